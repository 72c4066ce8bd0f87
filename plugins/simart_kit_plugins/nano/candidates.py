"""Lines and directions that a part may move about: from its boxes, round shapes, pins, and where it touches.

A candidate has no sense: limits on both sides of 0 say which way it goes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, units

SLIDE, EDGE, MIDDLE, CENTER, CIRCLE, CONTACT = range(6)
SOURCES = ("slide", "edge", "middle", "center", "circle", "contact")
# The middle share of points along each direction that a box holds: a handle must not move it.
_TRIM = 0.02
# Frames whose axes all lie closer to another's give nothing new [cosine].
_ALIKE = np.cos(np.deg2rad(4.0))
# Lines nearer than this are one [sides of the object].
_NEAR = 0.02
# Lines through a box's section: its corners, the middles of its sides, and its center.
_SPOTS = np.array(list(product((-1.0, 0.0, 1.0), repeat=2)))
_SPOT_SOURCE = np.array([EDGE, MIDDLE, EDGE, MIDDLE, CENTER, MIDDLE, EDGE, MIDDLE, EDGE])
# A piece is long if it is so many times as long as it is wide, flat if so many times as wide as it is thick.
_LONG, _FLAT = 2.0, 2.0
# What is flat is round if it is no longer than so many times its width.
_ROUND = 1.25
_Row = tuple[FloatArray, FloatArray, int, int, float]


@dataclass(frozen=True, eq=False)
class Candidates:
    """Joints that the shape suggests.

    Attributes:
        axis: (C, 3) unit.
        origin: (C, 3) a point on the line; for slides the middle of the part's box.
        source: (C,) index into `SOURCES`.
        frame: (C,) 0 of the object's own axes, 1 of the part's.
        misfit: (C,) of circles, how far the points are off it, as a share of its radius; else 0.
    """

    axis: FloatArray
    origin: FloatArray
    source: IntArray
    frame: IntArray
    misfit: FloatArray

    def __len__(self) -> int:
        return len(self.axis)


def candidates(
    points: FloatArray, normals: FloatArray, touching: FloatArray, pins: Sequence[FloatArray] = ()
) -> Candidates:
    """All candidates of a part.

    Args:
        points: (N, 3) of the part.
        normals: (N, 3) unit, either sense.
        touching: (M, 3) points of the part next to the rest of the object; may be none.
        pins: (K, 3) points each of pieces that it may turn about or slide along: its own, and small ones
            beside it.
    """
    rows: list[_Row] = []
    for number, axes in enumerate(_frames(points, normals)):
        rows += _of_box(points, axes, min(number, 1))
        rows += _of_circles(points, axes, min(number, 1))
    rows += _of_contact(touching)
    own = len(rows)
    for pin in pins:
        rows += _of_pin(pin)
    axis, origin, source, frame, misfit = zip(*rows, strict=True)
    found = Candidates(np.stack(axis), np.stack(origin), np.array(source), np.array(frame), np.array(misfit))
    return _without_doubles(found, own)


def alike(found: Candidates) -> BoolArray:
    """(C, C) whether two candidates are nearly one slide, or turns about nearly one line."""
    slide = found.source == SLIDE
    parallel = np.abs(found.axis @ found.axis.T) > _ALIKE
    apart = found.origin[None] - found.origin[:, None]
    off = np.linalg.norm(np.cross(apart, found.axis[:, None]), axis=2)
    both, neither = slide[:, None] & slide[None], ~slide[:, None] & ~slide[None]
    return np.asarray(parallel & (both | (neither & (off < _NEAR))))


def _frames(points: FloatArray, normals: FloatArray) -> list[FloatArray]:
    """(3, 3) axes as rows: the object's, then those of the part's normals and of its extent that differ."""
    found = [np.eye(3)]
    spread = points - points.mean(axis=0)
    for axes in (np.linalg.eigh(normals.T @ normals)[1].T[::-1], _extents(spread)):
        if all(np.abs(axes @ known.T).max(axis=1).min() < _ALIKE for known in found):
            found.append(axes)
    return found


def _extents(spread: FloatArray) -> FloatArray:
    """(3, 3) directions of (N, 3) points about 0, the longest first; of two others alike, one is level.

    A splayed leg folds about the level line across it, whichever way its round section is turned.
    """
    values, vectors = np.linalg.eigh(spread.T @ spread)
    axes = vectors.T[::-1]
    level = np.cross([0.0, 0.0, 1.0], axes[0])
    if values[1] > _ROUND**2 * values[0] or np.linalg.norm(level) < np.sqrt(1 - _ALIKE**2):
        return np.asarray(axes)
    level = units(level[None])[0]
    return np.stack([axes[0], level, np.cross(axes[0], level)])


def _of_box(points: FloatArray, axes: FloatArray, frame: int) -> list[_Row]:
    """Slides along the axes of a box, and lines along them through its section."""
    low, high = np.quantile(points @ axes.T, [_TRIM, 1 - _TRIM], axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    rows = [(axes[k], middle @ axes, SLIDE, frame, 0.0) for k in range(3)]
    for k in range(3):
        across = [(k + 1) % 3, (k + 2) % 3]
        for spot, source in zip(_SPOTS, _SPOT_SOURCE, strict=True):
            place = middle.copy()
            place[across] += spot * half[across]
            rows.append((axes[k], place @ axes, int(source), frame, 0.0))
    return rows


def _of_circles(points: FloatArray, axes: FloatArray, frame: int) -> list[_Row]:
    """Axes of circles fitted to the points as seen along each axis."""
    rows = []
    for k in range(3):
        flat = points @ axes[[(k + 1) % 3, (k + 2) % 3]].T
        center, misfit = fitted_circle(flat)
        place = center @ axes[[(k + 1) % 3, (k + 2) % 3]] + np.median(points @ axes[k]) * axes[k]
        rows.append((axes[k], place, CIRCLE, frame, misfit))
    return rows


def fitted_circle(flat: FloatArray) -> tuple[FloatArray, float]:
    """(2,) center of a circle about (N, 2) points, and how far these are off it as a share of its radius.

    By Kasa's linear least squares over the points of the outer half, which are the rim of a disc.
    """
    away = np.linalg.norm(flat - flat.mean(axis=0), axis=1)
    rim = flat[away >= np.median(away)]
    start = rim.mean(axis=0)
    shifted = rim - start
    matrix = np.column_stack([2 * shifted, np.ones(len(rim))])
    solution = np.linalg.lstsq(matrix, (shifted**2).sum(axis=1), rcond=None)[0]
    radius = float(np.sqrt(max(solution[2] + solution[:2] @ solution[:2], 1e-12)))
    if radius > 4 * max(float(away.max()), 1e-9):  # nearly a straight line
        return flat.mean(axis=0), 1.0
    off = np.linalg.norm(shifted - solution[:2], axis=1) - radius
    return solution[:2] + start, float(np.sqrt(np.mean(off**2))) / radius


def _of_contact(touching: FloatArray) -> list[_Row]:
    """Lines through the middle of where the part touches the rest: along it, and along the object's axes."""
    if len(touching) < 3:
        return []
    middle = touching.mean(axis=0)
    spread = touching - middle
    along = units(np.linalg.eigh(spread.T @ spread)[1].T[-1:])[0]
    return [(axis, middle, CONTACT, 0, 0.0) for axis in (along, *np.eye(3))]


def _of_pin(points: FloatArray) -> list[_Row]:
    """The axis of a long piece, as a line and a slide, or of a round flat one; of others nothing."""
    middle = points.mean(axis=0)
    spread = points - middle
    values, vectors = np.linalg.eigh(spread.T @ spread)
    thin, wide, long = np.sqrt(np.maximum(values, 1e-18))
    if long > _LONG * wide:
        return [(vectors[:, 2], middle, source, 1, 0.0) for source in (CONTACT, SLIDE)]
    if wide > _FLAT * thin and long < _ROUND * wide:
        return [(vectors[:, 0], middle, CONTACT, 1, 0.0)]
    return []


def _without_doubles(found: Candidates, own: int) -> Candidates:
    """The first `own`, and those of the others that say something else than all before them."""
    same, kept = alike(found), list(range(own))
    for row in range(own, len(found)):
        if not same[row, kept].any():
            kept.append(row)
    return Candidates(
        found.axis[kept], found.origin[kept], found.source[kept], found.frame[kept], found.misfit[kept]
    )
