"""Windows and shutters."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame, framed, louvred, planked, raised
from ...shapes.placing import at, moved, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder
from . import looks
from .assembling import Assembly, holder, lever, swing
from .category import Category
from .objects import Body, Look, hinge, slide

_Size = tuple[float, float]


def _window(dice: Dice) -> list[Body]:
    kit = Assembly("frame")
    width, height = dice.between(0.4, 1.4), dice.between(0.4, 1.5)
    border, deep = dice.between(0.03, 0.08), dice.between(0.06, 0.14)
    look = looks.wood(dice) if dice.chance(0.7) else looks.metal(dice)
    kit.fix([frame(width + 2 * border, height + 2 * border, deep, border) + [0, deep, 0]], look)
    if dice.chance(0.35):
        sill = (width + 2 * border + 0.08, deep + 0.08, 0.03)
        kit.fix([box(sill, (0, deep / 2 - 0.04, -height / 2 - border - 0.015))], looks.wood(dice))
    makes: list[tuple[float, Callable[[Dice, Assembly, _Size, float, Look], None]]]
    makes = [(4, _casements), (2, _hung), (2, _sashes_aside), (2, _shutters), (1, _pivot)]
    dice.weighted(makes)(dice, kit, (width, height), deep, look)
    return kit.done()


def _sash(dice: Dice, width: float, height: float, thick: float) -> tuple[Pieces, Pieces]:
    """Bars and pane of a sash, from y = -thick to 0."""
    border = min(width, height) * dice.between(0.06, 0.14)
    bars: Pieces = [frame(width, height, thick, border)]
    pane = box((width - 2 * border, 0.006, height - 2 * border), (0, -thick / 2, 0))
    if dice.chance(0.35):
        count = dice.whole(1, 2)
        levels = np.linspace(-0.5, 0.5, count + 2)[1:-1] * (height - 2 * border)
        bars.append(boxes((width - 2 * border, thick * 0.7, 0.02), [(0, -thick / 2, z) for z in levels]))
        if dice.chance(0.6):
            bars.append(box((0.02, thick * 0.7, height - 2 * border), (0, -thick / 2, 0)))
    return bars, [pane]


def _catch(
    dice: Dice, kit: Assembly, leaf: int, spot: tuple[float, float, float], metal: Look, lying: bool
) -> None:
    """A handle that turns on a sash by a quarter, hanging down where it is closed."""
    reach, radius = dice.between(0.07, 0.12), dice.between(0.006, 0.009)
    turn = rotation((0, 1, 0), 0.0 if lying else np.pi / 2)
    shape = moved(turned(lever(dice, reach, radius), turn), spot)
    kit.fix(moved([box((0.03, 0.008, 0.065), (0, -0.004, 0))], spot), metal, leaf)
    kit.add("handle", hinge(spot, (0, dice.sign(), 0), np.pi / 2), [(shape, metal)], leaf)


def _casements(dice: Dice, kit: Assembly, size: _Size, deep: float, look: Look) -> None:
    """One to three sashes, hinged at a side, at the top or at the bottom; one may be fixed."""
    count = dice.weighted([(3, 1), (3, 2), (1, 3)]) if size[0] > 0.7 else 1
    step, height, thick = size[0] / count, size[1], min(deep * 0.6, 0.05)
    way = dice.weighted([(5, "side"), (2, "top"), (1, "bottom")])
    metal, seed, upper = looks.metal(dice), dice.whole(0, 2**31), dice.between(0.5, 1.7)
    y, first, handled = thick, dice.sign(), dice.chance(0.75)
    for k in range(count):
        style, x = Dice(seed), (k - (count - 1) / 2) * step
        bars, pane = _sash(style, step - 0.006, height - 0.006, thick)
        parts = [(moved(bars, (x, y, 0)), look), (moved(pane, (x, y, 0)), looks.glass(style))]
        if count == 3 and k == 1:
            for pieces, stuff in parts:
                kit.fix(pieces, stuff)
            continue
        side = first if count == 1 else (-1 if k < count / 2 else 1)
        if way == "side":
            motion = swing(side, x + side * (step / 2 - 0.003), 0, upper)
            grip = (x - side * (step / 2 - 0.03), 0.0, 0.0)
        elif way == "top":
            motion, grip = (
                hinge((x, 0, height / 2 - 0.003), (-1, 0, 0), upper * 0.7),
                (x, 0.0, -height / 2 + 0.03),
            )
        else:
            motion, grip = (
                hinge((x, 0, -height / 2 + 0.003), (1, 0, 0), upper * 0.5),
                (x, 0.0, height / 2 - 0.03),
            )
        leaf = kit.add("window", motion, parts)
        if handled and not (count == 2 and k == 0 and seed % 2):
            _catch(style, kit, leaf, grip, metal, way != "side")


def _hung(dice: Dice, kit: Assembly, size: _Size, deep: float, look: Look) -> None:
    """Two sashes one above the other: the lower slides up, the upper slides down."""
    width, height = size
    thick, half = deep * 0.35, height / 2 + 0.015
    pane_look, seed = looks.glass(dice), dice.whole(0, 2**31)
    for way in (1, -1):
        bars, pane = _sash(Dice(seed), width - 0.004, half, thick)
        place = (0, thick + 0.004 if way > 0 else 2 * thick + 0.01, -way * (height - half - 0.004) / 2)
        if way > 0 and dice.chance(0.5):
            bars += at(
                box((0.05, 0.015, 0.015)),
                [(s * width / 4, -thick - 0.007, -half / 2 + 0.02) for s in (-1, 1)],
            )
        parts = [(moved(bars, place), look), (moved(pane, place), pane_look)]
        name = "lower_sash" if way > 0 else "upper_sash"
        kit.add("sash", slide((0, 0, way), height - half - 0.02), parts, name=name)


def _sashes_aside(dice: Dice, kit: Assembly, size: _Size, deep: float, look: Look) -> None:
    """Two to four sashes side by side in two tracks."""
    width, height = size
    count, thick = dice.weighted([(3, 2), (1, 3), (1, 4)]), deep * 0.33
    step = width / count
    pane_look, seed = looks.glass(dice), dice.whole(0, 2**31)
    for k in range(count):
        bars, pane = _sash(Dice(seed), step + 0.02, height - 0.006, thick)
        x = (k - (count - 1) / 2) * (step - 0.026 / max(count - 1, 1))
        near = k in (1, 2) if count == 4 else k % 2 == 0
        place = (x, thick + 0.004 if near else 2 * thick + 0.01, 0)
        parts = [(moved(bars, place), look), (moved(pane, place), pane_look)]
        way = 1 if k < count / 2 else -1
        if count == 4:
            way = -1 if k in (1, 3) else 1
        kit.add("sash", slide((way, 0, 0), step * dice.between(0.8, 0.93)), parts)


def _shutters(dice: Dice, kit: Assembly, size: _Size, deep: float, look: Look) -> None:
    """A pane behind shutters that fold aside."""
    width, height = size
    bars, pane = _sash(dice, width, height, 0.03)
    kit.fix(moved(bars, (0, deep * 0.9, 0)), look)
    kit.fix(moved(pane, (0, deep * 0.9, 0)), looks.glass(dice))
    thick, seed, coat = dice.between(0.02, 0.035), dice.whole(0, 2**31), looks.wood(dice)
    upper, metal = dice.between(1.6, 3.0), looks.metal(dice)
    sides = (-1, 1) if dice.chance(0.8) else (dice.sign(),)
    wide = width / len(sides)
    for side in sides:
        style, x = Dice(seed), side * (width - wide) / 2
        make = style.pick((louvred, louvred, planked, framed, raised))
        face = moved(make(style, wide - 0.004, height - 0.004, thick), (x, -0.002, 0))
        pins = at(
            cylinder(0.008, 0.06, 8), [(side * width / 2, -0.01 - thick, z * height) for z in (-0.35, 0.35)]
        )
        motion = swing(side, side * width / 2, -0.002 - thick, upper)
        name = "left_shutter" if side < 0 else "right_shutter"
        leaf = kit.add("shutter", motion, [(face, coat), (pins, metal)], name=name)
        if style.chance(0.4):
            kit.fix(moved(holder(style, 0.1), (x - side * (wide / 2 - 0.06), -thick - 0.002, 0)), metal, leaf)


def _pivot(dice: Dice, kit: Assembly, size: _Size, deep: float, look: Look) -> None:
    """A sash, round or square, that turns about its middle."""
    width, height = size
    thick = min(deep * 0.4, 0.04)
    y = deep / 2 + thick / 2
    bars, pane = _sash(dice, width - 0.01, height - 0.01, thick)
    parts = [(moved(bars, (0, y, 0)), look), (moved(pane, (0, y, 0)), looks.glass(dice))]
    axis = (-1, 0, 0) if dice.chance(0.7) else (0, 0, dice.sign())
    leaf = kit.add("window", hinge((0, deep / 2, 0), axis, dice.between(0.6, 1.5)), parts)
    if dice.chance(0.6):
        kit.fix(moved(holder(dice, 0.12), (0, y - thick, -height / 2 + 0.03)), looks.metal(dice), leaf)


CATEGORIES: tuple[Category, ...] = (Category("window", _window),)
