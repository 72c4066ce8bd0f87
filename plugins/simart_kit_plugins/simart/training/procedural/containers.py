"""Boxes with lids, suitcases, bins, baskets and laptops."""

from __future__ import annotations

import numpy as np

from ....shapes.dice import Dice
from ....shapes.handles import handle
from ....shapes.legs import wheel
from ....shapes.outlines import SQUARE, ngon, rounded
from ....shapes.placing import at, mirrored, moved, pointed, rotation, turned
from ....shapes.primitives import Pieces, between, box, boxes, loft, open_box, prism, rod, tube, vessel
from .devices import keys


def container(dice: Dice) -> list[Pieces]:
    """Something that opens."""
    return dice.weighted([(4, _chest), (2, _suitcase), (4, _bin), (3, _laptop), (1, _basket)])(dice)


def _chest(dice: Dice) -> list[Pieces]:
    """A box with a lid on a hinge, or lifted, or with two flaps."""
    width, depth, height = dice.between(0.3, 1.0), dice.between(0.2, 0.7), dice.between(0.1, 0.6)
    wall = max(width, depth) * dice.spread(0.006, 0.05)
    body: Pieces = [open_box((width, depth, height), wall)]
    body += _bands(dice, width, depth, height, wall)
    lid_high = dice.pick((wall, wall, dice.between(0.1, 0.4) * height))
    lid: Pieces = [box((width * 1.01, depth * 1.01, lid_high), (0, 0, lid_high / 2))]
    if lid_high > wall:
        lid = turned(
            [open_box((width, depth, lid_high), wall)], rotation((1, 0, 0), np.pi), (0, 0, lid_high / 2)
        )
    if dice.chance(0.5):
        lid += moved(handle(dice, width * dice.between(0.1, 0.3)), (0, -depth / 2, lid_high / 2))
    if dice.chance(0.15):
        half = box((width / 2, depth, wall), (width / 4, 0, wall / 2))
        wing = turned([half], rotation((0, 1, 0), dice.between(-0.2, 2.0)), (width / 2, 0, 0))
        return [body, *(moved(one, (0, 0, height)) for one in (wing, mirrored(wing)))]
    if dice.chance(0.55):
        lid = turned(lid, rotation((1, 0, 0), -dice.between(0.1, 2.2)), (0, depth / 2, 0))
    elif dice.chance(0.2):
        lid = moved(lid, (0, dice.between(0, 0.4) * depth, 0))
    return [body, moved(lid, (0, 0, height))]


def _bands(dice: Dice, width: float, depth: float, height: float, wall: float) -> Pieces:
    """Ribs, corner posts or hinges on the outside."""
    style = dice.unit()
    if style < 0.2:
        count = dice.whole(2, 6)
        xs = np.linspace(-width / 2, width / 2, count + 2)[1:-1]
        return at(box((wall, depth + 2 * wall, height * 0.9), (0, 0, height / 2)), [(x, 0, 0) for x in xs])
    if style < 0.35:
        spots = [(x * width / 2, y * depth / 2, height / 2) for x in (-1, 1) for y in (-1, 1)]
        return at(box((2 * wall, 2 * wall, height)), spots)
    if style < 0.6:
        barrel = rod((-0.05 * width, 0, 0), (0.05 * width, 0, 0), wall * 0.6)
        return at(barrel, [(s * width / 3, depth / 2 + wall / 2, height) for s in (-1, 1)])
    return []


def _suitcase(dice: Dice) -> list[Pieces]:
    """Two shells with ribs, a handle and wheels; open or shut."""
    width, height, depth = dice.between(0.35, 0.6), dice.between(0.45, 0.8), dice.between(0.18, 0.32)
    outline = rounded(dice.between(0.05, 0.2), width / height)
    shell = vessel(outline, (width, height, depth / 2), 0.008)
    half = turned([shell], rotation((1, 0, 0), -np.pi / 2))
    ribs = at(box((0.012, 0.012, height * 0.85)), [(x, 0, 0) for x in np.linspace(-0.35, 0.35, 6) * width])
    back = half + (ribs if dice.chance(0.5) else [])
    front = mirrored(moved(back, (0, -depth / 2, 0)), 1)
    back = moved(back, (0, -depth / 2, 0))
    if dice.chance(0.4):
        front = turned(front, rotation((0, 0, -1), dice.between(0.2, 3.0)), (-width / 2, 0, 0))
    roll = wheel(dice, 0.03)
    feet = [
        piece
        for part in roll
        for piece in at(part, [(s * width / 3, 0, -height / 2 - 0.03) for s in (-1, 1)])
    ]
    reach = dice.between(0.05, 0.4)
    x, top = width * 0.2, height / 2 + reach
    pull = [tube([(-x, 0, height / 2 - 0.1), (-x, 0, top), (x, 0, top), (x, 0, height / 2 - 0.1)], 0.012)]
    return [back, front, pull, feet]


