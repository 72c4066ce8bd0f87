"""Decoded parts onto a mesh's faces: the transfer, numbered without the parts that get no face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Mesh, Note
from simart_kit.arrays import FloatArray, IntArray, frozen_ints
from simart_kit.segments import Segments, find_segments
from simart_kit.transfer import Transfer, TransferMode, transfer
from simart_kit.transfer.labels import AGREEMENT, ITERATIONS, SIGMA


class TransferOptions(simart_kit.Options):
    """How decoded voxels are laid onto the mesh."""

    transfer: TransferMode = Field(
        default="segments",
        description="Label each face by itself (seeds), or also each segment that agrees (segments).",
    )
    sigma: float = Field(
        default=SIGMA,
        gt=0,
        allow_inf_nan=False,
        description="Reach of a seed [share of the bounding box's diagonal].",
    )
    iterations: int = Field(default=ITERATIONS, ge=0, description="Smoothing steps over the mesh.")
    agreement: float = Field(
        default=AGREEMENT, gt=0.5, le=1, description="Share of a segment's area that has to agree."
    )


@dataclass(frozen=True, eq=False)
class Labels:
    """Faces with their parts.

    Attributes:
        face_part: (F,) int32 place in `kept` of each face's part.
        kept: the parts that have a face, ascending.
        segments: of the mesh.
        moved: the transfer, with all parts.
        notes: on parts that won no face by vote, by their names.
    """

    face_part: IntArray
    kept: tuple[int, ...]
    segments: Segments
    moved: Transfer
    notes: tuple[Note, ...]


def labelled(
    mesh: Mesh, seeds: Sequence[FloatArray], names: Sequence[str], options: TransferOptions
) -> Labels:
    """Give each face the part that its surroundings vote for; see `simart_kit.transfer`.

    Args:
        mesh: of any frame.
        seeds: for each part (N_p, 3) points [m] in it, at least one.
        names: of the parts.
        options: of the transfer.
    """
    segments = find_segments(mesh)
    moved = transfer(
        mesh,
        seeds,
        mode=options.transfer,
        sigma=options.sigma,
        iterations=options.iterations,
        agreement=options.agreement,
        segments=segments,
    )
    kept, numbered = np.unique(moved.face_part, return_inverse=True)
    face_part = frozen_ints(numbered.reshape(-1).astype(np.int32))
    return Labels(face_part, tuple(kept.tolist()), segments, moved, _notes(moved, names))


def _notes(moved: Transfer, names: Sequence[str]) -> tuple[Note, ...]:
    """The transfer's own notes, parts by name."""
    texts = list(moved.notes)
    for part, name in enumerate(names):
        texts = [
            f"part '{name}' {text.removeprefix(f'part {part} ')}"
            if text.startswith(f"part {part} ")
            else text
            for text in texts
        ]
    return tuple(Note("segment", "warning", text) for text in texts)
