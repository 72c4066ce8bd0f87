"""What turns, tilts and telescopes on a stand: tripods, arms, globes, metronomes."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.legs import star_base
from ...shapes.placing import X, moved, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    cylinder,
    open_box,
    revolve,
    rod,
    superquadric,
    torus,
    tube,
)
from . import looks
from .category import Category
from .objects import Body, ball, hinge, slide, spin, surface
from .rigging import BACK, FRONT, LEFT, RIGHT, UP, Rig, ball_knob, lying


def _tripod(dice: Dice) -> list[Body]:
    tall, count = dice.between(0.3, 1.4), dice.whole(3, 4)
    look, thick = looks.metal(dice), dice.between(0.009, 0.016)
    hub = [
        cylinder(2.2 * thick, 3 * thick, 14) + [0, 0, tall],
        rod((0, 0, 0.55 * tall), (0, 0, tall), thick, 8),
    ]
    whole = Rig(surface(hub, looks.plastic(dice)), label="hub")
    spread, telescopes = dice.between(0.25, 0.45), dice.chance(0.5)
    for k in range(count):
        yaw = rotation(UP, 2 * np.pi * k / count + 0.3)
        pin = yaw @ np.array([2.2 * thick, 0, 0]) + [0, 0, tall]
        along = yaw @ np.array([np.sin(spread), 0, -np.cos(spread)])
        end = pin + along * tall / np.cos(spread)
        knee = pin + 0.55 * (end - pin)
        first = surface(
            [rod(pin, knee if telescopes else end, thick, 8), *moved([ball_knob(1.3 * thick)], pin)], look
        )
        leg = whole.add("leg", hinge(pin, yaw @ BACK, 0.9 * spread, -0.6), first, name=f"leg_{k + 1}")
        if telescopes:
            tip = surface(
                [rod(knee - 0.1 * tall * along, end, 0.65 * thick, 8), ball_knob(thick) + end],
                looks.rubber(dice),
            )
            whole.add("lower leg", slide(-along, 0.35 * tall), tip, parent=leg)
    top = np.array([0, 0, tall + 1.5 * thick])
    parent = 0
    if dice.chance(0.6):
        parent = whole.add(
            "center column",
            slide(UP, 0.2 * tall),
            surface([rod(top - [0, 0, 0.2 * tall], top + [0, 0, 2 * thick], 0.7 * thick, 8)], look),
        )
        top = top + [0, 0, 2 * thick]
    pan = whole.add(
        "pan head",
        spin(top, UP),
        surface([cylinder(2 * thick, 2 * thick, 14) + top + [0, 0, thick]], look),
        parent=parent,
    )
    pin = top + [0, 0, 3 * thick]
    plate_ = [
        box((5 * thick, 6 * thick, thick), pin + [0, 0, 1.5 * thick]),
        lying(thick, 4 * thick, X, 10) + pin,
    ]
    bar = rod(pin + [2 * thick, 0, 0], pin + [2 * thick, 0.18 * tall + 0.05, -0.08 * tall], 0.5 * thick)
    whole.add(
        "tilt head",
        hinge(pin, RIGHT, 1.3, -0.8),
        surface(plate_, looks.plastic(dice)),
        surface([bar], looks.rubber(dice)),
        parent=pan,
    )
    return whole.bodies()


def _microphone_arm(dice: Dice) -> list[Body]:
    """A chain of two or three arms with a microphone, magnifier or lamp at its end."""
    metal, count = looks.metal(dice), dice.whole(2, 4)
    foot = surface(
        [cylinder(0.07, 0.015, 18) + [0, 0, 0.0075], rod((0, 0, 0), (0, 0, 0.06), 0.012, 10)], metal
    )
    whole = Rig(foot, label="base")
    at = np.array([0, 0, 0.06])
    parent = whole.add(
        "turntable",
        spin(at, UP),
        surface([cylinder(0.016, 0.03, 12) + at + [0, 0, 0.016]], looks.darker(metal)),
    )
    at, angle = at + [0, 0, 0.03], dice.between(0.1, 0.5)
    for _ in range(count):
        long = dice.between(0.15, 0.4)
        end = at + long * np.array([0, -np.sin(angle), np.cos(angle)])
        bars = [rod(at + [s * 0.01, 0, 0], end + [s * 0.01, 0, 0], 0.006) for s in (-1, 1)]
        pieces = [*bars, lying(0.012, 0.034, X, 10) + at]
        parent = whole.add("arm", hinge(at, RIGHT, 1.2, -0.8), surface(pieces, metal), parent=parent)
        at, angle = end, angle + dice.between(0.4, 1.2)
    style = dice.unit()
    turns_freely = dice.chance(0.3)
    head: Pieces = [ball_knob(0.02) if turns_freely else lying(0.012, 0.034, X, 10)]
    if style < 0.5:
        head += [superquadric((0.05, 0.05, 0.12), 0.6, 1.0, 8) - [0, 0, 0.06]]
    elif style < 0.75:
        head += [
            revolve(np.array([[0.02, 0], [0.08, -0.1], [0.078, -0.1], [0.018, -0.002]]), 16),
            ball_knob(0.025) - [0, 0, 0.06],
        ]
    else:
        head += [torus(0.07, 0.008, 20) - [0, 0.07, 0.01], cylinder(0.068, 0.006, 18) - [0, 0.07, 0.01]]
    turn = ball(at) if turns_freely else hinge(at, RIGHT, 1.2, -1.2)
    whole.add("head", turn, surface(moved(head, at), looks.plastic(dice)), parent=parent)
    return whole.bodies()


def _globe(dice: Dice) -> list[Body]:
    radius, tilt = dice.between(0.06, 0.25), dice.pick((0.41, 0.41, 0.0, dice.between(0, 0.6)))
    metal = looks.metal(dice)
    middle = np.array([0, 0, 1.5 * radius + 0.02])
    axis = rotation(BACK, tilt) @ np.array(UP)
    reach = 1.12 * radius
    full = dice.chance(0.3)
    angle = np.linspace(-np.pi / 2, np.pi / 2 if not full else 1.5 * np.pi, 19)
    arc = np.column_stack([-reach * np.cos(angle), 0 * angle, reach * np.sin(angle)]) @ rotation(BACK, tilt).T
    meridian = [tube(arc + middle, 0.035 * radius, 6)]
    stem = revolve(
        np.array([[0, 0], [0.6, 0], [0.6, 0.03], [0.12, 0.12], [0.08, 0.35], [0, 0.35]]) * radius + [0, 0], 16
    )
    whole = Rig(surface([stem], looks.wood(dice)), label="stand")
    low = rod((0, 0, 0.3 * radius), middle + [0, 0, -reach], 0.06 * radius, 8)
    parent = 0
    if dice.chance(0.35):
        clamp = box(np.array([0.3, 0.24, 0.16]) * radius, middle - [0, 0, reach])
        whole.dress(0, surface([low, clamp], metal))
        parent = whole.add("meridian", hinge(middle, BACK, 0.9, -0.9), surface(meridian, metal))
    else:
        whole.dress(0, surface([low, *meridian], metal))
    ball_ = superquadric((2 * radius,) * 3, 1.0, 1.0, 10)
    pins = rod(-1.1 * radius * axis, 1.1 * radius * axis, 0.02 * radius)
    whole.add(
        "globe", spin(middle, axis), surface(moved([ball_, pins], middle), looks.plastic(dice)), parent=parent
    )
    return whole.bodies()


def _metronome(dice: Dice) -> list[Body]:
    high, wide = dice.between(0.15, 0.28), dice.between(0.09, 0.13)
    look, metal = looks.wood(dice), looks.metal(dice)
    body = revolve(
        np.array([[0, 0], [0.75, 0], [0.75, 0.08], [0.68, 0.1], [0.3, 1], [0, 1]]) * [wide, high], 4
    )
    case = turned([body], rotation(UP, np.pi / 4))
    whole = Rig(surface(case, look))
    lean = rotation(LEFT, np.arctan2(0.27 * wide, 0.9 * high))
    pin = np.array([0, -0.53 * wide - 0.004, 0.15 * high])
    wand = surface(moved(turned([box((0.005, 0.002, 0.85 * high), (0, 0, 0.4 * high))], lean), pin), metal)
    swing = whole.add("pendulum", hinge(pin, lean @ FRONT, 0.5, -0.5), wand)
    weight = moved(
        turned([box((0.022, 0.006, 0.016), (0, -0.001, dice.between(0.45, 0.7) * high))], lean), pin
    )
    whole.add("weight", slide(lean @ UP, 0.08 * high, -0.2 * high), surface(weight, metal), parent=swing)
    at = np.array([0.55 * wide, 0, 0.3 * high])
    key = [lying(0.004, 0.02, X, 8) + at, box((0.004, 0.03, 0.018), at + [0.012, 0, 0])]
    whole.add("winding key", spin(at, RIGHT), surface(key, metal))
    if dice.chance(0.4):
        drawer = open_box((0.7 * wide, 0.5 * wide, 0.04 * high), 0.002) + [0, -0.3 * wide, 0.02 * high]
        whole.dress(
            0,
            surface(
                [box((0.72 * wide, 0.004, 0.07 * high), (0, -0.54 * wide, 0.04 * high))], looks.darker(look)
            ),
        )
        whole.add("drawer", slide(FRONT, 0.3 * wide), surface([drawer], look))
    return whole.bodies()


def _music_stand(dice: Dice) -> list[Body]:
    """An easel or music stand: foot, telescoping post, tilting desk with a sliding lip."""
    tall, width = dice.between(0.6, 1.3), dice.between(0.35, 0.6)
    metal, look = looks.metal(dice), looks.wood(dice) if dice.chance(0.5) else looks.metal(dice)
    foot = moved(star_base(dice, 0.3, 0.15), (0, 0, 0.15))
    whole = Rig(surface([*foot, rod((0, 0, 0.1), (0, 0, 0.6 * tall), 0.014, 10)], metal), label="base")
    post = whole.add(
        "post", slide(UP, 0.3 * tall), surface([rod((0, 0, 0.3 * tall), (0, 0, tall), 0.009, 8)], metal)
    )
    pin, lean = np.array([0, 0, tall]), rotation(LEFT, dice.between(0.15, 0.5))
    desk = [
        box((width, 0.008, 0.7 * width), (0, -0.02, 0.25 * width)),
        box((width, 0.05, 0.008), (0, -0.045, -0.1 * width)),
        lying(0.014, 0.06, X, 10),
    ]
    board = whole.add(
        "desk", hinge(pin, LEFT, 0.9, -0.3), surface(moved(turned(desk, lean), pin), look), parent=post
    )
    for name, s in (("left_leaf", -1), ("right_leaf", 1)) if dice.chance(0.4) else ():
        edge = pin + lean @ np.array([s * (width / 2 + 0.003), -0.02, 0.25 * width])
        leaf = moved(turned([box((0.3 * width, 0.006, 0.6 * width), (s * 0.15 * width, 0, 0))], lean), edge)
        whole.add(
            "leaf",
            hinge(edge, lean @ np.array([0, 0, -s]), 2.8),
            surface(leaf, look),
            parent=board,
            name=name,
        )
    if dice.chance(0.6):
        spot = np.array([0.03, 0, 0.58 * tall])
        screw = [lying(0.005, 0.03, X, 8) + spot, lying(0.014, 0.012, X, 10) + spot + [0.02, 0, 0]]
        whole.add("clamp screw", spin(spot, RIGHT), surface(screw, looks.plastic(dice)))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("tripod", _tripod),
    Category("microphone_arm", _microphone_arm),
    Category("globe", _globe),
    Category("metronome", _metronome),
    Category("music_stand", _music_stand),
)
