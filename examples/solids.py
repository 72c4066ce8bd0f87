"""Closed solids made of flat polygons: boards, framed fronts and turned pieces. Metres, +Y up, front +Z."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
X, Y, Z = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Polygon:
    """A flat polygon with its look.

    Attributes:
        corners: (N, 3) counter-clockwise from outside [m].
        normals: (N, 3) unit, for shading.
        wood: band of the atlas.
        grain: axis along which the wood grows: 0, 1 or 2.
        plank: polygons of a solid with the same number are cut from the same piece of wood.
    """

    corners: Array
    normals: Array
    wood: str
    grain: int
    plank: int = 0


Solid = tuple[Polygon, ...]


def board(
    lower: Sequence[float],
    upper: Sequence[float],
    wood: str,
    grain: int,
    chamfer: float = 0.0015,
    faces: Mapping[str, str] | None = None,
) -> Solid:
    """A box with all twelve edges bevelled: 44 triangles.

    Args:
        lower: (3,) corner [m].
        upper: (3,) corner [m].
        wood: band of the atlas.
        grain: axis of the grain.
        chamfer: width of the bevel [m].
        faces: other bands for some sides, by direction such as "+z".
    """
    middle, half = (np.add(lower, upper)) / 2, (np.subtract(upper, lower)) / 2
    points = {}
    for signs in product((-1, 1), repeat=3):
        for axis in (X, Y, Z):
            inset = np.where(np.arange(3) == axis, 0.0, chamfer)
            points[signs, axis] = middle + np.array(signs) * (half - inset)
    groups: list[list[Array]] = []
    for axis, sign in product((X, Y, Z), (-1, 1)):
        groups.append([p for (signs, a), p in points.items() if a == axis and signs[axis] == sign])
    for axis in (X, Y, Z):
        first, second = (a for a in (X, Y, Z) if a != axis)
        for one, other in product((-1, 1), repeat=2):
            groups.append(
                [
                    p
                    for (signs, a), p in points.items()
                    if a != axis and signs[first] == one and signs[second] == other
                ]
            )
    for signs in product((-1, 1), repeat=3):
        groups.append([points[signs, axis] for axis in (X, Y, Z)])
    polygons = (_outward(np.array(group), middle, wood, grain) for group in groups)
    return tuple(_repainted(p, faces or {}) for p in polygons)


def framed_front(
    lower: Sequence[float], upper: Sequence[float], wood: str, grain: int, frame: float
) -> Solid:
    """A door or drawer front: frame with mitred corners, a groove, and a raised panel; it faces +Z.

    Args:
        lower: (3,) corner [m].
        upper: (3,) corner [m].
        wood: band of the atlas.
        grain: axis of the panel's grain.
        frame: width of the frame [m].
    """
    back, front = lower[2], upper[2]
    # (inset from the outline, z) of nested rectangles, from the back over the edge to the panel.
    rings = (
        (0.0015, back),
        (0.0, back + 0.0015),
        (0.0, front - 0.002),
        (0.002, front),
        (frame, front),
        (frame + 0.005, front - 0.007),
        (frame + 0.010, front - 0.007),
        (frame + 0.032, front - 0.001),
    )
    loops = [_rectangle(lower, upper, inset, z) for inset, z in rings]
    polygons = []
    for number, (outer, inner) in enumerate(pairwise(loops)):
        for side in range(4):
            corners = np.array([outer[side], outer[side - 3], inner[side - 3], inner[side]])
            along = X if side % 2 == 0 else Y
            flat = _flat(corners, wood, along if number < 5 else grain)
            polygons.append(replace(flat, plank=side if number < 5 else 4))
    polygons.append(replace(_flat(np.array(loops[-1]), wood, grain), plank=4))
    polygons.append(replace(_flat(np.array(loops[0][::-1]), wood, grain), plank=5))
    return tuple(polygons)


def turned(
    base: Sequence[float], axis: int, profile: Sequence[tuple[float, float]], sides: int, wood: str
) -> Solid:
    """A piece made on a lathe.

    Args:
        base: (3,) where its axis starts [m].
        axis: direction of the axis: 0, 1 or 2.
        profile: (radius, distance from the base) of each ring, the distance never falling [m].
        sides: corners of a ring.
        wood: band of the atlas.
    """
    around = _unit_ring(axis, sides)
    forward = np.eye(3)[axis]
    rings = [np.array(base) + radius * around + along * forward for radius, along in profile]
    steps = np.diff(np.array(profile), axis=0)
    slopes = np.stack([steps[:, 1], -steps[:, 0]], axis=1)
    slopes /= np.sqrt((slopes * slopes).sum(axis=1, keepdims=True))
    polygons = []
    for i in range(len(steps)):
        start, end = _shared(slopes, i, i - 1), _shared(slopes, i, i + 1)
        for k in range(sides):
            n = (k + 1) % sides
            corners = np.array([rings[i][k], rings[i][n], rings[i + 1][n], rings[i + 1][k]])
            normals = np.array(
                [
                    slope[0] * around[j] + slope[1] * forward
                    for j, slope in ((k, start), (n, start), (n, end), (k, end))
                ]
            )
            polygons.append(Polygon(corners, normals, wood, axis))
    across = (axis + 1) % 3
    polygons.append(_flat(rings[0][::-1], wood, across))
    polygons.append(_flat(rings[-1], wood, across))
    return tuple(polygons)


def _shared(slopes: Array, one: int, other: int) -> Array:
    """(2,) shading direction where two parts of a profile meet: common if they are nearly in line."""
    if not 0 <= other < len(slopes) or slopes[one] @ slopes[other] < 0.75:
        return np.array(slopes[one])
    both = slopes[one] + slopes[other]
    return np.array(both / np.sqrt(both @ both))


def _unit_ring(axis: int, sides: int) -> Array:
    """(N, 3) corners of a ring about an axis, counter-clockwise seen from its tip."""
    angles = np.arange(sides) * (2 * np.pi / sides)
    ring = np.zeros((sides, 3))
    # Rounded, because the last bit of a cosine differs between machines.
    ring[:, (axis + 1) % 3] = np.round(np.cos(angles), 9)
    ring[:, (axis + 2) % 3] = np.round(np.sin(angles), 9)
    return ring


def _rectangle(lower: Sequence[float], upper: Sequence[float], inset: float, z: float) -> list[Array]:
    """Corners from bottom left, counter-clockwise seen from +Z."""
    left, low, right, high = lower[0] + inset, lower[1] + inset, upper[0] - inset, upper[1] - inset
    return [np.array([x, y, z]) for x, y in ((left, low), (right, low), (right, high), (left, high))]


def _flat(corners: Array, wood: str, grain: int) -> Polygon:
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = normal / np.sqrt(normal @ normal)
    # Rounded, so that faces of one plane share vertices.
    return Polygon(corners, np.tile(np.round(normal, 6) + 0.0, (len(corners), 1)), wood, grain)


def _outward(points: Array, middle: Array, wood: str, grain: int) -> Polygon:
    """Order the corners of a convex polygon counter-clockwise seen from outside."""
    center = points.mean(axis=0)
    edge = points[0] - center
    normal = np.cross(edge, points[1] - center)
    normal = normal if normal @ (center - middle) > 0 else -normal
    side = np.cross(normal, edge)
    angles = np.arctan2(
        (points - center) @ side / np.sqrt(side @ side), (points - center) @ edge / np.sqrt(edge @ edge)
    )
    return _flat(points[np.argsort(angles)], wood, grain)


def _repainted(polygon: Polygon, faces: Mapping[str, str]) -> Polygon:
    """The polygon in the band of its main direction."""
    normal = polygon.normals[0]
    axis = int(np.abs(normal).argmax())
    direction = f"{'+' if normal[axis] > 0 else '-'}{'xyz'[axis]}"
    return replace(polygon, wood=faces.get(direction, polygon.wood))
