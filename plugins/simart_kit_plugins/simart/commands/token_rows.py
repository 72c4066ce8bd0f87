"""What the command `tokens` measures: the length of each form, the codes, and what decoding loses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from simart_kit.arrays import BoolArray
from simart_kit.bench.reconstruction import score_reconstruction

from ..token_counts import TokenCounts, token_counts
from ..tokens import VoxelTokens

HEAD = ("", "cells", "dense", "force-sparse", "zero-sparse", "empty", "codes", "IoU", "CD x1e5")


@dataclass(frozen=True, slots=True)
class Row:
    """One shape, or the mean of several.

    Attributes:
        name: of the shape.
        cells: occupied cells.
        dense, force_sparse, zero_sparse: atomic tokens of the three forms; see `token_counts`.
        reduction: share of the cells that need no token, 0..1.
        codes: different codes used.
        iou: intersection over union of voxels and decoded voxels, 0..1.
        cd: chamfer distance of the same, squared: `cd_squared` of `Reconstruction`.
    """

    name: str
    cells: float
    dense: float
    force_sparse: float
    zero_sparse: float
    reduction: float
    codes: float
    iou: float
    cd: float

    def table(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return asdict(self)

    def texts(self) -> tuple[str, ...]:
        """Cells of a table for people, under `HEAD`."""
        counts = (self.cells, self.dense, self.force_sparse, self.zero_sparse)
        told = [f"{value:.0f}" if float(value).is_integer() else f"{value:.1f}" for value in counts]
        codes = f"{self.codes:.0f}" if float(self.codes).is_integer() else f"{self.codes:.1f}"
        return (self.name, *told, f"{self.reduction:.1%}", codes, f"{self.iou:.3f}", f"{self.cd * 1e5:.2f}")


def row(name: str, tokens: VoxelTokens, true: BoolArray, decoded: BoolArray) -> Row:
    """Measure one shape.

    Args:
        name: of the shape.
        tokens: what it was encoded to.
        true: (64, 64, 64) its voxels.
        decoded: (64, 64, 64) what its tokens decode to.
    """
    counts: TokenCounts = token_counts(tokens.dense() > 0)
    scores = score_reconstruction(true, decoded)
    return Row(
        name,
        counts.zero_sparse.cells,
        counts.dense.tokens,
        counts.force_sparse.tokens,
        counts.zero_sparse.tokens,
        counts.reduction.cells,
        len(np.unique(tokens.code)),
        scores.iou,
        scores.cd_squared,
    )


def mean(rows: Sequence[Row], name: str) -> Row:
    """The mean of each number."""
    numbers = np.array([[value for key, value in r.table().items() if key != "name"] for r in rows])
    return Row(name, *numbers.mean(axis=0).tolist())
