"""What clamps, cuts and unfolds: clamps, vises, knives, ladders, boards."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, Y, around, moved, pointed, rotation
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, prism, rod, torus
from . import looks
from .category import Category
from .objects import Body, ball, hinge, slide, spin, surface
from .rigging import BACK, DOWN, FRONT, LEFT, RIGHT, UP, Rig, ball_knob, lying, plate, ribbon


def _clamp(dice: Dice) -> list[Body]:
    """A bow or a bar with a sliding jaw; its screw turns, its shoe tilts."""
    tall, deep, thick = dice.between(0.1, 0.35), dice.between(0.05, 0.14), dice.between(0.008, 0.016)
    paint, metal, bar = looks.painted_metal(dice), looks.metal(dice), dice.chance(0.5)
    low, high = -tall / 2, tall / 2
    anvil = cylinder(0.014, 0.012, 12) + [0, 0, low + thick]
    if bar:
        stem = box((0.7 * thick, 1.6 * thick, tall * 1.5), (deep, 0, 0.2 * tall))
        foot = box((deep + thick, thick, 1.4 * thick), (deep / 2, 0, low))
        whole = Rig(surface([stem, foot, anvil], metal), label="bar")
        jaw = [
            box((deep + 2 * thick, thick, 1.4 * thick), (deep / 2, 0, high)),
            box((3 * thick, 2.2 * thick, 2.4 * thick), (deep, 0, high)),
        ]
        parent = whole.add("jaw", slide(UP, 0.35 * tall, -0.3 * tall), surface(jaw, paint))
    else:
        path = np.array([[0, low], [deep, low], [deep, high], [0, high]])
        bow = pointed(ribbon(path[:, ::-1], 1.4 * thick, thick, -thick / 2), Y)
        whole, parent = (
            Rig(
                surface([bow, anvil, cylinder(1.1 * thick, 2 * thick, 12) + [0, 0, high]], paint),
                label="frame",
            ),
            0,
        )
    reach = dice.between(0.3, 0.7) * tall
    tip, top = np.array([0, 0, high - reach]), np.array([0, 0, high + 0.3 * tall])
    screw = whole.add(
        "screw",
        spin(top, UP),
        surface([rod(tip, top, 0.45 * thick, 10), cylinder(0.8 * thick, 1.6 * thick, 10) + top], metal),
        parent=parent,
    )
    whole.add(
        "shoe",
        ball(tip),
        surface([cylinder(0.015, 0.008, 14) + tip, ball_knob(0.5 * thick) + tip], metal),
        parent=screw,
    )
    half = 0.026 + 1.2 * thick  # the knobs stop at the screw's head
    grip = [
        lying(0.25 * thick, 2 * half, X, 8) + top,
        *(ball_knob(0.4 * thick) + top + [s * half, 0, 0] for s in (-1, 1)),
    ]
    whole.add("tommy bar", slide(RIGHT, 0.025, -0.025), surface(grip, metal), parent=screw)
    return whole.bodies()


def _vise(dice: Dice) -> list[Body]:
    wide, long, high = dice.between(0.08, 0.16), dice.between(0.14, 0.26), dice.between(0.1, 0.18)
    paint, metal = looks.painted_metal(dice), looks.metal(dice)
    foot = cylinder(0.6 * wide, 0.025, 18) + [0, 0.1 * long, 0.0125]
    body: Pieces = [
        box((0.7 * wide, 0.5 * long, 0.55 * high), (0, 0.2 * long, 0.027 + 0.275 * high)),
        box((wide, 0.16 * long, 0.42 * high), (0, 0.07 * long, 0.03 + 0.75 * high)),
    ]
    body.append(box((0.6 * wide, 0.2 * long, 0.08 * high), (0, 0.28 * long, 0.03 + 0.58 * high)))
    whole = Rig(surface([foot], paint), label="base")
    parent = whole.add("body", hinge((0, 0.1 * long, 0.026), UP, 3.0, -3.0), surface(body, paint))
    gap = dice.between(0.0, 0.15) * long
    face = -0.012 * long - gap
    jaw = [
        box((wide, 0.16 * long, 0.42 * high), (0, face - 0.08 * long, 0.03 + 0.75 * high)),
        box((0.45 * wide, 0.3 * long, 0.3 * high), (0, face - 0.12 * long, 0.03 + 0.36 * high)),
    ]
    plates = box((0.95 * wide, 0.006, 0.2 * high), (0, face + 0.002, 0.03 + 0.85 * high))
    moving = whole.add(
        "jaw",
        slide(FRONT, 0.5 * long, -0.9 * gap),
        surface(jaw, paint),
        surface([plates], metal),
        parent=parent,
    )
    at = np.array([0, face - 0.33 * long, 0.03 + 0.36 * high])
    screw = whole.add(
        "screw", spin(at, FRONT), surface([lying(0.1 * wide, 0.2 * long, Y, 12) + at], metal), parent=moving
    )
    # Its knobs pass before the jaw and stop at the screw.
    bar = [rod(at + [-0.7 * wide, -0.06 * long, 0], at + [0.7 * wide, -0.06 * long, 0], 0.045 * wide, 8)]
    bar += [ball_knob(0.08 * wide) + at + [s * 0.7 * wide, -0.06 * long, 0] for s in (-1, 1)]
    whole.add("tommy bar", slide(RIGHT, 0.5 * wide, -0.5 * wide), surface(bar, metal), parent=screw)
    return whole.bodies()


def _pocket_knife(dice: Dice) -> list[Body]:
    """Tools folded between two scales, hinged at either end."""
    long, wide, count = dice.between(0.07, 0.12), dice.between(0.018, 0.026), dice.whole(1, 6)
    layer, cover = dice.between(0.0018, 0.003), dice.between(0.002, 0.005)
    steel, shell = looks.metal(dice), looks.plastic(dice) if dice.chance(0.6) else looks.wood(dice)
    total = count * layer
    scale = prism(rounded(0.45, wide / long), (wide, long, cover))
    scales = [scale + [0, 0, s * (total / 2 + cover / 2 + 0.0003)] for s in (-1, 1)]
    pins = [cylinder(0.002, total + 2 * cover, 8) + [-0.15 * wide, s * 0.42 * long, 0] for s in (-1, 1)]
    spine = box((0.0015, 0.86 * long, total), (-0.4 * wide, 0, 0))
    whole = Rig(surface(scales, shell), surface([*pins, spine], steel), label="handle")
    for k in range(count):
        end = dice.sign()
        reach, broad = dice.between(0.45, 0.8) * long, dice.between(0.25, 0.5) * wide
        pin = np.array([-0.15 * wide, end * 0.42 * long, -total / 2 + (k + 0.5) * layer])
        run = -end * np.linspace(0, reach, 5)
        drift = np.array([0.1, 0.15, 0.15, 0.12, -0.05]) * wide + 0.15 * wide
        blade = ribbon(
            np.column_stack([drift, run]),
            broad * np.array([0.9, 1, 1, 0.8, dice.between(0.05, 0.9)]),
            0.8 * layer,
            -0.4 * layer,
        )
        ring = cylinder(0.2 * wide, 0.8 * layer, 10)
        axis = UP if end > 0 else DOWN
        whole.add(
            "blade",
            hinge(pin, axis, dice.between(1.6, 3.1)),
            surface(moved([blade, ring], pin), steel),
            name=f"blade_{k + 1}",
        )
    return whole.bodies()


def _box_cutter(dice: Dice) -> list[Body]:
    """A blade that slides out of a handle, with its slider; or a craft knife with a cap."""
    long, wide, thick = dice.between(0.11, 0.17), dice.between(0.018, 0.03), dice.between(0.008, 0.016)
    shell, steel = looks.plastic(dice), looks.metal(dice)
    y = long / 2
    walls = [
        box((wide, long, 0.2 * thick), (0, 0, -0.4 * thick)),
        boxes((0.15 * wide, long, 0.8 * thick), [(s * 0.425 * wide, 0, 0.1 * thick) for s in (-1, 1)]),
    ]
    walls += [boxes((0.2 * wide, long, 0.12 * thick), [(s * 0.4 * wide, 0, 0.44 * thick) for s in (-1, 1)])]
    walls.append(box((0.7 * wide, 0.01, 0.8 * thick), (0, y - 0.005, 0.1 * thick)))
    whole = Rig(surface(walls, shell), label="handle")
    out = dice.between(0.0, 0.2) * long
    tip = -y - out
    blade = plate(
        [
            [-0.3 * wide, tip + 0.4 * wide],
            [0.3 * wide, tip],
            [0.3 * wide, 0.25 * long],
            [-0.3 * wide, 0.25 * long],
        ],
        0.001,
    )
    knob_y = -0.15 * long - out * 0.5
    slider = box((0.5 * wide, 0.025, 0.6 * thick), (0, knob_y, 0.35 * thick))
    whole.add(
        "blade",
        slide(FRONT, 0.28 * long, -out),
        surface([blade], steel),
        surface([slider], looks.plastic(dice)),
    )
    if dice.chance(0.4):
        at = np.array([0, y + 0.006, 0.1 * thick])
        whole.add(
            "end cap",
            slide(BACK, 0.02),
            surface([box((0.9 * wide, 0.011, 0.8 * thick), at)], looks.rubber(dice)),
        )
    return whole.bodies()


def _corkscrew(dice: Dice) -> list[Body]:
    """With two wings: the spindle slides and its key turns while the wings rise."""
    tall, radius = dice.between(0.12, 0.17), dice.between(0.016, 0.022)
    look, dark = looks.metal(dice), looks.plastic(dice)
    bell = [
        torus(radius, 0.003, 18, 0.006),
        *around([rod((radius, 0, 0), (0.5 * radius, 0, 0.5 * tall), 0.003)], dice.whole(2, 4), 0.7),
    ]
    hole, collar = 0.0055, 0.6 * radius
    bell.append(torus((collar + hole) / 2, (collar - hole) / 2, 14, 0.01) + [0, 0, 0.5 * tall])
    lug = 1.2 * radius - hole - 0.001
    bell.append(boxes((lug, 0.012, 0.012), [(s * (1.2 * radius - lug / 2), 0, 0.5 * tall) for s in (-1, 1)]))
    whole = Rig(surface(bell, look), label="bell")
    run = np.linspace(0, 1, 25)
    helix = np.column_stack(
        [0.004 * np.cos(28 * run), 0.004 * np.sin(28 * run), 0.05 * tall + 0.4 * tall * run]
    )
    from_top = [rod((0, 0, 0.45 * tall), (0, 0, 0.8 * tall), 0.003, 8)]
    from_top += [rod(a, b, 0.0012, 4) for a, b in pairwise(helix)]
    spindle = whole.add("spindle", slide(UP, 0.3 * tall), surface(from_top, look))
    top = np.array([0, 0, 0.82 * tall])
    key = [box((0.05, 0.006, 0.03), top), cylinder(0.006, 0.02, 10) + top]
    whole.add("key", spin(top, UP), surface(key, dark), parent=spindle)
    for name, s in (("left_wing", -1), ("right_wing", 1)):
        pin = np.array([s * 1.15 * radius, 0, 0.5 * tall])
        arm = ribbon(
            np.array([[0, 0.008], [s * 0.4 * radius, -0.15 * tall], [s * 0.3 * radius, -0.5 * tall]]),
            [0.012, 0.008, 0.014],
            0.006,
            -0.003,
        )
        piece = arm[..., [0, 2, 1]] * [1, -1, 1]
        whole.add(
            "wing",
            hinge(pin, (0, -s, 0), dice.between(1.5, 2.4)),
            surface(moved([piece, lying(0.006, 0.016, Y, 10)], pin), look),
            name=name,
        )
    return whole.bodies()


def _ladder(dice: Dice) -> list[Body]:
    """Two halves hinged on top, or one that slides on the other."""
    tall, width, steps = dice.between(0.8, 2.6), dice.between(0.35, 0.5), dice.whole(3, 8)
    look, slope = looks.metal(dice) if dice.chance(0.6) else looks.wood(dice), dice.between(0.15, 0.3)
    levels = np.linspace(0.12, 0.92, steps)

    def half(side: int, wide: float, deep: float) -> Pieces:
        lean = side * slope * tall
        pieces = [rod((s * wide / 2, lean, 0), (s * wide * 0.42, 0, tall), 0.02, 4) for s in (-1, 1)]
        for level in levels:
            pieces.append(box((wide * (1 - 0.16 * level), deep, 0.02), (0, lean * (1 - level), level * tall)))
        return pieces

    if dice.chance(0.65):
        whole = Rig(
            surface(half(-1, width, 0.07), look),
            surface([box((width, 0.2, 0.03), (0, -0.03, tall + 0.01))], looks.plastic(dice)),
            label="front",
        )
        rear = half(1, width * 0.92, 0.02)
        whole.add(
            "rear legs",
            hinge((0, 0.02, tall - 0.01), LEFT, 1.9 * slope),
            surface([p + [0, 0.03, 0] for p in rear], look),
        )
        if dice.chance(0.5):
            pin = np.array([0, -0.14, tall])
            hoop = [
                rod((s * 0.4 * width, 0.1, tall), (s * 0.4 * width, 0.1, tall + 0.45), 0.012) for s in (-1, 1)
            ]
            hoop.append(rod((-0.4 * width, 0.1, tall + 0.45), (0.4 * width, 0.1, tall + 0.45), 0.012))
            whole.add("rail", hinge(pin + [0, 0.24, 0], LEFT, 0.9), surface(hoop, look))
        return whole.bodies()
    slope = 0.0
    whole = Rig(surface(half(-1, width, 0.03), look), label="lower half")
    upper = [p + [0, -0.05, 0.12] for p in half(-1, width * 0.9, 0.03)]
    whole.add("upper half", slide(UP, 0.75 * tall), surface(upper, look))
    return whole.bodies(rotation(LEFT, dice.between(0.0, 0.25)))


def _ironing_board(dice: Dice) -> list[Body]:
    """Crossed legs below a long board; or a folding table with a pair of frames."""
    long, wide, level = dice.between(0.9, 1.35), dice.between(0.28, 0.4), dice.between(0.7, 0.95)
    metal, x = looks.metal(dice), 0.4 * wide
    outline = (
        np.array([[-0.5, -0.25], [-0.35, -0.42], [0.35, -0.42], [0.5, -0.25], [0.5, 0.5], [-0.5, 0.5]])
        * [wide, long]
        if dice.chance(0.6)
        else np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]) * [wide, long]
    )
    board = plate(outline, 0.025) + [0, 0, level]
    whole = Rig(surface([board], looks.fabric(dice)), label="board")
    under = level - 0.02
    for name, s, half in (("outer_legs", 1, x), ("inner_legs", -1, x - 0.03)):
        top, foot = np.array([0, s * 0.3 * long, under]), np.array([0, -s * 0.3 * long, 0.012])
        legs = [rod(top + [t * half, 0, 0], foot + [t * half, 0, 0], 0.011, 8) for t in (-1, 1)]
        legs += [lying(0.012, 2 * half + 0.14, X, 8) + foot, lying(0.011, 2 * half, X, 8) + top]
        upper = np.arctan2(under, 0.6 * long)
        whole.add("legs", hinge(top, (-s, 0, 0), 0.95 * upper), surface(legs, metal), name=name)
    if dice.chance(0.4):
        tray = box((0.9 * wide, 0.25, 0.01), (0, 0.5 * long + 0.13, level))
        whole.add("iron rest", slide(FRONT, 0.2), surface([tray - [0, 0, 0.02]], metal))
    return whole.bodies()


def _seesaw(dice: Dice) -> list[Body]:
    """A seesaw, a swing or a pair of scales."""
    long, level, look = dice.between(1.4, 2.8), dice.between(0.35, 0.55), looks.wood(dice)
    metal, scale = looks.metal(dice), 1.0 if dice.chance(0.6) else 0.15
    stand = loft(
        np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]),
        [(0, 0, 0), (0.5, 0.3, 0), (0.16, 0.12, level - 0.05), (0, 0, level - 0.05)],
    )
    whole = Rig(surface([stand], metal), label="stand")
    pin = np.array([0, 0, level])
    limit = np.arctan2(level - 0.1, long / 2)
    plank = [box((long, 0.2, 0.04), (0, 0, level + 0.02)), lying(0.03, 0.24, Y, 12) + pin]
    if dice.chance(0.7):
        plank += [
            rod((s * 0.36 * long, t * 0.09, level), (s * 0.36 * long, t * 0.09, level + 0.2), 0.012)
            for s in (-1, 1)
            for t in (-1, 1)
        ]
    board = whole.add("plank", hinge(pin, BACK, limit, -limit), surface(plank, look))
    if dice.chance(0.4):
        for s in (-1, 1):
            hook = np.array([s * 0.47 * long, 0, level])
            pan = [
                cylinder(0.15, 0.02, 18) + hook - [0, 0, 0.2],
                *[
                    rod(hook, hook + [0.13 * np.cos(a), 0.13 * np.sin(a), -0.19], 0.005, 4)
                    for a in (0, 2.1, 4.2)
                ],
            ]
            whole.add("pan", hinge(hook, BACK, 0.6, -0.6), surface(pan, metal), parent=board)
    return whole.bodies(scale=scale)


CATEGORIES: tuple[Category, ...] = (
    Category("clamp", _clamp),
    Category("vise", _vise),
    Category("pocket_knife", _pocket_knife),
    Category("box_cutter", _box_cutter),
    Category("corkscrew", _corkscrew),
    Category("ladder", _ladder),
    Category("ironing_board", _ironing_board),
    Category("seesaw", _seesaw),
)
