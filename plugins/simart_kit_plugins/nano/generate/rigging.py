"""Hanging moving bodies on a root one by one, and bars and plates to build them of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.legs import wheel
from ...shapes.placing import X, Y, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, sheet
from .objects import Body, Motion, Surface, root

RIGHT, LEFT = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
BACK, FRONT = (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)
UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
QUARTER = rotation(UP, np.pi / 2)


class Rig:
    """Bodies in the order in which they are added.

    Args:
        surfaces: of the root.
        label: of the root.
    """

    def __init__(self, *surfaces: Surface, label: str = "body") -> None:
        self._bodies = [replace(root(surfaces, label), name=label.replace(" ", "_"))]

    def add(self, label: str, motion: Motion, *surfaces: Surface, parent: int = 0, name: str = "") -> int:
        """Hangs a body on another; returns its number. Its name is its label's, numbered, by default."""
        stem = (name or label).replace(" ", "_")
        taken = {body.name for body in self._bodies}
        number, chosen = 2, stem
        while chosen in taken:
            number, chosen = number + 1, f"{stem}_{number}"
        self._bodies.append(Body(chosen, label, surfaces, parent, motion))
        return len(self._bodies) - 1

    def dress(self, number: int, *surfaces: Surface) -> None:
        """Gives a body more surfaces."""
        body = self._bodies[number]
        self._bodies[number] = replace(body, surfaces=(*body.surfaces, *surfaces))

    def bodies(self, turn: FloatArray | None = None, scale: float = 1.0) -> list[Body]:
        """All bodies, scaled, turned by a (3, 3) rotation and set down on z = 0."""
        matrix = np.eye(3) if turn is None else turn
        low = min(float((body.triangles @ matrix.T)[..., 2].min()) for body in self._bodies)
        return [body.placed(scale * matrix, np.array([0.0, 0.0, -scale * low])) for body in self._bodies]


def ribbon(path: ArrayLike, width: ArrayLike, thick: float, base: float = 0.0) -> FloatArray:
    """Flat bar along (K, 2) points of x and y, from z = base up; one width, or (K,) of them."""
    line = np.asarray(path, dtype=np.float64)
    along = np.gradient(line, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    half = np.broadcast_to(np.asarray(width, dtype=np.float64), len(line))[:, None] / 2
    aside = half * np.column_stack([-along[:, 1], along[:, 0]])
    rings = np.zeros((len(line), 5, 3))
    for corner, (side, level) in enumerate(((1, 0), (-1, 0), (-1, 1), (1, 1), (1, 0))):
        rings[:, corner, :2] = line + side * aside
        rings[:, corner, 2] = base + level * thick
    ends = [np.broadcast_to(rings[end, :4].mean(axis=0), (1, 5, 3)) for end in (0, -1)]
    return sheet(np.concatenate([ends[0], rings, ends[1]]))


def plate(corners: ArrayLike, thick: float) -> FloatArray:
    """Extruded outline of x and y, about z = 0; all corners must be in sight of their mean."""
    outline = np.asarray(corners, dtype=np.float64)
    middle = outline.mean(axis=0)
    half = thick / 2
    skin = loft(outline - middle, [(0, 0, -half), (1, 1, -half), (1, 1, half), (0, 0, half)])
    shift: FloatArray = np.append(middle, 0.0)
    return skin + shift


def profile(corners: ArrayLike, width: float) -> FloatArray:
    """Outline of y and z, extruded along x about 0."""
    return pointed(plate(corners, width), X)


def lying(radius: float, length: float, axis: int = X, sides: int = 14) -> FloatArray:
    """Cylinder along an axis, its middle at 0."""
    return pointed(cylinder(radius, length, sides), axis)


def axle_wheel(dice: Dice, radius: float) -> Pieces:
    """A wheel about the x axis through 0."""
    return turned(wheel(dice, radius), QUARTER)


def fork(radius: float, width: float) -> Pieces:
    """What holds a caster's wheel, from z = 0 down; see `caster_hub` for where the wheel belongs."""
    thick = 0.2 * radius
    x = width / 2 + 0.7 * thick
    reach = 1.35 * radius
    cheeks = boxes((thick, 0.7 * radius, reach), [(s * x, 0.25 * radius, -reach / 2) for s in (-1, 1)])
    stem = cylinder(0.15 * radius, 0.24 * radius, 8) - [0, 0, 0.12 * radius]
    return [cheeks, box((2 * x + thick, 0.9 * radius, thick), (0, 0.2 * radius, -thick / 2)), stem]


def caster_hub(radius: float) -> FloatArray:
    """(3,) middle of a caster's wheel of this radius, below 0."""
    return np.array([0.0, 0.35 * radius, -1.25 * radius])


def caster_wheel(radius: float, width: float) -> Pieces:
    """A wheel about the x axis through 0, with a hub."""
    return [lying(radius, width, X, 14), lying(0.3 * radius, 1.15 * width, X, 8)]


def wires(starts: FloatArray, ends: FloatArray, radius: float) -> FloatArray:
    """Square bars between (N, 3) points, all at once."""
    along = ends - starts
    aside = np.cross(along, np.eye(3)[np.abs(along).sum(axis=0).argmin()])
    aside /= np.maximum(np.linalg.norm(aside, axis=1, keepdims=True), 1e-12)
    other = np.cross(along, aside)
    other /= np.maximum(np.linalg.norm(other, axis=1, keepdims=True), 1e-12)
    frames = np.stack([along, radius * aside, radius * other], axis=1)
    bars = np.einsum("fci,nij->nfcj", box((1, 2, 2), (0.5, 0, 0)), frames) + starts[:, None, None]
    return np.asarray(bars, dtype=np.float64).reshape(-1, 3, 3)


def ball_knob(radius: float, sides: int = 12) -> FloatArray:
    """A ball about 0."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 7)
    stages = np.column_stack([np.cos(angle), np.cos(angle), np.sin(angle)]) * radius
    around = 2 * np.pi * np.arange(sides) / sides
    return loft(np.column_stack([np.cos(around), np.sin(around)]), stages)


def upright_ring(radius: float, thick: float, sides: int = 18) -> FloatArray:
    """Thin ring about y, of square section."""
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    return pointed(ribbon(radius * np.column_stack([np.cos(angle), np.sin(angle)]), thick, thick), Y)
