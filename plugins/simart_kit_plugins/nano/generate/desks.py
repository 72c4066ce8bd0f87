"""Desks: drawers at the left, right, back and sides, under the top, in a top part; lids and roll tops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import between, box, boxes, cylinder, prism, sheet
from . import leaves, looks
from .assembly import Assembly, Leaf, until_moving
from .carcass import Size, board, even_or_random, fill, posts
from .category import Category
from .objects import Body, Look, hinge, slide, surface
from .styles import Opening, Style, random_style


def _desk(dice: Dice) -> Sequence[Body]:
    make = dice.weighted([(10, _writing_desk), (2, _school_desk), (1.5, _roll_top)])
    return make(dice)


def _writing_desk(dice: Dice) -> Sequence[Body]:
    made, look, style, size = _begun(dice)
    width, depth, height = size
    thick = dice.between(0.016, 0.04)
    made.fix([prism(_top(dice, width / depth), (width, depth, thick)) + [0, 0, height - thick / 2]], look)
    _under(made, dice, style, (width * 0.98, depth * 0.96, height - thick), look)
    if dice.chance(0.25):
        _hutch(made, dice, style, size, look)
    return made.bodies()


def _begun(dice: Dice) -> tuple[Assembly, Look, Style, Size]:
    look = looks.wood(dice) if dice.chance(0.85) else looks.painted_metal(dice)
    style = random_style(dice, look)
    style = replace(style, long=min(style.long, 0.2))
    size = (dice.between(0.8, 1.9), dice.between(0.45, 0.85), dice.between(0.68, 0.8))
    return Assembly("body"), look, style, size


def _top(dice: Dice, aspect: float) -> FloatArray:
    return SQUARE if dice.chance(0.7) else rounded(dice.between(0.02, 0.1) / aspect, aspect)


def _under(made: Assembly, dice: Dice, style: Style, size: Size, look: Look) -> None:
    """What carries the top: pedestals or legs at its ends, and what hangs between them."""
    width, depth, height = size
    wide = min(dice.between(0.3, 0.48), 0.38 * width)
    ends = dice.weighted([(3, (True, False)), (3, (False, True)), (3, (True, True)), (3, (False, False))])
    post = dice.between(0.03, 0.06)
    legs, other = posts(width, depth, height, post), dice.pick((look, looks.metal(dice)))
    inner = [-width / 2 + post, width / 2 - post]
    for k, has in enumerate(ends):
        start = -width / 2 if k == 0 else width / 2 - wide
        if has:
            _pedestal(made, dice, style, (start, start + wide), depth, height, look)
            inner[k] = start + wide if k == 0 else start
        elif dice.chance(0.3):
            made.fix([between((inner[k] - 0.01, -depth / 2, 0), (inner[k] + 0.01, depth / 2, height))], look)
        else:
            made.fix([part[(-1 if k == 0 else 1) * part[..., 0].mean(axis=1) > 0] for part in legs], other)
    _between_ends(made, dice, style, (inner[0], inner[1]), depth, height, look)
    if not any(ends) and dice.chance(0.5):
        _side_drawers(made, dice, style, size, post)


def _pedestal(
    made: Assembly, dice: Dice, style: Style, ends: tuple[float, float], depth: float, high: float, look: Look
) -> None:
    """A unit of drawers or a cupboard, down to the floor or to feet, some with the drawers at its back."""
    board, (left, right) = dice.between(0.012, 0.02), ends
    low = dice.pick((0.0, 0.0, 0.08, 0.35)) * high
    y = depth / 2
    boards = [between((x, -y, low), (x + board, y, high)) for x in (left, right - board)]
    boards.append(between((left + board, -y, low), (right - board, y, low + board)))
    boards.append(between((left + board, y - board, low + board), (right - board, y, high)))
    made.fix(boards, look)
    if low > 0:
        feet = [(x, s * (y - 0.03), low / 2) for x in (left + 0.02, right - 0.02) for s in (-1, 1)]
        made.fix([boxes((0.03, 0.03, low), feet)], dice.pick((look, looks.metal(dice))))
    room = Opening(
        left + board, right - board, low + board, high - 0.003, -y, depth - board, (board * 0.9,) * 3 + (0.0,)
    )
    if dice.chance(0.3):
        cell, top = room.rows((dice.between(1.5, 4), 1), 0.0)
        made.add(leaves.drawer(dice, style, top))
        kind = dice.pick(("door", "drawer", "decoy"))
        fill(made, dice, style, cell, kind, look)
        return
    count = dice.whole(2, 4) if dice.chance(0.8) else 1
    shares = sorted(even_or_random(dice, count), reverse=True)
    for cell in room.rows(shares, 0.0):
        kind = "door" if count == 1 else dice.weighted([(12, "drawer"), (1, "open"), (1, "decoy")])
        fill(made, dice, style, cell, kind, look)


def _between_ends(
    made: Assembly, dice: Dice, style: Style, ends: tuple[float, float], depth: float, high: float, look: Look
) -> None:
    """A pencil drawer, several of them, a keyboard tray, or an apron; and a panel at the back."""
    left, right = ends
    y, tall = depth / 2, dice.between(0.06, 0.14)
    panel = dice.between(0.1, 0.6) * high if dice.chance(0.5) else None
    kind = dice.weighted([(5, "drawers"), (2, "tray"), (2, "apron"), (1, "back"), (3, "nothing")])
    from_behind = kind == "back" and abs(left + right) < 0.05
    if panel is not None:
        top = high - tall if from_behind else high
        made.fix([between((left, y - 0.03, panel), (right, y - 0.015, top))], look)
    if kind == "tray":
        made.add(_keyboard_tray(dice, style, ends, depth, high))
        return
    if kind == "nothing":
        return
    behind = 0.1 if kind == "apron" else depth * 0.75
    slim = 0.012
    made.fix([between((left, -y + 0.02, high - tall), (left + slim, -y + behind, high))], look)
    made.fix([between((right - slim, -y + 0.02, high - tall), (right, -y + behind, high))], look)
    room = Opening(left + slim, right - slim, high - tall, high - 0.003, -y + 0.02, behind)
    if kind == "apron":
        made.fix([between((left, -y + 0.02, high - tall), (right, -y + 0.04, high))], look)
        if dice.chance(0.4):
            made.dress(*leaves.drawer_front(style, replace(room, front=-y + 0.02)))
        return
    count = 1 if room.width < 0.7 and dice.chance(0.7) else dice.whole(1, 3)
    for cell in room.columns([1.0] * count, slim):
        leaf = leaves.drawer(dice, style, cell, "pencil_drawer" if count == 1 else "drawer")
        # Some desks are used from both sides, or have theirs at the back only.
        made.add(leaves.facing(leaf, 2) if from_behind else leaf)
    for cell in room.columns([1.0] * count, slim)[1:]:
        made.fix([between((cell.left - slim, -y + 0.02, high - tall), (cell.left, -y + behind, high))], look)


def _keyboard_tray(dice: Dice, style: Style, ends: tuple[float, float], depth: float, high: float) -> Leaf:
    """A board below the top that slides out."""
    left, right = ends
    wide = min(right - left - 0.02, dice.between(0.5, 0.9))
    middle, deep = (left + right) / 2, dice.between(0.25, 0.4)
    low, front_y = high - dice.between(0.07, 0.12), -depth / 2 + dice.between(0.0, 0.05)
    plate = between((middle - wide / 2, front_y, low), (middle + wide / 2, front_y + deep, low + 0.016))
    rails = [
        between((x - 0.006, front_y + 0.05, low + 0.016), (x + 0.006, front_y + deep, high - 0.002))
        for x in (middle - wide / 2 + 0.01, middle + wide / 2 - 0.01)
    ]
    parts = [surface([plate], style.look), surface(rails, style.grip)]
    if dice.chance(0.3):
        edge = between((middle - wide / 2, front_y - 0.012, low), (middle + wide / 2, front_y, low + 0.04))
        parts.append(surface([edge], style.inner))
    return Leaf(
        "keyboard_tray", "keyboard tray", tuple(parts), slide((0, -1, 0), deep * dice.between(0.6, 0.9))
    )


def _side_drawers(made: Assembly, dice: Dice, style: Style, size: Size, post: float) -> None:
    """Drawers that open at the ends, between the legs."""
    width, depth, high = size
    tall, deep = dice.between(0.06, 0.12), min(0.28, 0.35 * width)
    wide = depth - 2 * post - 0.01
    for quarter in dice.pick(((1,), (3,), (1, 3))):
        room = Opening(-wide / 2, wide / 2, high - 0.2 - tall, high - 0.2, -width / 2, deep)
        made.add(leaves.facing(leaves.drawer(dice, style, room, "side_drawer"), quarter))
        x = width / 2 * (1 if quarter == 1 else -1)
        low, middle = high - 0.206 - tall, x - np.sign(x) * deep / 2
        # A board below, between straps down from the top.
        plate = box((deep, wide + 0.016, 0.004), (middle, 0, low))
        straps = [(middle, s * (wide / 2 + 0.006), (low + high) / 2) for s in (-1, 1)]
        made.fix([plate, boxes((deep * 0.9, 0.004, high - low), straps)], style.look)


def _hutch(made: Assembly, dice: Dice, style: Style, size: Size, look: Look) -> None:
    """A top part at the back of the desk with small rooms, drawers and doors."""
    width, depth, height = size
    tall, deep, board = dice.between(0.2, 0.6), dice.between(0.15, 0.3), 0.015
    wide, y = width * dice.pick((1.0, 0.96)), depth / 2
    x, near, top = wide / 2, y - deep, height + tall
    made.fix([between((s, near, height), (s + board, y, top)) for s in (-x, x - board)], look)
    made.fix(
        [between((-x, near, top), (x, y, top + board)), between((-x, y - 0.006, height), (x, y, top))], look
    )
    room = Opening(-x + board, x - board, height, top, near, deep - 0.006)
    small = replace(style, lift=-style.thick, long=min(style.long, 0.06))
    for k, cell in enumerate(room.columns(even_or_random(dice, dice.whole(2, 4)), board)):
        if k:
            made.fix([between((cell.left - board, near, height), (cell.left, y, top))], look)
        kind = dice.weighted([(3, "open"), (2, "drawers"), (1, "door"), (1, "flap_up")])
        fill(made, dice, small, cell, kind, look)


def _school_desk(dice: Dice) -> Sequence[Body]:
    """A box with a sloped lid hinged at its back, on legs."""
    made, look, style, _ = _begun(dice)
    width, depth, height = dice.between(0.55, 1.1), dice.between(0.4, 0.6), dice.between(0.5, 0.8)
    wall, front_high = dice.between(0.012, 0.02), dice.between(0.07, 0.14)
    slope = dice.between(0.05, 0.35)
    shelf = dice.between(0.05, 0.12)
    x, y = width / 2, depth / 2
    back_high = front_high + slope * (depth - shelf)
    loop = np.array([[-y, 0], [y, 0], [y, back_high], [y - shelf, back_high], [-y, front_high]])
    for side in (-1, 1):
        made.fix(moved([pointed(board(loop, wall), X)], (side * (x - wall / 2), 0, height)), look)
    inner = x - wall
    made.fix([between((-inner, -y, height), (inner, y, height + wall))], look)
    made.fix([between((-inner, -y, height), (inner, -y + wall, height + front_high))], look)
    made.fix([between((-inner, y - shelf, height + back_high - wall), (inner, y, height + back_high))], look)
    made.fix([between((-inner, y - wall, height), (inner, y, height + back_high))], look)
    legs = posts(width * dice.between(0.8, 0.98), depth * 0.95, height, dice.between(0.025, 0.05))
    made.fix(legs, dice.pick((look, looks.metal(dice))))
    pin, along = np.array([0, y - shelf, height + back_high]), np.hypot(1, slope) * (depth - shelf)
    thick, over = dice.between(0.012, 0.022), dice.between(0.0, 0.02)
    two = width > 0.85 and dice.chance(0.6)
    for name, middle, wide in _halves(width, two):
        plate = between((middle - wide / 2, -along - over, 0.001), (middle + wide / 2, 0, thick))
        lid = turned([plate], rotation((1, 0, 0), np.arctan(slope)))
        motion = hinge(pin, (-1, 0, 0), np.radians(dice.between(60, 95)))
        made.add(Leaf(name, "lid", (surface(moved(lid, pin), style.look),), motion))
    if dice.chance(0.3):
        _under_shelf(made, width, depth, height, look)
    return made.bodies()


def _halves(width: float, two: bool) -> list[tuple[str, float, float]]:
    if not two:
        return [("lid", 0.0, width)]
    half = width / 2 - 0.002
    return [("left_lid", -width / 4, half), ("right_lid", width / 4, half)]


def _under_shelf(made: Assembly, width: float, depth: float, height: float, look: Look) -> None:
    made.fix([box((width * 0.78, depth * 0.8, 0.015), (0, 0, 0.3 * height))], look)


def _roll_top(dice: Dice) -> Sequence[Body]:
    """A desk with a quarter of a drum over its back half, which turns back into its top part."""
    made, look, style, size = _begun(dice)
    width, depth, height = size
    made.fix([between((-width / 2, -depth / 2, height - 0.025), (width / 2, depth / 2, height))], look)
    _under(made, dice, style, (width * 0.98, depth * 0.96, height - 0.025), look)
    # Behind the middle of the drum there is room for the part that turns back.
    radius, wall = min(dice.between(0.2, 0.32), 0.44 * depth), 0.02
    pin = np.array([0.0, depth / 2 - 0.026 - radius, height + 0.004])
    x = width / 2
    angle = np.linspace(0, np.pi / 2, 9)
    rim = np.column_stack([-np.cos(angle), np.sin(angle)]) * (radius + 0.012) + pin[1:]
    loop = np.concatenate([[[depth / 2, height]], rim, [[depth / 2, pin[2] + radius + 0.012]]])
    for side in (-1, 1):
        made.fix(moved([pointed(board(loop, wall), X)], (side * (x - wall / 2), 0, 0)), look)
    top = pin[2] + radius + 0.012
    made.fix([between((-x, pin[1] - 0.02, top), (x, depth / 2, top + 0.02))], look)
    made.fix([between((-x, depth / 2 - 0.012, height), (x, depth / 2, top))], look)
    room = x - wall - 0.003
    shell = _slats(dice, angle[:-1] if dice.chance(0.5) else angle, radius, room)
    parts = [surface(moved(shell, pin), dice.pick((look, style.look)))]
    grip = pointed(cylinder(0.01, 0.02, 8), Y) - [0, radius + 0.012, -0.03]
    parts.append(surface(moved([grip + [s * room * 0.5, 0, 0] for s in (-1, 1)], pin), style.grip))
    made.add(
        Leaf("roll_top", "roll top", tuple(parts), hinge(pin, (-1, 0, 0), np.radians(dice.between(60, 85))))
    )
    return made.bodies()


def _slats(dice: Dice, angle: FloatArray, radius: float, room: float) -> list[FloatArray]:
    """Part of a drum about the x axis, from its front up, of slats or smooth."""
    if dice.chance(0.6):
        turns = np.linspace(angle[0] + 0.05, angle[-1] - 0.05, 14)
        slat = box((2 * room, 0.008, 0.09 * radius), (0, -radius + 0.004, 0))
        return [piece for turn in turns for piece in turned([slat], rotation((1, 0, 0), -turn))]
    rings = []
    for reach in (radius, radius - 0.008):
        arc = np.column_stack([-np.cos(angle), np.sin(angle)]) * reach
        rings.append(np.stack([np.insert(arc, 0, s * room, axis=1) for s in (-1, 1)]))
    return [sheet(rings[0]), sheet(rings[1])]


CATEGORIES: tuple[Category, ...] = (Category("desk", until_moving(_desk)),)
