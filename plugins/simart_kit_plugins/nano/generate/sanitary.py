"""Toilets: bowl and cistern, seat and lid, levers and buttons."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import Y, moved, pointed
from ...shapes.primitives import Pieces, between, box, cylinder, prism, rod, sheet, superquadric
from . import looks
from .assembly import Assembly, Leaf
from .category import Category
from .objects import Body, Look, free, hinge, slide, surface


def _egg(width: float, long: float, square: float, sides: int = 24) -> FloatArray:
    """(sides, 2) outline about 0: round in front (-y), squarer behind the widest line."""
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    x, y = np.cos(angle), np.sin(angle)
    behind = y > 0
    power = np.where(behind, square, 1.0)
    x, y = np.sign(x) * np.abs(x) ** power, np.sign(y) * np.abs(y) ** power
    reach = np.where(behind, 0.38, 0.62) * long
    return np.column_stack([x * width / 2, y * reach - 0.12 * long + 0.24 * long / 2])


def _skin(loops: Sequence[FloatArray], heights: ArrayLike) -> FloatArray:
    """Surface through closed (K, 2) loops at these heights."""
    levels = np.asarray(heights, dtype=np.float64)
    rings = np.stack([np.insert(loop, 2, z, axis=1) for loop, z in zip(loops, levels, strict=True)])
    return sheet(np.concatenate([rings, rings[:, :1]], axis=1))


def _plate(loop: FloatArray, hole: FloatArray | None, low: float, thick: float) -> FloatArray:
    """A level plate, with a hole or whole."""
    inner = loop * 0.0 + loop.mean(axis=0) if hole is None else hole
    loops = [inner, loop, loop, inner] + ([inner] if hole is not None else [])
    return _skin(loops, [low, low, low + thick, low + thick, low][: len(loops)])


def _toilet(dice: Dice) -> Sequence[Body]:
    white = looks.ceramic(dice)
    width, long, high = dice.between(0.34, 0.4), dice.between(0.42, 0.56), dice.between(0.36, 0.46)
    square, made = dice.between(0.35, 1.0), Assembly("body")
    loop = _egg(width, long, square)
    hung = dice.chance(0.2)
    made.fix(_bowl(dice, loop, high, hung), white)
    back = float(loop[:, 1].max())
    # Behind the open lid there is room for its thickness.
    shelf = dice.between(0.05, 0.1)
    made.fix([between((-0.3 * width, back - 0.03, high - 0.06), (0.3 * width, back + shelf, high))], white)
    if not hung:
        made.fix([between((-0.22 * width, back - 0.1, 0), (0.22 * width, back + shelf, high - 0.05))], white)
    _seat_and_lid(made, dice, loop, high, shelf, white)
    wall = back + shelf
    if hung or dice.chance(0.2):
        _flush_plate(made, dice, wall, high, white)
    else:
        _cistern(made, dice, wall, high, white)
    return made.bodies()


def _bowl(dice: Dice, loop: FloatArray, high: float, hung: bool) -> Pieces:
    """The outside from the floor or the wall up, the rim, and the inside down to the drain."""
    foot, waist = dice.between(0.55, 0.85), dice.between(0.5, 0.9)
    back = np.array([0.0, float(loop[:, 1].max())])
    scales = [0.3, waist, 1.0] if hung else [foot, min(foot, waist), 0.9, 1.0]
    levels = [0.35, 0.5, 0.9] if hung else [0.0, dice.between(0.2, 0.5), 0.8, 0.93]
    # Everything narrows towards the back, where the foot or the wall is.
    rings = [(loop - back) * scale + back for scale in scales]
    rings += [loop, loop * 0.78, loop * 0.6, loop * 0.2, loop * 0.0]
    heights = [*levels, 1.0, 1.0, 0.75, 0.5, 0.5]
    return [_skin(rings, np.array(heights) * high)]


def _seat_and_lid(
    made: Assembly, dice: Dice, loop: FloatArray, high: float, shelf: float, white: Look
) -> None:
    """Both on pins behind the bowl, or the lid on the seat's."""
    look = dice.pick((white, looks.plastic(dice), looks.wood(dice)))
    thick, cover = dice.between(0.012, 0.025), dice.between(0.008, 0.025)
    big = loop * dice.between(1.0, 1.05)
    back = float(big[:, 1].max())
    pin = np.array([0.0, back - 0.005, high + 0.004 + thick])
    barrels = [rod((s * 0.07 - 0.02, *pin[1:]), (s * 0.07 + 0.02, *pin[1:]), 0.009, 8) for s in (-1, 1)]
    low = high + 0.003
    lean = float(np.arcsin((shelf - 0.045) / 0.5))
    upper = dice.between(np.pi / 2 - 0.05, np.pi / 2 + max(0.0, lean))
    hole = loop * (0.62, 0.66)
    parts = (surface([_plate(big, hole, low, thick), *barrels], look),)
    seat = Leaf("seat", "toilet seat", parts, hinge(pin, (-1, 0, 0), upper))
    top = low + thick + 0.002
    lid_loop = big * dice.between(0.98, 1.02)
    shape = _plate(lid_loop, None, top, cover)
    if dice.chance(0.4):
        inner = lid_loop * 0.9
        loops = [lid_loop, lid_loop, inner, inner * 0.0]
        shape = _skin([inner * 0.0, inner, *loops], np.array([0.4, 0.4, 0, 0.5, 1, 1]) * cover * 1.5 + top)
    lid = Leaf("lid", "lid", (surface([shape], look),), hinge(pin, (-1, 0, 0), upper))
    present = dice.weighted([(8, "both"), (1, "seat"), (1, "lid")])
    number = made.add(seat) if present != "lid" else 0
    if present != "seat":
        made.add(lid, number if dice.chance(0.25) else 0)


