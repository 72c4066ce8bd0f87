"""Shopping trolleys and strollers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import moved, rotation, turned
from ...shapes.primitives import Pieces, box, rod, sheet, tube
from . import looks
from .carts import casters
from .category import Category
from .objects import Body, Look, hinge, spin, surface
from .rigging import (
    DOWN,
    LEFT,
    RIGHT,
    Rig,
    axle_wheel,
    ball_knob,
    lying,
    wires,
)


def _mesh(low: FloatArray, high: FloatArray, count: int, radius: float) -> Pieces:
    """Wires between two edges of (2, 3) points, and both edges."""
    share = np.linspace(0, 1, count)[:, None]
    starts, ends = low[0] + share * (low[1] - low[0]), high[0] + share * (high[1] - high[0])
    middles = 0.5 * (low + high)
    edges = wires(
        np.stack([low[0], high[0], middles[0]]), np.stack([low[1], high[1], middles[1]]), 1.3 * radius
    )
    return [wires(starts, ends, radius), edges]


def _shopping_trolley(dice: Dice) -> list[Body]:
    """The push bar is behind; the rear gate swings in, the child's seat folds out of it."""
    width, long, high = dice.between(0.42, 0.55), dice.between(0.65, 0.9), dice.between(0.35, 0.5)
    level, metal, thin = dice.between(0.45, 0.55), looks.metal(dice), 0.0035
    x, y = width / 2, long / 2
    narrow, rise = 0.8 * x, 0.12
    low = {
        (-1, -1): (-narrow * 0.9, -y, level + rise),
        (1, -1): (narrow * 0.9, -y, level + rise),
        (-1, 1): (-x * 0.9, y, level),
        (1, 1): (x * 0.9, y, level),
    }
    top = {
        (-1, -1): (-narrow, -y - 0.05, level + high),
        (1, -1): (narrow, -y - 0.05, level + high),
        (-1, 1): (-x, y + 0.02, level + high + 0.05),
        (1, 1): (x, y + 0.02, level + high + 0.05),
    }

    def edge(
        points: dict[tuple[int, int], tuple[float, float, float]], a: tuple[int, int], b: tuple[int, int]
    ) -> FloatArray:
        return np.array([points[a], points[b]])

    count = dice.whole(5, 8)
    pieces = _mesh(edge(low, (-1, -1), (1, -1)), edge(top, (-1, -1), (1, -1)), count, thin)
    for s in (-1, 1):
        pieces += _mesh(edge(low, (s, -1), (s, 1)), edge(top, (s, -1), (s, 1)), count + 3, thin)
    pieces += _mesh(edge(low, (-1, -1), (1, -1)), edge(low, (-1, 1), (1, 1)), count, thin)
    whole = Rig(surface(pieces + _trolley_frame(x, y, narrow, level, high), metal), label="basket")
    whole.dress(0, surface(_push_bar(x, y, level + high), looks.plastic(dice)))
    ends = edge(low, (-1, 1), (1, 1)), edge(top, (-1, 1), (1, 1))
    _gate(dice, whole, ends, count, metal)
    spots = np.array(
        [(s * narrow * 0.8, -y, 0.14) for s in (-1, 1)] + [(s * x * 0.85, y - 0.05, 0.15) for s in (-1, 1)]
    )
    casters(dice, whole, spots, 0.055, dice.pick((0, 2)))
    return whole.bodies()


def _trolley_frame(x: float, y: float, narrow: float, level: float, high: float) -> Pieces:
    """Two tubes from the basket's upper end down and forward over the wheels, and a bar between them."""
    tubes: Pieces = []
    for s in (-1, 1):
        upper = [(s * x * 0.9, y, level + high), (s * x * 0.9, y, level - 0.1)]
        lower = [(s * x * 0.9, y - 0.05, 0.16), (s * narrow * 0.8, -y, 0.14)]
        tubes.append(tube(np.array(upper + lower), 0.011))
    return [*tubes, rod((-x * 0.9, y - 0.05, 0.16), (x * 0.9, y - 0.05, 0.16), 0.01)]


def _push_bar(x: float, y: float, top: float) -> Pieces:
    bar = rod((-x, y + 0.06, top + 0.08), (x, y + 0.06, top + 0.08), 0.016, 8)
    return [bar, *(rod((s * x, y, top + 0.04), (s * x, y + 0.06, top + 0.08), 0.01) for s in (-1, 1))]


def _gate(dice: Dice, whole: Rig, ends: tuple[FloatArray, FloatArray], count: int, look: Look) -> None:
    """The rear gate of a trolley between two edges of (2, 3) points, with a child's seat."""
    (low, top), thin = ends, 0.0035
    width, high = float(np.ptp(top[:, 0])), float(top[0, 2] - low[0, 2])
    # Narrower than the sides where it swings to, and above the floor, which rises there.
    inner = [0.88, 1, 1]
    gate = _mesh(low * inner + [0, -0.012, 0.024], top * inner + [0, -0.012, -0.02], count, thin)
    swing = whole.add("rear gate", hinge(top[0] + [0, -0.012, -0.02], LEFT, 1.3), surface(gate, look))
    if dice.chance(0.7):
        pin = np.array([0, low[0, 1] - 0.03, low[0, 2] + 0.45 * high])
        flap = box((0.8 * width, 0.006, 0.3 * high), pin + [0, 0, 0.15 * high])
        whole.add("child seat", hinge(pin, RIGHT, 1.4), surface([flap], looks.plastic(dice)), parent=swing)


