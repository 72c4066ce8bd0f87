"""Part boundaries of a skin, moved to the creases and seams of colour that run near them."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.triangles import lengths

from .band import Band, band
from .costs import end_costs
from .islands import without_islands
from .links import Links, links
from .min_cut import min_cut

# Moving an end by a share s of the reach costs its length times _STAY / 2 * s^2, and less than its length is
# to be won: it moves by a third of the reach to the best of seams.
_STAY = 15.0
# So many faces at most are free: the time that a cut takes grows faster than their number.
MOST_FREE = 150_000


def refined(mesh: Mesh, face_part: IntArray, reach: float) -> IntArray:
    """Move the ends of parts to where an end is likely, at most by `reach`.

    Faces farther than that from another part are kept, and so are those in the depth of each piece of a
    part and those broader than `reach`. Between each two parts the others are divided by a minimum cut.

    Args:
        mesh: the surface.
        face_part: (F,) part of every face, 0...
        reach: how far an end may move, such as one and a half patches [m].

    Returns:
        (F,) int32 parts; each that had a face has one.
    """
    label = np.array(face_part, dtype=np.int32)
    if len(label) < 2 or (label == label[0]).all():
        return label
    around = links(mesh)
    about = _bounded(band(around, label, breadths(mesh), reach))
    near = around.at(np.flatnonzero(about.free[around.left] | about.free[around.right]))
    cost = end_costs(mesh, near)
    change = _STAY * mesh.face_areas * np.minimum(about.depth / reach, 1.0) / reach
    for one, two in _pairs(label, about):
        _divide(label, about, near, cost, change, one, two)
    return without_islands(label, about.free, around)


def _divide(
    label: IntArray, about: Band, near: Links, cost: FloatArray, change: FloatArray, one: int, two: int
) -> None:
    """Divide the free faces between two parts anew, in place."""
    mine = (label == one) & (about.other == two) | (label == two) & (about.other == one)
    nodes = np.flatnonzero(mine & about.free)
    place = np.full(len(label), -1, dtype=np.int64)
    place[nodes] = np.arange(len(nodes))
    left, right = place[near.left], place[near.right]
    stays = np.where(label[nodes] == one, 0.0, change[nodes])
    leaves = np.where(label[nodes] == two, 0.0, change[nodes])
    for here, there in ((left, near.right), (right, near.left)):
        rim = (here >= 0) & (place[there] < 0)
        beyond = label[there]
        stays += np.bincount(here[rim & (beyond == two)], cost[rim & (beyond == two)], len(nodes))
        leaves += np.bincount(here[rim & (beyond == one)], cost[rim & (beyond == one)], len(nodes))
    both = (left >= 0) & (right >= 0)
    label[nodes] = np.where(min_cut(left[both], right[both], cost[both], stays, leaves), two, one)


def _pairs(label: IntArray, about: Band) -> list[tuple[int, int]]:
    """The pairs of parts, lower first, that have free faces between them."""
    here, there = label[about.free], about.other[about.free]
    pairs = np.unique(np.sort(np.stack([here, there], axis=1), axis=1), axis=0)
    return [(int(one), int(two)) for one, two in pairs]


def _bounded(about: Band) -> Band:
    """The same band, narrowed where it holds too many faces."""
    free = np.flatnonzero(about.free)
    if len(free) <= MOST_FREE:
        return about
    limit = np.partition(about.depth[free], MOST_FREE)[MOST_FREE]
    return Band(about.free & (about.depth < limit), about.depth, about.other)


def breadths(mesh: Mesh) -> FloatArray:
    """(F,) longest side of each face [m]."""
    sides = mesh.triangles - np.roll(mesh.triangles, 1, axis=1)
    return np.asarray(lengths(sides.reshape(-1, 3)).reshape(-1, 3).max(axis=1))
