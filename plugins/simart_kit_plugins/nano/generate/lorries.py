"""Vans, lorries and trailers, real or toys."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.placing import moved
from ...shapes.primitives import between, box, boxes, open_box, rod
from . import looks
from .category import Category
from .objects import Body, Look, hinge, slide, spin, surface
from .rigging import BACK, DOWN, LEFT, RIGHT, UP, Rig, lying, profile
from .vehicle_parts import Shell, sheet_between, size_of, steering, wheels


def _van(dice: Dice) -> list[Body]:
    """A box with cab doors, a sliding door, and doors or a gate behind."""
    long, wide, tall = dice.between(4.2, 5.6), dice.between(1.7, 2.0), dice.between(1.8, 2.4)
    sill, paint, glass = dice.between(0.3, 0.4), looks.painted_metal(dice), looks.glass(dice)
    x, nose, tail, skin = wide / 2, -long / 2, long / 2, 0.05
    first = nose + dice.between(0.75, 1.15)  # behind the wheels, which doors would swing into
    middle = first + dice.between(0.95, 1.15)
    last, belt = middle + dice.between(1.0, 1.3), 1.05
    car = Shell(long, wide, tall, sill, belt, (first, middle, last))
    pieces = [
        between((-x, nose, sill), (x, tail, sill + 0.06)),
        between((-x, first + 0.5, tall - skin), (x, tail, tall)),
    ]
    pieces.append(between((-x, nose, sill), (x, first, belt)))
    slides = dice.pick(((), (1,), (-1,), (-1, 1)))
    for s in (-1, 1):
        begin = last if s in slides else middle
        side = s * (x - skin / 2)
        pieces.append(
            box((skin, tail - begin, tall - sill - 0.06), (side, (tail + begin) / 2, (tall + sill) / 2))
        )
        pieces.append(box((skin, last - middle + 0.1, 0.12), (side, (last + middle) / 2, tall - 0.1)))
        pieces.append(rod((s * (x - 0.03), first, belt), (s * (x - 0.03), first + 0.5, tall - 0.03), 0.04))
        pieces.append(box((skin, 0.07, tall - sill), (side, middle, (tall + sill) / 2)))
    low = np.array([[-x + 0.03, first - 0.01, belt], [x - 0.03, first - 0.01, belt]])
    screen = sheet_between(low, low + [0, 0.5, tall - belt - 0.02])
    whole = Rig(surface(pieces, paint), surface([screen], glass), label="body")
    for name, s in (("left", -1), ("right", 1)):
        _cab_door(dice, whole, car, (name, s), paint, glass)
    for s in slides:
        door = [
            box(
                (0.05, last - middle + 0.06, tall - sill - 0.2),
                (s * (x + 0.032), (last + middle) / 2, (tall + sill) / 2 - 0.02),
            )
        ]
        door.append(box((0.03, 0.04, 0.2), (s * (x + 0.07), middle + 0.1, 1.0)))
        pane = box((0.056, 0.6 * (last - middle), 0.4), (s * (x + 0.034), (last + middle) / 2, tall - 0.55))
        travel = min(last - middle, tail - last) - 0.02
        whole.add("sliding door", slide(BACK, travel), surface(door, paint), surface([pane], glass))
    _van_back(dice, whole, car, paint)
    wheels(dice, whole, car, (first - 0.58, tail - 0.2 * long), False)
    if dice.chance(0.5):
        steering(whole, np.array([-0.25 * wide, first + 0.35, belt + 0.05]), looks.rubber(dice))
    return whole.bodies(scale=size_of(dice))


def _cab_door(dice: Dice, whole: Rig, car: Shell, side: tuple[str, int], paint: Look, glass: Look) -> None:
    """A door behind the A post, with a window."""
    (name, s), (first, middle, _) = side, car.posts
    x, a, b = s * (car.wide / 2 - 0.025), first + 0.005, middle - 0.04
    corners = [
        [a, car.sill + 0.07],
        [b, car.sill + 0.07],
        [b, car.tall - 0.08],
        [a + 0.5, car.tall - 0.08],
        [a, car.belt],
    ]
    leaf = [
        profile(corners, 0.05) + [x, 0, 0],
        box((0.03, 0.15, 0.03), (x + s * 0.04, b - 0.15, car.belt - 0.08)),
    ]
    pane = profile(
        [[a + 0.12, car.belt], [b - 0.08, car.belt], [b - 0.08, car.tall - 0.18], [a + 0.5, car.tall - 0.18]],
        0.056,
    )
    mirror = box((0.16, 0.08, 0.25), (x + s * 0.12, a + 0.1, car.belt + 0.12))
    whole.add(
        "door",
        hinge((x + s * 0.02, a, car.belt), UP if s < 0 else DOWN, dice.between(0.9, 1.3)),
        surface([*leaf, mirror], paint),
        surface([pane + [x, 0, 0]], glass),
        name=f"{name}_door",
    )


def _van_back(dice: Dice, whole: Rig, car: Shell, paint: Look) -> None:
    """One gate hinged above, or two doors."""
    y, low, high, inner = car.long / 2 + 0.022, car.sill + 0.02, car.tall - 0.06, car.wide - 0.02
    tall, level = high - low, (high + low) / 2
    if dice.chance(0.4):
        gate = box((inner, 0.04, tall), (0, y, level))
        whole.add("tailgate", hinge((0, y, high), RIGHT, 1.5), surface([gate], paint))
        return
    for name, s in (("left", -1), ("right", 1)):
        leaf = [box((inner / 2 - 0.004, 0.04, tall), (s * (inner / 4 + 0.001), y, level))]
        leaf.append(box((0.04, 0.05, 0.3), (s * 0.1, y + 0.03, level)))
        axis = UP if s < 0 else DOWN
        pin = (s * inner / 2, y, level)
        whole.add(
            "rear door",
            hinge(pin, axis, dice.between(1.4, 2.4)),
            surface(leaf, paint),
            name=f"{name}_rear_door",
        )


def _truck(dice: Dice) -> list[Body]:
    """A cab, which may tilt, and a bed that tips, with gates."""
    long, wide, sill = dice.between(4.5, 5.7), dice.between(1.9, 2.3), dice.between(0.6, 0.8)
    tall, paint, dark = dice.between(2.1, 2.7), looks.painted_metal(dice), looks.metal(dice)
    x, nose, tail = wide / 2, -long / 2, long / 2
    cab = nose + dice.between(1.2, 1.7)
    rails = boxes((0.12, long - 0.3, 0.16), [(s * 0.3 * wide, 0.1, sill - 0.1) for s in (-1, 1)])
    whole = Rig(
        surface([rails, between((-x, nose + 0.1, sill - 0.3), (x, nose + 0.25, sill - 0.05))], dark),
        label="chassis",
    )
    car = Shell(long, wide, tall, sill, sill + 0.6 * (tall - sill), (nose + 0.3, cab - 0.02, cab))
    _cab(dice, whole, car, paint)
    high, wall, floor = dice.between(0.35, 1.0), 0.05, sill + 0.06
    bed_long = tail - cab - 0.08
    pieces = [
        between((-x, cab + 0.08, floor), (x, tail, floor + wall)),
        between((-x, cab + 0.08, floor), (x, cab + 0.08 + wall, floor + high * 1.1)),
    ]
    side = box(
        (wall, bed_long - 2 * wall - 0.01, high - wall), (0, (tail + cab + 0.08) / 2, floor + wall + high / 2)
    )
    rear = (0, tail - 0.1, floor)
    bed = whole.add("tipper bed", hinge(rear, LEFT, dice.between(0.7, 1.0)), surface(pieces, paint))
    for name, s in (("left", -1), ("right", 1)):
        pin = (s * x, 0, floor + wall + 0.01)
        leaf = surface(moved([side], (s * (x - wall / 2), 0, 0.005)), paint)
        whole.add("side gate", hinge(pin, (0, s, 0), 2.8), leaf, parent=bed, name=f"{name}_side_gate")
    gate = box(
        (wide - 0.02 - 2 * wall, wall, high - wall - 0.01), (0, tail - wall / 2, floor + wall + high / 2)
    )
    above = dice.chance(0.5)
    pin_at = np.array([0, tail - wall / 2, floor + (high if above else wall)])
    whole.add(
        "tailgate",
        hinge(pin_at, RIGHT if above else LEFT, dice.between(1.0, 1.6)),
        surface([gate], paint),
        parent=bed,
    )
    rows = (nose + 0.7, tail - 0.9) if dice.chance(0.6) else (nose + 0.7, tail - 1.45, tail - 0.6)
    wheels(dice, whole, Shell(long, wide - 0.5, 2.0, sill - 0.25, 1, car.posts), rows, False)
    return whole.bodies(scale=size_of(dice))


def _cab(dice: Dice, whole: Rig, car: Shell, paint: Look) -> None:
    x, nose, back, skin = car.wide / 2, -car.long / 2, car.posts[2], 0.05
    pieces = [
        between((-x, nose, car.sill), (x, back, car.sill + 0.08)),
        between((-x, nose + 0.1, car.tall - skin), (x, back, car.tall)),
        between((-x, back - skin, car.sill), (x, back, car.tall)),
        between((-x, nose, car.sill), (x, nose + skin, car.belt)),
    ]
    pieces += [
        box((skin, 0.3, car.tall - car.sill), (s * (x - skin / 2), nose + 0.15, (car.tall + car.sill) / 2))
        for s in (-1, 1)
    ]
    pieces.append(moved([frame(car.wide - 0.1, 0.3, 0.03, 0.05)], (0, nose, car.sill + 0.3))[0])
    pane = box(
        (car.wide - 0.1, 0.02, car.tall - car.belt - skin), (0, nose + 0.04, (car.tall + car.belt - skin) / 2)
    )
    surfaces = (surface(pieces, paint), surface([pane], looks.glass(dice)))
    cab = whole.add("cab", hinge((0, nose + 0.05, car.sill), RIGHT, 0.9), *surfaces)
    for name, s in (("left", -1), ("right", 1)):
        a, b = nose + 0.305, back - skin - 0.005
        leaf = [
            box(
                (0.045, b - a, car.tall - car.sill - 0.14),
                (s * (x - 0.023), (a + b) / 2, (car.tall + car.sill) / 2),
            )
        ]
        leaf.append(box((0.03, 0.15, 0.03), (s * (x + 0.015), b - 0.15, car.belt - 0.1)))
        pane = box(
            (0.05, 0.7 * (b - a), 0.6 * (car.tall - car.belt)),
            (s * (x - 0.023), (a + b) / 2, (car.tall + car.belt) / 2 - 0.03),
        )
        whole.add(
            "door",
            hinge((s * x, a, car.belt), UP if s < 0 else DOWN, 1.2),
            surface(leaf, paint),
            surface([pane], looks.glass(dice)),
            parent=cab,
            name=f"{name}_door",
        )


def _trailer(dice: Dice) -> list[Body]:
    """An open box on two wheels with a gate and a jockey wheel."""
    width, long, high = dice.between(0.9, 1.5), dice.between(1.3, 2.4), dice.between(0.25, 0.6)
    look, metal, level = looks.painted_metal(dice), looks.metal(dice), dice.between(0.4, 0.55)
    wall, x, y = 0.025, width / 2, long / 2
    tub = open_box((width, long, high), wall) + [0, 0, level]
    bar = [rod((s * 0.4 * x, -y, level), (0, -y - 0.8, level), 0.03) for s in (-1, 1)]
    whole = Rig(surface([tub], look), surface(bar, metal))
    gate = box((width - 0.1, wall, high - 0.05), (0, y + 0.02, level + high / 2 + 0.02))
    below = (0, y + 0.02, level + 0.045)
    whole.add("tailgate", hinge(below, LEFT, dice.between(1.5, 3.0)), surface([gate], look))
    wheels(dice, whole, Shell(long, width, 1.3, level - 0.1, 1, (0, 0, 0)), (0.1 * y,), False)
    if dice.chance(0.6):
        spot = np.array([0.09, -y - 0.5, level])
        leg = whole.add(
            "jockey leg", slide(UP, 0.2), surface([rod(spot, spot - [0, 0, level - 0.16], 0.02)], metal)
        )
        hub = spot - [0, 0, level - 0.1]
        whole.add(
            "jockey wheel",
            spin(hub, RIGHT),
            surface([lying(0.09, 0.05) + hub], looks.rubber(dice)),
            parent=leg,
        )
    if dice.chance(0.4):
        cover = box((width + 0.02, long + 0.02, 0.03), (0, 0, level + high + 0.02))
        whole.add("lid", hinge((-x, 0, level + high), (0, -1, 0), 1.4), surface([cover], looks.plastic(dice)))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("van", _van),
    Category("truck", _truck),
    Category("trailer", _trailer),
)
