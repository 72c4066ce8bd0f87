"""Printers that build things up in layers: from a thread, or from resin."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, around, at, corners, moved, pointed
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, revolve, rod, tube
from . import looks
from .assembling import Assembly, dial, disc, holder, press, swing, turning
from .machine_tools_parts import DARK, sleeve
from .objects import Body, Look, hinge, slide, spin
from .rigging import BACK, FRONT, LEFT, RIGHT, UP, lying


def _spool(dice: Dice, kit: Assembly, pin: FloatArray, axis: int, to: int = 0) -> None:
    """A reel of thread that turns on a peg."""
    radius, wide = dice.between(0.07, 0.1), dice.between(0.05, 0.07)
    reel = [pointed(sleeve(0.02, radius, 0.004) + [0, 0, z], axis) for z in (-wide / 2, wide / 2 - 0.004)]
    reel.append(pointed(sleeve(0.0195, 0.026, wide) - [0, 0, wide / 2], axis))
    wound = pointed(
        sleeve(0.027, dice.between(0.5, 0.95) * radius, wide - 0.01) - [0, 0, wide / 2 - 0.005], axis
    )
    look = looks.plastic(dice)
    parts = [(moved(reel, pin), looks.plastic(dice)), (moved([wound], pin), look)]
    kit.add("spool", spin(pin, np.eye(3)[axis]), parts, to)


def _print_head(dice: Dice, kit: Assembly, spot: FloatArray, room: float, to: int) -> None:
    """A carriage with a nozzle before a beam along x, whose middle is at `spot`; it slides both ways."""
    wide, tall = dice.between(0.045, 0.07), dice.between(0.05, 0.08)
    body = [
        box((wide, 0.012, tall), (0, -0.0235, 0)),
        box((0.8 * wide, 0.035, 0.7 * tall), (0, -0.0465, 0.004)),
    ]
    body += [box((0.8 * wide, 0.05, 0.006), (0, 0.004, s * 0.0215)) for s in (-1, 1)]
    nozzle = [revolve([[0.0, -0.02], [0.002, -0.02], [0.008, -0.01], [0.008, 0.0], [0.0, 0.0]], 10)]
    nozzle = moved(nozzle, (0, -0.0465, 0.004 - 0.35 * tall))
    cooler = [disc(0.3 * wide, 0.008, 16) + [0, -0.064, 0.004]]
    parts = [(moved(body, spot), looks.plastic(dice)), (moved(nozzle, spot), Look("steel", (205, 170, 90)))]
    start = dice.between(-0.5, 0.5) * room
    parts = [(moved(pieces, (start, 0, 0)), look) for pieces, look in parts]
    parts.append((moved(cooler, spot + np.array([start, 0, 0])), DARK))
    kit.add("head", slide(RIGHT, room - start - wide / 2, wide / 2 - room - start), parts, to)


def _panel(dice: Dice, kit: Assembly, spot: FloatArray) -> None:
    """A display before y = 0 with a knob or buttons beside it."""
    wide = dice.between(0.06, 0.1)
    kit.fix([box((wide + 0.07, 0.012, 0.05), spot - [0, 0.006, 0])], DARK)
    kit.fix([box((wide, 0.002, 0.038), spot - [0.02, 0.013, 0])], looks.glass(dice))
    place = spot + [wide / 2 + 0.01, -0.012, 0]
    if dice.chance(0.65):
        kit.add("knob", spin(place, FRONT), [(moved(dial(dice, 0.012), place), looks.plastic(dice))])
        return
    for z in (-0.013, 0.013):
        kit.add("button", press(0.003), [([disc(0.007, 0.006, 12) + place + [0, 0, z]], looks.plastic(dice))])


def _bed(size: float, deep: float) -> Pieces:
    """A heated plate, its top at z = 0, on a carrier with screws at its corners."""
    spots = corners(size - 0.03, deep - 0.03, -0.013)
    bars = boxes((0.9 * size, 0.03, 0.006), [(0, s * (deep / 2 - 0.015), -0.02) for s in (-1, 1)])
    plate = [
        box((size, deep, 0.006), (0, 0, -0.003)),
        bars,
        box((0.5 * size, 0.8 * deep, 0.006), (0, 0, -0.02)),
    ]
    return [*plate, *at(cylinder(0.007, 0.016, 8), spots)]


def _open_printer(dice: Dice) -> list[Body]:
    """A bed that slides to and fro below a beam that climbs on one upright or two, with a head on it."""
    kit, metal, coat = Assembly("frame"), looks.metal(dice), looks.painted_metal(dice)
    size, tall, single = dice.between(0.16, 0.34), dice.between(0.3, 0.5), dice.chance(0.35)
    deep, x, foot = size * dice.between(0.9, 1.1), size / 2 + 0.06, dice.between(0.05, 0.07)
    frame = [box((0.04, 1.9 * deep, 0.04), (s * 0.06, 0, foot - 0.02)) for s in (-1, 1)]
    frame.append(box((2 * x + 0.04, 0.06, 0.04), (0, 0.03, foot - 0.02)))
    frame.append(box((0.16, 0.03, 0.038), (0, -0.95 * deep, foot - 0.02)))
    kit.fix([*frame, box((2 * x, 0.05, 0.01), (0, -0.4 * deep, foot - 0.03))], coat)
    spots = corners(0.12, 1.7 * deep, (foot - 0.04) / 2)
    kit.fix(at(cylinder(0.015, foot - 0.04, 10), spots), looks.rubber(dice))
    sides = (-1,) if single else (-1, 1)
    posts = [box((0.03, 0.03, tall), (s * x, 0.03, foot + tall / 2)) for s in sides]
    kit.fix(
        posts if single else [*posts, box((2 * x + 0.03, 0.03, 0.03), (0, 0.03, foot + tall + 0.015))], coat
    )
    plate = moved(_bed(size, deep), (0, 0, foot + 0.05))
    shoes = [box((0.03, 0.12, 0.026), (s * 0.06, 0, foot + 0.0143)) for s in (-1, 1)]
    start = dice.between(-0.1, 0.1) * deep
    motion = slide(FRONT, 0.4 * deep + start, start - 0.4 * deep)
    kit.add("bed", motion, [(moved(plate, (0, start, 0)), metal), (moved(shoes, (0, start, 0)), DARK)])
    level = foot + 0.09 + dice.between(0.02, 0.5) * tall
    beam = [box((2 * x + (0.0 if single else 0.04), 0.03, 0.03), (0, -0.012, level))]
    for s in sides:
        beam.append(box((0.05, 0.006, 0.07), (s * x, 0.0075, level)))
        beam += [boxes((0.008, 0.042, 0.06), [(s * x + t * 0.0205, 0.031, level) for t in (-1, 1)])]
    gantry = kit.add("gantry", slide(UP, foot + tall - level - 0.05, foot + 0.095 - level), [(beam, metal)])
    _print_head(dice, kit, np.array([0, -0.012, level]), size / 2 + 0.01, gantry)
    if dice.chance(0.6):
        for s in sides:
            line = [cylinder(0.004, tall - 0.03, 8) + [s * (x - 0.034), 0.045, foot + 0.02 + tall / 2]]
            line.append(cylinder(0.01, 0.024, 12) + [s * (x - 0.034), 0.045, foot + 0.04])
            kit.fix([box((0.036, 0.036, 0.026), (s * (x - 0.034), 0.045, foot + 0.013))], DARK)
            kit.add("screw", spin((s * (x - 0.034), 0.045, foot), UP), [(line, metal)])
    _panel(dice, kit, np.array([0 if dice.chance(0.5) else 0.3 * x, -0.95 * deep - 0.015, foot - 0.015]))
    if dice.chance(0.75):
        top = foot + tall
        pin = (
            np.array([-x, 0.03, top + 0.14])
            if single or dice.chance(0.3)
            else np.array([0, 0.03, top + 0.15])
        )
        stand = box((0.03, 0.008, pin[2] - top + 0.02), (pin[0], 0.034, (pin[2] + top) / 2))
        kit.fix([stand, pointed(cylinder(0.017, 0.09, 12), Y) + pin + [0, 0.05, 0]], DARK)
        _spool(dice, kit, pin + [0, 0.06, 0], Y)
    return kit.done()


def _boxed_printer(dice: Dice) -> list[Body]:
    """A closed cube: a bed that sinks, a beam that slides on rails, a head on it, a door, a lid."""
    kit, coat, metal = Assembly("housing"), looks.painted_metal(dice), looks.metal(dice)
    x, y, tall, wall = dice.between(0.17, 0.26), dice.between(0.17, 0.25), dice.between(0.38, 0.6), 0.02
    floor, band = dice.between(0.05, 0.1), dice.between(0.05, 0.08)
    spans = [
        (-x, x, -y, y, 0, floor),
        (-x, x, y - wall, y, floor, tall),
        (-x, x, -y, -y + wall, tall - band, tall),
    ]
    case = [between((a, c, e), (b, d, f)) for a, b, c, d, e, f in spans]
    case += [
        between(
            (s * (x - wall / 2) - wall / 2, -y, floor), (s * (x - wall / 2) + wall / 2, y - wall, tall - band)
        )
        for s in (-1, 1)
    ]
    case += [
        between(
            (s * (x - wall / 2) - wall / 2, -y + wall, tall - band),
            (s * (x - wall / 2) + wall / 2, y - wall, tall),
        )
        for s in (-1, 1)
    ]
    kit.fix(case, coat)
    kit.fix(at(cylinder(0.02, 0.012, 10), corners(1.7 * x, 1.7 * y, -0.006)), looks.rubber(dice))
    rails, level = x - wall, tall - band - 0.05
    kit.fix(
        [
            rod((s * (rails - 0.02), -y + wall, level), (s * (rails - 0.02), y - wall, level), 0.005, 8)
            for s in (-1, 1)
        ],
        metal,
    )
    shoe = [pointed(sleeve(0.0055, 0.013, 0.05), Y) + [s * (rails - 0.02), -0.025, level] for s in (-1, 1)]
    beam = box((2 * rails - 0.065, 0.03, 0.024), (0, 0, level))
    start, room = dice.between(-0.3, 0.4) * y, y - wall - 0.03
    parts = [(moved([*shoe, beam], (0, start, 0)), metal)]
    bar = kit.add("gantry", slide(BACK, room - start, 0.085 - room - start), parts)
    _print_head(dice, kit, np.array([0, start, level]), rails - 0.06, bar)
    wide, deep = 2 * rails - 0.07, 2 * y - 2 * wall - 0.09
    top = floor + 0.03 + dice.between(0.2, 0.9) * (level - 0.09 - floor - 0.03)
    guides = [(s * 0.6 * rails, y - wall - 0.022) for s in (-1, 1)]
    kit.fix([cylinder(0.005, level - floor, 10) + [a, b, (level + floor) / 2] for a, b in guides], metal)
    plate = moved(_bed(wide, deep), (0, -0.03, 0))
    plate += [sleeve(0.0055, 0.013, 0.03) + [a, b, -0.035] for a, b in guides]
    plate += [boxes((0.02, 0.05, 0.008), [(a, b - 0.03, -0.02) for a, b in guides])]
    kit.add("bed", slide(UP, level - 0.075 - top, floor + 0.04 - top), [(moved(plate, (0, 0, top)), DARK)])
    _boxed_openings(dice, kit, (x, y, tall), (floor, band), coat)
    return kit.done()


def _boxed_openings(
    dice: Dice, kit: Assembly, size: tuple[float, float, float], span: tuple[float, float], coat: Look
) -> None:
    """Door, lid, display, and a spool behind or at a side of a closed printer."""
    (x, y, tall), (floor, band), clear = size, span, looks.glass(dice)
    if dice.chance(0.85):
        side, middle, high = dice.sign(), (floor + tall - band) / 2, tall - band - floor
        pane = [box((2 * x - 0.004, 0.008, high - 0.004), (0, -y - 0.006, middle))]
        pins = [
            cylinder(0.006, 0.04, 10) + [side * (x - 0.006), -y - 0.0085, middle + k * 0.35 * high]
            for k in (-1, 1)
        ]
        spot = (-side * (x - 0.03), -y - 0.01, middle)
        grip = moved(holder(dice, min(0.25, 0.5 * high), True), spot)
        motion = swing(side, side * (x - 0.006), -y - 0.008, dice.between(1.6, 2.2))
        kit.add("door", motion, [(pane, clear), (pins, looks.metal(dice)), (grip, DARK)])
    if dice.chance(0.75):
        rise = dice.pick((0.008, 0.008, 0.06, 0.1))
        lid = [box((2 * x, 2 * y, 0.008), (0, 0, tall + rise - 0.002))]
        if rise > 0.02:
            low = tall + 0.002
            lid += [
                between((s * (x - 0.002) - 0.002, -y, low), (s * (x - 0.002) + 0.002, y, tall + rise - 0.006))
                for s in (-1, 1)
            ]
            lid += [
                between(
                    (-x + 0.004, s * (y - 0.002) - 0.002, low),
                    (x - 0.004, s * (y - 0.002) + 0.002, tall + rise - 0.006),
                )
                for s in (-1, 1)
            ]
        pins = [lying(0.006, 0.04) + [s * 0.6 * x, y + 0.004, tall + 0.007] for s in (-1, 1)]
        grip = [box((0.08, 0.014, 0.012), (0, -y - 0.006, tall + rise))]
        kit.add(
            "lid",
            hinge((0, y + 0.004, tall + 0.007), LEFT, dice.between(1.2, 1.7)),
            [(lid, clear), (pins, looks.metal(dice)), (grip, DARK)],
        )
    _panel(
        dice,
        kit,
        np.array(
            [dice.between(-0.3, 0.3) * x, -y, min(floor - 0.027, 0.03) if floor > 0.07 else tall - band / 2]
        ),
    )
    if dice.chance(0.6):
        side = dice.pick((-1, 1))
        pin = np.array([side * (x + 0.045), dice.between(-0.2, 0.3) * y, dice.between(0.4, 0.7) * tall])
        kit.fix([lying(0.016, 0.09) + pin - [side * 0.001, 0, 0]], coat)
        _spool(dice, kit, pin, X)


def _vat(dice: Dice, kit: Assembly, size: tuple[float, float, float], floor: float, metal: Look) -> None:
    """A tray for resin, half so wide and deep about a y, and the knobs that hold it."""
    (half, deep, middle), low = size, floor + 0.001
    sides = [
        between(
            (s * (half + 0.016) - 0.006, -deep - 0.022, 0), (s * (half + 0.016) + 0.006, deep + 0.022, 0.03)
        )
        for s in (-1, 1)
    ]
    sides += [
        between(
            (-half - 0.01, s * (deep + 0.016) - 0.006, 0), (half + 0.01, s * (deep + 0.016) + 0.006, 0.03)
        )
        for s in (-1, 1)
    ]
    vat = [*sides, box((2 * half + 0.02, 2 * deep + 0.02, 0.003), (0, 0, 0.0015))]
    kit.add("tray", slide(UP, 0.03), [(moved(vat, (0, middle, low)), metal)])
    for s in (-1, 1) if dice.chance(0.7) else ():
        spot = np.array([s * (half + 0.036), middle, floor])
        screw = [
            cylinder(0.004, 0.02, 8) + [0, 0, 0.01],
            cylinder(0.012, 0.016, 12) + [0, 0, 0.028],
            box((0.02, 0.005, 0.012), (0, 0, 0.04)),
        ]
        kit.add("knob", turning(dice, spot, UP), [(moved(screw, spot), DARK)])


def _build_plate(
    dice: Dice,
    kit: Assembly,
    size: tuple[float, float, float],
    post: float,
    span: tuple[float, float],
    metal: Look,
) -> None:
    """A plate above the vat on an arm that climbs on a column, and the knob on top of it."""
    (half, deep, middle), (floor, tall) = size, span
    z = floor + dice.between(0.012, 0.5 * tall)
    plate = [
        box((2 * half, 2 * deep, 0.014), (0, middle, z)),
        box((0.05, 0.05, 0.03), (0, middle, z + 0.022)),
    ]
    plate += [
        between((-0.02, middle, z + 0.037), (0.02, post - 0.016, z + 0.057)),
        box((0.044, 0.012, 0.06), (0, post - 0.0225, z + 0.047)),
    ]
    plate += [boxes((0.008, 0.04, 0.05), [(s * 0.0305, post - 0.008, z + 0.047) for s in (-1, 1)])]
    plate.append(boxes((0.02, 0.01, 0.05), [(s * 0.025, post - 0.022, z + 0.047) for s in (-1, 1)]))
    arm = kit.add("plate", slide(UP, floor + tall - 0.11 - z, floor + 0.012 - z), [(plate, metal)])
    spot = np.array([0, middle, z + 0.057])
    knob = [
        cylinder(0.005, 0.008) + [0, 0, 0.004],
        cylinder(0.016, 0.018) + [0, 0, 0.017],
        *around([cylinder(0.005, 0.018, 6) + [0.015, 0, 0.017]], 6),
    ]
    kit.add("knob", turning(dice, spot, UP), [(moved(knob, spot), DARK)], arm)


def _cover(dice: Dice, kit: Assembly, size: tuple[float, float, float], floor: float, metal: Look) -> None:
    """A clear hood over all of it that tips back, or lifts off by a grip."""
    (x, y, tall), wall, clear = size, 0.006, looks.glass(dice)
    hood = [
        box((2 * x, 2 * y, wall), (0, 0, tall - wall / 2)),
        box((2 * x - 2 * wall, wall, tall - wall), (0, -y + wall / 2, (tall - wall) / 2)),
    ]
    hood += [box((wall, 2 * y, tall - wall), (s * (x - wall / 2), 0, (tall - wall) / 2)) for s in (-1, 1)]
    hood.append(box((2 * x - 2 * wall, wall, tall - wall), (0, y - wall / 2, (tall - wall) / 2)))
    hood = moved(hood, (0, 0, floor + 0.0015))
    if dice.chance(0.6):
        pins = [lying(0.006, 0.04) + [s * 0.6 * x, y + 0.005, floor + 0.006] for s in (-1, 1)]
        motion = hinge((0, y + 0.005, floor + 0.006), LEFT, dice.between(1.2, 1.6))
        kit.add("lid", motion, [(hood, clear), (pins, metal)])
    else:
        grip = [
            tube(
                [
                    (-0.05, 0, tall + floor),
                    (-0.05, 0, tall + floor + 0.03),
                    (0.05, 0, tall + floor + 0.03),
                    (0.05, 0, tall + floor),
                ],
                0.006,
            )
        ]
        kit.add("lid", slide(UP, tall + 0.05), [(hood, clear), (grip, DARK)])


def _resin_printer(dice: Dice) -> list[Body]:
    """A plate that an arm lifts out of a vat on a column, below a cover that tips back or lifts off."""
    kit, coat, metal = Assembly("base"), looks.painted_metal(dice), looks.metal(dice)
    x, y, floor, tall = (
        dice.between(0.1, 0.15),
        dice.between(0.1, 0.15),
        dice.between(0.12, 0.2),
        dice.between(0.22, 0.34),
    )
    kit.fix([box((2 * x, 2 * y, floor), (0, 0, floor / 2))], coat)
    post = y - 0.045
    kit.fix([box((0.05, 0.03, tall - 0.03), (0, post, floor + (tall - 0.03) / 2))], metal)
    size, deep = dice.between(0.5, 0.6) * x, dice.between(0.35, 0.45) * y
    middle = -0.25 * y
    _vat(dice, kit, (size, deep, middle), floor, metal)
    _build_plate(dice, kit, (size, deep, middle), post, (floor, tall), metal)
    _cover(dice, kit, (x, y, tall), floor, metal)
    _panel(dice, kit, np.array([0, -y, 0.5 * floor]))
    return kit.done()


def printer_3d(dice: Dice) -> list[Body]:
    """An open frame, a closed cube, or a resin printer."""
    return dice.weighted([(4, _open_printer), (4, _boxed_printer), (2, _resin_printer)])(dice)
