"""Furniture of drawers: chests, night stands, tool chests, filing cabinets, shoe cabinets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...shapes.dice import Dice
from ...shapes.handles import handle
from ...shapes.placing import moved, rotation, turned
from ...shapes.primitives import between, box, boxes, open_box, tube
from . import leaves, looks
from .assembly import Assembly, Leaf, until_moving
from .carcass import Size, any_size, carcass, columns, crown, even_or_random, fill, rows, side_panels, stand
from .category import Category
from .objects import Body, Look, hinge, surface
from .rolling import caster
from .styles import Face, Opening, Style, random_style


def _drawer_chest(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice) if dice.chance(0.9) else looks.plastic(dice)
    small = dice.chance(0.15)
    low, high = ((0.15, 0.12, 0.12), (0.4, 0.3, 0.5)) if small else ((0.35, 0.35, 0.45), (1.6, 0.55, 1.4))
    size = any_size(dice, low, high)
    board = dice.between(0.006, 0.01) if small else dice.between(0.014, 0.028)
    made, style = Assembly("body"), random_style(dice, look, board if small else None)
    opening = carcass(made, dice, size, board, look)
    if not small:
        stand(made, dice, size, look)
    crown(made, dice, size, look)
    side_panels(made, dice, size, look)
    between_boards = board if style.inset or dice.chance(0.3) else 0.0
    rails = _rows(made, opening, _heights(dice, opening), between_boards, look)
    across = dice.whole(1, 3) if opening.width > 0.7 else dice.whole(1, 2)
    grid = dice.chance(0.3)
    for k, rail in enumerate(rails):
        count = across if grid or k == len(rails) - 1 else dice.weighted([(5, 1), (1, 2)])
        for cell in _columns(made, rail, [1.0] * count, between_boards, look):
            fill(made, dice, style, cell, dice.weighted([(30, "drawer"), (1, "decoy"), (1, "open")]), look)
    return made.bodies()


def _heights(dice: Dice, opening: Opening) -> list[float]:
    """Shares of the rows from below: even, random, or lower ones higher."""
    count = dice.whole(1, max(1, min(7, round(opening.height / (0.25 * min(opening.width, 0.8))))))
    if dice.chance(0.4):
        return list(np.linspace(dice.between(1.2, 2.2), 1.0, count))
    return even_or_random(dice, count)


def _rows(
    made: Assembly, opening: Opening, shares: Sequence[float], board: float, look: Look
) -> list[Opening]:
    return rows(made, opening, shares, board, look) if board else opening.rows(shares, 0.0)


def _columns(
    made: Assembly, opening: Opening, shares: Sequence[float], board: float, look: Look
) -> list[Opening]:
    return columns(made, opening, shares, board, look) if board else opening.columns(shares, 0.0)


def _nightstand(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    size, board = any_size(dice, (0.3, 0.28, 0.25), (0.65, 0.5, 0.65)), dice.between(0.012, 0.025)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look, 0.3)
    crown(made, dice, size, look)
    count = dice.whole(1, 3)
    shares = even_or_random(dice, count)
    for k, cell in enumerate(_rows(made, opening, shares, board, look)):
        top = k == count - 1
        kinds = [(6.0, "drawer"), (2.0, "open"), (0.3, "decoy")]
        if not top or count == 1:
            kinds += [(2.0, "door"), (0.5, "flap_down"), (1.0 if cell.width > 0.4 else 0.0, "pair")]
        kind = dice.weighted(kinds)
        fill(made, dice, style, cell, kind, look)
    return made.bodies()


def _tool_chest(dice: Dice) -> Sequence[Body]:
    look = looks.painted_metal(dice)
    size, board = any_size(dice, (0.5, 0.3, 0.35), (1.2, 0.55, 1.1)), dice.between(0.006, 0.02)
    made, style = Assembly("body"), random_style(dice, look, dice.between(0.005, 0.015))
    style = replace(style, long=dice.between(0.15, 0.9), lift=dice.pick((0.0, -style.thick)))
    opening = carcass(made, dice, size, board, look)
    count = dice.whole(2, 7)
    cells = opening.rows(np.linspace(dice.between(1.0, 2.5), 1.0, count).tolist(), 0.0)
    door = dice.chance(0.2)
    for k, cell in enumerate(cells):
        if k == 0 and door:
            fill(made, dice, style, cell, "door", look)
        elif k == count - 1 and size[0] > 0.6 and dice.chance(0.4):
            for half in cell.columns((1, 1) if dice.chance(0.6) else (1, 2), 0.0):
                fill(made, dice, style, half, "drawer", look)
        else:
            fill(made, dice, style, cell, "drawer", look)
    if dice.chance(0.5):
        _top_box(made, dice, size, style, look)
    else:
        crown(made, dice, size, looks.rubber(dice), 0.7)
    if dice.chance(0.7):
        _roll(made, dice, size)
    if dice.chance(0.5):
        _push_bar(made, dice, size)
    return made.bodies()


def _top_box(made: Assembly, dice: Dice, size: Size, style: Style, look: Look) -> None:
    """An open tray with a lid over the drawers."""
    width, depth, height = size
    tall, wall = dice.between(0.06, 0.2), 0.006
    made.fix([open_box((width, depth, tall), wall) + [0, 0, height]], look)
    thick, top = dice.between(0.01, 0.04), height + tall
    shell = box((width * 1.005, depth * 1.005, thick), (0, 0, top + thick / 2 + 0.001))
    parts = [surface([shell], look)]
    if dice.chance(0.6):
        pull = handle(dice, dice.between(0.1, 0.3))
        parts.append(surface(moved(pull, (0, -depth * 0.5025, top + thick / 2)), style.grip))
    motion = hinge((0, depth / 2, top), (-1, 0, 0), np.radians(dice.between(70, 105)))
    made.add(Leaf("lid", "lid", tuple(parts), motion))


def _roll(made: Assembly, dice: Dice, size: Size) -> None:
    """Four casters; the front ones, or all, swivel."""
    width, depth, _ = size
    radius = dice.between(0.025, 0.06)
    all_swivel = dice.chance(0.5)
    for y, end in ((-1, "front"), (1, "rear")):
        for x, side in ((-1, "left"), (1, "right")):
            top = (x * (width / 2 - 1.2 * radius), y * (depth / 2 - 1.6 * radius), 0.0)
            swivels = all_swivel or y < 0
            made.add(caster(dice, radius, top, swivels, f"{end}_{side}"))
            if not swivels:
                cheeks = [(top[0] + s * 0.62 * radius, top[1], -0.75 * radius) for s in (-1, 1)]
                made.fix([boxes((0.15 * radius, radius, 1.5 * radius), cheeks)], looks.metal(dice))


def _push_bar(made: Assembly, dice: Dice, size: Size) -> None:
    """A fixed bow on one side."""
    width, depth, height = size
    side, out, level = dice.sign(), dice.between(0.04, 0.1), dice.between(0.75, 0.92) * height
    x = side * width / 2
    path = [(x, -depth * 0.35, level), (x + side * out, -depth * 0.33, level)]
    path += [(px, -y, pz) for px, y, pz in reversed(path)]
    made.fix([tube(path, 0.01, 8)], looks.metal(dice))


def _filing_cabinet(dice: Dice) -> Sequence[Body]:
    look = looks.painted_metal(dice) if dice.chance(0.8) else looks.wood(dice)
    wide = dice.chance(0.3)
    size = any_size(dice, (0.38, 0.4, 0.5), (0.5, 0.65, 1.4))
    if wide:
        size = (dice.between(0.75, 1.1), size[1] * 0.8, size[2])
    board = dice.between(0.01, 0.022)
    made, style = Assembly("body"), random_style(dice, look, dice.between(0.012, 0.025))
    style = replace(style, long=dice.between(0.08, 0.25), lift=dice.pick((0.0, 0.0, -style.thick)))
    opening = carcass(made, dice, size, board, look)
    if dice.chance(0.25) and size[2] < 0.8:
        _roll(made, dice, size)
    else:
        stand(made, dice, size, look, 0.08)
    crown(made, dice, size, look, 0.3)
    count = max(2, min(5, round(size[2] / 0.32)))
    cells = opening.rows([1.0] * (count - 1) + [dice.pick((1.0, 1.0, 0.5))], 0.0)
    label = dice.chance(0.5)
    locks = dice.chance(0.6)
    for k, cell in enumerate(cells):
        face = Face.of(style, cell)
        body = leaves.drawer(dice, style, cell)
        if label:
            plate = box(
                (0.08, 0.003, 0.04), (face.x, face.back - style.thick - 0.0015, face.z + 0.3 * face.height)
            )
            body = replace(body, surfaces=(*body.surfaces, surface([plate], style.grip)))
        if k == count - 1 and locks:
            lock = leaves.lock(dice, face, style, face.width * 0.4, face.height * 0.25)
            body = body.with_children(lock)
        made.add(body)
    return made.bodies()


def _shoe_cabinet(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice) if dice.chance(0.8) else looks.painted_metal(dice)
    size = any_size(dice, (0.5, 0.17, 0.6), (1.2, 0.35, 1.8))
    board = dice.between(0.012, 0.02)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    if dice.chance(0.5):
        stand(made, dice, size, look, 0.15)
    crown(made, dice, size, look)
    count = max(1, min(4, round(size[2] / dice.between(0.33, 0.5))))
    if dice.chance(0.35):
        opening, top = rows(made, opening, (0.8, 0.2), board, look)
        fill(made, dice, style, top, dice.pick(("drawer", "flap_up", "open")), look)
    across = 2 if size[0] > 0.8 and dice.chance(0.6) else 1
    for column in columns(made, opening, [1.0] * across, board, look):
        gap = board if dice.chance(0.4) or style.inset else 0.0
        for cell in _rows(made, column, [1.0] * count, gap, look):
            made.add(_tilting(dice, style, cell))
    return made.bodies()


def _tilting(dice: Dice, style: Style, opening: Opening) -> Leaf:
    """A flap hinged at its bottom that carries pockets for shoes."""
    leaf = leaves.flap(dice, style, opening, -1, "flap")
    upper = np.radians(dice.between(30, 60))
    motion = replace(leaf.motion, upper=float(upper))
    face = Face.of(style, opening)
    parts = list(leaf.surfaces)
    deep = min(opening.depth * 0.6, 0.2 * opening.height)
    wide, x, z = opening.width * 0.94, opening.center[0], opening.low
    # Pockets stay inside a circle about the hinge that the room holds.
    for k in range(dice.whole(0, 2)):
        level = z + opening.height * (0.12 + 0.36 * k)
        tray = open_box((wide, deep, 0.2 * opening.height), 0.006)
        tilt = turned([tray], rotation((1, 0, 0), -dice.between(0.0, 0.15)))
        parts.append(surface(moved(tilt, (x, face.back + deep / 2 + 0.01, level)), style.inner))
    cheek = between((-0.004, 0, 0), (0.004, deep, opening.height * 0.6))
    sides = [(x + s * wide / 2, face.back, z + 0.05 * opening.height) for s in (-1, 1)]
    if dice.chance(0.6):
        parts.append(surface([cheek + np.array(spot) for spot in sides], style.inner))
    return replace(leaf, surfaces=tuple(parts), motion=motion)


CATEGORIES: tuple[Category, ...] = (
    Category("drawer_chest", until_moving(_drawer_chest)),
    Category("nightstand", until_moving(_nightstand)),
    Category("tool_chest", _tool_chest),
    Category("filing_cabinet", _filing_cabinet),
    Category("shoe_cabinet", _shoe_cabinet),
)
