"""Fittings that close something or carry it on: halves of cases, caps, clasps, flaps, busy leaves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, open_box, prism, superquadric
from . import fitted_arms, fitted_leaves, fittings
from .assembling import Assembly, disc
from .fittings import Fitting, Room, standing
from .objects import hinge, slide, spin

# What is on a leaf: locks and such.
_ON_LEAVES: Sequence[tuple[float, Fitting]] = (
    (3, fittings.knob),
    (3, fitted_arms.flat_lever),
    (1, fittings.handwheel),
    (1, fittings.crank),
    (2, fittings.buttons),
    (1, fittings.bail),
    (1, fitted_leaves.bolt),
    (1, fitted_leaves.leaf),
)


def case_half(dice: Dice, room: Room) -> Assembly:
    """A shell that lies with its mouth on the plane and opens about one of its edges; some have a clasp."""
    kit, deep = Assembly(), room.least * dice.between(0.15, 0.6)
    wide, high = room.wide * dice.between(0.7, 1.0), room.high * dice.between(0.6, 1.0)
    gap, wall = 0.006 * room.least, 0.03 * room.least
    shell = open_box((wide, high, deep), wall)
    if dice.chance(0.3):
        shell = prism(rounded(0.2), (wide, high, deep)) + [0, 0, deep / 2]
    shells = moved(turned([shell], rotation((1, 0, 0), -np.pi / 2)), (0, -deep - gap, 0))
    knuckle = max(0.02 * room.least, gap)
    pin = np.array([0, -gap - knuckle * dice.pick((0.0, 1.0)), -high / 2 - 0.5 * knuckle])
    spots = [(x * wide, 0, 0) for x in ((0,) if dice.chance(0.4) else (-0.35, 0.35))]
    barrels = at(pointed(cylinder(knuckle, wide * dice.between(0.08, 0.3), 10), X) + pin, spots)
    kit.fix(barrels if dice.chance(0.8) else [], room.base)
    half = kit.add(
        dice.pick(("lid", "hatch", "cover")),
        hinge(pin, (1, 0, 0), dice.between(1.2, 3.0)),
        [(shells, room.own)],
    )
    if dice.chance(0.4):
        size = np.array([0.12 * wide, 0.02 * high, 0.35 * deep])
        for x in (-0.3, 0.3) if dice.chance(0.6) else (0.0,):
            top = np.array([x * wide, -gap - 1.3 * size[2], high / 2 + 0.7 * size[1]])
            plate = box((size[0], size[2], size[1]), top + [0, 0.5 * size[2], 0.0])
            bolt = pointed(cylinder(0.6 * size[1], size[0], 8), X) + top
            kit.add("latch", hinge(top, (1, 0, 0), 1.6), [([plate, bolt], room.accent)], half)
    return kit


def trailing_flap(dice: Dice, room: Room) -> Assembly:
    """A slab that stands off, and one as thick that carries it on and tips about the line between."""
    kit, wide = Assembly(), room.wide * dice.between(0.5, 1.0)
    thick = room.high * dice.between(0.15, 0.9) if room.high < 0.4 * room.wide else 0.06 * room.least
    own, fixed = room.wide * dice.between(0.12, 0.5), room.wide * dice.between(0.0, 0.4)
    side = dice.pick((-1, 0, 1))  # where the line is: below, in the middle or above
    gap = thick * (0.05 if side else dice.between(0.2, 0.4))
    if fixed > thick:
        kit.fix([box((wide, fixed, thick), (0, -fixed / 2, 0))], room.own)
    else:
        fixed = 0.0
    line = -fixed - gap
    thin = dice.between(0.2, 1.0)
    profile = np.array([(0, -0.5), (0, 0.5), (-1, 0.5 * thin), (-1, -0.5 * thin)])
    flap = pointed(
        loft(profile, [(0, 0, -0.5), (1, 1, -0.5), (1, 1, 0.5), (0, 0, 0.5)]) * [own, thick, 0.98 * wide], X
    )
    pieces = moved([flap], (0, line, 0))
    level = 0.5 * side * thick
    if dice.chance(0.6):
        barrel = pointed(cylinder(0.3 * thick, 0.1 * wide, 8), X) + [0, line + gap, level]
        kit.fix(at(barrel, [(x * wide, 0, 0) for x in (-0.35, 0.35)]), room.base)
    down, up = {-1: (1.5, 0.0), 0: (0.35, -0.35), 1: (0.0, -1.5)}[side]
    kit.add("flap", hinge((0, line + gap, level), (1, 0, 0), down, up), [(pieces, room.own)])
    return kit


def pad(dice: Dice, room: Room) -> Assembly:
    """A board or a cushion that stands off and tips about its root, some between cheeks."""
    kit, wide = Assembly(), room.wide * dice.between(0.4, 0.9)
    reach, thick = room.wide * dice.between(0.4, 1.2), room.high * dice.between(0.1, 0.4)
    root = thick * dice.between(0.1, 0.6)
    size = (wide, reach, thick)
    piece = box(size) if dice.chance(0.5) else superquadric(size, 0.3, 0.3, 6)
    pieces = [piece - [0, root + reach / 2, 0]]
    if dice.chance(0.4):
        pieces.append(
            superquadric((0.8 * wide, 0.8 * reach, thick), 0.3, 0.3, 6) + pieces[0].mean(axis=(0, 1))
        )
    pin = np.array([0, -root, thick * dice.pick((-0.4, 0.0, 0.4))])
    style = dice.unit()
    if style < 0.4:
        cheek = wide * dice.between(0.04, 0.15)
        tall = reach * dice.between(0.15, 0.6)
        spots = [(s * (wide / 2 + 0.55 * cheek), -tall / 2, 0) for s in (-1, 1)]
        kit.fix([boxes((cheek, tall, thick * dice.between(1.0, 2.0)), spots)], room.base)
    if style > 0.25:
        pieces.append(pointed(cylinder(0.12 * thick, 1.1 * wide, 10), X) + pin)
    most = dice.between(0.3, 1.3)
    lean = rotation((1, 0, 0), dice.between(-0.4, 0.4))
    motion = hinge(pin, (dice.sign(), 0, 0), most, -most * dice.pick((0, 0.3)))
    kit.add(dice.pick(("backrest", "footrest", "seat")), motion, [(turned(pieces, lean, pin), room.own)])
    return kit


def screw_cap(dice: Dice, room: Room) -> Assembly:
    """A cap on a neck, which turns without end; some with ribs."""
    kit, radius = Assembly(), room.least * dice.between(0.12, 0.45)
    neck, high = radius * dice.between(0.05, 0.5), radius * dice.between(0.3, 1.4)
    kit.fix([disc(radius * dice.between(0.7, 1.15), neck, 18)], room.base)
    narrow = dice.between(0.75, 1.0)
    cap = loft(
        ngon(18),
        [(0, 0, 0), (2 * radius, 2 * radius, 0), (2 * narrow * radius,) * 2 + (high,), (0, 0, high)],
    )
    pieces: Pieces = [cap]
    if dice.chance(0.6):
        rib = box((0.08 * radius, 0.1 * radius, 0.8 * high), (0.97 * narrow * radius, 0, high / 2))
        pieces += around([rib], dice.whole(6, 12))
    kit.add("cap", spin((0, 0, 0), (0, 1, 0)), [(moved(standing(pieces), (0, -neck, 0)), room.own)])
    return kit


def clasp(dice: Dice, room: Room) -> Assembly:
    """A plate that is hinged at a block and lies over another one."""
    kit, long = Assembly(), room.wide * dice.between(0.3, 0.8)
    wide, thick = room.high * dice.between(0.1, 0.4), room.least * dice.between(0.02, 0.06)
    off = thick * dice.between(1.0, 2.0)
    kit.fix([box((0.2 * long, off, 0.9 * wide), (s * 0.5 * long, -off / 2, 0)) for s in (-1, 1)], room.base)
    pin = np.array([-0.55 * long, -off - 0.6 * thick, 0])
    plate = box((1.1 * long, thick, wide), (0, -off - 0.6 * thick, 0))
    barrel = cylinder(0.9 * thick, 1.1 * wide, 10) + pin - [0.9 * thick, 0, 0]
    pieces: Pieces = [plate, barrel]
    if dice.chance(0.5):
        pieces.append(box((0.1 * long, 2 * thick, wide), (0.58 * long, -off - 1.5 * thick, 0)))
    motion = hinge(pin - [0.9 * thick, 0, 0], (0, 0, -1), dice.between(1.4, 2.8))
    kit.add(dice.pick(("latch", "latch", "cover")), motion, [(pieces, room.own)])
    return kit


def busy_leaf(dice: Dice, room: Room) -> Assembly:
    """A leaf with something on it that moves by itself."""
    kit = fitted_leaves.leaf(dice, room)
    points = kit.points(1)
    low, high = points.min(axis=0), points.max(axis=0)
    wide, tall = (high - low)[[0, 2]]
    spot = np.array([low[0] + wide * dice.between(0.45, 0.7), 0, dice.between(-0.25, 0.25) * tall])
    near = points[(np.abs(points - spot)[:, [0, 2]] < [0.4 * wide, 0.4 * tall]).all(axis=1)]
    spot[1] = near[:, 1].min() if len(near) else low[1]
    small = Room(0.4 * wide, 0.35 * tall, room.base, room.own, room.accent)
    kit.graft(dice.weighted(_ON_LEAVES)(dice, small), spot, parent=1)
    return kit


def hung_panel(dice: Dice, room: Room) -> Assembly:
    """A panel or a grate before the plane that hangs on a rail, or stands on one, and slides along it."""
    kit, share = Assembly(), dice.between(0.35, 0.55)
    wide, high = room.wide * share, room.high * dice.between(0.7, 0.9)
    thick, rail = room.least * dice.between(0.02, 0.06), room.high * dice.between(0.02, 0.05)
    off, x = thick * dice.between(0.3, 1.0), -room.wide / 2 + wide / 2
    hung = dice.sign()
    bar = box((room.wide, off + 0.9 * thick, rail), (0, -(off + 0.9 * thick) / 2, hung * (high + rail) / 2))
    kit.fix([bar], room.base)
    if dice.chance(0.4):
        bars = [(s * 0.4 * wide, 0, 0) for s in np.linspace(-1, 1, dice.whole(3, 8))]
        pieces = at(box((0.05 * wide, thick, high * 0.96)), bars)
        pieces += at(box((0.9 * wide, 0.8 * thick, 0.05 * high)), [(0, 0, s * 0.45 * high) for s in (-1, 1)])
    else:
        pieces = [box((wide, thick, high * 0.98))]
    pieces += _rollers(dice, wide, thick, hung * (high / 2 + 0.5 * rail), rail)
    motion = slide((1, 0, 0), (room.wide - wide) * dice.between(0.8, 1.0))
    parts = [(moved(pieces, (x, -off - 1.5 * thick, 0)), room.own)]
    kit.add("sliding door", motion, parts)
    return kit


def _rollers(dice: Dice, wide: float, thick: float, level: float, rail: float) -> Pieces:
    """What a panel hangs or rolls by; some have none."""
    if dice.chance(0.3):
        return []
    roller: FloatArray = pointed(cylinder(rail * dice.between(0.6, 1.2), 0.5 * thick, 12), Y)
    return at(roller + [0, 0, level], [(s * 0.35 * wide, -0.4 * thick, 0) for s in (-1, 1)])
