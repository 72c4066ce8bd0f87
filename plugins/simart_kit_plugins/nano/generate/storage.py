"""Cabinets, wardrobes, sideboards: cases with doors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import slab
from ...shapes.placing import moved
from ...shapes.primitives import between, box, boxes
from . import leaves, looks
from .assembly import Assembly, Leaf, until_moving
from .carcass import (
    Size,
    any_size,
    carcass,
    columns,
    crown,
    even_or_random,
    fill,
    rows,
    shelves,
    side_panels,
    stand,
)
from .category import Category
from .objects import Body, Look, slide, surface
from .styles import Face, Opening, Style, grip, random_style


def _cabinet(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice) if dice.chance(0.85) else looks.painted_metal(dice)
    hung = dice.chance(0.25)
    low, high = ((0.3, 0.22, 0.35), (1.2, 0.4, 0.9)) if hung else ((0.35, 0.28, 0.5), (1.4, 0.6, 1.7))
    size, board = any_size(dice, low, high), dice.between(0.012, 0.028)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    style = style.clear() if dice.chance(0.12) else style
    if not hung:
        stand(made, dice, size, look)
    crown(made, dice, size, look)
    side_panels(made, dice, size, look)
    most = max(1, min(3, round(size[0] / 0.4)))
    cells = columns(made, opening, even_or_random(dice, dice.whole(1, most)), board, look)
    shared = dice.whole(1, 3)
    for cell in cells:
        _cabinet_column(made, dice, style, cell, board, look, shared if dice.chance(0.6) else 0)
    return made.bodies()


def _cabinet_column(
    made: Assembly, dice: Dice, style: Style, cell: Opening, board: float, look: Look, parts: int
) -> None:
    """Rooms over each other: doors, drawers above or below, open ones."""
    count = parts or dice.whole(1, 3)
    shares = even_or_random(dice, count)
    drawn = dice.pick((0, count - 1)) if count > 1 and dice.chance(0.7) else -1
    if drawn >= 0:
        shares[drawn] = 0.35 * min(shares)
    for k, room in enumerate(rows(made, cell, shares, board, look)):
        if k == drawn and room.height < 1.2 * room.width:
            fill(made, dice, style, room, dice.weighted([(9, "drawer"), (1, "decoy")]), look)
            continue
        wide = room.width > 0.75 * room.height and room.width > 0.45
        kind = dice.weighted(
            [
                (6, "pair" if wide else "door"),
                (1.2, "open"),
                (1.0 if wide else 0.0, "flap_down"),
                (0.7 if wide else 0.0, "flap_up"),
                (0.6, "decoy"),
                (1.2, "drawers"),
            ]
        )
        fill(made, dice, style, room, kind, look)


def _wardrobe(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    size, board = any_size(dice, (0.7, 0.45, 1.6), (2.6, 0.7, 2.4)), dice.between(0.015, 0.03)
    made, style = Assembly("body"), random_style(dice, look)
    style = replace(style, long=dice.spread(0.1, 0.6))
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look, 0.15)
    crown(made, dice, size, look)
    side_panels(made, dice, size, look)
    if size[0] > 1.0 and dice.chance(0.4):
        return _sliding_wardrobe(made, dice, style, opening, board, look)
    count = max(1, round(size[0] / dice.between(0.4, 1.0)))
    if dice.chance(0.35):
        share = dice.between(0.15, 0.25)
        below, opening = rows(made, opening, (share, 1 - share), board, look)
        for cell in columns(made, below, [1.0] * dice.whole(1, 2), board, look):
            fill(made, dice, style, cell, dice.pick(("drawer", "drawers")), look)
    if dice.chance(0.2):
        opening, above = rows(made, opening, (0.8, 0.2), board, look)
        for cell in columns(made, above, [1.0] * count, board, look):
            fill(made, dice, style, cell, "pair" if cell.width > 0.6 else "door", look)
    folding = dice.chance(0.12)
    mirror = dice.whole(0, count - 1) if dice.chance(0.4) else -1
    for k, cell in enumerate(columns(made, opening, even_or_random(dice, count), board, look)):
        kind = "pair" if cell.width > 0.55 else "door"
        if k and dice.chance(0.08):
            kind = "open"
        front = _mirrored(dice, style) if k == mirror else style
        if folding and cell.width > 0.5:
            made.add(leaves.folding(dice, front, cell, -1 if k == 0 else 1))
            shelves(made, dice, cell, look, 0.06)
            continue
        fill(made, dice, front, cell, kind, look)
        if cell.height > 1.0 and dice.chance(0.3):
            _within(made, dice, style, cell, look)
    return made.bodies()


def _mirrored(dice: Dice, style: Style) -> Style:
    """With a mirror instead of a front's own make."""
    return replace(style.clear(), pane=looks.metal(dice))


