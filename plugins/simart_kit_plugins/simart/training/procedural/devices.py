"""Small devices: game controllers, keyboards, switches, remotes, fans, valves."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.handles import knob
from ....shapes.outlines import ngon, rounded
from ....shapes.placing import Y, around, at, moved, pointed, rotation, turned
from ....shapes.primitives import (
    Pieces,
    box,
    boxes,
    cylinder,
    loft,
    prism,
    revolve,
    rod,
    sheet,
    superquadric,
    torus,
)

_STICK = np.array([[0, 0], [0.004, 0], [0.004, 0.008], [0.009, 0.01], [0.008, 0.013], [0, 0.012]])


def device(dice: Dice) -> list[Pieces]:
    """A body first, then what is pressed, turned or spun."""
    return dice.weighted(
        [(3, _controller), (2, _keyboard), (3, _switch), (3, _fan), (2, _valve), (2, _panel)]
    )(dice)


def keys(dice: Dice, width: float, depth: float, rows: int, columns: int, rise: float) -> Pieces:
    """Caps in a grid on z = 0, the last row with a long one."""
    pitch_x, pitch_y = width / columns, depth / rows
    size = (pitch_x * 0.85, pitch_y * 0.85, rise)
    x = (np.arange(columns) + 0.5) * pitch_x - width / 2
    y = (np.arange(rows) + 0.5) * pitch_y - depth / 2
    low = x[np.abs(x) > 0.25 * width]
    places = [(a, b, rise / 2) for b in y[1:] for a in x] + [(a, y[0], rise / 2) for a in low]
    space = box((0.45 * width, size[1], rise), (0, y[0], rise / 2))
    return [boxes(size, places), space]


def _controller(dice: Dice) -> list[Pieces]:
    """Grips, sticks, buttons, a cross and triggers; lies on its back."""
    width, depth, high = 0.15, dice.between(0.06, 0.09), dice.between(0.03, 0.045)
    body: Pieces = [superquadric((width, depth, high), 0.6, 0.5, 8)]
    horn = superquadric((0.045, dice.between(0.07, 0.1), high * 0.9), 0.8, 0.9, 6)
    for side in (-1, 1):
        body += moved(turned([horn], rotation((0, 0, 1), side * 0.3)), (side * width * 0.4, -depth * 0.5, 0))
    top = high * 0.48
    parts = [body]
    for x, y in ((-0.045, 0.012), (0.022, -0.015)):
        tilt = rotation((dice.between(-1, 1), dice.between(-1, 1), 0.1), dice.between(0, 0.3))
        stick = revolve(_STICK, 10)
        parts.append(moved(turned([stick], tilt), (x, y, top)))
    button = cylinder(0.005, 0.006, 8)
    spots = [(0.045 + 0.011 * np.cos(a), 0.012 + 0.011 * np.sin(a), top) for a in np.arange(4) * np.pi / 2]
    parts += [at(button, spots)] if dice.chance(0.5) else [[button + np.array(spot)] for spot in spots]
    parts.append(
        [box((0.022, 0.007, 0.006), (-0.022, -0.015, top)), box((0.007, 0.022, 0.006), (-0.022, -0.015, top))]
    )
    if dice.chance(0.7):
        parts.append(
            at(
                superquadric((0.03, 0.02, 0.015), 0.5, 0.5, 5),
                [(s * 0.05, depth / 2, 0.005) for s in (-1, 1)],
            )
        )
    return parts


def _keyboard(dice: Dice) -> list[Pieces]:
    width, depth, high = dice.between(0.28, 0.45), dice.between(0.1, 0.16), dice.between(0.008, 0.025)
    rows, columns = dice.whole(3, 6), dice.whole(10, 17)
    caps = moved(
        keys(dice, width * 0.95, depth * 0.9, rows, columns, dice.between(0.004, 0.012)), (0, 0, high / 2)
    )
    body: Pieces = [prism(rounded(0.02, width / depth), (width, depth, high))]
    if dice.chance(0.5):
        caps, body = (turned(pieces, rotation((1, 0, 0), 0.1)) for pieces in (caps, body))
        body += at(box((0.02, 0.01, 0.02)), [(s * 0.4 * width, 0.4 * depth, -high) for s in (-1, 1)])
    return [body, caps]


def _switch(dice: Dice) -> list[Pieces]:
    """A wall plate with rockers, toggles, dials or sockets."""
    count = dice.whole(1, 3)
    step, height, thick = 0.05, dice.between(0.08, 0.12), dice.between(0.006, 0.02)
    width = step * count + 0.03
    body: Pieces = [box((width, thick, height), (0, thick / 2, 0))]
    if dice.chance(0.4):
        body.append(box((width * 0.85, 0.05, height * 0.8), (0, 0.025 + thick, 0)))
    style, parts = dice.unit(), [body]
    for k in range(count):
        spot = ((k + 0.5) * step - step * count / 2, 0, 0)
        tilt = rotation((1, 0, 0), dice.sign() * dice.between(0.05, 0.5))
        if style < 0.4:
            moving = turned([box((0.03, 0.012, 0.06))], rotation((1, 0, 0), dice.sign() * 0.12))
        elif style < 0.75:
            moving = turned([box((0.01, 0.035, 0.012), (0, -0.012, 0))], tilt)
            body.append(box((0.02, 0.006, 0.035), spot))
        else:
            moving = knob(dice, 0.02)
        parts.append(moved(moving, spot))
    screws = [(0, 0, s * 0.42 * height) for s in (-1, 1)]
    body += at(pointed(cylinder(0.004, 0.004, 6), Y), screws)
    return parts


def _fan(dice: Dice) -> list[Pieces]:
    """Blades and a cage on a stand, or a ceiling fan."""
    radius, count = dice.between(0.15, 0.4), dice.whole(3, 6)
    hub = pointed(cylinder(radius * 0.15, radius * 0.25, 12), Y)
    blades = turned(around([_blade(dice, radius)], count, dice.between(0, 2)), rotation((1, 0, 0), np.pi / 2))
    height = radius * dice.between(1.2, 4.0)
    motor = superquadric((radius * 0.4, radius * 0.6, radius * 0.4), 0.7, 1.0, 6) + [0, radius * 0.45, 0]
    post = rod((0, radius * 0.5, -height), (0, radius * 0.5, 0), radius * 0.07, 8)
    foot = revolve(np.array([[0, 0.08], [0.2, 0.08], [0.7, 0.03], [0.7, 0], [0, 0]]) * radius, 16)
    body = [motor, post, foot + [0, radius * 0.5, -height]]
    parts = [body, [hub, *blades]]
    if dice.chance(0.6):
        wire, deep = radius * 0.02, radius * 0.2
        rings = [
            pointed(torus(r * radius, wire, 16), Y) + [0, s * deep, 0] for r in (0.5, 1.08) for s in (-1, 1)
        ]
        path = [
            (0.15 * radius, -deep, 0),
            (1.08 * radius, -deep, 0),
            (1.08 * radius, deep, 0),
            (0.15 * radius, deep, 0),
        ]
        spokes = [
            piece @ rotation((1, 0, 0), np.pi / 2).T
            for piece in around([_wire(path, wire)], dice.whole(8, 14))
        ]
        parts.append(rings + spokes)
    if dice.chance(0.2):
        level = rotation((1, 0, 0), -np.pi / 2)
        return [turned(part, level) for part in parts[:2]]
    return parts


def _wire(path: Sequence[tuple[float, float, float]], radius: float) -> FloatArray:
    points = np.array(path)[:, [0, 2, 1]]
    pairs = pairwise(points)
    return np.concatenate([rod(a, b, radius, 3) for a, b in pairs])


def _blade(dice: Dice, radius: float) -> FloatArray:
    """A twisted sheet along x about z."""
    out, across = np.meshgrid(np.linspace(0.12, 0.98, 5), np.linspace(-1, 1, 4), indexing="ij")
    wide = dice.between(0.15, 0.35) * (0.4 + 0.6 * np.sin(out * np.pi * 0.8))
    points = np.stack([out, across * wide, across * wide * dice.between(0.2, 0.7)], axis=-1) * radius
    return (
        sheet(points)
        if dice.chance(0.6)
        else np.concatenate([sheet(points), sheet(points + [0, 0, 0.03 * radius])])
    )


def _valve(dice: Dice) -> list[Pieces]:
    """A pipe with flanges and a hand wheel or lever."""
    radius, long = dice.between(0.1, 0.2), dice.between(0.4, 0.6)
    pipe = pointed(revolve([[0, -long], [radius, -long], [radius, long], [0, long]], 14), 0)
    rim = pointed(cylinder(radius * 1.6, 0.05, 16), 0)
    neck = cylinder(radius * 0.5, 2.4 * radius, 10) + [0, 0, 1.2 * radius]
    body = [
        pipe,
        neck,
        *at(rim, [(s * long, 0, 0) for s in (-1, 1)]),
        superquadric((3 * radius,) * 3, 1, 1, 6),
    ]
    top, size = 2.5 * radius, radius * dice.between(1.2, 2.5)
    if dice.chance(0.6):
        spokes = around([rod((0, 0, 0), (size, 0, 0), size * 0.06)], dice.whole(3, 5))
        turn = [torus(size, size * dice.between(0.06, 0.12)), *spokes, cylinder(size * 0.2, size * 0.25, 8)]
    else:
        turn = turned(
            [rod((0, 0, 0), (2 * size, 0, 0.1 * size), size * 0.1)], rotation((0, 0, 1), dice.between(0, 6))
        )
    return [body, moved(turn, (0, 0, top))]


def _panel(dice: Dice) -> list[Pieces]:
    """A box with rows of knobs, sliders, screens or buttons: mixers, radios, thermostats, remotes."""
    width, depth, height = dice.between(0.1, 0.6), dice.between(0.03, 0.4), dice.between(0.1, 0.4)
    body: Pieces = [box((width, depth, height), (0, depth / 2, 0))]
    if dice.chance(0.4):
        body = [prism(rounded(0.08), (width, height, depth))[..., [0, 2, 1]] + [0, depth / 2, 0]]
    parts, rows = [body], dice.whole(1, 4)
    pitch = height / rows
    for row in range(rows):
        level, count = (row + 0.5) * pitch - height / 2, dice.whole(1, 6)
        xs = np.linspace(-0.5, 0.5, count + 2)[1:-1] * width
        size, style = 0.6 * min(pitch, width / count), dice.unit()
        if style < 0.35:
            one = knob(dice, size / 2)
        elif style < 0.7:
            one = [box((size, 0.03 * width, size * dice.between(0.3, 0.9)))]
        elif style < 0.85:
            one = [
                loft(ngon(10), [(size, size, 0), (size, size, size * 0.3), (0, 0, size * 0.3)])[
                    ..., [0, 2, 1]
                ]
                * [1, -1, 1]
            ]
        else:
            body.append(box((width * 0.8, 0.02 * width, 0.8 * pitch), (0, 0, level)))
            continue
        parts.append([piece for part in one for piece in at(part, [(x, 0, level) for x in xs])])
    return parts
