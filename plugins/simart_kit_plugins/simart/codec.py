"""Meshes and grids to voxel tokens, and back to points: what stands between the model and the rest.

All parts of an object lie in one frame, the cube about the object; a part is never centred or scaled by
itself. So its tokens tell where it is, and its decoded voxels are seeds on the object's own surface.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh
from simart_kit.voxels import GridFrame, VoxelGrid, cube_frame, voxelise

from .tokens import RESOLUTION, TokenGrid, VoxelTokens

if TYPE_CHECKING:
    from torch import Tensor

# Grids that go through the model at once: the full-size one needs about 300 MB for each.
_BATCH = 4
# A mesh may leave its cube by so many voxels: rounding of its bounds.
_SLACK = 1e-6


class TokenConfig(Protocol):
    """What `VqvaeConfig` says of tokens."""

    @property
    def resolution(self) -> int:
        """Voxels along an edge of the cube."""

    @property
    def cells(self) -> tuple[int, int, int]:
        """Tokens along x, y and z."""

    @property
    def codebook_size(self) -> int:
        """Number of codes."""

    @property
    def mode(self) -> str:
        """How empty cells are written: "zero", "force-sparse" or "dense"."""


class EncodedGrids(Protocol):
    """What `encode` gives: see `vqvae.model.Encoded`."""

    @property
    def codes(self) -> Tensor:
        """(B, X, Y, Z) int64."""


class TokenModel(Protocol):
    """A model between voxels and codes, such as `vqvae.model.SparseVQVAE`."""

    @property
    def config(self) -> TokenConfig:
        """Sizes and mode."""

    def encode(self, occupancy: Tensor) -> EncodedGrids:
        """Codes of (B, 1, R, R, R) voxels."""

    def decode(self, codes: Tensor, occupied: Tensor) -> Tensor:
        """(B, 1, R, R, R) logits of (B, X, Y, Z) codes; nothing is on outside the `occupied` cells."""


@dataclass(frozen=True, eq=False)
class ObjectGrids:
    """An object and its parts as voxels in one frame.

    Attributes:
        frame: the cube about the object.
        whole: (64, 64, 64) bool.
        parts: (P, 64, 64, 64) bool.
    """

    frame: GridFrame
    whole: BoolArray
    parts: BoolArray


@dataclass(frozen=True, eq=False)
class ObjectTokens:
    """An object and its parts as tokens in one frame.

    Attributes:
        frame: the cube about the object, 64 voxels an edge.
        whole: tokens of the object.
        parts: tokens of each part; their cells are a subset of the object's.
    """

    frame: GridFrame
    whole: VoxelTokens
    parts: tuple[VoxelTokens, ...]


def token_grid(model: TokenModel) -> TokenGrid:
    """The cells and codes that a model's tokens are counted in.

    Raises:
        BadInputError: the model is not of mode zero, so that code 0 may stand for geometry and a sequence
            cannot leave empty cells out; or its sizes are not those of a token sequence.
    """
    config = model.config
    if config.mode != "zero":
        raise BadInputError(
            f"a model of mode '{config.mode}' has no zero token, and voxel tokens need one: "
            "give a model of mode 'zero'"
        )
    if config.resolution != RESOLUTION:
        raise BadInputError(f"a model of {config.resolution}^3 voxels: voxel tokens need {RESOLUTION}^3")
    return TokenGrid(config.cells, config.codebook_size)


def nearest_codes(model: TokenModel) -> TokenModel:
    """The model, sharing its weights, that encodes with the nearest codes and tries no others.

    Where a model encodes by trial (vq-nano) this is some 15 times as fast, for a part IoU that is lower by
    about 0.03; a model that does not is returned as it is. Language models are trained and asked with it.
    """
    from .vqnano.model import VqNano

    if not isinstance(model, VqNano):
        return model
    quick = copy.copy(model)
    quick.config = model.config.model_copy(update={"candidates": 1})
    return quick


def object_frame(mesh: Mesh) -> GridFrame:
    """The 64^3 cube about an object, which its parts share; raises BadInputError for a point."""
    try:
        return cube_frame(mesh.bounds, RESOLUTION)
    except ValueError as error:
        raise BadInputError(f"the mesh cannot be divided into voxels: {error}") from error


def occupancy(triangles: FloatArray, frame: GridFrame, name: str = "the mesh") -> BoolArray:
    """(64, 64, 64) voxels that (F, 3, 3) triangles [m] touch.

    Raises:
        BadInputError: there is no triangle, or one lies outside the frame; a surface that is cut off in
            silence would come back as another shape.
    """
    if not len(triangles):
        raise BadInputError(f"{name} has no faces, so it has no voxels")
    corners = frame.to_grid(triangles.reshape(-1, 3))
    beyond = float(max(-corners.min(), corners.max() - frame.resolution))
    if beyond > _SLACK * frame.resolution:
        raise BadInputError(
            f"{name} lies up to {beyond * frame.voxel_size:.3g} m outside the cube of voxels: "
            "take the cube about the whole object"
        )
    return voxelise(triangles, frame).occupancy


def object_grids(mesh: Mesh, face_part: IntArray, names: Sequence[str]) -> ObjectGrids:
    """Voxels of a mesh and its parts in the cube about the mesh.

    Args:
        mesh: in the canonical frame.
        face_part: (F,) part 0..P-1 of every face, -1 for none.
        names: of the P parts, for messages.

    Raises:
        BadInputError: labels of another mesh, a part without faces, or a mesh that is a point.
    """
    if face_part.shape != (len(mesh.faces),):
        raise BadInputError(f"{len(face_part)} labels for a mesh of {len(mesh.faces)} faces")
    if face_part.max(initial=-1) >= len(names) or face_part.min(initial=0) < -1:
        raise BadInputError(f"labels {face_part.min()}..{face_part.max()} for {len(names)} parts")
    frame = object_frame(mesh)
    groups = [mesh.triangles[face_part == part] for part in range(len(names))]
    grids = [occupancy(group, frame, f"part '{name}'") for group, name in zip(groups, names, strict=True)]
    parts = np.array(grids, dtype=np.bool_).reshape(-1, *(RESOLUTION,) * 3)
    # Where every face is of a part, the whole has the voxels of its parts and no others.
    covered = len(grids) > 0 and face_part.min() >= 0
    whole = np.asarray(parts.any(axis=0)) if covered else occupancy(mesh.triangles, frame)
    return ObjectGrids(frame, whole, parts)


def encode_parts(model: TokenModel, mesh: Mesh, face_part: IntArray, names: Sequence[str]) -> ObjectTokens:
    """Tokens of a mesh and of its parts, all in the object's frame; see `object_grids` and `encode_grids`."""
    grids = object_grids(mesh, face_part, names)
    whole, *parts = encode_grids(model, np.concatenate([grids.whole[None], grids.parts]))
    return ObjectTokens(grids.frame, whole, tuple(parts))


