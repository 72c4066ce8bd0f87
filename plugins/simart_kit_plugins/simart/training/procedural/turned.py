"""Lathe work and what goes with it: bottles, vases, pots, kettles, mugs, lamps."""

from __future__ import annotations

import numpy as np

from ....shapes.dice import Dice
from ....shapes.handles import handle, knob
from ....shapes.legs import star_base
from ....shapes.placing import moved, rotation, turned
from ....shapes.primitives import Pieces, cylinder, revolve, rod, superquadric, torus, tube
from ....shapes.walls import hollow, smooth_wall


def turned_object(dice: Dice) -> list[Pieces]:
    """A vessel, a pot or a lamp."""
    return dice.weighted([(3, _bottle), (3, _pot), (2, _vase), (3, _lamp)])(dice)


def _bottle(dice: Dice) -> list[Pieces]:
    radius, height = dice.between(0.03, 0.1), dice.between(0.15, 0.4)
    neck, shoulder = dice.between(0.2, 0.9) * radius, dice.between(0.5, 0.85)
    wall = np.array([[0.95, 0], [1, 0.03], [1, shoulder], [0.9, shoulder + 0.05], [0, 0.9], [0, 1]])
    wall *= [radius, height]
    wall[-2:, 0] = neck
    sides = dice.pick((4, 6, 16, 20, 24))
    body = [
        revolve(
            hollow(wall, 0.1 * neck) if dice.chance(0.5) else np.vstack([[0, 0], wall, [0, height]]), sides
        )
    ]
    cap: Pieces = [cylinder(neck * dice.between(1.0, 1.3), 0.12 * height, 14) + [0, 0, height]]
    style = dice.unit()
    if style < 0.2:
        top = height * 1.12
        spout = [(0, 0, height), (0, 0, top), (0, -radius, top), (0, -1.3 * radius, top * 0.97)]
        cap.append(tube(spout, neck * 0.35))
    elif style < 0.35:
        cap = moved(cap, (0, 0, dice.between(0.1, 0.5) * height))
    return [body, cap] if dice.chance(0.8) else [body]


def _pot(dice: Dice) -> list[Pieces]:
    """A pan, kettle, mug or tea pot, with handles, a spout and a lid."""
    radius, height = dice.between(0.08, 0.2), dice.between(0.06, 0.3)
    wall = np.array(
        [[dice.between(0.6, 1.0), 0], [1, 0.25], [dice.between(0.9, 1.05), 0.75], [dice.between(0.5, 1.1), 1]]
    )
    wall *= [radius, height]
    mouth = wall[-1, 0]
    body: Pieces = [revolve(hollow(wall, radius * dice.between(0.02, 0.08)), dice.whole(14, 24))]
    style, grip = dice.unit(), dice.between(0.05, 0.1) * radius
    if style < 0.35:
        reach = radius * dice.between(1.5, 2.8)
        body.append(rod((radius * 0.95, 0, 0.8 * height), (radius + reach, 0, height), grip * 1.5, 8))
    elif style < 0.7:
        around = np.linspace(-1.3, 1.3, 9)
        loop = np.column_stack(
            [0.92 * radius + 0.6 * radius * np.cos(around), 0 * around, height * (0.5 + 0.4 * np.sin(around))]
        )
        body.append(tube(loop, grip))
    else:
        body += [
            piece
            for s in (-1, 1)
            for piece in turned(
                moved(handle(dice, 0.6 * radius), (0, -radius, 0.8 * height)),
                rotation((0, 0, 1), s * np.pi / 2),
            )
        ]
    if dice.chance(0.35):
        start, end = (-0.8 * radius, 0, 0.4 * height), (-1.7 * radius, 0, height)
        body.append(
            tube([start, (-1.3 * radius, 0, 0.6 * height), end], radius * np.array([0.25, 0.15, 0.1]), 8)
        )
    if dice.chance(0.25):
        return [body]
    lid = [
        revolve(
            np.array([[0, 0], [1.03, 0], [1.03, 0.05], [0.6, 0.2], [0, 0.25]])
            * [mouth, mouth * dice.between(0.3, 1.2)],
            18,
        )
    ]
    lid += moved(turned(knob(dice, 0.18 * mouth), rotation((1, 0, 0), -np.pi / 2)), (0, 0, 0.15 * mouth))
    if dice.chance(0.35):
        lid = moved(
            turned(lid, rotation((1, 0, 0), -dice.between(0, 1.5)), (0, mouth, 0)),
            (0, 0, dice.between(0, 0.3) * height),
        )
    return [body, moved(lid, (0, 0, height))]


def _vase(dice: Dice) -> list[Pieces]:
    """A vase, bowl, goblet, candle holder or baluster."""
    size = [dice.between(0.1, 0.3), dice.between(0.15, 0.8)]
    wall = smooth_wall(dice, dice.whole(3, 6), 0.2) * size
    profile = (
        hollow(wall, size[0] * dice.between(0.03, 0.12))
        if dice.chance(0.7)
        else np.vstack([[0, 0], wall, [0, size[1]]])
    )
    parts: list[Pieces] = [[revolve(profile, dice.pick((6, 8, 20, 24, 28)))]]
    if dice.chance(0.3):
        top = wall[-1, 0]
        parts.append([revolve(smooth_wall(dice, 4, 0.2)[::-1] * [top, 0.3 * size[1]], 16) + [0, 0, size[1]]])
    return parts


def _lamp(dice: Dice) -> list[Pieces]:
    """A desk, floor or pendant lamp: foot, arms with joints, shade and bulb."""
    height, radius = dice.between(0.3, 1.6), dice.between(0.08, 0.2)
    thick = dice.between(0.006, 0.02)
    foot: Pieces = [
        revolve(
            np.array([[0, 0.2], [0.3, 0.2], [1, 0.1], [1, 0], [0, 0]]) * radius * dice.between(0.6, 1.2), 16
        )
    ]
    if dice.chance(0.2):
        foot = moved(star_base(dice, radius * 1.5, 0.1), (0, 0, 0.1))
    elbow, tip = np.array([0.0, 0.0, height]), np.array([0.0, 0.0, height])
    parts = [foot]
    if dice.chance(0.5):
        elbow = np.array([dice.between(-0.5, 0.1) * height, 0, dice.between(0.5, 0.9) * height])
        tip = elbow + [dice.between(0.2, 0.7) * height, 0, dice.between(-0.1, 0.4) * height]
        ball = superquadric((4 * thick,) * 3, 1, 1, 5)
        parts += [[rod((0, 0, 0), elbow, thick), ball + elbow], [rod(elbow, tip, thick), ball + tip]]
    else:
        foot.append(rod((0, 0, 0), tip, thick, 8))
    mouth, top, deep = (
        radius * dice.between(0.8, 1.4),
        radius * dice.between(0.2, 1.0),
        radius * dice.between(0.6, 1.8),
    )
    shade: Pieces = [
        revolve([[mouth, -deep], [top, 0], [top * 0.97, 0], [mouth * 0.97, -deep]], dice.whole(12, 24))
    ]
    if dice.chance(0.5):
        shade += [torus(top, thick, 16), rod((-top, 0, 0), (top, 0, 0), thick, 4)]
    bulb = superquadric((0.4 * top + 0.02,) * 3, 1, 1, 6) - [0, 0, 0.4 * deep]
    tilt = rotation((0, 1, 0), dice.between(-0.8, 0.8) if len(parts) > 1 else 0.0)
    head = moved(turned(shade, tilt), tip)
    light = moved(turned([bulb], tilt), tip)
    return [*parts, head, light] if dice.chance(0.4) else [*parts, head + light]
