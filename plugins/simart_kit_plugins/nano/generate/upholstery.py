"""Cushions, and the backrests, headrests, armrests and levers of seats that have them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, loft, prism, rod, superquadric
from . import looks
from .assembling import Assembly
from .fittings import sleeve_of
from .objects import Look, hinge, slide, spin
from .rigging import LEFT, QUARTER, RIGHT, UP, ball_knob, lying, profile

PLAIN = ("soft", "rounded", "block")
"""Styles of cushions that are one piece."""
_STYLES = (*PLAIN, "soft", "rolls", "channels", "bolsters", "bolsters", "tufted", "split")
# Colors of leather.
_HIDES = ((24, 24, 26), (96, 38, 30), (150, 110, 70), (225, 220, 208), (60, 90, 96), (44, 58, 92))
HALF_TURN = rotation(UP, np.pi)
"""Turns what lies to y from 0 so that it lies to -y."""


@dataclass(frozen=True)
class Made:
    """A seat or bed in the making.

    Attributes:
        dice: for all choices.
        kit: that bodies are added to.
        style: of its cushions; see `padding`.
        cover, frame, hard: looks of cushions, of irons and of shells.
    """

    dice: Dice
    kit: Assembly
    style: str
    cover: Look
    frame: Look
    hard: Look


def begun(dice: Dice, label: str) -> Made:
    """Nothing yet but a root with this label, and choices of style and looks."""
    cover = looks.fabric(dice) if dice.chance(0.4) else Look("fabric", dice.pick(_HIDES))
    frame = looks.metal(dice) if dice.chance(0.7) else looks.painted_metal(dice)
    return Made(dice, Assembly(label), dice.pick(_STYLES), cover, frame, looks.plastic(dice))


def padding(dice: Dice, style: str, wide: float, long: float, thick: float) -> Pieces:
    """A cushion of a style that lies on z = 0, from y = 0 back."""
    middle, size = np.array([0, long / 2, thick / 2]), (wide, long, thick)
    if style == "soft":
        return [superquadric(size, dice.between(0.25, 0.55), dice.between(0.2, 0.5), 7) + middle]
    if style == "block":
        edge = dice.between(0.1, 0.6) * thick
        top = [(wide, long, thick - edge / 2), (wide - edge, long - edge, thick), (0, 0, thick)]
        return [loft(SQUARE, [(0, 0, 0), (wide, long, 0), *top]) + [0, long / 2, 0]]
    if style == "channels":
        return moved(turned(padding(dice, "rolls", long, wide, thick), QUARTER), (wide / 2, long / 2, 0))
    if style == "rolls":
        step = long / dice.whole(3, 8)
        roll = superquadric((0.96 * wide, step, 0.94 * thick), dice.between(0.5, 0.9), 0.3, 6)
        rolls = at(roll, [(0, y, 0.53 * thick) for y in np.arange(step / 2, long, step)])
        return [*rolls, box((0.95 * wide, 0.96 * long, 0.4 * thick), middle * [1, 1, 0.4])]
    if style == "bolsters":
        share = dice.between(0.14, 0.24) * wide
        side = superquadric((share, 0.98 * long, 1.25 * thick), 0.5, 0.35, 6) + middle * [1, 1, 1.25]
        inner = padding(dice, dice.pick((*PLAIN, "rolls", "split")), wide - 1.9 * share, long, 0.8 * thick)
        return [*inner, *paired(side, (wide - share) / 2)]
    if style == "split":
        cut, kind = dice.between(0.35, 0.65) * long, dice.pick(PLAIN)
        upper = padding(dice, kind, wide, long - cut - 0.006, thick * dice.between(0.8, 1.0))
        return [*padding(dice, kind, wide, cut, thick), *moved(upper, (0, cut + 0.006, 0))]
    body = prism(rounded(dice.between(0.04, 0.2), wide / long), size) + middle
    x, y = np.meshgrid((np.arange(3) - 1) * wide / 3.4, np.linspace(0.2, 0.8, dice.whole(2, 4)) * long)
    spots = np.stack([x, y, 0 * x + thick], axis=-1).reshape(-1, 3)
    return [body] if style == "rounded" else [body, *at(superquadric((0.024, 0.024, 0.014), rows=4), spots)]


def grid(piece: FloatArray, xs: Iterable[float], ys: Iterable[float], z: float = 0.0) -> Pieces:
    """A copy at each x of each y, all at one height."""
    rows = list(ys)
    return at(piece, [(x, y, z) for x in xs for y in rows])


def paired(piece: FloatArray, x: float) -> Pieces:
    """A copy at either side: at -x and at x."""
    return grid(piece, (-x, x), (0,))


def add_headrest(made: Made, wide: float, tall: float, thick: float, paddle: bool = False) -> None:
    """Adds one at the top of a backrest that lies: on two rods in collars, or on a bar behind (`paddle`)."""
    dice, own, z = made.dice, made.kit, 0.1 * thick
    across, high, soft = wide * dice.between(0.42, 0.7), dice.between(0.11, 0.2), dice.between(0.06, 0.1)
    pad = padding(dice, dice.pick(PLAIN), across, high, soft)
    level, moves = tall + dice.between(0.014, 0.05), slide((0, 1, 0), dice.between(0.05, 0.1))
    if paddle:
        pin = np.array([0, tall + 0.03, -0.35 * thick - 0.036])
        straps = [box((0.09, 0.03, 0.012), (0, y * tall, pin[2])) for y in (0.7, 0.9)]
        straps += moved(paired(box((0.006, 0.3 * tall, 0.02)), 0.04), pin * [1, 0.7, 0.9])
        own.fix(straps, made.frame)
        bar = between((-0.03, 0.5 * tall, pin[2] - 0.003), (0.03, tall + 0.012, pin[2] + 0.003))
        holder, ends = [bar, *moved(paired(box((0.008, 0.05, 0.03)), 0.024), pin)], pin
        joint = [lying(0.014, 0.034) + pin, rod(pin, (0, level + 0.05, z), 0.01, 8)]
    else:
        x, tips = across * dice.between(0.2, 0.34), dice.chance(0.3)
        collar = pointed(sleeve_of(0.0075, 0.014, 0.016, 10), Y) + [0, tall - 0.004, z]
        own.fix(paired(collar, x), made.hard)
        holder = paired(rod((0, tall - 0.1, z), (0, level + (0 if tips else 0.5 * high), z), 0.006, 8), x)
        if not tips:
            cushion = moved(pad, (0, level, z - 0.5 * soft))
            own.add("headrest", moves, [(holder, made.frame), (cushion, made.cover)])
            return
        ends, joint = np.array([0, level, z]), paired(box((0.02, 0.03, 0.022), (0, level + 0.006, z)), x / 2)
        holder.append(lying(0.008, 2 * x + 0.03) + ends)
    number = own.add("bracket", moves, [(holder, made.frame)])
    parts = [(moved(pad, (0, level + 0.016, z - 0.5 * soft)), made.cover), (joint, made.frame)]
    own.add("headrest", hinge(ends, LEFT, 0.35, -0.3), parts, number)


def add_backrest(
    made: Made, seat: int, pin: FloatArray, deck: float, size: tuple[float, float, float], upper: float
) -> tuple[int, Made]:
    """Adds one to a seat, on a pin above its deck, as a body without surfaces yet.

    Gives its number, and its surfaces in a kit of their own, lying from y = 0 back: to be leaned and grafted.
    """
    (wide, tall, thick), dice, kit = size, made.dice, made.kit
    own = replace(made, kit=Assembly())
    number = kit.add("backrest", hinge(pin, LEFT, upper, -dice.between(0.1, 0.25)), [], seat)
    hull = prism(rounded(dice.between(0.02, 0.15), wide / tall), (0.98 * wide, tall - 0.04, 0.02))
    hull += [0, tall / 2 + 0.015, -0.35 * thick - 0.008]
    pad = moved(padding(dice, made.style, wide, tall - 0.03, thick), (0, 0.03, -0.35 * thick))
    share = dice.pick((0.0, 0.0, dice.between(-0.1, 0.35)))
    for piece in (hull, *pad):  # narrower, or wider, at its top
        piece[..., 0] *= 1 - share * piece[..., 1] / tall
    own.kit.fix(pad, made.cover)
    own.kit.fix([hull], made.hard)
    hub = dice.between(0.016, 0.036)
    if dice.chance(0.35):
        irons = [lying(hub / 1.5, 0.8 * wide), *paired(box((0.03, 0.08, 0.01), (0, 0.035, 0)), wide / 4)]
        out, wall = 0.43 * wide, 0.02
        kit.fix([lying(hub / 3, 0.86 * wide, X, 8) + pin], made.frame, seat)
    else:
        x, long = wide / 2 + 0.006, tall * dice.between(0.2, 0.6)
        irons = [*paired(box((0.008, long, 1.4 * hub), (0, long / 2, 0)), x), *paired(lying(hub, 0.009), x)]
        out, wall = x + 0.012, 0.01
    own.kit.fix(irons, made.frame)
    y, z = pin[1:]
    lug = [(y - 0.12, deck), (y, deck), (y + 0.03, z), (y + 0.015, z + 0.025), (y - 0.025, z + 0.025)]
    plates = paired(profile(lug, wall), out)
    kit.fix([*plates, *paired(lying(0.75 * hub, wall + 0.016, X, 10) + pin, out + 0.003)], made.frame, seat)
    return number, own


def room_to_tip(made: Made, back: float) -> float:
    """How far before the pin of a backrest of a thickness the seat's cushion ends, for it to tip forward."""
    return 0.02 + back * (1.0 if made.style == "bolsters" else 0.7)


