"""Lines that a link may turn about and arrows that it may slide along: a letter each, drawn from geometry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.alignment import yaw
from simart_kit.arrays import BoolArray, FloatArray, units
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.sweeping import sample_surface

from ..nano.candidates import fitted_circle

_POINTS = 3000  # sampled on a link, and on what carries it
_TRIM = 0.01  # share of them that a box leaves out at each side: thin handles must not move its edges
_NEAR = 0.015  # of the diagonal: parallel lines nearer than this are one
_ALIKE = np.cos(np.deg2rad(4.0))
_TOUCH = 0.02  # of the diagonal: what lies so near is in contact
_ROUND = 0.06  # misfit of a circle, as a share of its radius, up to which its middle is a candidate
_SECTION = ((0.0, 0.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0))
_APART = 0.02  # of the largest spread: what two others differ by where ways along them are clear
_SPOT = 0.6  # of the link's size up to which a contact is a spot on it, as a lever's on its axle
_STRIP = 0.25  # width by length up to which a contact is a strip
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"  # without I and O, which look like numbers


@dataclass(frozen=True, eq=False)
class Line:
    """A way to move.

    Attributes:
        letter: in pictures.
        axis: (3,) unit; positive opens.
        origin: (3,) a point on it [m].
        group: lines of a number are parallel, and drawn in one picture.
        source: "edge", "center", "circle" or "contact" of turns; "slide".
    """

    letter: str
    axis: FloatArray
    origin: FloatArray
    group: int
    source: str


@dataclass(frozen=True, eq=False)
class Shape:
    """Points on a link and on what carries it.

    Attributes:
        points: (N, 3) of the link [m].
        others: (M, 3) of what carries it; may be none.
        frames: (3, 3) each, axes as rows: of the object, and of the link's faces where they differ.
        ways: (3,) unit directions that the link is long along, where they are none of these.
        diagonal: of the object [m].
    """

    points: FloatArray
    others: FloatArray
    frames: tuple[FloatArray, ...]
    ways: tuple[FloatArray, ...]
    diagonal: float


def shape_of(mesh: Mesh, link: BoolArray, carrier: BoolArray) -> Shape:
    """Sample a link and its carrier, which are (F,) faces of a mesh."""
    rng = np.random.default_rng(0)
    points = sample_surface(mesh.triangles[link], _POINTS, rng)
    if not len(points):
        points = mesh.triangles[link].reshape(-1, 3)
    others = sample_surface(mesh.triangles[carrier], _POINTS, rng)
    frames = (rotation(np.array([0.0, 0.0, yaw(mesh)])).T, *_own_frame(mesh, link, yaw(mesh)))
    return Shape(points, others, frames, _long_ways(points, frames), mesh.diagonal)


def turning_lines(shape: Shape) -> tuple[Line, ...]:
    """Lines along the axes of the link's boxes: through their edges and middles, circles, and its contact."""
    found: list[tuple[FloatArray, FloatArray, int, str]] = []
    for number, axes in enumerate(shape.frames):
        for k in range(3):
            found += [(axes[k], at, 3 * number + k, source) for at, source in _along(shape, axes, k)]
    found += _contact(shape, found)
    kept: list[tuple[FloatArray, FloatArray, int, str]] = []
    for line in found:
        if not any(_same(line, other, _NEAR * shape.diagonal) for other in kept):
            kept.append(line)
    kept = sorted(kept, key=lambda line: line[2])[: len(LETTERS)]
    return tuple(
        Line(LETTERS[i], _opening(shape, axis, at), at, group, source)
        for i, (axis, at, group, source) in enumerate(kept)
    )


def sliding_lines(shape: Shape) -> tuple[Line, ...]:
    """Both ways along each axis of the link's frames, and along what it is long along, from its middle."""
    low, high = shape.points.min(axis=0), shape.points.max(axis=0)
    axes = [*(axis for frame in shape.frames for axis in frame), *shape.ways]
    ways = [sign * axis for axis in axes for sign in (1.0, -1.0)]
    kept: list[FloatArray] = []
    for way in ways:
        if all(way @ other < _ALIKE for other in kept):
            kept.append(way)
    middle = (low + high) / 2
    return tuple(Line(LETTERS[i], way, middle, 0, "slide") for i, way in enumerate(kept[: len(LETTERS)]))


