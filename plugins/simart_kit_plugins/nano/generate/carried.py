"""Suitcases, tool boxes and coolers: what opens and is carried or pulled."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, mirrored, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, loft, open_box, rod, tube, vessel
from . import looks
from .assembly import Assembly, Leaf
from .carcass import Size, any_size, board
from .category import Category
from .objects import Body, Look, free, hinge, slide, spin, surface
from .rolling import caster, wheel_leaf

_UPSIDE_DOWN = rotation((1, 0, 0), np.pi)


def bow(width: float, rise: float, thick: float) -> FloatArray:
    """A carrying handle along x that stands up from z = 0."""
    x, top = width / 2, rise
    path = [
        (-x, 0, 0),
        (-x, 0, 0.8 * top),
        (-0.85 * x, 0, top),
        (0.85 * x, 0, top),
        (x, 0, 0.8 * top),
        (x, 0, 0),
    ]
    return tube(path, thick, 8)


def _suitcase(dice: Dice) -> Sequence[Body]:
    return _trolley_case(dice) if dice.chance(0.7) else _briefcase(dice)


def _trolley_case(dice: Dice) -> Sequence[Body]:
    """Two shells on wheels: the front one turns about one of its sides or its foot."""
    width, height, depth = any_size(dice, (0.3, 0.42, 0.16), (0.58, 0.85, 0.34))
    share, wall = dice.pick((0.5, 0.5, dice.between(0.2, 0.5))), dice.between(0.003, 0.008)
    look, trim = dice.pick((looks.plastic(dice), looks.fabric(dice), looks.metal(dice))), looks.rubber(dice)
    outline = rounded(dice.between(0.04, 0.2), width / height)
    made = Assembly("body")
    seam = -depth / 2 + share * depth
    back = _half(outline, width, height, depth * (1 - share), wall)
    made.fix(moved(back, (0, depth / 2, 0)), look)
    front = mirrored(_half(outline, width, height, depth * share, wall), Y)
    front = moved(front, (0, -depth / 2 - 0.001, 0))
    _ribs(made, dice, (width, depth, height), front, look)
    side, upper = dice.sign(), np.radians(dice.between(90, 175))
    motion = hinge((side * width / 2, seam, 0), (0, 0, side), upper)
    if dice.chance(0.2):
        motion = hinge((0, seam, -height / 2), (1, 0, 0), upper)
    made.add(Leaf("front_shell", "shell", (surface(front, look),), motion))
    made.add(_pull(dice, width, height, depth, looks.metal(dice)))
    if dice.chance(0.7):
        grip = bow(dice.between(0.1, 0.16), 0.03, 0.008) + [
            0,
            depth / 2 - 0.6 * (1 - share) * depth,
            height / 2,
        ]
        pin = (0, depth / 2 - 0.6 * (1 - share) * depth, height / 2)
        both = dice.chance(0.3)
        motion = hinge(pin, (1, 0, 0), 1.4, lower=-1.4 if both else 0.0)
        made.add(Leaf("carry_handle", "handle", (surface([grip], trim),), motion))
    _rollers(made, dice, (width, depth, height))
    return made.bodies()


def _half(outline: FloatArray, width: float, height: float, deep: float, wall: float) -> Pieces:
    """A tray on its edge, open to -y, its back at y = 0."""
    return turned([vessel(outline, (width, height, deep), wall)], rotation((1, 0, 0), np.pi / 2))


def _ribs(made: Assembly, dice: Dice, size: Size, front: Pieces, look: Look) -> None:
    """Grooves or pockets on both shells."""
    width, depth, height = size
    style = dice.unit()
    if style < 0.5:
        xs = np.linspace(-0.36, 0.36, dice.whole(3, 7)) * width
        bars = boxes((0.012, 0.006, height * 0.8), [(x, 0, 0) for x in xs])
        made.fix([bars + [0, depth / 2 + 0.003, 0]], look)
        front.append(bars + [0, -depth / 2 - 0.004, 0])
    elif style < 0.75:
        for tall, z in ((0.4, -0.22), (0.28, 0.25)):
            pocket = box((0.75 * width, 0.025, tall * height), (0, -depth / 2 - 0.0135, z * height))
            front.append(pocket)


def _pull(dice: Dice, width: float, height: float, depth: float, look: Look) -> Leaf:
    """A telescopic handle that slides out of the back shell."""
    x, y, long = dice.between(0.12, 0.3) * width, depth / 2 - 0.03, 0.75 * height
    top = height / 2 + dice.between(0.012, 0.03)
    rods = [rod((s * x, y, top - long), (s * x, y, top), 0.007, 8) for s in (-1, 1)]
    grip = box((2 * x + 0.03, 0.03, 0.022), (0, y, top + 0.005))
    if dice.chance(0.3):
        rods, grip = rods[:1], box((0.1, 0.03, 0.022), (-x, y, top + 0.005))
    parts = (surface(rods, look), surface([grip], looks.plastic(dice)))
    return Leaf("telescopic_handle", "handle", parts, slide((0, 0, 1), long * dice.between(0.6, 0.85)))


def _rollers(made: Assembly, dice: Dice, size: Size) -> None:
    """Two fixed wheels at the back, or four casters."""
    width, depth, height = size
    radius, x, y = dice.between(0.018, 0.032), 0.38 * width, 0.32 * depth
    if dice.chance(0.5):
        for end, level in (("front", -1), ("rear", 1)):
            for side, name in ((-1, "left"), (1, "right")):
                # Those in front stand below the back shell's overhang, fixed to it by a plate.
                made.add(
                    caster(dice, radius, (side * x, level * y, -height / 2 - 0.004), True, f"{end}_{name}")
                )
        made.fix(
            [boxes((0.05, 2 * y + 0.04, 0.004), [(s * x, 0, -height / 2 - 0.002) for s in (-1, 1)])],
            looks.rubber(dice),
        )
        return
    for side, name in ((-1, "left_wheel"), (1, "right_wheel")):
        place = (side * x, depth / 2 - radius, -height / 2 - 0.4 * radius)
        made.add(wheel_leaf(dice, radius, place, name))
        cheeks = [(place[0] + s * 0.6 * radius, place[1], place[2] + 0.3 * radius) for s in (-1, 1)]
        made.fix([boxes((0.15 * radius, 1.6 * radius, 1.4 * radius), cheeks)], looks.rubber(dice))
        foot = box(
            (0.03, 0.03, 1.4 * radius), (place[0], -depth / 2 + 0.2 * depth, -height / 2 - 0.7 * radius)
        )
        made.fix([foot], looks.rubber(dice))


def _briefcase(dice: Dice) -> Sequence[Body]:
    """A flat case that lies: a lid at its back, a handle and clasps in front."""
    size = any_size(dice, (0.3, 0.22, 0.05), (0.6, 0.42, 0.14))
    width, depth, height = size
    look, trim = dice.pick((looks.fabric(dice), looks.plastic(dice), looks.metal(dice))), looks.metal(dice)
    made, wall, outline = Assembly("body"), 0.005, rounded(dice.between(0.02, 0.12), 1.3)
    low = dice.between(0.45, 0.8) * height
    made.fix([vessel(outline, (width, depth, low), wall)], look)
    upper = turned([vessel(outline, (width, depth, height - low), wall)], _UPSIDE_DOWN)
    lid = Leaf(
        "lid",
        "lid",
        (surface(moved(upper, (0, 0, height + 0.001)), look),),
        hinge((0, depth / 2, low), (-1, 0, 0), np.radians(dice.between(80, 170))),
    )
    for x, name in ((-0.3 * width, "left_clasp"), (0.3 * width, "right_clasp")):
        plate = box((0.03, 0.004, 0.035), (x, -depth / 2 - 0.003, low))
        motion = hinge((x, -depth / 2 - 0.003, low + 0.0175), (-1, 0, 0), dice.between(0.8, 2.0))
        lid = lid.with_children(Leaf(name, "latch", (surface([plate], trim),), motion))
    made.add(lid)
    grip = turned([bow(0.3 * width, 0.045, 0.007)], rotation((1, 0, 0), np.pi / 2))
    pin = (0, -depth / 2 - 0.006, 0.6 * low)
    motion = hinge(pin, (1, 0, 0), 1.4, lower=-1.4)
    made.add(Leaf("handle", "handle", (surface(moved(grip, pin), looks.rubber(dice)),), motion))
    return made.bodies()


def _toolbox(dice: Dice) -> Sequence[Body]:
    """A long box: one lid or two, a handle that turns on it, latches, a tray."""
    size = any_size(dice, (0.28, 0.14, 0.1), (0.65, 0.32, 0.28))
    width, depth, height = size
    look, trim = dice.pick((looks.plastic(dice), looks.painted_metal(dice))), looks.metal(dice)
    made, wall = Assembly("body"), 0.004
    made.fix([open_box(size, wall)], look)
    if dice.chance(0.5):
        ribs = np.linspace(-0.4, 0.4, dice.whole(3, 6)) * width
        spots = [(x, s * (depth / 2 + 0.002), height / 2) for x in ribs for s in (-1, 1)]
        made.fix([boxes((0.015, 0.004, 0.9 * height), spots)], look)
    cover, rise = (
        dice.pick((look, looks.darker(look), looks.plastic(dice))),
        dice.between(0.02, 0.35) * height,
    )
    if dice.chance(0.3):
        _wings(made, dice, size, rise, cover, trim)
        return made.bodies()
    top = height + 0.001
    stages = [(width + 0.006, depth + 0.006, top), (width + 0.006, depth + 0.006, top + 0.4 * rise)]
    stages += [(0.9 * width, 0.6 * depth, top + rise), (0, 0, top + rise)]
    lid = Leaf(
        "lid",
        "lid",
        (surface([loft(SQUARE, stages)], cover),),
        hinge((0, depth / 2, height), (-1, 0, 0), np.radians(dice.between(80, 120))),
    )
    lid = lid.with_children(_carrying(dice, 0.45 * width, top + rise, trim))
    for x, name in ((-0.32 * width, "left_latch"), (0.32 * width, "right_latch")) if dice.chance(0.7) else ():
        plate = box((0.035, 0.006, 0.05), (x, -depth / 2 - 0.009, height - 0.012))
        motion = hinge((x, -depth / 2 - 0.009, height + 0.013), (-1, 0, 0), dice.between(1.0, 2.4))
        lid = lid.with_children(Leaf(name, "latch", (surface([plate], trim),), motion))
    made.add(lid)
    if dice.chance(0.5):
        tray = open_box((width - 0.02, depth - 0.02, 0.35 * height), 0.003) + [0, 0, 0.62 * height]
        made.add(Leaf("tray", "tray", (surface([tray], looks.plastic(dice)),), free()))
    return made.bodies()


def _carrying(dice: Dice, wide: float, level: float, look: Look) -> Leaf:
    """A handle that lies on a lid and turns up, or stands and turns down both ways."""
    grip = [bow(wide, dice.between(0.04, 0.07), 0.006)]
    pin = (0, 0, level + 0.008)
    if dice.chance(0.5):
        grip = turned(grip, rotation((1, 0, 0), np.pi / 2))
        motion = hinge(pin, (-1, 0, 0), np.pi / 2)
    else:
        motion = hinge(pin, (1, 0, 0), 1.5, lower=-1.5)
    return Leaf("handle", "handle", (surface(moved(grip, pin), look),), motion)


def _wings(made: Assembly, dice: Dice, size: Size, rise: float, cover: Look, trim: Look) -> None:
    """Two lids that open to the front and the back, below a handle between posts."""
    width, depth, height = size
    top, upper = height + 0.001, np.radians(dice.between(90, 160))
    for side, name in ((-1, "front_lid"), (1, "back_lid")):
        plate = between(
            (-width / 2, min(0.0015 * side, side * depth / 2), top),
            (width / 2, max(0.0015 * side, side * depth / 2), top + 0.2 * rise),
        )
        motion = hinge((0, side * depth / 2, height), (-side, 0, 0), upper)
        made.add(Leaf(name, "lid", (surface([plate], cover),), motion))
    x, tall = width / 2 + 0.006, height + rise + 0.06
    made.fix([box((0.006, 0.03, 0.03), (s * x, 0, height - 0.03)) for s in (-1, 1)], trim)
    grip = bow(2 * x + 0.012, tall - height + 0.03, 0.006) + [0, 0, height - 0.03]
    reach = float(np.arccos((0.2 * rise + 0.045) / (tall - height + 0.03)))
    motion = hinge((0, 0, height - 0.03), (1, 0, 0), reach, lower=-reach)
    made.add(Leaf("handle", "handle", (surface([grip], trim),), motion))


def _cooler(dice: Dice) -> Sequence[Body]:
    """A thick-walled box with a lid, a bow about it or handles at its ends, wheels, a drain plug."""
    size = any_size(dice, (0.28, 0.2, 0.22), (0.9, 0.48, 0.48))
    width, depth, height = size
    look, trim = looks.plastic(dice), looks.plastic(dice)
    made, wall, outline = Assembly("body"), 0.1 * depth, rounded(dice.between(0.03, 0.12), width / depth)
    made.fix([vessel(outline, size, wall, dice.between(1.0, 1.08))], look)
    if dice.chance(0.4):
        made.fix(
            [
                loft(
                    outline,
                    [
                        (width * s, depth * s, z * height)
                        for s, z in ((1, 0.7), (1.1, 0.72), (1.1, 0.85), (1, 0.87))
                    ],
                )
            ],
            trim,
        )
    wide, deep, rise = width * 1.1, depth * 1.1, dice.between(0.1, 0.25) * height
    top = height + 0.001
    stages = [
        (0, 0, top),
        (wide, deep, top),
        (wide, deep, top + 0.7 * rise),
        (0.94 * wide, 0.92 * deep, top + rise),
    ]
    cover = [loft(outline, [*stages, (0, 0, top + rise)])]
    halves = width > 0.5 and dice.chance(0.2)
    upper = np.radians(dice.between(80, 110))
    if halves:
        half = between((0.001, -deep / 2, top), (wide / 2, deep / 2, top + rise))
        for side, name in ((-1, "left_lid"), (1, "right_lid")):
            motion = hinge((side * wide / 2, 0, top), (0, side, 0), upper)
            made.add(Leaf(name, "lid", (surface([half * [side, 1, 1]], trim),), motion))
    else:
        cups = [cylinder(0.035, 0.004, 14) + [s * 0.2 * width, 0, top + rise + 0.002] for s in (-1, 1)]
        parts = [surface(cover, trim)] + ([surface(cups, looks.darker(trim))] if dice.chance(0.3) else [])
        loose = dice.chance(0.12)
        motion = free() if loose else hinge((0, deep / 2, top), (-1, 0, 0), upper)
        made.add(Leaf("lid", "lid", tuple(parts), motion))
    _cooler_trim(made, dice, (wide, deep, height), rise, looks.metal(dice))
    return made.bodies()


def _cooler_trim(made: Assembly, dice: Dice, size: Size, rise: float, metal: Look) -> None:
    wide, deep, height = size
    style = dice.unit()
    if style < 0.5:
        level = 0.75 * height
        x = wide / 2 + 0.015
        clear = height + rise + 0.012 - level
        # A long bow swings over the edges of the lid, a short one leans on it.
        over = dice.chance(0.5)
        tall = float(np.hypot(deep / 2, clear)) + 0.02 if over else clear + 0.05
        reach = dice.between(1.6, 2.2) if over else float(np.arccos(clear / tall))
        grip = bow(2 * x, tall, 0.009) + [0, 0, level]
        made.fix(
            [pointed(cylinder(0.018, 0.07, 12), X) + [s * (x - 0.035), 0, level] for s in (-1, 1)], metal
        )
        motion = hinge((0, 0, level), (1, 0, 0), reach, lower=-reach)
        made.add(Leaf("handle", "handle", (surface([grip], metal),), motion))
    else:
        ends = [box((0.03, 0.4 * deep, 0.03), (s * (wide / 2 + 0.005), 0, 0.75 * height)) for s in (-1, 1)]
        made.fix(ends, looks.rubber(dice))
    if wide > 0.5 and dice.chance(0.5):
        radius = 0.18 * height
        for y, name in ((-1, "front_wheel"), (1, "rear_wheel")):
            place = (wide / 2 - 0.05, y * (deep / 2 - 0.01), 0.6 * radius)
            roll = wheel_leaf(dice, radius, (0, 0, 0), name).turned(rotation((0, 0, 1), np.pi / 2))
            made.add(roll.moved(place))
        loop = np.array([[-0.02, -0.02], [0.02, -0.02], [0.02, 0.02], [-0.02, 0.02]])
        made.fix(
            [board(loop, 0.4 * radius) + [-0.4 * wide, s * 0.3 * deep, -0.2 * radius] for s in (-1, 1)], metal
        )
    if dice.chance(0.5):
        place = (-wide / 2 * 0.95, 0.2 * deep, 0.12 * height)
        plug = [pointed(cylinder(0.018, 0.03, 12), X), box((0.01, 0.008, 0.035), (-0.018, 0, 0))]
        made.add(Leaf("drain_plug", "plug", (surface(moved(plug, place), metal),), spin(place, (-1, 0, 0))))


CATEGORIES: tuple[Category, ...] = (
    Category("suitcase", _suitcase),
    Category("toolbox", _toolbox),
    Category("cooler", _cooler),
)
