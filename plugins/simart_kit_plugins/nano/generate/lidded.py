"""Chests and boxes: lids of every kind."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import front
from ...shapes.handles import handle
from ...shapes.legs import feet
from ...shapes.placing import X, mirrored, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, open_box, rod, sheet, tube
from . import looks
from .assembly import Assembly, Leaf
from .carcass import Size, any_size, board
from .category import Category
from .objects import Body, Look, free, hinge, slide, surface

_UPSIDE_DOWN = rotation((1, 0, 0), np.pi)


def _chest(dice: Dice) -> Sequence[Body]:
    look = (
        looks.wood(dice) if dice.chance(0.7) else dice.pick((looks.plastic(dice), looks.painted_metal(dice)))
    )
    size = any_size(dice, (0.25, 0.2, 0.12), (1.4, 0.7, 0.7))
    width, depth, height = size
    wall = dice.between(0.006, 0.03) * min(1.0, 3 * depth)
    made, trim = Assembly("body"), looks.metal(dice)
    made.fix([open_box(size, wall)], look)
    _outside(made, dice, size, wall, look, trim)
    stand = dice.unit()
    if stand < 0.3:
        made.fix(feet(dice, width, depth, dice.between(0.03, 0.12)), look)
    elif stand < 0.5:
        made.fix([box((width + 2 * wall, depth + 2 * wall, 0.06), (0, 0, 0.03))], look)
    lid, rise = _lid(dice, size, wall, look)
    parts = [surface(lid, look)]
    if dice.chance(0.45):
        pull = moved(handle(dice, min(0.2, 0.3 * width)), (0, -depth / 2, height + 0.5 * rise))
        parts.append(surface(pull, trim))
    if dice.chance(0.3):
        straps = boxes(
            (0.08 * width, 0.004, rise * 0.9),
            [(s * width / 4, -depth / 2 - 0.002, height + rise / 2) for s in (-1, 1)],
        )
        parts.append(surface([straps], trim))
    pin = (0, depth / 2, height)
    upper = np.radians(dice.between(70, 115))
    motion = hinge(pin, (-1, 0, 0), upper)
    if dice.chance(0.6):
        barrels = [
            rod(
                (x - 0.04 * width, depth / 2 + wall / 3, height),
                (x + 0.04 * width, depth / 2 + wall / 3, height),
                wall / 3,
                8,
            )
            for x in (-0.3 * width, 0.3 * width)
        ]
        parts.append(surface(barrels, trim))
    leaf = Leaf("lid", "lid", tuple(parts), motion)
    if dice.chance(0.3):
        leaf = leaf.with_children(_hasp(dice, size, rise, trim))
    made.add(leaf)
    if dice.chance(0.3):
        made.add(_tray(dice, size, wall, look))
    if dice.chance(0.35):
        for one in _side_handles(dice, size, trim):
            made.add(one)
    return made.bodies()


def _outside(made: Assembly, dice: Dice, size: Size, wall: float, look: Look, trim: Look) -> None:
    """Bands, corner pieces, false drawers, or a lock plate on the body."""
    width, depth, height = size
    style = dice.unit()
    if style < 0.2:
        xs = np.linspace(-width / 2, width / 2, dice.whole(2, 4) + 2)[1:-1]
        bands = [(x, s * (depth / 2 + 0.0015), height / 2) for x in xs for s in (-1, 1)]
        made.fix([boxes((0.04, 0.003, height * 0.98), bands)], trim)
    elif style < 0.35:
        spots = [(x * width / 2, y * depth / 2, height / 2) for x in (-1, 1) for y in (-1, 1)]
        made.fix([boxes((wall, wall, height * 0.99), spots)], dice.pick((look, trim)))
    elif style < 0.6:
        panels = front(dice, width * 0.96, height * 0.92, 0.01)
        made.fix(moved(panels, (0, -depth / 2, height / 2)), look)
    if dice.chance(0.3):
        made.fix([box((0.05, 0.004, 0.06), (0, -depth / 2 - 0.002, height - 0.04))], trim)


def _lid(dice: Dice, size: Size, wall: float, look: Look) -> tuple[Pieces, float]:
    """Flat, as a tray upside down, domed or sloped, over the body; and its height at the front."""
    width, depth, height = size
    style, over = dice.unit(), dice.between(0.0, 0.015)
    wide, deep = width + 2 * over, depth + over
    shift = np.array([0, -over / 2, height + 0.001])
    if style < 0.3:
        thick = max(wall, 0.012)
        return [box((wide, deep, thick), shift + [0, 0, thick / 2])], thick
    rise = dice.between(0.12, 0.4) * min(height, depth)
    if style < 0.55:
        return moved(
            turned([open_box((wide, deep, rise), wall)], _UPSIDE_DOWN, (0, 0, rise / 2)), shift
        ), rise
    if style < 0.85:
        return moved(_dome(dice, wide, deep, rise, wall), shift), 0.3 * rise
    low = 0.3 * rise
    loop = np.array([[-deep / 2, 0], [deep / 2, 0], [deep / 2, rise], [-deep / 2, low]])
    if dice.chance(0.5):
        loop = np.array([[-deep / 2, 0], [deep / 2, 0], [0.3 * deep, rise], [-0.3 * deep, rise]])
    return moved([pointed(board(loop, wide), X)], shift), low


def _dome(dice: Dice, width: float, depth: float, rise: float, wall: float) -> Pieces:
    """A barrel vault with ends, hollow or full."""
    angle = np.linspace(0, np.pi, 11)
    flat = dice.between(0.5, 1.0)
    arc = np.column_stack([np.cos(angle) * depth / 2, np.sin(angle) ** flat * rise])
    if dice.chance(0.4):
        return [pointed(board(arc, width), X)]
    inner = arc * (1 - 2 * wall / depth, max(0.2, 1 - wall / rise))
    ends = [pointed(board(arc, wall), X) + [s * (width - wall) / 2, 0, 0] for s in (-1, 1)]
    skins = []
    for line in (arc, inner):
        skins.append(sheet(np.stack([np.insert(line, 0, s * width / 2, axis=1) for s in (-1, 1)])))
    rims = [
        between(
            (-width / 2, s * depth / 2 - (wall if s > 0 else 0), 0),
            (width / 2, s * depth / 2 + (wall if s < 0 else 0), 0.002),
        )
        for s in (-1, 1)
    ]
    return [*ends, *skins, *rims]


def _hasp(dice: Dice, size: Size, rise: float, trim: Look) -> Leaf:
    """A plate on the lid that turns up from the body's front."""
    width, depth, height = size
    long, wide = min(0.07, 0.4 * height), min(0.04, 0.15 * width)
    pin = (0, -depth / 2 - 0.02, height + 0.2 * rise)
    plate = box((wide, 0.005, long), (0, -depth / 2 - 0.018, pin[2] - long / 2))
    knuckle = rod((-wide / 2, pin[1], pin[2]), (wide / 2, pin[1], pin[2]), 0.004, 8)
    return Leaf(
        "hasp", "latch", (surface([plate, knuckle], trim),), hinge(pin, (-1, 0, 0), dice.between(1.5, 2.8))
    )


