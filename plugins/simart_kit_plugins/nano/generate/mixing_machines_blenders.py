"""Blenders with a jug, a cup or a stick, and food processors."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import around, at, moved, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, loft, prism, revolve, vessel
from . import looks
from .assembling import Assembly, dial, turning
from .mixing_machines_parts import (
    DARK,
    LEFT,
    ON_TOP,
    UP,
    clamp_levers,
    cup,
    cutter,
    ear,
    grip,
    keys,
    panel,
    ring,
)
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import lying


def blender(dice: Dice) -> list[Body]:
    """A jug on a base, a food processor, a stick or a cup blender."""
    style = dice.unit()
    if style < 0.5:
        return _jug_blender(dice)
    if style < 0.8:
        return _food_processor(dice)
    return _stick_blender(dice) if style < 0.9 else _cup_blender(dice)


def _motor_base(dice: Dice, kit: Assembly, wide: float, top: float, high: float) -> None:
    """A base that narrows upwards, on feet, with controls before it."""
    coat, outline = looks.plastic(dice), dice.pick((rounded(0.2), rounded(0.42), ngon(26)))
    if dice.chance(0.5):
        coat = looks.painted_metal(dice)
    belly = dice.between(top, wide)
    stages = [(0, 0, 0), (wide, wide, 0), (wide, wide, 0.2 * high), (belly, belly, 0.7 * high)]
    kit.fix([loft(outline, [*stages, (top, top, high), (0, 0, high)])], coat)
    spots = [(x * 0.3 * wide, y * 0.3 * wide, -0.003) for x in (-1, 1) for y in (-1, 1)]
    kit.fix(at(cylinder(0.012, 0.008, 12), spots), looks.rubber(dice))
    tall, front = min(0.55 * high, 0.09), wide / 2 + 0.004
    kit.fix([box((0.62 * wide, 0.5 * front, tall), (0, -0.75 * front, 0.45 * high))], coat)
    kit.graft(panel(dice, 0.56 * wide, 0.9 * tall), (0, -front, 0.45 * high))


def _jug_blender(dice: Dice) -> list[Body]:
    """A base with a coupling, a jug with a blade and a handle, its lid and the cap in it."""
    kit, dark = Assembly("base"), looks.plastic(dice)
    low, tall, wall = dice.between(0.045, 0.06), dice.between(0.15, 0.24), 0.003
    flare, high = dice.between(1.05, 1.45), dice.between(0.09, 0.18)
    wide = dice.between(0.15, 0.21)
    _motor_base(dice, kit, wide, max(2 * low + 0.024, 0.75 * wide), high)
    kit.fix([ring(low + 0.0015, low + 0.01, high - 0.002, high + 0.014)], dark)
    kit.fix([cylinder(0.016, 0.016, 12) + [0, 0, high + 0.006]], DARK)
    start = high + 0.0015
    foot = ring(low - 0.012, low, start, start + 0.034)
    outline = ngon(28) if dice.chance(0.6) else rounded(dice.between(0.2, 0.4))
    floor = start + 0.03
    body = vessel(outline, (2 * low, 2 * low, tall), wall, flare) + [0, 0, floor]
    clear = looks.glass(dice)
    bow: Pieces = []
    if dice.chance(0.8):
        bow = moved(
            ear(low * (1 + 0.25 * (flare - 1)), 0.2 * tall, 0.9 * tall, 0.03 + low * (flare - 1), 0.008),
            (0, 0, floor),
        )
        bow = turned(bow, rotation(UP, dice.pick((0.0, np.pi, np.pi / 2, 0.5))))
    jug = kit.add("jug", free(), [([body], clear), ([foot, *bow], dark)])
    spot = (0, 0, floor + wall + 0.001)
    kit.add("blade", spin(spot, UP), [(moved(cutter(dice, 0.75 * low), spot), looks.metal(dice))], jug)
    _jug_lid(dice, kit, jug, outline, (low * flare, floor + tall, wall))
    return kit.done()


def _jug_lid(
    dice: Dice, kit: Assembly, jug: int, outline: FloatArray, size: tuple[float, float, float]
) -> None:
    """A lid with a plug in the jug's mouth of this radius, level and wall; most have a cap in the middle."""
    mouth, level, wall = size
    look, thick, gap = looks.plastic(dice), dice.between(0.012, 0.022), 0.001
    plug = 2 * (mouth - wall - 0.004)
    parts = [prism(outline, (2.04 * mouth, 2.04 * mouth, thick)) + [0, 0, level + gap + thick / 2]]
    parts.append(prism(outline, (plug, plug, 0.014)) + [0, 0, level + gap - 0.006])
    if dice.chance(0.4):
        parts.append(box((0.03, 0.02, 0.6 * thick), (0, -mouth - 0.006, level + thick / 2)))
    top = level + gap + thick
    pin = (0, 1.02 * mouth + 0.004, level + gap)
    tips = len(outline) < 20 and dice.chance(0.4)
    if tips:
        kit.fix(
            [lying(0.004, 0.03) + pin, box((0.026, 0.012, 0.01), (0, pin[1] - 0.004, level - 0.007))],
            look,
            jug,
        )
    motion = hinge(pin, LEFT, dice.between(1.4, 2.0)) if tips else free()
    radius = min(0.45 * mouth, dice.between(0.018, 0.028))
    capped = dice.chance(0.75)
    if capped:
        parts.append(ring(radius + 0.0012, radius + 0.006, top - 0.002, top + 0.009))
    else:
        parts += moved(grip(dice, 0.3 * mouth, 0.03), (0, 0, top - 0.001))
    lid = kit.add("lid", motion, [(parts, look)], jug)
    if capped:
        cap = [
            cylinder(radius, 0.022, 20) + [0, 0, top + 0.0115],
            cylinder(radius + 0.004, 0.005, 20) + [0, 0, top + 0.025],
        ]
        cap += [box((1.6 * radius, 0.005, 0.01), (0, 0, top + 0.031))] if dice.chance(0.5) else []
        kit.add("cap", free(), [(cap, looks.plastic(dice))], lid)


