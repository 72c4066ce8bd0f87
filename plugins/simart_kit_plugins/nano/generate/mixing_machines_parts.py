"""What kitchen machines share: cups, domes and hulls, blades and beaters, and panels to work them by."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.handles import knob
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import Y, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, prism, revolve, rod, sheet, tube
from . import looks
from .assembling import PAD, Assembly, dial, disc, press, turning
from .objects import Look, hinge, slide
from .rigging import lying

UP, DOWN, BACK, RIGHT, LEFT = (0, 0, 1), (0, 0, -1), (0, 1, 0), (1, 0, 0), (-1, 0, 0)
ON_TOP = rotation(LEFT, np.pi / 2)
"""Turns what stands off to -y so that it stands off upwards."""
DARK = Look("plastic", (32, 32, 35))


def ring(inner: float, outer: float, low: float, high: float, sides: int = 26) -> FloatArray:
    """A tube with a wall about z, between two heights."""
    line = [(inner, low), (outer, low), (outer, high), (inner, high), (inner, low)]
    return revolve(line, sides)


def cup(line: ArrayLike, wall: float, sides: int = 26) -> FloatArray:
    """An open container: its outer skin along radii and heights from the floor to the mouth."""
    outer = np.asarray(line, dtype=np.float64)
    inner = outer[::-1] - [wall, 0]
    floor = outer[0, 1] + wall
    inner[:, 1] = np.maximum(inner[:, 1], floor)
    return revolve(np.concatenate([[(0, outer[0, 1])], outer, inner, [(0, floor)]]), sides)


def dome(radius: float, low: float, high: float, bend: float = 1.0, sides: int = 26) -> FloatArray:
    """A solid cap about z with a flat bottom; `bend` below 1 makes it boxier."""
    angle = np.linspace(0, np.pi / 2, 7)
    line = np.column_stack([radius * np.cos(angle) ** bend, low + (high - low) * np.sin(angle) ** bend])
    return revolve(np.concatenate([[(0, low)], line]), sides)


def hull(stations: ArrayLike, bend: float = 0.7, sides: int = 20) -> FloatArray:
    """A skin along y through sections (y, middle height, half width, half height); closed at both ends."""
    steps = np.asarray(stations, dtype=np.float64)
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    flat = np.column_stack([np.cos(angle), np.sin(angle)])
    flat = np.sign(flat) * np.abs(flat) ** bend
    flat[-1] = flat[0]
    steps = np.concatenate([steps[:1] * [1, 1, 0, 0], steps, steps[-1:] * [1, 1, 0, 0]])
    points = np.zeros((len(steps), len(flat), 3))
    points[..., 0] = steps[:, None, 2] * flat[:, 0]
    points[..., 1] = steps[:, None, 0]
    points[..., 2] = steps[:, None, 1] + steps[:, None, 3] * flat[:, 1]
    falls = steps[-1, 0] < steps[0, 0]
    return sheet(points if falls else points[::-1])


def ear(x: float, low: float, high: float, reach: float, thick: float) -> Pieces:
    """A handle of a jug at x, between two heights, standing off to +x."""
    path = [(x - thick, 0, low), (x + 0.8 * reach, 0, low), (x + reach, 0, low + 0.2 * (high - low))]
    path += [(x + reach, 0, high - 0.15 * (high - low)), (x + 0.8 * reach, 0, high), (x - thick, 0, high)]
    return [tube(path, thick, 8) * [1, 1.4, 1]]


def cutter(dice: Dice, reach: float) -> Pieces:
    """Blades on a hub that stands on z = 0."""
    hub = min(0.012, 0.4 * reach)
    pieces = [cylinder(hub, 0.01, 12) + [0, 0, 0.005], cylinder(0.5 * hub, 0.016, 8) + [0, 0, 0.009]]
    for tilt, start in ((dice.between(0.2, 0.6), 0.0), (-dice.between(0.0, 0.2), np.pi / 2)):
        blade = [box((reach - 0.5 * hub, 0.3 * hub + 0.006, 0.0016), ((reach + 0.5 * hub) / 2, 0, 0))]
        blade = moved(turned(blade, rotation((0, -1, 0), tilt)), (0, 0, 0.008))
        pieces += around(blade, 2, start)
    return pieces


def beater(dice: Dice, radius: float, long: float) -> tuple[str, Pieces]:
    """A whisk, a flat beater or a dough hook from z = 0 down, and what it is called."""
    stem, thick = 0.25 * long, min(0.0022, 0.05 * radius)
    pieces = [rod((0, 0, 0), (0, 0, -stem), 0.006, 10), cylinder(0.009, 0.016, 12) - [0, 0, 0.012]]
    style = dice.unit()
    if style < 0.4:
        angle = np.linspace(0, 2 * np.pi, 17)
        drop = stem + (long - stem) * (1 - np.cos(angle)) / 2 - 0.004
        side = radius * np.sin(angle) * (1 - 0.25 * np.cos(angle)) / 1.1
        loop = [tube(np.column_stack([side, 0 * side, -drop]), thick, 5)]
        count = dice.whole(3, 6)
        return "whisk", pieces + [one for k in range(count) for one in _about(loop, k * np.pi / count)]
    if style < 0.75:
        half = np.array([(0, stem), (0.75, 1.2 * stem), (1, 2.0 * stem), (0.8, 0.85 * long), (0, long)])
        path = np.column_stack([half[:, 0] * radius, 0 * half[:, 0], -half[:, 1]])
        frame = [tube(path * [s, 1, 1], 2.5 * thick, 6) for s in (-1, 1)]
        levels = np.linspace(2.0 * stem, 0.85 * long, dice.whole(2, 4))
        bars = [box((1.8 * radius, 0.004, 0.007), (0, 0, -level)) for level in levels]
        return "beater", [
            *pieces,
            *frame,
            *bars,
            box((0.007, 0.004, long - stem), (0, 0, -(long + stem) / 2)),
        ]
    turn = np.linspace(0, dice.between(3.5, 6.0), 12)
    wide = radius * np.sin(np.linspace(0.1, 2.6, 12))
    drop = np.linspace(0.8 * stem, long - 0.006, 12)
    path = np.column_stack([wide * np.cos(turn), wide * np.sin(turn), -drop])
    return "hook", [*pieces, tube(path, min(0.006, 0.2 * radius), 7)]


def _about(pieces: Pieces, angle: float) -> Pieces:
    """Turned about z."""
    return turned(pieces, rotation(UP, angle))


def grip(dice: Dice, radius: float, high: float) -> Pieces:
    """A knob to hold on a lid, from z = 0 up; it does not turn by itself."""
    if dice.chance(0.3):
        posts = [cylinder(0.25 * radius, 0.7 * high, 8) + [s * radius, 0, 0.35 * high] for s in (-1, 1)]
        return [*posts, box((2.6 * radius, 0.7 * radius, 0.3 * high), (0, 0, 0.85 * high))]
    pieces = turned(knob(dice, radius), ON_TOP)
    top = max(float(piece[..., 2].max()) for piece in pieces)
    return [piece * [1, 1, high / top] for piece in pieces]


def keys(dice: Dice, kit: Assembly, spots: list[tuple[float, float]], size: float, look: Look) -> None:
    """Buttons at x and z before y = 0; all of one object alike."""
    shape = dice.pick((SQUARE, rounded(0.25), rounded(0.5, steps=4)))
    wide, thick = size * dice.between(0.9, 1.5), dice.between(0.002, 0.0045)
    for x, z in spots:
        key = pointed(prism(shape, (size, wide, thick)), Y) + [x, -thick / 2, z]
        kit.add("button", press(0.6 * thick), [([key], look)])


def panel(dice: Dice, wide: float, high: float) -> Assembly:
    """A plate before y = 0 with a knob, keys, a lever in a slot, or some of them; the screen is fixed."""
    kit, look = Assembly(), looks.plastic(dice) if dice.chance(0.6) else looks.metal(dice)
    plate = pointed(prism(rounded(0.2, wide / high), (high, wide, 0.004)), Y)
    kit.fix([plate + [0, 0.002, 0]], DARK if dice.chance(0.5) else looks.metal(dice))
    size = min(0.3 * high, 0.09 * wide, 0.014)
    style = dice.unit()
    if style < 0.45:
        radius = min(0.36 * high, 0.16 * wide, dice.between(0.014, 0.03))
        ticks = [box((0.001, PAD, 0.003), (0, 0, 1.2 * radius))]
        marks = [one for k in range(7) for one in turned(ticks, rotation(BACK, 0.6 * k - 1.8))]
        kit.fix(marks, Look("plastic", (235, 235, 235)))
        kit.fix([disc(1.06 * radius, 0.0015)], look)
        kit.add("knob", turning(dice, (0, 0, 0)), [(moved(dial(dice, radius), (0, -0.002, 0)), look)])
        sides = dice.pick((0, 0, 1, 2))
        spots = [
            (s * 0.34 * wide, z) for s in (-1, 1) for z in ((0.0,), (-0.2 * high, 0.2 * high))[sides // 2]
        ]
        keys(dice, kit, spots if sides else [], size, look)
    elif style < 0.75:
        kit.fix([box((0.3 * wide, 2 * PAD, 0.35 * high), (0, 0, 0.22 * high))], looks.glass(dice))
        count = dice.whole(2, 4)
        spots = [(x, -0.2 * high) for x in np.linspace(-0.36, 0.36, count) * wide]
        keys(dice, kit, spots, min(size, 0.25 * high), look)
        pads = [(s * 0.32 * wide, 0, 0.22 * high) for s in (-1, 1)]
        kit.fix(at(box((size, PAD, 0.7 * size)), pads) if dice.chance(0.4) else [], look)
    elif style < 0.9:
        reach = 0.28 * wide
        kit.fix([box((2.4 * reach, PAD, 0.003))], Look("plastic", (12, 12, 12)))
        cap = [box((0.005, 0.008, 0.003), (0, -0.005, 0)), box((0.012, 0.006, 0.35 * high), (0, -0.012, 0))]
        kit.add("slider", slide(RIGHT, reach, -reach), [(cap, look)])
    else:
        pin = np.array([0, -0.007, 0.1 * high])
        kit.fix([box((0.026, 0.003, 0.6 * high), (0, -0.0015, 0))], look)
        flap = [
            rod((-0.011, 0, 0), (0.011, 0, 0), 0.003, 8),
            box((0.018, 0.004, 0.4 * high), (0, 0, -0.2 * high)),
        ]
        flap.append(box((0.018, 0.01, 0.003), (0, -0.005, -0.38 * high)))
        kit.fix([box((0.004, 0.008, 0.006), pin + [s * 0.0132, 0.002, 0]) for s in (-1, 1)], look)
        kit.add("lever", hinge(pin, LEFT, dice.between(0.3, 0.5)), [(moved(flap, pin), look)])
    return kit


def clamp_levers(kit: Assembly, radius: float, high: float, level: float, look: Look, upper: float) -> None:
    """Levers on posts at both sides of a bowl, which hook over its lid and swing outwards."""
    for s in (-1, 1):
        pin = np.array([s * (1.02 * radius + 0.014), 0, level - 0.045])
        post = [
            box((0.012, 0.012, pin[2] - 0.6 * high), (pin[0], y, (pin[2] + 0.6 * high) / 2))
            for y in (-0.021, 0.021)
        ]
        post.append(box((0.04, 0.054, 0.03), (pin[0] - s * 0.012, 0, 0.6 * high)))
        kit.fix([*post, rod(pin - [0, 0.028, 0], pin + [0, 0.028, 0], 0.004, 10)], look)
        arm = [box((0.008, 0.026, 0.065), (0, 0, 0.024)), box((0.02, 0.026, 0.006), (-s * 0.008, 0, 0.0545))]
        arm.append(rod((0, -0.013, 0), (0, 0.013, 0), 0.008, 12))
        kit.add("lever", hinge(pin, (0, s, 0), upper), [(moved(arm, pin), look)])


def rear_hinge(kit: Assembly, rim: float, level: float, look: Look) -> tuple[FloatArray, Pieces]:
    """Two arms behind a round mouth, for a lid at a level; gives the pin and the lid's knuckles."""
    pin = np.array([0, rim + 0.009, level])
    low, high = [-0.07 * rim, 0.79 * rim, level - 0.0115], [0.07 * rim, pin[1] + 0.003, level - 0.0035]
    sides = [(s * 0.66 * rim, 0, 0) for s in (-1, 1)]
    kit.fix(at(between(low, high), sides) + at(lying(0.0045, 0.14 * rim) + pin, sides), look)
    low, high = [-0.05 * rim, 0.84 * rim, level + 0.0032], [0.05 * rim, pin[1] + 0.002, level + 0.0075]
    sides = [(s * 0.48 * rim, 0, 0) for s in (-1, 1)]
    return pin, at(between(low, high), sides) + at(lying(0.0042, 0.1 * rim) + pin, sides)
