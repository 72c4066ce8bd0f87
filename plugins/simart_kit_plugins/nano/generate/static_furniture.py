"""Furniture that does not move, some of it with fronts and knobs that only look as if it did."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import front, raised
from ...shapes.handles import handle
from ...shapes.legs import feet
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import at, mirrored, moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, prism, rod, superquadric, torus, tube
from . import looks
from .category import Category
from .objects import Body, surface
from .rigging import RIGHT, Rig, plate


def _outline(dice: Dice, aspect: float) -> tuple[FloatArray, float]:
    """Of a top or seat, and how far out its legs can stand, 0..1."""
    style = dice.unit()
    if style < 0.6:
        return SQUARE, dice.between(0.8, 1.0)
    if style < 0.85:
        return rounded(dice.between(0.02, 0.2) / max(aspect, 1.0), aspect), dice.between(0.75, 0.9)
    return ngon(dice.pick((6, 8, 20))), dice.between(0.5, 0.62)


def _apron(width: float, depth: float, high: float, thick: float, top: float) -> Pieces:
    x, y, z = width / 2, depth / 2, top - high / 2
    long = boxes((width - thick, thick, high), [(0, s * (y - thick), z) for s in (-1, 1)])
    return [long, boxes((thick, depth - thick, high), [(s * (x - thick), 0, z) for s in (-1, 1)])]


def _chair(dice: Dice) -> list[Body]:
    width, depth, height = dice.between(0.36, 0.56), dice.between(0.36, 0.55), dice.between(0.4, 0.5)
    wood = looks.wood(dice) if dice.chance(0.7) else looks.metal(dice)
    outline, inset = _outline(dice, width / depth)
    thick = dice.between(0.015, 0.04)
    body = [prism(outline, (width, depth, thick)) + [0, 0, height - thick / 2]]
    wide, deep = width * inset, depth * inset
    body += moved(feet(dice, wide, deep, height), (0, 0, height))
    if dice.chance(0.5):
        rail = dice.between(0.012, 0.025)
        body += _apron(wide * 0.95, deep * 0.95, rail, rail, dice.between(0.2, 0.6) * height)
    whole = Rig(surface(body, wood))
    if dice.chance(0.4):
        pad = superquadric((width * 0.94, depth * 0.94, 0.07), 0.4, 0.4, 7) + [0, 0, height + 0.02]
        whole.dress(0, surface([pad], looks.fabric(dice)))
    back = turned(_backrest(dice, wide, dice.between(0.3, 0.6)), rotation(RIGHT, -dice.between(0, 0.2)))
    whole.dress(0, surface(moved(back, (0, deep / 2 - 0.03, height - 0.01)), wood))
    if dice.chance(0.3):
        arm = _arm(dice, deep, dice.between(0.18, 0.26))
        sides = moved(arm, (-wide / 2, 0, height)) + moved(mirrored(arm), (wide / 2, 0, height))
        whole.dress(0, surface(sides, wood))
    return whole.bodies()


def _backrest(dice: Dice, width: float, height: float) -> Pieces:
    """Posts with slats, spindles or a panel, from z = 0 up."""
    post = dice.between(0.02, 0.04)
    pieces = [boxes((post, post, height), [(s * (width - post) / 2, 0, height / 2) for s in (-1, 1)])]
    inner, style = width - 2 * post, dice.unit()
    if style < 0.35:
        levels = np.linspace(0.3, 0.92, dice.whole(1, 4)) * height
        slat = height * dice.between(0.06, 0.15)
        return [*pieces, boxes((inner, post * 0.5, slat), [(0, 0, z) for z in levels])]
    if style < 0.65:
        xs = np.linspace(-inner / 2, inner / 2, dice.whole(2, 7) + 2)[1:-1]
        pieces += at(rod((0, 0, 0), (0, 0, height), post * 0.3), [(x, 0, 0) for x in xs])
        return [*pieces, box((inner, post, post * 1.5), (0, 0, height - post))]
    low = dice.between(0.1, 0.6)
    panel = front(dice, inner, height * (1 - low), post * 0.6)
    return pieces + moved(panel, (0, 0, height * (1 + low) / 2))


def _arm(dice: Dice, depth: float, height: float) -> Pieces:
    thick = dice.between(0.015, 0.03)
    if dice.chance(0.5):
        return [
            box((2 * thick, depth, thick), (0, 0, height)),
            box((thick, thick, height), (0, -depth * 0.4, height / 2)),
        ]
    angle = np.linspace(0, np.pi, 9)
    path = np.column_stack([0 * angle, 0.42 * depth * np.cos(angle), height * np.sin(angle) ** 0.5])
    return [tube(path, thick)]


def _table(dice: Dice) -> list[Body]:
    """Some with drawer fronts that are only glued on."""
    width, depth, height = dice.between(0.4, 1.9), dice.between(0.4, 0.95), dice.between(0.35, 1.0)
    thick, look = dice.between(0.015, 0.05), looks.wood(dice)
    outline, inset = _outline(dice, width / depth)
    top = prism(outline, (width, depth, thick)) + [0, 0, height - thick / 2]
    under, wide, deep = height - thick, width * inset, depth * inset
    body: Pieces = []
    if dice.chance(0.2):
        radius = 0.3 * min(width, depth)
        body += [rod((0, 0, 0), (0, 0, under), 0.035, 10), cylinder(radius, 0.025, 20) + [0, 0, 0.0125]]
    else:
        body += moved(feet(dice, wide, deep, under), (0, 0, under))
    if dice.chance(0.3):
        body.append(prism(outline, (width * 0.8, depth * 0.8, thick * 0.7)) + [0, 0, 0.25 * height])
    whole = Rig(surface([top], look if dice.chance(0.6) else looks.wood(dice)), surface(body, look))
    if dice.chance(0.6):
        high = dice.between(0.08, 0.16)
        whole.dress(0, surface(_apron(wide, deep, high, 0.02, under), look))
        for x in np.linspace(-0.25, 0.25, 2)[: dice.whole(0, 2)] * wide:
            panel = front(dice, 0.42 * wide, 0.8 * high, 0.012)
            pull = moved(handle(dice, 0.08), (0, -0.012, 0))
            middle = (x, -deep / 2 + 0.01, under - high / 2)
            whole.dress(
                0, surface(moved(panel, middle), look), surface(moved(pull, middle), looks.metal(dice))
            )
    return whole.bodies()


def _boards(width: float, depth: float, height: float, thick: float, levels: FloatArray) -> Pieces:
    """Uprights and shelves."""
    x = (width - thick) / 2
    sides = boxes((thick, depth, height), [(s * x, 0, height / 2) for s in (-1, 1)])
    return [sides, boxes((width - 2 * thick, depth - 0.005, thick), [(0, 0, z) for z in levels])]


def _shelf(dice: Dice) -> list[Body]:
    """Boards or a rack of posts; now and then a back and dividers."""
    width, depth, height = dice.between(0.4, 1.4), dice.between(0.2, 0.45), dice.between(0.5, 2.1)
    thick, count = dice.between(0.012, 0.03), dice.whole(3, 6)
    look = looks.wood(dice) if dice.chance(0.7) else looks.metal(dice)
    levels = np.linspace(dice.between(0.02, 0.15), height - thick / 2, count)
    if dice.chance(0.3):
        posts = at(
            box((thick, thick, height), (0, 0, height / 2)),
            [(s * width / 2, t * depth / 2, 0) for s in (-1, 1) for t in (-1, 1)],
        )
        body = [*posts, boxes((width, depth, thick), [(0, 0, z) for z in levels])]
    else:
        body = _boards(width, depth, height, thick, levels)
        for a, b in pairwise(levels):
            if dice.chance(0.3):
                body.append(
                    box(
                        (thick, depth * 0.97, b - a - thick),
                        (dice.between(-0.3, 0.3) * width, 0, (a + b) / 2),
                    )
                )
    if dice.chance(0.5):
        body.append(box((width, 0.006, height), (0, depth / 2, height / 2)))
    return Rig(surface(body, look)).bodies()


def _bookcase(dice: Dice) -> list[Body]:
    """Filled with books and boxes that stay where they are."""
    width, depth, height = dice.between(0.5, 1.2), dice.between(0.22, 0.32), dice.between(0.7, 2.0)
    thick, count = dice.between(0.015, 0.025), dice.whole(3, 6)
    levels = np.linspace(0.05, height - thick / 2, count)
    body = [
        *_boards(width, depth, height, thick, levels),
        box((width, 0.006, height), (0, depth / 2, height / 2)),
    ]
    whole = Rig(surface(body, looks.wood(dice)))
    piles: list[Pieces] = [[], [], []]
    pitch = levels[1] - levels[0] - thick
    for level in levels[:-1]:
        x = -width / 2 + thick + 0.004
        while x < width * dice.between(0.1, 0.45):
            wide, tall = dice.between(0.012, 0.05), pitch * dice.between(0.55, 0.92)
            book = box(
                (wide, depth * dice.between(0.6, 0.85), tall), (x + wide / 2, 0, level + (thick + tall) / 2)
            )
            piles[dice.whole(0, 2)].append(book)
            x += wide + dice.between(0.0005, 0.004)
    for pile in piles:
        if pile:
            whole.dress(0, surface(pile, looks.fabric(dice)))
    return whole.bodies()


def _sofa(dice: Dice) -> list[Body]:
    count, unit = dice.whole(1, 4), dice.between(0.55, 0.7)
    width, depth, low = unit * count, dice.between(0.65, 0.9), dice.between(0.2, 0.32)
    arm, high, cover = dice.between(0.08, 0.2), dice.between(0.6, 0.9), looks.fabric(dice)
    x, y = width / 2, depth / 2
    body = [between((-x, -y, 0.08), (x, y, low)), between((-x, y - arm, low), (x, y, high))]
    size = (arm, depth, high * dice.between(0.65, 0.95) - 0.05)
    side = box(size) if dice.chance(0.5) else prism(rounded(0.3), size)
    side = side + [-x - arm / 2, 0, 0.05 + size[2] / 2]
    if dice.chance(0.85):
        body += [side, *mirrored([side])]
    whole = Rig(surface(body, cover))
    whole.dress(0, surface(moved(feet(dice, width, depth, 0.08), (0, 0, 0.08)), looks.wood(dice)))
    pillow = superquadric((unit - 0.01, depth - arm, dice.between(0.12, 0.2)), 0.4, 0.3, 7)
    rest = superquadric((unit - 0.02, 0.16, high - low), 0.5, 0.5, 7)
    soft: Pieces = []
    for k in range(count):
        spot = (k + 0.5) * unit - x
        soft.append(pillow + [spot, -arm / 2, low + 0.06])
        soft += turned([rest + [spot, y - arm - 0.05, low + 0.1 + (high - low) / 2]], rotation(RIGHT, -0.05))
    whole.dress(0, surface(soft, cover if dice.chance(0.6) else looks.fabric(dice)))
    return whole.bodies()


def _bed(dice: Dice) -> list[Body]:
    width, long, low = dice.between(0.8, 1.8), dice.between(1.7, 2.1), dice.between(0.22, 0.4)
    look, linen = looks.wood(dice), looks.fabric(dice)
    body = _apron(width, long, dice.between(0.12, 0.2), 0.03, low)
    body += moved(feet(dice, width, long, low), (0, 0, low))
    body += moved(front(dice, width, dice.between(0.5, 1.0), 0.05), (0, long / 2, 0.5))
    if dice.chance(0.4):
        body += moved(front(dice, width, dice.between(0.25, 0.4), 0.04), (0, -long / 2 + 0.03, low))
    soft = [superquadric((width * 0.96, long * 0.96, 0.22), 0.25, 0.12, 7) + [0, 0, low + 0.06]]
    pillow = superquadric((0.55, 0.36, 0.14), 0.8, 0.4, 7)
    soft += [pillow + [s * 0.25 * width, 0.36 * long, low + 0.22] for s in ((-1, 1) if width > 1.2 else (0,))]
    whole = Rig(surface(body, look), surface(soft, linen))
    if dice.chance(0.4):
        # A plank with false drawer fronts.
        for y in (-0.25, 0.2):
            panel = turned(front(dice, 0.35 * long, 0.13, 0.012), rotation((0, 0, 1), np.pi / 2))
            whole.dress(
                0, surface(moved(panel, (width / 2 - 0.03, y * long, low - 0.08)), looks.darker(look))
            )
    return whole.bodies()


def _stool(dice: Dice) -> list[Body]:
    """A stool or a bench."""
    width, height = (
        dice.between(0.28, 0.42) if dice.chance(0.6) else dice.between(0.8, 1.6),
        dice.between(0.25, 0.8),
    )
    depth, thick, look = dice.between(0.26, 0.4), dice.between(0.02, 0.05), looks.wood(dice)
    outline, inset = _outline(dice, width / depth)
    legs = moved(feet(dice, width * inset, depth * inset, height), (0, 0, height))
    if dice.chance(0.5):
        legs += _apron(width * inset * 0.9, depth * inset * 0.9, 0.02, 0.02, dice.between(0.2, 0.6) * height)
    whole = Rig(surface(legs, look))
    if dice.chance(0.4) and width > 0.5:
        ys = np.linspace(-0.4, 0.4, dice.whole(2, 4)) * depth
        top: Pieces = [boxes((width, 0.7 * depth / len(ys), thick), [(0, y, height) for y in ys])]
    else:
        top = [prism(outline, (width, depth, thick)) + [0, 0, height]]
    whole.dress(0, surface(top, look if dice.chance(0.6) else looks.fabric(dice)))
    return whole.bodies()


def _decoy_cabinet(dice: Dice) -> list[Body]:
    """A solid block with grooves, panels and knobs, none of which opens."""
    width, depth, height = dice.between(0.3, 1.2), dice.between(0.25, 0.6), dice.between(0.4, 1.6)
    look, legs = looks.wood(dice), dice.pick((0.0, 0.0, 0.08, 0.2))
    body = [between((-width / 2, -depth / 2, legs), (width / 2, depth / 2, height))]
    if legs:
        body += moved(feet(dice, width, depth, legs), (0, 0, legs))
    if dice.chance(0.5):
        body.append(box((width + 0.03, depth + 0.02, 0.025), (0, 0, height + 0.0125)))
    whole = Rig(surface(body, look))
    rows, columns = dice.whole(1, 4), dice.whole(1, 3)
    cell = np.array([width / columns, (height - legs) / rows])
    skin = dice.between(0.002, 0.02)
    make, metal = dice.pick((front, raised)), looks.metal(dice)
    knobs, shade = dice.chance(0.6), dice.between(0.75, 1.0)
    for row in range(rows):
        for column in range(columns):
            middle = ((column + 0.5) * cell[0] - width / 2, -depth / 2, legs + (row + 0.5) * cell[1])
            panel = make(dice, 0.88 * cell[0], 0.88 * cell[1], skin)
            whole.dress(0, surface(moved(panel, middle), looks.darker(look, shade)))
            if knobs:
                pull = moved(handle(dice, min(0.12, 0.4 * cell[0])), (0, -skin, 0.2 * cell[1]))
                whole.dress(0, surface(moved(pull, middle), metal))
    return whole.bodies()


def _fireplace(dice: Dice) -> list[Body]:
    """Pillars, lintel, mantel and a fire box, with decorative panels."""
    width, depth, height = dice.between(0.9, 1.6), dice.between(0.25, 0.5), dice.between(0.9, 1.3)
    side, look = (
        width * dice.between(0.15, 0.25),
        looks.ceramic(dice) if dice.chance(0.4) else looks.wood(dice),
    )
    lintel = height * dice.between(0.15, 0.25)
    x = width / 2
    body = [
        between(
            (s * x - (side if s > 0 else 0), -depth / 2, 0),
            (s * x + (0 if s > 0 else side), depth / 2, height),
        )
        for s in (-1, 1)
    ]
    body += [
        between((-x + side, -depth / 2, height - lintel), (x - side, depth / 2, height)),
        box((width + 0.12, depth + 0.1, 0.05), (0, 0, height + 0.025)),
    ]
    body.append(box((width + 0.1, depth + 0.3, 0.04), (0, -0.1, 0.02)))
    for s in (-1, 1):
        body += moved(
            raised(dice, 0.7 * side, 0.75 * (height - lintel), 0.02),
            (s * (x - side / 2), -depth / 2, 0.5 * (height - lintel)),
        )
    body += moved(front(dice, 0.6 * width, 0.6 * lintel, 0.02), (0, -depth / 2, height - lintel / 2))
    inside = [between((-x + side, depth / 2 - 0.03, 0), (x - side, depth / 2, height - lintel))]
    logs = [
        rod(
            (-0.2, dice.between(-0.1, 0.1) * depth, 0.07 + 0.06 * k),
            (0.2, dice.between(-0.1, 0.1) * depth, 0.08 + 0.06 * k),
            0.035,
            7,
        )
        for k in range(dice.whole(0, 3))
    ]
    return Rig(surface(body, look), surface([*inside, *logs], looks.darker(looks.wood(dice), 0.5))).bodies()


def _picture_frame(dice: Dice) -> list[Body]:
    """A picture or mirror in a profiled frame, on its strut."""
    width, height, border = dice.between(0.15, 1.0), dice.between(0.2, 1.2), dice.between(0.02, 0.08)
    thick, x, z = dice.between(0.01, 0.03), width / 2, height / 2
    strip = plate([[-x, -z], [x, -z], [x - border, -z + border], [-x + border, -z + border]], thick)
    upright = plate([[-x, -z], [-x + border, -z + border], [-x + border, z - border], [-x, z]], thick)
    flat = [strip, strip * [1, -1, 1], upright, upright * [-1, 1, 1]]
    if dice.chance(0.5):
        flat.append(torus(0.4 * border, 0.2 * border, 12) + [0, z + 0.2 * border, 0])
    lean = rotation(RIGHT, np.pi / 2 - (dice.between(0.1, 0.3) if width < 0.5 else 0.0))
    pane = surface(
        turned([box((width - 1.5 * border, height - 1.5 * border, 0.3 * thick))], lean), looks.glass(dice)
    )
    whole = Rig(surface(turned(flat, lean), looks.wood(dice)), pane)
    if width < 0.5:
        whole.dress(0, surface([rod((0, 0.02, 0.2 * z), (0, 0.45 * z, -0.95 * z), 0.006)], looks.metal(dice)))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("chair", _chair, moves=False),
    Category("table", _table, moves=False),
    Category("shelf", _shelf, moves=False),
    Category("bookcase", _bookcase, moves=False),
    Category("sofa", _sofa, moves=False),
    Category("bed", _bed, moves=False),
    Category("stool", _stool, moves=False),
    Category("decoy_cabinet", _decoy_cabinet, moves=False),
    Category("fireplace", _fireplace, moves=False),
    Category("picture_frame", _picture_frame, moves=False),
)
