"""Beds whose lying surface rises and whose sections tip."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, Y, corners, moved, pointed, rotation, turned
from ...shapes.primitives import between, box, cylinder, prism, rod, tube
from . import looks
from .category import Category
from .fittings import sleeve_of
from .objects import Body, hinge, slide, spin
from .rigging import LEFT, RIGHT, UP, caster_hub, caster_wheel, fork, lying
from .upholstery import PLAIN, Made, begun, grid, padding, paired


def _hospital_bed(dice: Dice) -> list[Body]:
    """On casters or feet; the lying surface rises on columns and its sections tip."""
    made, wide, long = begun(dice, "frame"), dice.between(0.62, 0.92), dice.between(1.85, 2.1)
    kit, radius, level, top = made.kit, dice.between(0.045, 0.07), dice.between(0.5, 0.64), 0
    base, x, y = 2.25 * radius + 0.03, 0.36 * wide, 0.4 * long
    cross = grid(box((2 * x, 0.04, 0.036)), (0,), (-y, -0.15 * long, 0.15 * long, y), base)
    kit.fix([*paired(box((0.04, 2 * y + 0.04, 0.04), (0, 0, base)), x), *cross], made.frame)
    rolls, every = dice.chance(0.75), dice.pick((1, 2, 9))
    for n, spot in enumerate(corners(2 * x, 2 * y, base - 0.03), 1):
        if rolls:
            _caster(made, spot, radius, n % every == 0)
        else:
            kit.fix([box((0.05, 0.05, base), spot * [1, 1, 0.5])], made.frame)
    tall, thick, outline = level - base - 0.05, dice.between(0.09, 0.13), rounded(dice.pick((0.1, 0.5)))
    places = (-0.15 * long, 0.15 * long)
    if dice.chance(0.85):
        sleeve = prism(outline, (thick, thick, 0.7 * tall))
        kit.fix(grid(sleeve, (0,), places, base + 0.35 * tall), made.hard)
        piston = prism(outline, (0.7 * thick, 0.7 * thick, 0.9 * tall))
        parts = [(grid(piston, (0,), places, level - 0.05 - 0.45 * tall), made.frame)]
        top = kit.add("lying surface", slide(UP, 0.6 * tall), parts)
    else:
        kit.fix(grid(cylinder(0.02, tall + 0.02), (-x, x), (-y, y), base + tall / 2 + 0.01), made.frame)
    rim = paired(box((0.03, long, 0.04), (0, 0, level - 0.024)), wide / 2 + 0.02)
    across = np.array([0.5 * long - 0.02, 0.4 * long, 0.15 * long])
    rim += grid(box((wide + 0.03, 0.04, 0.036)), (0,), [*across, *-across], level - 0.024)
    kit.fix(rim, made.frame, top)
    moving = _sections(made, top, wide, long, level)
    _boards(made, top, wide, long, level)
    _rails(made, top, wide / 2 + 0.07, long, level - 0.02)
    if dice.chance(0.6):
        reach = dice.between(0.08, 0.13)
        stub, grip = rod((0, 0.03, 0), (0, -0.01, 0), 0.009, 8), rod((0, 0, 0), (0, -0.09, 0), 0.013, 10)
        crank = [stub, grip - [0, 0, reach], box((0.02, 0.012, reach), (0, -0.005, -reach / 2))]
        for k in range(moving):
            pin = np.array([0.2 * k - 0.1, -long / 2 - 0.1, level - 0.05])
            kit.fix([box((0.05, 0.08, 0.04), pin + [0, 0.06, 0])], made.frame, top)
            kit.add("crank", spin(pin, (0, 1, 0)), [(moved(crank, pin), made.hard)], top)
    return kit.done()


def _caster(made: Made, spot: FloatArray, radius: float, brakes: bool) -> None:
    """Below a spot: it turns, its wheel rolls, and a pedal before it brakes."""
    yaw, thick = rotation(UP, made.dice.between(0, 2 * np.pi)), radius * 0.6
    made.kit.fix([cylinder(0.35 * radius, 0.021, 12) + spot + [0, 0, 0.0115]], made.frame)
    holder = moved(turned(fork(radius, thick), yaw), spot)
    number = made.kit.add("caster", spin(spot, UP), [(holder, made.hard)])
    hub = yaw @ caster_hub(radius) + spot
    tyre = moved(turned(caster_wheel(radius, thick), yaw), hub)
    made.kit.add("wheel", spin(hub, yaw @ RIGHT), [(tyre, looks.rubber(made.dice))], number)
    if brakes:
        pin = yaw @ np.array([0, -0.42 * radius, -0.12 * radius]) + spot
        pedal = [box((0.9 * thick, 0.8 * radius, 0.12 * radius), (0, -0.4 * radius, 0))]
        pedal.append(lying(0.12 * radius, 1.2 * thick))
        parts = [(moved(turned(pedal, yaw), pin), made.frame)]
        made.kit.add("brake", hinge(pin, yaw @ RIGHT, 0.3), parts, number)


def _sections(made: Made, top: int, wide: float, long: float, level: float) -> int:
    """Boards or slats, most with pads, of which the head's and mostly the legs' tip up; gives how many."""
    dice, kit, slab = made.dice, made.kit, 0.025
    thick = dice.between(0.05, 0.12) if dice.chance(0.7) else 0.0
    pin, angle = level + (slab + 0.35 * thick if thick else slab / 2), dice.between(0.8, 1.15)
    room = max(level + slab + thick - pin, 0.01) * np.tan(angle / 2) + 0.004  # for the pads' upper edges
    folds = [-long / 2, dice.between(-0.18, -0.05) * long, dice.between(0.08, 0.16) * long, long / 2]
    numbers = [top, top, top]
    moves = [(2, folds[2], RIGHT, angle), (0, folds[1], LEFT, dice.between(0.3, 0.7))]
    moves = moves[: dice.weighted([(1, 1), (2, 2)])]
    for k, y, axis, upper in moves:
        numbers[k] = kit.add("backrest" if k else "leg rest", hinge((0, y, pin), axis, upper), [], top)
        for to, x, away in ((top, wide / 2 + 0.006, 1 - k), (numbers[k], wide / 2 + 0.017, k - 1)):
            plate = box((0.008, 0.14, 0.022), (0, y + 0.07 * away, level + 0.0145))
            ear = between((-0.004, y - 0.015, level + 0.004), (0.004, y + 0.015, pin + 0.013))
            kit.fix([*paired(plate, x), *paired(ear, x)], made.frame, to)
        kit.fix(paired(lying(0.011, 0.03, X, 12) + [0, y, pin], wide / 2 + 0.016), made.frame, top)
    style, slats = dice.pick((*PLAIN, "channels")), not thick and dice.chance(0.6)
    for k, number in enumerate(numbers):
        low, high, z = folds[k] + 0.004, folds[k + 1] - 0.004, level + slab / 2
        boards = [between((-wide / 2, low, level), (wide / 2, high, level + slab))]
        if slats:
            boards = grid(box((wide, 0.05, slab)), (0,), np.arange(low + 0.025, high - 0.02, 0.08), z)
            boards += paired(box((0.03, high - low, slab - 0.004), (0, (low + high) / 2, z)), 0.4 * wide)
        kit.fix(boards, made.hard, number)
        if thick:
            start, stop = folds[k] + (room if k else 0), folds[k + 1] - (room if k < 2 else 0)
            pad = padding(dice, style, wide - 0.02, stop - start, thick)
            kit.fix(moved(pad, (0, start, level + slab)), made.cover, number)
    return len(moves)


def _boards(made: Made, top: int, wide: float, long: float, level: float) -> None:
    """At head and foot, solid or bows; some stand on pegs in sockets and can be pulled out."""
    dice, bows, lifts, x = made.dice, made.dice.chance(0.5), made.dice.chance(0.35), 0.4 * wide
    along, power, bars = np.linspace(-1, 1, 13), dice.pick((4, 8, 14)), dice.whole(0, 3)
    for s in (-1, 1):
        high, spot = dice.between(0.25, 0.4), np.array([0, s * (long / 2 + 0.03), level])
        panel = prism(rounded(dice.between(0.02, 0.2), high / wide), (high, wide, 0.025))
        pieces = [pointed(panel, Y) + [0, 0, 0.04 + high / 2]]
        if bows:
            arch = 0.03 + high * (1 - np.abs(along) ** power)
            pieces = [tube(np.column_stack([along * (wide / 2 - 0.02), 0 * along, arch]), 0.014, 10)]
            pieces += [lying(0.009, 0.84 * wide) + [0, 0, 0.18 * high * (k + 1)] for k in range(bars)]
        pegs = paired(rod((0, 0, -0.06), (0, 0, 0.05 + 0.15 * high), 0.01, 8), x)
        sockets = paired(sleeve_of(0.0115, 0.02, 0.07, 12) - [0, 0, 0.05], x)
        arms = paired(box((0.05, 0.03, 0.03), (0, -s * 0.035, -0.024)), x)
        made.kit.fix(moved([*arms, *(sockets if lifts else pegs)], spot), made.frame, top)
        if lifts:
            made.kit.add("board", slide(UP, 0.12), [(moved([*pieces, *pegs], spot), made.hard)], top)
        else:
            made.kit.fix(moved(pieces, spot), made.hard, top)


def _rails(made: Made, top: int, x: float, long: float, z: float) -> None:
    """Along the sides: fences on barrels that fold down and out, or on posts that sink in sleeves."""
    dice, drops, high = made.dice, made.dice.chance(0.35), made.dice.between(0.26, 0.36)
    spans = dice.pick((((-0.1, 0.42),), ((-0.35, 0.4),), ((-0.3, 0.05), (0.14, 0.45)), ((-0.3, 0.02),)))
    kind, bars = dice.pick(("upright", "level", "solid")), dice.whole(2, 7)
    for low, end in spans:
        half = (end - low) / 2 * long
        ys = np.linspace(0.012 - half, half - 0.012, 2 + (bars if kind == "upright" else 0))
        fence = [*grid(cylinder(0.008, high, 8), (0,), ys, high / 2), lying(0.012, 2 * half, Y, 10)]
        fence.append(lying(0.014, 2 * half, Y, 10) + [0, 0, high])
        if kind == "level":
            fence += [lying(0.009, 2 * half, Y, 8) + [0, 0, high * k / bars] for k in range(1, bars)]
        if kind == "solid":
            fence.append(box((0.02, 2 * half - 0.06, high - 0.08), (0, 0, high / 2)))
        feet = (-0.6 * half, 0.6 * half)
        for s in (-1, 1):
            spot = np.array([s * x, (low + end) / 2 * long, z])
            grips = grid(box((0.03, 0.03, 0.03)), (-0.028 * s,), feet)
            moves = hinge(spot, (0, s, 0), dice.between(2.4, 2.9))
            pieces = [*fence]
            if drops:
                grips += grid(sleeve_of(0.0115, 0.02, 0.1, 12), (0,), feet, -0.08)
                pieces = [*moved(fence, (0, 0, 0.18)), *grid(cylinder(0.01, 0.36, 8), (0,), feet, 0.02)]
                moves = slide((0, 0, -1), 0.15)
            else:
                grips += grid(pointed(sleeve_of(0.0135, 0.02, 0.03, 12), Y), (0,), feet)
            made.kit.fix(moved(grips, spot), made.frame, top)
            made.kit.add("rail", moves, [(moved(pieces, spot), made.frame)], top)


CATEGORIES: tuple[Category, ...] = (Category("hospital_bed", _hospital_bed),)
