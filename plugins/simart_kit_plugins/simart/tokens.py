"""Voxel tokens: the occupied cells of a coarse grid, each with the code that stands for its geometry."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, IntArray, frozen_ints
from simart_kit.errors import BadInputError

RESOLUTION = 64
GRID_SHAPES = ((8, 8, 8), (16, 8, 8))
CODEBOOK_SIZES = (4096, 8192)
EMPTY_CODE = 0
VOXEL_NAME = "<voxel>"

# y and z have eight cells in every grid shape, so that one formula serves all: 64x + 8y + z.
_STRIDES = (64, 8, 1)


@dataclass(frozen=True, slots=True)
class TokenGrid:
    """The cells that tokens may name, and the codes that they may carry.

    The paper's text and tables use 8x8x8 cells and 4096 codes, its system prompt 16x8x8 and 8192; the linear
    index 64x + 8y + z holds for both. x runs left to right, y front to back, z from the ground up.

    Attributes:
        shape: cells along x, y and z, one of `GRID_SHAPES`.
        codebook: number of codes, one of `CODEBOOK_SIZES`; code 0 means emptiness.
    """

    shape: tuple[int, int, int] = (8, 8, 8)
    codebook: int = 4096

    def __post_init__(self) -> None:
        """Refuse a grid or a codebook that the index formula and the models do not know."""
        if self.shape not in GRID_SHAPES:
            known = " or ".join("x".join(map(str, shape)) for shape in GRID_SHAPES)
            raise BadInputError(f"token grid {self.shape}: the grid must have {known} cells")
        if self.codebook not in CODEBOOK_SIZES:
            known = " or ".join(map(str, CODEBOOK_SIZES))
            raise BadInputError(f"codebook of {self.codebook}: it must have {known} codes")

    @property
    def cells(self) -> int:
        """Number of cells; indices are 0..cells-1."""
        return math.prod(self.shape)

    @property
    def block(self) -> tuple[int, int, int]:
        """Voxels of the 64^3 grid in a cell, along x, y and z."""
        x, y, z = self.shape
        return (RESOLUTION // x, RESOLUTION // y, RESOLUTION // z)

    def index(self, coordinates: IntArray) -> IntArray:
        """(..., 3) cell coordinates to (...) linear indices; raises BadInputError outside the grid."""
        _require_whole(coordinates, "cell coordinates")
        if coordinates.shape[-1:] != (3,):
            raise BadInputError(f"cell coordinates have shape {coordinates.shape}, expected (..., 3)")
        outside = ((coordinates < 0) | (coordinates >= np.array(self.shape))).any(axis=-1)
        if outside.any():
            raise BadInputError(f"cell {coordinates[outside][0].tolist()} lies outside the grid {self.shape}")
        return frozen_ints(coordinates @ np.array(_STRIDES))

    def coordinates(self, index: IntArray) -> IntArray:
        """(...) linear indices to (..., 3) cell coordinates; raises BadInputError outside the grid."""
        _require_within(index, 0, self.cells - 1, "cell index")
        return frozen_ints(np.stack(np.unravel_index(frozen_ints(index), self.shape), axis=-1))

    def occupied_cells(self, occupancy: BoolArray) -> BoolArray:
        """Cells that hold a voxel which is on: a max-pool of the input, never derived from an encoder.

        Args:
            occupancy: (64, 64, 64) whether a voxel is on.

        Returns:
            (X, Y, Z) whether a cell is occupied, read-only.

        Raises:
            BadInputError: the grid has another shape or does not hold booleans.
        """
        if occupancy.shape != (RESOLUTION,) * 3 or occupancy.dtype != np.bool_:
            found = f"{occupancy.dtype} of shape {occupancy.shape}"
            raise BadInputError(f"occupancy is {found}, expected bool of shape {(RESOLUTION,) * 3}")
        split = [size for pair in zip(self.shape, self.block, strict=True) for size in pair]
        occupied = np.asarray(occupancy.reshape(split).any(axis=(1, 3, 5)))
        occupied.setflags(write=False)
        return occupied


@dataclass(frozen=True, eq=False, slots=True)
class VoxelTokens:
    """The sparse form of a shape: cells that are not listed are empty.

    No cell at all is a valid value, which a part without surface gives; whoever needs geometry must ask.

    Attributes:
        grid: what the cells and the codes are counted in.
        index: (K,) int32 linear cell indices 64x + 8y + z, each once, ascending.
        code: (K,) int32 codes 1..codebook-1.

    Raises:
        BadInputError: wrong shapes, values out of range, a cell twice or out of order.
    """

    grid: TokenGrid
    index: IntArray
    code: IntArray

    def __post_init__(self) -> None:
        """Check before the values are narrowed to int32, which would wrap in silence."""
        if self.index.ndim != 1 or self.index.shape != self.code.shape:
            raise BadInputError(
                f"voxel tokens: index {self.index.shape} and code {self.code.shape} must be equal in length"
            )
        _require_within(self.index, 0, self.grid.cells - 1, "cell index")
        _require_within(self.code, 1, self.grid.codebook - 1, "code")
        object.__setattr__(self, "index", frozen_ints(self.index))
        object.__setattr__(self, "code", frozen_ints(self.code))
        unsorted = np.flatnonzero(np.diff(self.index) <= 0)
        if len(unsorted):
            before, after = self.index[unsorted[0]], self.index[unsorted[0] + 1]
            raise BadInputError(f"voxel tokens: cell {after} follows cell {before}, indices must ascend")

    @classmethod
    def from_dense(cls, grid: TokenGrid, codes: IntArray) -> VoxelTokens:
        """The tokens of a dense array.

        Args:
            grid: what the cells and the codes are counted in.
            codes: (X, Y, Z) codes, 0 where a cell is empty.

        Raises:
            BadInputError: the array has not the grid's shape, or a code is out of range.
        """
        if codes.shape != grid.shape:
            raise BadInputError(f"dense codes have shape {codes.shape}, expected {grid.shape}")
        _require_within(codes, EMPTY_CODE, grid.codebook - 1, "code")
        index = np.flatnonzero(codes != EMPTY_CODE)
        return cls(grid, index, codes.ravel()[index])

    def dense(self) -> IntArray:
        """(X, Y, Z) codes, read-only, 0 where a cell is empty."""
        codes = np.full(self.grid.cells, EMPTY_CODE, dtype=np.int32)
        codes[self.index] = self.code
        return frozen_ints(codes.reshape(self.grid.shape))

    @property
    def coordinates(self) -> IntArray:
        """(K, 3) cell coordinates."""
        return self.grid.coordinates(self.index)

    def text(self) -> str:
        """The form that the paper prints, for people: `<voxel> 43 1930 <voxel> 44 7`."""
        return " ".join(f"{VOXEL_NAME} {cell} {code}" for cell, code in self._pairs())

    def atoms(self) -> str:
        """The form that a model reads: `<voxel><xyz_43><mesh_1930>`, three added tokens a cell.

        No blanks stand between the names, since a tokenizer would spend a token on each.
        """
        return "".join(VOXEL_NAME + coordinate_name(cell) + code_name(code) for cell, code in self._pairs())

    def _pairs(self) -> list[tuple[int, int]]:
        return list(zip(self.index.tolist(), self.code.tolist(), strict=True))


def coordinate_name(index: int) -> str:
    """Name of the atomic token that stands for a cell, such as `<xyz_43>`."""
    return f"<xyz_{index}>"


def code_name(code: int) -> str:
    """Name of the atomic token that stands for a code, such as `<mesh_1930>`."""
    return f"<mesh_{code}>"


def _require_whole(values: IntArray, what: str) -> None:
    if values.dtype.kind not in "iu":
        raise BadInputError(f"{what} must be whole numbers, found {values.dtype}")


def _require_within(values: IntArray, low: int, high: int, what: str) -> None:
    _require_whole(values, what)
    outside = values[(values < low) | (values > high)]
    if outside.size:
        raise BadInputError(f"{what} {outside.flat[0]} is out of range {low}..{high}")
