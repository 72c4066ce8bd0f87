"""Small things and machines that do not move."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame, front
from ...shapes.handles import handle, knob
from ...shapes.legs import feet
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import at, moved, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    boxes,
    cylinder,
    loft,
    prism,
    revolve,
    superquadric,
    torus,
    tube,
    vessel,
)
from ...shapes.walls import hollow, smooth_wall
from . import looks
from .category import Category
from .objects import Body, Look, surface
from .rigging import UP, Rig, lying


def stuff(dice: Dice) -> Look:
    """What ornaments are made of."""
    return dice.pick((looks.ceramic, looks.glass, looks.metal, looks.wood, looks.plastic))(dice)


def _vase(dice: Dice) -> list[Body]:
    size = [dice.between(0.05, 0.25), dice.between(0.12, 0.7)]
    wall = smooth_wall(dice, dice.whole(3, 6), 0.25) * size
    whole = Rig(
        surface(
            [revolve(hollow(wall, size[0] * dice.between(0.03, 0.1)), dice.pick((6, 8, 20)))], stuff(dice)
        )
    )
    if dice.chance(0.35):
        ears = []
        for s in (-1, 1):
            angle = np.linspace(-1.4, 1.4, 9)
            at_x = float(wall[7, 0])
            path = np.column_stack(
                [
                    s * (0.9 * at_x + 0.4 * size[0] * np.cos(angle)),
                    0 * angle,
                    size[1] * (0.6 + 0.15 * np.sin(angle)),
                ]
            )
            ears.append(tube(path, 0.05 * size[0] + 0.003))
        whole.dress(0, surface(ears, stuff(dice)))
    if dice.chance(0.3):
        whole.dress(
            0, surface([torus(float(wall[5, 0]), 0.03 * size[0], 20) + [0, 0, wall[5, 1]]], looks.metal(dice))
        )
    return whole.bodies()


def _tableware(dice: Dice) -> list[Body]:
    """Plates, cups, bowls and jugs on a tray or board."""
    width, depth = dice.between(0.3, 0.6), dice.between(0.25, 0.4)
    board = prism(rounded(dice.between(0.02, 0.3), width / depth), (width, depth, 0.012))
    whole = Rig(surface([board + [0, 0, 0.006]], looks.wood(dice)))
    for x in np.linspace(-0.3, 0.3, dice.whole(2, 3)) * width:
        for y in np.linspace(-0.22, 0.22, dice.whole(1, 2)) * depth:
            whole.dress(0, surface(moved(_dish(dice), (x, y, 0.0125)), looks.ceramic(dice)))
    return whole.bodies()


def _dish(dice: Dice) -> Pieces:
    radius, style = dice.between(0.03, 0.055), dice.unit()
    if style < 0.3:
        stack, pitch = dice.whole(1, 4), 0.006
        line = np.array([[0, 0], [0.6, 0], [1.2, 0.012], [1.2, 0.016], [0.6, 0.004], [0, 0.004]]) * [
            radius,
            1,
        ]
        return at(revolve(line, 18), [(0, 0, k * pitch) for k in range(stack)])
    if style < 0.55:
        return [vessel(ngon(18), (radius, radius, radius * 0.8), 0.003, dice.between(1.2, 2.0))]
    high = radius * dice.between(1.2, 2.6)
    pieces = [vessel(ngon(16), (1.5 * radius, 1.5 * radius, high), 0.003, dice.between(0.8, 1.2))]
    angle = np.linspace(-1.4, 1.4, 8)
    loop = np.column_stack(
        [radius * (0.7 + 0.45 * np.cos(angle)), 0 * angle, high * (0.5 + 0.3 * np.sin(angle))]
    )
    return [*pieces, *turned([tube(loop, 0.004)], rotation(UP, dice.between(0, 6.3)))]


def _statue(dice: Dice) -> list[Body]:
    """A plinth with a heap of stones, an abstract figure or a bust."""
    base, high, look = (
        dice.between(0.1, 0.3),
        dice.between(0.05, 0.6),
        Look("stone", dice.pick(((190, 186, 178), (120, 118, 115), (90, 80, 72)))),
    )
    pieces = [
        box((base, base, high), (0, 0, high / 2)),
        box((1.15 * base, 1.15 * base, 0.08 * base), (0, 0, high)),
    ]
    level = high
    for _ in range(dice.whole(2, 6)):
        size = base * (0.3 + 0.6 * dice.units(3))
        turn = rotation(dice.normals(3), dice.between(0, 0.5))
        piece = superquadric(size, dice.between(0.3, 1.4), dice.between(0.3, 1.4), 7)
        pieces += moved(
            turned([piece], turn),
            (dice.between(-0.1, 0.1) * base, dice.between(-0.1, 0.1) * base, level + size[2] * 0.4),
        )
        level += float(size[2]) * 0.75
    return Rig(
        surface(pieces[:2], look), surface(pieces[2:], looks.metal(dice) if dice.chance(0.4) else look)
    ).bodies()


def _machine_housing(dice: Dice) -> list[Body]:
    """A closed case with vents, ribs, screws and printed panels, all of one piece."""
    width, depth, high = dice.between(0.2, 1.2), dice.between(0.2, 0.8), dice.between(0.2, 1.6)
    paint, dark, x, y = looks.painted_metal(dice), looks.plastic(dice), width / 2, depth / 2
    case = (
        box((width, depth, high), (0, 0, high / 2))
        if dice.chance(0.6)
        else prism(rounded(0.06), (width, depth, high)) + [0, 0, high / 2]
    )
    whole = Rig(surface([case], paint))
    low, up = sorted((dice.between(0.1, 0.9), dice.between(0.1, 0.9)))
    if up - low > 0.2:
        panel = front(dice, 0.85 * width, 0.8 * (up - low) * high, 0.01)
        whole.dress(0, surface(moved(panel, (0, -y, (up + low) / 2 * high)), looks.darker(paint, 0.9)))
    slots = dice.whole(3, 9)
    vents = boxes((0.5 * width, 0.008, 0.012), [(0, -y, (0.06 + 0.02 * k) * high) for k in range(slots)])
    ribs = boxes(
        (0.012, 0.7 * depth, 0.015),
        [(s * x, 0, z * high) for s in (-1, 1) for z in np.linspace(0.2, 0.8, dice.whole(2, 6))],
    )
    screws = at(
        lying(0.008, 0.006, 1, 8), [(s * 0.46 * width, -y, t * high) for s in (-1, 1) for t in (0.05, 0.95)]
    )
    whole.dress(0, surface([vents, ribs, *screws], dark))
    for _ in range(dice.whole(0, 4)):
        spot = (dice.between(-0.35, 0.35) * width, -y, dice.between(0.85, 0.93) * high)
        whole.dress(0, surface(moved(knob(dice, 0.03 * width), spot), looks.plastic(dice)))
    if dice.chance(0.4):
        whole.dress(0, surface(moved(handle(dice, 0.3 * width), (0, -y, 0.7 * high)), looks.metal(dice)))
    if dice.chance(0.4):
        whole.dress(0, surface(feet(dice, width, depth, 0.06), dark))
    return whole.bodies()


def _wall_panel(dice: Dice) -> list[Body]:
    """Wainscot, a radiator or a door leaf that is only painted on."""
    width, high, thick, look = (
        dice.between(0.5, 2.0),
        dice.between(0.4, 2.1),
        dice.between(0.02, 0.08),
        looks.wood(dice),
    )
    pieces = [box((width, thick, high), (0, thick / 2, high / 2))]
    if dice.chance(0.3):
        xs = np.linspace(-0.47, 0.47, dice.whole(6, 20)) * width
        pieces.append(boxes((0.6 * width / len(xs), 0.04, 0.9 * high), [(x, -0.02, high / 2) for x in xs]))
        return Rig(surface(pieces, looks.painted_metal(dice))).bodies()
    count = dice.whole(1, 4)
    for x in ((np.arange(count) + 0.5) / count - 0.5) * width:
        wide = 0.85 * width / count
        if dice.chance(0.5):
            pieces += moved(front(dice, wide, 0.85 * high, 0.02), (x, 0, high / 2))
        else:
            pieces += moved([frame(wide, 0.85 * high, 0.015, 0.03)], (x, 0, high / 2))
    pieces.append(box((width + 0.02, thick + 0.05, 0.06), (0, thick / 2, 0.03)))
    whole = Rig(surface(pieces, look))
    if dice.chance(0.4):
        whole.dress(
            0, surface(moved(handle(dice, 0.12), (0.3 * width / count, -0.02, 0.5 * high)), looks.metal(dice))
        )
    return whole.bodies()


def _bottle_group(dice: Dice) -> list[Body]:
    """Bottles, jars and cans on a base."""
    count, pitch = dice.whole(2, 6), dice.between(0.08, 0.11)
    base = box((count * pitch, 0.12, 0.01), (0, 0, 0.005))
    whole = Rig(surface([base], looks.wood(dice)))
    for k in range(count):
        radius, high = dice.between(0.3, 0.46) * pitch, dice.between(0.08, 0.32)
        neck, shoulder = dice.between(0.2, 0.9) * radius, dice.between(0.5, 0.85)
        line = [[0, 0], [radius, 0], [radius, shoulder * high], [neck, 0.88 * high], [neck, high], [0, high]]
        spot = ((k + 0.5 - count / 2) * pitch, dice.between(-0.01, 0.01), 0.0105)
        whole.dress(0, surface(moved([revolve(np.array(line), dice.pick((4, 8, 16)))], spot), stuff(dice)))
        if dice.chance(0.6):
            cap = cylinder(1.1 * neck, 0.02, 12) + [spot[0], spot[1], 0.0105 + high]
            whole.dress(0, surface([cap], looks.plastic(dice)))
    return whole.bodies()


def _block(dice: Dice, size: FloatArray) -> FloatArray:
    """A box, roll or roof about 0."""
    style = dice.unit()
    if style < 0.4:
        return box(size)
    if style < 0.8:
        return prism(ngon(14) if style < 0.6 else rounded(0.15), size)
    x, y, z = size.tolist()
    return loft(ngon(4), [(0, 0, -z / 2), (x, y, -z / 2), (0.2 * x, 0.2 * y, z / 2), (0, 0, z / 2)])


def _toy_blocks(dice: Dice) -> list[Body]:
    """Blocks, rolls and roofs, glued on top of each other."""
    edge, level = dice.between(0.03, 0.08), 0.0
    whole: Rig | None = None
    for _ in range(dice.whole(2, 6)):
        size = edge * (0.7 + 1.6 * dice.units(3)) * [1, 1, 0.6]
        form = _block(dice, size)
        yaw = rotation(UP, dice.pick((0.0, 0.0, dice.between(0, 1.5))))
        block = moved(
            turned([form], yaw),
            (dice.between(-0.2, 0.2) * edge, dice.between(-0.2, 0.2) * edge, level + size[2] / 2),
        )
        level += float(size[2])
        painted = surface(block, looks.wood(dice) if dice.chance(0.4) else looks.plastic(dice))
        if whole is None:
            whole = Rig(painted)
        else:
            whole.dress(0, painted)
    assert whole is not None
    return whole.bodies()


def _trophy(dice: Dice) -> list[Body]:
    radius, tall = dice.between(0.04, 0.1), dice.between(0.12, 0.45)
    foot = [box((2 * radius, 2 * radius, 0.3 * tall), (0, 0, 0.15 * tall))]
    if dice.chance(0.5):
        foot = [revolve(np.array([[0, 0], [1.1, 0], [1, 0.1], [0.8, 0.3], [0, 0.3]]) * [radius, tall], 16)]
    cup = np.array([[0.3, 0.3], [0.15, 0.42], [0.2, 0.5], [0.8, 0.65], [1.0, 1.0]]) * [radius, tall]
    pieces = [revolve(hollow(cup, 0.08 * radius), 18)]
    angle = np.linspace(-1.5, 1.5, 9)
    ear = np.column_stack(
        [radius * (0.85 + 0.5 * np.cos(angle)), 0 * angle, tall * (0.8 + 0.13 * np.sin(angle))]
    )
    if dice.chance(0.7):
        pieces += [tube(ear, 0.06 * radius + 0.001), tube(ear * [-1, 1, 1], 0.06 * radius + 0.001)]
    label = surface([box((radius, 0.003, 0.12 * tall), (0, -radius - 0.001, 0.15 * tall))], looks.metal(dice))
    return Rig(surface(foot, looks.wood(dice)), surface(pieces, looks.metal(dice)), label).bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("vase", _vase, moves=False),
    Category("tableware", _tableware, moves=False),
    Category("statue", _statue, moves=False),
    Category("machine_housing", _machine_housing, moves=False),
    Category("wall_panel", _wall_panel, moves=False),
    Category("bottle_group", _bottle_group, moves=False),
    Category("toy_blocks", _toy_blocks, moves=False),
    Category("trophy", _trophy, moves=False),
)
