"""Which face of a mesh each face of its cut version was cut from."""

from __future__ import annotations

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, frozen_ints
from .mesh import Mesh
from .rays import Rays
from .triangles import crosses

_OFF = 1e-5  # of the diagonal: how far above a face a ray starts
_LEVEL = 0.999  # cosine between normals of a face and of what was cut from it
_MOST_PAIRS = 50_000_000  # that are compared one by one
_AT_ONCE = 2_000_000


def face_sources(cut: Mesh, given: Mesh) -> IntArray:
    """(F,) face of the given mesh that each face of the cut one lies in, -1 where that is not clear.

    Args:
        cut: the same surface, some faces divided; may be the given mesh itself.
        given: the whole faces.
    """
    if cut is given:
        return frozen_ints(np.arange(len(cut.faces)))
    caster, middles, normals = Rays(given.vertices, given.faces), cut.triangles.mean(axis=1), cut.face_normals
    found = np.full(len(cut.faces), -1)
    height = _OFF * given.diagonal
    for side in (1.0, -1.0):
        seen, distance = caster.first(middles + side * height * normals, -side * normals)
        level = (normals * given.face_normals[seen]).sum(axis=1) > _LEVEL
        fits = (found < 0) & (seen >= 0) & (np.abs(distance - height) < 0.5 * height) & level
        found[fits] = seen[fits]
    unclear = np.flatnonzero(found < 0)  # where surfaces lie on each other, a ray may meet the other one
    if len(unclear) * len(given.faces) <= _MOST_PAIRS:
        rows = max(1, _AT_ONCE // len(given.faces))
        for some in np.split(unclear, range(rows, len(unclear), rows)):
            found[some] = _containing(middles[some], normals[some], given, height)
    return frozen_ints(found)


def _containing(points: FloatArray, normals: FloatArray, given: Mesh, height: float) -> IntArray:
    """(N,) first face that holds each point and looks its way, -1 for none; every pair is looked at."""
    offsets = np.einsum("fi,fi->f", given.face_normals, given.triangles[:, 0])
    apart = np.abs(points @ given.face_normals.T - offsets) < height
    pairs = np.argwhere(apart & (normals @ given.face_normals.T > _LEVEL))
    inside = _holds(given.triangles[pairs[:, 1]], points[pairs[:, 0]])
    found = np.full(len(points), -1)
    chosen = pairs[inside][::-1]  # of several the first is written last
    found[chosen[:, 0]] = chosen[:, 1]
    return found


def _holds(triangles: FloatArray, points: FloatArray) -> BoolArray:
    """(N,) whether points in the planes of (N, 3, 3) triangles lie inside them."""
    ends = np.roll(triangles, -1, axis=1)
    turns = [crosses(np.stack([points, triangles[:, i], ends[:, i]], axis=1)) for i in range(3)]
    towards = crosses(triangles)
    return np.asarray(np.all([(turn * towards).sum(axis=1) >= 0 for turn in turns], axis=0))