def _food_processor(dice: Dice) -> list[Body]:
    """A bowl with a blade, a lid with a chute and its pusher, held by levers; some sit beside the motor."""
    kit, dark, clear = Assembly("base"), looks.plastic(dice), looks.glass(dice)
    radius, tall, high = dice.between(0.075, 0.1), dice.between(0.09, 0.14), dice.between(0.08, 0.14)
    _motor_base(dice, kit, 2 * radius + dice.between(0.03, 0.07), 2 * radius + 0.02, high)
    floor = high + 0.0015
    shape = [cup([(0.92 * radius, 0), (radius, 0.02), (radius, tall)], 0.003, 30) + [0, 0, floor]]
    bow = []
    if dice.chance(0.7):
        bow = moved(ear(radius, 0.2 * tall, 0.85 * tall, 0.045, 0.008), (0, 0, floor))
        bow = turned(bow, rotation(UP, dice.pick((np.pi / 2, -np.pi / 2, 1.1))))
    bowl = kit.add("bowl", free(), [(shape, clear), (bow, dark)])
    spot, metal = (0, 0, floor + 0.004), looks.metal(dice)
    if dice.chance(0.65):
        post = [revolve([(0, 0), (0.02, 0), (0.014, 0.7 * tall), (0, 0.7 * tall)], 16)]
        blades = moved(cutter(dice, 0.85 * radius), (0, 0, 0.006))
        blades += moved(turned(cutter(dice, 0.8 * radius), rotation(UP, 0.8)), (0, 0, 0.3 * tall))
        parts = [(moved(post, spot), dark), (moved(blades, spot), metal)]
    else:
        post = [cylinder(0.012, 0.75 * tall, 14) + [0, 0, 0.375 * tall]]
        plate = [
            cylinder(0.93 * radius, 0.002, 28),
            *around([box((0.6 * radius, 0.008, 0.006), (0.55 * radius, 0, 0.003))], 2),
        ]
        parts = [(moved(post, spot), dark), (moved(plate, np.array(spot) + [0, 0, 0.75 * tall]), metal)]
    kit.add("blade", spin(spot, UP), parts, bowl)
    _chute_lid(dice, kit, bowl, radius, floor + tall + 0.001, clear)
    if dice.chance(0.6):
        clamp_levers(kit, radius, high, floor + tall + 0.001, dark, dice.between(1.0, 1.9))
    return kit.done()


