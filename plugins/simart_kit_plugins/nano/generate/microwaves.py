"""Microwaves and dishwashers."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame, slab
from ...shapes.legs import feet
from ...shapes.outlines import ngon
from ...shapes.placing import around, at, moved
from ...shapes.primitives import Pieces, between, box, cylinder, open_box, vessel
from . import looks
from .assembling import PAD, Assembly, dial, fall, holder, press, pull, rack, shell, swing, turning
from .category import Category
from .objects import Body, Look, free, spin


def _microwave(dice: Dice) -> list[Body]:
    width, depth, height = dice.between(0.4, 0.62), dice.between(0.3, 0.45), dice.between(0.22, 0.4)
    wall, thick = dice.between(0.01, 0.03), dice.between(0.012, 0.04)
    share = dice.between(0.66, 0.82) if dice.chance(0.85) else 1.0
    coat, kit = looks.painted_metal(dice), Assembly("case")
    flip = 1 if dice.chance(0.8) else -1
    room = share * width
    mid = -flip * (1 - share) * width / 2
    band = 0.0 if share < 1 else height * 0.18
    kit.fix([shell(room, depth, height - band, wall) + [mid, 0, 0]], coat)
    kit.fix(
        [
            shell(room - 2 * wall - 0.002, depth - wall, height - band - 2 * wall - 0.002, 0.003)
            + [mid, -wall / 2, wall + 0.001]
        ],
        Look("steel", (210, 212, 215)),
    )
    kit.fix(feet(dice, width * 0.9, depth * 0.9, 0.012), looks.rubber(dice))
    front = -depth / 2 - thick
    if band:
        low, high = (-width / 2, front, height - band), (width / 2, depth / 2, height)
    else:
        low, high = sorted_corners(
            flip * (room - width / 2), flip * width / 2, (front, depth / 2), (0, height)
        )
    kit.fix([between(low, high)], coat)
    _microwave_door(dice, kit, (room, height - band), (mid, -depth / 2), (thick, -flip), coat)
    if band:
        _pad(dice, kit, (low[0], high[0]), (height - band, height), front, dice.chance(0.5))
    else:
        _pad(dice, kit, (low[0], high[0]), (0, height), front, True)
    if dice.chance(0.85):
        _turntable(dice, kit, 0.43 * min(room - 2 * wall, depth - wall), (mid, 0, wall + 0.009))
    return kit.done()


def sorted_corners(
    a: float, b: float, along: tuple[float, float], up: tuple[float, float]
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """The low and the high corner of a box between two x, in either order."""
    return (min(a, b), along[0], up[0]), (max(a, b), along[1], up[1])


def _turntable(dice: Dice, kit: Assembly, radius: float, place: tuple[float, float, float]) -> None:
    plate = vessel(ngon(20), (1.7 * radius, 1.7 * radius, 0.014), 0.004, 1.15)
    star = around([box((radius, 0.012, 0.004), (radius / 2, 0, -0.001))], 3) if dice.chance(0.5) else []
    look = looks.glass(dice) if dice.chance(0.7) else looks.ceramic(dice)
    shape = moved([plate, *moved(star, (0, 0, 0))], place)
    kit.add("turntable", spin(place, (0, 0, 1)), [(shape, look)])


def _microwave_door(
    dice: Dice,
    kit: Assembly,
    size: tuple[float, float],
    at_: tuple[float, float],
    make: tuple[float, int],
    coat: Look,
) -> None:
    width, height = size[0] - 0.003, size[1] - 0.003
    thick, side = make
    border = dice.between(0.1, 0.2) * height
    y = at_[1] - 0.002
    place = (at_[0], y, size[1] / 2)
    pane = box((width - 2 * border, thick * 0.5, height - 2 * border), (0, -thick / 2, 0))
    parts: list[tuple[Pieces, Look]] = [
        ([frame(width, height, thick, border)], coat),
        ([pane], looks.glass(dice)),
    ]
    below = dice.chance(0.12)
    if dice.chance(0.75):
        if below:
            grip = moved(holder(dice, width * 0.6), (0, -thick, height / 2 - border / 2))
        else:
            grip = moved(
                holder(dice, height * dice.between(0.4, 0.9), upright=True),
                (-side * (width / 2 - border / 2), -thick, 0),
            )
        parts.append((grip, looks.metal(dice)))
    motion = (
        fall(y, 0.0015, 1.5)
        if below
        else swing(side, at_[0] + side * width / 2, y, dice.between(1.5, 2.0), place[2])
    )
    kit.add("door", motion, [(moved(pieces, place), look) for pieces, look in parts])


def _pad(
    dice: Dice,
    kit: Assembly,
    across: tuple[float, float],
    up: tuple[float, float],
    front: float,
    knobs: bool,
) -> None:
    """Keys and knobs of a microwave."""
    middle, wide, high = (across[0] + across[1]) / 2, across[1] - across[0], up[1] - up[0]
    screen = box((wide * 0.7, 0.003, high * 0.12), (middle, front - 0.0015, up[1] - 0.14 * high))
    kit.fix([screen], looks.glass(dice))
    look = looks.plastic(dice)
    if knobs and dice.chance(0.5):
        count = dice.whole(1, 2)
        radius = min(0.32 * wide, 0.16 * high, 0.03)
        seed = dice.whole(0, 2**31)
        for k in range(count):
            spot = (middle, front, up[0] + high * (0.25 + 0.33 * k))
            shape = moved(dial(Dice(seed), radius), spot)
            kit.add("knob", turning(Dice(seed + 1), spot), [(shape, look)])
        return
    rows, columns = dice.whole(2, 5), dice.whole(2, 3)
    moves = dice.chance(0.6)
    thick = 0.006 if moves else PAD
    key = np.array([0.7 * wide / columns, thick, 0.6 * high / rows])
    for row in range(rows):
        for column in range(columns):
            x = middle + (column - (columns - 1) / 2) * key[0] * 1.1
            shape = [
                box(
                    key * [0.8, 1, 0.75],
                    (x, front - thick / 2, up[0] + 0.06 * high + (row + 0.5) * key[2] * 1.1),
                )
            ]
            if moves:
                kit.add("button", press(0.002), [(shape, look)])
            else:
                kit.fix(shape, look)


def _dishwasher(dice: Dice) -> list[Body]:
    width, depth, height = dice.between(0.42, 0.65), dice.between(0.5, 0.65), dice.between(0.45, 0.88)
    wall, thick, plinth = dice.between(0.012, 0.03), dice.between(0.015, 0.06), dice.between(0.04, 0.12)
    coat, metal, kit = looks.painted_metal(dice), looks.metal(dice), Assembly("case")
    kit.fix([shell(width, depth, height, wall) + [0, 0, plinth]], coat)
    if dice.chance(0.6):
        lining = shell(width - 2 * wall - 0.006, depth - wall - 0.01, height - 2 * wall - 0.006, 0.003)
        kit.fix([lining + [0, -wall / 2, plinth + wall + 0.003]], metal)
    kit.fix(
        [between((-width / 2, -depth / 2 + 0.06, 0), (width / 2, depth / 2, plinth))], looks.darker(coat, 0.5)
    )
    if dice.chance(0.3):
        kit.fix(
            [box((width * 1.02, depth * 1.05, 0.025), (0, 0, plinth + height + 0.0125))], looks.wood(dice)
        )
    inside, room = (width - 2 * wall - 0.03, depth - wall - 0.05), height - 2 * wall
    # Racks are clear of what stands off the door's inside, and of the lining at the back.
    middle = (0.018 - wall) / 2
    count, floor = dice.whole(1, 2), plinth + wall
    for k in range(count):
        level = floor + room * (0.1 + 0.5 * k)
        rise = room * dice.between(0.15, 0.3)
        _basket(dice, kit, inside, (middle, level), min(rise, room * (0.9 - 0.5 * k) - 0.09))
        if dice.chance(0.5):
            _arm(dice, kit, 0.42 * min(inside), level - 0.025 - 0.01 * k, k > 0)
    if count == 2 and dice.chance(0.3):
        _basket(dice, kit, inside, (middle, plinth + height - wall - 0.06), 0.02)
    _dish_door(dice, kit, (width, height, wall), (thick, -depth / 2 - 0.003, plinth), coat)
    return kit.done()


def _basket(
    dice: Dice, kit: Assembly, inside: tuple[float, float], place: tuple[float, float], rise: float
) -> None:
    """A rack about a place (y, z) that slides out, some with a basket for cutlery in it."""
    middle, level = place
    shape = moved(rack(dice, *inside, rise), (0, middle, level))
    number = kit.add("rack", pull(inside[1] * dice.between(0.7, 0.95)), [(shape, looks.metal(dice))])
    if rise > 0.05 and dice.chance(0.3):
        size = (dice.between(0.08, 0.14), dice.between(0.15, 0.24), rise * 0.9)
        spot = (dice.sign() * (inside[0] / 2 - size[0] / 2 - 0.01), middle, level + 0.006)
        tub = moved([open_box(size, 0.004)], spot)
        cross = box((size[0], 0.004, size[2]), (spot[0], middle, level + size[2] / 2 + 0.006))
        kit.add("cutlery basket", free(), [([*tub, cross], looks.plastic(dice))], number)


def _arm(dice: Dice, kit: Assembly, reach: float, level: float, below: bool) -> None:
    """A spray arm that spins about its middle."""
    blade = [box((2 * reach, 0.04, 0.012)), cylinder(0.03, 0.02, 12)]
    blade += at(
        cylinder(0.005, 0.016, 6),
        [(x, 0.008, 0) for x in (-0.7 * reach, -0.4 * reach, 0.4 * reach, 0.7 * reach)],
    )
    look = looks.plastic(dice)
    kit.add("spray arm", spin((0, 0, level), (0, 0, 1)), [(moved(blade, (0, 0, level)), look)])
    if not below:
        kit.fix([cylinder(0.012, 0.03, 8) + [0, 0, level - 0.015]], look)


def _dish_door(
    dice: Dice,
    kit: Assembly,
    size: tuple[float, float, float],
    place: tuple[float, float, float],
    coat: Look,
) -> None:
    width, height, wall = size
    thick, y, low = place
    face = slab(dice, width - 0.004, height - 0.004, thick)
    parts: list[tuple[Pieces, Look]] = [(face, coat if dice.chance(0.6) else looks.wood(dice))]
    inner = box((width - 2.6 * wall, 0.02, height - 2.6 * wall), (0, 0.0101, 0))
    parts.append(([inner], looks.metal(dice)))
    if dice.chance(0.5):
        dose = box((0.15, 0.008, 0.1), (dice.between(-0.1, 0.1), 0.024, 0))
        parts.append(([dose], looks.plastic(dice)))
    if dice.chance(0.75):
        grip = holder(dice, width * dice.between(0.3, 0.85))
        parts.append((moved(grip, (0, -thick, height * dice.between(0.36, 0.45))), looks.metal(dice)))
    if dice.chance(0.5):
        band = box((width - 0.004, 0.006, height * 0.1), (0, -thick - 0.003, height * 0.44))
        parts.append(([band], looks.darker(coat, 0.4)))
    spot = (0, y, low + height / 2)
    kit.add(
        "door",
        fall(y, low + 0.002, dice.between(1.4, 1.57)),
        [(moved(pieces, spot), look) for pieces, look in parts],
    )


CATEGORIES: tuple[Category, ...] = (
    Category("microwave", _microwave),
    Category("dishwasher", _dishwasher),
)