def _sliding_wardrobe(
    made: Assembly, dice: Dice, style: Style, opening: Opening, board: float, look: Look
) -> Sequence[Body]:
    """Two or three leaves in tracks, rooms and drawers behind them."""
    plain = replace(style, thick=min(style.thick, 0.02))
    count = 2 if opening.width < 1.5 else dice.whole(2, 3)
    for k, leaf in enumerate(leaves.sliding(dice, plain, opening, count)):
        made.add(leaf)
        if k == 0 and dice.chance(0.3):
            plain = plain.clear()
    inside = opening.sunk(4 * plain.thick)
    for cell in columns(made, inside, even_or_random(dice, dice.whole(1, 3)), board, look):
        shelves(made, dice, cell, look, 0.02)
        if cell.width < 1.1 and dice.chance(0.4):
            _within(made, dice, style, cell, look, 0.03)
    return made.bodies()


def _within(
    made: Assembly, dice: Dice, style: Style, cell: Opening, look: Look, recess: float = 0.14
) -> None:
    """Drawers behind the doors, at the bottom of a room, in a box of their own."""
    tall = dice.between(0.15, 0.25) * cell.height
    deep = cell.sunk(recess + style.reach)
    room = replace(deep, high=deep.low + tall, left=deep.left + 0.02, right=deep.right - 0.02)
    sides = [(deep.left + 0.01, 0.0, deep.low + tall / 2), (deep.right - 0.01, 0.0, deep.low + tall / 2)]
    middle = deep.front + deep.depth / 2
    made.fix([boxes((0.02, deep.depth, tall), [(x, middle, z) for x, _, z in sides])], look)
    made.fix([box((deep.width, deep.depth, 0.012), (deep.center[0], middle, deep.low + tall + 0.006))], look)
    for one in room.rows([1.0] * dice.whole(1, 2), 0.004):
        made.add(leaves.drawer(dice, style.inside(), one, "inner_drawer"))


def _sliding_cabinet(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    size, board = any_size(dice, (0.6, 0.25, 0.4), (2.0, 0.5, 2.0)), dice.between(0.012, 0.03)
    made = Assembly("body")
    style = random_style(dice, look, dice.between(0.005, 0.018))
    style = style.clear() if dice.chance(0.35) else style
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look)
    crown(made, dice, size, look)
    if size[2] > 0.9 and dice.chance(0.4):
        share = dice.between(0.25, 0.5)
        spare, opening = rows(made, opening, (share, 1 - share), board, look)
        fill(made, dice, style, spare, dice.pick(("open", "sliding", "drawer")), look)
    elif dice.chance(0.25):
        cells = columns(made, opening, (1, 2) if dice.chance(0.5) else (2, 1), board, look)
        opening, spare = max(cells, key=lambda c: c.width), min(cells, key=lambda c: c.width)
        fill(made, dice, style, spare, dice.pick(("open", "door", "drawers")), look)
    for leaf in leaves.sliding(dice, style, opening, dice.whole(2, 3) if size[0] > 1.0 else 2):
        made.add(leaf)
    shelves(made, dice, opening, look, 4 * style.thick)
    return made.bodies()


def _sideboard(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    size, board = any_size(dice, (1.0, 0.35, 0.4), (2.2, 0.55, 0.95)), dice.between(0.014, 0.03)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look, 0.3)
    crown(made, dice, size, look)
    kinds = [(4, "pair"), (4, "door"), (4, "drawers"), (2, "flap_down"), (1.5, "flap_up"), (1, "open")]
    cells = columns(made, opening, even_or_random(dice, dice.whole(2, 4)), board, look)
    wings = dice.weighted(kinds)
    for k, cell in enumerate(cells):
        outer = k in (0, len(cells) - 1)
        kind = wings if outer and dice.chance(0.7) else dice.weighted(kinds)
        if dice.chance(0.3):
            high, low = (0.3, 0.7) if dice.chance(0.6) else (0.6, 0.4)
            cell, top = rows(made, cell, (low, high), board, look)
            fill(made, dice, style, top, dice.pick(("drawer", "drawer", "flap_up", "open")), look)
        kind = "door" if kind == "pair" and cell.width < 0.35 else kind
        fill(made, dice, style, cell, kind, look)
    return made.bodies()