def contact_point(shape: Shape) -> FloatArray:
    """(3,) middle of where the link meets what carries it [m]; its own middle where it does not."""
    near = _touching(shape)
    points = shape.points[near] if near.any() else shape.points
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def _along(shape: Shape, axes: FloatArray, k: int) -> list[tuple[FloatArray, str]]:
    """Points that lines along an axis go through, the middle of the link's box first."""
    local = shape.points @ axes.T
    low, high = np.quantile(local, [_TRIM, 1 - _TRIM], axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    across = [(k + 1) % 3, (k + 2) % 3]
    found = []
    for spot in _SECTION:
        place = middle.copy()
        place[across] += np.array(spot) * half[across]
        found.append((place @ axes, "edge" if any(spot) else "center"))
    center, misfit = fitted_circle(local[:, across])
    if misfit < _ROUND:
        place = middle.copy()
        place[across] = center
        found.append((place @ axes, "circle"))
    return found


def _contact(
    shape: Shape, found: Sequence[tuple[FloatArray, FloatArray, int, str]]
) -> list[tuple[FloatArray, FloatArray, int, str]]:
    """Lines through where the link meets what carries it: along it if it is a strip, or through a spot."""
    near = _touching(shape)
    if near.sum() < 8:
        return []
    points = shape.points[near]
    if np.linalg.norm(np.ptp(points, axis=0)) < _SPOT * np.linalg.norm(np.ptp(shape.points, axis=0)):
        middle = contact_point(shape)
        return [(axis, middle, group, "contact") for group, axis in enumerate(shape.frames[0])]
    spread = points - points.mean(axis=0)
    values, vectors = np.linalg.eigh(spread.T @ spread)
    if values[1] > _STRIP**2 * values[2]:
        return []
    axis = units(vectors.T[-1:])[0]
    nearest = max(found, key=lambda line: abs(float(line[0] @ axis)))
    if abs(float(nearest[0] @ axis)) > _ALIKE:  # as good as parallel: then it is
        axis = nearest[0]
    return [(axis, points.mean(axis=0), nearest[2], "contact")]


def _touching(shape: Shape) -> BoolArray:
    """(N,) which points of the link are near what carries it."""
    from scipy.spatial import cKDTree

    if not len(shape.others):
        return np.zeros(len(shape.points), dtype=np.bool_)
    distance, _ = cKDTree(shape.others).query(shape.points)
    return np.asarray(distance < _TOUCH * shape.diagonal)


def _opening(shape: Shape, axis: FloatArray, origin: FloatArray) -> FloatArray:
    """The axis with the sense in which the link's middle leaves its carrier's; upward if in doubt."""
    middle = (shape.points.min(axis=0) + shape.points.max(axis=0)) / 2
    if len(shape.others):
        away = middle - (shape.others.min(axis=0) + shape.others.max(axis=0)) / 2
        first_step = float(np.cross(axis, middle - origin) @ away)
        if abs(first_step) > 1e-4 * shape.diagonal**2:
            return np.asarray(axis * np.sign(first_step))
    return axis if float(axis[np.abs(axis).argmax()]) > 0 else np.asarray(-axis)


def _own_frame(mesh: Mesh, link: BoolArray, turn: float) -> list[FloatArray]:
    """The axes that the link's faces look along, where these are not the object's."""
    normals = mesh.face_normals[link] * np.sqrt(mesh.face_areas[link])[:, None]
    values, vectors = np.linalg.eigh(normals.T @ normals)
    axes = vectors.T[::-1]
    whole = rotation(np.array([0.0, 0.0, turn])).T
    spread = values[::-1] / max(float(values.sum()), 1e-30)
    if spread[0] < spread[1] + 0.05 or spread[1] < spread[2] + 0.05:  # which way is which is not clear
        return []
    same = np.abs(axes @ whole.T).max(axis=1).min() > _ALIKE
    return [] if same else [axes]


def _long_ways(points: FloatArray, frames: tuple[FloatArray, ...]) -> tuple[FloatArray, ...]:
    """The direction that (N, 3) points are longest along, and those across, where no frame has them."""
    spread = points - points.mean(axis=0)
    values, vectors = np.linalg.eigh(spread.T @ spread)
    if min(values[1] - values[0], values[2] - values[1]) < _APART * values[2]:
        return ()  # about as long the one way as the other
    known = np.concatenate(frames)
    return tuple(axis for axis in vectors.T[::-1] if np.abs(known @ axis).max() < _ALIKE)


def _same(
    one: tuple[FloatArray, FloatArray, int, str], two: tuple[FloatArray, FloatArray, int, str], near: float
) -> bool:
    off = np.linalg.norm(np.cross(one[1] - two[1], two[0]))
    return bool(abs(float(one[0] @ two[0])) > _ALIKE and off < near)


def same_line(one: Line, two: Line, shape: Shape) -> bool:
    """Whether two lines of a link are one, and arrows also point the same way."""
    if "slide" in (one.source, two.source):
        return one.source == two.source and bool(float(one.axis @ two.axis) > _ALIKE)
    near = _NEAR * shape.diagonal
    return _same((one.axis, one.origin, 0, ""), (two.axis, two.origin, 0, ""), near)


def groups(lines: Sequence[Line]) -> dict[int, list[int]]:
    """Indices of the lines of each group."""
    numbers = sorted({line.group for line in lines})
    return {number: [i for i, line in enumerate(lines) if line.group == number] for number in numbers}
