"""Large faces cut where a part ends inside them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, frozen_ints
from simart_kit.mesh import Mesh

from .halving import Pieces, halved, undivided
from .links import links
from .refining import breadths, refined
from .region import Region, put_back, region_of
from .whole import whole_again

# (N,) face of each place and (N, 3) barycentric weights in it -> (N,) part.
PartAt = Callable[[IntArray, FloatArray], IntArray]
# In patches: how far the end of a part may move, what a face must exceed to be searched for an end, and how
# long the sides of faces may be where an end may lie.
REACH, _COARSE, _FINE = 1.5, 0.5, 0.125
# So many faces at most may be cut, the broadest; pieces beyond that number are divided no more, and no side
# is halved more often.
_MOST_FACES, _MOST_PIECES, _MOST_STEPS = 50_000, 250_000, 12
_MOST_ROWS = 16


@dataclass(frozen=True, eq=False)
class CutMesh:
    """A mesh with a part for each face; only faces that a part ends in, and their neighbours, are cut.

    Attributes:
        mesh: the same surface; the very mesh that was given where nothing had to be cut.
        face_part: (G,) int32 part of each face.
        face_source: (G,) int32 face of the given mesh that it is of, ascending: faces that were not cut keep
            their order, and the pieces of one that was stand in its place.
    """

    mesh: Mesh
    face_part: IntArray
    face_source: IntArray


def cut(mesh: Mesh, face_part: IntArray, part_at: PartAt, patch: float) -> CutMesh:
    """Give each face of a skin its part; cut those that are larger than patches where a part ends in them.

    All that lies near an end is divided finely, the ends are moved by `refined`, and what needs no cut is
    put together again. A closed surface stays closed: neighbours get the corners on the sides they share.

    Args:
        mesh: the surface.
        face_part: (F,) part of each face by its middle, 0...
        part_at: the part at any place of it.
        patch: size of the patches that carry the parts [m].
    """
    large = _large(mesh, patch)
    alone = undivided(region_of(mesh, np.flatnonzero(large))) if large.any() else None
    if alone is None or not _mixed(alone, part_at, patch).any():
        part = frozen_ints(refined(mesh, face_part, REACH * patch))
        return CutMesh(mesh, part, frozen_ints(np.arange(len(part))))
    region = region_of(mesh, _with_neighbours(mesh, large))
    steps = _divided(mesh, face_part, part_at, patch, region, large)
    fine, _, row = put_back(mesh, region, steps[-1].mesh, steps[-1].source)
    known = np.concatenate([face_part, _parts(steps[-1], face_part, part_at)])
    known[row] = refined(fine, known[row], REACH * patch)
    made, source, part = whole_again(steps, known[len(mesh.faces) :])
    whole, source, row = put_back(mesh, region, made, source)
    label = np.concatenate([known[: len(mesh.faces)], part])[row]
    uncut = len(whole.faces) == len(mesh.faces)
    return CutMesh(mesh if uncut else whole, frozen_ints(label), frozen_ints(source))


def _large(mesh: Mesh, patch: float) -> BoolArray:
    """(F,) faces that may be cut: those too broad for their middle to tell where a part ends."""
    breadth = breadths(mesh)
    large = breadth > _COARSE * patch
    if large.sum() > _MOST_FACES:
        large &= breadth > np.partition(breadth, -_MOST_FACES)[-_MOST_FACES]
    return large


def _with_neighbours(mesh: Mesh, chosen: BoolArray) -> IntArray:
    """(R,) the chosen faces and all that share an edge with one."""
    around, wanted = links(mesh), chosen.copy()
    wanted[around.left[chosen[around.right]]] = True
    wanted[around.right[chosen[around.left]]] = True
    return np.flatnonzero(wanted)


def _divided(
    mesh: Mesh, face_part: IntArray, part_at: PartAt, patch: float, region: Region, large: BoolArray
) -> list[Pieces]:
    """The region, divided step by step: where ends lie, then wherever they may be moved to."""
    steps = [undivided(region)]
    for _ in range(_MOST_STEPS):
        mixed = _mixed(steps[-1], part_at, patch) & large[steps[-1].source]
        sides = _long_sides(steps[-1].mesh, mixed, _COARSE * patch)
        if not sides.any():
            break
        steps.append(halved(steps[-1], sides))
    fine, _, row = put_back(mesh, region, steps[-1].mesh, steps[-1].source)
    known = np.concatenate([face_part, _parts(steps[-1], face_part, part_at)])
    ends = _ends(fine, known[row])
    for _ in range(_MOST_STEPS):
        near = _near(steps[-1].mesh, ends, REACH * patch) & large[steps[-1].source]
        sides = _long_sides(steps[-1].mesh, near, _FINE * patch)
        if not sides.any() or len(sides) > _MOST_PIECES:
            break
        steps.append(halved(steps[-1], sides))
    return steps


def _parts(pieces: Pieces, face_part: IntArray, part_at: PartAt) -> IntArray:
    """(F,) parts: that of its middle for what was divided, and else the known one."""
    label = np.asarray(face_part)[pieces.source]
    count = np.bincount(pieces.source)
    made = np.flatnonzero(count[pieces.source] > 1)
    label[made] = part_at(pieces.source[made], pieces.weights[made].mean(axis=1))
    return label


def _mixed(pieces: Pieces, part_at: PartAt, patch: float) -> BoolArray:
    """(F,) whether a face is large and places in it are of several parts."""
    breadth = breadths(pieces.mesh)
    mixed = np.zeros(len(breadth), dtype=np.bool_)
    large = np.flatnonzero(breadth > _COARSE * patch)
    rows = np.clip(np.ceil(2 * breadth[large] / patch), 2, _MOST_ROWS).astype(np.int64)
    for count in np.unique(rows).tolist():
        some = large[rows == count]
        grid = _grid(count)
        places = np.einsum("gc,fcs->fgs", grid, pieces.weights[some]).reshape(-1, 3)
        part = part_at(np.repeat(pieces.source[some], len(grid)), places).reshape(len(some), -1)
        mixed[some] = (part != part[:, :1]).any(axis=1)
    return mixed


def _grid(rows: int) -> FloatArray:
    """(rows * rows, 3) barycentric weights of the middles of so many equal small triangles."""
    i, j = (index.ravel() for index in np.mgrid[:rows, :rows])
    upright, flipped = i + j < rows, i + j < rows - 1
    low = np.concatenate(
        [np.stack([i, j], axis=1)[upright] + 1 / 3, np.stack([i, j], axis=1)[flipped] + 2 / 3]
    )
    low = low / rows
    return np.column_stack([low, 1 - low.sum(axis=1)])


def _ends(mesh: Mesh, label: IntArray) -> FloatArray:
    """(E, 3) places where parts meet [m]."""
    around = links(mesh)
    apart = label[around.left] != label[around.right]
    middles = mesh.triangles.mean(axis=1)
    return np.asarray((middles[around.left[apart]] + middles[around.right[apart]]) / 2)


def _near(mesh: Mesh, ends: FloatArray, reach: float) -> BoolArray:
    """(F,) whether a face may come within reach of one of the (E, 3) ends."""
    from scipy.spatial import cKDTree

    near = np.zeros(len(mesh.faces), dtype=np.bool_)
    if len(ends):
        middles = mesh.triangles.mean(axis=1)
        radius = np.linalg.norm(mesh.triangles - middles[:, None], axis=2).max(axis=1)
        near = np.asarray(cKDTree(ends).query(middles)[0]) < reach + radius
    return near


def _long_sides(mesh: Mesh, chosen: BoolArray, limit: float) -> BoolArray:
    """(F, 3) the sides of the chosen faces that are longer than the limit, from each corner to the next."""
    sides = np.roll(mesh.triangles, -1, axis=1) - mesh.triangles
    return np.asarray((np.linalg.norm(sides, axis=2) > limit) & chosen[:, None])
