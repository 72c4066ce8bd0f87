"""Tools of two arms on a pin, and what staples, punches and clips."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, moved, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, prism, rod, superquadric
from . import looks
from .category import Category
from .objects import Body, Look, hinge, slide, spin, surface
from .rigging import LEFT, RIGHT, UP, Rig, lying, plate, profile, ribbon


def _loop(middle: ArrayLike, across: float, along: float, thick: float, width: float) -> FloatArray:
    """A finger ring that lies flat on z = 0."""
    angle = np.linspace(0, 2 * np.pi, 17)
    path = np.column_stack([across * np.cos(angle), along * np.sin(angle)])
    return ribbon(path + np.asarray(middle), width, thick)


def _held(dice: Dice, whole: Rig) -> list[Body]:
    """As a hand holds them: the arm that moves above the one that stays, which looks the same."""
    return whole.bodies(_askew(dice) @ rotation((0, 1, 0), np.pi / 2))


def _askew(dice: Dice) -> FloatArray:
    """(3, 3) some way round about z, half of the time."""
    return rotation(UP, dice.between(-0.6, 0.6) if dice.chance(0.5) else 0.0)


def _scissors(dice: Dice) -> list[Body]:
    blade, shank = dice.between(0.05, 0.16), dice.between(0.03, 0.1)
    thick, wide = 0.02 * blade + 0.0008, dice.between(0.08, 0.16) * blade
    steel, grip = looks.metal(dice), looks.plastic(dice)
    rings, bow = dice.between(0.012, 0.022), dice.between(0.01, 0.02)
    bare = dice.chance(0.3)
    arms: list[tuple[Pieces, Pieces]] = []
    for side in (1, -1):
        base = 0 if side == 1 else thick + 0.0003
        edge: list[list[float]] = [
            [-0.2 * side * wide, -blade],
            [-0.1 * side * wide, -0.4 * blade],
            [0, 0],
            [side * bow * 0.5, 0.4 * shank],
        ]
        metal = [
            ribbon([*edge, [side * bow, shank]], wide * np.array([0.1, 0.8, 1.0, 0.8, 0.5]), thick, base)
        ]
        metal.append(cylinder(0.25 * wide, thick * 1.6, 10) + [0, 0, base + 0.8 * thick])
        across = rings * (1.0 if side == 1 else dice.between(0.8, 1.1))
        ring = (side * (max(bow, across) + 0.003), shank + rings * 1.1)
        high = thick * (1 if bare else 2.5)
        lift = base + thick / 2 - high / 2
        arms.append(
            (metal, [_loop(ring, across, rings * dice.between(1.1, 1.6), high, 0.3 * rings) + [0, 0, lift]])
        )
    looked = [(surface(a, steel), surface(b, steel if bare else grip)) for a, b in arms]
    whole = Rig(*looked[0], label="arm")
    moving = whole.add("arm", hinge((0, 0, thick), UP, dice.between(0.6, 1.2)), *looked[1], name="second_arm")
    if dice.chance(0.2):
        latch = box((0.25 * rings, 1.6 * rings, thick), (-0.3 * rings, shank * 0.7, 2.6 * thick))
        whole.add(
            "latch",
            hinge((-0.3 * rings, shank * 0.7 - 0.7 * rings, 2 * thick), UP, 1.2),
            surface([latch], grip),
            parent=moving,
        )
    # Flat on the table: the arm that moves is the upper one.
    return whole.bodies(_askew(dice))


def _arm(jaw: FloatArray, handle: FloatArray, thick: float, layer: int, disc: float) -> tuple[Pieces, Pieces]:
    """Jaw, half of the joint, and handle of pliers; (K, 3) points of x, y and width each."""
    steel = [
        ribbon(jaw[:, :2], jaw[:, 2], thick),
        cylinder(disc, thick / 2 - 0.0002, 14) + [0, 0, (0.25 + 0.5 * layer) * thick],
    ]
    return steel, [ribbon(handle[:, :2], handle[:, 2], thick)]


def _pliers(dice: Dice) -> list[Body]:
    long, jaw = dice.between(0.07, 0.16), dice.between(0.02, 0.07)
    thick, wide = dice.between(0.006, 0.012), dice.between(0.007, 0.012)
    steel, grip = looks.metal(dice), looks.plastic(dice)
    disc, tip = wide * dice.between(0.9, 1.3), dice.between(0.25, 1.0) * wide
    bow, end = dice.between(1.1, 2.0) * disc, dice.between(0.6, 1.8) * disc
    hook = dice.between(0, 0.5) * wide if dice.chance(0.3) else 0.0
    gap = 0.0004
    sides = []
    for side in (1, -1):
        rows = [
            [-side * (tip / 2 + gap), -jaw, tip],
            [-side * (wide / 2 + gap + hook), -0.5 * jaw, wide],
            [-side * (wide / 2 + gap), -0.7 * disc, wide],
        ]
        bar = [
            [side * 0.6 * disc, 0.7 * disc, wide],
            [side * bow, 0.35 * long, wide],
            [side * bow, 0.7 * long, wide],
            [side * end, long, 0.7 * wide],
        ]
        sides.append(_arm(np.array(rows), np.array(bar), thick, 0 if side == 1 else 1, disc))
    whole = Rig(surface(sides[0][0], steel), surface(sides[0][1], grip), label="arm")
    pin = surface([cylinder(0.4 * disc, thick * 1.15, 10) + [0, 0, thick / 2]], looks.darker(steel))
    whole.dress(0, pin)
    arm = (surface(sides[1][0], steel), surface(sides[1][1], grip))
    whole.add("arm", hinge((0, 0, thick / 2), UP, dice.between(0.5, 1.1)), *arm, name="second_arm")
    if dice.chance(0.25):
        lever = [
            ribbon(
                [[bow - wide, 0.3 * long], [bow - 1.4 * wide, 0.8 * long]],
                0.5 * wide,
                0.5 * thick,
                0.25 * thick,
            )
        ]
        pivot = (bow - wide, 0.3 * long, thick / 2)
        whole.add("lever", hinge(pivot, UP, 0.4), surface(lever, looks.darker(steel)))
    return _held(dice, whole)


def _tongs(dice: Dice) -> list[Body]:
    """Two arms hinged at their ends, such as tongs and tweezers; a ring may lock them."""
    long, wide = dice.between(0.1, 0.35), dice.between(0.012, 0.03)
    look = looks.metal(dice)
    steps = np.linspace(0, 1, 8)
    bulge, tip = dice.between(0.04, 0.1) * long, wide * dice.between(0.8, 2.0)
    spread = 0.0012 + bulge * np.sin(np.pi * steps) ** 0.8
    arms = []
    for side in (1, -1):
        points = np.column_stack([side * (spread + 0.0012), -long * steps])
        piece = ribbon(points, 0.0022, wide, -wide / 2)
        pad = superquadric((0.006, 0.16 * long, tip), 0.6, 0.8, 6) + [side * 0.0045, -0.95 * long, 0]
        arms.append(
            (surface([piece], look), surface([pad], looks.plastic(dice) if dice.chance(0.4) else look))
        )
    whole = Rig(*arms[0], surface([cylinder(0.004, wide * 1.05, 10)], looks.darker(look)), label="arm")
    # Arms on the +x side stay; the other opens towards -x.
    whole.add("arm", hinge((0, 0, 0), (0, 0, -1), dice.between(0.3, 0.8)), *arms[1], name="second_arm")
    if dice.chance(0.45):
        y, half = -0.12 * long, 0.0035 + float(np.interp(0.12, steps, spread))
        ring = boxes((2 * half + 0.004, 0.006, 0.002), [(0, y, s * (wide / 2 + 0.002)) for s in (-1, 1)])
        cheeks = boxes((0.002, 0.006, wide + 0.006), [(s * (half + 0.001), y, 0) for s in (-1, 1)])
        whole.add("lock ring", slide((0, 1, 0), 0.09 * long), surface([ring, cheeks], looks.darker(look)))
    return _held(dice, whole)


def _nutcracker(dice: Dice) -> list[Body]:
    """Two levers on a link at the front, with a mouth behind it."""
    long, thick, wide = dice.between(0.13, 0.2), dice.between(0.008, 0.014), dice.between(0.008, 0.014)
    look, mouth = looks.metal(dice) if dice.chance(0.7) else looks.wood(dice), dice.between(0.008, 0.016)
    y = np.array([0, 0.1, 0.2, 0.32, 0.6, 1.0]) * long
    x = np.array([0.55, 1.0, 1.0, 0.5, 1.1, 0.9]) * mouth + wide / 2
    width = wide * np.array([1.2, 1, 1, 1.1, 0.9, 1.2])
    arms = [surface([ribbon(np.column_stack([s * x, y]), width, thick)], look) for s in (1, -1)]
    pin = s_x = float(x[0])
    link = [
        box((2 * s_x + wide, wide, 0.3 * thick), (0, 0, -0.17 * thick)),
        cylinder(0.4 * wide, 1.2 * thick, 10) + [pin, 0, thick / 2],
    ]
    whole = Rig(arms[0], surface(link, looks.darker(look)), label="arm")
    bolt = surface([cylinder(0.4 * wide, 1.2 * thick, 10) + [-pin, 0, thick / 2]], looks.darker(look))
    whole.add("arm", hinge((-pin, 0, 0), UP, dice.between(0.6, 1.3)), arms[1], bolt, name="second_arm")
    return _held(dice, whole)


def _stapler(dice: Dice) -> list[Body]:
    long, wide, high = dice.between(0.08, 0.17), dice.between(0.022, 0.036), dice.between(0.02, 0.035)
    shell, steel = looks.plastic(dice) if dice.chance(0.6) else looks.painted_metal(dice), looks.metal(dice)
    base = prism(rounded(dice.between(0.1, 0.4), wide / long), (wide, long, 0.006)) + [0, 0, 0.003]
    back = 0.42 * long
    pin = np.array([0, back, 0.006 + 0.5 * high])
    cheeks = boxes(
        (0.0025, 0.12 * long, 0.7 * high), [(s * 0.36 * wide, back, 0.005 + 0.35 * high) for s in (-1, 1)]
    )
    whole = Rig(surface([base], shell), surface([cheeks], steel), label="base")
    anvil = surface([box((0.4 * wide, 0.08 * long, 0.001), (0, -0.4 * long, 0.0066))], steel)
    whole.dress(0, anvil)
    tilt = dice.between(0.03, 0.1)
    lean = rotation(LEFT, tilt)
    bar = box((0.5 * wide, 0.88 * long, 0.3 * high), (0, -0.43 * long, 0))
    magazine = [*moved(turned([bar], lean), pin), lying(0.1 * high, 0.8 * wide, X, 10) + pin]
    first = whole.add(
        "magazine", hinge(pin, LEFT, dice.between(0.8, 2.6), -0.5 * tilt), surface(magazine, steel)
    )
    top = np.array(
        [
            [0.06 * long, -0.1 * high],
            [-0.9 * long, 0.2 * high],
            [-0.92 * long, 0.6 * high],
            [-0.4 * long, dice.between(0.7, 1.0) * high],
            [0.04 * long, 0.5 * high],
        ]
    )
    cover = profile(top, wide * 0.9) + [0, 0, 0.12 * high]
    over = moved(turned([cover], lean), pin)
    whole.add("cover", hinge(pin, LEFT, dice.between(0.5, 1.3)), surface(over, shell), parent=first)
    return whole.bodies()


def _hole_punch(dice: Dice) -> list[Body]:
    width, depth, high = dice.between(0.1, 0.16), dice.between(0.06, 0.12), dice.between(0.03, 0.05)
    shell, steel = looks.painted_metal(dice), looks.metal(dice)
    count = dice.whole(2, 4)
    base = box((width, depth, 0.008), (0, 0, 0.008))
    back = 0.3 * depth
    posts = boxes((0.006, 0.025, high), [(s * 0.42 * width, back, 0.012 + high / 2) for s in (-1, 1)])
    xs = np.linspace(-0.3, 0.3, count) * width
    bars = [box((0.016, 0.02, 0.4 * high), (x, 0.02 * depth, 0.012 + 0.3 * high)) for x in xs]
    whole = Rig(surface([base, posts], shell), surface(bars, steel))
    pin = np.array([0, back, 0.012 + 0.85 * high])
    arm = plate(
        [[-0.4 * width, 0], [0.4 * width, 0], [0.3 * width, -0.95 * depth], [-0.3 * width, -0.95 * depth]],
        0.005,
    )
    lever = turned([arm, lying(0.006, 0.8 * width, X, 10)], rotation(LEFT, dice.between(0.3, 0.5)))
    whole.add(
        "lever", hinge(pin, RIGHT, dice.between(0.2, 0.3)), surface(moved(lever, pin), looks.plastic(dice))
    )
    if dice.chance(0.5):
        tray = open_box((0.94 * width, 0.9 * depth, 0.004), 0.001)
        whole.add(
            "tray", slide((0, 1, 0), 0.5 * depth), surface([tray - [0, 0, 0.0008]], looks.plastic(dice))
        )
    if dice.chance(0.5):
        ruler = box((0.6 * width, 0.012, 0.0018), (0.1 * width, -0.1 * depth, 0.0135))
        stop = box((0.003, 0.012, 0.008), (0.4 * width, -0.1 * depth, 0.016))
        whole.add("paper guide", slide(RIGHT, 0.35 * width), surface([ruler, stop], steel))
    return whole.bodies()


def _nail_clipper(dice: Dice) -> list[Body]:
    long, wide = dice.between(0.05, 0.085), dice.between(0.011, 0.016)
    look = looks.metal(dice)
    mouth = dice.between(0.003, 0.005)
    strips = []
    for side in (1, -1):
        path = [
            [0.5 * long, side * 0.0008],
            [0, side * 0.5 * mouth],
            [-0.44 * long, side * mouth],
            [-0.5 * long, side * 0.3 * mouth],
        ]
        flat = ribbon(path, 0.0014, wide, -wide / 2)
        strips.append(flat[..., [2, 0, 1]])
    post = cylinder(0.0016, 2.2 * mouth + 0.008, 8) + [0, -0.36 * long, 0.002]
    whole = Rig(surface([*strips, post], look))
    top = mouth + 0.004
    at = np.array([0, -0.36 * long, top])
    collar = surface([cylinder(0.0026, 0.0016, 10) + at], looks.darker(look))
    turn = whole.add("collar", spin(at, UP), collar)
    bar = plate(
        [
            [-0.4 * wide, 0.06 * long],
            [-0.2 * wide, -0.1 * long],
            [0.2 * wide, -0.1 * long],
            [0.4 * wide, 0.06 * long],
            [0.5 * wide, 0.8 * long],
            [-0.5 * wide, 0.8 * long],
        ],
        0.0016,
    )
    lever = moved(turned([bar + [0, 0, 0.0008]], rotation(RIGHT, dice.between(0, 0.12))), at + [0, 0, 0.001])
    whole.add("lever", hinge(at, RIGHT, dice.between(0.4, 2.8)), surface(lever, look), parent=turn)
    if dice.chance(0.5):
        pin = np.array([0, 0.44 * long, mouth * 0.4 + 0.0022])
        blade = ribbon(
            np.array([[0, 0], [0, -0.5 * long], [0, -0.72 * long]]),
            [0.5 * wide, 0.5 * wide, 0.1 * wide],
            0.0008,
        )
        whole.add("nail file", hinge(pin, UP, np.pi), surface([blade + pin], looks.darker(look)))
    return whole.bodies()


def _bar_look(dice: Dice) -> Look:
    return looks.metal(dice) if dice.chance(0.5) else looks.painted_metal(dice)


def _clothes_peg(dice: Dice) -> list[Body]:
    """Two levers about a spring: pegs, bag clips, clipboards' jaws."""
    long, thick, wide = dice.between(0.05, 0.09), dice.between(0.005, 0.009), dice.between(0.008, 0.02)
    look, open_ = looks.wood(dice) if dice.chance(0.5) else looks.plastic(dice), dice.between(0.12, 0.22)
    y = np.array([-0.5, -0.3, 0.0, 0.5]) * long
    halves = []
    for side in (1, -1):
        x = side * (thick / 2 + 0.0003 + np.array([0, 0, 0, np.tan(open_) * 0.5 * long]))
        path = np.column_stack([x, y])
        halves.append(surface([ribbon(path, thick * np.array([0.6, 1, 1, 0.7]), wide)], look))
    spring = [cylinder(0.0025, wide * 1.25, 10) + [0, 0, wide / 2]]
    ends = [
        rod((0, 0, z), (side * 1.3 * thick, -0.12 * long, z), 0.0008, 5)
        for side in (1, -1)
        for z in (-0.1 * wide, 1.1 * wide)
    ]
    whole = Rig(halves[0], surface(spring + ends, _bar_look(dice)), label="half")
    whole.add("half", hinge((0, 0, 0), (0, 0, -1), open_ * 0.8), halves[1], name="second_half")
    return _held(dice, whole)


CATEGORIES: tuple[Category, ...] = (
    Category("scissors", _scissors),
    Category("pliers", _pliers),
    Category("tongs", _tongs),
    Category("nutcracker", _nutcracker),
    Category("stapler", _stapler),
    Category("hole_punch", _hole_punch),
    Category("nail_clipper", _nail_clipper),
    Category("clothes_peg", _clothes_peg),
)
