"""Fans and lamps."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.legs import star_base
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, loft, prism, revolve, rod, superquadric, torus, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .objects import Body, Look, hinge, slide, spin


def _blades(dice: Dice, radius: float) -> Pieces:
    """A propeller about z, its blades pitched."""
    count, wide = dice.whole(2, 7), radius * dice.between(0.2, 0.7)
    pitch, thick = dice.between(0.15, 0.6), radius * 0.015
    outline = dice.pick((SQUARE, rounded(0.3), ngon(10)))
    reach = radius * 0.85
    blade = turned([prism(outline, (reach, wide, thick))], rotation((1, 0, 0), pitch))
    blade = moved(blade, (radius * 0.12 + reach / 2, 0, 0))
    hub = radius * dice.between(0.12, 0.2)
    return [*around(blade, count), cylinder(hub, hub, 14)]


def _cage(dice: Dice, radius: float, deep: float) -> Pieces:
    """Wires before and behind a propeller about z."""
    wire, count = radius * 0.012, dice.whole(8, 14)
    path = [(radius * 0.15, 0, deep / 2), (radius * 0.7, 0, deep / 2), (radius, 0, 0)]
    front = tube(path, wire, 4)
    return [
        torus(radius, wire * 1.6, 22),
        cylinder(radius * 0.2, wire * 2, 14) + [0, 0, deep / 2],
        *around([front, front * [1, 1, -1]], count),
    ]


def _fan(dice: Dice) -> list[Body]:
    if dice.chance(0.3):
        return _ceiling_fan(dice)
    if dice.chance(0.2):
        return _box_fan(dice)
    return _standing_fan(dice)


def _standing_fan(dice: Dice) -> list[Body]:
    """A head on a column or a bracket: it nods on a pin, swivels, or both."""
    kit, coat, metal = Assembly("base"), looks.plastic(dice), looks.metal(dice)
    radius = dice.between(0.08, 0.24)
    height = radius * dice.between(1.3, 5.0)
    if dice.chance(0.7):
        foot = loft(
            dice.pick((ngon(20), rounded(0.2))),
            [(0, 0, 0), (1.5 * radius, 1.5 * radius, 0), (1.4 * radius, 1.4 * radius, 0.03), (0, 0, 0.05)],
        )
        kit.fix([foot], coat)
    else:
        kit.fix(moved(star_base(dice, radius, radius * 0.3), (0, 0, radius * 0.3)), coat)
    post = max(0.012, radius * 0.08)
    kit.fix([rod((0, 0, 0.02), (0, 0, height), post, 10)], metal)
    top, parent = np.array([0, 0, height]), 0
    if dice.chance(0.5):
        neck = [cylinder(post * 1.6, post * 3, 12) + top + [0, 0, post * 1.5]]
        reach = dice.between(0.5, 1.2)
        parent = kit.add("neck", hinge(top, (0, 0, 1), reach, -reach), [(neck, coat)])
    pin = top + [0, 0, post * 3.2]
    motor = turned(
        [superquadric((post * 6, post * 6, post * 8), 0.6, rows=7)], rotation((1, 0, 0), np.pi / 2)
    )
    shape: Pieces = moved(motor, pin + [0, 0, post])
    deep = radius * dice.between(0.3, 0.5)
    center = pin + [0, -post * 4.5 - deep * 0.4, post]
    parts = [(shape, coat)]
    if dice.chance(0.8):
        parts.append((moved([pointed(p, Y) for p in _cage(dice, radius * 1.05, deep)], center), metal))
    motion = hinge(pin, (1, 0, 0), dice.between(0.2, 0.6), -dice.between(0.2, 0.8))
    head = kit.add("head", motion, parts, parent)
    rotor = [pointed(p, Y) for p in _blades(dice, radius)]
    shaft = rod(center + [0, post * 2, 0], center, post * 0.4, 8)
    kit.fix([shaft], metal, head)
    kit.add("blades", spin(center, (0, 1, 0)), [(moved(rotor, center), looks.plastic(dice))], head)
    _controls(dice, kit, radius * 0.7)
    return kit.done()


def _controls(dice: Dice, kit: Assembly, reach: float) -> None:
    """Buttons or a knob on the foot."""
    if dice.chance(0.5):
        return
    count, look = dice.whole(1, 4), looks.plastic(dice)
    for k in range(count):
        spot = ((k - (count - 1) / 2) * 0.028, -reach * 0.6, 0.042)
        kit.add("button", slide((0, 0, -1), 0.004), [(moved([box((0.02, 0.015, 0.016))], spot), look)])


def _box_fan(dice: Dice) -> list[Body]:
    """A fan in a frame, or in a ring on a stirrup that lets it tilt."""
    kit, coat = Assembly("stand"), looks.plastic(dice)
    radius = dice.between(0.1, 0.28)
    deep = radius * dice.between(0.3, 0.6)
    center = np.array([0, 0, 1.35 * radius])
    angle = np.linspace(0, np.pi, 15)
    bow = np.column_stack(
        [1.18 * radius * np.cos(angle), 0 * angle, 1.35 * radius - 1.28 * radius * np.sin(angle)]
    )
    kit.fix([tube(bow, radius * 0.04, 8)], looks.metal(dice))
    kit.fix(
        [box((radius * 0.1, 2 * deep, 0.02), (s * 0.5 * radius, 0, 0.012)) for s in (-1, 1)],
        looks.rubber(dice),
    )
    ring = revolve(
        [
            [radius, -deep / 2],
            [1.1 * radius, -deep / 2],
            [1.1 * radius, deep / 2],
            [radius, deep / 2],
            [radius, -deep / 2],
        ],
        22,
    )
    pins = [rod((s * 1.08 * radius, 0, 0), (s * 1.2 * radius, 0, 0), radius * 0.05, 8) for s in (-1, 1)]
    cage = moved([pointed(p, Y) for p in _cage(dice, radius, deep)], center)
    parts = [([pointed(ring, Y) + center, *moved(pins, center)], coat), (cage, looks.metal(dice))]
    head = kit.add("head", hinge(center, (1, 0, 0), 1.2, -1.2), parts)
    rotor = moved([pointed(p, Y) for p in _blades(dice, radius * 0.95)], center)
    kit.add("blades", spin(center, (0, 1, 0)), [(rotor, looks.plastic(dice))], head)
    return kit.done()


def _ceiling_fan(dice: Dice) -> list[Body]:
    """A rod from the ceiling, a motor that spins with its blades, lamps below."""
    kit, metal = Assembly("mount"), looks.metal(dice)
    radius, drop = dice.between(0.4, 0.75), dice.between(0.12, 0.5)
    kit.fix(
        [cylinder(0.07, 0.05, 16) + [0, 0, drop + 0.1], rod((0, 0, 0.05), (0, 0, drop + 0.1), 0.012, 8)],
        metal,
    )
    count, wide = dice.whole(3, 6), dice.between(0.1, 0.16)
    outline = dice.pick((SQUARE, rounded(0.2), rounded(0.4)))
    board = turned([prism(outline, (radius * 0.75, wide, 0.008))], rotation((1, 0, 0), 0.2))
    arm = box((radius * 0.25, 0.03, 0.01), (radius * 0.2, 0, 0))
    motor = revolve([[0, -0.06], [0.09, -0.05], [0.12, 0], [0.09, 0.05], [0, 0.06]], 18)
    blades = around(moved(board, (radius * 0.62, 0, 0)), count)
    parts = [([motor, *around([arm], count)], metal), (blades, looks.wood(dice))]
    kit.add("blades", spin((0, 0, 0), (0, 0, 1)), parts)
    if dice.chance(0.6):
        lamp = revolve([[0.05, -0.07], [0.13, -0.1], [0.1, -0.16], [0, -0.18]], 18)
        kit.fix([cylinder(0.05, 0.02, 14) - [0, 0, 0.075]], metal)
        kit.fix([lamp], looks.glass(dice))
    if dice.chance(0.4):
        chain = [
            rod((0.05, 0, -0.09), (0.05, 0, -0.3), 0.002, 4),
            superquadric((0.015, 0.015, 0.025), rows=5) + [0.05, 0, -0.31],
        ]
        kit.add("chain", slide((0, 0, -1), 0.02), [(chain, metal)])
    return kit.done()


def _shade(dice: Dice, radius: float) -> Pieces:
    """A cone, bell, drum or box about z that opens to -z, its neck at 0."""
    high = radius * dice.between(0.8, 1.8)
    neck = radius * dice.between(0.25, 0.9)
    outline = ngon(20) if dice.chance(0.8) else rounded(0.15)
    wall = radius * 0.03
    belly = dice.between(0.0, 1.0)
    middle = neck + (radius - neck) * (0.5 + 0.3 * belly)
    skin = [
        (0, 0),
        (neck, 0),
        (middle, -high / 2),
        (radius, -high),
        (radius - wall, -high),
        (middle - wall, -high / 2),
        (neck - wall, -wall),
        (0, -wall),
    ]
    bulb = superquadric((neck * 1.0, neck * 1.0, high * 0.5), rows=7) - [0, 0, high * 0.45]
    return [loft(outline, [(2 * max(r, 0), 2 * max(r, 0), z) for r, z in skin]), bulb]


def _desk_lamp(dice: Dice) -> list[Body]:
    """A foot or a clamp, one to three arms, and a head; a joint at every elbow."""
    kit, coat, metal = Assembly("base"), looks.painted_metal(dice), looks.metal(dice)
    wide = dice.between(0.06, 0.11)
    kit.fix([prism(dice.pick((ngon(20), SQUARE, rounded(0.2))), (2 * wide, 2 * wide, 0.025))], coat)
    place = np.array([0, 0.3 * wide, 0.0125])
    post = [cylinder(0.015, 0.04, 12) + place + [0, 0, 0.021]]
    reach = dice.between(1.0, 3.1)
    parent = kit.add("post", hinge(place, (0, 0, 1), reach, -reach), [(post, metal)])
    place = place + [0, 0, 0.045]
    count, lean = dice.whole(1, 3), dice.between(-0.5, 0.2)
    twin, thick = dice.chance(0.4), dice.between(0.004, 0.009)
    for _ in range(count):
        long = dice.between(0.12, 0.35)
        end = place + long * np.array([0, np.sin(-lean), np.cos(lean)])
        arm = _arm(place, end, thick, twin)
        up, down = dice.between(0.5, 1.3), dice.between(0.4, 1.0)
        parent = kit.add("arm", hinge(place, (1, 0, 0), up, -down), [(arm, metal)], parent)
        place, lean = end, lean + dice.between(0.6, 1.6)
    radius = dice.between(0.04, 0.09)
    if dice.chance(0.75):
        shade = _shade(dice, radius)
    else:
        shade = [
            box((radius * 1.2, radius * 4, 0.02), (0, -radius * 1.5, -0.01)),
            box((radius, radius * 3.6, 0.004), (0, -radius * 1.5, -0.022)),
        ]
    tilt = rotation((1, 0, 0), dice.between(-0.7, 0.3))
    head = moved(turned([*shade, cylinder(0.012, 0.03, 10)], tilt), place - [0, 0, 0.02])
    motion = hinge(place, (1, 0, 0), dice.between(0.4, 1.2), -dice.between(0.4, 1.2))
    kit.add("head", motion, [(head, coat)], parent)
    if dice.chance(0.5):
        spot = (0, -0.6 * wide, 0.0125)
        button = [cylinder(0.01, 0.012, 12) + spot + [0, 0, 0.006]]
        kit.add("switch", slide((0, 0, -1), 0.004), [(button, looks.plastic(dice))])
    return kit.done()


def _arm(start: FloatArray, end: FloatArray, thick: float, twin: bool) -> Pieces:
    """One rod or two beside each other, with a pin along x at its start."""
    pin = pointed(cylinder(thick * 1.8, 0.03, 10), X) + start
    if not twin:
        return [rod(start, end, thick, 8), pin]
    return [pin, *(rod(start + [s, 0, 0], end + [s, 0, 0], thick * 0.6, 6) for s in (-0.01, 0.01))]


def _floor_lamp(dice: Dice) -> list[Body]:
    """A tall stand with a shade that tilts, an arm that swings, or heads on goosenecks."""
    kit, metal = Assembly("stand"), looks.metal(dice)
    height, foot = dice.between(1.1, 1.8), dice.between(0.12, 0.2)
    if dice.chance(0.7):
        kit.fix([cylinder(foot, 0.025, 20) + [0, 0, 0.0125]], metal)
        kit.fix([rod((0, 0, 0.02), (0, 0, height), 0.012, 10)], metal)
    else:
        legs = around([rod((0, 0, height * 0.8), (foot * 2, 0, 0), 0.014, 6)], 3, dice.between(0, 2))
        kit.fix([*legs, rod((0, 0, height * 0.78), (0, 0, height), 0.012, 8)], looks.wood(dice))
    shade = looks.fabric(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    style = dice.unit()
    if style < 0.4:
        radius = dice.between(0.12, 0.25)
        pin = np.array([0, 0, height])
        shape = moved(_shade(dice, radius), pin + [0, 0, radius * 0.8])
        shape.append(rod(pin, pin + [0, 0, radius * 0.8], 0.008, 6))
        kit.add("shade", hinge(pin, (1, 0, 0), 0.5, -0.5), [(shape, shade)])
    elif style < 0.7:
        _swing_arm(dice, kit, height, metal, shade)
    else:
        for k in range(dice.whole(1, 3)):
            level = height - 0.03 - 0.25 * k
            turn = rotation((0, 0, 1), dice.between(0, 6.28))
            unit = Assembly()
            reach = dice.between(0.1, 0.3)
            unit.fix([rod((0, 0, 0), (0, -reach, 0.05), 0.008, 8)], metal)
            head = moved(turned(_shade(dice, 0.07), rotation((1, 0, 0), -0.4)), (0, -reach, 0.05))
            unit.add("head", hinge((0, -reach, 0.05), (1, 0, 0), 0.9, -0.9), [(head, shade)])
            kit.graft(unit, (0, 0, level), turn)
    if dice.chance(0.4):
        pull = [
            rod((0.03, 0, 0), (0.03, 0, -0.12), 0.0015, 4),
            superquadric((0.012, 0.012, 0.02), rows=5) + [0.03, 0, -0.125],
        ]
        kit.fix([rod((0, 0, height * 0.9), (0.032, 0, height * 0.9), 0.004)], metal)
        kit.add("chain", slide((0, 0, -1), 0.02), [(moved(pull, (0, 0, height * 0.9)), metal)])
    return kit.done()


def _swing_arm(dice: Dice, kit: Assembly, height: float, metal: Look, shade: Look) -> None:
    reach = dice.between(0.3, 0.7)
    pin = np.array([0, 0, height])
    arm = [
        cylinder(0.018, 0.04, 12) + pin + [0, 0, 0.021],
        rod(pin + [0, 0, 0.03], pin + [0, -reach, 0.05], 0.009, 8),
    ]
    way = dice.between(0.8, 3.1)
    number = kit.add("arm", hinge(pin, (0, 0, 1), way, -way), [(arm, metal)])
    end = pin + [0, -reach, 0.045]
    head = moved(_shade(dice, dice.between(0.07, 0.14)), end)
    kit.add("shade", hinge(end, (1, 0, 0), 0.7, -0.7), [(head, shade)], number)


CATEGORIES: tuple[Category, ...] = (
    Category("fan", _fan),
    Category("desk_lamp", _desk_lamp),
    Category("floor_lamp", _floor_lamp),
)
