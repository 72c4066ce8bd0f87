"""Rice cookers, pressure cookers and slow cookers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, at, moved, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, loft, revolve, rod, tube
from . import looks
from .assembling import Assembly
from .mixing_machines_parts import (
    BACK,
    DARK,
    DOWN,
    LEFT,
    ON_TOP,
    RIGHT,
    UP,
    clamp_levers,
    cup,
    ear,
    grip,
    panel,
    rear_hinge,
    ring,
)
from .objects import Body, Look, free, hinge, slide
from .rigging import lying


def rice_cooker(dice: Dice) -> list[Body]:
    """A case with a hinged lid, a pressure cooker, or a case with a crock and a loose lid."""
    style = dice.unit()
    if style < 0.45:
        return _hinged_cooker(dice)
    return _pressure_cooker(dice) if style < 0.72 else _crock_cooker(dice)


def _hinged_cooker(dice: Dice) -> list[Body]:
    """A pot in a case, a domed lid flush with it, a button that frees the lid, and a bow to carry it by."""
    kit, coat = Assembly("case"), looks.plastic(dice) if dice.chance(0.5) else looks.painted_metal(dice)
    wide, high, wall = dice.between(0.22, 0.31), dice.between(0.13, 0.19), dice.between(0.022, 0.03)
    deep = wide * dice.between(1.0, 1.25)
    outline = rounded(dice.between(0.2, 0.36), wide / deep, 5)
    foot = dice.between(0.8, 0.97)
    stages = [(0, 0, 0), (foot * wide, foot * deep, 0), (wide, deep, 0.35 * high), (wide, deep, high)]
    inside = (wide - 2 * wall, deep - 2 * wall)
    kit.fix([loft(outline, [*stages, (*inside, high), (*inside, 0.03), (0, 0, 0.03)])], coat)
    radius = inside[0] / 2 - 0.003
    pot = [cup([(0.85 * radius, 0.0315), (radius, 0.06), (radius, high - 0.012)], 0.0025)]
    kit.add("pot", free(), [(pot, looks.metal(dice))])
    low, rise = high + 0.0015, dice.between(0.03, 0.06)
    sections = [(0, 0), (1, 0), (1, 0.2), (0.93, 0.6), (0.72, 0.92), (0, 1)]
    cover = loft(outline, [(s * wide, s * deep, low + t * rise) for s, t in sections])
    plug = cylinder(0.9 * radius, 0.009, 26) + [0, 0, low - 0.0035]
    pin = np.array([0, deep / 2 + 0.007, high + 0.003])
    kit.fix([box((0.76 * wide, 0.03, 0.03), (0, deep / 2 - 0.001, high - 0.021))], coat)
    kit.fix(
        [rod(pin - [s * 0.17 * wide, 0, 0], pin - [s * 0.08 * wide, 0, 0], 0.006, 12) for s in (-1, 1)], coat
    )
    ends = [box((0.03 * wide, 0.014, 0.014), pin + [s * 0.14 * wide, 0.002, -0.008]) for s in (-1, 1)]
    kit.fix(ends, coat)
    arm = [rod(pin - [0.075 * wide, 0, 0], pin + [0.075 * wide, 0, 0], 0.005, 12)]
    arm.append(box((0.14 * wide, 0.014, 0.006), pin + [0, -0.007, 0.003]))
    top = coat if dice.chance(0.6) else looks.metal(dice)
    lid = kit.add("lid", hinge(pin, LEFT, dice.between(1.35, 1.6)), [([cover, *arm], top), ([plug], DARK)])
    _lid_fittings(dice, kit, lid, (wide, deep, high), low + rise, rise)
    if dice.chance(0.7):
        _carrying_bow(dice, kit, (wide, deep, high))
    elif dice.chance(0.5):
        for s in (-1, 1):
            kit.fix([box((0.024, 0.09, 0.02), (s * (wide / 2 + 0.008), 0, 0.8 * high))], DARK)
    return kit.done()


def _lid_fittings(
    dice: Dice, kit: Assembly, lid: int, size: tuple[float, float, float], top: float, rise: float
) -> None:
    """The button that frees a lid, the steam cap, and the panel, on the lid or before the case."""
    wide, deep, high = size
    look = looks.plastic(dice)
    above = dice.chance(0.35)
    if above:
        kit.graft(panel(dice, 0.5 * wide, 0.2 * deep), (0, -0.13 * deep, top + 0.0005), ON_TOP, lid)
    else:
        kit.fix([box((0.62 * wide, 0.03, 0.5 * high), (0, 0.011 - deep / 2, 0.42 * high))], DARK)
        kit.graft(panel(dice, 0.56 * wide, 0.44 * high), (0, -deep / 2 - 0.005, 0.42 * high))
    if dice.chance(0.55):
        kit.fix([box((0.18 * wide, 0.012, 0.14 * high), (0, -deep / 2 + 0.002, 0.85 * high))], DARK)
        key = box((0.15 * wide, 0.006, 0.1 * high), (0, -deep / 2 - 0.007, 0.85 * high))
        kit.add("button", slide(BACK, 0.003), [([key], look)])
    else:
        level = top - 0.2 * rise
        kit.fix([box((0.2 * wide, 0.1 * deep, 0.6 * rise), (0, -0.4 * deep, level - 0.3 * rise))], DARK, lid)
        key = box((0.16 * wide, 0.07 * deep, 0.006), (0, -0.4 * deep, level + 0.0032))
        kit.add("button", slide(DOWN, 0.004), [([key], look)], lid)
    if dice.chance(0.75):
        spot, radius = np.array([0, dice.between(0.2, 0.28) * deep, top]), dice.between(0.016, 0.026)
        kit.fix([cylinder(1.25 * radius, 0.6 * rise, 20) + spot - [0, 0, 0.3 * rise - 0.003]], DARK, lid)
        cap = [cylinder(radius, 0.012, 20) + [0, 0, 0.0098], box((0.8 * radius, 0.003, 0.004), (0, 0, 0.017))]
        kit.add("cap", free(), [(moved(cap, spot), look)], lid)


def _carrying_bow(dice: Dice, kit: Assembly, size: tuple[float, float, float]) -> None:
    """A bow on bosses at both sides of a case; it lies back round its rear and swings up over the lid."""
    wide, deep, high = size
    pin = np.array([0, dice.between(0.02, 0.16) * deep, high - dice.between(0.025, 0.04)])
    reach = float(np.hypot(deep / 2 + 0.02 - pin[1], high + 0.012 - pin[2])) + 0.012
    x, look = wide / 2 + 0.011, looks.plastic(dice)
    bosses = [lying(0.016, 0.03, X, 18) + pin + [s * (x - 0.0205), 0, 0] for s in (-1, 1)]
    kit.fix([*bosses, *at(lying(0.006, 0.024), [pin + [s * (x - 0.002), 0, 0] for s in (-1, 1)])], look)
    bow = [lying(0.017, 0.009, X, 18) + [s * x, 0, 0] for s in (-1, 1)]
    bow += [box((0.008, reach, 0.018), (s * x, reach / 2, 0)) for s in (-1, 1)]
    bar = dice.between(0.008, 0.011)
    bow.append(
        lying(bar, 2 * x + 0.008) + [0, reach, 0]
        if dice.chance(0.5)
        else box((2 * x, 2 * bar, 0.018), (0, reach, 0))
    )
    kit.add("handle", hinge(pin, RIGHT, dice.between(1.5, 1.8)), [(moved(bow, pin), look)])


def _pressure_cooker(dice: Dice) -> list[Body]:
    """A pot or a round case under a lid that turns to lock or is hinged, with valves on the lid."""
    electric = dice.chance(0.5)
    kit, metal = Assembly("case" if electric else "pot"), looks.metal(dice)
    radius, high = dice.between(0.1, 0.135), dice.between(0.11, 0.22)
    rim = 1.05 * radius
    line = [(0.94 * radius, 0), (radius, 0.01), (radius, high - 0.008), (rim, high - 0.007), (rim, high)]
    kit.fix([cup(line, 0.004, 32)], metal)
    level, rise = high + 0.0012, dice.between(0.015, 0.04)
    line = [(0, level), (rim, level), (rim + 0.002, level + 0.01), (0.8 * rim, level + 0.75 * rise)]
    cover = revolve([*line, (0, level + rise)], 32)
    finish = _electric_lid if electric else _stove_lid
    lid = finish(dice, kit, cover, (radius, high, level, rise), metal)
    _valves(dice, kit, lid, radius, level + rise, rise)
    return kit.done()


def _electric_lid(
    dice: Dice, kit: Assembly, cover: FloatArray, size: tuple[float, float, float, float], metal: Look
) -> int:
    """A lid with a grip on it, which turns to lock or is hinged behind, over a case with a panel."""
    (radius, high, level, rise), dark = size, looks.plastic(dice)
    rim, top = 1.05 * radius, level + rise
    kit.fix([ring(radius + 0.0002, radius + 0.006, 0.0, 0.3 * high, 32)], dark)
    kit.fix([box((0.86 * radius, 0.023, 0.5 * high), (0, 0.0005 - radius, 0.45 * high))], dark)
    kit.graft(panel(dice, 0.8 * radius, 0.42 * high), (0, -radius - 0.014, 0.45 * high))
    _side_grips(kit, radius, 0.82 * high, dark)
    parts = [([cover], metal if dice.chance(0.5) else dark)]
    hold = moved(grip(dice, 0.2 * radius, 0.035), (0, 0, top - 0.002))
    parts.append((_bridge(radius, top) if dice.chance(0.5) else hold, dark))
    if dice.chance(0.65):
        return kit.add("lid", hinge((0, 0, 0), (0, 0, dice.sign()), dice.between(0.4, 0.8)), parts)
    pin, knuckles = rear_hinge(kit, rim, level, dark)
    parts.append((knuckles, dark))
    return kit.add("lid", hinge(pin, LEFT, dice.between(1.3, 1.6)), parts)


def _stove_lid(
    dice: Dice, kit: Assembly, cover: FloatArray, size: tuple[float, float, float, float], metal: Look
) -> int:
    """A lid that turns on a pot until its handle is over the pot's, and the lock on the handle."""
    (radius, high, level, _), dark, long = size, looks.plastic(dice), dice.between(0.13, 0.2)
    turn = rotation(UP, dice.pick((0.0, np.pi, -np.pi / 2)))
    stick = [box((long, 0.026, 0.02), (radius + long / 2 - 0.002, 0, high - 0.019))]
    kit.fix(turned(stick, turn), dark)
    kit.fix(turned(ear(radius, 0.6 * high, 0.85 * high, 0.035, 0.007), turn @ rotation(UP, np.pi)), dark)
    upper = turned([box((long + 0.02, 0.026, 0.016), (radius + long / 2 - 0.012, 0, level + 0.02))], turn)
    motion = hinge((0, 0, 0), (0, 0, dice.sign()), dice.between(0.4, 0.9))
    lid = kit.add("lid", motion, [([cover], metal), (upper, dark)])
    spot = turn @ np.array([radius + 0.4 * long, 0, level + 0.0285])
    cap = [box((0.024, 0.014, 0.007), (0, 0, 0.0037)), box((0.005, 0.014, 0.004), (0, 0, 0.009))]
    kit.add("slider", slide(turn @ RIGHT, 0.014), [(moved(turned(cap, turn), spot), metal)], lid)
    return lid


