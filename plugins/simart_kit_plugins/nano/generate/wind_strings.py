"""Stringed instruments, with wind instruments and drum kits."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import box, cylinder, rod, superquadric, torus, tube
from . import looks
from .assembling import Assembly, dial, disc, turning
from .category import Category
from .objects import Body, Look, hinge, slide
from .rigging import lying, plate
from .wind_strings_drums import drum_kit
from .wind_strings_parts import (
    FRONT,
    LEFT,
    RIGHT,
    UP,
    laid,
    peg,
    trumpet,
)
from .wind_strings_reeds import woodwind


def _figure(bottom: float, waist: float, top: float, long: float, cut: float = 0.0) -> FloatArray:
    """The outline of a guitar or a violin in x and y, from y = 0 up; `cut` takes its shoulders in."""
    high = np.array([0, 0.03, 0.12, 0.28, 0.42, 0.56, 0.68, 0.8, 0.92, 0.98, 1.0])
    wide = np.array([0.4, 0.72, 0.95, 1.0, 0.86, 0, 0.88, 1.0, 0.92 - cut, 0.6 - cut, 0.3]) * bottom
    wide[5:] = wide[5:] * top / bottom
    wide[5] = waist
    right = np.column_stack([wide, high * long])
    outline = np.concatenate([right, right[::-1] * [-1, 1]])
    for _ in range(2):  # corners are cut off twice
        ahead = np.roll(outline, -1, axis=0)
        outline = np.stack([0.75 * outline + 0.25 * ahead, 0.25 * outline + 0.75 * ahead], axis=1).reshape(
            -1, 2
        )
    return outline


def _strings(kit: Assembly, count: int, spread: float, low: float, top: float, off: float) -> None:
    """Thin strings up the front."""
    lines = [(k - (count - 1) / 2) * spread / count for k in range(count)]
    kit.fix([rod((x, off, low), (x, off, top), 0.0006, 4) for x in lines], Look("steel", (200, 200, 204)))


def _head(
    dice: Dice,
    kit: Assembly,
    foot: float,
    size: tuple[float, float],
    pegs: int,
    kind: str,
    wood: Look,
    metal: Look,
) -> None:
    """A flat head above a neck, from z = foot up, with pegs at both sides or all at one; or behind it."""
    wide, pitch = size
    behind = kind == "friction"
    one_side = not behind and dice.chance(0.35)
    rows = pegs if one_side else (pegs + 1) // 2
    high, peg_size = (rows + 0.6) * pitch, min(0.014, 0.5 * pitch)
    kit.fix([box((wide, 0.015, high), (0, 0.002, foot + high / 2))], wood)
    for k in range(pegs):
        side = -1 if one_side or k % 2 else 1
        z = foot + pitch * (0.7 + (k if one_side else k // 2))
        spot = np.array([side * (0.3 if behind else 0.5) * wide, 0.0095 if behind else 0.002, z])
        post = pointed(cylinder(0.003, 0.014, 8), Y) + [side * 0.3 * wide, -0.01, z]
        kit.fix([post, pointed(cylinder(0.0055, 0.003, 6), Y) + [side * 0.3 * wide, -0.0065, z]], metal)
        button = "round" if behind else kind
        peg(
            dice,
            kit,
            spot,
            -FRONT if behind else side * RIGHT,
            peg_size,
            button,
            wood if behind else metal,
            metal,
        )


def _electric(dice: Dice, kit: Assembly, wood: Look, metal: Look) -> None:
    """A flat body with pickups, knobs, a switch, a bridge and mostly a tremolo arm."""
    long, wide, thick = dice.between(0.38, 0.46), dice.between(0.15, 0.18), dice.between(0.034, 0.045)
    pegs, dark, white = dice.pick((4, 6, 6, 6)), Look("plastic", (26, 26, 28)), looks.plastic(dice)
    outline = _figure(
        wide, dice.between(0.6, 0.8) * wide, dice.between(0.75, 0.95) * wide, long, dice.between(0, 0.3)
    )
    kit.fix([turned([plate(outline, thick)], rotation(RIGHT, np.pi / 2))[0]], looks.painted_metal(dice))
    face, neck = -thick / 2, long + dice.between(0.36, 0.5)
    kit.fix([box((0.05, 0.022, neck - 0.7 * long), (0, face, (neck + 0.7 * long) / 2))], wood)
    kit.fix(
        [box((0.085, 0.008, 0.03), (0, face - 0.004, z * long)) for z in (0.42, 0.62)[: dice.whole(1, 2)]],
        dark,
    )
    _strings(kit, pegs, 0.045, 0.26 * long, neck + 0.03, face - 0.016)
    pin = np.array([0, face - 0.004, 0.3 * long])
    bridge = [box((0.085, 0.004, 0.05), (0, -0.002, -0.028)), lying(0.0025, 0.084, X, 8)]
    bridge += [box((0.009, 0.005, 0.02), (x, -0.0065, -0.03)) for x in np.linspace(-0.03, 0.03, pegs)]
    if dice.chance(0.7):
        part = kit.add("bridge", hinge(pin, LEFT, 0.05), [(moved(bridge, pin), metal)])
        root_ = pin + [0.036, -0.006, -0.012]
        bend = [(0, 0, 0), (0, -0.016, 0), (-0.004, -0.022, -0.02), (0.0, -0.026, -0.1), (0, -0.026, -0.12)]
        arm = [tube(bend, 0.0025, 8), rod((0, -0.026, -0.105), (0, -0.026, -0.135), 0.004, 8)]
        kit.fix([pointed(cylinder(0.005, 0.004, 10), Y) + root_ + [0, 0.003, 0]], metal, part)
        kit.add("arm", hinge(root_, FRONT, 1.2, -1.5), [(moved(arm, root_), metal)], part)
    else:
        kit.fix(moved(bridge, pin), metal)
    for k in range(dice.whole(1, 4)):
        spot = np.array([(0.5 + 0.14 * (k % 2)) * wide, face, (0.14 + 0.105 * k) * long])
        kit.add("knob", turning(dice, spot), [(moved(dial(dice, 0.011), spot), white)])
    if dice.chance(0.8):
        spot = np.array([-0.55 * wide, face - 0.003, 0.76 * long])
        kit.fix([disc(0.012, 0.003) + spot + [0, 0.003, 0]], dark)
        stick = turned(
            [rod((0, 0.002, 0), (0, -0.016, 0), 0.0025, 8), disc(0.004, 0.008) - [0, 0.012, 0]],
            rotation(RIGHT, 0.3),
        )
        kit.add("switch", hinge(spot, LEFT, 0.6), [(moved(stick, spot), metal)])
    _head(
        dice,
        kit,
        neck,
        (dice.between(0.06, 0.075), dice.between(0.03, 0.045)),
        pegs,
        dice.pick(("oval", "square")),
        wood,
        metal,
    )


def _hollow(dice: Dice, kit: Assembly, wood: Look, metal: Look) -> None:
    """A box with a hole, or a banjo's drum, below a neck: guitars, ukuleles, mandolins and banjos."""
    scale, body = dice.pick((0.55, 0.9, 1.0, 1.1)), looks.wood(dice)
    long, wide, thick = 0.48 * scale, 0.19 * scale, dice.between(0.08, 0.11) * scale
    face, neck = -thick / 2, long + dice.between(0.3, 0.4) * scale
    banjo = dice.chance(0.35)
    if banjo:
        long, wide, neck = 0.3 * scale, 0.15 * scale, neck - 0.1 * scale
        ring = [
            pointed(torus(wide, 0.008, 28, thick / 2), Y),
            pointed(cylinder(0.97 * wide, 0.7 * thick, 28), Y),
        ]
        kit.fix(moved(ring, (0, 0, wide)), body)
        hooks = [rod((wide + 0.012, 0, 0.45 * thick), (wide + 0.012, 0, -0.45 * thick), 0.0025, 5)]
        kit.fix(moved([pointed(p, Y) for p in around(hooks, dice.whole(8, 16))], (0, 0, wide)), metal)
    else:
        outline = _figure(wide, dice.between(0.6, 0.75) * wide, dice.between(0.7, 0.8) * wide, long, 0.1)
        kit.fix([turned([plate(outline, thick)], rotation(RIGHT, np.pi / 2))[0]], body)
        kit.fix([disc(0.27 * wide, 0.0015) + [0, face, 0.66 * long]], Look("wood", (30, 22, 18)))
    kit.fix([box((0.05, 0.024, neck - 0.85 * long), (0, face, (neck + 0.85 * long) / 2))], wood)
    pegs = 4 if scale < 0.7 or banjo else dice.pick((6, 6, 8))
    kit.fix([box((0.13 * scale, 0.012, 0.02), (0, face - 0.005, 0.3 * long))], wood)
    _strings(kit, pegs, 0.042, 0.3 * long, neck + 0.02, face - 0.0145)
    tip = Assembly()
    _head(
        dice,
        tip,
        0,
        (0.058, dice.between(0.03, 0.04)),
        pegs,
        dice.pick(("oval", "square", "friction")),
        wood,
        metal,
    )
    kit.graft(tip, (0, face, neck - 0.001), rotation(RIGHT, -0.15))
    if banjo:
        peg(dice, kit, (0.025, face + 0.001, 0.6 * neck + 0.4 * long), RIGHT, 0.011, "round", wood, metal)