def _tray(dice: Dice, size: Size, wall: float, look: Look) -> Leaf:
    """A tray that lies in the chest, over its whole or half its width."""
    width, depth, height = size
    room = np.array([width, depth]) - 2 * wall - 0.004
    share, tall = dice.pick((1.0, 0.5, 0.6)), dice.between(0.15, 0.35) * height
    shift = (1 - share) * room[0] / 2 * dice.sign()
    tray = open_box((room[0] * share, room[1], tall), min(wall, 0.01)) + [shift, 0, height - tall - 0.005]
    return Leaf("tray", "tray", (surface([tray], looks.darker(look, 0.9)),), free())


def _side_handles(dice: Dice, size: Size, trim: Look) -> list[Leaf]:
    """Bows on both ends that hang down and turn up."""
    width, depth, height = size
    long, drop = 0.35 * depth, min(0.25 * height, 0.12 * depth + 0.02)
    made = []
    for side, name in ((-1, "left_handle"), (1, "right_handle")):
        x, z = side * (width / 2 + 0.012), 0.7 * height
        path = [(x, -long / 2, z), (x, -long / 2, z - drop), (x, long / 2, z - drop), (x, long / 2, z)]
        bow = tube(path, 0.005, 6)
        # Both ends of the bow run in eyes on the chest.
        motion = hinge((x, 0, z), (0, -side, 0), np.radians(dice.between(80, 120)))
        made.append(Leaf(name, "handle", (surface([bow], trim),), motion))
    return made


