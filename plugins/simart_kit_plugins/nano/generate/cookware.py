"""Kettles, pots, pans and teapots."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon
from ...shapes.placing import Y, moved, pointed
from ...shapes.primitives import (
    Pieces,
    box,
    cylinder,
    revolve,
    torus,
    tube,
    vessel,
)
from . import looks
from .assembling import Assembly
from .category import Category
from .objects import Body, Look, Motion, free, hinge


def _belly(dice: Dice, radius: float, height: float, wall: float) -> tuple[FloatArray, float]:
    """A turned vessel on z = 0 with an inner skin, and the radius of its mouth."""
    style = dice.unit()
    up = np.linspace(0, 1, 7)
    if style < 0.35:
        width = np.full(7, 1.0)
    elif style < 0.6:
        width = np.linspace(1.0, dice.between(0.5, 1.2), 7)
    else:
        swell = dice.between(0.2, 0.5)
        width = dice.between(0.6, 0.9) + swell * np.sin(np.pi * (0.15 + 0.7 * up))
    width *= radius / width.max()
    outer = np.column_stack([width, up * height])
    inner = np.column_stack([np.maximum(width - wall, wall), np.maximum(up * height, wall)])[::-1]
    return revolve(np.vstack([[[0.0, 0.0]], outer, inner, [[0, wall]]]), 20), float(width[-1])


def _cover(dice: Dice, radius: float, thick: float) -> Pieces:
    """A lid on z = 0, flat or domed, with a knob on top."""
    rise = radius * dice.between(0.0, 0.4)
    profile = [
        [0.0, 0.0],
        [radius, 0],
        [radius, thick],
        [radius * 0.7, thick + rise * 0.7],
        [0, thick + rise],
    ]
    top = thick + rise
    pieces: Pieces = [revolve(profile, 20)]
    if dice.chance(0.5):
        pieces.append(cylinder(radius * 0.9, thick * 2, 18) - [0, 0, thick * 0.4])
    style, size = dice.unit(), radius * dice.between(0.12, 0.2)
    if style < 0.5:
        stem = [
            [0.0, 0.0],
            [size * 0.5, 0],
            [size * 0.5, size * 0.6],
            [size, size],
            [size * 0.8, size * 1.4],
            [0, size * 1.5],
        ]
        pieces.append(revolve(stem, 12) + [0, 0, top - 0.001])
    elif style < 0.8:
        arch = [
            (-2 * size, 0, 0),
            (-1.6 * size, 0, size * 1.4),
            (1.6 * size, 0, size * 1.4),
            (2 * size, 0, 0),
        ]
        pieces.append(tube(arch, size * 0.3, 6) + [0, 0, top - rise * 0.1 - 0.001])
    elif style < 0.9:
        pieces.append(box((size * 3, size * 0.5, size), (0, 0, top + size / 2)))
    return pieces


def _spout(dice: Dice, radius: float, height: float) -> FloatArray:
    """A spout towards -x from the side of a vessel."""
    start, rise = height * dice.between(0.2, 0.7), height * dice.between(0.2, 0.6)
    reach = radius * dice.between(0.3, 0.9)
    path = [
        (-radius * 0.8, 0, start),
        (-radius - 0.5 * reach, 0, start + 0.3 * rise),
        (-radius - reach, 0, start + rise),
    ]
    wide = radius * dice.between(0.12, 0.25)
    return tube(path, wide * np.array([1.2, 0.9, 0.6]), 10)


def ear(dice: Dice, radius: float, height: float) -> FloatArray:
    """A handle at the side of x."""
    out, thick = radius * dice.between(0.4, 0.8), radius * dice.between(0.06, 0.12)
    low, high = height * dice.between(0.1, 0.35), height * dice.between(0.7, 0.95)
    middle = radius * 0.95
    path = [
        (middle, 0, high),
        (middle + out, 0, high),
        (middle + out * 1.1, 0, (low + high) / 2),
        (middle + out * 0.8, 0, low),
        (middle, 0, low),
    ]
    return tube(path if dice.chance(0.7) else path[:3], thick, 8)


def bail(dice: Dice, radius: float, height: float) -> FloatArray:
    """A bow over the top, from pin to pin along x."""
    angle = np.linspace(0, np.pi, 13)
    tall = height * dice.between(0.5, 1.0) + radius * 0.3
    line = np.column_stack(
        [radius * np.cos(angle), 0 * angle, tall * np.sin(angle) ** dice.between(0.5, 1.0)]
    )
    return tube(line, radius * dice.between(0.03, 0.07), 8)


def _lidded(dice: Dice, kit: Assembly, mouth: float, height: float, look: Look, hinged: float) -> int:
    """A lid on a mouth: free, or on a hinge at the side of the handle."""
    thick = mouth * dice.between(0.04, 0.12)
    shape = moved(_cover(dice, mouth * dice.between(0.92, 1.02), thick), (0, 0, height + 0.001))
    if dice.chance(hinged):
        pin = (mouth, 0, height + thick / 2)
        shape.append(pointed(cylinder(thick * 0.6, mouth * 0.3, 8), Y) + pin)
        return kit.add("lid", hinge(pin, (0, 1, 0), dice.between(1.1, 1.8)), [(shape, look)])
    return kit.add("lid", free(), [(shape, look)])


def _shoulder(kit: Assembly, mouth: float, lid: float, height: float, look: Look) -> None:
    """A ring that narrows a mouth to a lid."""
    inner, low = lid * 0.92, height - 0.003
    kit.fix([revolve([[inner, low], [mouth, low], [mouth, height], [inner, height], [inner, low]], 20)], look)


def _kettle(dice: Dice) -> list[Body]:
    kit = Assembly()
    radius, height = dice.between(0.06, 0.11), dice.between(0.1, 0.24)
    coat = looks.metal(dice) if dice.chance(0.6) else looks.plastic(dice)
    dark = looks.plastic(dice)
    shape, mouth = _belly(dice, radius, height, 0.003)
    kit.fix([shape], coat)
    kit.fix([_spout(dice, radius, height)], coat)
    electric = dice.chance(0.5)
    if electric:
        kit.fix([cylinder(radius * 1.08, 0.02, 20) - [0, 0, 0.011]], dark)
    if dice.chance(0.55) or electric:
        kit.fix([ear(dice, radius, height)], dark)
        _lidded(dice, kit, mouth, height, coat, 0.7)
        if dice.chance(0.6):
            pin = (radius * 1.1, 0, height * dice.between(0.1, 0.9))
            flip = [box((0.02, 0.014, 0.006), (0.012, 0, 0))]
            kit.add("switch", hinge(pin, (0, 1, 0), 0.4), [(moved(flip, pin), looks.plastic(dice))])
        return kit.done()
    _shoulder(kit, mouth, 0.85 * mouth, height, coat)
    _lidded(dice, kit, mouth * 0.85, height, coat, 0.1)
    level = height * dice.between(0.85, 0.97)
    at_x = max(mouth, radius * 0.8) * 1.05
    bow = [bail(dice, at_x, height) + [0, 0, level]]
    kit.fix([box((0.01, 0.012, 0.02), (s * at_x * 0.97, 0, level)) for s in (-1, 1)], coat)
    kit.add("handle", tilting((0, 0, level), dice.between(1.0, 1.45)), [(bow, dark)])
    return kit.done()


def tilting(pin: tuple[float, float, float], reach: float) -> Motion:
    """A handle that swings both ways about x."""
    return hinge(pin, (1, 0, 0), reach, -reach)


def _pot(dice: Dice) -> list[Body]:
    kit, coat = Assembly(), looks.metal(dice) if dice.chance(0.7) else looks.ceramic(dice)
    radius = dice.between(0.07, 0.17)
    height = radius * dice.between(0.6, 1.6)
    kit.fix([vessel(ngon(22), (2 * radius, 2 * radius, height), 0.004, dice.between(1.0, 1.15))], coat)
    grip = coat if dice.chance(0.5) else looks.plastic(dice)
    lid = looks.glass(dice) if dice.chance(0.4) else coat
    _grips(dice, kit, radius, height, grip)
    _lidded(dice, kit, radius, height, lid, 0.08)
    return kit.done()


def _grips(dice: Dice, kit: Assembly, radius: float, height: float, grip: Look) -> None:
    """Two ears that stand off or hang, one long handle, or a bail."""
    style, level = dice.unit(), height * dice.between(0.65, 0.92)
    if style < 0.55:
        wide = radius * dice.between(0.25, 0.45)
        loop = [
            (radius * 0.97, -wide, 0),
            (radius * 1.25, -wide * 0.8, 0.005),
            (radius * 1.25, wide * 0.8, 0.005),
            (radius * 0.97, wide, 0),
        ]
        ear = [tube(loop, radius * 0.04, 8) + [0, 0, level]]
        for side in (-1, 1):
            kit.fix([piece * [side, 1, 1] for piece in ear], grip)
    elif style < 0.85:
        kit.fix(_stick(dice, radius, level), grip)
    else:
        at_x = radius * 1.06
        kit.fix([box((0.01, 0.015, 0.02), (s * radius * 1.02, 0, level)) for s in (-1, 1)], grip)
        bow = [bail(dice, at_x, radius) + [0, 0, level]]
        kit.add("handle", tilting((0, 0, level), 1.4), [(bow, grip)])


def _stick(dice: Dice, radius: float, level: float) -> Pieces:
    """A long handle along x."""
    long, thick = radius * dice.between(1.0, 1.8), dice.between(0.008, 0.014)
    rise = long * dice.between(0.0, 0.3)
    path = [(radius * 0.95, 0, 0), (radius + 0.2 * long, 0, 0.3 * rise), (radius + long, 0, rise)]
    grip = tube(path, thick * np.array([0.7, 1.0, 1.2]), 8) * [1, dice.between(1.0, 1.6), 1]
    return moved([grip], (0, 0, level))


def _pan(dice: Dice) -> list[Body]:
    """A pan with a lid; some handles fold up against it."""
    kit, coat = Assembly(), looks.metal(dice)
    radius, height = dice.between(0.09, 0.17), dice.between(0.035, 0.09)
    kit.fix([vessel(ngon(24), (1.7 * radius, 1.7 * radius, height), 0.003, 2 / 1.7)], coat)
    level, grip = height * 0.8, looks.plastic(dice)
    if dice.chance(0.25):
        pin = (radius * 1.05, 0, level)
        kit.fix([box((0.03, 0.03, 0.02), (radius * 1.0, 0, level))], coat)
        stick = _stick(dice, radius * 1.08, level)
        kit.add("handle", hinge(pin, (0, -1, 0), dice.between(0.8, 1.5)), [(stick, grip)])
    else:
        kit.fix(_stick(dice, radius, level), grip)
    if dice.chance(0.3):
        kit.fix(
            [
                tube(
                    [
                        (-radius * 0.95, -0.03, level),
                        (-radius * 1.25, 0, level),
                        (-radius * 0.95, 0.03, level),
                    ],
                    0.006,
                )
            ],
            grip,
        )
    _lidded(dice, kit, radius, height, looks.glass(dice) if dice.chance(0.6) else coat, 0.05)
    return kit.done()


def _teapot(dice: Dice) -> list[Body]:
    kit, glaze = Assembly(), looks.ceramic(dice)
    radius = dice.between(0.05, 0.1)
    height = radius * dice.between(1.0, 2.0)
    shape, mouth = _belly(dice, radius, height, 0.004)
    kit.fix([shape, _spout(dice, radius, height)], glaze)
    if dice.chance(0.75):
        kit.fix([ear(dice, radius, height)], glaze)
    else:
        level, at_x = height * 0.9, max(mouth, radius * 0.75)
        kit.fix([torus(0.008, 0.003, 10) + [s * at_x, 0, level] for s in (-1, 1)], glaze)
        kit.add(
            "handle",
            tilting((0, 0, level), 1.2),
            [([bail(dice, at_x, height) + [0, 0, level]], looks.wood(dice))],
        )
    lid = mouth * dice.between(0.6, 0.95)
    _shoulder(kit, mouth, lid, height, glaze)
    _lidded(dice, kit, lid, height, glaze, 0.15)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("kettle", _kettle),
    Category("pot", _pot),
    Category("pan_with_lid", _pan),
    Category("teapot", _teapot),
)
