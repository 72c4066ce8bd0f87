"""Fridges and freezers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import front, slab
from ...shapes.legs import feet
from ...shapes.outlines import rounded
from ...shapes.placing import at, moved
from ...shapes.primitives import Pieces, box, boxes, open_box, prism, superquadric
from . import looks
from .assembling import Assembly, Parts, holder, lift, press, pull, shell, swing
from .category import Category
from .objects import Body, Look, free, slide


@dataclass(frozen=True)
class _Make:
    """What all compartments of a fridge share."""

    width: float
    depth: float
    wall: float
    thick: float
    seed: int
    coat: Look
    leaf: Look
    inner: Look
    grip: Look
    grips: float
    bins: bool

    @classmethod
    def random(cls, dice: Dice) -> _Make:
        coat = looks.painted_metal(dice)
        return cls(
            width=dice.between(0.45, 1.0),
            depth=dice.between(0.45, 0.75),
            wall=dice.between(0.025, 0.06),
            thick=dice.between(0.02, 0.07),
            seed=dice.whole(0, 2**31),
            coat=coat,
            leaf=coat if dice.chance(0.6) else looks.painted_metal(dice),
            inner=Look("plastic", (236, 238, 240)),
            grip=looks.metal(dice) if dice.chance(0.6) else looks.darker(coat),
            grips=dice.pick((0.0, 0.1, 0.2, 0.35, 0.5, 0.8)),
            bins=dice.chance(0.7),
        )


def _fridge(dice: Dice) -> list[Body]:
    make = _Make.random(dice)
    kit = Assembly("cabinet")
    tall = dice.between(1.2, 2.0) if dice.chance(0.85) else dice.between(0.5, 0.9)
    plan = dice.weighted(
        [(3, "one"), (3, "freezer above"), (3, "freezer below"), (3, "side by side"), (3, "french")]
    )
    share = dice.between(0.25, 0.42)
    side = dice.sign()
    if plan in ("side by side", "french"):
        make = replace(make, width=max(make.width, dice.between(0.65, 1.0)))
    if plan == "one" or tall < 0.95:
        _compartment(dice, kit, make, 0.0, tall, (side,))
    elif plan == "freezer above":
        _compartment(dice, kit, make, 0.0, (1 - share) * tall, (side,))
        _compartment(dice, kit, make, (1 - share) * tall, tall, (side,))
    elif plan == "side by side":
        _compartment(dice, kit, make, 0.0, tall, (-1, 1), dice.between(0.38, 0.55))
    else:
        _below(dice, kit, make, share * tall, side if plan == "freezer below" else 0)
        sides = (-1, 1) if plan == "french" else (side,)
        _compartment(dice, kit, make, share * tall, tall, sides, 0.5)
    kit.fix(_foot(dice, make), looks.darker(make.coat, 0.4))
    if dice.chance(0.2):
        kit.fix([box((make.width, make.depth, 0.02), (0, 0, tall + 0.01))], looks.wood(dice))
    return kit.done()


def _foot(dice: Dice, make: _Make) -> Pieces:
    if dice.chance(0.5):
        return feet(dice, make.width, make.depth, dice.between(0.02, 0.06))
    low = dice.between(0.03, 0.1)
    return [box((make.width * 0.96, make.depth * 0.9, low), (0, 0.03 * make.depth, -low / 2))]


def _below(dice: Dice, kit: Assembly, make: _Make, high: float, side: int) -> None:
    """One or two drawers at the bottom, or a door."""
    if side and dice.chance(0.5):
        return _compartment(dice, kit, make, 0.0, high, (side,))
    count = dice.whole(1, 2)
    for k in range(count):
        low, top = high * k / count, high * (k + 1) / count
        kit.fix([shell(make.width, make.depth, top - low, make.wall * 0.7) + [0, 0, low]], make.coat)
        _big_drawer(dice, kit, make, low, top)
    return None


def _big_drawer(dice: Dice, kit: Assembly, make: _Make, low: float, top: float) -> None:
    height, wall = top - low, make.wall
    leaf = moved(_face(make, make.width, height - 0.006), (0, 0, height / 2))
    grip = moved(
        holder(Dice(make.seed + 1), max(make.grips, 0.2) * make.width), (0, -make.thick, height * 0.85)
    )
    tub = (make.width - 2.6 * wall, make.depth * 0.8, (height - 2 * wall) * dice.between(0.4, 0.85))
    basket = moved([open_box(tub, 0.006)], (0, make.depth * 0.4 + 0.001, wall * 1.2))
    place = (0, -make.depth / 2 - 0.003, low)
    parts = [
        (moved(leaf, place), make.leaf),
        (moved(basket, place), make.inner),
        (moved(grip, place) if make.grips else [], make.grip),
    ]
    kit.add("drawer", pull(make.depth * dice.between(0.5, 0.75)), parts)


def _face(make: _Make, width: float, height: float) -> Pieces:
    """A leaf's outer skin; the same style wherever it is asked for."""
    dice = Dice(make.seed)
    if dice.chance(0.8):
        return slab(dice, width, height, make.thick)
    return front(dice, width, height, make.thick)


