"""What the segmenter `tokens` shows in a recording: every step from tokens to probabilities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.evidence import Evidence, PointEvidence, VertexEvidence, VoxelEvidence
from simart_kit.voxels import GridFrame

from .codec import seeds
from .tokens import RESOLUTION

if TYPE_CHECKING:
    from simart_kit.arrays import BoolArray
    from simart_kit.transfer import Transfer

    from .tokens import VoxelTokens
    from .tokens_file import TokensFile

ERRORS = ("missing", "added")


@dataclass(frozen=True, eq=False)
class Decoded:
    """Voxels of the mesh and of the tokens, in one frame.

    Attributes:
        frame: the cube about the mesh.
        mesh: (64, 64, 64) bool, voxels of the mesh.
        whole: (64, 64, 64) bool, decoded from the object's tokens.
        parts: (P, 64, 64, 64) bool, decoded from each part's.
    """

    frame: GridFrame
    mesh: BoolArray
    whole: BoolArray
    parts: BoolArray


def evidence(file: TokensFile, decoded: Decoded, moved: Transfer) -> tuple[Evidence, ...]:
    """Tokens by code, the reconstruction and its errors, seeds, and probabilities at the vertices.

    The mesh's own voxels are in every recording.
    """
    names = tuple(part.name for part in file.parts)
    return (
        token_cells(file.object, decoded.frame),
        _reconstruction(decoded),
        _errors(decoded),
        _seeds(decoded, names),
        VertexEvidence("Probability", np.clip(moved.probabilities, 0, 1), names),
    )


def token_cells(tokens: VoxelTokens, frame: GridFrame) -> VoxelEvidence:
    """Occupied cells with their codes; a cell that is no cube, of 16x8x8, is shown as several cubes."""
    edge = min(tokens.grid.block)
    cubes = RESOLUTION // edge
    fine = GridFrame(frame.origin, frame.voxel_size * edge, cubes)
    codes = tokens.dense()
    for axis, cells in enumerate(codes.shape):
        codes = codes.repeat(cubes // cells, axis=axis)
    where = np.argwhere(codes > 0)
    return VoxelEvidence("Tokens by code", fine, where, codes[tuple(where.T)])


def _reconstruction(decoded: Decoded) -> VoxelEvidence:
    where = np.argwhere(decoded.whole)
    return VoxelEvidence("Reconstruction", decoded.frame, where, where[:, 2].astype(np.float64))


def _errors(decoded: Decoded) -> VoxelEvidence:
    where = np.argwhere(decoded.whole ^ decoded.mesh)
    added = decoded.whole[tuple(where.T)].astype(np.int32)
    return VoxelEvidence("Errors", decoded.frame, where, added, ERRORS)


def _seeds(decoded: Decoded, names: tuple[str, ...]) -> PointEvidence:
    points = [seeds(grid, decoded.frame) for grid in decoded.parts]
    group = np.repeat(np.arange(len(points)), [len(part) for part in points])
    return PointEvidence("Part seeds", np.concatenate(points), group, names)
