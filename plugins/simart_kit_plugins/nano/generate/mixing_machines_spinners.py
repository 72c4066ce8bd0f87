"""What is cranked or pumped by hand: salad spinners, coffee mills, mincers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, loft, prism, revolve, tube, vessel
from . import looks
from .assembling import Assembly, dial, disc
from .mixing_machines_parts import (
    BACK,
    DARK,
    DOWN,
    LEFT,
    ON_TOP,
    UP,
    cup,
    dome,
    rear_hinge,
    ring,
)
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import lying


def salad_spinner(dice: Dice) -> list[Body]:
    """A salad spinner, a coffee mill or a mincer."""
    style = dice.unit()
    if style < 0.55:
        return _spinner(dice)
    if style < 0.84:
        return _coffee_mill(dice) if style < 0.74 else _tube_mill(dice)
    return _mincer(dice)


def _spinner(dice: Dice) -> list[Body]:
    """A basket that spins in a bowl, and a lid with a crank, a knob or a plunger on it."""
    kit, look = Assembly("bowl"), looks.plastic(dice) if dice.chance(0.5) else looks.glass(dice)
    radius, high = dice.between(0.1, 0.14), dice.between(0.1, 0.16)
    foot, rim = dice.between(0.65, 0.9) * radius, radius + 0.005
    line = [
        (foot, 0),
        (foot + 0.006, 0.004),
        (0.95 * radius, 0.6 * high),
        (radius, high - 0.006),
        (rim, high - 0.005),
    ]
    kit.fix([cup([*line, (rim, high)], 0.003, 32)], look)
    kit.fix([cylinder(0.008, 0.009, 12) + [0, 0, 0.007]], look)
    _basket(dice, kit, foot - 0.012, 0.95 * radius - 0.012, 0.0125, high - 0.008)
    level, rise = high + 0.0012, dice.between(0.012, 0.05)
    shoulder = dice.between(0.73, 0.95)
    line = [
        (0, level),
        (rim + 0.003, level),
        (rim + 0.003, level + 0.008),
        (min(shoulder + dice.between(0.0, 0.25), 1.0) * radius, level + 0.008),
        (shoulder * radius, level + rise),
        (0, level + rise),
    ]
    shape, motion, cover = [revolve(line, 32)], free(), looks.plastic(dice)
    if dice.chance(0.25):
        pin, knuckles = rear_hinge(kit, rim, level, look)
        shape, motion = shape + knuckles, hinge(pin, LEFT, dice.between(1.4, 2.0))
    lid = kit.add("lid", motion, [(shape, cover)])
    top, grips = np.array([0, 0, level + rise]), looks.plastic(dice)
    style = dice.unit()
    if style < 0.45:
        spot = top + [0, dice.pick((0.0, 0.0, 0.45)) * radius, 0]
        kit.fix([cylinder(0.02, 0.008, 18) + spot + [0, 0, 0.003]], cover, lid)
        reach = dice.between(0.6, 0.9) * min(0.75 * radius, 0.95 * radius - spot[1])
        crank(dice, kit, lid, spot + [0, 0, 0.0085], reach, grips)
    elif style < 0.62:
        knob = turned(dial(dice, dice.between(0.22, 0.36) * radius), ON_TOP)
        kit.add("knob", spin(top, UP), [(moved(knob, top + [0, 0, 0.001]), grips)], lid)
    else:
        _plunger(dice, kit, lid, top, radius, cover)
    if dice.chance(0.4):
        pads = Assembly()
        pads.fix([disc(0.016, 0.003, 18)], grips)
        size = dice.between(0.007, 0.011)
        pads.add(
            "button", slide(BACK, 0.003), [([disc(size, 0.005, 16) - [0, 0.0032, 0]], looks.plastic(dice))]
        )
        kit.graft(pads, top - [0, 0.55 * radius, 0.0005], ON_TOP, lid)
    return kit.done()


def _basket(dice: Dice, kit: Assembly, low: float, mouth: float, floor: float, top: float) -> None:
    """A basket of ribs between a floor and hoops, which spins."""
    ribs, hoops = dice.whole(14, 30), dice.whole(2, 4)
    thick, high = 0.0015, top - floor
    pieces = [cylinder(low, 0.002, 28) + [0, 0, floor + 0.001]]
    rib = tube([(low - thick, 0, floor + 0.001), (mouth - thick, 0, top - 0.002)], thick, 4)
    pieces += around([rib], ribs)
    for share in np.linspace(1, 0.3, hoops):
        r = low + share * (mouth - low)
        pieces.append(ring(r - 2.2 * thick, r, floor + share * high - 0.005, floor + share * high, 28))
    kit.add("basket", spin((0, 0, 0), UP), [(pieces, looks.plastic(dice))])


def _plunger(dice: Dice, kit: Assembly, lid: int, top: FloatArray, radius: float, look: Look) -> None:
    """A plunger that is pumped in a sleeve on a lid."""
    wide, stroke = dice.between(0.14, 0.3) * radius, dice.between(0.015, 0.035)
    kit.fix([ring(wide + 0.0015, wide + 0.005, -0.001, stroke + 0.006, 22) + top], look, lid)
    low, high = stroke + 0.0015, 2 * stroke + dice.between(0.012, 0.02)
    parts = [
        cylinder(wide, high - low, 20) + [0, 0, (high + low) / 2],
        dome(wide * 0.9, high, high + 0.006, 0.8),
    ]
    if dice.chance(0.5):
        parts.append(cylinder(wide + 0.006, 0.008, 20) + [0, 0, high - 0.003])
    kit.add("plunger", slide(DOWN, stroke), [(moved(parts, top), looks.plastic(dice))], lid)


def crank(dice: Dice, kit: Assembly, parent: int, spot: ArrayLike, reach: float, look: Look) -> None:
    """An arm that turns about z at a spot, with a hub below it and a knob at its end that spins too."""
    rise, wide = dice.between(0.0, 0.4) * reach, dice.between(0.008, 0.014)
    turn, metal = rotation(UP, dice.between(0, 6.28)), looks.metal(dice)
    hub, level = 0.014 + rise, 0.008 + rise
    arm: Pieces = [cylinder(0.8 * wide, hub, 14) + [0, 0, hub / 2 + 0.0005]]
    arm.append(box((reach + wide / 2, wide, 0.005), (reach / 2 + wide / 4, 0, level)))
    arm.append(cylinder(0.003, 0.024, 8) + [reach, 0, level + 0.012])
    number = kit.add("crank", spin(spot, UP), [(moved(turned(arm, turn), spot), metal)], parent)
    high, size = dice.between(0.025, 0.04), dice.between(0.008, 0.013)
    line = [(0, 0), (0.7 * size, 0), (size, 0.6 * high), (0.8 * size, high), (0, high)]
    place = np.asarray(spot) + turn @ [reach, 0, level + 0.0035]
    kit.add("knob", spin(place, UP), [(moved([revolve(line, 14)], place), look)], number)


def _coffee_mill(dice: Dice) -> list[Body]:
    """A box with a drawer below a hopper or a dome, and a crank on top."""
    kit, coat, brass = Assembly("box"), looks.wood(dice), looks.metal(dice)
    wide, high, wall = dice.between(0.1, 0.16), dice.between(0.09, 0.15), 0.007
    deep, low = wide * dice.between(0.9, 1.1), dice.between(0.35, 0.55) * high
    x, y = wide / 2, deep / 2
    case = [between((-x, -y, 0), (x, y, wall)), between((-x, -y, high - wall), (x, y, high))]
    case += [
        between((s * x - wall * (s > 0), -y, wall), (s * x + wall * (s < 0), y, high - wall)) for s in (-1, 1)
    ]
    case += [between((wall - x, y - wall, wall), (x - wall, y, high - wall))]
    case += [between((wall - x, -y, low), (x - wall, wall - y, high - wall))]
    case += [box((wide + 0.016, deep + 0.016, 0.006), (0, 0, z)) for z in (-0.003, high + 0.003)]
    kit.fix(case, coat)
    inner = wide - 2 * wall - 0.003
    tray = vessel(SQUARE, (inner - 0.002, deep - wall - 0.012, 0.7 * (low - wall)), 0.003) + [
        0,
        -wall / 2,
        wall + 0.0012,
    ]
    face = box((inner, 0.007, low - wall - 0.003), (0, 0.0035 - y, (low + wall) / 2))
    pull_ = moved([disc(0.004, 0.012, 10), disc(0.008, 0.006, 14) - [0, 0.01, 0]], (0, -y, (low + wall) / 2))
    kit.add("drawer", slide((0, -1, 0), 0.75 * deep), [([tray, face], coat), (pull_, brass)])
    top, radius = high + 0.006, 0.42 * wide
    rise = dice.between(0.03, 0.06)
    if dice.chance(0.5):
        kit.fix([dome(radius, top - 0.001, top + rise, 0.9)], brass)
        if dice.chance(0.6):
            flap = prism(rounded(0.4), (0.5 * radius, 0.5 * radius, 0.002)) + [0, -0.3 * radius, 0]
            spot = np.array([0.45 * radius, 0, top + rise - 0.003])
            kit.fix([cylinder(0.4 * radius, 0.002, 16) + [0, 0, top + rise]], brass)
            kit.add(
                "flap",
                hinge(spot, UP, 1.2),
                [(moved([flap, cylinder(0.003, 0.008)], spot + [0, 0, 0.012]), brass)],
            )
    else:
        kit.fix(
            [cup([(0.4 * radius, top - 0.001), (radius, top + 0.8 * rise), (radius, top + rise)], 0.002)],
            brass,
        )
        kit.fix([box((2 * radius - 0.002, 0.012, 0.004), (0, 0, top + rise - 0.003))], brass)
        kit.fix([cylinder(0.006, rise, 10) + [0, 0, top + rise / 2 - 0.002]], brass)
    crank(
        dice,
        kit,
        0,
        (0, 0, top + rise + 0.0015),
        dice.between(0.75, 1.1) * wide,
        coat if dice.chance(0.6) else DARK,
    )
    return kit.done()


def _tube_mill(dice: Dice) -> list[Body]:
    """A tube with a jar screwed on below, a lid and a crank on it."""
    kit, metal = Assembly("body"), looks.metal(dice)
    radius, long, jar = dice.between(0.022, 0.04), dice.between(0.08, 0.14), dice.between(0.05, 0.09)
    waist = dice.between(0.75, 1.0) * radius
    line = [(0, 0), (radius, 0), (waist, 0.4 * long), (radius, long), (0, long)]
    kit.fix([revolve(line, 24) + [0, 0, jar + 0.001]], metal if dice.chance(0.5) else looks.wood(dice))
    shape = [cup([(0.9 * radius, 0), (radius, 0.004), (radius, jar)], 0.002, 24)]
    kit.add("jar", spin((0, 0, 0), UP), [(shape, looks.glass(dice))])
    top = jar + long + 0.002
    lid = kit.add("lid", free(), [([dome(1.03 * radius, top, top + 0.012, 0.6, 24)], looks.plastic(dice))])
    crank(dice, kit, lid, (0, 0, top + 0.0125), dice.between(2.2, 3.5) * radius, DARK)
    return kit.done()


def _mincer(dice: Dice) -> list[Body]:
    """A barrel with a hopper on a foot that is clamped or sucked on; a crank behind, a ring nut before it."""
    kit, coat, dark = Assembly("body"), looks.metal(dice), looks.plastic(dice)
    radius, long, up = dice.between(0.026, 0.036), dice.between(0.11, 0.15), dice.between(0.14, 0.2)
    wall = 0.004
    barrel = ring(radius, radius + wall, 0, long) + [0, 0, -long / 2]
    kit.fix(
        moved(
            [pointed(barrel, Y), pointed(cylinder(radius + wall, 0.006, 24), Y) + [0, long / 2 + 0.001, 0]],
            (0, 0, up),
        ),
        coat,
    )
    neck, tall = 0.75 * radius, dice.between(0.05, 0.08)
    spot = np.array([0, 0.15 * long, up + radius + wall - 0.003])
    mouth = min(dice.between(1.6, 2.3) * radius, 0.35 * long + 0.015)
    kit.fix([cup([(neck, 0), (neck, 0.5 * tall), (mouth, tall)], 0.003) + spot], coat)
    if dice.chance(0.5):
        push = [
            cylinder(neck - 0.0045, 0.8 * tall, 16) + [0, 0, 0.6 * tall],
            cylinder(neck, 0.012, 16) + [0, 0, 1.05 * tall],
        ]
        push = [piece + [0, 0, 0.1 * tall] for piece in push]
        kit.add("plunger", slide(UP, 0.8 * tall, -0.15 * tall), [(moved(push, spot), dark)])
    front = -long / 2 - 0.0012
    nut = [pointed(ring(0.86 * radius, radius + 0.009, -0.018, 0, 24), Y)]
    nut += [
        turned([box((0.008, 0.018, 0.006), (radius + 0.01, -0.009, 0))], rotation(BACK, k * 0.785))[0]
        for k in range(8)
    ]
    kit.add("ring", spin((0, 0, up), BACK), [(moved(nut, (0, front, up)), coat)])
    plate = [
        disc(0.84 * radius, 0.004, 24),
        *[turned([disc(0.003, 0.005, 8) + [0.5 * radius, 0, 0]], rotation(BACK, k))[0] for k in range(6)],
    ]
    kit.fix(moved(plate, (0, front - 0.004, up)), looks.metal(dice))
    worm = np.linspace(0, 12, 40)
    path = np.column_stack(
        [0.55 * radius * np.cos(worm), np.linspace(0.35, -0.44, 40) * long, 0.55 * radius * np.sin(worm)]
    )
    arm, reach = [lying(0.4 * radius, 0.85 * long, Y), tube(path, 0.3 * radius, 5)], dice.between(0.1, 0.15)
    reach = min(reach, up - 0.03)
    back = long / 2 + 0.02
    arm += [
        lying(0.007, 0.035, Y, 10) + [0, back - 0.006, 0],
        box((0.016, 0.006, reach + 0.016), (0, back + 0.008, -reach / 2)),
    ]
    arm += [lying(0.004, 0.03, Y, 8) + [0, back + 0.022, -reach]]
    turn = rotation(BACK, dice.between(0, 6.28))
    number = kit.add("crank", spin((0, 0, up), BACK), [(moved(turned(arm, turn), (0, 0, up)), coat)])
    hold = np.array([0, 0, up]) + turn @ [0, back + 0.012, -reach]
    shape = pointed(revolve([(0, 0), (0.008, 0), (0.013, 0.05), (0.009, 0.085), (0, 0.085)], 14), Y)
    kit.add("knob", spin(hold, BACK), [([shape + hold], looks.wood(dice))], number)
    _mincer_foot(dice, kit, up - radius, coat, dark)
    return kit.done()


def _mincer_foot(dice: Dice, kit: Assembly, top: float, coat: Look, dark: Look) -> None:
    """A column to a jaw with a clamp screw, or to a suction foot with a lever."""
    kit.fix([loft(rounded(0.3), [(0.03, 0.03, 0.02), (0.024, 0.04, top), (0, 0, top)])], coat)
    if dice.chance(0.5):
        jaw = [box((0.05, 0.07, 0.012), (0, -0.01, 0.016)), box((0.03, 0.014, 0.09), (0, 0.03, -0.024))]
        kit.fix([*jaw, box((0.03, 0.06, 0.014), (0, 0.005, -0.066))], coat)
        spot = np.array([0, -0.008, -0.066])
        screw = [cylinder(0.006, 0.07, 10) + [0, 0, -0.004], cylinder(0.014, 0.006, 16) + [0, 0, 0.033]]
        screw.append(box((0.04, 0.006, 0.014), (0, 0, -0.04)))
        kit.add("clamp screw", spin(spot, UP), [(moved(screw, spot), coat)])
        return
    kit.fix([revolve([(0, 0), (0.075, 0), (0.07, 0.012), (0.03, 0.024), (0, 0.024)], 26)], dark)
    side = dice.sign()
    pin = np.array([side * 0.045, 0, 0.04])
    kit.fix([box((0.004, 0.02, 0.03), pin + [s * 0.008, 0, -0.009]) for s in (-1, 1)], dark)
    lever = [lying(0.007, 0.01), box((0.01, 0.07, 0.007), (0, -0.035, 0)), lying(0.003, 0.022, X, 8)]
    kit.add("lever", hinge(pin, LEFT, dice.between(1.0, 1.6)), [(moved(lever, pin), looks.plastic(dice))])
