"""Taps and valves."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, prism, revolve, rod, superquadric, torus, tube, vessel
from . import looks
from .assembling import Assembly, disc
from .category import Category
from .objects import Body, Look, Motion, hinge, slide, spin


def _tap(dice: Dice) -> list[Body]:
    metal = looks.metal(dice)
    kit = Assembly("base")
    on_wall = dice.chance(0.33)
    mounted = dice.weighted([(2, _wall_tap), (1, _pillar)])
    make = mounted if on_wall else dice.pick((_one_lever, _two_handles))
    make(dice, kit, metal)
    if not on_wall:
        _below(dice, kit)
    return kit.done()


def _below(dice: Dice, kit: Assembly) -> None:
    """What a tap stands on: a piece of worktop, a basin behind, or nothing."""
    if dice.chance(0.6):
        return
    wide, deep = dice.between(0.2, 0.5), dice.between(0.15, 0.4)
    look = looks.ceramic(dice)
    if dice.chance(0.5):
        kit.fix([box((wide, 0.14, 0.02), (0, 0, -0.01))], look)
        return
    bowl = vessel(dice.pick((ngon(20), rounded(0.2), SQUARE)), (wide * 0.7, deep * 0.7, 0.14), 0.012, 1.35)
    kit.fix([bowl + [0, -0.5 * deep - 0.02, -0.14]], look)
    kit.fix([box((wide, 0.12, 0.03), (0, 0.02, -0.015))], look)


def _spout(dice: Dice, reach: float, height: float, radius: float) -> FloatArray:
    """A centre line from 0 up and over to -y."""
    style = dice.unit()
    if style < 0.5:
        bend = np.linspace(0, np.pi * dice.between(0.8, 1.0), 9)
        arch = np.column_stack([0 * bend, reach / 2 * (np.cos(bend) - 1), height + reach / 2 * np.sin(bend)])
        return np.vstack([[0, 0, 0], arch, arch[-1] - [0, 0, dice.between(0.1, 0.4) * height]])
    if style < 0.8:
        rise = dice.between(-0.2, 0.4) * height
        end = [0, -reach, height + rise]
        return np.array(
            [[0, 0, 0], [0, 0, 0.98 * height], [0, -radius, height], end, end - np.array([0, 0, 2 * radius])]
        )
    return np.array(
        [
            [0, 0, 0],
            [0, 0, height],
            [0, -0.01, height + 0.01],
            [0, -reach, height + 0.01],
            [0, -reach, 0.7 * height],
        ]
    )


def _one_lever(dice: Dice, kit: Assembly, metal: Look) -> None:
    """A mixer with one lever, on top or at a side."""
    height, reach = dice.between(0.07, 0.3), dice.between(0.1, 0.24)
    radius = dice.between(0.009, 0.016)
    body = radius * dice.between(1.3, 2.2)
    kit.fix([cylinder(body * 1.25, 0.012, 18) + [0, 0, 0.006]], metal)
    on_top = height < 0.16 and dice.chance(0.7)
    kit.fix(
        [cylinder(body, height if on_top else 0.6 * height, 16) + [0, 0, height * (0.5 if on_top else 0.3)]],
        metal,
    )
    if on_top:
        level = height * dice.between(0.55, 0.8)
        end = (0, -reach, level + dice.between(-0.02, 0.05))
        kit.fix(
            [tube(np.array([(0, 0, level), end, (0, end[1] - 0.002, end[2] - 2 * radius)]), radius, 10)],
            metal,
        )
        _top_lever(dice, kit, height, body, reach * dice.between(0.5, 1.0), metal)
        return
    line = _spout(dice, reach, height, radius)
    line[0, 2] = 0.6 * height
    motion = _both_ways(dice.between(0.7, 2.0), (0, 0, 0), (0, 0, 1))
    spout = kit.add("spout", motion, [([tube(line, radius, 10)], metal)])
    if dice.chance(0.35):
        _pull_out(dice, kit, line, radius, metal, spout)
    _side_lever(dice, kit, body, height * dice.between(0.3, 0.5), metal)


def _both_ways(reach: float, origin: ArrayLike, axis: ArrayLike) -> Motion:
    return hinge(origin, axis, reach, -reach)


def _pull_out(dice: Dice, kit: Assembly, line: FloatArray, radius: float, metal: Look, parent: int) -> None:
    """A spray head that is drawn off the end of the spout."""
    along = line[-1] - line[-2]
    along = along / np.linalg.norm(along)
    tip = line[-1] + along * 0.002
    long = dice.between(0.03, 0.08)
    head = tube([tip, tip + along * long * 0.6, tip + along * long], radius * np.array([1.1, 1.2, 1.5]), 12)
    look = looks.darker(metal, 0.5) if dice.chance(0.5) else metal
    kit.add("spray head", slide(along, dice.between(0.1, 0.3)), [([head], look)], parent)


def _top_lever(dice: Dice, kit: Assembly, height: float, body: float, reach: float, metal: Look) -> None:
    """A lever on top: it turns with its cap, tilts about a pin, or does both in a chain, on a ring."""
    cap: Pieces = [cylinder(body * 0.98, body * 0.5, 16) + [0, 0, height + 0.25 * body + 0.001]]
    top = height + 0.5 * body
    end = (0, -reach, top + reach * dice.between(0.0, 0.4))
    arm: Pieces = [rod((0, 0, top), end, body * dice.between(0.2, 0.35), 8)]
    if dice.chance(0.4):
        arm = [box((body * 0.9, reach, body * 0.25), (0, -reach / 2, top + body * 0.15))]
    tilt = dice.between(0.3, 0.6)
    pin = (0.0, 0.0, top - 0.1 * body)
    style = dice.unit()
    bolt = pointed(cylinder(body * 0.15, 2.2 * body, 8), X) + pin
    if style < 0.35:
        kit.add("lever", hinge(pin, (-1, 0, 0), tilt), [([*cap, *arm, bolt], metal)])
    elif style < 0.65:
        kit.add("lever", _both_ways(dice.between(0.6, 1.2), pin, (0, 0, 1)), [(cap + arm, metal)])
    else:
        cap.append(cylinder(body * 1.15, body * 0.15, 16) + [0, 0, height + 0.1 * body])
        turn = kit.add("cap", _both_ways(dice.between(0.6, 1.2), pin, (0, 0, 1)), [(cap, metal)])
        kit.add("lever", hinge(pin, (-1, 0, 0), tilt), [([*arm, bolt], metal)], turn)


def _side_lever(dice: Dice, kit: Assembly, body: float, level: float, metal: Look) -> None:
    """A lever on a stub at the right or the left, which turns about the stub."""
    side = dice.sign()
    stub = dice.between(0.5, 1.5) * body
    start = side * (body * 0.8)
    kit.fix([rod((start, 0, level), (start + side * stub, 0, level), body * 0.6, 12)], metal)
    at_x = start + side * (stub + 0.001)
    grip: Pieces = [rod((at_x, 0, level), (at_x + side * body * 0.5, 0, level), body * 0.65, 12)]
    long = dice.between(0.05, 0.12)
    lean = rotation((1, 0, 0), dice.between(-0.6, 1.2))
    arm = rod(
        (at_x + side * body * 0.3, 0, level),
        (at_x + side * body * dice.between(0.3, 1.5), 0, level + long),
        body * 0.22,
        8,
    )
    grip += turned([arm], lean, (at_x, 0, level))
    kit.add("lever", hinge((at_x, 0, level), (1, 0, 0), dice.between(0.7, 1.5)), [(grip, metal)])


def _cross(dice: Dice, radius: float) -> Pieces:
    """A handle on a stem from z = 0 up: arms, a lobed or a plain knob, or a lever."""
    stem: Pieces = [cylinder(radius * 0.45, radius * 0.8, 12) + [0, 0, 0.4 * radius]]
    style, top = dice.unit(), 0.8 * radius
    if style < 0.5:
        arm = rod((0, 0, top), (radius * dice.between(1.0, 1.8), 0, top), radius * 0.22, 8)
        return [*stem, *around([arm], dice.pick((2, 3, 4, 4, 5)), dice.between(0, 3))]
    if style < 0.75:
        lobes = around([cylinder(radius * 0.4, radius * 0.7, 8) + [radius * 0.7, 0, top]], dice.whole(3, 6))
        return [*stem, *lobes, cylinder(radius * 0.75, radius * 0.7, 14) + [0, 0, top]]
    reach = radius * dice.between(2.0, 4.0)
    arm = rod((0, 0, top), (reach, 0, top + reach * dice.between(0, 0.3)), radius * 0.25, 8)
    return [*stem, arm, superquadric((radius, radius, radius), rows=6) + [0, 0, top]]


def _two_handles(dice: Dice, kit: Assembly, metal: Look) -> None:
    """A handle at either side of a spout, on a bridge, a plate, or each on its own."""
    gap, radius = dice.between(0.05, 0.12), dice.between(0.008, 0.014)
    height, reach = dice.between(0.05, 0.28), dice.between(0.09, 0.2)
    line = _spout(dice, reach, height, radius)
    pipe = ([tube(line, radius, 10)], metal)
    base = radius * dice.between(1.4, 2.2)
    kit.fix([cylinder(base, 0.02, 16) + [0, 0, 0.01]], metal)
    kit.add("spout", _both_ways(dice.between(0.6, 1.6), (0, 0, 0), (0, 0, 1)), [pipe])
    if dice.chance(0.5):
        kit.fix([rod((-gap, 0, base), (gap, 0, base), base * 0.5, 10)], metal)
    else:
        kit.fix(
            [prism(rounded(0.5, 2 * gap / (3 * base)), (2 * gap + 3 * base, 3 * base, 0.01)) + [0, 0, 0.005]],
            metal,
        )
    rise = dice.between(0.02, 0.05)
    seed, grip = dice.whole(0, 2**31), metal if dice.chance(0.7) else looks.ceramic(dice)
    lean = dice.between(0.2, 0.8) if dice.chance(0.3) else 0.0
    upper = dice.pick((1.57, 1.57, 3.14, 6.28))
    for side in (-1, 1):
        kit.fix([cylinder(base * 0.9, rise, 14) + [side * gap, 0, rise / 2]], metal)
        turn = rotation((0, 1, 0), side * lean)
        foot = np.array([side * gap, 0, rise + 0.001])
        shape = moved(turned(_cross(Dice(seed), base * 1.1), turn), foot)
        axis = turn @ [0, 0, 1]
        kit.add(
            "handle",
            hinge(foot, side * axis, upper),
            [(shape, grip)],
            name="left_handle" if side < 0 else "right_handle",
        )
    if dice.chance(0.3):
        pin = [
            rod((0, base * 1.3, 0), (0, base * 1.3, 0.06), 0.003),
            cylinder(0.006, 0.012, 8) + [0, base * 1.3, 0.06],
        ]
        kit.add("rod", slide((0, 0, 1), 0.03), [(pin, metal)])


def _wall_tap(dice: Dice, kit: Assembly, metal: Look) -> None:
    """A mixer before a wall: a level body, handles at its ends or before it, a spout below."""
    wide, radius = dice.between(0.1, 0.28), dice.between(0.018, 0.03)
    off = dice.between(0.04, 0.08)
    kit.fix([rod((-wide / 2, -off, 0), (wide / 2, -off, 0), radius, 14)], metal)
    for x in (-0.3 * wide, 0.3 * wide):
        kit.fix([rod((x, -off, 0), (x, 0, 0), radius * 0.6, 10)], metal)
        kit.fix(moved([disc(radius * 1.3, 0.01, 16)], (x, 0, 0)), metal)
    if dice.chance(0.5):
        kit.fix([box((wide * 1.6, 0.01, 0.2), (0, 0.005, 0))], looks.ceramic(dice))
    reach, thin = dice.between(0.06, 0.22), radius * 0.55
    path = [
        (0, -off, -radius * 0.5),
        (0, -off, -radius - 0.02),
        (0, -off - 0.02, -radius - 0.035),
        (0, -off - reach, -radius - 0.03),
        (0, -off - reach, -radius - 0.06),
    ]
    aside = _both_ways(dice.between(0.5, 1.5), (0, -off, 0), (0, 0, 1))
    kit.add("spout", aside, [([tube(path, thin, 10)], metal)])
    seed = dice.whole(0, 2**31)
    if dice.chance(0.6):
        for side in (-1, 1):
            turn = rotation((0, 1, 0), side * np.pi / 2)
            spot = np.array([side * (wide / 2 + 0.001), -off, 0])
            shape = moved(turned(_cross(Dice(seed), radius), turn), spot)
            motion = hinge(spot, (side, 0, 0), dice.pick((1.57, 3.14)))
            kit.add("handle", motion, [(shape, metal)], name="left_handle" if side < 0 else "right_handle")
        return
    spot = np.array([0, -off - radius * 0.9, 0])
    shape = moved(turned(_cross(Dice(seed), radius), rotation((1, 0, 0), np.pi / 2)), spot)
    kit.add("handle", hinge(spot, (0, -1, 0), dice.pick((1.57, 3.14))), [(shape, metal)])


def _pillar(dice: Dice, kit: Assembly, metal: Look) -> None:
    """A tap of a garden or a barrel: a handle on top of a pipe that turns down."""
    radius = dice.between(0.01, 0.018)
    reach = dice.between(0.05, 0.1)
    kit.fix(
        [
            tube(
                [
                    (0, 0.06, 0),
                    (0, 0, 0),
                    (0, -reach, 0),
                    (0, -reach - radius, -radius),
                    (0, -reach - radius, -0.05),
                ],
                radius,
                10,
            )
        ],
        metal,
    )
    kit.fix(moved([disc(radius * 2, 0.01, 12)], (0, 0.06, 0)), metal)
    high = dice.between(0.02, 0.05)
    lean = rotation((1, 0, 0), dice.between(0, 0.7) if dice.chance(0.5) else 0.0)
    kit.fix(turned([cylinder(radius * 1.1, high, 12) + [0, 0, high / 2]], lean), metal)
    foot = lean @ [0, 0, high + 0.001]
    grip = moved(turned(_cross(dice, radius * 1.3), lean), foot)
    look = metal if dice.chance(0.5) else looks.plastic(dice)
    kit.add("handle", hinge(foot, lean @ [0, 0, 1], dice.pick((1.57, 3.14, 6.28))), [(grip, look)])


def _wheel(dice: Dice, radius: float) -> Pieces:
    """A hand wheel about z."""
    thick = radius * dice.between(0.06, 0.14)
    spoke = rod((0, 0, -thick * dice.between(0, 2)), (radius, 0, 0), thick * 0.7, 6)
    hub = cylinder(radius * dice.between(0.15, 0.3), thick * 4, 12)
    pieces = [
        torus(radius, thick, 20),
        hub,
        *around([spoke], dice.pick((1, 2, 3, 4, 5, 6)), dice.between(0, 3)),
    ]
    if dice.chance(0.15):
        pieces.append(cylinder(thick, 6 * thick, 8) + [radius, 0, 3 * thick])
    return pieces


def _lever_arm(dice: Dice, reach: float, radius: float) -> Pieces:
    """A flat lever along x from the stem, its end cranked up, some with a second wing."""
    rise = radius * dice.between(0, 1.5)
    path = [(0, 0, 0), (0.2 * reach, 0, 0), (0.35 * reach, 0, rise), (reach, 0, rise)]
    pieces = [
        tube(path, radius * 0.35, 8) * [1, dice.between(0.8, 1.6), 1],
        cylinder(radius * 0.6, radius * 0.5, 12),
    ]
    if dice.chance(0.25):
        pieces.append(tube(np.array(path) * [-1, 1, 1], radius * 0.35, 8))
    return pieces


def _valve_unit(dice: Dice, kit: Assembly, pipe: float, wheel: bool, metal: Look, look: Look) -> None:
    """A bonnet on a pipe along x, and what turns on it."""
    body = pipe * dice.between(1.3, 1.8)
    shape = superquadric((2.2 * body, 2 * body, 2 * body), 0.7, 0.7, 7)
    if dice.chance(0.4):
        shape = pointed(cylinder(body, 2.4 * body, dice.pick((6, 8, 16))), X)
    high = body * dice.between(1.4, 2.4)
    kit.fix([shape, cylinder(pipe * 0.6, high, 10) + [0, 0, high / 2]], metal)
    if wheel:
        radius = pipe * dice.between(1.6, 3.5)
        shape_ = moved(_wheel(dice, radius), (0, 0, high + 0.1 * radius))
        kit.fix([cylinder(pipe * 0.25, 0.3 * radius, 8) + [0, 0, high]], metal)
        kit.add("wheel", spin((0, 0, high), (0, 0, 1)), [(shape_, look)])
        return
    arm = _lever_arm(dice, pipe * dice.between(2.5, 6), pipe)
    turn = rotation((0, 0, 1), dice.pick((0, np.pi)))
    shaped = moved(turned(arm, turn), (0, 0, high + 0.2 * pipe))
    sense = dice.sign()
    kit.add("lever", hinge((0, 0, high), (0, 0, sense), dice.between(1.4, 1.6)), [(shaped, look)])


def _flanges(dice: Dice, long: float, pipe: float) -> Pieces:
    """A pipe along x with flanges or nuts at its ends."""
    sides = dice.pick((6, 8, 16, 20))
    ring = pointed(cylinder(pipe * dice.between(1.2, 1.9), pipe * dice.between(0.3, 0.9), sides), X)
    spots = [-long / 2, long / 2] if dice.chance(0.6) else [-0.3 * long, 0.3 * long]
    return [rod((-long / 2, 0, 0), (long / 2, 0, 0), pipe, 14), *(ring + [x, 0, 0] for x in spots)]


def _valve(dice: Dice) -> list[Body]:
    metal = looks.painted_metal(dice) if dice.chance(0.5) else looks.metal(dice)
    look = Look("steel", (180, 40, 35)) if dice.chance(0.5) else looks.painted_metal(dice)
    pipe = dice.spread(0.008, 0.05)
    kit = Assembly("pipe")
    count = dice.weighted([(5, 1), (2, 2), (1, 3), (1, 4)])
    step = pipe * dice.between(6, 9)
    long = step * count + pipe * dice.between(1, 6)
    kit.fix(_flanges(dice, long, pipe), metal)
    wheel, seed = dice.chance(0.55), dice.whole(0, 2**31)
    for k in range(count):
        unit, own = Assembly(), Dice(seed if dice.chance(0.8) else seed + k)
        _valve_unit(own, unit, pipe, wheel, metal, look)
        kit.graft(unit, ((k - (count - 1) / 2) * step, 0, 0))
    if dice.chance(0.3):
        gauge = [
            cylinder(pipe * 0.3, 2 * pipe, 8) + [0, 0, pipe],
            pointed(cylinder(pipe * 1.2, pipe, 16), Y) + [0, 0, 3 * pipe],
        ]
        kit.fix(moved(gauge, (long / 2 - pipe, 0, 0)), metal)
    if dice.chance(0.3):
        kit.fix(
            [
                revolve(
                    [
                        [0.0, 0.0],
                        [pipe, 0],
                        [pipe, -3 * pipe],
                        [1.6 * pipe, -3 * pipe],
                        [1.6 * pipe, -3.5 * pipe],
                        [0, -3.5 * pipe],
                    ],
                    14,
                )
            ],
            metal,
        )
    ways = [
        np.eye(3),
        rotation((0, 0, 1), np.pi / 2),
        rotation((0, 1, 0), np.pi / 2) @ rotation((1, 0, 0), np.pi / 2),
        rotation((1, 0, 0), np.pi / 2),
        rotation((1, 0, 0), dice.between(0, 1.5)),
    ]
    return kit.done(dice.pick(ways))


CATEGORIES: tuple[Category, ...] = (Category("tap", _tap), Category("valve", _valve))
