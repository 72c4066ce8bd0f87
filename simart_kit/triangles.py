"""Triangles as (F, 3, 3) corners: which way they face, and how large they are."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .arrays import FloatArray, IntArray

_AT_ONCE = 1 << 12


def crosses(triangles: FloatArray) -> FloatArray:
    """(F, 3) normals towards where the corners run counter-clockwise, as long as twice the area."""
    normals = np.zeros((len(triangles), 3))
    for some in chunks(len(triangles)):
        normals[some] = _crosses(triangles[some]).T
    return normals


def _crosses(triangles: FloatArray) -> FloatArray:
    """(3, F) the same by axis, several times as fast as `numpy.cross`."""
    a, b, c = np.array(triangles.reshape(-1, 9).T, dtype=np.float64, order="C").reshape(3, 3, -1)
    b -= a
    c -= a
    for axis in range(3):
        after, last = (axis + 1) % 3, (axis + 2) % 3
        a[axis] = b[after] * c[last] - b[last] * c[after]
    return np.asarray(a)


def areas(triangles: FloatArray) -> FloatArray:
    """(F,) areas, in square units."""
    return np.asarray(0.5 * lengths(crosses(triangles)))


def unit_normals(triangles: FloatArray) -> FloatArray:
    """(F, 3) unit normals; zero for a triangle without area."""
    normals = crosses(triangles)
    length = lengths(normals)[:, None]
    return np.asarray(np.divide(normals, length, out=np.zeros_like(normals), where=length > 0))


def areas_and_normals(points: FloatArray, faces: IntArray) -> tuple[FloatArray, FloatArray]:
    """The same (F,) areas and (F, 3) unit normals at once, of (F, 3) faces on (V, 3) points."""
    area, normals = np.zeros(len(faces)), np.zeros((len(faces), 3))
    for some in chunks(len(faces)):
        cross = _crosses(points.take(faces[some], axis=0))
        length = lengths(cross.T)
        area[some] = 0.5 * length
        np.divide(cross, length, out=normals[some].T, where=length > 0)
    return area, normals


def cosines(normals: FloatArray, left: IntArray, right: IntArray) -> FloatArray:
    """(L,) cosines of the angles between the unit `normals` (F, 3) of `left` (L,) and `right` (L,) faces."""
    cosine = np.zeros(len(left))
    for some in chunks(len(left)):
        one, two = normals.take(left[some], axis=0), normals.take(right[some], axis=0)
        cosine[some] = np.einsum("ij,ij->i", one, two)
    return cosine


def lengths(vectors: FloatArray) -> FloatArray:
    """(N,) lengths of (N, 3) vectors, faster than `numpy.linalg.norm`."""
    x, y, z = vectors.T
    return np.asarray(np.sqrt(x * x + y * y + z * z))


def chunks(count: int) -> Iterator[slice]:
    """Slices of 0..count-1 so short that a few arrays of that length stay in the processor's cache."""
    return (slice(start, start + _AT_ONCE) for start in range(0, count, _AT_ONCE))