def _compartment(
    dice: Dice,
    kit: Assembly,
    make: _Make,
    low: float,
    high: float,
    sides: tuple[int, ...],
    share: float = 1.0,
) -> None:
    """A shell with shelves behind one door or two; `share` is the left one's width."""
    height, wall = high - low, make.wall
    kit.fix([shell(make.width, make.depth, height, wall) + [0, 0, low]], make.coat)
    if dice.chance(0.5):
        skin = shell(make.width - 1.6 * wall, make.depth - 0.8 * wall, height - 1.6 * wall, wall * 0.15)
        kit.fix([skin + [0, -0.4 * wall, low + 0.8 * wall]], make.inner)
    split = -make.width / 2 + share * make.width
    edges = (
        [-make.width / 2, split, make.width / 2] if len(sides) == 2 else [-0.5 * make.width, 0.5 * make.width]
    )
    divided = len(sides) == 2 and (share != 0.5 or dice.chance(0.3))
    if divided:
        wall_size = (wall, make.depth * 0.95, height - 2 * wall)
        kit.fix([box(wall_size, (split, 0.02 * make.depth, (low + high) / 2))], make.inner)
    rooms = list(pairwise(edges)) if divided else [(edges[0], edges[-1])]
    for left, right in rooms:
        _interior(dice, kit, make, (left + wall, right - wall), (low + wall, high - wall))
    for side, left, right in zip(sides, edges[:-1], edges[1:], strict=True):
        _door(dice, kit, make, side, (left, right), (low, high))


def _interior(
    dice: Dice, kit: Assembly, make: _Make, across: tuple[float, float], up: tuple[float, float]
) -> None:
    """Shelves, and drawers below them."""
    middle, wide = (across[0] + across[1]) / 2, across[1] - across[0]
    high = up[1] - up[0]
    deep = make.depth * dice.between(0.6, 0.78)
    back = make.depth / 2 - make.wall - deep / 2
    levels = np.linspace(up[0], up[1], dice.whole(0, 4) + 2)[1:-1]
    look = looks.glass(dice) if dice.chance(0.5) else make.inner
    if len(levels):
        kit.fix(at(box((wide, deep, 0.008)), [(middle, back, z) for z in levels]), look)
    room = (levels[0] if len(levels) else up[1]) - up[0]
    if dice.chance(0.5) or room < 0.1:
        return
    count = dice.whole(1, 2)
    tall = min(room * 0.9, 0.35 * high, 0.25)
    clear = Look("plastic", (200, 215, 225))
    for k in range(count):
        tub = open_box((wide / count - 0.012, deep * 0.95, tall), 0.004)
        x = across[0] + (k + 0.5) * wide / count
        grip = box((wide / count * 0.5, 0.012, 0.015), (0, -deep * 0.475 - 0.006, tall * 0.9))
        bin_ = moved([tub, grip], (x, back, up[0] + 0.004))
        kit.add("drawer", pull(deep * dice.between(0.6, 0.9)), [(bin_, clear)], name="inner_drawer")


