"""Tables, desks, chairs, stools, sofas and beds; most stand on z = 0."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.fronts import front
from ....shapes.legs import feet, star_base, wheels
from ....shapes.outlines import SQUARE, ngon, rounded
from ....shapes.placing import at, mirrored, moved, rotation, turned
from ....shapes.primitives import Pieces, between, box, boxes, cylinder, prism, rod, sheet, superquadric, tube
from .leaves import Opening, Style, door, drawer


def table(dice: Dice) -> list[Pieces]:
    """Top and legs, and on some drawers, a shelf or casters."""
    width, depth, height = dice.between(0.4, 1.8), dice.between(0.35, 0.9), dice.between(0.35, 1.0)
    thick = dice.between(0.015, 0.06)
    outline, inset = _outline(dice, width / depth)
    top: Pieces = [prism(outline, (width, depth, thick)) + [0, 0, height - thick / 2]]
    if dice.chance(0.2):
        post = between((-0.05, -0.05, 0.08), (0.05, 0.05, height - thick))
        base = moved(star_base(dice, 0.4 * min(width, depth) + 0.1, 0.1), (0, 0, 0.1))
        return [top, [post, *base]] if dice.chance(0.5) else [[*top, post, *base]]
    wide, deep, under = width * inset, depth * inset, height - thick
    legs = moved(feet(dice, wide, deep, under), (0, 0, under))
    body = top + legs
    if dice.chance(0.3):
        body.append(prism(outline, (width * 0.9, depth * 0.9, thick * 0.7)) + [0, 0, 0.2 * height])
    apron = dice.between(0.08, 0.2)
    if dice.chance(0.7):
        body += _apron(wide, deep, apron, 0.02, under)
    if dice.chance(0.5):
        return [body, *_table_drawers(dice, wide * 0.9, deep, apron, under)]
    if inset > 0.75 and dice.chance(0.3):
        pedestal, leaves = _pedestal(dice, min(0.45, width * 0.35), depth * 0.9, under)
        shift = (dice.sign() * (width / 2 - 0.25 * min(0.9, width * 0.7)), 0, 0)
        return [body + moved(pedestal, shift), *(moved(leaf, shift) for leaf in leaves)]
    return [top, legs] if dice.chance(0.5) else [body]


def seat(dice: Dice) -> list[Pieces]:
    """A chair, stool, office chair, sofa or bed."""
    make = dice.weighted([(4, _chair), (2, _swivel), (2, _sofa), (1, _bed)])
    return make(dice)


def _outline(dice: Dice, aspect: float) -> tuple[FloatArray, float]:
    """Of a table top or seat: square, with round corners, or round; and how far out legs can stand, 0..1."""
    style = dice.unit()
    if style < 0.65:
        return SQUARE, dice.between(0.8, 1.0)
    if style < 0.85:
        return rounded(dice.between(0.02, 0.2) / max(aspect, 1.0), aspect), dice.between(0.75, 0.9)
    return ngon(dice.pick((6, 8, 20, 24))), dice.between(0.5, 0.65)


def _apron(width: float, depth: float, high: float, thick: float, top: float) -> Pieces:
    x, y, z = width / 2, depth / 2, top - high / 2
    long = boxes((width, thick, high), [(0, s * (y - thick), z) for s in (-1, 1)])
    return [long, boxes((thick, depth, high), [(s * (x - thick), 0, z) for s in (-1, 1)])]


def _table_drawers(dice: Dice, width: float, depth: float, high: float, top: float) -> list[Pieces]:
    count = dice.whole(1, 3)
    style = Style.random(dice, 0.02)
    opening = Opening(width / count * 0.97, high * 0.95, depth * 0.8)
    xs = (np.arange(count) + 0.5) * width / count - width / 2
    return [moved(drawer(dice, opening, style), (x, -depth / 2, top - high / 2)) for x in xs]


def _pedestal(dice: Dice, width: float, depth: float, height: float) -> tuple[Pieces, list[Pieces]]:
    """A drawer unit or cupboard under a desk."""
    count, board, low = dice.whole(1, 4), 0.018, dice.pick((0.0, 0.1, 0.3)) * height
    x, y = width / 2, depth / 2
    body = [boxes((board, depth, height - low), [(s * x, 0, (low + height) / 2) for s in (-1, 1)])]
    body += [between((-x, -y, low), (x, y, low + board)), between((-x, y - board, low), (x, y, height))]
    style = Style.random(dice, board)
    levels = np.linspace(low, height, count + 1)
    leaves = []
    for a, b in pairwise(levels):
        opening, place = Opening(width, (b - a) * 0.96, depth * 0.95), (0, -y, (a + b) / 2)
        leaf = door(dice, opening, style, 1) if count == 1 else drawer(dice, opening, style)
        leaves.append(moved(leaf, place))
    return body, leaves


def _chair(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.35, 0.6), dice.between(0.35, 0.6), dice.between(0.3, 0.8)
    thick = dice.between(0.015, 0.05)
    outline, inset = _outline(dice, width / depth)
    pad: Pieces = [prism(outline, (width, depth, thick)) + [0, 0, height]]
    if dice.chance(0.35):
        pad.append(superquadric((width * 0.95, depth * 0.95, 0.08), 0.4, 0.4, 6) + [0, 0, height + 0.04])
    legs = moved(feet(dice, width * inset, depth * inset, height), (0, 0, height))
    if dice.chance(0.5):
        rail, low = dice.between(0.012, 0.03), dice.between(0.15, 0.6) * height
        legs += _apron(width * inset * 0.92, depth * inset * 0.92, rail, rail, low)
    parts = [pad, legs]
    if dice.chance(0.75):
        back = turned(
            _backrest(dice, width, dice.between(0.25, 0.6)), rotation((1, 0, 0), -dice.between(0, 0.25))
        )
        parts.append(moved(back, (0, depth / 2 - 0.02, height)))
        if dice.chance(0.3):
            arm = _arm(dice, depth, dice.between(0.15, 0.3))
            parts.append(moved(arm, (-width / 2, 0, height)) + moved(mirrored(arm), (width / 2, 0, height)))
    if dice.chance(0.4):
        return [[piece for part in parts for piece in part]]
    return parts


def _backrest(dice: Dice, width: float, height: float) -> Pieces:
    """Posts with slats, spindles or a panel, from z = 0 up."""
    post = dice.between(0.02, 0.05)
    pieces = [boxes((post, post, height), [(s * (width - post) / 2, 0, height / 2) for s in (-1, 1)])]
    inner, style = width - 2 * post, dice.unit()
    if style < 0.35:
        levels = np.linspace(0.3, 0.95, dice.whole(1, 4)) * height
        pieces.append(
            boxes((inner, post * 0.5, height * dice.between(0.06, 0.18)), [(0, 0, z) for z in levels])
        )
    elif style < 0.65:
        xs = np.linspace(-inner / 2, inner / 2, dice.whole(2, 7) + 2)[1:-1]
        pieces += at(rod((0, 0, 0), (0, 0, height), post * 0.3), [(x, 0, 0) for x in xs])
        pieces.append(box((inner, post, post * 1.5), (0, 0, height - post)))
    else:
        low = dice.between(0.1, 0.6)
        panel = front(dice, inner, height * (1 - low), post * 0.6)
        pieces += moved(panel, (0, 0, height * (1 + low) / 2))
    return pieces


def _arm(dice: Dice, depth: float, height: float) -> Pieces:
    thick = dice.between(0.015, 0.03)
    if dice.chance(0.5):
        top = box((2.5 * thick, depth, thick), (0, 0, height))
        return [top, box((thick, thick, height), (0, -depth * 0.4, height / 2))]
    angle = np.linspace(0, np.pi, 9)
    path = np.column_stack([0 * angle, 0.45 * depth * np.cos(angle), height * np.sin(angle) ** 0.5])
    return [tube(path, thick)]


def _swivel(dice: Dice) -> list[Pieces]:
    """An office chair or bar stool: base, column, seat, and mostly a back."""
    width, height = dice.between(0.4, 0.55), dice.between(0.4, 0.75)
    radius = dice.between(0.02, 0.04)
    reach, low = width * dice.between(0.5, 0.7), dice.between(0.06, 0.15)
    base = moved(star_base(dice, reach, low), (0, 0, low + 0.05))
    if dice.chance(0.2):
        base = [cylinder(reach * 0.8, 0.03, 20) + [0, 0, low]]
    column = [rod((0, 0, low), (0, 0, height), radius, 8)]
    pad = [
        superquadric((width, width, dice.between(0.06, 0.12)), 0.5, dice.pick((0.3, 1.0)), 6) + [0, 0, height]
    ]
    if dice.chance(0.2):
        return [base, column, pad]
    tall, bend = dice.between(0.3, 0.7), dice.between(0.0, 0.12)
    x, z = np.meshgrid(np.linspace(-1, 1, 7), np.linspace(0, 1, 7), indexing="ij")
    skin = np.stack([x * width * 0.45, width * 0.5 - bend * x**2 + 0.1 * z, height + 0.1 + tall * z], axis=-1)
    back = [sheet(skin), sheet(skin + [0, dice.between(0.02, 0.06), 0])]
    back.append(box((0.06, 0.03, 0.3), (0, width * 0.5 + 0.03, height + 0.1)))
    if dice.chance(0.5):
        arm = moved(_arm(dice, width * 0.6, 0.2), (-width / 2, 0, height))
        back += arm + mirrored(arm)
    return [base, column + pad, back]


def _sofa(dice: Dice) -> list[Pieces]:
    count = dice.whole(1, 3)
    width, depth, low = 0.65 * count, dice.between(0.6, 0.85), dice.between(0.15, 0.3)
    arm, high = dice.between(0.08, 0.2), dice.between(0.5, 0.9)
    body = [between((-width / 2, -depth / 2, 0.08), (width / 2, depth / 2, low))]
    body.append(between((-width / 2, depth / 2 - arm, low), (width / 2, depth / 2, high)))
    side = between(
        (-width / 2 - arm, -depth / 2, 0.05), (-width / 2, depth / 2, high * dice.between(0.65, 1.0))
    )
    body += [side, *mirrored([side])]
    body += moved(feet(dice, width, depth, 0.08), (0, 0, 0.08))
    pillow = superquadric((0.63, depth - arm, dice.between(0.12, 0.2)), 0.4, 0.3, 6)
    spots = [((k + 0.5) * 0.65 - width / 2, -arm / 2, low + 0.08) for k in range(count)]
    return [body, *([pillow + np.array(spot)] for spot in spots)]


def _bed(dice: Dice) -> list[Pieces]:
    width, long, low = dice.between(0.8, 1.8), dice.between(1.6, 2.1), dice.between(0.2, 0.4)
    body = _apron(width, long, dice.between(0.1, 0.2), 0.03, low)
    body += moved(feet(dice, width, long, low), (0, 0, low))
    head = front(dice, width, dice.between(0.4, 1.0), 0.05)
    body += moved(head, (0, long / 2, 0.5))
    slats = np.linspace(-long / 2, long / 2, dice.whole(6, 14))[1:-1]
    body.append(boxes((width * 0.95, 0.08, 0.02), [(0, y, low - 0.05) for y in slats]))
    parts = [body]
    if dice.chance(0.6):
        parts.append([superquadric((width * 0.96, long * 0.97, 0.22), 0.25, 0.15, 6) + [0, 0, low + 0.06]])
    if dice.chance(0.5):
        style = Style.random(dice, 0.02)
        box_below = drawer(dice, Opening(long * 0.45, low * 0.6, width * 0.8), style)
        aside = turned(box_below, rotation((0, 0, 1), np.pi / 2))
        parts.append(moved(aside, (width / 2, long * 0.22, low * 0.45)))
    return parts


def cart(dice: Dice) -> list[Pieces]:
    """Shelves between posts on casters, with a push bar."""
    width, depth, height = dice.between(0.4, 0.9), dice.between(0.3, 0.6), dice.between(0.3, 1.0)
    post = dice.between(0.012, 0.03)
    levels = np.linspace(0, height, dice.whole(2, 4))
    body = at(
        box((post, post, height)),
        [(x * width / 2, y * depth / 2, height / 2) for x in (-1, 1) for y in (-1, 1)],
    )
    body.append(boxes((width, depth, post * 0.7), [(0, 0, z) for z in levels]))
    if dice.chance(0.6):
        x, y = width / 2, depth / 2
        path = [
            (-x, y, height),
            (-x - 0.12, y, height + 0.1),
            (-x - 0.12, -y, height + 0.1),
            (-x, -y, height),
        ]
        body.append(tube(path, post * 0.6))
    rolling = wheels(dice, width * 0.92, depth * 0.9, dice.between(0.03, 0.09))
    return [body, rolling]
