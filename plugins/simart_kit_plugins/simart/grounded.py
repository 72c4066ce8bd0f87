"""The voxels that a model gave for a description, to faces of the mesh."""

from __future__ import annotations

import numpy as np

from simart_kit import Mesh, Note
from simart_kit.arrays import BoolArray
from simart_kit.grounding import Grounded

from .asking import Said
from .certainty import certainty
from .codec import seeds
from .labelling import TransferOptions, labelled
from .looking import Asked
from .seeding import Decoder
from .tokens import VoxelTokens

_NAMES = ("part", "rest")


def grounded(
    mesh: Mesh, asked: Asked, said: Said[VoxelTokens], decoder: Decoder, options: TransferOptions
) -> Grounded:
    """The faces that decoded voxels win against the rest of the object's; none where nothing is decoded.

    Voxels of the object that touch decoded ones are on neither side, for decoding moves a surface by one.
    """
    (part,) = decoder.voxels([said.value], asked.seen)
    cells, sure = len(said.value.index), certainty(said.words)
    told = f"{said.source} gives it {cells} of {len(asked.seen.tokens.index)} cells"
    notes = (*asked.notes, *(Note("segment", "warning", remark) for remark in said.remarks))
    rest = asked.seen.occupancy & ~_grown(part)
    frame = asked.seen.frame
    if not part.any():
        faces = np.zeros(len(mesh.faces), dtype=np.bool_)
        return Grounded(faces, 0.0, f"{told}, which decode to no voxel", notes=notes)
    if not rest.any():
        faces = np.ones(len(mesh.faces), dtype=np.bool_)
        return Grounded(faces, sure, f"{told}: it is the whole object", notes=notes)
    labels = labelled(mesh, [seeds(part, frame), seeds(rest, frame)], _NAMES, options)
    faces = labels.moved.face_part == 0
    return Grounded(faces, sure, told, notes=(*notes, *labels.notes))


def _grown(grid: BoolArray) -> BoolArray:
    """The voxels that are on, and those that touch one, also at an edge or a corner."""
    for axis in range(3):
        padded = np.moveaxis(np.pad(grid, [(1, 1) if a == axis else (0, 0) for a in range(3)]), axis, 0)
        grid = np.moveaxis(padded[:-2] | padded[1:-1] | padded[2:], 0, axis)
    return np.asarray(grid)