def _door(
    dice: Dice,
    kit: Assembly,
    make: _Make,
    side: int,
    across: tuple[float, float],
    up: tuple[float, float],
) -> None:
    width, height = across[1] - across[0] - 0.004, up[1] - up[0] - 0.004
    place = np.array([(across[0] + across[1]) / 2, -make.depth / 2 - 0.004, (up[0] + up[1]) / 2])
    parts: list[tuple[Pieces, Look]] = [(moved(_face(make, width, height), place), make.leaf)]
    if make.grips:
        grip = holder(Dice(make.seed + 1), max(min(make.grips * height, 0.9), 0.1), upright=True)
        level = dice.between(-0.1, 0.1) * height if make.grips < 0.7 else 0.0
        parts.append((moved(grip, place + [-side * (width / 2 - 0.05), -make.thick, level]), make.grip))
    parts += [(moved(pieces, place), look) for pieces, look in _lining(dice, make, width, height)]
    gush = height > 0.9 and dice.chance(0.25)
    if gush:
        spot = place + [0, -make.thick, 0.1 * height]
        parts.append((moved(_dispenser(width), spot), looks.darker(make.leaf, 0.35)))
    pin_y = place[1] if dice.chance(0.6) else place[1] - make.thick / 2
    motion = swing(side, across[1] if side > 0 else across[0], pin_y, dice.between(1.6, 2.4), place[2])
    name = ("left_door" if side < 0 else "right_door") if width < 0.8 * make.width else "door"
    number = kit.add("door", motion, parts, name=name)
    if gush and dice.chance(0.6):
        paddle = moved([box((0.05, 0.012, 0.08))], place + [0, -make.thick - 0.008, 0.08 * height])
        kit.add("lever", press(0.004), [(paddle, make.grip)], number)


def _dispenser(width: float) -> Pieces:
    """A frame with a nozzle and a tray about a niche that is only drawn."""
    wide = min(0.6 * width, 0.24)
    frame = boxes((0.015, 0.015, 0.35), [(s * wide / 2, -0.0075, 0) for s in (-1, 1)])
    bars = boxes((wide, 0.02, 0.05), [(0, -0.01, s * 0.15) for s in (-1, 1)])
    return [frame, bars, box((wide, 0.002, 0.3), (0, -0.001, 0)), box((0.03, 0.03, 0.02), (0, -0.015, 0.12))]


def _lining(dice: Dice, make: _Make, width: float, height: float) -> Parts:
    """The inner skin of a door, and its bins, before which the shelves end."""
    wide, high = width - 3 * make.wall, height - 3 * make.wall
    skin = box((wide, make.wall * 0.4, high), (0, make.wall * 0.2 + 0.006, 0))
    seal = boxes((wide + make.wall, 0.004, make.wall), [(0, 0.002, s * high / 2) for s in (-1, 1)])
    parts: list[tuple[Pieces, Look]] = [([skin], make.inner), ([seal], looks.rubber(dice))]
    if not make.bins or min(wide, high) < 0.15:
        return parts
    deep = make.depth * dice.between(0.1, 0.15)
    levels = np.linspace(-high / 2, high / 2, dice.whole(1, 5) + 1)[:-1]
    tall = min(0.12, 0.5 * high / len(levels))
    shelf = open_box((wide * 0.92, deep, tall), 0.005) + [0, deep / 2 + 0.4 * make.wall + 0.006, 0]
    parts.append((at(shelf, [(0, 0, z + 0.01) for z in levels]), Look("plastic", (210, 220, 228))))
    if dice.chance(0.4):
        eggs = [
            (x, deep / 2 + 0.4 * make.wall, levels[-1] + 0.035) for x in np.linspace(-0.35, 0.35, 5) * wide
        ]
        parts.append((at(superquadric((0.04, 0.04, 0.05), rows=5), eggs), Look("ceramic", (225, 200, 175))))
    return parts