def _bridge(radius: float, top: float) -> Pieces:
    """A bar across a lid, on two feet."""
    feet = [box((0.02, 0.03, 0.05), (s * 0.6 * radius, 0, top + 0.003)) for s in (-1, 1)]
    return [*feet, box((1.2 * radius + 0.02, 0.03, 0.012), (0, 0, top + 0.033))]


def _side_grips(kit: Assembly, x: float, level: float, look: Look) -> None:
    """Two fixed ears."""
    for s in (-1, 1):
        path = [
            (s * (x - 0.01), -0.045, 0),
            (s * (x + 0.02), -0.04, 0),
            (s * (x + 0.02), 0.04, 0),
            (s * (x - 0.01), 0.045, 0),
        ]
        kit.fix(moved([tube(path, 0.008, 8)], (0, 0, level)), look)


def _valves(dice: Dice, kit: Assembly, lid: int, radius: float, top: float, rise: float) -> None:
    """A weight, a valve that is turned, and a pin that rises, each on a socket behind the grip of a lid."""
    look, metal = looks.plastic(dice), looks.metal(dice)
    spot = np.array([dice.between(-0.1, 0.1) * radius, 0.5 * radius, top - 0.1 * rise])
    kit.fix([cylinder(0.011, rise, 14) + spot - [0, 0, 0.5 * rise - 0.006]], metal, lid)
    seat = spot + [0, 0, 0.0072]
    if dice.chance(0.4):
        kit.add("cap", free(), [(moved([cylinder(0.014, 0.02, 16) + [0, 0, 0.01]], seat), metal)], lid)
    else:
        valve = [cylinder(0.013, 0.014, 16) + [0, 0, 0.007], box((0.007, 0.036, 0.009), (0, 0.013, 0.012))]
        most = dice.between(0.5, 1.6)
        kit.add(
            "valve",
            hinge(seat, UP, most, -most if dice.chance(0.4) else 0.0),
            [(moved(valve, seat), look)],
            lid,
        )
    if dice.chance(0.6):
        spot = np.array([-0.45 * radius, 0.3 * radius, top - 0.1 * rise])
        kit.fix(
            [ring(0.0045, 0.009, spot[2] - rise * 0.6, spot[2] + 0.005, 14) + [spot[0], spot[1], 0]],
            metal,
            lid,
        )
        kit.add("pin", slide(UP, 0.006), [([cylinder(0.0035, 0.006, 10) + spot + [0, 0, 0.005]], metal)], lid)


