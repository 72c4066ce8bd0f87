"""Things of yards and streets that do not move."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import around, at, moved, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    boxes,
    cylinder,
    open_box,
    prism,
    revolve,
    rod,
    superquadric,
    torus,
    tube,
    vessel,
)
from . import looks
from .category import Category
from .objects import Body, Look, surface
from .rigging import RIGHT, Rig, ball_knob
from .static_small import stuff


def _planter(dice: Dice) -> list[Body]:
    width, depth, high = dice.between(0.15, 1.0), dice.between(0.15, 0.4), dice.between(0.12, 0.5)
    wall, round_pot = 0.012, dice.chance(0.5)
    if round_pot:
        tub = vessel(ngon(dice.pick((8, 18))), (depth, depth, high), wall, dice.between(1.0, 1.5))
        width = depth
    else:
        tub = open_box((width, depth, high), wall)
    size = (0.97 * width, 0.97 * depth, 0.01)
    soil = (cylinder(0.49 * depth, 0.01, 18) if round_pot else box(size)) + [0, 0, 0.85 * high]
    whole = Rig(
        surface([tub], stuff(dice)),
        surface([soil], Look("wood", (80, 60, 45))),
    )
    stems: Pieces = []
    for _ in range(dice.whole(0, 7)):
        x, y, tall = (
            dice.between(-0.3, 0.3) * width,
            dice.between(-0.3, 0.3) * depth,
            dice.between(0.2, 1.0) * high,
        )
        tip = (1.6 * x, 1.6 * y, 0.85 * high + tall)
        stems += [
            rod((x, y, 0.85 * high), tip, 0.004, 5),
            *moved([superquadric((0.06, 0.06, 0.05), 1, 1, 5)], tip),
        ]
    if stems:
        whole.dress(0, surface(stems, Look("fabric", (70, 120, 60))))
    return whole.bodies()


def _pillar(dice: Dice) -> list[Body]:
    """A column, lamp post, bollard or finial post."""
    radius, tall, look = dice.between(0.05, 0.25), dice.between(0.6, 3.2), stuff(dice)
    sides = dice.pick((4, 6, 8, 16, 20))
    foot, head = dice.between(0.05, 0.12) * tall, dice.between(0.03, 0.1) * tall
    line = [
        [0, 0],
        [1.5, 0],
        [1.5, foot],
        [1.1, foot],
        [1, 1.3 * foot],
        [dice.between(0.7, 1), tall - head],
        [1.4, tall - 0.6 * head],
        [1.4, tall],
        [0, tall],
    ]
    pieces = [revolve(np.array(line) * [radius, 1], sides)]
    if dice.chance(0.4):
        pieces += around([rod((radius, 0, 1.3 * foot), (0.9 * radius, 0, tall - head), 0.12 * radius, 5)], 12)
    whole = Rig(surface(pieces, look))
    if dice.chance(0.5):
        whole.dress(0, surface([ball_knob(1.2 * radius) + [0, 0, tall + 1.0 * radius]], looks.glass(dice)))
    return whole.bodies()


def _lamp_post(dice: Dice) -> list[Body]:
    tall, radius, look = dice.between(1.6, 4.0), dice.between(0.03, 0.06), looks.painted_metal(dice)
    reach, count = dice.between(0.2, 0.8), dice.whole(1, 4)
    pieces = [
        revolve(
            np.array([[0, 0], [3, 0], [3, 0.05], [1.5, 0.3], [1, 0.5], [0.8, tall], [0, tall]]) * [radius, 1],
            12,
        )
    ]
    path = [(0, 0, tall - 0.3), (0.6 * reach, 0, tall), (reach, 0, tall - 0.02)]
    pieces += around([tube(path, 0.6 * radius, 8)], count)
    shade = revolve(np.array([[0, 0.12], [0.06, 0.1], [0.16, 0], [0.15, 0], [0, 0.08]]), 14) + [
        reach,
        0,
        tall - 0.12,
    ]
    bulb = ball_knob(0.07) + [reach, 0, tall - 0.12]
    return Rig(
        surface([*pieces, *around([shade], count)], look), surface(around([bulb], count), looks.glass(dice))
    ).bodies()


def _crate(dice: Dice) -> list[Body]:
    """A closed or open box of planks, with braces that go nowhere."""
    width, depth, high = dice.between(0.25, 0.9), dice.between(0.25, 0.7), dice.between(0.2, 0.7)
    look, plank, rows = looks.wood(dice), 0.015, dice.whole(2, 5)
    pitch, x, y = high / rows, width / 2, depth / 2
    levels, slat = (np.arange(rows) + 0.5) * pitch, pitch * dice.between(0.7, 0.97)
    pieces = [boxes((width, plank, slat), [(0, s * (y - plank / 2), z) for s in (-1, 1) for z in levels])]
    pieces.append(
        boxes(
            (plank, depth - 2 * plank, slat), [(s * (x - plank / 2), 0, z) for s in (-1, 1) for z in levels]
        )
    )
    pieces += at(
        box((0.03, 0.03, high), (0, 0, high / 2)),
        [(s * (x - 0.03), t * (y - 0.03), 0) for s in (-1, 1) for t in (-1, 1)],
    )
    pieces.append(box((width, depth, plank), (0, 0, plank / 2)))
    if dice.chance(0.5):
        pieces.append(box((width, depth, plank), (0, 0, high + plank / 2)))
    if dice.chance(0.5):
        brace = rod((-x, -y - 0.008, 0.02), (x, -y - 0.008, high - 0.02), 0.02, 4)
        pieces += [brace, brace * [1, -1, 1]]
    return Rig(surface(pieces, look)).bodies()


def _barrel(dice: Dice) -> list[Body]:
    radius, high = dice.between(0.12, 0.35), dice.between(0.3, 1.0)
    bulge, hoops = dice.between(0.0, 0.25), dice.whole(2, 5)
    levels = np.linspace(0, 1, 11)
    wall = np.column_stack([1 + bulge * np.sin(np.pi * levels), levels]) * [radius, high]
    skin = revolve(
        np.vstack([[0, 0.02], [radius * 0.95, 0.02], wall, [radius * 0.95, high - 0.02], [0, high - 0.02]]),
        20,
    )
    whole = Rig(surface([skin], looks.wood(dice) if bulge > 0.08 else looks.painted_metal(dice)))
    spots = np.linspace(0.1, 0.9, hoops)
    bands = [
        torus(radius * (1 + bulge * float(np.sin(np.pi * z))), 0.008, 20, 0.015) + [0, 0, z * high]
        for z in spots
    ]
    whole.dress(0, surface(bands, looks.metal(dice)))
    if dice.chance(0.5):
        bung = cylinder(0.12 * radius, 0.02, 10) + [0.5 * radius, 0, high - 0.01]
        whole.dress(0, surface([bung], looks.plastic(dice)))
    return whole.bodies()


def _sign(dice: Dice) -> list[Body]:
    """A signpost, notice board or gravestone."""
    width, high, tall = dice.between(0.3, 1.0), dice.between(0.2, 0.7), dice.between(0.6, 2.2)
    board = (
        prism(rounded(0.1, width / high), (width, high, 0.02))
        if dice.chance(0.6)
        else prism(ngon(dice.pick((6, 8, 16))), (width, width, 0.02))
    )
    posts = [0.0] if dice.chance(0.5) else [-0.35 * width, 0.35 * width]
    pieces = [rod((x, 0.03, 0), (x, 0.03, tall), 0.025, 8) for x in posts]
    whole = Rig(surface(pieces, looks.metal(dice) if dice.chance(0.5) else looks.wood(dice)))
    face = turned([board], rotation(RIGHT, np.pi / 2))
    for k in range(dice.whole(1, 2)):
        whole.dress(0, surface(moved(face, (0, 0, tall - (0.5 + 1.1 * k) * high)), looks.painted_metal(dice)))
    text = [(0, -0.012, tall - (0.3 + 0.15 * k) * high) for k in range(dice.whole(1, 4))]
    lines = boxes((0.7 * width, 0.003, 0.05 * high), text)
    whole.dress(0, surface([lines], looks.plastic(dice)))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("planter", _planter, moves=False),
    Category("pillar", _pillar, moves=False),
    Category("lamp_post", _lamp_post, moves=False),
    Category("crate", _crate, moves=False),
    Category("barrel", _barrel, moves=False),
    Category("sign", _sign, moves=False),
)
