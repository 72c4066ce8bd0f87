"""Bookcases with doors, and cases of glass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import rotation, turned
from ...shapes.primitives import between, box, boxes
from . import leaves, looks
from .assembly import Assembly, Leaf
from .carcass import (
    Size,
    any_size,
    carcass,
    columns,
    crown,
    even_or_random,
    fill,
    posts,
    rows,
    side_panels,
    stand,
)
from .category import Category
from .objects import Body, Look, hinge, surface
from .styles import Opening, Style, random_style


def _bookcase(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    size, board = any_size(dice, (0.5, 0.25, 1.0), (1.8, 0.45, 2.3)), dice.between(0.014, 0.03)
    made, style = Assembly("body"), random_style(dice, look)
    opening = carcass(made, dice, size, board, look)
    stand(made, dice, size, look, 0.12)
    crown(made, dice, size, look)
    side_panels(made, dice, size, look)
    plan = dice.weighted([(4, "below"), (2, "whole"), (2, "above"), (1, "middle")])
    shares = {"below": (0.4, 1), "above": (0.5, 1), "middle": (1, 0.6, 1), "whole": (1,)}[plan]
    shut = {"below": (0,), "above": (1,), "middle": (1,), "whole": (0,)}[plan]
    glass = dice.chance(0.75 if plan in ("whole", "above") else 0.1)
    across = max(1, round(size[0] / dice.between(0.4, 0.8)))
    for k, level in enumerate(rows(made, opening, shares, board, look)):
        for cell in columns(made, level, even_or_random(dice, across), board, look):
            shown = style.clear() if glass else style
            kind = "open"
            if k in shut:
                kind = "pair" if cell.width > 0.5 else "door"
                kind = dice.weighted([(6, kind), (1, "drawers"), (0.5, "sliding"), (0.5, "flap_down")])
            fill(made, dice, shown if kind != "drawers" else style, cell, kind, look)
    return made.bodies()


def _display_case(dice: Dice) -> Sequence[Body]:
    return _counter(dice) if dice.chance(0.3) else _tower(dice)


def _tower(dice: Dice) -> Sequence[Body]:
    """Posts with panes between them, a base and a head; a glass door, a pair, or sliding panes."""
    look = looks.wood(dice) if dice.chance(0.5) else looks.metal(dice)
    width, depth, height = any_size(dice, (0.35, 0.25, 0.4), (1.4, 0.5, 1.9))
    made = Assembly("body")
    style = replace(random_style(dice, look, dice.between(0.008, 0.02)), look=look).clear()
    post, base = dice.between(0.015, 0.04), dice.between(0.02, 0.35) * height
    made.fix(posts(width, depth, height, post), look)
    head = dice.between(0.015, 0.06)
    made.fix([between((-width / 2, -depth / 2, height), (width / 2, depth / 2, height + head))], look)
    _base_box(made, dice, style, (width, depth, base), look)
    x, y, thin = width / 2, depth / 2, 0.005
    middle = (base + height) / 2
    sides = [(s * (x - post / 2), 0, middle) for s in (-1, 1)]
    made.fix([boxes((thin, depth - 2 * post, height - base), sides)], style.pane)
    back = box((width - 2 * post, thin, height - base), (0, y - post / 2, middle))
    made.fix([back], dice.pick((style.pane, look, looks.metal(dice))))
    room = Opening(-x + post, x - post, base, height, -y, depth - post, (post * 0.9, post * 0.9, 0.0, 0.0))
    for level in np.linspace(base, height, dice.whole(1, 5) + 1)[1:-1]:
        deep = depth - 2 * post - style.reach - 0.02
        plate = box((room.width, deep, 0.006), (0, y - post - deep / 2, level))
        made.fix([plate], style.pane)
    _glass_doors(made, dice, style, room)
    return made.bodies()


def _base_box(made: Assembly, dice: Dice, style: Style, size: Size, look: Look) -> None:
    """What a case of glass stands on; a drawer in some."""
    width, depth, height = size
    x, y = width / 2, depth / 2
    if height < 0.12 or dice.chance(0.5):
        made.fix([between((-x, -y, 0), (x, y, height))], look)
        return
    thick = 0.015
    sides = [(s * (x - thick / 2), 0, height / 2) for s in (-1, 1)]
    made.fix([boxes((thick, depth, height), sides)], look)
    made.fix([between((-x + thick, -y, z), (x - thick, y, z + thick)) for z in (0, height - thick)], look)
    made.fix([between((-x + thick, y - thick, thick), (x - thick, y, height - thick))], look)
    room = Opening(-x + thick, x - thick, thick, height - thick, -y, depth - thick, (thick * 0.8,) * 4)
    plain = replace(style, make=random_style(dice, look).make)
    kind = "pair" if width > 0.6 and height > 0.25 else "drawer"
    fill(made, dice, plain, room, kind, look)


def _glass_doors(made: Assembly, dice: Dice, style: Style, room: Opening) -> None:
    kind = dice.weighted([(4, "door"), (2, "pair"), (2, "sliding")])
    if kind == "sliding" and room.width > 0.4:
        for leaf in leaves.sliding(dice, style, room, 2):
            made.add(leaf)
    elif kind == "pair" and room.width > 0.4:
        for leaf in leaves.pair(dice, style, room):
            made.add(leaf)
    else:
        side = dice.sign()
        leaf = leaves.door(dice, style, room, side)
        if dice.chance(0.25):
            leaf = leaves.door(dice, style.bare(), room, side)
            leaf = leaf.with_children(leaves.turning_grip(dice, style, room, side))
        made.add(leaf)


def _counter(dice: Dice) -> Sequence[Body]:
    """A flat case on legs or a base with a glass lid, level or sloped towards the front."""
    look = looks.wood(dice) if dice.chance(0.7) else looks.metal(dice)
    width, depth, tall = any_size(dice, (0.4, 0.3, 0.08), (1.6, 0.7, 0.35))
    made, style = Assembly("body"), random_style(dice, look)
    slope = dice.pick((0.0, 0.0, dice.between(0.05, 0.5)))
    rim, x, y = dice.between(0.015, 0.03), width / 2, depth / 2
    made.fix([between((-x, -y, 0), (x, y, rim))], dice.pick((look, looks.fabric(dice))))
    rise = slope * depth
    wall = dice.pick((look, style.pane))
    made.fix(
        [between((-x, -y, rim), (x, -y + 0.008, tall)), between((-x, y - 0.008, rim), (x, y, tall + rise))],
        wall,
    )
    sheer = box((0.008, depth - 0.016, tall - rim), (0, 0, (tall + rim) / 2))
    sheer[..., 2] += np.where(sheer[..., 2] > rim + 1e-9, slope * (sheer[..., 1] + y), 0.0)
    made.fix([sheer + [s * (x - 0.004), 0, 0] for s in (-1, 1)], wall)
    under = dice.between(0.1, 0.9)
    made.fix([part - [0, 0, under] for part in posts(width, depth, under, dice.between(0.02, 0.06))], look)
    if under > 0.4 and dice.chance(0.3):
        made.fix([between((-x * 0.94, -y * 0.9, 0.02 - under), (x * 0.94, y * 0.9, 0.04 - under))], look)
    made.add(_glass_lid(dice, style, (width, depth, tall + rise), slope))
    return made.bodies()


def _glass_lid(dice: Dice, style: Style, size: Size, slope: float) -> Leaf:
    """Hinged along the back edge, or along the front one."""
    width, depth, high = size
    long, border = depth * np.hypot(1, slope), dice.between(0.015, 0.05)
    lid = leaves.flat_lid(replace(style.clear(), thick=0.02), width, long, border)
    pin = np.array([0.0, depth / 2, high + 0.001])
    tilt = rotation((1, 0, 0), float(np.arctan(slope)))
    parts = tuple(surface([piece + pin for piece in turned([one.triangles], tilt)], one.look) for one in lid)
    return Leaf("lid", "lid", parts, hinge(pin, (-1, 0, 0), np.radians(dice.between(60, 100))))


CATEGORIES: tuple[Category, ...] = (
    Category("bookcase_with_doors", _bookcase),
    Category("display_case", _display_case),
)