def _stroller(dice: Dice) -> list[Body]:
    level, metal = dice.between(0.42, 0.55), looks.metal(dice)
    cloth, x = looks.fabric(dice), dice.between(0.4, 0.52) / 2
    front, back = dice.between(0.06, 0.1), dice.between(0.09, 0.16)
    frame: Pieces = []
    for s in (-1, 1):
        frame.append(rod((s * x, -0.4, front * 1.9), (s * x, 0.15, level + 0.1), 0.012, 8))
        frame.append(rod((s * x, 0.35, back), (s * x, 0.05, level), 0.012, 8))
    frame += [
        rod((-x, 0.35, back), (x, 0.35, back), 0.009),
        rod((-x, -0.1, level * 0.72), (x, -0.1, level * 0.72), 0.009),
    ]
    whole = Rig(surface(frame, metal), label="frame")
    seat = box((2 * x - 0.05, 0.3, 0.04), (0, -0.03, level - 0.05))
    whole.dress(0, surface([seat], cloth))
    back_pin = (0, 0.12, level - 0.04)
    rest = moved(turned([box((2 * x - 0.06, 0.03, 0.5), (0, 0, 0.25))], rotation(LEFT, 0.35)), back_pin)
    whole.add(
        "backrest", hinge(back_pin, LEFT, dice.between(0.3, 0.8)), surface(rest, looks.darker(cloth, 0.85))
    )
    foot = box((2 * x - 0.06, 0.02, 0.2), (0, -0.19, level - 0.15))
    whole.add("leg rest", hinge((0, -0.19, level - 0.05), LEFT, 1.2), surface([foot], cloth))
    pin = np.array([0, 0.15, level + 0.1])
    push = [(-x, 0.15, level + 0.1), (-x, 0.4, level + 0.48), (x, 0.4, level + 0.48), (x, 0.15, level + 0.1)]
    bar = surface([tube(np.array(push), 0.013, 8)], looks.rubber(dice))
    whole.add("handle", hinge(pin, RIGHT, 1.4), bar)
    if dice.chance(0.75):
        _hood(dice, whole, x, level, cloth)
    if dice.chance(0.4):
        whole.dress(
            0,
            surface([rod((s * x, 0, level - 0.05), (s * x, 0, level + 0.16), 0.01) for s in (-1, 1)], metal),
        )
        bar_y = [
            (-x, 0.0, level + 0.16),
            (-x, -0.3, level + 0.16),
            (x, -0.3, level + 0.16),
            (x, -0.02, level + 0.16),
        ]
        whole.add(
            "bumper bar",
            hinge((-x, 0.0, level + 0.16), DOWN, 1.3),
            surface([tube(np.array(bar_y), 0.01)], metal),
        )
    _stroller_wheels(dice, whole, x, (front, back))
    return whole.bodies()


def _hood(dice: Dice, whole: Rig, x: float, level: float, cloth: Look) -> None:
    """A bent cover on ribs."""
    at_hood = np.array([0, 0.1, level + 0.3])
    a, t = np.meshgrid(np.linspace(-1.2, 0.5, 6), np.linspace(-1, 1, 2), indexing="ij")
    hood = np.stack([t * (x + 0.02), 0.32 * np.sin(a), 0.32 * np.cos(a)], axis=-1)
    ribs = [
        tube(
            np.column_stack(
                [
                    [-x - 0.02, -x - 0.02, x + 0.02, x + 0.02],
                    np.sin(c) * np.array([0, 0.32, 0.32, 0]),
                    np.cos(c) * np.array([0, 0.32, 0.32, 0]),
                ]
            ),
            0.006,
        )
        for c in (-1.2, -0.3, 0.5)
    ]
    whole.add(
        "hood",
        hinge(at_hood, LEFT, dice.between(0.6, 1.2), -0.3),
        surface(moved([sheet(hood), *ribs], at_hood), cloth),
    )


def _stroller_wheels(dice: Dice, whole: Rig, x: float, radii: tuple[float, float]) -> None:
    """Casters in front, one or two of them; larger fixed wheels behind."""
    front, back = radii
    single = dice.chance(0.25)
    spots = np.array([(s * x, -0.4, front * 1.9 + 0.35 * front) for s in (-1, 1)])
    if single:
        spots = spots[:1] * [0, 1, 1]
        whole.dress(
            0, surface([rod((-x, -0.4, front * 2.25), (x, -0.4, front * 2.25), 0.012)], looks.metal(dice))
        )
    casters(dice, whole, spots, front)
    form = axle_wheel(dice, back)
    half = max(float(np.abs(p[..., 0]).max()) for p in form)
    thin = min(1.0, 0.03 / half)
    for name, s in (("left_rear_wheel", -1), ("right_rear_wheel", 1)):
        hub = np.array([s * (x + 0.045), 0.35, back])
        parts = [p * [thin, 1, 1] for p in form] + [lying(0.2 * back, 0.06), ball_knob(0.012)]
        whole.add("wheel", spin(hub, RIGHT), surface(moved(parts, hub), looks.rubber(dice)), name=name)


CATEGORIES: tuple[Category, ...] = (
    Category("shopping_trolley", _shopping_trolley),
    Category("stroller", _stroller),
)
