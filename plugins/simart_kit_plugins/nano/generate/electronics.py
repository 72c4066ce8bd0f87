"""Things with keys, buttons and screens: laptops, phones, controllers, keyboards, mice."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Z, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, prism, revolve, superquadric, torus
from . import looks
from .assembling import PAD
from .category import Category
from .objects import Body, GeneratedObject, Look, Motion, ball, hinge, slide, spin, surface
from .posing import posed
from .rigging import DOWN, LEFT, RIGHT, UP, Rig, ball_knob, lying, plate

_STICK = np.array([[0, 0], [0.004, 0], [0.004, 0.008], [0.009, 0.01], [0.008, 0.013], [0, 0.012]])


def slab(dice: Dice, width: float, depth: float, thick: float) -> FloatArray:
    """A flat case about 0, its corners sharp or round."""
    if dice.chance(0.3):
        return box((width, depth, thick))
    return prism(rounded(dice.between(0.02, 0.12), width / depth), (width, depth, thick))


def grid(width: float, depth: float, rows: int, columns: int) -> FloatArray:
    """(rows columns, 2) middles of the cells of a rectangle about 0, from its front left."""
    x = ((np.arange(columns) + 0.5) / columns - 0.5) * width
    y = ((np.arange(rows) + 0.5) / rows - 0.5) * depth
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def press(depth: float, axis: tuple[float, float, float] = DOWN) -> Motion:
    """What a button does."""
    return slide(axis, max(depth, 0.0012))


def cap(dice: Dice, size: float, rise: float) -> FloatArray:
    """A round or square button that stands on z = 0."""
    style = dice.unit()
    if style < 0.4:
        return prism(ngon(12), (size, size, rise)) + [0, 0, rise / 2]
    if style < 0.75:
        return prism(rounded(0.2), (size, size, rise)) + [0, 0, rise / 2]
    return revolve(np.array([[0, 0], [0.5, 0], [0.48, 0.5], [0.25, 0.9], [0, 1]]) * [size, rise], 12)


def _keyboard_deck(dice: Dice, whole: Rig, area: tuple[float, float], at: FloatArray, look: Look) -> float:
    """Keys in an area about a point of the root, and how high they stand: all fixed, or a row movable."""
    width, depth = area
    rows, columns = dice.whole(4, 6), dice.whole(10, 15)
    pitch = np.array([width / columns, depth / rows])
    size = 0.86 * pitch
    spots = [at + [x, y, 0] for x, y in grid(width, depth, rows, columns)]
    if dice.chance(0.55):
        rise = dice.between(0.0012, 0.005)
        whole.dress(0, surface(_raised(dice, spots, pitch, columns, rise), look))
        return rise
    printed, key = (box((*size, high), (0, 0, high / 2)) for high in (PAD, 0.0024))
    first = dice.whole(0, rows - 1) * columns
    live = dice.whole(3, columns) if dice.chance(0.5) else 0
    still = [spot for k, spot in enumerate(spots) if not first <= k < first + live]
    whole.dress(0, surface([printed + spot for spot in still], look))
    for spot in spots[first : first + live]:
        whole.add("key", press(0.0013), surface([key + spot], look))
    return 0.0024 if live else PAD


def _raised(dice: Dice, spots: list[FloatArray], pitch: FloatArray, columns: int, rise: float) -> Pieces:
    """Keys that stay: flat, tapered or half sunk, in rows that begin further in or not, with a space bar."""
    share, style = dice.between(0.78, 0.95), dice.pick(("flat", "round", "low"))
    size, lag, space = share * pitch, dice.pick((0.0, 0.25)) * pitch[0], dice.whole(3, 6)
    pieces: Pieces = []
    for row in range(len(spots) // columns):
        start, end = row * columns, (row + 1) * columns
        x = np.array([spot[0] for spot in spots[start:end]])
        edges = np.append(x - pitch[0] / 2, x[-1] + pitch[0] / 2)
        edges[1:-1] += (row % 3 - 1) * lag
        if row == 0:
            first = (columns - space) // 2
            edges = np.delete(edges, np.arange(first + 1, first + space))
        for left, right in pairwise(edges):
            wide = right - left - (pitch[0] - size[0])
            if style == "round":
                key = superquadric((wide, size[1], 2 * rise), 0.3, 0.2, 4)
            else:
                key = box((wide, size[1], rise), (0, 0, rise / 2 if style == "flat" else 0.1 * rise))
            pieces.append(key + [(left + right) / 2, spots[start][1], spots[start][2]])
    return pieces


def _laptop(dice: Dice) -> list[Body]:
    width, depth = dice.between(0.26, 0.4), dice.between(0.18, 0.27)
    thick, lid = dice.between(0.01, 0.028), dice.between(0.005, 0.012)
    shell = looks.metal(dice) if dice.chance(0.6) else looks.plastic(dice)
    form = slab(dice, width, depth, 1.0)
    whole = Rig(surface([form * [1, 1, thick] + [0, 0, thick / 2]], shell), label="base")
    keys = looks.plastic(dice)
    area = (width * 0.9, depth * 0.45)
    rise = _keyboard_deck(dice, whole, area, np.array([0, 0.17 * depth, thick]), keys)
    pad = box((0.35 * width, 0.25 * depth, 0.0006), (0, -0.28 * depth, thick))
    whole.dress(0, surface([pad], looks.darker(shell)))
    gap, back = max(rise + 0.0008, 0.002), depth / 2
    pin = np.array([0, back - 0.003, thick + gap + dice.between(0, lid / 2)])
    panel = form * [1, 0.98, lid] + [0, -0.01 * depth, thick + gap + lid / 2]
    screen = box((width * 0.92, depth * 0.85, 0.0006), (0, 0, thick + gap - 0.0003))
    barrel, count = dice.between(0.003, 0.006), dice.whole(1, 2)
    length = (0.6 if count == 1 else 0.12) * width
    spots = [0.0] if count == 1 else [-0.34 * width, 0.34 * width]
    tubes = [lying(barrel, length, X, 10) + pin + [x, barrel, 0] for x in spots]
    pin = pin + [0, barrel, 0]
    parent = 0
    faces = (surface([panel], shell), surface([screen], looks.glass(dice)))
    opens = hinge(pin, LEFT, dice.pick((1.9, 2.3, 3.1)))
    if count == 1 and dice.chance(0.35):
        neck = surface([cylinder(0.012, 2 * barrel, 12) + pin, *tubes], looks.darker(shell))
        parent = whole.add("bracket", hinge(pin, UP, np.pi / 2, -np.pi / 2), neck)
        whole.add("screen", opens, *faces, parent=parent)
    elif dice.chance(0.5):
        whole.add("screen", opens, *faces, surface(tubes, looks.darker(shell)))
    else:
        whole.dress(0, surface(tubes, looks.darker(shell)))
        whole.add("screen", opens, *faces)
    bodies = whole.bodies()
    if dice.chance(0.4):
        return bodies
    # Most that people model stand open; the screen comes last.
    stand = [0.0] * (len(bodies) - 1) + [dice.between(1.4, 1.85)]
    return list(posed(GeneratedObject("", tuple(bodies)), stand).bodies)


def _flip_phone(dice: Dice) -> list[Body]:
    """Halves that fold or slide, with keys inside."""
    width, depth, thick = dice.between(0.045, 0.07), dice.between(0.08, 0.11), dice.between(0.008, 0.013)
    shell, glass = looks.plastic(dice), looks.glass(dice)
    form = slab(dice, width, depth, 1.0)
    whole = Rig(surface([form * [1, 1, thick] + [0, 0, thick / 2]], shell))
    rows, columns = dice.whole(3, 5), dice.whole(3, 4)
    moving, spots = dice.chance(0.6), grid(width * 0.85, depth * 0.55, rows, columns)
    rise = 0.0012 if moving else 0.0003
    key = slab(dice, width * 0.7 / columns, depth * 0.42 / rows, rise) + [0, 0, thick + rise / 2]
    for x, y in spots:
        one = surface([key + [x, y - 0.18 * depth, 0]], looks.darker(shell, 0.6))
        if moving:
            whole.add("key", press(rise), one)
        else:
            whole.dress(0, one)
    level = thick + 0.0025
    upper = [form * [1, 1, 0.8 * thick] + [0, 0, level + 0.4 * thick]]
    inner = surface([box((width * 0.8, depth * 0.6, 0.0006), (0, -0.05 * depth, level - 0.0003))], glass)
    outer = box((width * 0.5, depth * 0.3, 0.0006), (0, 0.1 * depth, level + 0.8 * thick))
    if dice.chance(0.7):
        radius = thick * dice.between(0.45, 0.7)
        pin = (0, depth / 2 + radius * 0.6, level - 0.001)
        upper.append(lying(radius, 0.5 * width, X, 12) + pin)
        ends = [lying(radius, 0.22 * width, X, 12) + pin + [s * 0.38 * width, 0, 0] for s in (-1, 1)]
        whole.dress(0, surface(ends, shell))
        moves, label = hinge(pin, LEFT, dice.between(2.4, 3.0)), "cover"
    else:
        moves, label = slide((0, 1, 0), dice.between(0.4, 0.55) * depth), "slider"
        outer = box((width * 0.86, depth * 0.7, 0.0006), (0, 0.05 * depth, level + 0.8 * thick))
    whole.add(label, moves, surface(upper, shell), inner, surface([outer], glass))
    return whole.bodies()


def _game_controller(dice: Dice) -> list[Body]:
    """Lies on its back, its face up, the triggers away from the viewer."""
    width, depth, high = dice.between(0.13, 0.17), dice.between(0.06, 0.09), dice.between(0.028, 0.042)
    shell, dark = looks.plastic(dice), looks.rubber(dice)
    top = high * 0.5
    if dice.chance(0.7):
        core: Pieces = [superquadric((width * 0.86, depth, high), 0.2, 0.4, 9)]
        horn = superquadric((0.045, dice.between(0.06, 0.1), high * 0.95), 0.6, 0.9, 7)
        for side in (-1, 1):
            lean = rotation(UP, side * dice.between(0.15, 0.4))
            core += moved(turned([horn], lean), (side * width * 0.4, -depth * 0.5, -0.002))
    else:
        core = [prism(rounded(dice.between(0.1, 0.4), width / depth), (width, depth, high))]
    whole = Rig(surface(core, shell))
    left, right = -0.27 * width, 0.27 * width
    _buttons(dice, whole, np.array([right, 0.14 * depth, top]), depth)
    _cross(dice, whole, np.array([left, 0.14 * depth, top]), dark)
    for x in (-0.13 * width, 0.13 * width)[: dice.whole(0, 2)]:
        _thumbstick(dice, whole, np.array([x, -0.22 * depth, top - 0.001]), dark)
    for x in (-0.06, 0.06)[: dice.whole(0, 2)]:
        small = prism(ngon(10), (0.008, 0.005, 0.003)) + [x * width, 0.25 * depth, top + 0.001]
        whole.add("button", press(0.0015), surface([small], dark))
    _triggers(dice, whole, (width, depth, high), looks.darker(shell))
    return whole.bodies()


def _buttons(dice: Dice, whole: Rig, middle: FloatArray, depth: float) -> None:
    count, reach = dice.pick((2, 4, 4, 6)), 0.17 * depth
    size, rise = dice.between(0.009, 0.012), dice.between(0.003, 0.005)
    form = cap(dice, size, rise)
    if count == 6:
        spots = grid(3 * size * 1.25, 2 * size * 1.3, 2, 3)
    else:
        angle = dice.pick((0.0, 0.35)) + 2 * np.pi * np.arange(count) / count
        spots = reach * np.column_stack([np.cos(angle), np.sin(angle)])
    for x, y in spots:
        whole.add("button", press(0.6 * rise), surface([form + middle + [x, y, 0]], looks.plastic(dice)))


def _cross(dice: Dice, whole: Rig, middle: FloatArray, look: Look) -> None:
    """A direction pad: one that tilts, or four keys."""
    size, rise = dice.between(0.02, 0.026), 0.004
    third = size / 3
    level = [0, 0, rise / 2]
    if dice.chance(0.6):
        pieces = [box((size, third, rise)) + middle + level, box((third, size, rise)) + middle + level]
        if dice.chance(0.4):
            pieces.append(cylinder(size * 0.55, 0.5 * rise, 16) + middle)
        whole.add("direction pad", ball(middle), surface(pieces, look))
        return
    for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        key = box((third, third, rise)) + middle + level + [x * third * 1.15, y * third * 1.15, 0]
        whole.add("direction key", press(0.5 * rise), surface([key], look))


def _thumbstick(dice: Dice, whole: Rig, at: FloatArray, look: Look) -> None:
    """A stick that tilts every way, or first one way and then the other."""
    scale = dice.between(0.8, 1.2)
    stick = [revolve(_STICK * scale, 14) + at]
    whole.dress(0, surface([torus(0.011 * scale, 0.0015, 16) + at], looks.darker(look)))
    if dice.chance(0.5):
        whole.add("thumbstick", ball(at), surface(stick, look))
        return
    # Each of the two turns about the pin that it has.
    pins = [lying(0.001 * scale, 0.019 * scale, axis, 8) + at + [0, 0, 0.001 * scale] for axis in (0, 1)]
    collar = surface([cylinder(0.007 * scale, 0.003, 12) + at, pins[0]], looks.darker(look))
    first = whole.add("stick collar", hinge(at, RIGHT, 0.4, -0.4), collar)
    whole.add("thumbstick", hinge(at, (0, 1, 0), 0.4, -0.4), surface([*stick, pins[1]], look), parent=first)


def _triggers(dice: Dice, whole: Rig, size: tuple[float, float, float], look: Look) -> None:
    """At the back: keys that are pressed, and below them triggers that turn."""
    width, depth, high = size
    long, keys = 0.2 * width, dice.chance(0.6)
    for name, side in (("left", -1), ("right", 1)):
        x, y = side * 0.28 * width, depth / 2
        if keys:
            bar = superquadric((long, 0.014, 0.3 * high), 0.4, 0.5, 6) + [x, y, 0.28 * high]
            whole.add(
                "shoulder button", press(0.002, (0, -1, 0)), surface([bar], look), name=f"{name}_shoulder"
            )
        if not keys or dice.chance(0.6):
            pin = np.array([x, y - 0.004, 0.05 * high])
            arc = np.array(
                [[0, 0], [0.016, -0.002], [0.022, -0.4 * high], [0.017, -0.6 * high], [0.002, -0.5 * high]]
            )
            paddle = pointed(plate(arc, long * 0.8), X) + pin
            whole.add("trigger", hinge(pin, LEFT, 0.35), surface([paddle], look), name=f"{name}_trigger")


def _remote_control(dice: Dice) -> list[Body]:
    width, depth, thick = dice.between(0.035, 0.06), dice.between(0.1, 0.22), dice.between(0.012, 0.025)
    shell = looks.plastic(dice)
    whole = Rig(surface([slab(dice, width, depth, thick) + [0, 0, thick / 2]], shell))
    rows, columns = dice.pick((dice.whole(2, 5), dice.whole(5, 12))), dice.whole(2, 4)
    share = dice.between(0.35, 0.6)
    spots = grid(width * 0.85, depth * share, rows, columns)
    size, rise = min(0.6 * width / columns, 0.6 * depth * share / rows), dice.between(0.0015, 0.003)
    form, rubber = cap(dice, size, rise), looks.rubber(dice)
    for number, (x, y) in enumerate(spots):
        look = looks.plastic(dice) if number == 0 else rubber
        whole.add("button", press(0.8 * rise), surface([form + [x, y - 0.1 * depth, thick]], look))
    if dice.chance(0.5):
        round_key = cylinder(width * 0.3, rise, 18) + [0, 0.34 * depth, thick + rise / 2]
        whole.add("direction pad", ball((0, 0.34 * depth, thick)), surface([round_key], rubber))
    else:
        whole.dress(
            0, surface([box((width * 0.7, 0.1 * depth, 0.001), (0, 0.37 * depth, thick))], looks.glass(dice))
        )
    if dice.chance(0.4):
        cover = slab(dice, width * 0.8, depth * 0.4, 0.002) + [0, -0.25 * depth, -0.0015]
        if dice.chance(0.6):  # with ribs to push it by
            ribs = [
                box((0.4 * width, 0.002, 0.001), (0, (0.01 * k - 0.25) * depth, -0.003)) for k in (-2, 0, 2)
            ]
            motion, more = slide((0, -1, 0), 0.3 * depth), ribs
        else:
            pin = np.array([0, -0.45 * depth, -0.001])
            motion, more = hinge(pin, LEFT, 1.5), [lying(0.001, 0.5 * width, X, 8) + pin]
        whole.add("battery cover", motion, surface([cover, *more], looks.darker(shell)))
    return whole.bodies()


def _keyboard(dice: Dice) -> list[Body]:
    """A computer keyboard or a number pad."""
    small = dice.chance(0.35)
    rows, columns = (dice.whole(4, 5), dice.whole(3, 4)) if small else (dice.whole(4, 6), dice.whole(12, 17))
    pitch, high = dice.between(0.017, 0.021), dice.between(0.01, 0.025)
    width, depth = columns * pitch, rows * pitch
    shell, caps = looks.plastic(dice) if dice.chance(0.6) else looks.metal(dice), looks.plastic(dice)
    whole = Rig(surface([slab(dice, width + 0.015, depth + 0.015, high) + [0, 0, high / 2]], shell))
    rise = dice.between(0.003, 0.009)
    key = superquadric((0.88 * pitch, 0.88 * pitch, 2 * rise), 0.3, 0.2, 4) + [0, 0, high]
    spots = grid(width, depth, rows, columns)
    space = 0 if small else dice.whole(4, 6)
    for number, (x, y) in enumerate(spots):
        if number >= columns or abs(x) >= space / 2 * pitch:
            whole.add("key", press(0.5 * rise), surface([key + [x, y, 0]], caps))
    if space:
        bar = box(((space - 0.4) * pitch, 0.86 * pitch, rise), (0, spots[0][1], high + rise / 2))
        whole.add("space bar", press(0.5 * rise), surface([bar], caps))
    if dice.chance(0.5):
        for name, side in (("left_foot", -1), ("right_foot", 1)):
            pin = (side * 0.38 * width, depth / 2 - 0.004, -0.002)
            foot = box((0.02, 0.018, 0.003), (pin[0], pin[1] - 0.009, -0.002))
            whole.add("foot", hinge(pin, RIGHT, 1.5), surface([foot], caps), name=name)
    return whole.bodies(rotation(RIGHT, dice.pick((0.0, 0.06, 0.12))))


def _mouse(dice: Dice) -> list[Body]:
    width, depth, high = dice.between(0.05, 0.07), dice.between(0.09, 0.12), dice.between(0.028, 0.042)
    shell = looks.plastic(dice)
    hump = superquadric((width, depth, 2 * high), dice.between(0.5, 0.8), dice.between(0.6, 0.9), 12)
    low = np.maximum(hump, [-np.inf, -np.inf, 0])
    seam = dice.between(-0.02, 0.12) * depth
    front = np.minimum(low, [np.inf, -seam, np.inf])
    whole = Rig(surface([np.maximum(low, [-np.inf, -seam - 0.001, -np.inf])], shell))
    # The keys are the shell's own front half, split in the middle; below them the case is lower.
    core = np.minimum(low, [np.inf, 0, np.inf]) * [0.93, 0.95, 0.86]
    whole.dress(0, surface([core], looks.darker(shell)))
    gap, lifted = 0.003, front * [1, 1, 1]
    lifted[..., 2] = np.maximum(lifted[..., 2], 0.3 * high)
    for name, side in (("left_button", -1), ("right_button", 1)):
        half = np.maximum(lifted * [side, 1, 1], [gap, -np.inf, -np.inf]) * [side, 1, 1]
        pin = (0, -seam, 0.9 * high)
        whole.add("button", hinge(pin, RIGHT, 0.06), surface([half], looks.darker(shell, 0.9)), name=name)
    spot = np.array([0, -0.3 * depth, 0.82 * high])
    whole.add("wheel", spin(spot, RIGHT), surface([lying(0.011, 0.006, X, 16) + spot], looks.rubber(dice)))
    for k in range(dice.whole(0, 2)):
        key = box((0.003, 0.015, 0.006), (-0.49 * width, -seam + 0.012 + 0.018 * k, 0.55 * high))
        whole.add("side button", press(0.0015, RIGHT), surface([key], looks.rubber(dice)))
    return whole.bodies()


def _joystick(dice: Dice) -> list[Body]:
    """A flight stick or arcade stick with buttons and a throttle."""
    width, depth, high = dice.between(0.16, 0.34), dice.between(0.14, 0.22), dice.between(0.03, 0.06)
    shell, dark = looks.plastic(dice), looks.rubber(dice)
    whole = Rig(surface([slab(dice, width, depth, high) + [0, 0, high / 2]], shell))
    at = np.array([-0.22 * width, 0, high])
    tall = dice.between(0.06, 0.16)
    grip = [cylinder(0.012, 0.01, 14) + at, lying(0.005, tall, Z, 10) + at + [0, 0, tall / 2]]
    if dice.chance(0.5):
        grip.append(ball_knob(dice.between(0.014, 0.02)) + at + [0, 0, tall])
    else:
        grip.append(superquadric((0.035, 0.045, 0.8 * tall), 0.4, 0.7, 8) + at + [0, 0, 0.7 * tall])
    if dice.chance(0.5):
        stick = whole.add("stick", ball(at), surface(grip, dark))
    else:
        ring = surface([torus(0.018, 0.004, 16) + at], dark)
        first = whole.add("stick ring", hinge(at, RIGHT, 0.35, -0.35), ring)
        stick = whole.add("stick", hinge(at, (0, 1, 0), 0.35, -0.35), surface(grip, dark), parent=first)
    if dice.chance(0.5):
        key = cap(dice, 0.012, 0.008) + at + [0, 0, 1.08 * tall]
        whole.add("fire button", press(0.003), surface([key], looks.plastic(dice)), parent=stick)
    form = cap(dice, dice.between(0.02, 0.03), 0.008)
    for x, y in grid(0.34 * width, 0.6 * depth, dice.whole(1, 2), dice.whole(1, 4)):
        spot = np.array([0.18 * width + x, y, high])
        whole.add("button", press(0.004), surface([form + spot], looks.plastic(dice)))
    if dice.chance(0.4):
        x = 0.46 * width
        whole.dress(0, surface([boxes((0.003, 0.5 * depth, 0.004), [(x, 0, high)])], dark))
        lever = [
            box((0.004, 0.006, 0.03), (x, -0.2 * depth, high + 0.015)),
            box((0.016, 0.014, 0.012), (x, -0.2 * depth, high + 0.03)),
        ]
        whole.add("throttle", slide((0, 1, 0), 0.4 * depth), surface(lever, dark))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("laptop", _laptop),
    Category("flip_phone", _flip_phone),
    Category("game_controller", _game_controller),
    Category("remote_control", _remote_control),
    Category("keyboard", _keyboard),
    Category("mouse", _mouse),
    Category("joystick", _joystick),
)
