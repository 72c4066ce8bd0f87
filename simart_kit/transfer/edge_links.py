"""Which faces follow each other around an edge, also where more than two meet because surfaces touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, units
from ..topology import edge_ends, half_edges, shared_by_two, unique_rows
from ..triangles import areas_and_normals, cosines

CREASE_ANGLE = np.deg2rad(25.0)
# Edges with more faces than this link none; pairing takes time with the square.
_MOST_FACES = 16
# Directions closer than this are the same [rad].
_SAME_ANGLE = 1e-6


@dataclass(frozen=True, eq=False)
class EdgeLinks:
    """Pairs of faces that continue each other.

    Attributes:
        left, right: (L,) ids of the two faces.
        bent: (L,) whether the surface is creased between them: it turns by more than 25 degrees.
        repeats: (R, 2) a face and the one that it repeats, which alone has links.
        creased: (V,) whether a vertex touches a crease, or an edge of more than two faces.
        ends: (E,) lower and higher vertex of each edge, and how many faces have it.
    """

    left: IntArray
    right: IntArray
    bent: BoolArray
    repeats: IntArray
    creased: BoolArray
    ends: tuple[IntArray, IntArray, IntArray]


def edge_links(points: FloatArray, faces: IntArray) -> EdgeLinks:
    """Link the faces at every edge.

    Where more than two faces meet at an edge, surfaces touch there. Those two belong together that have
    material between them, as far as their winding tells (counter-clockwise from outside).

    Args:
        points: (V, 3) [m].
        faces: (F, 3) vertex ids.
    """
    half, edge = half_edges(faces)
    first, ends = shared_by_two(edge), edge_ends(faces, edge)
    one, two = half.take(first), half.take(first + 1)
    crowded, edge = _crowded(half, edge)
    repeats: IntArray = np.zeros((0, 2), dtype=np.int64)
    if len(crowded):
        repeats = _repeats(faces, np.unique(crowded // 3))
        once = ~np.isin(crowded // 3, repeats[:, 0])
        crowded, edge = crowded[once], edge[once]
        more, others = _across_material(points, faces, crowded, edge)
        one, two = np.concatenate([one, more]), np.concatenate([two, others])
    left, right = one // 3, two // 3
    bent = cosines(areas_and_normals(points, faces)[1], left, right) < np.cos(CREASE_ANGLE)
    creased = np.zeros(len(points), dtype=np.bool_)
    for sharp in (one[bent], two[bent], crowded):
        creased[faces[sharp // 3, sharp % 3]] = True
        creased[faces[sharp // 3, (sharp + 1) % 3]] = True
    return EdgeLinks(left, right, bent, repeats, creased, ends)


def _crowded(half: IntArray, edge: IntArray) -> tuple[IntArray, IntArray]:
    """The half-edges, and their edges, where more than two share an edge."""
    same = edge[1:] == edge[:-1]
    third = same[1:] & same[:-1]
    many = np.zeros(len(edge), dtype=np.bool_)
    for shift in range(3):
        many[shift : shift + len(third)] |= third
    some = np.flatnonzero(many)
    return half[some], edge[some]


def _repeats(faces: IntArray, suspects: IntArray) -> IntArray:
    """(R, 2) of the suspects, those with the corners of an earlier one in the same sense, with that one."""
    corners = faces[suspects]
    turn = corners.argmin(axis=1)[:, None] + np.arange(3)
    once, same = unique_rows(np.take_along_axis(corners, turn % 3, axis=1))
    first = once[same]
    again = first != np.arange(len(suspects))
    return np.stack([suspects[again], suspects[first[again]]], axis=1)


def _across_material(
    points: FloatArray, faces: IntArray, half: IntArray, edge: IntArray
) -> tuple[IntArray, IntArray]:
    """Pairs of half-edges of crowded edges that bound the same wedge of material."""
    group = np.cumsum(np.r_[False, edge[1:] != edge[:-1]])
    rising = faces[half // 3, half % 3] < faces[half // 3, (half + 1) % 3]
    angle = _angles(points, faces, half, rising)
    falling = np.bincount(group, ~rising).astype(np.int64)
    first = np.cumsum(falling) - falling
    partners = np.flatnonzero(~rising)
    one = np.flatnonzero(rising & (np.bincount(group)[group] <= _MOST_FACES))
    many = falling[group[one]]
    two = np.repeat(first[group[one]] - np.cumsum(many) + many, many) + np.arange(many.sum())
    one, two = np.repeat(one, many), partners[two]
    # Seen along the rising edge, the material of a face wound that way begins clockwise of it.
    wedge = (angle[one] - angle[two]) % (2 * np.pi)
    wedge[wedge < _SAME_ANGLE] += 2 * np.pi
    least = np.full(len(half), np.inf)
    np.minimum.at(least, one, wedge)
    np.minimum.at(least, two, wedge)
    best = wedge <= np.minimum(least[one], least[two]) + _SAME_ANGLE
    return half[one[best]], half[two[best]]


def _angles(points: FloatArray, faces: IntArray, half: IntArray, rising: BoolArray) -> FloatArray:
    """(H,) direction of each face seen along its edge from the lower vertex id to the higher [rad]."""
    face, side = half // 3, half % 3
    start, end = faces[face, side], faces[face, (side + 1) % 3]
    low, high = points[np.where(rising, start, end)], points[np.where(rising, end, start)]
    along = units(high - low)
    reference = units(np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)]))
    inward = points[faces[face, (side + 2) % 3]] - low
    across = np.einsum("ij,ij->i", inward, np.cross(along, reference))
    return np.asarray(np.arctan2(across, np.einsum("ij,ij->i", inward, reference)))