def _violin(dice: Dice, kit: Assembly, wood: Look, metal: Look) -> None:
    """A violin, a viola or a cello: four friction pegs across a box below a scroll, and fine tuners."""
    scale = dice.pick((0.9, 1.0, 1.15, 2.1))
    long, wide, thick = 0.355 * scale, 0.104 * scale, 0.045 * scale
    outline = _figure(wide, 0.52 * wide, 0.82 * wide, long)
    kit.fix([turned([plate(outline, thick)], rotation(RIGHT, np.pi / 2))[0]], wood)
    face, neck, dark = -thick / 2, 0.5 * scale, Look("wood", (28, 24, 22))
    kit.fix([box((0.028 * scale, 0.02 * scale, neck - 0.9 * long), (0, face, (neck + 0.9 * long) / 2))], wood)
    kit.fix(
        [
            box(
                (0.03 * scale, 0.006 * scale, neck - 0.62 * long),
                (0, face - 0.014 * scale, (neck + 0.62 * long) / 2),
            )
        ],
        dark,
    )
    kit.fix([box((0.045 * scale, 0.003 * scale, 0.03 * scale), (0, face - 0.012 * scale, 0.48 * long))], wood)
    tail = np.array([0, face - 0.016 * scale, 0.2 * long])
    kit.fix([box((0.035 * scale, 0.005 * scale, 0.3 * long), tail)], dark)
    for k in range(dice.pick((0, 1, 4))):
        spot = tail + scale * np.array([(k - 1.5) * 0.008, -0.0025, 0.035])
        screw = [
            disc(0.0028 * scale, 0.006 * scale, 10),
            disc(0.0014 * scale, 0.008 * scale, 8) + [0, 0.005 * scale, 0],
        ]
        kit.add("knob", turning(dice, spot), [(moved(screw, spot - [0, 0.0012, 0]), metal)])
    for k in range(4):
        spot = np.array([(-1) ** k * 0.0125 * scale, face, neck + (0.016 + 0.017 * k) * scale])
        peg(dice, kit, spot, (-1) ** k * RIGHT, 0.013 * scale, "friction", dark, metal)
    kit.fix([box((0.024 * scale, 0.022 * scale, 0.085 * scale), (0, face, neck + 0.042 * scale))], wood)
    scroll = [pointed(cylinder(r * scale, w * scale, 16), X) for r, w in ((0.016, 0.022), (0.008, 0.036))]
    kit.fix(moved(scroll, (0, face, neck + 0.095 * scale)), wood)
    if scale > 2:
        pin = [rod((0, 0, 0.15), (0, 0, -0.06), 0.005, 8), rod((0, 0, -0.06), (0, 0, -0.075), 0.003, 8)]
        kit.fix([cylinder(0.014, 0.03, 12) - [0, 0, 0.01]], dark)
        kit.add("rod", slide(-UP, 0.18), [(pin, metal)])