def encode_grids(model: TokenModel, occupancy: BoolArray) -> tuple[VoxelTokens, ...]:
    """Tokens of (N, 64, 64, 64) voxels.

    Raises:
        BadInputError: a grid is empty or of another shape, or the model has no tokens (see `token_grid`).
    """
    import torch

    grid = token_grid(model)
    if occupancy.shape[1:] != (RESOLUTION,) * 3 or occupancy.dtype != np.bool_:
        raise BadInputError(
            f"grids of {occupancy.dtype} and shape {occupancy.shape}: bool (N, 64, 64, 64) is needed"
        )
    empty = np.flatnonzero(~occupancy.any(axis=(1, 2, 3)))
    if len(empty):
        raise BadInputError(f"grid {empty[0]} is empty: there is no voxel to encode")
    codes: list[IntArray] = []
    for start in range(0, len(occupancy), _BATCH):
        batch = torch.from_numpy(occupancy[start : start + _BATCH].copy())[:, None].float()
        codes += list(model.encode(batch).codes.numpy())
    return tuple(VoxelTokens.from_dense(grid, dense) for dense in codes)


def decode_tokens(model: TokenModel, tokens: Sequence[VoxelTokens]) -> BoolArray:
    """(N, 64, 64, 64) voxels of token sequences; none are on outside the cells that a sequence names.

    Raises:
        BadInputError: tokens of another grid or codebook, or the model has no tokens (see `token_grid`).
    """
    import torch

    grid = token_grid(model)
    foreign = next((t.grid for t in tokens if t.grid != grid), None)
    if foreign is not None:
        raise BadInputError(f"tokens of {_told(foreign)} cannot be decoded by a model of {_told(grid)}")
    result = np.zeros((len(tokens), *(RESOLUTION,) * 3), dtype=np.bool_)
    for start in range(0, len(tokens), _BATCH):
        dense = np.stack([t.dense() for t in tokens[start : start + _BATCH]]).astype(np.int64)
        codes = torch.from_numpy(dense)
        logits = model.decode(codes, codes > 0)
        result[start : start + _BATCH] = (logits[:, 0] > 0).numpy()
    return result


def seeds(occupancy: BoolArray, frame: GridFrame) -> FloatArray:
    """(K, 3) middles of the voxels that are on [m], for `simart_kit.transfer`."""
    return VoxelGrid(frame, np.argwhere(occupancy)).centers


def part_seeds(occupancy: BoolArray, frame: GridFrame, names: Sequence[str]) -> list[FloatArray]:
    """Seeds of each part of (P, 64, 64, 64) decoded voxels.

    Raises:
        BadInputError: a part has none; it would vanish from the object.
    """
    gone = [name for name, grid in zip(names, occupancy, strict=True) if not grid.any()]
    if gone:
        raise BadInputError(
            f"part '{gone[0]}' decodes to no voxel: check its tokens, or leave the part out of the file"
        )
    return [seeds(grid, frame) for grid in occupancy]


def _told(grid: TokenGrid) -> str:
    return f"{'x'.join(map(str, grid.shape))} cells and {grid.codebook} codes"
