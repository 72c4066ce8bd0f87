"""Closed solids that touch others along edges and faces, and yet are their own: a drawer in its bay."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .mesh import Mesh
from .topology import connected, half_edges, shared_by_two, unique_rows

# Faces around an edge in one of so many directions coincide: steps are far above single precision's noise.
_DIRECTIONS = 1 << 12
_OPPOSED = -0.95
_SPREAD = 0.1  # least of the share of what opposes each other that lies across the main direction


def plugs(mesh: Mesh, corners: IntArray, face_ids: IntArray) -> IntArray:
    """Tell which faces are of solids that fill a hole, or have one that another fills.

    Two faces belong together at an edge that only they have, and at an edge of more where nothing but
    material lies between them: outwards is where their corners run counter-clockwise. A closed surface is a
    plug where others lie against it all around, but not at its ends.

    Args:
        mesh: the faces' mesh.
        corners: (K, 3) welded ids of what the faces meet at; none twice in a face.
        face_ids: (K,) ids of the faces. Repeated ones that are wound alike count once.

    Returns:
        (K,) number 1.. of each face's plug, 0 for all other faces.
    """
    half, edge = half_edges(corners)
    if not _crowded(edge).any():
        return np.zeros(len(corners), dtype=np.int64)
    own, which = unique_rows(_from_lowest(corners))
    corners, face_ids = corners.take(own, axis=0), face_ids.take(own)
    half, edge = half_edges(corners)
    crowd = _Crowd.of(mesh, corners, face_ids, half, edge)
    two = shared_by_two(edge)
    left = np.concatenate([half.take(two) // 3, crowd.face[crowd.begins]])
    right = np.concatenate([half.take(two + 1) // 3, crowd.face[crowd.after[crowd.begins]]])
    surface = connected(len(corners), left, right)
    faces = np.bincount(surface)
    closed = 2 * np.bincount(surface.take(left), minlength=len(faces)) == 3 * faces
    against = crowd.against(surface)
    touched = np.unique(surface.take(against))
    found = [
        number
        for number in touched[closed[touched]]
        if _surrounded(mesh.face_normals[face_ids[against[surface.take(against) == number]]])
    ]
    plug = np.zeros(len(faces), dtype=np.int64)
    plug[found] = np.arange(1, len(found) + 1)
    return plug.take(surface).take(which)


def _surrounded(normals: FloatArray) -> bool:
    """Whether some of (N, 3) unit normals oppose each other in all directions of a plane, and only there."""
    once = np.unique(np.round(normals, 3), axis=0)
    opposed = once[(once @ once.T < _OPPOSED).any(axis=1)]
    if len(opposed) < 4:
        return False
    spread = np.linalg.eigvalsh(opposed.T @ opposed / len(opposed))
    return bool(spread[1] > _SPREAD > spread[0])


def _crowded(edge: IntArray) -> BoolArray:
    """(H,) which of sorted edges are there more than twice."""
    third = np.flatnonzero(edge[2:] == edge[:-2])
    crowded = np.zeros(len(edge), dtype=np.bool_)
    crowded[np.concatenate([third, third + 1, third + 2])] = True
    return crowded


def _from_lowest(corners: IntArray) -> IntArray:
    """(K, 3) the same corners, in the same sense, from the lowest on."""
    turn = (corners.argmin(axis=1)[:, None] + np.arange(3)) % 3
    return np.take_along_axis(corners, turn, axis=1)


@dataclass(frozen=True, eq=False)
class _Crowd:
    """Faces at edges that more than two have, in the order in which they stand around it.

    Attributes:
        face: (H,) of them; those of an edge follow each other.
        direction: (H,) that they lie in, around the edge.
        after: (H,) where the next face around the edge stands.
        begins: where material begins that ends at the next face.
    """

    face: IntArray
    direction: IntArray
    after: IntArray
    begins: IntArray

    @classmethod
    def of(cls, mesh: Mesh, corners: IntArray, face_ids: IntArray, half: IntArray, edge: IntArray) -> _Crowd:
        """Those of (K, 3) faces, whose half-edges are as `topology.half_edges` gives them."""
        some = _crowded(edge)
        half, edge = half[some], edge[some]
        new = np.diff(edge, prepend=-1) > 0
        group = np.cumsum(new) - 1
        face, side = half // 3, half % 3
        upwards = corners[face, side] < corners[face, (side + 1) % 3]
        direction = _directions(mesh, face_ids.take(face), side, upwards, np.flatnonzero(new)[group])
        # Going round the edge, an upward face is where material ends, any other where it begins. Where one
        # solid touches another, it ends before the other begins.
        order = np.lexsort((~upwards, direction, group))
        upwards = upwards[order]
        start = np.flatnonzero(new)
        after = np.arange(1, len(group) + 1)
        after[np.append(start[1:], len(group)) - 1 if len(start) else start] = start
        # Material must begin and end by turns, or the faces are not wound as those of solids.
        sound = np.bincount(group, upwards == upwards.take(after)) == 0
        begins = np.flatnonzero(~upwards & sound.take(group))
        return cls(face[order], direction[order], after, begins)

    def against(self, surface: IntArray) -> IntArray:
        """Faces that coincide, beside their edge, with one of another of the (K,) surfaces."""
        other = surface.take(self.face) != surface.take(self.face[self.after])
        here = np.flatnonzero(other & (self.direction == self.direction[self.after]))
        return np.unique(self.face[np.concatenate([here, self.after[here]])])


def _directions(
    mesh: Mesh, face_ids: IntArray, side: IntArray, upwards: BoolArray, first: IntArray
) -> IntArray:
    """(H,) in which of many directions around its edge, counted from the `first` face's, each face lies."""
    start, end = (mesh.vertices[mesh.faces[face_ids, (side + step) % 3]] for step in range(2))
    sign = np.where(upwards, 1.0, -1.0)[:, None]
    upward = _unit((end - start) * sign)
    inwards = _unit(np.cross(mesh.face_normals.take(face_ids, axis=0), upward) * sign)
    cosine = np.einsum("ij,ij->i", inwards[first], inwards)
    sine = np.einsum("ij,ij->i", np.cross(upward[first], inwards[first]), inwards)
    turn = np.arctan2(sine, cosine) / (2 * np.pi)
    return np.asarray(np.rint(turn * _DIRECTIONS).astype(np.int64) % _DIRECTIONS)


def _unit(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)[:, None])