def _harp(dice: Dice, kit: Assembly, wood: Look, metal: Look) -> None:
    """A harp: a column, a slanting box and a bent neck; pedals at its foot, levers at its neck, or both."""
    high = dice.between(0.6, 1.75)
    wide, thick, dark = high * dice.between(0.24, 0.32), 0.018 * high, looks.wood(dice)
    slant = high * np.array([(-0.13, 0, 0.1), (0, 0, 0.74)]) + [(0, 0, 0), (wide, 0, 0)]
    neck = np.array([(-wide, 0, high), (-0.45 * wide, 0, 0.95 * high), (0.2 * wide, 0, 0.79 * high)])
    neck = np.concatenate([neck, [(0.6 * wide, 0, 0.76 * high), (wide, 0, 0.78 * high)]])
    kit.fix([rod((-wide, 0, 0.02), (-wide, 0, high), 1.2 * thick, 12), tube(neck, 1.1 * thick, 10)], wood)
    kit.fix(
        [tube(slant, np.array([0.07, 0.025]) * high, 12), cylinder(1.7 * thick, thick, 16) + neck[0]], wood
    )
    deep, low, middle = 0.17 * high, 0.11 * high, -0.5 * wide - 0.05 * high
    kit.fix([box((wide + 0.06 * high, deep, low), (middle, 0, 0.5 * low + 0.01))], wood)
    spots = np.linspace(-0.75, 0.85, dice.whole(12, 24)) * wide
    feet = np.interp(spots, slant[:, 0], slant[:, 2])
    tops = np.interp(spots, neck[:, 0], neck[:, 2])
    kit.fix([rod((x, 0, a), (x, 0, b), 0.0008, 4) for x, a, b in zip(spots, feet, tops, strict=True)], metal)
    pins = np.column_stack([spots, 0 * spots - 1.1 * thick - 0.004, tops])
    kit.fix([pointed(cylinder(0.003, 0.02, 8), Y) + pin for pin in pins], metal)
    pedals = high > 1.2 and dice.chance(0.7)
    for pin in [] if pedals and dice.chance(0.6) else pins[:: 1 + len(pins) // 11]:
        spot = pin - [0, 0.003, 0.55 * thick + 0.01]
        kit.fix([box((0.01, 0.014, 0.014), spot + [0, 0.007, 0])], metal)
        leaf = [disc(0.0045, 0.004, 10) - [0, 0.001, 0], box((0.026, 0.003, 0.006), (0.012, -0.0035, 0))]
        kit.add("lever", hinge(spot, FRONT, 1.4), [(moved(leaf, spot), dark)])
    for k in range(7 if pedals else 0):
        side = -1 if k < 4 else 1
        pin = np.array(
            [middle + (k % 4 - 1.5 + 0.5 * (k > 3)) * 0.22 * wide, side * (0.5 * deep + 0.012), 0.06]
        )
        kit.fix([box((0.004, 0.024, 0.014), pin + [x, -side * 0.008, 0]) for x in (-0.014, 0.014)], metal)
        foot = [
            lying(0.006, 0.022, X, 10),
            lying(0.003, 0.034, X, 8),
            rod((0, 0, 0), (0, side * 0.08, 0), 0.004, 8),
        ]
        foot.append(superquadric((0.028, 0.045, 0.012), 0.5, 0.7, 6) + [0, side * 0.085, 0])
        kit.add("pedal", hinge(pin, (-side, 0, 0), 0.22, -0.22), [(moved(foot, pin), metal)])


def _guitar(dice: Dice) -> list[Body]:
    """A guitar, a banjo, a violin or a harp: standing or lying."""
    kit, metal = Assembly("body"), Look("steel", dice.pick(((196, 198, 202), (206, 174, 92), (40, 40, 44))))
    make = dice.weighted([(4, _electric), (4, _hollow), (3, _violin), (2, _harp)])
    make(dice, kit, looks.wood(dice), metal)
    if make is _harp:
        return laid(dice, kit, np.eye(3))
    return laid(dice, kit, np.eye(3), np.eye(3), rotation(RIGHT, -np.pi / 2), rotation((0, 1, 0), np.pi / 2))


CATEGORIES: tuple[Category, ...] = (
    Category("trumpet", trumpet),
    Category("woodwind", woodwind),
    Category("guitar", _guitar),
    Category("drum_kit", drum_kit),
)