def _freezer(dice: Dice) -> list[Body]:
    """A chest with one lid or two, or with panes that slide."""
    width, depth, height = dice.between(0.6, 1.8), dice.between(0.5, 0.75), dice.between(0.7, 0.95)
    wall, coat = dice.between(0.03, 0.07), looks.painted_metal(dice)
    kit = Assembly("chest")
    kit.fix([open_box((width, depth, height), wall)], coat)
    kit.fix(feet(dice, width, depth, 0.04), looks.rubber(dice))
    if dice.chance(0.5):
        grille = boxes(
            (0.25 * width, 0.006, 0.008), [(0.3 * width, -depth / 2, 0.05 + 0.02 * k) for k in range(5)]
        )
        kit.fix([grille], looks.darker(coat, 0.4))
    if dice.chance(0.3):
        _panes(dice, kit, width, depth, height)
    else:
        _lids(dice, kit, (width, depth, height), wall, coat)
    for k in range(dice.whole(0, 2)):
        basket = open_box((width * 0.25, depth - 2.4 * wall, 0.2), 0.005)
        spot = ((k - 0.5) * 0.4 * width, 0, height - 0.23)
        kit.add("basket", free(), [(moved([basket], spot), looks.metal(dice))])
    return kit.done()


def _lids(dice: Dice, kit: Assembly, size: tuple[float, float, float], wall: float, coat: Look) -> None:
    width, depth, height = size
    count = 2 if width > 1.1 and dice.chance(0.5) else 1
    thick, seed = dice.between(0.03, 0.09), dice.whole(0, 2**31)
    upper = dice.between(1.1, 1.6)
    for k in range(count):
        style, wide = Dice(seed), width / count - 0.003
        outline = rounded(style.between(0.01, 0.05), wide / depth)
        x = (k - (count - 1) / 2) * width / count
        slab_ = prism(outline, (wide, depth * 1.01, thick)) + [x, 0, height + thick / 2 + 0.003]
        inner = box((wide - 2.5 * wall, depth - 2.5 * wall, 0.02), (x, 0, height - 0.007))
        parts: list[tuple[Pieces, Look]] = [([slab_], coat), ([inner], Look("plastic", (235, 235, 235)))]
        if style.chance(0.8):
            grip = holder(style, dice.between(0.15, 0.4))
            spot = (x, -depth * 0.505, height + thick / 2)
            parts.append((moved(grip, spot), looks.plastic(style)))
        kit.add("lid", lift(depth / 2, height + 0.003, upper), parts)


def _panes(dice: Dice, kit: Assembly, width: float, depth: float, height: float) -> None:
    """Two glass lids, one over the other, that slide along x."""
    metal, pane = looks.metal(dice), looks.glass(dice)
    rails = [(0, s * (depth / 2 - 0.015), height + 0.025) for s in (-1, 1)]
    kit.fix(at(box((width, 0.03, 0.05)), rails), metal)
    for side in (-1, 1):
        level = height + (0.012 if side < 0 else 0.034)
        wide = width * 0.52
        glass = box((wide, depth - 0.08, 0.008), (side * (width - wide) / 2, 0, level))
        rim = boxes(
            (0.02, depth - 0.064, 0.016),
            [(side * (width - wide) / 2 + s * wide / 2, 0, level) for s in (-1, 1)],
        )
        room = slide((-side, 0, 0), width * 0.44)
        kit.add("lid", room, [([glass], pane), ([rim], metal)], name="left_lid" if side < 0 else "right_lid")


CATEGORIES: tuple[Category, ...] = (Category("fridge", _fridge), Category("freezer_chest", _freezer))