def _cistern(made: Assembly, dice: Dice, wall: float, high: float, white: Look) -> None:
    """A tank behind the bowl with a loose lid, a lever at its front or side, or buttons on top."""
    width, deep, tall = dice.between(0.34, 0.5), dice.between(0.14, 0.2), dice.between(0.28, 0.42)
    low = high + dice.pick((0.0, 0.0, 0.02, 0.35))
    y, outline = wall + deep / 2 - 0.01, rounded(dice.between(0.02, 0.2), width / deep)
    made.fix([prism(outline, (width, deep, tall)) + [0, y, low + tall / 2]], white)
    if low > high:
        made.fix([rod((0, y, high - 0.05), (0, y, low), 0.02, 10)], looks.plastic(dice))
    over, thick, top = dice.between(1.0, 1.06), dice.between(0.02, 0.045), low + tall + 0.001
    cover = prism(outline, (width * over, deep * over, thick)) + [0, y, top + thick / 2]
    lid = Leaf("cistern_lid", "cistern lid", (surface([cover], white),), free())
    metal = dice.pick((looks.metal(dice), white))
    lever = dice.chance(0.55)
    number = made.add(lid)
    if lever:
        made.add(_lever(dice, width, y - deep / 2, low + 0.8 * tall, metal))
        return
    radius = dice.between(0.015, 0.03)
    two = dice.chance(0.5)
    for k in (-1, 1) if two else (0,):
        spot = (k * 1.1 * radius, y, top + thick)
        button = cylinder(radius, 0.012, 14) + np.array(spot) + [0, 0, 0.006]
        motion = slide((0, 0, -1), 0.01)
        made.add(Leaf("flush_button", "button", (surface([button], metal),), motion), number)


def _lever(dice: Dice, width: float, near: float, level: float, look: Look) -> Leaf:
    side, reach = dice.sign(), dice.between(0.05, 0.09)
    pin = np.array([side * 0.36 * width, near, level])
    boss = pointed(cylinder(0.014, 0.02, 12), Y) - [0, 0.01, 0]
    arm = superquadric((reach, 0.012, 0.016), 0.4, 0.5, 4) + [-side * reach / 2, -0.024, 0]
    # Its free end goes down.
    motion = hinge(pin, (0, -side, 0), dice.between(0.4, 0.9))
    return Leaf("flush_lever", "lever", (surface(moved([boss, arm], pin), look),), motion)


def _flush_plate(made: Assembly, dice: Dice, wall: float, high: float, white: Look) -> None:
    """A piece of wall behind the bowl with a plate of two buttons."""
    width, top = dice.between(0.45, 0.8), high + dice.between(0.4, 0.7)
    made.fix([between((-width / 2, wall, 0), (width / 2, wall + 0.12, top))], looks.ceramic(dice))
    level, metal = top - 0.15, looks.metal(dice)
    made.fix([box((0.24, 0.008, 0.16), (0, wall - 0.004, level))], white)
    for x, wide, name in ((-0.04, 0.07, "large_button"), (0.06, 0.05, "small_button")):
        button = box((wide, 0.008, 0.07), (x, wall - 0.012, level))
        made.add(Leaf(name, "button", (surface([button], metal),), slide((0, 1, 0), 0.006)))


CATEGORIES: tuple[Category, ...] = (Category("toilet", _toilet),)
