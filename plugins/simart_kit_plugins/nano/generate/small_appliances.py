"""Toasters, coffee machines, grills and cooker hoods."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.legs import feet
from ...shapes.outlines import SQUARE, half_round, ngon, rounded
from ...shapes.placing import X, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, loft, prism, rod, tube, vessel
from . import looks
from .assembling import Assembly, dial, disc, holder, press, pull, rack, turning
from .category import Category
from .objects import Body, Look, free, hinge, slide


def _toaster(dice: Dice) -> list[Body]:
    """Slots on top, a lever at an end that goes down, a dial, a crumb tray."""
    kit, coat = Assembly("case"), looks.painted_metal(dice)
    slots = dice.whole(1, 4)
    lengthwise = slots > 1 and dice.chance(0.3)
    long = dice.between(0.24, 0.4) if lengthwise or slots == 1 else dice.between(0.2, 0.3)
    deep, high = 0.08 + 0.045 * (1 if lengthwise else slots), dice.between(0.15, 0.21)
    wall, lift_by = 0.018, dice.between(0.05, 0.09)
    kit.fix(feet(dice, long * 0.9, deep * 0.85, 0.012), looks.rubber(dice))
    step = (deep - 2 * wall) / (1 if lengthwise else slots)
    rows = 1 if lengthwise else slots
    cut = step * dice.between(0.5, 0.7)
    # Bars between the slots make up the top; below it the case is closed by its sides.
    edges = np.concatenate(
        [
            [-deep / 2],
            *([y - cut / 2, y + cut / 2] for y in (np.arange(rows) + 0.5 - rows / 2) * step),
            [deep / 2],
        ]
    )
    bars = [between((-long / 2 + wall, a, 0), (long / 2 - wall, b, high)) for a, b in edges.reshape(-1, 2)]
    ends = boxes((wall, deep, high), [(s * (long - wall) / 2, 0, high / 2) for s in (-1, 1)])
    floor = box((long - 2 * wall, deep, 0.01), (0, 0, 0.005))
    kit.fix([*bars, ends], coat)
    kit.fix([floor], looks.darker(coat, 0.5))
    side = dice.sign()
    count = 2 if slots > 2 and dice.chance(0.5) else 1
    dark = looks.plastic(dice)
    for k in range(count):
        y = (k - (count - 1) / 2) * deep * 0.5
        top = high * 0.82
        kit.fix(
            [box((0.001, 0.006, lift_by + 0.02), (side * long / 2, y, top - lift_by / 2))],
            Look("plastic", (20, 20, 20)),
        )
        knob = [box((0.025, dice.between(0.025, 0.05), 0.014), (side * (long / 2 + 0.0135), y, top))]
        kit.add("lever", slide((0, 0, -1), lift_by), [(knob, dark)])
    if dice.chance(0.7):
        spot = (side * long / 2, dice.between(-0.2, 0.2) * deep, high * 0.22)
        turn = rotation((0, 0, 1), side * np.pi / 2)
        shape = moved(turned(dial(dice, dice.between(0.012, 0.018)), turn), spot)
        kit.add("knob", turning(dice, spot, (-side, 0, 0)), [(shape, dark)])
    if dice.chance(0.4):
        _crumbs(kit, dice, long, deep, -side)
    return kit.done()


def _crumbs(kit: Assembly, dice: Dice, long: float, deep: float, side: int) -> None:
    """A tray below the floor that comes out at an end."""
    tray = box((long * 0.9, deep * 0.7, 0.004), (side * long * 0.05, 0, -0.004))
    lip = box((0.004, deep * 0.7, 0.014), (side * (long / 2 + 0.003), 0, 0.001))
    kit.add("tray", slide((side, 0, 0), long * 0.7), [([tray, lip], looks.metal(dice))])


def _coffee_machine(dice: Dice) -> list[Body]:
    """A foot, a back and a head over a pot: with a lid, or with a portafilter, a wand and knobs."""
    kit, coat = Assembly("case"), looks.plastic(dice) if dice.chance(0.5) else looks.painted_metal(dice)
    width, depth, height = dice.between(0.15, 0.32), dice.between(0.2, 0.34), dice.between(0.28, 0.4)
    foot, head, back = dice.between(0.03, 0.07), dice.between(0.08, 0.13), dice.between(0.3, 0.45) * depth
    kit.fix(
        [box((width, depth, foot), (0, 0, foot / 2)), box((width, depth, head), (0, 0, height - head / 2))],
        coat,
    )
    kit.fix(
        [box((width, back, height - foot - head), (0, (depth - back) / 2, (height + foot - head) / 2))], coat
    )
    front = -depth / 2
    under, doored = height - head, False
    if dice.chance(0.5):
        _jug(dice, kit, width, (depth - back, -back / 2), foot, under)
        basket = moved(
            [box((width * 0.6, 0.02, head * 0.7)), *holder(dice, 0.08)], (0, front - 0.011, height - head / 2)
        )
        doored = dice.chance(0.5)
        if doored:
            motion = hinge((width * 0.3, front - 0.001, height), (0, 0, 1), 1.5)
            kit.add("filter door", motion, [(basket, coat)])
    else:
        _portafilter(dice, kit, (front - back) / 2, under)
        if dice.chance(0.6):
            side = dice.sign()
            spot = (side * width * 0.42, front + 0.02, under)
            wand = [
                rod((0, 0, 0), (0, -0.01, -0.05), 0.005),
                rod((0, -0.01, -0.05), (0, -0.02, -(under - foot) * 0.8), 0.004),
            ]
            kit.add("wand", hinge(spot, (0, 0, side), 0.9, -0.4), [(moved(wand, spot), looks.metal(dice))])
    tray = [
        box((width * 0.8, depth - back - 0.02, 0.012), (0, front + (depth - back) / 2 - 0.012, foot + 0.007)),
        box((width * 0.8, 0.006, foot * 0.7), (0, front - 0.004, foot * 0.65)),
    ]
    if dice.chance(0.7):
        kit.add("drip tray", pull((depth - back) * 0.9), [(tray, looks.metal(dice))])
    if dice.chance(0.7):
        deep = depth * dice.between(0.4, 0.98)
        lid = [box((width * 0.96, deep, 0.012), (0, depth / 2 - deep / 2, height + 0.008))]
        kit.add(
            "lid", hinge((0, depth / 2, height + 0.002), (-1, 0, 0), dice.between(1.2, 1.6)), [(lid, coat)]
        )
    if not doored:
        _front_controls(dice, kit, width, front, height - head * 0.5, head)
    return kit.done()


def _jug(
    dice: Dice, kit: Assembly, width: float, room: tuple[float, float], floor: float, under: float
) -> None:
    """A glass pot on the foot with a lid of its own."""
    deep, y = room
    radius, high = min(width * 0.4, deep * 0.45, 0.065), (under - floor) * 0.7
    base = (0, y, floor + 0.014)
    jug = moved([vessel(ngon(18), (1.8 * radius, 1.8 * radius, high), 0.003)], base)
    ear = tube(
        [
            (0, -radius * 0.9, high * 0.9),
            (0, -radius * 1.5, high * 0.85),
            (0, -radius * 1.4, high * 0.3),
            (0, -radius * 0.9, high * 0.2),
        ],
        0.006,
        6,
    )
    number = kit.add("jug", free(), [(jug, looks.glass(dice)), (moved([ear], base), looks.plastic(dice))])
    pin = np.array([0, y - radius * 0.85, floor + 0.015 + high])
    lid = [cylinder(radius * 0.9, 0.008, 18) + [0, y, pin[2] + 0.004]]
    lid.append(pointed(cylinder(0.003, 0.5 * radius, 8), X) + pin)
    kit.add("lid", hinge(pin, (1, 0, 0), 0.45), [(lid, looks.plastic(dice))], number)


def _portafilter(dice: Dice, kit: Assembly, y: float, under: float) -> None:
    """One or two handles that turn in below the head."""
    metal = looks.metal(dice)
    pin = np.array([0, y, under - 0.001])
    kit.fix([cylinder(0.034, 0.012, 18) + pin - [0, 0, 0.005]], metal)
    cup = [cylinder(0.031, 0.028, 18) + pin - [0, 0, 0.026]]
    grip = [rod(pin + [0, -0.03, -0.028], pin + [0, -0.17, -0.036], 0.012, 10)]
    spouts = [rod(pin + [s * 0.008, 0, -0.03], pin + [s * 0.016, 0, -0.055], 0.004) for s in (-1, 1)]
    parts = [(cup + spouts, metal), (grip, looks.plastic(dice))]
    kit.add("portafilter", hinge(pin, (0, 0, -1), dice.between(0.6, 1.2)), parts)


def _front_controls(dice: Dice, kit: Assembly, width: float, front: float, level: float, room: float) -> None:
    count, look = dice.whole(0, 4), looks.plastic(dice)
    knobs = dice.chance(0.4)
    size = min(room * 0.25, 0.14 * width)
    for k in range(count):
        spot = ((k + 0.5 - count / 2) * width * 0.85 / count, front, level + room * 0.22)
        if knobs:
            kit.add("knob", turning(dice, spot), [(moved(dial(dice, size), spot), look)])
        else:
            kit.add("button", press(0.003), [(moved([disc(size * 0.6, 0.007, 14)], spot), look)])


def _grill(dice: Dice) -> list[Body]:
    """A bowl, a drum or a case on legs with a lid on a hinge or free, vents, and knobs with gas."""
    kit, coat = Assembly("bowl"), looks.painted_metal(dice)
    if dice.chance(0.4):
        return _kettle_grill(dice, kit, coat)
    width, depth = dice.between(0.45, 1.1), dice.between(0.35, 0.55)
    level, deep = dice.between(0.6, 0.85), dice.between(0.12, 0.25)
    tub = vessel(dice.pick((SQUARE, rounded(0.1))), (width * 0.92, depth * 0.92, deep), 0.006, 1 / 0.92)
    kit.fix([tub + [0, 0, level]], coat)
    kit.fix(moved(feet(dice, width * 0.9, depth * 0.9, level), (0, 0, level)), looks.metal(dice))
    kit.fix(
        moved(rack(dice, width * 0.96, depth * 0.94, 0.0), (0, 0, level + deep * 0.93)), looks.metal(dice)
    )
    tall, top = depth * dice.between(0.35, 0.6), level + deep + 0.003
    hood = prism(half_round(), (depth, 2 * tall, width))
    hood = pointed(hood, X) + [0, 0, 0]
    hood[..., 2] = (hood[..., 2] + tall) / 2
    grip = moved(holder(dice, width * dice.between(0.4, 0.8)), (0, -depth * 0.46, top + tall * 0.35))
    gauge = moved([disc(0.035, 0.012, 16)], (0, -depth * 0.42, top + tall * 0.62))
    parts: list[tuple[Pieces, Look]] = [([hood + [0, 0, top]], coat), (grip, looks.metal(dice))]
    if dice.chance(0.5):
        parts.append((gauge, looks.metal(dice)))
    kit.add("lid", hinge((0, depth / 2, top), (-1, 0, 0), dice.between(0.9, 1.6)), parts)
    if dice.chance(0.6):
        panel = box((width, 0.04, deep * 0.7), (0, -depth / 2 - 0.02, level + deep * 0.45))
        kit.fix([panel], coat)
        seed, count = dice.whole(0, 2**31), dice.whole(1, 5)
        for k in range(count):
            spot = ((k + 0.5 - count / 2) * width * 0.8 / count, -depth / 2 - 0.04, level + deep * 0.45)
            kit.add(
                "knob",
                turning(Dice(seed + 1), spot),
                [(moved(dial(Dice(seed), 0.025), spot), looks.metal(dice))],
            )
    _side_tables(dice, kit, (width, depth), level + deep * 0.9)
    return kit.done()


def _side_tables(dice: Dice, kit: Assembly, size: tuple[float, float], level: float) -> None:
    """Boards at the ends, which fold down."""
    for side in (-1, 1):
        if dice.chance(0.5):
            continue
        wide = dice.between(0.2, 0.4)
        x = side * size[0] / 2
        board = [box((wide, size[1] * 0.85, 0.02), (x + side * (wide / 2 + 0.008), 0, level))]
        folds = hinge((x + side * 0.004, 0, level - 0.01), (0, side, 0), 1.55)
        kit.add("side table", folds, [(board, looks.wood(dice))])


def _kettle_grill(dice: Dice, kit: Assembly, coat: Look) -> list[Body]:
    radius, level = dice.between(0.18, 0.32), dice.between(0.35, 0.75)
    wall = 0.006
    outer = [(0, -0.7), (0.5, -0.6), (0.85, -0.35), (1, 0)]
    bowl = [(2 * radius * r, 2 * radius * r, radius * z) for r, z in outer]
    bowl += [(x - 2 * wall, y - 2 * wall, z) if x else (0, 0, z + wall) for x, y, z in reversed(bowl)]
    kit.fix([loft(ngon(22), [(max(x, 0), max(y, 0), z + level) for x, y, z in bowl])], coat)
    legs = [
        rod(
            (0.5 * radius * np.cos(a), 0.5 * radius * np.sin(a), level - 0.4 * radius),
            (1.0 * radius * np.cos(a), 1.0 * radius * np.sin(a), 0),
            0.012,
            6,
        )
        for a in (0.5, 2.6, 4.7)
    ]
    kit.fix(legs, looks.metal(dice))
    kit.fix([cylinder(radius * 0.97, 0.004, 22) + [0, 0, level - 0.02]], looks.metal(dice))
    dome = [
        (2 * radius * r, 2 * radius * r, level + 0.003 + radius * z)
        for r, z in ((0.97, 0), (1.02, 0), (0.85, 0.35), (0.5, 0.55), (0, 0.62))
    ]
    grip = moved(turned(holder(dice, 0.14), rotation((1, 0, 0), -np.pi / 2)), (0, 0, level + 0.6 * radius))
    parts = [([loft(ngon(22), dome)], coat), (grip, looks.wood(dice))]
    if dice.chance(0.5):
        pin = (0, 1.02 * radius, level + 0.003)
        kit.add("lid", hinge(pin, (-1, 0, 0), dice.between(1.0, 1.6)), parts)
    else:
        kit.add("lid", free(), parts)
    if dice.chance(0.6):
        spot = np.array([0, 0, level - 0.72 * radius])
        vent = [cylinder(0.05, 0.003, 14) + spot, rod(spot, spot + [0, -0.12, 0], 0.004)]
        kit.add("vent", hinge(spot, (0, 0, 1), 0.8), [(vent, looks.metal(dice))])
    return kit.done()


def _hood(dice: Dice) -> list[Body]:
    """A cooker hood: a visor or a box that pulls out, a flap, buttons and lamps, a duct."""
    kit, coat = Assembly("hood"), looks.painted_metal(dice)
    width, depth, high = dice.between(0.5, 1.0), dice.between(0.28, 0.5), dice.between(0.05, 0.16)
    kit.fix([box((width, depth, high), (0, 0, high / 2))], coat)
    duct = dice.unit()
    if duct < 0.4:
        top = dice.between(0.2, 0.35)
        kit.fix(
            [
                loft(
                    SQUARE,
                    [
                        (width, depth, high),
                        (top, top * 0.9, high + 0.2),
                        (top, top * 0.9, high + 0.7),
                        (0, 0, high + 0.7),
                    ],
                )
            ],
            coat,
        )
    elif duct < 0.7:
        kit.fix([cylinder(0.08, 0.4, 18) + [0, 0.1 * depth, high + 0.2]], looks.metal(dice))
    lamps = at(box((0.06, 0.06, 0.004)), [(s * width * 0.35, 0, -0.002) for s in (-1, 1)])
    kit.fix(lamps, looks.glass(dice))
    _visor(dice, kit, (width, depth, high))
    return kit.done()


def _visor(dice: Dice, kit: Assembly, size: tuple[float, float, float]) -> None:
    """What pulls out, swings up or falls below a hood, and buttons where the front is free."""
    width, depth, high = size
    front = -depth / 2
    style = dice.unit()
    if style < 0.5:
        visor = [
            box((width * 0.99, depth * 0.95, 0.018), (0, -0.03, -0.016)),
            box((width, 0.02, high * 0.6), (0, front - 0.012, high * 0.3 - 0.025)),
        ]
        kit.add("visor", pull(depth * dice.between(0.4, 0.75)), [(visor, looks.metal(dice))])
    elif style < 0.8:
        tall = dice.between(0.1, 0.3)
        face = [box((width * 0.98, 0.01, tall), (0, front - 0.007, high - tall / 2))]
        motion = hinge((0, front - 0.007, high), (-1, 0, 0), dice.between(0.5, 1.2))
        kit.add("visor", motion, [(face, looks.glass(dice))])
    else:
        mesh = [
            box((width * 0.5 - 0.01, depth * 0.8, 0.008), (0, 0, -0.006)),
            box((0.06, 0.01, 0.012), (0, -depth * 0.35, -0.014)),
        ]
        for side in (-1, 1):
            shape = moved(mesh, (side * width * 0.25, 0, -0.002))
            motion = hinge((0, depth * 0.4, -0.002), (1, 0, 0), dice.between(0.8, 1.5))
            kit.add(
                "filter",
                motion,
                [(shape, looks.metal(dice))],
                name="left_filter" if side < 0 else "right_filter",
            )
    if style >= 0.8 or dice.chance(0.3):
        count = dice.whole(2, 5)
        for k in range(count):
            spot = (width * 0.3 + (k - count / 2) * 0.028, front, high * 0.5)
            if style >= 0.8:
                kit.add(
                    "button", press(0.003), [(moved([disc(0.009, 0.008, 12)], spot), looks.plastic(dice))]
                )
            else:
                kit.fix(moved([disc(0.009, 0.002, 12)], spot), looks.plastic(dice))


CATEGORIES: tuple[Category, ...] = (
    Category("toaster", _toaster),
    Category("coffee_machine", _coffee_machine),
    Category("grill", _grill),
    Category("range_hood", _hood),
)