def _chute_lid(dice: Dice, kit: Assembly, bowl: int, radius: float, level: float, look: Look) -> None:
    """A flat or vaulted lid with a chute off its middle, and the pusher that slides in it."""
    hole, wall, long = radius * dice.between(0.25, 0.4), 0.003, dice.between(0.05, 0.1)
    off = rotation(UP, dice.pick((0.0, 1.57, 3.14, 2.3))) @ [
        min(0.5 * radius, 0.9 * radius - hole - wall),
        0,
        0,
    ]
    top = level + dice.between(0.006, 0.02)
    lid = [
        revolve(
            [
                (0, level),
                (1.02 * radius, level),
                (1.02 * radius, level + 0.005),
                (0.93 * radius, top),
                (0, top),
            ],
            30,
        )
    ]
    lid.append(ring(hole, hole + wall, top - 0.001, top + long, 22) + off)
    cover = kit.add("lid", free(), [(lid, look)], bowl)
    raised = dice.pick((0.0, 0.0, 0.3, 0.6)) * long
    push = cylinder(hole - 0.0012, long, 20) + [0, 0, top + 0.0015 + long / 2 + raised]
    head = cylinder(hole + wall + dice.between(0.0, 0.006), 0.008, 20) + [0, 0, top + long + 0.0055 + raised]
    stroke = dice.between(0.7, 0.95) * long - raised
    pusher = kit.add(
        "plunger",
        slide(UP, max(stroke, 0.01), -raised),
        [(moved([push, head], off), looks.plastic(dice))],
        cover,
    )
    if hole > 0.026 and dice.chance(0.35):
        spot = off + [0, 0, top + long + 0.01 + raised]
        small = [
            cylinder(0.5 * hole, 0.014, 16) + [0, 0, 0.007],
            cylinder(0.6 * hole, 0.004, 16) + [0, 0, 0.015],
        ]
        kit.add("cap", free(), [(moved(small, spot), looks.plastic(dice))], pusher)


def _cup_blender(dice: Dice) -> list[Body]:
    """A small base, and on it a cup upside down over a collar with the blade."""
    kit, coat = Assembly("base"), looks.plastic(dice)
    radius, high = dice.between(0.038, 0.05), dice.between(0.09, 0.14)
    _motor_base(dice, kit, 2 * radius + dice.between(0.02, 0.05), 2 * radius + 0.018, high)
    kit.fix([ring(radius + 0.0045, radius + 0.009, high - 0.002, high + 0.012)], coat)
    low, tall = high + 0.0015, dice.between(0.12, 0.19)
    collar = [cylinder(radius + 0.003, 0.02, 26) + [0, 0, low + 0.01]]
    collar += around([box((0.008, 0.012, 0.016), (radius + 0.001, 0, low + 0.024))], 4)
    bottom = kit.add("collar", hinge((0, 0, 0), UP, dice.between(0.4, 0.8)), [(collar, looks.plastic(dice))])
    shape = cup([(0.8 * radius, 0), (0.9 * radius, 0.006), (radius - 0.004, tall)], 0.0025) * [1, -1, -1]
    kit.add("cup", free(), [([shape + [0, 0, low + 0.0215 + tall]], looks.glass(dice))], bottom)
    spot = (0, 0, low + 0.0215)
    kit.add("blade", spin(spot, UP), [(moved(cutter(dice, 0.7 * radius), spot), looks.metal(dice))], bottom)
    return kit.done()


def _stick_blender(dice: Dice) -> list[Body]:
    """A grip with buttons and a speed knob, a shaft with a bell to take off, and the blade in it."""
    kit, coat, metal = Assembly("grip"), looks.plastic(dice), looks.metal(dice)
    thick, bell, long = dice.between(0.024, 0.033), dice.between(0.027, 0.038), dice.between(0.17, 0.24)
    tall = dice.between(0.16, 0.22)
    line = [(0, 0), (0.75 * thick, 0), (thick, 0.15 * tall), (0.8 * thick, 0.6 * tall), (thick, 0.9 * tall)]
    kit.fix([revolve([*line, (0.8 * thick, tall), (0, tall)], 22) + [0, 0, long + 0.001]], coat)
    count, look = dice.whole(1, 3), looks.plastic(dice)
    front = [box((0.02, thick, 0.024 * count + 0.006), (0, -0.47 * thick, long + 0.68 * tall))]
    kit.fix(front, DARK)
    pads = Assembly()
    keys(dice, pads, [(0.0, (k - (count - 1) / 2) * 0.024) for k in range(count)], 0.014, look)
    kit.graft(pads, (0, -0.97 * thick, long + 0.68 * tall))
    if dice.chance(0.6):
        spot = (0, 0, long + tall + 0.0015)
        kit.add(
            "knob", turning(dice, spot, UP), [(moved(turned(dial(dice, 0.6 * thick), ON_TOP), spot), look)]
        )
    rim = bell * 0.8
    outer = [
        (bell, 0),
        (bell, 0.01),
        (rim, 0.03),
        (0.4 * thick, 0.06),
        (0.5 * thick, 0.9 * long),
        (0.7 * thick, long),
    ]
    inner = [(0, long), (0, 0.024), (0.5 * bell, 0.022), (bell - 0.003, 0.008), (bell - 0.003, 0), (bell, 0)]
    shaft = kit.add("shaft", free(), [([revolve([*outer, *inner], 22)], metal)])
    blade = [box((1.5 * bell, 0.007, 0.0015), (0, 0, 0.01)), cylinder(0.003, 0.017, 8) + [0, 0, 0.0175]]
    kit.add("blade", spin((0, 0, 0.01), UP), [(blade, looks.metal(dice))], shaft)
    return kit.done()