def _bin(dice: Dice) -> list[Pieces]:
    """A trash can: flared or straight, with a lid, a pedal or a swing."""
    width = dice.between(0.2, 0.5)
    depth, height = width * dice.between(0.7, 1.2), dice.between(0.3, 0.9)
    outline = dice.pick((SQUARE, rounded(0.15), rounded(0.3), ngon(24), ngon(24)))
    wall, flare = dice.between(0.005, 0.02), dice.between(1.0, 1.25)
    body: Pieces = [vessel(outline, (width, depth, height), wall, flare)]
    wide, deep = width * flare, depth * flare
    if dice.chance(0.3):
        body.append(
            loft(
                outline,
                [(wide, deep, 0.97 * height), (1.06 * wide, 1.06 * deep, height), (wide, deep, height)],
            )
        )
    rise = dice.between(0.01, 0.15) * height
    inset = dice.between(0.5, 1.0)
    lid: Pieces = [
        loft(
            outline,
            [
                (0, 0, 0),
                (1.04 * wide, 1.04 * deep, 0),
                (wide, deep, rise * 0.6),
                (inset * wide, inset * deep, rise),
                (0, 0, rise),
            ],
        )
    ]
    if dice.chance(0.4):
        lid += moved(turned(handle(dice, 0.4 * wide), rotation((1, 0, 0), -np.pi / 2)), (0, 0, rise))
    if dice.chance(0.45):
        lid = turned(lid, rotation((1, 0, 0), -dice.between(0.1, 1.9)), (0, deep / 2, 0))
    parts = [body, moved(lid, (0, 0, height))]
    if dice.chance(0.35):
        pedal = box((0.3 * width, 0.25 * depth, 0.02), (0, -depth / 2 - 0.05, 0.04))
        parts.append([pedal, rod((0, -depth / 2, 0.04), (0, 0, 0.04), 0.01)])
    if dice.chance(0.3):
        tire = wheel(dice, 0.12 * height)
        spots = [(s * 0.5 * width, depth / 2, 0.1 * height) for s in (-1, 1)]
        sides = [pointed(piece, 2)[..., [1, 0, 2]] for piece in tire]
        parts.append([piece for side in sides for piece in at(side, spots)])
    return parts


def _laptop(dice: Dice) -> list[Pieces]:
    width, depth, thick = dice.between(0.28, 0.4), dice.between(0.2, 0.28), dice.between(0.01, 0.03)
    base: Pieces = [box((width, depth, thick), (0, 0, thick / 2))]
    parts = [base]
    pad = keys(dice, 0.92 * width, 0.5 * depth, dice.whole(3, 6), dice.whole(8, 14), 0.004)
    board = moved(pad, (0, 0.15 * depth, thick))
    if dice.chance(0.5):
        parts.append(board)
    else:
        base += board
    base.append(between((-0.15 * width, -0.45 * depth, thick), (0.15 * width, -0.15 * depth, thick + 0.001)))
    lid_thick = thick * dice.between(0.3, 0.8)
    lid: Pieces = [between((-width / 2, -depth / 2, 0), (width / 2, depth / 2, lid_thick))]
    if dice.chance(0.5):
        lid.append(open_box((width, depth, lid_thick * 1.2), 0.012) - [0, 0, lid_thick * 0.3])
    angle = dice.between(1.2, 2.3) if dice.chance(0.75) else dice.between(0.0, 0.5)
    lid = turned(moved(lid, (0, 0, thick)), rotation((1, 0, 0), -angle), (0, depth / 2, thick))
    barrel = rod((-0.35 * width, depth / 2, thick), (0.35 * width, depth / 2, thick), thick * 0.45)
    return [base, [*lid, barrel], *parts[1:]]


def _basket(dice: Dice) -> list[Pieces]:
    """A crate of slats or a tray with handles."""
    width, depth, height = dice.between(0.3, 0.7), dice.between(0.25, 0.5), dice.between(0.12, 0.4)
    thick, count = dice.between(0.008, 0.02), dice.whole(2, 5)
    step = height / count
    levels = [(k + 0.5) * step for k in range(count)]
    slat = step * dice.between(0.4, 0.9)
    body: Pieces = [boxes((width, thick, slat), [(0, s * depth / 2, z) for s in (-1, 1) for z in levels])]
    body.append(boxes((thick, depth, slat), [(s * width / 2, 0, z) for s in (-1, 1) for z in levels]))
    body.append(prism(SQUARE, (width, depth, thick)))
    grips = [
        moved(
            turned(handle(dice, 0.3 * depth), rotation((0, 0, 1), s * np.pi / 2)),
            (s * width / 2, 0, 0.8 * height),
        )
        for s in (-1, 1)
    ]
    return [body, *grips] if dice.chance(0.5) else [body, grips[0] + grips[1]]
