"""Seats whose backs, rests and arms tip, rise and slide."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, Y, at, moved, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, prism, revolve, rod, superquadric, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .fittings import sleeve_of
from .objects import Body, hinge, slide, spin
from .rigging import LEFT, RIGHT, UP, ball_knob, lying
from .upholstery import (
    HALF_TURN,
    PLAIN,
    Made,
    add_armrest,
    add_backrest,
    add_headrest,
    add_lever,
    begun,
    grid,
    padding,
    paired,
    room_to_tip,
)


def _car_seat(dice: Dice) -> list[Body]:
    """One to three seats on a turntable, on legs or, mostly, on rails."""
    made, total = begun(dice, "base"), dice.weighted([(5, 1), (1, 2), (1, 3)])
    wide, deep = dice.between(0.42, 0.54), dice.between(0.44, 0.54)
    tall, back, lean = dice.between(0.52, 0.72), dice.between(0.09, 0.13), dice.between(0.15, 0.35)
    pitch, start = wide + 0.07, -(total - 1) / 2
    seat, deck = _runners(made, total * pitch - 0.02, deep, dice.between(0.1, 0.24))
    rear, front = deep / 2 + 0.03, -deep / 2 - dice.between(0.0, 0.05)
    rise, thick, upper = dice.between(0.045, 0.1), dice.between(0.09, 0.14), dice.between(0.6, 1.1)
    arms = dice.pick(((), (-1,), (1,), (-1, 1))) if total == 1 else ()
    cushion = padding(dice, made.style, wide, rear - room_to_tip(made, back) - front, thick)
    for k in range(total):
        pin = np.array([(start + k) * pitch, rear, deck + rise])
        part = replace(made, kit=Assembly())
        number, own = add_backrest(part, 0, pin * [0, 1, 1], deck, (wide, tall, back), upper)
        part.kit.fix(moved(cushion, (0, front, deck)), made.cover)
        add_headrest(own, wide, tall, back)
        for s in arms:
            spot = np.array([s * (wide / 2 + 0.012), dice.between(0.22, 0.3), 0.0])
            add_armrest(own, 0, spot, s, rotation(RIGHT, lean - np.pi / 2), dice.between(0.26, 0.36))
        part.kit.graft(own.kit, pin * [0, 1, 1], rotation(RIGHT, np.pi / 2 - lean), number)
        made.kit.graft(part.kit, pin * [1, 0, 0], parent=seat)
    side = dice.sign()
    for k in range(dice.whole(1, 2)):
        at_side = (total * pitch - 0.02) / 2
        add_lever(made, seat, np.array([side * at_side, deep * (0.28 - 0.55 * k), deck - 0.025]), side)
    return made.kit.done()


def _runners(made: Made, wide: float, deep: float, rise: float) -> tuple[int, float]:
    """What a car seat stands or slides on, and its pan; gives its number and the height of the deck."""
    dice, kit, x, floor, parent = made.dice, made.kit, 0.38 * wide, 0.0, 0
    kind = dice.weighted([(6, "rails"), (2 if wide < 0.7 else 0, "turntable"), (1, "bolted")])
    pan = box((wide, deep, 0.05))
    feet = [(s * x, t * 0.4 * deep, 0.006) for s in (-1, 1) for t in (-1, 1)]
    if kind == "bolted":
        legs = at(box((0.04, 0.06, rise), (0, 0, rise / 2)), feet)
        kit.fix([*legs, *at(box((0.1, 0.1, 0.012)), feet), pan + [0, 0, rise + 0.025]], made.frame)
        return 0, rise + 0.05
    if kind == "turntable":
        tall, radius = dice.between(0.08, 0.2), 0.4 * min(wide, deep)
        kit.fix([prism(rounded(0.1), (1.8 * radius, 1.8 * radius, tall)) + [0, 0, tall / 2]], made.hard)
        kit.fix([cylinder(0.7 * radius, 0.02, 20) + [0, 0, tall + 0.01]], made.frame)
        disc = cylinder(radius, 0.015, 24) + [0, 0, tall + 0.03]
        parent = kit.add("turntable", spin((0, 0, tall), UP), [([disc], made.frame)])
        x, floor, rise = 0.8 * radius, tall + 0.036, 0.06
    travel = dice.between(0.08, 0.14)
    long, shoe = deep + 0.08, deep + 0.06 - 2 * travel
    rail = [box((0.05, long, 0.016), (0, 0, floor + 0.008))]
    rail += paired(box((0.007, long, 0.024), (0, 0, floor + 0.022)), 0.022)
    kit.fix([one for piece in rail for one in paired(piece, x)], made.frame, parent)
    webs = paired(box((0.012, shoe * dice.between(0.5, 1.0), rise), (0, 0, floor + 0.03 + rise / 2)), x)
    webs += paired(box((0.034, shoe, 0.03), (0, 0, floor + 0.034)), x)
    parts = [(webs, made.frame), ([pan + [0, 0, floor + rise + 0.05]], made.hard)]
    seat = kit.add("seat", slide((0, -1, 0), travel, -travel), parts, parent)
    half, rear, tip, z = x - 0.05, -0.12 * deep, -deep / 2 - dice.between(0.03, 0.07), floor + rise - 0.002
    kit.fix(paired(box((0.008, 0.03, 0.05), (0, rear, z + 0.01)), half + 0.014), made.frame, seat)
    path = [(-half, rear, z), (-half, tip + 0.01, z), (0.01 - half, tip, z)]
    grip = tube([*path, *((-a, b, c) for a, b, c in path[::-1])], 0.006, 8)
    pins = paired(lying(0.008, 0.05, X, 10) + [0, rear, z], half + 0.008)
    kit.add("bar", hinge((0, rear, z), LEFT, 0.02 / (rear - tip)), [([grip, *pins], made.frame)], seat)
    return seat, floor + rise + 0.075


def _lounge(made: Made, dental: bool) -> tuple[int, float, float]:
    """A seat with all that tips, on a piston in a sleeve; gives its number, half width and height."""
    dice, kit, top, post = made.dice, made.kit, made.dice.between(0.28, 0.4), made.dice.between(0.05, 0.09)
    sleeve, swell = top * dice.between(0.55, 0.8), post * dice.pick((1.0, 1.0, 1.6))
    tower = revolve([(0, 0.02), (swell, 0.03), (post, 0.1), (post, sleeve), (0, sleeve)], 20)
    square = prism(rounded(0.1), (2 * post, 2 * post, sleeve)) + [0, 0, sleeve / 2]
    kit.fix([square if dice.chance(0.3) else tower], made.hard)
    stem = [rod((0, 0, 0.055), (0, 0, top), 0.72 * post, 16), cylinder(0.11, 0.018, 24) + [0, 0, top]]
    seat = kit.add("column", slide(UP, 0.8 * sleeve - 0.05), [(stem, made.frame)])
    if not dental or dice.chance(0.3):
        seat = kit.add("seat", spin((0, 0, top), UP), [], seat)
    kit.fix([cylinder(0.13, 0.05, 24) + [0, 0, top + 0.036]], made.hard, seat)
    wide, deep, deck = dice.between(0.44, 0.56), dice.between(0.42, 0.52), top + 0.11
    front, pin = -deep / 2, np.array([0, deep / 2 + 0.02, deck + dice.between(0.06, 0.1)])
    size = (wide - 0.02, dice.between(0.44, 0.62) + 0.1 * dental, dice.between(0.07, 0.11))
    kit.fix([box((wide + 0.05, deep, 0.05), (0, 0, deck - 0.025))], made.frame, seat)
    long = pin[1] - room_to_tip(made, size[2]) - front
    pad = padding(dice, made.style, wide, long, dice.between(0.08, 0.13))
    kit.fix(moved(pad, (0, front, deck)), made.cover, seat)
    number, own = add_backrest(made, seat, pin, deck, size, dice.between(0.5, 0.9))
    if dental or dice.chance(0.75):
        add_headrest(own, *size, paddle=dice.chance(0.8 if dental else 0.2))
    lean = dice.between(0.1, 0.3) + 0.3 * dental
    kit.graft(own.kit, pin, rotation(RIGHT, np.pi / 2 - lean), number)
    kind = dice.weighted([(2, "fixed"), (3, "tips"), (3 if dental else 1, "swings")])
    for s in (-1, 1):
        _stand_arm(made, seat, np.array([s * (wide / 2 + 0.08), deep / 2 - 0.06, deck]), s, kind)
    if dental or dice.chance(0.4):
        _leg_rest(made, seat, np.array([0, front - 0.03, deck - 0.02]), 0.9 * wide, 0.7 if dental else 0.2)
    else:
        _footrest(made, seat, np.array([0.25 * wide, front, deck - 0.05]))
    return seat, wide / 2 + 0.025, deck


def _stand_arm(made: Made, seat: int, spot: FloatArray, side: int, kind: str) -> None:
    """Beside a seat: fixed on two posts, on a bolt about which it tips, or on a post about which it turns."""
    dice, long, rise = made.dice, made.dice.between(0.3, 0.4), made.dice.between(0.17, 0.22)
    foot = [box((0.028, 0.05, rise), (0, 0, rise / 2)), box((0.1, 0.05, 0.03), (-side * 0.04, 0, -0.01))]
    pad = turned(padding(dice, dice.pick(PLAIN), 0.07, long, 0.04), HALF_TURN)
    pad = moved(pad, spot + [0, 0.03, rise - 0.004])
    if kind == "tips":
        add_armrest(made, seat, spot + [side * 0.014, 0, rise - 0.04], side, np.eye(3), long)
    elif kind == "fixed":
        made.kit.fix(pad, made.cover, seat)
        foot += moved(foot, (0, -0.5 * long, 0))
    else:
        foot[0] = rod((0, 0, -0.03), (0, 0, rise - 0.03), 0.015, 12)
        collar = sleeve_of(0.017, 0.026, 0.09, 14) + spot + [0, 0, rise - 0.09]
        moves = hinge(spot, (0, 0, side), dice.between(1.1, 1.6))
        made.kit.add("armrest", moves, [(pad, made.cover), ([collar], made.frame)], seat)
    made.kit.fix(moved(foot, spot), made.frame, seat)


def _leg_rest(made: Made, seat: int, pin: FloatArray, wide: float, slope: float) -> None:
    """A leg rest below the seat's front edge, on a barrel between lugs; it leans by up to `slope`.

    Some have a plate that slides out of them.
    """
    dice, own = made.dice, Assembly()
    long, thick, slope = dice.between(0.25, 0.3), dice.between(0.05, 0.09), slope * dice.unit()
    style = dice.pick((*PLAIN, "rolls", "split"))
    own.fix(moved(padding(dice, style, wide, long, thick), (0, 0.022, 0.006)), made.cover)
    own.fix([lying(0.013, 0.6 * wide), *paired(box((0.03, 0.16, 0.01), (0, 0.08, 0)), wide / 5)], made.frame)
    if dice.chance(0.6):
        plate = box((0.8 * wide, 0.014, dice.between(0.06, 0.12)), (0, long + 0.04, 0.02))
        rods = paired(rod((0, 0.6 * long, -0.004), (0, long + 0.036, -0.004), 0.007, 8), 0.3 * wide)
        own.add("footrest", slide((0, 1, 0), dice.between(0.04, 0.07)), [([plate, *rods], made.frame)])
    lugs = paired(box((0.016, 0.05, 0.03), (0, 0.016, 0)), 0.34 * wide)
    made.kit.fix(moved([*lugs, lying(0.007, 0.72 * wide, X, 10)], pin), made.frame, seat)
    number = made.kit.add("leg rest", hinge(pin, LEFT, 1.5 - slope, -0.8 * slope), [], seat)
    down = rotation((0, 1, -1), np.pi)  # what lies hangs, its top face to -y
    made.kit.graft(own, pin, rotation(LEFT, slope) @ down, number)


def _footrest(made: Made, seat: int, spot: FloatArray) -> None:
    """A plate that tips about a rod between two irons before the seat."""
    (x, front, high), step = spot, made.dice.between(0.1, 0.16)
    end = np.array([0, front - made.dice.between(0.18, 0.26), made.dice.between(0.17, 0.22)])
    path = np.array([(0, front + 0.1, high), (0, front - 0.08, high - 0.02), end])
    irons = paired(tube(path, 0.011, 8), x)
    made.kit.fix([*irons, lying(0.007, 2 * x) + end], made.frame, seat)
    plate = [box((2 * x - 0.05, step, 0.014), (0, -0.5 * step - 0.01, 0)), lying(0.014, 2 * x - 0.03)]
    parts = [(moved(turned(plate, rotation(LEFT, 0.3)), end), made.frame)]
    made.kit.add("footrest", hinge(end, LEFT, 1.1), parts, seat)


def _pedal(made: Made, pin: FloatArray, turn: FloatArray, reach: float, label: str = "pedal") -> None:
    """A tread, or a bar with a grip, that is pressed down; it stands off to -y unless turned."""
    long = reach > 0.12
    pieces, grip = [lying(0.011, 0.08, X, 10)], box((0.06, reach, 0.012), (0, -reach / 2 - 0.005, 0))
    if long:
        pieces = [lying(0.018, 0.034), rod((0, 0, 0), (0, -reach, 0), 0.009, 8)]
        round_grip = superquadric((0.06, 0.09, 0.025), 0.4, 0.5, 6)
        grip = (ball_knob(0.024) if made.dice.chance(0.5) else round_grip) - [0, reach, 0]
    pieces = moved(turned([*pieces, grip], turn @ rotation(LEFT, 0.35 if long else 0.15)), pin)
    moves = hinge(pin, turn @ np.array(RIGHT), made.dice.between(0.2, 0.3))
    made.kit.add(label, moves, [(pieces, made.frame)])


def _barber_chair(dice: Dice) -> list[Body]:
    """On a round or square plate, pumped up by a lever; the seat swivels."""
    made, radius, side = begun(dice, "base"), dice.between(0.27, 0.36), dice.sign()
    dome = [(0, 0), (radius, 0), (radius, 0.012), (0.5 * radius, 0.04), (0, 0.05)]
    plate = prism(rounded(dice.between(0.01, 0.3)), (1.8 * radius, 1.8 * radius, 0.03)) + [0, 0, 0.015]
    made.kit.fix([revolve(dome, 28) if dice.chance(0.65) else plate], made.frame)
    seat, half, deck = _lounge(made, dental=False)
    pin = np.array([side * 0.14, 0, 0.12])
    pump = [box((0.11, 0.06, 0.06), pin - [side * 0.075, 0, 0]), lying(0.01, 0.08, X, 10) + pin]
    made.kit.fix(pump, made.hard)
    turn = rotation(UP, dice.pick((0, np.pi)))
    _pedal(made, pin, turn, dice.between(0.2, 0.32), "lever")
    side = dice.sign()
    add_lever(made, seat, np.array([side * half, -0.12, deck - 0.025]), side)
    return made.kit.done()


def _dentist_chair(dice: Dice) -> list[Body]:
    """On a long foot with pedals and a post, from which a lamp and some trays reach out in joints."""
    made, wide, long = begun(dice, "base"), dice.between(0.36, 0.5), dice.between(0.6, 0.9)
    plate = prism(rounded(dice.between(0.02, 0.4), wide / long), (wide, long, 0.04)) + [0, 0.05, 0.02]
    made.kit.fix([plate], made.hard)
    _lounge(made, dental=True)
    for x in np.arange(-1, 2)[: dice.whole(1, 3)] * 0.11:
        pin = np.array([x, 0.03 - long / 2, 0.045])
        made.kit.fix([box((0.07, 0.03, 0.05), pin + [0, 0.02, -0.02])], made.frame)
        _pedal(made, pin, np.eye(3), 0.1)
    side, high = dice.sign(), dice.between(1.7, 1.95)
    foot = np.array([side * dice.between(0.66, 0.76), dice.between(0.3, 0.4), 0])
    beam = box((abs(foot[0]) + 0.1, 0.14, 0.035), foot * [0.5, 1, 0] + [0, 0, 0.0175])
    made.kit.fix([beam, rod(foot, foot + [0, 0, high + 0.05], dice.between(0.018, 0.026), 14)], made.frame)
    if dice.chance(0.4):  # the unit with the bowl, around the post
        bowl = revolve([(0, 0), (0.06, 0), (0.12, 0.07), (0.11, 0.07), (0.05, 0.012), (0, 0.012)], 20)
        unit = prism(rounded(0.15), (0.26, 0.3, 0.75)) + [0, 0, 0.4]
        made.kit.fix(moved([unit, bowl + [0, -0.16, 0.78]], foot), looks.ceramic(dice))
    _lamp(made, foot + [0, 0, high], side)
    if dice.chance(0.6):
        _tray(made, foot + [0, 0, dice.between(1.15, 1.25)], side)
    return made.kit.done()


def _arm_on_post(top: FloatArray, end: FloatArray) -> Pieces:
    """An arm from a collar around a post."""
    collar = sleeve_of(0.028, 0.042, 0.07, 16) + top - [0, 0, 0.035]
    return [collar, rod(top + 0.1 * (end - top), end - 0.012 * (end - top), 0.016, 10)]


def _tray(made: Made, top: FloatArray, side: int) -> None:
    """A tray that turns on the end of an arm that turns about a post."""
    end, wide, deep = top - [0, 0.35, 0], made.dice.between(0.26, 0.4), made.dice.between(0.2, 0.28)
    arm = [*_arm_on_post(top, end), cylinder(0.03, 0.05, 14) + end]
    number = made.kit.add("arm", hinge(top, (0, 0, -side), 0.7, -0.4), [(arm, made.hard)])
    rim = grid(box((wide, 0.01, 0.028)), (0,), (-deep / 2, deep / 2))
    rim += paired(box((0.01, deep, 0.03)), wide / 2)
    tray = moved([box((wide, deep, 0.01)), *rim], (0, -0.06, 0.05))
    tray.append(cylinder(0.024, 0.025, 14) + [0, 0, 0.039])
    made.kit.add("tray", hinge(end, UP, 1.2, -1.2), [(moved(tray, end), made.frame)], number)


def _lamp(made: Made, top: FloatArray, side: int) -> None:
    """An arm that turns about a post, another that tips between cheeks, and a head that tips below it."""
    dice, kit, end = made.dice, made.kit, top - [side * made.dice.between(0.28, 0.45), 0, 0]
    turn, drop, axis = dice.between(0.6, 1.2), dice.between(0.2, 0.6), (0, side, 0)
    cheeks = grid(box((0.06, 0.008, 0.05)), (0,), (-0.026, 0.026))
    arm = [*_arm_on_post(top, end), *moved(cheeks, end)]
    number = kit.add("arm", hinge(top, UP, turn, -turn), [(arm, made.hard)])
    tip = dice.between(0.25, 0.4) * np.array([-side * np.cos(drop), 0, -np.sin(drop)])
    other = [rod((0, 0, 0), tip, 0.013, 10), lying(0.02, 0.04, Y), lying(0.008, 0.09, Y, 8)]
    other += moved([lying(0.017, 0.03, Y, 12), lying(0.006, 0.1, Y, 8)], tip)
    number = kit.add("arm", hinge(end, axis, 0.4, -0.3), [(moved(other, end), made.frame)], number)
    wide = dice.between(0.08, 0.14)
    shade = revolve([(0, 0), (0.4 * wide, 0), (wide, -0.06), (0.93 * wide, -0.06), (0, -0.02)], 22)
    slab = prism(rounded(0.2), (1.5 * wide, dice.between(0.18, 0.3), 0.05)) - [0, 0, 0.025]
    head = [shade if dice.chance(0.5) else slab, rod((0, -0.2, -0.03), (0, 0.2, -0.03), 0.009, 8)]
    head += grid(box((0.03, 0.008, 0.09)), (0,), (-0.03, 0.03), 0.04)
    place = end + tip
    kit.add("head", hinge(place, axis, 0.6, -0.6), [(moved(head, place - [0, 0, 0.075]), made.hard)], number)


CATEGORIES: tuple[Category, ...] = (
    Category("car_seat", _car_seat),
    Category("dentist_chair", _dentist_chair),
    Category("barber_chair", _barber_chair),
)
