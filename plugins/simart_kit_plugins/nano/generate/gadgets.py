"""Monitors, cameras, headphones, radios and safes."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.handles import knob
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import (
    box,
    cylinder,
    open_box,
    prism,
    rod,
    superquadric,
    torus,
    tube,
)
from . import looks
from .assembling import dial, turning
from .category import Category
from .objects import Body, hinge, slide, spin, surface
from .rigging import BACK, DOWN, FRONT, LEFT, RIGHT, UP, Rig, ball_knob, lying, upright_ring


def _monitor(dice: Dice) -> list[Body]:
    """A screen that tilts, swivels and slides on its stand, or only some of it."""
    width = dice.between(0.35, 0.9)
    high, thick, level = width * dice.between(0.5, 0.65), dice.between(0.015, 0.05), dice.between(0.12, 0.3)
    shell, metal = looks.plastic(dice), looks.metal(dice)
    foot = prism(rounded(0.2), (0.4 * width, 0.2, 0.012)) + [0, 0.02, 0.006]
    if dice.chance(0.4):
        foot = prism(ngon(20), (0.3 * width, 0.22, 0.015)) + [0, 0.02, 0.0075]
    whole = Rig(surface([foot], shell), label="base")
    center = level + 0.5 * high
    column = [box((0.05, 0.025, center - 0.02), (0, 0.06, center / 2 + 0.01))]
    parent = whole.add("column", hinge((0, 0.06, 0.01), UP, 0.8, -0.8), surface(column, metal))
    if dice.chance(0.5):
        sleeve = surface([box((0.07, 0.04, 0.08), (0, 0.06, center - 0.05))], shell)
        room = min(0.1, level - 0.02)
        parent = whole.add("carriage", slide(UP, 0.3 * room, -room), sleeve, parent=parent)
    pin = np.array([0, 0.03, center])
    panel = [
        box((width, thick, high), (0, -thick / 2, center)),
        superquadric((0.5 * width, 0.06, 0.5 * high), 0.4, 0.4, 6) + [0, 0, center],
    ]
    glass = surface([box((0.95 * width, 0.001, 0.92 * high), (0, -thick, center))], looks.glass(dice))
    arm = surface([box((0.04, 0.04, 0.05), pin), lying(0.015, 0.06, X, 10) + pin], metal)
    screen = whole.add(
        "screen", hinge(pin, LEFT, 0.35, -0.1), surface(panel, shell), glass, arm, parent=parent
    )
    for k in range(dice.whole(0, 4)):
        key = box((0.012, 0.004, 0.006), ((0.3 + 0.05 * k) * width, -thick - 0.0015, center - 0.48 * high))
        whole.add("button", slide(BACK, 0.002), surface([key], metal), parent=screen)
    return whole.bodies()


def _camera(dice: Dice) -> list[Body]:
    width, depth, high = dice.between(0.1, 0.15), dice.between(0.035, 0.06), dice.between(0.065, 0.095)
    shell, dark, metal = looks.plastic(dice), looks.rubber(dice), looks.metal(dice)
    body = [
        box((width, depth, high), (0, 0, high / 2)),
        superquadric((0.03, depth + 0.03, high * 0.95), 0.4, 0.6, 6) + [-0.42 * width, 0, high / 2],
    ]
    whole = Rig(surface(body, shell))
    radius, x, front = dice.between(0.3, 0.42) * high, dice.between(-0.05, 0.15) * width, -depth / 2
    reach = front
    for k in range(dice.whole(1, 3)):
        long, size = dice.between(0.012, 0.035), radius * (1 - 0.08 * k)
        middle = np.array([x, reach - long / 2, 0.48 * high])
        ring = surface([lying(size, long - 0.001, Y, 20) + middle, upright_ring(size, 0.003) + middle], dark)
        whole.add("lens ring", spin(middle, FRONT), ring)
        reach -= long
    whole.dress(0, surface([lying(0.75 * radius, 0.002, Y, 16) + [x, reach, 0.48 * high]], looks.glass(dice)))
    top = high + 0.004
    for k, spot in enumerate((0.38, 0.25)[: dice.whole(1, 2)]):
        at = np.array([spot * width, 0, top])
        whole.add("dial", spin(at, UP), surface([cylinder(0.009 - 0.002 * k, 0.01, 14) + at], metal))
    at = np.array([-0.4 * width, front + 0.012, top])
    whole.add("shutter button", slide(DOWN, 0.002), surface([cylinder(0.005, 0.008, 10) + at], metal))
    if dice.chance(0.5):
        flash = surface([box((0.035, 0.03, 0.012), (x, 0.002, high + 0.0065))], dark)
        whole.add("flash", hinge((x, 0.017, high + 0.001), LEFT, 1.1), flash)
    if dice.chance(0.5):
        pin = np.array([-0.4 * width, depth / 2 + 0.003, high / 2])
        arm = surface([box((0.01, 0.006, 0.6 * high), pin)], dark)
        first = whole.add("screen arm", hinge(pin, UP, 2.8), arm)
        panel = box((0.65 * width, 0.006, 0.65 * high), pin + [0.34 * width, 0, 0])
        whole.add("screen", hinge(pin, RIGHT, 2.5, -1.2), surface([panel], looks.glass(dice)), parent=first)
    if dice.chance(0.4):
        door = box((0.003, 0.7 * depth, 0.5 * high), (width / 2 + 0.002, 0, 0.45 * high))
        whole.add(
            "card door",
            hinge((width / 2 + 0.002, 0.35 * depth, 0.45 * high), UP, 1.6),
            surface([door], shell),
        )
    return whole.bodies()


def _headphones(dice: Dice) -> list[Body]:
    width, high = dice.between(0.14, 0.18), dice.between(0.07, 0.1)
    shell, soft = looks.plastic(dice), looks.rubber(dice)
    angle = np.linspace(0, np.pi, 13)
    arch = np.column_stack([width / 2 * np.cos(angle), 0 * angle, high * np.sin(angle)])
    band = tube(arch, 0.007, 8) * [1, dice.between(1, 3), 1]
    whole = Rig(surface([band], shell), label="headband")
    radius = dice.between(0.03, 0.045)
    for name, s in (("left", -1), ("right", 1)):
        end = np.array([s * width / 2, 0, 0])
        arm = surface([box((0.008, 0.016, 0.05), end + [0, 0, -0.012])], shell)
        parent = whole.add("slider", slide(DOWN, 0.03), arm, name=f"{name}_slider")
        pin = end + [0, 0, -0.05]
        # It tips about a level pin, or turns about an upright one.
        tips = dice.chance(0.5)
        place = end + [0, 0, -0.035]
        joint = lying(0.006, 0.03, Y, 8) if tips else cylinder(0.006, 0.03, 8)
        cup = [
            pointed(superquadric((2.3 * radius, 2 * radius, 0.03), 0.5, 1.0, 7), X) + pin,
            joint + place,
        ]
        pad = pointed(torus(0.75 * radius, 0.012, 16), X) + pin - [s * 0.018, 0, 0]
        turns = hinge(place, BACK, 0.4, -0.4) if tips else hinge(place, UP, 1.5, -0.3)
        whole.add(
            "ear cup", turns, surface(cup, shell), surface([pad], soft), parent=parent, name=f"{name}_cup"
        )
    if dice.chance(0.4):
        pin = np.array([-width / 2 - 0.02, 0, -0.05])
        boom = surface(
            [rod(pin, pin + [0, -0.12, -0.04], 0.003), ball_knob(0.008) + pin + [0, -0.12, -0.04]], soft
        )
        whole.add("microphone", hinge(pin, RIGHT, 1.8, -0.4), boom)
    return whole.bodies()


def _radio(dice: Dice) -> list[Body]:
    width, depth, high = dice.between(0.15, 0.4), dice.between(0.06, 0.14), dice.between(0.1, 0.24)
    shell, metal = looks.plastic(dice) if dice.chance(0.6) else looks.wood(dice), looks.metal(dice)
    whole = Rig(surface([box((width, depth, high), (0, 0, high / 2))], shell))
    front = -depth / 2
    grille = (
        pointed(cylinder(min(0.35 * high, 0.2 * width), 0.004, 18), Y)
        if dice.chance(0.5)
        else box((0.4 * width, 0.004, 0.6 * high))
    )
    whole.dress(
        0,
        surface(
            [
                grille + [-0.22 * width, front - 0.002, 0.5 * high],
                box((0.35 * width, 0.003, 0.2 * high), (0.24 * width, front, 0.72 * high)),
            ],
            looks.metal(dice),
        ),
    )
    for k in range(dice.whole(1, 3)):
        at = np.array([(0.12 + 0.13 * k) * width, front, 0.3 * high])
        whole.add("knob", turning(dice, at), surface(moved(dial(dice, 0.045 * width), at), metal))
    for k in range(dice.whole(0, 5)):
        key = box((0.06 * width, 0.4 * depth, 0.008), ((0.4 - 0.08 * k) * width, 0, high + 0.004))
        whole.add("button", slide(DOWN, 0.004), surface([key], looks.plastic(dice)))
    if dice.chance(0.7):
        long, side = 0.85 * width, dice.sign()
        pin = np.array([side * 0.46 * width, depth / 2 + 0.006, high - 0.01])
        wand = [rod(pin, pin - [side * long, 0, 0], 0.003), ball_knob(0.006) + pin]
        first = whole.add("antenna", hinge(pin, (0, side, 0), 1.6), surface(wand, metal))
        if dice.chance(0.5):
            inner = [
                rod(pin - [side * 0.5 * long, 0, 0], pin - [side * 1.03 * long, 0, 0], 0.0018),
                ball_knob(0.004) + pin - [side * 1.03 * long, 0, 0],
            ]
            whole.add("antenna tip", slide((-side, 0, 0), 0.4 * long), surface(inner, metal), parent=first)
    if dice.chance(0.5):
        x = 0.47 * width + 0.008
        bow = tube(
            np.array([(-x, 0, high - 0.02), (-x, 0, high + 0.03), (x, 0, high + 0.03), (x, 0, high - 0.02)]),
            0.006,
        )
        whole.add("handle", hinge((0, 0, high - 0.02), LEFT, 1.5, -1.5), surface([bow], metal))
    return whole.bodies()


def _safe(dice: Dice) -> list[Body]:
    """A strong box: door with keypad or dial, handle and bolts."""
    width, depth, high, wall = dice.between(0.25, 0.5), dice.between(0.25, 0.45), dice.between(0.2, 0.6), 0.02
    paint, metal = looks.painted_metal(dice), looks.metal(dice)
    shell = pointed(open_box((high, width, depth), wall), Y) * [1, -1, 1]
    whole = Rig(surface([shell + [0, depth / 2, high / 2]], paint))
    if dice.chance(0.5):
        whole.dress(0, surface([box((width - 2 * wall, depth - 0.1, 0.01), (0, 0.03, high / 2))], metal))
    side, thick = dice.sign(), dice.between(0.02, 0.05)
    wide, tall = width - 2 * wall - 0.006, high - 2 * wall - 0.006
    front = -depth / 2
    pin = np.array([side * wide / 2, front, high / 2])
    leaf = surface([box((wide, thick, tall), (0, front + thick / 2, high / 2))], looks.darker(paint, 0.9))
    door = whole.add("door", hinge(pin, (0, 0, side), dice.between(1.4, 2.2)), leaf)
    spot = np.array([-side * 0.25 * wide, front, 0.55 * high])
    turn = [lying(0.02, 0.02, Y, 14) + spot, *around([box((0.1, 0.012, 0.014), (0.03, 0, 0))], 1)]
    turn[1:] = moved(turn[1:], spot - [0, 0.02, 0])
    if dice.chance(0.5):
        star = [
            rod(spot - [0, 0.03, 0], spot + [0.05 * np.cos(a), -0.03, 0.05 * np.sin(a)], 0.006)
            for a in (0, 2.1, 4.2)
        ]
        whole.add(
            "handle",
            spin(spot, FRONT),
            surface([lying(0.012, 0.07, Y, 10) + spot, *star], metal),
            parent=door,
        )
    else:
        whole.add("handle", hinge(spot, FRONT, 1.3), surface(turn, metal), parent=door)
    at = np.array([side * 0.22 * wide, front - 0.004, 0.55 * high])
    if dice.chance(0.4):
        marks = turned(around([box((0.005, 0.002, 0.002), (0.044, 0, 0))], 12), rotation(RIGHT, np.pi / 2))
        whole.dress(door, surface(moved(marks, at), metal))
        whole.add("dial", spin(at, FRONT), surface(moved(knob(dice, 0.035), at), metal), parent=door)
        return whole.bodies()
    pad = min(0.11, 0.32 * wide)
    whole.dress(door, surface([box((pad, 0.008, 1.3 * pad), at)], looks.plastic(dice)))
    for row in range(4):
        for column in range(3):
            key = box(
                (0.22 * pad, 0.006, 0.2 * pad),
                at + [(column - 1) * 0.29 * pad, -0.006, (1.5 - row) * 0.29 * pad],
            )
            whole.add("key", slide(BACK, 0.003), surface([key], metal), parent=door)
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("monitor", _monitor),
    Category("camera", _camera),
    Category("headphones", _headphones),
    Category("radio", _radio),
    Category("keypad_safe", _safe),
)
