"""Things of two halves alike, and things that open like a book."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, at, moved, pointed
from ...shapes.primitives import Pieces, between, box, cylinder, loft, revolve, rod, vessel
from . import looks
from .assembling import Assembly, press
from .category import Category
from .objects import Body, Look, free, hinge, slide
from .rigging import lying

_FLIP = np.array([1, 1, -1])


def _half(dice: Dice, round_: float, size: tuple[float, float, float], wall: float) -> Pieces:
    """A shell that lies open upwards, its rim at z = 0."""
    wide, deep, high = size
    outline = rounded(round_, wide / deep) if round_ else SQUARE
    if dice.chance(0.3):
        low = dice.between(0.6, 0.9)
        hull = loft(
            outline,
            [(0, 0, -high), (low * wide, low * deep, -high), (wide, deep, -0.3 * high), (wide, deep, 0)],
        )
        return [
            hull,
            loft(
                outline, [(wide, deep, 0.0005), (0.9 * wide, 0.9 * deep, 0.0005), (0.9 * wide, 0.9 * deep, 0)]
            ),
        ]
    return [vessel(outline, (wide, deep, high), wall) + [0, 0, -high]]


def _compact_case(dice: Dice) -> list[Body]:
    """A cosmetic compact, a ring box, a spectacle case or a lunch box: two shells, a catch, a lining."""
    kit, coat = Assembly("case"), looks.plastic(dice) if dice.chance(0.6) else looks.metal(dice)
    wide = dice.spread(0.05, 0.26)
    deep = wide * dice.between(0.45, 1.0)
    high, wall = deep * dice.between(0.08, 0.4), 0.02 * deep
    round_ = dice.pick((0.0, 0.15, 0.3, 0.5))
    lower = _half(dice, round_, (wide, deep, high), wall)
    upper = [p * _FLIP for p in lower] if dice.chance(0.6) else None
    thin = dice.between(0.2, 0.7) * high
    if upper is None:
        upper = [p * [1, 1, -thin / high] for p in lower]
    upper = [piece[:, ::-1] for piece in upper]  # a mirror turns faces inside out
    gap = max(0.004 * deep, 0.0015)
    kit.fix(lower, coat)
    parts = [(moved(upper, (0, 0, gap)), coat if dice.chance(0.7) else looks.plastic(dice))]
    edge = deep / 2 + 0.02 * deep
    barrel, metal = 0.016 * deep, looks.metal(dice)
    out = 0.3 if round_ < 0.2 else 0.12  # a round shell recedes from its hinges
    spots = np.linspace(-out, out, dice.pick((2, 2, 3)) if round_ < 0.2 else 2) * wide
    if dice.chance(0.7):
        kit.fix([lying(barrel, 0.1 * wide, X, 10) + [x, edge, gap / 2] for x in spots], metal)
        ears = [lying(barrel, 0.05 * wide, X, 10) + [x + 0.08 * wide, edge, gap / 2] for x in spots]
        parts.append((ears, metal))
    if dice.chance(0.4):
        mirror = cylinder(0.35 * deep, 0.02 * deep, 20) + [0, 0, gap + 0.012 * deep]
        parts.append(([mirror], looks.glass(dice)))
    upper_limit = dice.pick((1.4, 1.6, 1.9, 3.0))
    lid = kit.add("lid", hinge((0, edge, gap / 2), (-1, 0, 0), upper_limit), parts)
    _add_catch(dice, kit, lid, (wide, deep, high), metal)
    return kit.done()


def _add_catch(dice: Dice, kit: Assembly, lid: int, size: tuple[float, float, float], metal: Look) -> None:
    """Adds a button in front, a tongue that swings down over the rim, or a handle that folds."""
    wide, deep, high = size
    style, front = dice.unit(), -deep / 2
    if style < 0.3:
        knob = box((0.12 * wide, 0.05 * deep, 0.3 * high), (0, front - 0.026 * deep, -0.3 * high))
        kit.add("button", press(0.02 * deep), [([knob], metal)])
    elif style < 0.65:
        pin = np.array([0, front - 0.02 * deep, 0.25 * high])
        tongue = [
            box((0.14 * wide, 0.014 * deep, 0.6 * high), (0, -0.016 * deep, -0.28 * high)),
            lying(0.012 * deep, 0.14 * wide),
        ]
        kit.add("latch", hinge(pin, (-1, 0, 0), 1.6), [(moved(tongue, pin), metal)], lid)
    elif style < 0.85:
        long, bar = 0.4 * wide, 0.03 * deep
        pins = [(s * long / 2, front - bar, -0.25 * high) for s in (-1, 1)]
        kit.fix(
            at(
                box((0.5 * bar, 1.6 * bar, bar)),
                [(x - np.sign(x) * bar, y + 0.2 * bar, z) for x, y, z in pins],
            ),
            metal,
        )
        reach = 0.25 * deep
        bow = [rod(p, (p[0], p[1] - reach, p[2]), 0.4 * bar, 8) for p in pins]
        bow.append(
            rod(
                (-long / 2, front - bar - reach, -0.25 * high),
                (long / 2, front - bar - reach, -0.25 * high),
                0.5 * bar,
                8,
            )
        )
        moves = hinge(pins[0], (1, 0, 0), 1.4, -1.4)
        kit.add("handle", moves, [(bow, looks.plastic(dice))])


def _book(dice: Dice) -> list[Body]:
    """A book or a ring binder that lies: leaves or rings, a cover that opens, and on it a flap."""
    kit, coat = Assembly("book"), looks.fabric(dice)
    wide, deep = dice.between(0.12, 0.3), dice.between(0.16, 0.34)
    thick, board = dice.between(0.015, 0.09), dice.between(0.002, 0.005)
    paper = Look("fabric", (240, 236, 224))
    spine, gap = -wide / 2, 0.0012
    kit.fix([box((wide, deep, board), (0, 0, board / 2))], coat)
    kit.fix([box((board, deep, thick - 2 * board - 2 * gap), (spine + board / 2, 0, thick / 2))], coat)
    ringed = dice.chance(0.5)
    if not ringed:
        block = between(
            (spine + board + gap, -0.48 * deep, board + gap), (0.48 * wide, 0.48 * deep, thick - board - gap)
        )
        kit.fix([block], paper)
    else:
        _add_rings(dice, kit, (spine + board, deep, thick - board), board)
    moves = hinge((spine + board / 2, 0, thick - board - gap / 2), (0, -1, 0), dice.pick((1.6, 2.6, 3.0)))
    lid = [box((wide, deep, board), (0, 0, thick - board / 2))]
    parts = [(lid, coat)]
    if dice.chance(0.4):
        x = wide / 2
        parts.append(
            (
                at(
                    box((0.02, 0.02, board + 0.001)),
                    [(x - 0.01, s * (deep / 2 - 0.01), thick - board / 2) for s in (-1, 1)],
                ),
                looks.metal(dice),
            )
        )
    cover = kit.add("cover", moves, parts)
    if dice.chance(0.45):
        pin = (wide / 2 + 0.001, 0, thick - board / 2)
        strap = between((wide / 2 + 0.001, -0.02, 0.2 * thick), (wide / 2 + 0.003, 0.02, thick - board / 2))
        tab = between((wide / 2 + 0.0005, -0.02, thick - board), (wide / 2 + 0.004, 0.02, thick))
        kit.add("flap", hinge(pin, (0, -1, 0), 1.6), [([strap, tab], looks.rubber(dice))], cover)
    return kit.done()


def _add_rings(dice: Dice, kit: Assembly, place: tuple[float, float, float], board: float) -> None:
    """Adds a rail with half rings that stay and others that open, and a lever at its end."""
    left, deep, top = place
    metal, tall = looks.metal(dice), top - board
    x, radius = left + 0.45 * tall, 0.36 * tall
    kit.fix(
        [between((left + 0.002, -0.42 * deep, board), (left + 0.9 * tall, 0.42 * deep, board + 0.08 * tall))],
        metal,
    )
    count = dice.pick((2, 3, 4))
    rows = np.linspace(-0.32, 0.32, count) * deep
    wire, low = 0.05 * tall, board + 0.12 * tall
    angles = np.linspace(0, 0.47 * np.pi, 7)
    for side, number in ((-1, 0), (1, 1)):
        arc = np.column_stack([side * radius * np.cos(angles), 0 * angles, 1.9 * radius * np.sin(angles)])
        rings = [rod(a, b, wire, 6) + [x, y, low] for y in rows for a, b in pairwise(arc)]
        bar = between(
            (x + side * radius - wire, rows[0], low - wire), (x + side * radius + wire, rows[-1], low + wire)
        )
        if number == 0:
            kit.fix([*rings, bar], metal)
        else:
            pin = (x + radius, 0, low)
            kit.add("ring", hinge(pin, (0, 1, 0), 0.7), [([*rings, bar], metal)])
    pivot = np.array([left + 0.45 * tall, -0.42 * deep, board + 0.1 * tall])
    arm = [
        box((0.1 * tall, 0.02 * deep, 0.7 * tall), (0, -0.011 * deep, 0.3 * tall)),
        lying(0.05 * tall, 0.14 * tall) + [0, -0.011 * deep, 0],
    ]
    kit.add("lever", hinge(pivot - [0, 0.011 * deep, 0], (1, 0, 0), 1.2), [(moved(arm, pivot), metal)])


def _pill_box(dice: Dice) -> list[Body]:
    """Rows of small cells, each with its own lid."""
    kit, coat = Assembly("box"), looks.plastic(dice)
    columns, rows = dice.whole(2, 7), dice.pick((1, 1, 2, 3, 4))
    cell = dice.spread(0.018, 0.07)
    deep = cell * dice.between(0.8, 1.6)
    high, wall = cell * dice.between(0.4, 1.0), 0.05 * cell
    wide, long = columns * cell, rows * deep
    kit.fix([box((wide + wall, long + wall, wall), (0, 0, wall / 2))], coat)
    xs, ys = (np.arange(columns + 1) - columns / 2) * cell, (np.arange(rows + 1) - rows / 2) * deep
    kit.fix(at(box((wall, long + wall, high - wall)), [(x, 0, (high + wall) / 2) for x in xs]), coat)
    kit.fix(
        at(
            box((cell - wall - 0.0004, wall, high - wall)),
            [((a + b) / 2, y, (high + wall) / 2) for y in ys for a, b in pairwise(xs)],
        ),
        coat,
    )
    own = coat if dice.chance(0.4) else looks.glass(dice) if dice.chance(0.5) else looks.plastic(dice)
    level, gap = high + 0.06 * wall, 0.03 * cell
    tongue, domed = dice.chance(0.7), dice.chance(0.3)
    for y in ys[:-1]:
        for x in xs[:-1]:
            spot = np.array([x + cell / 2, y + deep - gap, level])
            lid = [box((cell - gap, deep - 2 * gap, wall), (0, -deep / 2 + gap, wall / 2))]
            if domed:
                lid.append(
                    revolve(cell * np.array([[0, 0.24], [0.2, 0.18], [0.3, 0], [0, 0]]), 14)
                    + [0, -deep / 2, wall]
                )
            if tongue:
                lid.append(box((0.3 * cell, 0.1 * deep, 0.6 * wall), (0, -deep + 0.06 * deep, wall * 1.3)))
            moves = hinge(spot + [0, 0, wall / 2], (-1, 0, 0), dice.pick((1.5, 1.8)))
            kit.add("lid", moves, [(moved(lid, spot), own)])
    return kit.done()


def _tin(dice: Dice) -> list[Body]:
    """A flat tin or box: a lid that slides off along it or lies loose, or trays in a sleeve."""
    kit, coat = Assembly("box"), looks.painted_metal(dice) if dice.chance(0.5) else looks.wood(dice)
    wide = dice.spread(0.04, 0.3)
    deep, wall = wide * dice.between(0.35, 0.8), 0.025 * wide
    high = deep * dice.between(0.25, 0.8)
    if dice.chance(0.45):  # a sleeve with trays that come out to one side or to both
        faces = at(box((wide, deep, wall)), [(0, 0, wall / 2), (0, 0, high - wall / 2)])
        faces += at(
            box((wide, wall, high - 2 * wall)), [(0, s * (deep - wall) / 2, high / 2) for s in (-1, 1)]
        )
        kit.fix(faces, coat)
        count, gap, own = dice.pick((1, 1, 2)), 0.15 * wall, looks.plastic(dice)
        inner = (wide / count - gap, deep - 2 * wall - 2 * gap, high - 2 * wall - 2 * gap)
        for side in (-1, 1)[:count]:
            x = side * wide / 4 if count == 2 else 0.0
            tray = [vessel(SQUARE, inner, wall) + [x, 0, wall + gap]]
            if dice.chance(0.5):
                tray.append(
                    pointed(cylinder(0.1 * high, 0.08 * wide, 10), X)
                    + [x + side * (inner[0] / 2 + 0.03 * wide), 0, high / 2]
                )
            kit.add("tray", slide((side, 0, 0), 0.9 * inner[0]), [(tray, own)])
        return kit.done()
    kit.fix([vessel(SQUARE, (wide, deep, high), wall)], coat)
    gap, own = 0.12 * wall, coat if dice.chance(0.5) else looks.plastic(dice)
    level = high + gap + wall / 2
    if dice.chance(0.5):
        rails = at(
            box((wide, 0.7 * wall, 2.4 * wall)),
            [(0, s * (deep / 2 - 0.35 * wall), high + 1.2 * wall) for s in (-1, 1)],
        )
        kit.fix(rails, coat)
        lid = [box((wide, deep - 1.6 * wall, wall), (0, 0, level))]
        if dice.chance(0.6):
            lid.append(box((0.05 * wide, 0.4 * deep, 0.5 * wall), (0.4 * wide, 0, level + 0.7 * wall)))
        kit.add("lid", slide((1, 0, 0), 0.95 * wide), [(lid, own)])
    else:
        lid = [box((wide + 2.4 * wall, deep + 2.4 * wall, wall), (0, 0, level))]
        rim = 0.35 * high
        lid += at(
            box((wall, deep + 2.4 * wall, rim)),
            [(s * (wide / 2 + 0.7 * wall), 0, level - (rim + wall) / 2) for s in (-1, 1)],
        )
        lid += at(
            box((wide + 0.4 * wall, wall, rim)),
            [(0, s * (deep / 2 + 0.7 * wall), level - (rim + wall) / 2) for s in (-1, 1)],
        )
        kit.add("lid", free(), [(lid, own)])
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("compact_case", _compact_case),
    Category("book", _book),
    Category("pill_box", _pill_box),
    Category("tin", _tin),
)
