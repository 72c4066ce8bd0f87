"""Cars with doors, lids and wheels, real or toys."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, rod
from . import looks
from .category import Category
from .objects import Body, Look, hinge, surface
from .rigging import DOWN, LEFT, RIGHT, UP, Rig, profile
from .vehicle_parts import Shell, sheet_between, size_of, steering, wheels


def _car(dice: Dice) -> list[Body]:
    long, wide, tall = dice.between(3.4, 4.8), dice.between(1.5, 1.9), dice.between(1.3, 1.75)
    sill, belt = dice.between(0.25, 0.35), dice.between(0.8, 0.95)
    first = -long * dice.between(0.17, 0.24)
    middle = first + dice.between(0.95, 1.15)
    hatch = dice.chance(0.5)
    last = min(middle + dice.between(0.7, 0.95), long * (0.4 if hatch else 0.28))
    car = Shell(long, wide, tall, sill, belt, (first, middle, last))
    paint = looks.painted_metal(dice)
    whole = Rig(surface(_fenders(car), paint), surface(_insides(car), looks.plastic(dice)), label="body")
    _roof(whole, car, paint, looks.glass(dice), hatch)
    _car_doors(dice, whole, car, paint)
    _bonnet(dice, whole, car, paint)
    _boot(dice, whole, car, paint, hatch)
    wheels(dice, whole, car, (first - 0.25 * long * 0.5, last + 0.12 * long), dice.chance(0.4))
    if dice.chance(0.5):
        steering(whole, np.array([-0.2 * wide, first + 0.3, belt]), looks.rubber(dice))
    return whole.bodies(scale=size_of(dice))


def _fenders(car: Shell) -> Pieces:
    """Engine bay, floor, and what is behind the doors."""
    x, nose, tail = car.wide / 2, -car.long / 2, car.long / 2
    first, _, last = car.posts
    skin, front = 0.04, car.belt - 0.1
    pieces = [between((-x, nose, car.sill), (x, tail, car.sill + 0.05))]
    for s in (-1, 1):
        pieces.append(
            box(
                (skin, first - nose, front - car.sill),
                (s * (x - skin / 2), (first + nose) / 2, (front + car.sill) / 2),
            )
        )
        pieces.append(
            box(
                (skin, tail - last, car.belt - car.sill),
                (s * (x - skin / 2), (tail + last) / 2, (car.belt + car.sill) / 2),
            )
        )
    pieces.append(between((-x, nose, car.sill), (x, nose + skin, front)))
    pieces.append(between((-x, tail - skin, car.sill), (x, tail, car.belt - 0.1)))
    pieces.append(between((-x + 0.05, first - skin, car.sill), (x - 0.05, first, car.belt)))
    pieces += [
        between((s * x * 0.6 - 0.12, nose - 0.02, front - 0.22), (s * x * 0.6 + 0.12, nose, front - 0.08))
        for s in (-1, 1)
    ]
    pieces += [
        between((-x - 0.01, e - 0.05, car.sill), (x + 0.01, e + 0.05, car.sill + 0.15)) for e in (nose, tail)
    ]
    return pieces


def _insides(car: Shell) -> Pieces:
    """Seats and dashboard."""
    first, middle, last = car.posts
    x, pieces = 0.22 * car.wide, []
    for y in (middle - 0.3, last - 0.25):
        for s in (-1, 1):
            pieces.append(box((0.45, 0.45, 0.25), (s * x, y, car.sill + 0.2)))
            pieces.append(box((0.45, 0.1, 0.55), (s * x, y + 0.24, car.sill + 0.5)))
    pieces.append(box((0.85 * car.wide, 0.2, 0.25), (0, first + 0.11, car.belt - 0.15)))
    return pieces


def _roof(whole: Rig, car: Shell, paint: Look, glass: Look, hatch: bool) -> None:
    first, middle, last = car.posts
    x, top = car.wide / 2 - 0.02, car.wide / 2 - 0.14
    head, tail = first + 0.45, min(last + (0.3 if hatch else 0.0), car.long / 2 - 0.25)
    foot = car.long / 2 - 0.06 if hatch else tail + 0.4
    pieces = [between((-top, head, car.tall - 0.04), (top, tail, car.tall))]
    for s in (-1, 1):
        pieces.append(rod((s * x, first + 0.02, car.belt), (s * top, head, car.tall - 0.02), 0.03))
        pieces.append(rod((s * (x - 0.06), middle, car.sill), (s * top, middle, car.tall - 0.02), 0.025))
        pieces.append(
            rod((s * x, min(foot, car.long / 2 - 0.05), car.belt), (s * top, tail, car.tall - 0.02), 0.035)
        )
    whole.dress(0, surface(pieces, paint))
    low = np.array([[-x, first, car.belt], [x, first, car.belt]])
    high = np.array([[-top, head, car.tall - 0.03], [top, head, car.tall - 0.03]])
    whole.dress(0, surface([sheet_between(low, high)], glass))
    if not hatch:
        low, high = low * [1, 0, 1] + [0, foot, 0], high * [1, 0, 1] + [0, tail, 0]
        whole.dress(0, surface([sheet_between(low, high)], glass))


def _car_doors(dice: Dice, whole: Rig, car: Shell, paint: Look) -> None:
    """Four doors, or two where there is no room for those behind."""
    first, middle, last = car.posts
    glass, metal = looks.glass(dice), looks.metal(dice)
    handle_z, framed = car.belt - 0.12, dice.chance(0.7)
    for name, s in (("left", -1), ("right", 1)):
        for place, a, b in (("front", first, middle), ("rear", middle, last)):
            if b - a < 0.3:
                continue
            x, gap = s * (car.wide / 2 - 0.02), 0.004
            size, mid = b - a - 2 * gap, (a + b) / 2
            panel: Pieces = [
                box((0.04, size, car.belt - car.sill - 0.06), (x, mid, (car.belt + car.sill) / 2 + 0.03))
            ]
            panel.append(box((0.03, 0.16, 0.03), (x + s * 0.03, b - 0.2, handle_z)))
            lean = rotation((0, s * -1.0, 0), 0.22)
            high = car.tall - car.belt - 0.09
            inner = [a + 0.02, a + (0.42 if place == "front" else 0.02), b - 0.03, b - 0.02]
            pane = profile([[inner[0], 0], [inner[3], 0], [inner[2], high], [inner[1], high]], 0.012)
            window = moved(turned([pane], lean), (x, 0, car.belt))
            surfaces = [surface(panel, paint), surface(window, glass)]
            if framed:
                bars = [
                    rod((0, p, 0), (0, q, high), 0.015, 4)
                    for p, q in ((inner[0], inner[1]), (inner[3], inner[2]))
                ]
                bars.append(rod((0, inner[1], high), (0, inner[2], high), 0.015, 4))
                surfaces.append(surface(moved(turned(bars, lean), (x, 0, car.belt)), paint))
            if place == "front":
                surfaces.append(
                    surface([box((0.16, 0.08, 0.12), (x + s * 0.1, a + 0.2, car.belt + 0.08))], metal)
                )
            axis = UP if s < 0 else DOWN
            whole.add(
                "door",
                hinge((x + s * 0.015, a + gap, car.belt), axis, dice.between(0.9, 1.3)),
                *surfaces,
                name=f"{name}_{place}_door",
            )


def _bonnet(dice: Dice, whole: Rig, car: Shell, paint: Look) -> None:
    nose, first, x = -car.long / 2, car.posts[0], car.wide / 2
    front, drop = car.belt - 0.1, dice.between(0.0, 0.1)
    pane = profile(
        [
            [nose + 0.005, 0.003 - 0],
            [first - 0.01, 0.003],
            [first - 0.01, 0.08],
            [nose + 0.005 + drop, 0.045],
        ],
        car.wide - 0.01,
    )
    pieces = surface([pane + [0, 0, front]], paint)
    whole.dress(
        0,
        surface(
            [box((x, 0.5 * (first - nose), 0.25), (0, (first + nose) / 2, front - 0.3))], looks.metal(dice)
        ),
    )
    rear = dice.chance(0.85)
    pin = (0, first - 0.01 if rear else nose + 0.01, front + 0.05)
    whole.add("bonnet", hinge(pin, LEFT if rear else RIGHT, dice.between(0.7, 1.1)), pieces)


def _boot(dice: Dice, whole: Rig, car: Shell, paint: Look, hatch: bool) -> None:
    last, tail, x = car.posts[2], car.long / 2, car.wide / 2 - 0.05
    if not hatch:
        fore = min(last + 0.42, tail - 0.3)
        lid = [box((car.wide - 0.1, tail - fore, 0.035), (0, (tail + fore) / 2, car.belt + 0.022))]
        lid.append(box((car.wide - 0.1, 0.03, 0.11), (0, tail + 0.02, car.belt - 0.03)))
        whole.add(
            "boot lid", hinge((0, fore, car.belt + 0.03), RIGHT, dice.between(0.8, 1.3)), surface(lid, paint)
        )
        return
    top, edge = car.tall - 0.02, min(last + 0.3, tail - 0.25)
    low = np.array([[-x, tail + 0.012, car.belt], [x, tail + 0.012, car.belt]])
    high = np.array([[-x + 0.1, edge + 0.03, top], [x - 0.1, edge + 0.03, top]])
    pane = surface([sheet_between(low, high)], looks.glass(dice))
    panel = box((2 * x, 0.03, car.belt - car.sill - 0.2), (0, tail + 0.018, (car.belt + car.sill + 0.2) / 2))
    bars = [rod(low[k], high[k], 0.025) for k in (0, 1)] + [rod(high[0], high[1], 0.025)]
    whole.add(
        "tailgate",
        hinge((0, edge + 0.03, top), RIGHT, dice.between(1.0, 1.5)),
        surface([panel, *bars], paint),
        pane,
    )


CATEGORIES: tuple[Category, ...] = (Category("car", _car),)