def _crock_cooker(dice: Dice) -> list[Body]:
    """An oval or round case with a crock in it and a loose lid, on some held by levers."""
    kit, coat, dark = Assembly("case"), looks.painted_metal(dice), looks.plastic(dice)
    wide, high = dice.between(0.24, 0.36), dice.between(0.12, 0.2)
    deep = wide * dice.pick((1.0, 0.75, 0.85))
    outline = ngon(32) if dice.chance(0.75) else rounded(0.35, wide / deep, 5)
    swell = dice.between(0.85, 1.0)
    inner = np.array([wide - 0.024, deep - 0.024])
    stages = [(0, 0, 0), (swell * wide, swell * deep, 0), (wide, deep, 0.4 * high), (wide, deep, high)]
    kit.fix([loft(outline, [*stages, (*inner, high), (*(swell * inner), 0.02), (0, 0, 0.02)])], coat)
    side = inner - 0.006
    hull = [
        (*(s * side), z)
        for s, z in ((0, 0.0215), (0.82 * swell, 0.0215), (swell, 0.45 * high), (1, high - 0.004))
    ]
    lip = [(wide, deep, high + 0.001), (wide, deep, high + 0.01), (*(side - 0.014), high + 0.01)]
    crock = loft(
        outline, [*hull, (*side, high + 0.001), *lip, (*(0.8 * swell * side - 0.01), 0.03), (0, 0, 0.03)]
    )
    kit.add("pot", free(), [([crock], looks.ceramic(dice) if dice.chance(0.6) else looks.metal(dice))])
    level, rise = high + 0.0112, dice.between(0.02, 0.05)
    sections = [(0, 0), (0.97, 0), (0.97, 0.004 / rise), (0.9, 0.006 / rise), (0.7, 0.75), (0, 1)]
    cover = loft(outline, [(s * wide, s * deep, level + t * rise) for s, t in sections])
    hold = moved(grip(dice, dice.between(0.014, 0.022), 0.035), (0, 0, level + rise - 0.002))
    clear = looks.glass(dice) if dice.chance(0.75) else looks.metal(dice)
    kit.add("lid", free(), [([cover], clear), (hold, dark)])
    if dice.chance(0.35):
        clamp_levers(kit, wide / 2, 0.6 * (high - 0.05), level, dark, dice.between(1.0, 1.8))
    else:
        _side_grips(kit, wide / 2, 0.8 * high, dark)
    kit.fix([box((0.5 * wide, 0.03, 0.5 * high), (0, 0.011 - deep / 2, 0.4 * high))], dark)
    kit.graft(panel(dice, 0.45 * wide, 0.44 * high), (0, -deep / 2 - 0.005, 0.4 * high))
    spots = [(x * 0.3 * wide, y * 0.3 * deep, -0.004) for x in (-1, 1) for y in (-1, 1)]
    kit.fix(at(cylinder(0.013, 0.01, 12), spots), DARK)
    return kit.done()