def _box(dice: Dice) -> Sequence[Body]:
    make = dice.weighted([(3, _flap_box), (2, _sliding_box), (3, _lift_off_box), (3, _hinged_box)])
    return make(dice)


def _flap_box(dice: Dice) -> Sequence[Body]:
    """A carton with two or four flaps, or with one long one that tucks in."""
    width, depth, height = any_size(dice, (0.15, 0.12, 0.06), (0.8, 0.6, 0.6))
    thick, look = dice.between(0.002, 0.006), looks.wood(dice)
    made = Assembly("body")
    made.fix([open_box((width, depth, height), thick)], look)
    if dice.chance(0.3):
        made.fix([box((width * 0.3, 0.001, height * 0.3), (0, -depth / 2, height * 0.5))], looks.darker(look))
    count = dice.pick((2, 2, 4, 4))
    reach, z = dice.pick((0.5, 0.5, 0.35)) * depth, height + 1.5 * thick + 0.001
    for side, name in ((-1, "front_flap"), (1, "back_flap")):
        flap = between((-width / 2, min(0, -side * reach), 0), (width / 2, max(0, -side * reach), thick))
        pin = np.array([0, side * depth / 2, z if count == 4 else height + 0.001])
        motion = hinge(pin, (-side, 0, 0), np.radians(dice.between(100, 230)))
        made.add(Leaf(name, "flap", (surface([flap + pin], look),), motion))
    across = min(reach, 0.49 * width)
    for side, name in ((-1, "left_flap"), (1, "right_flap")) if count == 4 else ():
        flap = between((min(0, -side * across), -depth / 2, 0), (max(0, -side * across), depth / 2, thick))
        pin = np.array([side * width / 2, 0, height + 0.0005])
        motion = hinge(pin, (0, side, 0), np.radians(dice.between(100, 230)))
        made.add(Leaf(name, "flap", (surface([flap + pin], look),), motion))
    return made.bodies()


def _sliding_box(dice: Dice) -> Sequence[Body]:
    """A box whose lid runs in grooves, or a sleeve with a drawer as of matches."""
    size = any_size(dice, (0.06, 0.05, 0.025), (0.5, 0.35, 0.25))
    width, depth, height = size
    wall, look = min(0.012, 0.06 * min(size)), dice.pick((looks.wood(dice), looks.plastic(dice)))
    made, inner = Assembly("body"), dice.pick((look, looks.wood(dice), looks.plastic(dice)))
    x, y = width / 2, depth / 2
    if dice.chance(0.35):
        plates = [between((-x, -y, z), (x, y, z + wall)) for z in (0, height - wall)]
        plates += [between((s, -y, wall), (s + wall, y, height - wall)) for s in (-x, x - wall)]
        made.fix(plates, look)
        tray = open_box((width - 2 * wall - 0.002, depth, height - 2 * wall - 0.002), wall) + [
            0,
            0,
            wall + 0.001,
        ]
        both = dice.chance(0.5)
        motion = slide((0, -1, 0), depth * 0.8, -depth * 0.8 if both else 0.0)
        made.add(Leaf("tray", "drawer", (surface([tray], inner),), motion))
        return made.bodies()
    made.fix([open_box((width, depth, height - 2 * wall), wall)], look)
    rails = [between((s, -y, height - 2 * wall), (s + wall, y, height)) for s in (-x, x - wall)]
    made.fix([*rails, between((-x + wall, y - wall, height - 2 * wall), (x - wall, y, height))], look)
    plate = between(
        (-x + wall + 0.001, -y, height - 2 * wall + 0.0005),
        (x - wall - 0.001, y - wall - 0.001, height - wall),
    )
    parts = [surface([plate], inner)]
    if dice.chance(0.6):
        size_ = (0.3 * width, 0.02 * depth + 0.004, wall)
        parts.append(surface([box(size_, (0, -y + 0.1 * depth, height - wall / 2))], looks.darker(inner)))
    made.add(Leaf("lid", "lid", tuple(parts), slide((0, -1, 0), depth * dice.between(0.7, 0.98))))
    return made.bodies()


