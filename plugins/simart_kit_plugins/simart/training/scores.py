"""What a model is worth on some data: whole objects and single parts apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray

from ..models import VoxelModel
from .evaluation import Evaluation, evaluate
from .grids import Grids, objects_of


@dataclass(frozen=True)
class Score:
    """A model on grids of one kind.

    Attributes:
        kind: "whole objects", "single parts" or "all".
        evaluation: of the reconstruction.
        tokens: cells with a token, mean over grids.
        empty: share of the cells that need none, mean over grids; the paper's 70 %.
    """

    kind: str
    evaluation: Evaluation
    tokens: float
    empty: float


def score(model: VoxelModel, grids: Grids) -> tuple[Score, ...]:
    """The model on the whole objects, on their parts, and on all grids alike.

    An object of one part is a whole object only.
    """
    wholes = [rows[0] for rows in objects_of(grids.names)]
    parts = sorted(set(range(len(grids))) - set(wholes))
    kinds = {"whole objects": wholes, "single parts": parts}
    if parts:
        kinds["all"] = list(range(len(grids)))
    return tuple(_score(kind, model, grids, rows) for kind, rows in kinds.items() if rows)


def _score(kind: str, model: VoxelModel, grids: Grids, rows: Sequence[int]) -> Score:
    evaluation = evaluate(model, (grids.occupancy([row])[0] for row in rows))
    counts = np.array([_occupied(grids.occupancy([row])[0], model.config.cells) for row in rows])
    cells = np.prod(model.config.cells)
    return Score(kind, evaluation, float(counts.mean()), float(1 - (counts / cells).mean()))


def _occupied(occupancy: BoolArray, cells: tuple[int, int, int]) -> int:
    (x, y, z), edge = cells, len(occupancy)
    blocks = occupancy.reshape(x, edge // x, y, edge // y, z, edge // z)
    return int(blocks.any(axis=(1, 3, 5)).sum())
