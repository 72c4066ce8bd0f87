"""How deep two convex shapes stand in each other, exactly: the separating axis theorem."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .arrays import FloatArray, IntArray
from .asset import ConvexMesh
from .bounds import sharing
from .kept import kept
from .primitive_meshes import pose
from .topology import unique_rows
from .triangles import areas, unit_normals

_SAME = 1e6  # steps of a grid, of which directions that share one are one
_AT_ONCE = 512  # axes that vertices are multiplied with
_SLIVER = 1e-9  # of the largest triangle's area: normals of smaller ones are noise


@dataclass(frozen=True, eq=False)
class Convex:
    """A convex shape with what the test asks of it.

    Attributes:
        shape: in the asset frame; a round primitive counts as exactly round.
        turned: the same shape elsewhere, whose directions are known, and the (3, 3) rotation from there.
    """

    shape: ConvexMesh
    turned: tuple[Convex, FloatArray] | None = None

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) lower and upper corner of the box around it, along the asset's axes [m]."""
        lower, upper = self.extent(np.eye(3))
        return np.array([lower, upper])

    @cached_property
    def middle(self) -> FloatArray:
        """(3,) middle of that box [m]."""
        lower, upper = self.bounds
        return np.asarray((lower + upper) / 2)

    @cached_property
    def normals(self) -> FloatArray:
        """(N, 3) unit normals of its faces, each up to its sign."""
        if self.turned:
            return self.turned[0].normals @ self.turned[1].T
        triangles = self.shape.vertices[self.shape.faces]
        area = areas(triangles)
        return _lines(unit_normals(triangles[area > _SLIVER * area.max()]))

    @cached_property
    def edges(self) -> FloatArray:
        """(E, 3) unit directions of the edges between its faces, each up to its sign."""
        if self.turned:
            return self.turned[0].edges @ self.turned[1].T
        vertices, faces = self.shape.vertices, self.shape.faces
        ends = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        order = np.lexsort(ends.T)
        ends, normals = ends[order], np.repeat(unit_normals(vertices[faces]), 3, axis=0)[order]
        repeated = (ends[1:] == ends[:-1]).all(axis=1)
        flat = repeated & (np.einsum("ei,ei->e", normals[1:], normals[:-1]) > 1 - 1e-9)
        creased = ~(np.append(flat, False) | np.insert(flat, 0, False))
        return _lines(vertices[ends[creased, 1]] - vertices[ends[creased, 0]])

    def extent(self, axes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(K,) lowest and highest coordinates along (K, 3) unit axes [m]."""
        primitive = self.shape.primitive
        if primitive is None or primitive.kind == "box":
            lower, upper = np.zeros(len(axes)), np.zeros(len(axes))
            for some in _slices(len(axes)):
                along = self.shape.vertices @ axes[some].T  # so that a row is long: minima are faster
                lower[some], upper[some] = along.min(axis=0), along.max(axis=0)
            return lower, upper
        middle = axes @ primitive.asset_T_shape[:3, 3]
        reach = np.full(len(axes), primitive.size[0] / 2)
        if primitive.kind == "cylinder":
            cosine = np.abs(axes @ primitive.asset_T_shape[:3, 2])
            reach = reach * np.sqrt(np.maximum(1 - cosine**2, 0)) + cosine * primitive.size[2] / 2
        return middle - reach, middle + reach

    def moved(self, matrix: FloatArray) -> Convex:
        """The shape where a (4, 4) motion takes it."""
        rotation, shift = matrix[:3, :3], matrix[:3, 3]
        primitive = self.shape.primitive
        if primitive is not None:
            start = primitive.asset_T_shape
            primitive = replace(
                primitive, asset_T_shape=pose(rotation @ start[:3, :3], rotation @ start[:3, 3] + shift)
            )
        vertices = self.shape.vertices @ rotation.T + shift
        return Convex(ConvexMesh(vertices, self.shape.faces, primitive), (self, rotation))


@kept
def convex(shape: ConvexMesh) -> Convex:
    """A shape with what the test asks of it, which stays known as long as the shape is."""
    return Convex(shape)


def meets(one: Convex, boxes: FloatArray) -> IntArray:
    """Indices of the (N, 2, 3) boxes that share space with the one around a shape."""
    return sharing(one.bounds, boxes)


def gap(one: Convex, other: Convex, deep: float = 0.0) -> tuple[float, FloatArray]:
    """How far two shapes are apart [m], and the (3,) unit axis from one to the other along which they are.

    Negative is how deep they overlap: the shortest way that parts them. Positive is their distance where
    faces look at each other, and at most their distance elsewhere.

    Args:
        one: a shape.
        other: a shape.
        deep: where they overlap by less than this [m], how deep exactly is not looked at: the answer may be
            deeper than it is, but not as deep as this.
    """
    if deep > 0:  # boxes tell at once of two that hardly share space
        found = _farthest((*one.bounds,), (*other.bounds,), np.eye(3))
        if found[0] > -deep:
            return found
    middles = other.middle - one.middle
    length = float(np.linalg.norm(middles))
    between = middles[None] / length if length > 0 else np.eye(3)
    for few in (between, one.normals) if deep > 0 else ():  # most are apart along these
        found = _widest(one, other, few)
        if found[0] > -deep:
            return found
    found = _widest(one, other, np.concatenate([one.normals, other.normals, between]))
    if found[0] > -deep:
        return found
    cross = _across(one.edges, other.edges)
    edged = _widest(one, other, cross) if len(cross) else found
    return edged if edged[0] > found[0] + 1e-9 else found  # faces win ties: shapes are cut along them


def gap_across(one: Convex, other: Convex, way: FloatArray) -> tuple[float, FloatArray]:
    """How far two shapes pass each other by [m], if one moves along a (3,) unit way, and the axis there."""
    across = _across(np.concatenate([one.edges, other.edges]), way[None])
    return _widest(one, other, _lines(across))


def _across(one: FloatArray, other: FloatArray) -> FloatArray:
    """(K, 3) unit directions across each of (N, 3) and each of (M, 3) ones that are not parallel."""
    a, b = one.T[:, :, None], other.T[:, None]
    x, y, z = a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    size = np.sqrt(x * x + y * y + z * z)
    wide = size > 1e-6
    return np.asarray(np.stack([x[wide], y[wide], z[wide]]).T / size[wide, None])


def _widest(one: Convex, other: Convex, axes: FloatArray) -> tuple[float, FloatArray]:
    return _farthest(one.extent(axes), other.extent(axes), axes)


def _farthest(
    one: tuple[FloatArray, FloatArray], other: tuple[FloatArray, FloatArray], axes: FloatArray
) -> tuple[float, FloatArray]:
    """How far two extents (K,) are apart along that of (K, 3) axes where it is most, and the way there."""
    ahead, behind = other[0] - one[1], one[0] - other[1]
    best = int(np.argmax(np.maximum(ahead, behind)))
    sign = 1.0 if ahead[best] >= behind[best] else -1.0
    return float(max(ahead[best], behind[best])), sign * axes[best]


def _slices(count: int) -> Iterator[slice]:
    """Even slices of 0..count-1, so short that their products stay in the processor's cache.

    BLAS would share longer ones among threads, which wait for each other longer than they work.
    """
    parts = -(-count // _AT_ONCE)
    return (slice(count * k // parts, count * (k + 1) // parts) for k in range(parts))


def _lines(directions: FloatArray) -> FloatArray:
    """The distinct lines along (N, 3) directions, as unit vectors."""
    unit = directions / np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-300)
    lead = np.argmax(np.abs(unit) > 1e-3, axis=1)
    unit = unit * np.sign(np.take_along_axis(unit, lead[:, None], axis=1))
    first = unique_rows(np.rint(unit * _SAME).astype(np.int64))[0]
    return np.asarray(unit[np.sort(first)])
