"""What moves in front of an opening: hinged doors, drawers and sliding doors, closed or ajar.

An opening is a rectangle in the plane of x and z, centred at 0; the front of its case is at y = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....shapes.dice import Dice
from ....shapes.fronts import front
from ....shapes.handles import handle
from ....shapes.placing import moved, rotation, turned
from ....shapes.primitives import Pieces, boxes, open_box, rod


@dataclass(frozen=True)
class Opening:
    """Where a leaf goes.

    Attributes:
        width: along x.
        height: along z.
        depth: of the room behind it, along y.
    """

    width: float
    height: float
    depth: float


@dataclass(frozen=True)
class Style:
    """What the leaves of one object have in common.

    Attributes:
        seed: of the make of fronts and handles, so that they match.
        thick: thickness of a front.
        lift: how far a front's back lies before the case; negative for one set into it.
        ajar: share of leaves that stand open.
    """

    seed: int
    thick: float
    lift: float
    ajar: float

    @classmethod
    def random(cls, dice: Dice, board: float, inset: bool = False) -> Style:
        """A style for a case with boards of this thickness; a third of the objects stand open."""
        thick = board * dice.between(0.6, 1.6)
        lift = dice.pick((0.0, 0.0, thick * 0.15, -thick if inset else 0.0))
        return cls(dice.whole(0, 2**31), thick, lift, dice.pick((0.0, 0.0, dice.between(0.2, 1.0))))


def panel(style: Style, width: float, height: float) -> Pieces:
    """The front that all leaves of this style and size have."""
    return moved(front(Dice(style.seed), width, height, style.thick), (0, -style.lift, 0))


def grip(style: Style, length: float, upright: bool) -> Pieces:
    """Their handle, on their front's middle; none in a tenth of the styles."""
    dice = Dice((style.seed, 1))
    if dice.chance(0.1):
        return []
    return moved(handle(dice, length, upright), (0, -style.lift - style.thick, 0))


def door(dice: Dice, opening: Opening, style: Style, side: int) -> Pieces:
    """A door hinged on its left (side -1) or right (1), its handle on the other side."""
    wide, high = opening.width, opening.height
    upright = dice.chance(0.8)
    length = min(0.5 * high, dice.between(0.25, 0.6) * wide) if upright else 0.35 * wide
    place = (-side * wide * dice.between(0.36, 0.42), 0, high * dice.between(-0.35, 0.35))
    pieces = panel(style, wide, high) + moved(grip(style, length, upright), place)
    pin = np.array([side * wide / 2, -style.lift, 0.0])
    if dice.chance(0.25):
        ends = np.linspace(-0.4, 0.4, 2)[:, None] * [0, 0, high] + pin
        pieces += [rod(end, end + [0, 0, 0.07 * high], 0.4 * style.thick) for end in ends]
    if not dice.chance(style.ajar):
        return pieces
    return turned(pieces, rotation((0, 0, side), dice.spread(0.1, 2.0)), pin)


def flap(dice: Dice, opening: Opening, style: Style, side: int = -1) -> Pieces:
    """A door hinged at its bottom (side -1) or top (1), its handle on the other side."""
    wide, high = opening.width, opening.height
    pull = moved(grip(style, dice.between(0.3, 0.9) * wide, False), (0, 0, -side * 0.4 * high))
    pieces = panel(style, wide, high) + pull
    if not dice.chance(style.ajar):
        return pieces
    pin = (0, -style.lift, side * high / 2)
    return turned(pieces, rotation((-side, 0, 0), dice.between(0.1, np.pi / 2)), pin)


def drawer(dice: Dice, opening: Opening, style: Style) -> Pieces:
    """A front with a handle and, mostly, a box behind."""
    wide, high, deep = opening.width, opening.height, opening.depth
    count = 2 if wide > 3.5 * high and dice.chance(0.3) else 1
    length = min(wide / count, 2.5 * high) * dice.between(0.25, 0.6)
    places = [(0, 0, 0)] if count == 1 else [(-wide / 4, 0, 0), (wide / 4, 0, 0)]
    pieces = panel(style, wide, high)
    for place in places:
        pieces += moved(grip(style, length, False), place)
    if dice.chance(0.85):
        pieces += _tray(dice, opening, style)
    out = dice.between(0.1, 0.8) * deep if dice.chance(style.ajar) else 0.0
    return moved(pieces, (0, -out, 0))


def sliding(dice: Dice, opening: Opening, style: Style, place: int, count: int) -> Pieces:
    """One of several doors that run in tracks behind each other."""
    wide = opening.width / count * 1.04
    pieces = panel(style, wide, opening.height)
    pieces += moved(grip(style, 0.3 * min(wide, opening.height), True), (dice.sign() * 0.4 * wide, 0, 0))
    home = (place + 0.5) / count * opening.width - opening.width / 2
    shift = dice.sign() * dice.between(0.1, 0.9) * wide if dice.chance(style.ajar) else 0.0
    limit = (opening.width - wide) / 2
    return moved(pieces, (float(np.clip(home + shift, -limit, limit)), style.thick * 1.1 * (place % 2), 0))


def _tray(dice: Dice, opening: Opening, style: Style) -> Pieces:
    """The box of a drawer, or a bottom with two rails."""
    wide, deep = opening.width * dice.between(0.9, 0.98), opening.depth * dice.between(0.75, 0.97)
    high = opening.height * dice.between(0.5, 0.9)
    wall = style.thick * dice.between(0.3, 0.8)
    low = -opening.height / 2 * dice.between(0.85, 0.98)
    if dice.chance(0.85):
        return moved([open_box((wide, deep, high), wall)], (0, deep / 2 - style.lift, low))
    rails = boxes((wall, deep, high / 2), [(s * wide / 2, deep / 2, low + high / 4) for s in (-1, 1)])
    return [rails, boxes((wide, deep, wall), [(0, deep / 2, low)])]