def _tambour_cabinet(dice: Dice) -> Sequence[Body]:
    look = dice.pick((looks.wood(dice), looks.painted_metal(dice)))
    size, board = any_size(dice, (0.4, 0.3, 0.5), (1.3, 0.55, 2.0)), dice.between(0.015, 0.03)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look)
    upwards = dice.chance(0.5)
    if not upwards:
        crown(made, dice, size, look)
    if dice.chance(0.3):
        below, opening = rows(made, opening, (0.3, 0.7), board, look)
        fill(made, dice, style, below, dice.pick(("drawer", "drawers", "open")), look)
    shutter_look = dice.pick((look, looks.plastic(dice), looks.darker(look, 0.8)))
    rooms = [opening]
    if not upwards and opening.width > 0.8:
        rooms = (
            columns(made, opening, (1, 1), board, look) if dice.chance(0.5) else opening.columns((1, 1), 0)
        )
    for k, room in enumerate(rooms):
        made.add(_shutter(dice, style, room, shutter_look, 0 if upwards else (-1 if k == 0 else 1)))
    _rails(made, dice, opening, size, upwards, look)
    shelves(made, dice, opening, look, 0.03)
    return made.bodies()


def _rails(made: Assembly, dice: Dice, opening: Opening, size: Size, upwards: bool, look: Look) -> None:
    """What a roll front runs in, before the case, and mostly a pelmet over its far end."""
    out, slim = 0.016, 0.008
    left, right = opening.left - opening.borders[0], opening.right + opening.borders[1]
    low, high = opening.low - opening.borders[2], opening.high + opening.borders[3]
    near, y = opening.front - out, opening.front
    if upwards:
        guides = [between((x - slim, near, low), (x, y, high)) for x in (left + slim / 2, right + slim / 2)]
    else:
        guides = [between((left, near, z - slim), (right, y, z)) for z in (low + slim / 2, high + slim / 2)]
    made.fix(guides, dice.pick((look, looks.metal(dice))))
    if upwards and dice.chance(0.6):
        tall, wide = min(0.25 * size[2], dice.between(0.05, 0.2)), size[0] / 2
        made.fix([between((-wide, near - 0.03, high - tall), (wide, near - 0.015, high))], look)
        ends = [(-wide, -wide + 0.012), (wide - 0.012, wide)]
        made.fix([between((a, near - 0.03, high - tall), (b, y, high)) for a, b in ends], look)


def _shutter(dice: Dice, style: Style, opening: Opening, look: Look, side: int) -> Leaf:
    """A roll front of slats, which goes up (side 0), to the left (-1) or to the right (1)."""
    face = Face.of(replace(style, lift=0.001, gap=0.014), opening)
    long, across = (face.height, face.width) if side == 0 else (face.width, face.height)
    count = max(6, min(48, round(long / dice.between(0.015, 0.05))))
    step = long / count
    places = (np.arange(count) + 0.5) * step - long / 2
    slim, thin = step * dice.between(0.75, 0.95), dice.between(0.006, 0.012)
    size = (across, thin, slim) if side == 0 else (slim, thin, across)
    spots = [(0, -0.007, p) if side == 0 else (p, -0.007, 0) for p in places]
    sheet = slab(Dice(0), face.width, face.height, 0.002)
    pieces = moved([boxes(size, spots), *sheet], (face.x, face.back, face.z))
    bar = (across, 0.012, 0.03) if side == 0 else (0.03, 0.012, across)
    end = (long - 0.03) / 2
    spot = (face.x - side * end, face.back - 0.012, face.z - (end if side == 0 else 0))
    parts = [surface(pieces, look), surface([box(bar, spot)], style.grip)]
    low = replace(face, back=face.back - 0.018 + style.thick)
    parts += grip(style, low, -side * end, -end if side == 0 else 0, side != 0, min(0.2, 0.5 * across))
    axis = (0, 0, 1) if side == 0 else (side, 0, 0)
    return Leaf("shutter", "shutter", tuple(parts), slide(axis, dice.between(0.65, 0.85) * long))


CATEGORIES: tuple[Category, ...] = (
    Category("cabinet", until_moving(_cabinet)),
    Category("wardrobe", _wardrobe),
    Category("sliding_cabinet", _sliding_cabinet),
    Category("sideboard", until_moving(_sideboard)),
    Category("tambour_cabinet", _tambour_cabinet),
)
