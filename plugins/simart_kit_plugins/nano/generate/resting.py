"""Sofas that become beds, and tables to lie on."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.legs import feet, four
from ...shapes.placing import Z, at, moved, pointed
from ...shapes.primitives import box, rod, torus
from . import looks
from .assembling import pull
from .category import Category
from .objects import Body, hinge, slide
from .rigging import LEFT, RIGHT, lying
from .upholstery import PLAIN, Made, add_lever, begun, grid, padding, paired

_GAP = 0.004


def _sofa_bed(dice: Dice) -> list[Body]:
    """A sofa whose back goes flat, and whose seat lifts, tips out or is drawn out; arms may fold down."""
    made, seats = begun(dice, "frame"), dice.whole(1, 3)
    kit, one = made.kit, dice.between(0.55, 0.8)
    wide, deep, arm = seats * one, dice.between(0.6, 0.85), dice.between(0.1, 0.22)
    base, rise = dice.between(0.16, 0.3), dice.between(0.03, 0.14)
    kit.fix(moved(feet(dice, wide, deep, rise), (0, 0, 0)), made.frame)
    out = made.cover if dice.chance(0.5) else looks.wood(dice)
    wall = 0.03
    kit.fix(grid(box((wall, deep, base)), np.array([-1, 1]) * (wide - wall) / 2, (0,), base / 2), out)
    kit.fix([box((wide - 2 * wall - _GAP, wall, base), (0, (deep - wall) / 2, base / 2))], out)
    kit.fix([box((wide - 2 * wall - _GAP, deep - wall - _GAP, 0.02), (0, -wall / 2, 0.012))], out)
    thick = dice.between(0.12, 0.2)
    _add_arms(made, wide + 2 * _GAP, deep, base, arm)
    split = seats if dice.chance(0.5) else 1
    tall = dice.between(0.42, 0.62)
    _add_backs(made, split, (wide, deep, base), (thick, tall))
    _add_seats(made, split, (wide, deep, base), thick)
    return kit.done()


def _add_arms(made: Made, wide: float, deep: float, base: float, arm: float) -> None:
    """Adds them beside the frame: upholstered ones that stay, ones that fold down outwards, or none."""
    dice, style = made.dice, made.dice.unit()
    if style < 0.2:
        return
    high = dice.between(0.2, 0.32)
    block = padding(dice, dice.pick(PLAIN), arm, deep, base + high)
    for s in (-1, 1):
        x = s * (wide + arm) / 2
        if style < 0.7:
            made.kit.fix(moved(block, (x, -deep / 2, 0)), made.cover)
            continue
        made.kit.fix([box((arm, 0.96 * deep, 0.6 * base), (x, 0, 0.3 * base))], made.cover)
        edge = np.array([s * (wide / 2 + arm), 0, base])
        pad = padding(dice, dice.pick(PLAIN), arm, 0.96 * deep, high)
        pin = lying(0.008, 0.9 * deep, 1, 8) + edge
        parts = [(moved(pad, (x, -0.48 * deep, base + _GAP)), made.cover), ([pin], made.frame)]
        made.kit.add("armrest", hinge(edge, (0, s, 0), dice.between(0.8, 1.5)), parts)


def _add_backs(made: Made, count: int, size: tuple[float, float, float], back: tuple[float, float]) -> None:
    """Adds the backs, which lean back until they lie flat behind the seat."""
    dice, (wide, deep, base), (thick, tall) = made.dice, size, back
    one, shown = wide / count, dice.chance(0.5)
    pad = padding(dice, made.style, one - 2 * _GAP, thick, tall)
    y, low = deep / 2, base + dice.between(0.03, 0.1)
    edge = y + 0.012
    for k in range(count):
        x = (k - (count - 1) / 2) * one
        parts = [(moved(pad, (x, y - thick, low)), made.cover)]
        if shown:
            lugs = grid(box((0.02, 0.02, 0.12)), (x - 0.3 * one, x + 0.3 * one), (y + 0.011,), low + 0.03)
            parts.append((lugs, made.frame))
            posts = grid(
                box((0.02, 0.022, base)), (x - 0.3 * one - 0.022, x + 0.3 * one + 0.022), (edge,), base / 2
            )
            made.kit.fix(posts, made.frame)
            made.kit.fix([lying(0.006, 0.75 * one, 0, 8) + [x, edge + 0.018, base - 0.006]], made.frame)
        made.kit.add("backrest", hinge((x, edge, low), LEFT, dice.between(0.7, 1.45)), parts)


def _add_seats(made: Made, count: int, size: tuple[float, float, float], thick: float) -> None:
    """Adds what lies before the back: lids over boxes, drawers below cushions, or leaves that fold out."""
    dice, (wide, deep, base) = made.dice, size
    one, long, style = wide / count, deep - thick - 0.03, dice.unit()
    cushion = padding(dice, made.style, one - 2 * _GAP, long, thick * 0.9)
    front = -deep / 2
    for k in range(count):
        x = (k - (count - 1) / 2) * one
        pad = moved(cushion, (x, front, base + _GAP))
        if style < 0.35:
            moves = hinge((x, front + long, base + _GAP), LEFT, dice.between(0.7, 1.1))
            made.kit.add("seat", moves, [(pad, made.cover)])
        elif style < 0.7 or k:
            made.kit.fix(pad, made.cover)
        else:
            moves = hinge((x, front, base + _GAP), RIGHT, dice.between(1.4, 2.6))
            hinges = grid(lying(0.008, 0.08, 0, 8), (x - one / 3, x + one / 3), (front - 0.009,), base + _GAP)
            made.kit.add("seat", moves, [(pad, made.cover), (hinges, made.frame)])
        if style < 0.7 or k == 0:
            _add_box(made, x, (one - 0.08 / count, deep, base), style >= 0.35)


def _add_box(made: Made, x: float, size: tuple[float, float, float], drawn: bool) -> None:
    """A front below a seat: of a drawer, or one that stays."""
    wide, deep, base = size
    face = box((wide, 0.025, base - 0.04), (x, -deep / 2 + 0.015, base / 2 + 0.012))
    if not drawn:
        made.kit.fix([face], made.hard)
        return
    tray = box((wide - 0.02, 0.7 * deep, 0.4 * base), (x, -0.12 * deep, 0.2 * base + 0.03))
    grip = made.dice.pick((0.0, 0.08, 0.14))
    parts = [([face, tray], made.hard)]
    if grip:
        parts.append(([box((grip, 0.02, 0.015), (x, -deep / 2 - 0.008, 0.6 * base))], made.frame))
    made.kit.add("drawer", pull(made.dice.between(0.4, 0.6) * deep), parts)


def _massage_table(dice: Dice) -> list[Body]:
    """A padded table on legs or a column: its back and leg sections tip, its face rest slides or tips."""
    made = begun(dice, "table")
    kit, wide, thick = made.kit, dice.between(0.55, 0.8), dice.between(0.05, 0.1)
    middle, back = dice.between(0.3, 0.7), dice.between(0.55, 0.8)
    legs = dice.pick((0.0, dice.between(0.4, 0.7)))
    high, rail = dice.between(0.5, 0.75), 0.045
    total = middle + back + legs
    stand = four(box((0.045, 0.045, high), (0, 0, -high / 2)), 0.8 * wide, max(0.7 * total, 0.6))
    if dice.chance(0.4):
        stand = [
            box((0.7 * wide, 0.8 * total, 0.05), (0, 0, 0.025 - high)),
            box((0.3, 0.4, high), (0, 0, -high / 2)),
        ]
    kit.fix(stand, made.frame)
    kit.fix(paired(box((0.03, total, rail), (0, 0, rail / 2)), 0.4 * wide), made.frame)
    deck, head = rail + 0.006, -total / 2
    kit.fix(
        moved(padding(dice, made.style, wide, middle - 2 * _GAP, thick), (0, head + legs + _GAP, deck)),
        made.cover,
    )
    kit.fix([box((0.7 * wide, middle, 0.004), (0, head + legs + middle / 2, rail + 0.002))], made.hard)
    joints = [(head + legs + middle, 1, back, "backrest"), (head + legs, -1, legs, "leg rest")]
    numbers = []
    for y, sense, long, label in joints:
        if not long:
            continue
        pad = padding(dice, made.style, wide, long - 2 * _GAP, thick)
        start = y + _GAP if sense > 0 else y - long + _GAP
        pin = np.array([0, y, deck - 0.012])
        board = box((0.7 * wide, long - 0.01, 0.006), (0, y + sense * long / 2, deck - 0.003))
        hubs = paired(lying(0.012, 0.03, 0, 10), 0.4 * wide - 0.04) if dice.chance(0.7) else []
        upper = dice.between(0.6, 1.3) if sense > 0 else dice.between(0.2, 0.5)
        parts = [
            (moved(pad, (0, start, deck)), made.cover),
            ([board], made.hard),
            (moved(hubs, pin), made.frame),
        ]
        moves = hinge(pin, RIGHT if sense > 0 else LEFT, upper)
        numbers.append(kit.add(label, moves, parts))
    _add_face_rest(made, numbers[0], (0, head + total, deck), wide)
    if dice.chance(0.4):
        add_lever(made, 0, np.array([0.4 * wide + 0.04, head + legs + middle / 2, rail / 2]), 1)
    if dice.chance(0.5):
        shelf = box((wide * 0.4, 0.2, 0.02), (0, total / 2 - 0.12, -0.2 * high))
        hang = at(
            box((0.012, 0.012, 0.2 * high)),
            [(s * 0.17 * wide, total / 2 - 0.12, -0.1 * high) for s in (-1, 1)],
        )
        kit.fix([shelf, *hang], made.frame)
    return kit.done()


def _add_face_rest(made: Made, parent: int, end: tuple[float, float, float], wide: float) -> None:
    """Adds a ring or a cushion at the end of the back section: on rods that slide, and that tip, or none."""
    dice, style = made.dice, made.dice.unit()
    if style < 0.2:
        return
    spot = np.array(end) + [0, 0.05, 0.02]
    ring = pointed(torus(0.11, 0.05, 20), Z) + spot + [0, 0.14, 0.01]
    pad = (
        [ring]
        if dice.chance(0.6)
        else moved(padding(dice, "soft", 0.45 * wide, 0.24, 0.06), spot + [0, 0.02, -0.01])
    )
    rods = [rod(spot + [s * 0.09, -0.25, -0.028], spot + [s * 0.09, 0.1, -0.028], 0.008, 8) for s in (-1, 1)]
    if style < 0.6:
        made.kit.add("headrest", slide((0, 1, 0), 0.12), [(pad, made.cover), (rods, made.frame)], parent)
        return
    pin = np.array(end) + [0, 0.02, -0.008]
    lugs = paired(box((0.012, 0.09, 0.012), (0, 0.04, -0.004)), 0.09)
    made.kit.fix([lying(0.01, 0.24, 0, 10) + pin], made.frame, parent)
    moves = hinge(pin, RIGHT, dice.between(0.3, 0.6), -dice.between(0.3, 0.6))
    made.kit.add("headrest", moves, [(pad, made.cover), (moved(lugs, pin), made.frame)], parent)


CATEGORIES: tuple[Category, ...] = (
    Category("sofa_bed", _sofa_bed),
    Category("massage_table", _massage_table),
)