def _lift_off_box(dice: Dice) -> Sequence[Body]:
    """Shoe boxes, cake tins, crates with a loose lid."""
    size = any_size(dice, (0.1, 0.08, 0.05), (0.6, 0.45, 0.4))
    width, depth, height = size
    wall, look = (
        dice.between(0.002, 0.01),
        dice.pick((looks.wood(dice), looks.plastic(dice), looks.metal(dice))),
    )
    made = Assembly("body")
    made.fix([open_box(size, wall)], look)
    skirt = dice.between(0.1, 0.5) * height
    wide, deep = width + 2 * wall + 0.002, depth + 2 * wall + 0.002
    lid = turned([open_box((wide, deep, skirt), wall)], _UPSIDE_DOWN, (0, 0, skirt / 2))
    lid = moved(lid, (0, 0, height + wall + 0.001 - skirt))
    cover = dice.pick((look, looks.darker(look), looks.plastic(dice)))
    parts = [surface(lid, cover)]
    if dice.chance(0.35):
        pull = turned(handle(dice, 0.3 * width), rotation((1, 0, 0), -np.pi / 2))
        parts.append(surface(moved(pull, (0, 0, height + wall + 0.001)), looks.metal(dice)))
    made.add(Leaf("lid", "lid", tuple(parts), free()))
    return made.bodies()


def _hinged_box(dice: Dice) -> Sequence[Body]:
    """A small case with a lid, some with trays that slide or lie inside, or with two lids."""
    size = any_size(dice, (0.1, 0.08, 0.04), (0.5, 0.35, 0.25))
    width, depth, height = size
    wall, look = (
        dice.between(0.003, 0.012),
        dice.pick((looks.wood(dice), looks.plastic(dice), looks.fabric(dice))),
    )
    made, thick = Assembly("body"), dice.between(0.15, 0.5) * height
    made.fix([open_box(size, wall)], look)
    if dice.chance(0.25):
        half = turned([open_box((width / 2 - 0.001, depth, thick), wall)], _UPSIDE_DOWN, (0, 0, thick / 2))
        right = moved(half, (width / 4 + 0.0005, 0, height + 0.001))
        for side, pieces, name in ((-1, mirrored(right), "left_lid"), (1, right, "right_lid")):
            motion = hinge((side * width / 2, 0, height), (0, side, 0), np.radians(dice.between(90, 180)))
            made.add(Leaf(name, "lid", (surface(pieces, look),), motion))
        return made.bodies()
    lid = turned([open_box((width, depth, thick), wall)], _UPSIDE_DOWN, (0, 0, thick / 2))
    parts = [surface(moved(lid, (0, 0, height + 0.0008)), look)]
    clasp = box((0.1 * width, 0.004, 0.3 * height), (0, -depth / 2 - 0.003, height))
    leaf = Leaf(
        "lid",
        "lid",
        tuple(parts),
        hinge((0, depth / 2, height), (-1, 0, 0), np.radians(dice.between(80, 175))),
    )
    if dice.chance(0.5):
        pin = (0, -depth / 2 - 0.003, height + 0.15 * height)
        motion = hinge(pin, (-1, 0, 0), dice.between(0.8, 2.4))
        leaf = leaf.with_children(Leaf("clasp", "latch", (surface([clasp], looks.metal(dice)),), motion))
    elif dice.chance(0.6):
        _outside(made, dice, size, wall, look, looks.metal(dice))
    made.add(leaf)
    if dice.chance(0.3):
        made.add(_tray(dice, size, wall, look))
    return made.bodies()


CATEGORIES: tuple[Category, ...] = (Category("chest", _chest), Category("box", _box))