def add_lever(made: Made, parent: int, spot: FloatArray, side: int) -> None:
    """Adds a lever that is pulled up, or a hand wheel, on a boss on a side face."""
    dice, kit, radius = made.dice, made.kit, made.dice.between(0.012, 0.02)
    kit.fix([lying(1.5 * radius, 0.02) + spot], made.frame, parent)
    hub = spot + [side * 0.024, 0, 0]
    if dice.chance(0.3):
        wheel = 1.6 * radius + dice.between(0.0, 0.02)
        ribs = around([box((0.006, 0.008, 0.02), (wheel, 0, 0))], dice.whole(6, 14))
        pieces = [pointed(piece, X) for piece in (cylinder(wheel, 0.024, 18), *ribs)]
        kit.add("knob", spin(spot, RIGHT), [(moved(pieces, hub), made.hard)], parent)
        return
    reach, turn = dice.between(0.1, 0.2), rotation(LEFT, dice.between(-0.1, 0.4))
    tip = np.array([side * 0.012 * dice.whole(0, 1), -reach, 0])
    grip = ball_knob(1.4 * radius) + tip if dice.chance(0.4) else rod(tip / 2, tip, 0.9 * radius, 8)
    arm = [lying(radius, 0.022), box((0.01, reach, radius), (0, -reach / 2, 0)), grip]
    moves = hinge(spot, LEFT, dice.between(0.4, 0.8))
    kit.add("lever", moves, [(moved(turned(arm, turn), hub), made.hard)], parent)


def add_armrest(made: Made, parent: int, pin: FloatArray, side: int, turn: FloatArray, long: float) -> None:
    """Adds one that tips up about a bolt through its end; `turn` takes it from level to how its parent is."""
    wide, hub = made.dice.between(0.045, 0.08), made.dice.between(0.026, 0.036)
    out = side * (wide / 2 + 0.012)
    beam = turned(padding(made.dice, made.dice.pick(PLAIN), wide, long, 1.5 * hub), HALF_TURN)
    pieces = [*moved(beam, (out, -0.6 * hub, -0.6 * hub)), lying(hub, 0.9 * wide, X, 16) + [out, 0, 0]]
    bolt = lying(0.55 * hub, wide + 0.05, X, 10) + pin + [out - side * 0.012, 0, 0]
    made.kit.fix([bolt], made.frame, parent)
    moves = hinge(pin, LEFT, made.dice.between(1.2, 1.5))
    made.kit.add("armrest", moves, [(moved(turned(pieces, turn), pin), made.cover)], parent)
