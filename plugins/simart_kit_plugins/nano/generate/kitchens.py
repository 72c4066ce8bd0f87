"""Kitchen furniture: base, wall, tall and corner units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import rotation
from ...shapes.primitives import Pieces, between, open_box, rod, tube, vessel
from . import leaves, looks
from .assembly import Assembly, Leaf, until_moving
from .carcass import Size, any_size, board, carcass, columns, even_or_random, fill, rows
from .category import Category
from .objects import Body, Look, slide, surface
from .styles import Face, Opening, Style, grip, panel, random_style


def _kitchen_unit(dice: Dice) -> Sequence[Body]:
    return dice.weighted([(5, _base), (3, _wall), (2, _tall), (1.5, _corner)])(dice)


def _style(dice: Dice, look: Look) -> Style:
    style = random_style(dice, look, dice.between(0.015, 0.024))
    lift = dice.weighted([(5, 0.0), (2, 0.002), (1, -style.thick)])
    return replace(style, lift=lift, long=dice.spread(0.1, 0.45))


def _plinth(made: Assembly, dice: Dice, size: Size, look: Look) -> None:
    width, depth, _ = size
    tall, recess = dice.between(0.06, 0.16), dice.between(0.03, 0.08)
    made.fix(
        [between((-width / 2, -depth / 2 + recess, -tall), (width / 2, depth / 2, 0))], looks.darker(look)
    )


def _worktop(made: Assembly, dice: Dice, size: Size) -> None:
    """A plate over a base unit; some with a sink and a tap."""
    width, depth, height = size
    look, thick, over = looks.wood(dice), dice.between(0.015, 0.045), dice.between(0.01, 0.03)
    low, high = (
        (-width / 2 - over / 2, -depth / 2 - over, height),
        (width / 2 + over / 2, depth / 2, height + thick),
    )
    made.fix([between(low, high)], look)
    top = height + thick
    if dice.chance(0.2) and width > 0.5:
        x = dice.between(-0.2, 0.2) * width
        steel = looks.metal(dice)
        made.fix([open_box((0.42, 0.38, 0.01), 0.02) + [x, -0.03, top]], steel)
        path = [(x, 0.2, top), (x, 0.2, top + 0.25), (x, 0.12, top + 0.3), (x, 0.03, top + 0.22)]
        made.fix([tube(path, 0.012, 8)], steel)
    elif dice.chance(0.3):
        made.fix([between((-width / 2, depth / 2 - 0.015, top), (width / 2, depth / 2, top + 0.08))], look)


def _base(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    made, style = Assembly("body"), _style(dice, look)
    size = any_size(dice, (0.3, 0.5, 0.65), (2.4, 0.62, 0.8))
    opening = carcass(made, dice, size, 0.017, look)
    _plinth(made, dice, size, look)
    if dice.chance(0.85):
        _worktop(made, dice, size)
    count = max(1, round(size[0] / dice.between(0.4, 0.7)))
    for cell in columns(made, opening, even_or_random(dice, count), 0.017, look):
        _base_column(made, dice, style, cell, look)
    return made.bodies()


def _base_column(made: Assembly, dice: Dice, style: Style, cell: Opening, look: Look) -> None:
    kind = dice.weighted([(4, "door"), (3, "drawers"), (3, "mixed"), (1, "larder"), (1, "bins"), (1, "open")])
    if kind == "larder" and cell.width < 0.45:
        made.add(_larder(dice, style, cell))
        return
    if kind == "bins" and cell.width > 0.3:
        made.add(_bins(dice, style, cell))
        return
    if kind == "drawers":
        count = dice.whole(2, 4)
        for k, room in enumerate(cell.rows([2.0] * (count - 1) + [1.0], 0.0)):
            leaf = leaves.drawer(dice, style, room)
            # A small drawer behind the lowest front looks like nothing from outside.
            made.add(_with_inner(dice, style, room, leaf) if k == 0 and dice.chance(0.15) else leaf)
        return
    if kind == "mixed":
        cell, top = rows(made, cell, (4, 1), 0.017, look)
        fill(made, dice, style, top, dice.pick(("drawer", "drawer", "decoy")), look)
    shown = style.clear() if dice.chance(0.1) else style
    closed = "pair" if cell.width > 0.5 else "door"
    fill(made, dice, shown, cell, "open" if kind == "open" else closed, look)


def _with_inner(dice: Dice, style: Style, room: Opening, leaf: Leaf) -> Leaf:
    """A drawer with a second one that slides in it, as for cutlery."""
    wide, deep = room.width - 0.07, room.depth * 0.35
    start = room.front + style.reach + 0.03
    tray = open_box((wide, deep, 0.05), 0.006) + [room.center[0], start + deep / 2, room.high - 0.06]
    motion = slide((0, 1, 0), room.depth * 0.35)
    return leaf.with_children(Leaf("inner_tray", "tray", (surface([tray], style.inner),), motion))


def _larder(dice: Dice, style: Style, cell: Opening) -> Leaf:
    """A tall front that slides out with racks behind it."""
    face = Face.of(style, cell)
    pieces = panel(style, face)
    pieces += grip(style, face, 0, dice.between(0.0, 0.3) * face.height, True, 0.4 * face.height)
    wide, deep = cell.width - 0.03, cell.depth * dice.between(0.8, 0.95) - style.reach
    x, start = cell.center[0], face.back
    levels = np.linspace(cell.low + 0.02, cell.high - 0.25, dice.whole(2, 5))
    racks = [open_box((wide, deep, 0.07), 0.006) + [x, start + deep / 2, level] for level in levels]
    bars = [
        rod((x, y, cell.low + 0.02), (x, y, cell.high - 0.05), 0.008, 8)
        for y in (start + 0.02, start + deep - 0.02)
    ]
    pieces += [surface(racks, looks.metal(dice)), surface(bars, style.grip)]
    return Leaf(
        "larder", "pull out larder", tuple(pieces), slide((0, -1, 0), deep * dice.between(0.75, 0.95))
    )


def _bins(dice: Dice, style: Style, cell: Opening) -> Leaf:
    """A front that slides out with bins on a carrier, which can be lifted out."""
    face = Face.of(style, cell)
    pieces = panel(style, face)
    pieces += grip(style, face, 0, 0.35 * face.height, False, 0.5 * face.width)
    deep, wide = cell.depth * 0.9 - style.reach, cell.width - 0.03
    x, start = cell.center[0], face.back
    plate = between((x - wide / 2, start, cell.low + 0.02), (x + wide / 2, start + deep, cell.low + 0.035))
    pieces.append(surface([plate], looks.metal(dice)))
    count = dice.whole(1, 3)
    step, outline = deep / count, rounded(0.12)
    tall = min(0.55, 0.7 * cell.height)
    bins: Pieces = [
        vessel(outline, (wide * 0.85, step * 0.8, tall), 0.006, 1.1)
        + [x, start + (k + 0.5) * step, cell.low + 0.036]
        for k in range(count)
    ]
    pieces.append(surface(bins, looks.plastic(dice)))
    return Leaf("bin_drawer", "drawer", tuple(pieces), slide((0, -1, 0), deep * dice.between(0.7, 0.95)))


def _wall(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    made, style = Assembly("body"), _style(dice, look)
    size = any_size(dice, (0.3, 0.28, 0.3), (1.8, 0.4, 1.0))
    opening = carcass(made, dice, size, 0.017, look)
    count = max(1, round(size[0] / dice.between(0.4, 0.9)))
    glass = dice.chance(0.3)
    for cell in columns(made, opening, even_or_random(dice, count), 0.017, look):
        shown = style.clear() if glass and dice.chance(0.7) else style
        closed = "pair" if cell.width > 0.5 else "door"
        kind = dice.weighted([(5, closed), (2, "flap_up"), (1, "open"), (0.5, "sliding"), (0.7, "stacked")])
        if kind == "stacked":
            for room in rows(made, cell, (1, 1), 0.017, look):
                fill(made, dice, shown, room, "flap_up", look)
        else:
            fill(made, dice, shown, cell, "flap_up" if kind == "open" and count == 1 else kind, look)
    if dice.chance(0.2):
        steel = looks.metal(dice)
        made.fix(
            [between((-size[0] / 2, -size[1] / 2 + 0.02, -0.03), (size[0] / 2, -size[1] / 2 + 0.03, 0))],
            steel,
        )
    return made.bodies()


def _tall(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    made, style = Assembly("body"), _style(dice, look)
    size = any_size(dice, (0.3, 0.5, 1.7), (0.9, 0.62, 2.3))
    opening = carcass(made, dice, size, 0.017, look)
    _plinth(made, dice, size, look)
    if size[0] < 0.6 and dice.chance(0.4):
        made.add(_larder(dice, style, opening))
        return made.bodies()
    count = dice.whole(2, 3)
    for k, cell in enumerate(rows(made, opening, even_or_random(dice, count), 0.017, look)):
        closed = "pair" if cell.width > 0.55 else "door"
        kind = dice.weighted(
            [(5, closed), (1.5, "drawers"), (1, "open"), (1.0 if k == count - 1 else 0, "flap_up")]
        )
        fill(made, dice, style, cell, kind, look)
    return made.bodies()


def _corner(dice: Dice) -> Sequence[Body]:
    """A unit for the corner of a room, its front across at 45 degrees."""
    look = looks.wood(dice)
    made, style = Assembly("body"), _style(dice, look)
    hung = dice.chance(0.4)
    side, arm = (dice.between(0.55, 0.7), 0.32) if hung else (dice.between(0.8, 0.95), 0.55)
    height, thick, half = dice.between(0.5, 0.95) if hung else dice.between(0.65, 0.8), 0.017, side / 2
    loop = np.array([[-half, half], [half, half], [half, -half], [half - arm, -half], [-half, half - arm]])
    plates = [board(loop, thick) + [0, 0, z] for z in (thick / 2, height - thick / 2)]
    inner = height - thick
    plates.append(between((-half, half - thick, thick), (half, half, inner)))
    plates.append(between((half - thick, -half, thick), (half, half - thick, inner)))
    plates.append(between((-half, half - arm, thick), (-half + thick, half - thick, inner)))
    plates.append(between((half - arm, -half, thick), (half - thick, -half + thick, inner)))
    made.fix(plates, look)
    if dice.chance(0.7):
        made.fix([board(loop * 0.93, 0.012) + [0.01, 0.01, height * z] for z in (0.35, 0.68)], look)
    if not hung:
        made.fix([board(loop * 0.9, 0.1) + [0.02, 0.02, -0.05]], looks.darker(look))
        made.fix([board(loop * 1.02, 0.03) + [0, 0, height + 0.015]], looks.wood(dice))
    long = (side - arm) * np.sqrt(2) / 2
    borders = (0.0, 0.0, 0.8 * thick, 0.8 * thick)
    room = Opening(-long, long, thick, inner, -arm / np.sqrt(2) - 0.001, 0.3, borders)
    shown = replace(style, lift=max(style.lift, 0.0))
    shown = shown.clear() if dice.chance(0.2) else shown
    two = dice.chance(0.25)
    closed = leaves.pair(dice, shown, room) if two else [leaves.door(dice, shown, room, dice.sign())]
    for leaf in closed:
        made.add(leaf.turned(rotation((0, 0, 1), -np.pi / 4)))
    return made.bodies()


CATEGORIES: tuple[Category, ...] = (Category("kitchen_unit", until_moving(_kitchen_unit)),)
