"""Surface voxels: which cells of a cubic grid a triangle mesh touches, and world <-> grid."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .arrays import BoolArray, FloatArray, IntArray, Vec3, frozen_ints, vec3
from .triangles import crosses

# Cell counts and keys pass 32 bits from 1291 cells an edge on.
LongArray = NDArray[np.int64]

# Slack of every test, in voxels: a face on the border of two cells turns both on, whatever rounding says.
_SLACK = 1e-9
# Grid columns tested at once; keeps the working memory near 100 MB.
_COLUMNS = 1 << 17
# Grids of up to so many cells an edge are marked cell by cell: 16 MB.
_MARKED = 256
# Triangles looked at at once: as many as a processor's cache holds.
_AT_ONCE = 1 << 14
_NONE: LongArray = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True, slots=True)
class GridFrame:
    """A cube of `resolution`^3 cubic cells along the axes of the mesh's frame.

    Attributes:
        origin: (3,) lowest corner of cell (0, 0, 0) [m].
        voxel_size: edge of a cell [m].
        resolution: cells along an edge of the cube.
    """

    origin: Vec3
    voxel_size: float
    resolution: int

    def __post_init__(self) -> None:
        if self.resolution < 1 or not (math.isfinite(self.voxel_size) and self.voxel_size > 0):
            raise ValueError(f"a grid needs cells: resolution {self.resolution}, size {self.voxel_size}")

    def to_grid(self, points: FloatArray) -> FloatArray:
        """(..., 3) points [m] to cell coordinates; cell (i, j, k) spans i..i+1, j..j+1, k..k+1."""
        return np.asarray((points - np.array(self.origin)) / self.voxel_size, dtype=np.float64)

    def to_world(self, cells: FloatArray) -> FloatArray:
        """(..., 3) cell coordinates to points [m]; the inverse of `to_grid`."""
        return np.asarray(cells * self.voxel_size + np.array(self.origin), dtype=np.float64)


@dataclass(frozen=True, eq=False)
class VoxelGrid:
    """The cells that are on.

    Attributes:
        frame: where the grid lies.
        indices: (K, 3) int32 cells 0..resolution-1, each once, in lexicographic order.
    """

    frame: GridFrame
    indices: IntArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "indices", frozen_ints(self.indices))

    @property
    def centers(self) -> FloatArray:
        """(K, 3) middles of the cells [m]."""
        return self.frame.to_world(self.indices.astype(np.float64) + 0.5)

    @cached_property
    def occupancy(self) -> BoolArray:
        """(N, N, N) read-only: whether a cell is on."""
        dense = np.zeros((self.frame.resolution,) * 3, dtype=np.bool_)
        dense[tuple(self.indices.T)] = True
        dense.setflags(write=False)
        return dense


def cube_frame(bounds: FloatArray, resolution: int) -> GridFrame:
    """The smallest cubic grid about (2, 3) bounds [m], in their middle; raises ValueError for a point."""
    side = float((bounds[1] - bounds[0]).max())
    if not side > 0:
        raise ValueError("a point has no size to divide into voxels")
    return GridFrame(vec3((bounds[0] + bounds[1]) / 2 - side / 2), side / resolution, resolution)


def voxelise(triangles: FloatArray, frame: GridFrame) -> VoxelGrid:
    """Turn on every cell whose closed box a triangle touches, however thin or small the triangle.

    A triangle whose bounding box lies in one row of cells touches all of that box's cells. Each other one is
    offered the cells that its plane passes through, column by column along the axis that it faces most; those
    that the separating-axis test does not part from it stay (Akenine-Moeller, "Fast 3D Triangle-Box Overlap
    Testing", 2001). Triangles without area count as the segment or point that they are.

    Args:
        triangles: (F, 3, 3) corners [m], such as `Mesh.triangles`.
        frame: the grid, such as `cube_frame(mesh.bounds, 64)`; what lies outside it is cut off.
    """
    cells = frame.resolution
    pieces = range(0, len(triangles), _AT_ONCE)
    rows = [_in_rows(triangles[start : start + _AT_ONCE], frame) for start in pieces]
    keys = [_distinct(np.concatenate([_NONE, *(found for found, _ in rows)]), cells)]
    others = np.flatnonzero(np.concatenate([np.zeros(0, dtype=np.bool_), *(left for _, left in rows)]))
    corners = frame.to_grid(triangles[others])
    first, last = _cell_span(*_extremes(corners), cells)
    # The axis that a triangle faces most is put last, so that its columns run along z.
    normal = crosses(corners)
    facing = np.abs(normal).argmax(axis=1)
    for axis in range(3):
        order = [(axis + 1) % 3, (axis + 2) % 3, axis]
        mine = np.flatnonzero(facing == axis).astype(np.int64)
        for chunk in _chunks(first[mine], last[mine], mine, order):
            touched = _touched(corners[chunk][:, :, order], first[chunk][:, order], last[chunk][:, order])
            weights = np.array([cells * cells, cells, 1], dtype=np.int64)[order]
            keys.append(_distinct(touched @ weights, cells))
    flat = _distinct(np.concatenate(keys), cells)
    return VoxelGrid(frame, np.stack(np.unravel_index(flat, (cells,) * 3), axis=1))


def _extremes(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest over the second axis of (F, 3) or (F, 3, 3); numpy's reductions take much longer."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def _cell_span(low: FloatArray, high: FloatArray, cells: int) -> tuple[FloatArray, FloatArray]:
    """First and last cell whose closed box meets a range, as whole floats cut to the grid."""
    first = np.maximum(np.ceil(low - _SLACK) - 1.0, 0.0)
    return first, np.minimum(np.floor(high + _SLACK), cells - 1.0)


def _in_rows(triangles: FloatArray, frame: GridFrame) -> tuple[LongArray, BoolArray]:
    """The cells of (F, 3, 3) triangles whose bounding box lies in one row of them.

    Returns:
        (K,) keys of those cells, and (F,) which triangles are left, those outside the grid not among them.
    """
    cells, count = frame.resolution, len(triangles)
    start, end, long = np.zeros(count), np.zeros(count), np.zeros(count, dtype=np.int8)
    inside, whole = np.ones(count, dtype=np.bool_), np.ones(count, dtype=np.bool_)
    for axis, origin in enumerate(frame.origin):
        low, high = ((end - origin) / frame.voxel_size for end in _extremes(triangles[:, :, axis]))
        first, last = _cell_span(low, high, cells)
        inside &= first <= last
        # What the grid cuts off may be all that lies in a cell of the box.
        whole &= (low >= 0) & (high <= cells)
        long += last > first
        start, end = start * cells + first, end * cells + last
    in_row = whole & (long <= 1)
    return _row_keys(start[in_row], end[in_row], cells), inside & ~in_row


def _row_keys(start: FloatArray, end: FloatArray, cells: int) -> LongArray:
    """(K,) keys of all cells in rows from the keys `start` (R,) to `end` (R,), along any axis."""
    long = np.flatnonzero(end > start)
    length = end[long] - start[long]
    stride = np.where(length >= cells * cells, cells * cells, np.where(length >= cells, cells, 1))
    row, step = _repeat((length / stride).astype(np.int64) + 1)
    return np.concatenate([start, start[long][row] + step * stride[row]]).astype(np.int64)


def _distinct(keys: LongArray, cells: int) -> LongArray:
    """The keys 0..cells^3-1 that occur, ascending; small grids are marked, which is faster than to sort."""
    if cells > _MARKED:
        return np.unique(keys)
    marked = np.zeros(cells**3, dtype=np.bool_)
    marked[keys] = True
    return np.flatnonzero(marked)


def _chunks(first: FloatArray, last: FloatArray, ids: LongArray, order: list[int]) -> Iterator[LongArray]:
    """Split triangle ids so that a piece has about `_COLUMNS` columns, or one triangle."""
    columns = (last - first + 1.0)[:, order[:2]].prod(axis=1)
    piece = (np.cumsum(columns) // _COLUMNS).astype(np.int64)
    return (group for group in np.split(ids, np.flatnonzero(np.diff(piece)) + 1) if len(group))


def _touched(corners: FloatArray, first: FloatArray, last: FloatArray) -> LongArray:
    """(M, 3) cells touched by (T, 3, 3) triangles in grid units that face z; a cell may come twice."""
    triangle, cell = _columns(corners, first, last)
    centers = cell + 0.5
    keep = np.ones(len(cell), dtype=np.bool_)
    for axis in _axes(corners):
        reach = 0.5 * np.abs(axis).sum(axis=1) + _SLACK * np.abs(axis).max(axis=1)
        along = np.einsum("tcx,tx->tc", corners, axis)
        low, high = _extremes(along)
        low, high = low - reach, high + reach
        place = np.einsum("mx,mx->m", centers, axis[triangle])
        keep &= (low[triangle] <= place) & (place <= high[triangle])
    return cell[keep].astype(np.int64)


def _columns(corners: FloatArray, first: FloatArray, last: FloatArray) -> tuple[LongArray, FloatArray]:
    """Candidates, (M,) triangles with (M, 3) cells: in each column, those that the triangle's plane passes.

    For a triangle next to no area the normal is noise; the plane is therefore widened until it holds all
    three corners, so that nothing is missed whatever the slope.
    """
    size = (last - first + 1.0).astype(np.int64)
    triangle, rank = _repeat(size[:, 0] * size[:, 1])
    corner = first[triangle, :2] + np.stack(np.divmod(rank, size[triangle, 1]), axis=1)
    normal = crosses(corners)
    slope = np.divide(
        -normal[:, :2], normal[:, 2:], out=np.zeros_like(first[:, :2]), where=normal[:, 2:] != 0
    )
    height = corners[:, :, 2] - np.einsum("tcx,tx->tc", corners[:, :, :2], slope)
    half = 0.5 * np.abs(slope).sum(axis=1) + 1e-6
    middle = np.einsum("mx,mx->m", corner + 0.5, slope[triangle])
    lowest, highest = _extremes(height)
    bottom = middle + (lowest - half)[triangle]
    top = middle + (highest + half)[triangle]
    low = np.maximum(np.ceil(bottom) - 1.0, first[triangle, 2])
    high = np.minimum(np.floor(top), last[triangle, 2])
    column, step = _repeat(np.maximum(high - low + 1.0, 0.0).astype(np.int64))
    cell = np.concatenate([corner[column], (low[column] + step)[:, None]], axis=1)
    return triangle[column], cell


def _axes(corners: FloatArray) -> Iterator[FloatArray]:
    """Directions (T, 3) that may part triangle and box, besides the box's own: normal, edges x box axes."""
    edges = np.roll(corners, -1, axis=1) - corners
    yield np.cross(edges[:, 0], edges[:, 1])
    for edge in range(3):
        for unit in np.eye(3):
            yield np.cross(edges[:, edge], unit)


def _repeat(counts: LongArray) -> tuple[LongArray, LongArray]:
    """Each index as often as its count says, and the rank of each copy."""
    index = np.repeat(np.arange(len(counts), dtype=np.int64), counts)
    return index, np.arange(len(index), dtype=np.int64) - np.repeat(np.cumsum(counts) - counts, counts)
