"""Appliances: double-skinned shells with doors, racks, drums, dials and vents."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.handles import knob
from ....shapes.legs import feet
from ....shapes.outlines import ngon, rounded
from ....shapes.placing import Y, at, moved, pointed, rotation, turned
from ....shapes.primitives import (
    Pieces,
    between,
    box,
    cylinder,
    loft,
    open_box,
    prism,
    rod,
    torus,
    tube,
    vessel,
)
from ....shapes.walls import pierced
from .leaves import Opening, Style, door, drawer, flap


def appliance(dice: Dice) -> list[Pieces]:
    """The body first, then doors, racks and dials."""
    make = dice.weighted(
        [(3, _fridge), (3, _oven), (2, _dishwasher), (3, _microwave), (3, _washer), (1, _hood)]
    )
    return make(dice)


def shell(size: tuple[float, float, float], wall: float) -> FloatArray:
    """An open box that stands on z = 0, its mouth at y = -depth / 2."""
    width, depth, height = size
    turn = rotation((1, 0, 0), np.pi / 2)
    return turned([open_box((width, height, depth), wall)], turn)[0] + [0, depth / 2, height / 2]


def rack(dice: Dice, width: float, depth: float, height: float) -> Pieces:
    """A basket of wires or a plain grate, its floor at z = 0."""
    wire = min(width, depth) * dice.between(0.006, 0.02)
    along = np.linspace(-width / 2, width / 2, dice.whole(4, 14))
    across = np.linspace(-depth / 2, depth / 2, dice.whole(2, 8))
    rise = height if dice.chance(0.6) else 0.0
    tine = height * dice.between(0.3, 0.8) if dice.chance(0.4) else 0.0
    pieces = at(box((wire, depth, wire)), [(x, 0, 0) for x in along])
    pieces += at(box((width, wire, wire)), [(0, y, 0) for y in across])
    if rise:
        pieces += at(box((wire, wire, rise)), [(x, y, rise / 2) for x in along for y in across[[0, -1]]])
        rim = [(0, s * depth / 2, rise) for s in (-1, 1)]
        pieces += at(box((width, wire, wire)), rim)
        pieces += at(box((wire, depth, wire)), [(s * width / 2, 0, rise) for s in (-1, 1)])
    if tine and len(across) > 2:
        pieces += at(box((wire, wire, tine)), [(x, y, tine / 2) for x in along for y in across[1:-1]])
    return pieces


def dials(dice: Dice, width: float, radius: float, count: int) -> list[Pieces]:
    """Knobs in a row along x on the plane y = 0, each a part of its own or all one."""
    row = [moved(knob(dice, radius), (x, 0, 0)) for x in np.linspace(-0.5, 0.5, count + 2)[1:-1] * width]
    return row if dice.chance(0.6) else [[piece for one in row for piece in one]]


def _fridge(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.5, 1.0), dice.between(0.5, 0.8), dice.between(0.8, 2.0)
    wall = dice.between(0.03, 0.06)
    style = Style.random(dice, wall)
    share = dice.pick((0.0, 0.3, 0.4, 0.6, 0.7)) * height
    lows_highs = [(0.0, share), (share, height)] if share else [(0.0, height)]
    body: Pieces = []
    leaves: list[Pieces] = []
    side = dice.sign()
    for low, high in lows_highs:
        tall = high - low
        body += moved([shell((width, depth, tall), wall)], (0, 0, low))
        opening = Opening(width - 0.006, tall - 0.006, depth - wall)
        place = np.array([0, -depth / 2, (low + high) / 2])
        levels = np.linspace(low, high, dice.whole(1, 4) + 2)[1:-1]
        body += at(box((width - 2 * wall, depth * 0.7, 0.01)), [(0, depth * 0.08, z) for z in levels])
        if width > 0.75 and dice.chance(0.6):
            half = Opening(opening.width / 2, opening.height, opening.depth)
            leaves += [moved(door(dice, half, style, s), place + [s * width / 4, 0, 0]) for s in (-1, 1)]
        elif tall < 0.5 * height and dice.chance(0.5):
            leaves.append(moved(drawer(dice, opening, style), place))
        else:
            leaves.append(moved(door(dice, opening, style, side), place))
    if dice.chance(0.5):
        body += feet(dice, width, depth, 0.04)
    return [body, *leaves]


def _oven(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.5, 0.9), dice.between(0.5, 0.65), dice.between(0.6, 0.95)
    wall = dice.between(0.015, 0.05)
    style = Style.random(dice, dice.between(0.015, 0.035))
    panel, store = dice.between(0.08, 0.18) * height, dice.pick((0.0, 0.2)) * height
    room = height - panel - store
    body = moved([shell((width, depth, room), wall)], (0, 0, store))
    body.append(between((-width / 2, -depth / 2, height - panel), (width / 2, depth / 2, height)))
    opening = Opening(width * 0.97, room * 0.97, depth - wall)
    parts = [moved(flap(dice, opening, style), (0, -depth / 2, store + room / 2))]
    if store:
        body += moved([shell((width, depth, store), wall / 2)], (0, 0, 0))
        low = Opening(width * 0.97, store * 0.94, depth - wall)
        parts.append(moved(drawer(dice, low, style), (0, -depth / 2, store / 2)))
    count = dice.whole(2, 6)
    row = dials(dice, width, min(panel * 0.3, width / count * 0.25), count)
    parts += [moved(one, (0, -depth / 2, height - panel / 2)) for one in row]
    if dice.chance(0.6):
        parts.append(moved(rack(dice, width - 2.2 * wall, depth * 0.85, 0.1), (0, 0, store + room * 0.45)))
    if dice.chance(0.6):
        body += _hob(dice, width, depth, height)
    return [body, *parts]


def _hob(dice: Dice, width: float, depth: float, height: float) -> Pieces:
    """Burners on top, under grates or not."""
    radius = dice.between(0.1, 0.17) * min(width, depth)
    spots = [(x * width / 4, y * depth / 4, height + 0.005) for x in (-1, 1) for y in (-1, 1)]
    pieces = at(cylinder(radius, 0.02, 14), spots)
    if dice.chance(0.5):
        bars = rod((-1.5 * radius, 0, 0.03), (1.5 * radius, 0, 0.03), 0.008, 4)
        pieces += [
            piece for bar in turned([bars], rotation((0, 0, 1), np.pi / 2)) for piece in at(bar, spots)
        ]
        pieces += at(bars, spots)
    if dice.chance(0.4):
        pieces.append(between((-width / 2, depth / 2 - 0.02, height), (width / 2, depth / 2, height * 1.15)))
    return pieces


def _dishwasher(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.45, 0.62), dice.between(0.5, 0.65), dice.between(0.5, 0.88)
    wall, plinth = dice.between(0.01, 0.04), dice.between(0.06, 0.12)
    style = Style.random(dice, dice.between(0.02, 0.05))
    body = [*moved([shell((width, depth, height), wall)], (0, 0, plinth))]
    body.append(between((-width / 2, -depth / 2 + 0.05, 0), (width / 2, depth / 2, plinth)))
    opening = Opening(width * 0.99, height * 0.98, depth)
    parts = [moved(flap(dice, opening, style), (0, -depth / 2, plinth + height / 2))]
    for level in (0.12, 0.55)[: dice.whole(1, 2)]:
        out = -dice.between(0, 0.7) * depth if dice.chance(style.ajar) else 0.0
        basket = rack(dice, width - 2.6 * wall, depth * 0.85, 0.22 * height)
        parts.append(moved(basket, (0, out, plinth + level * height)))
    return [body, *parts]


def _microwave(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.42, 0.6), dice.between(0.3, 0.45), dice.between(0.24, 0.36)
    wall, share = dice.between(0.008, 0.025), dice.between(0.65, 0.85)
    style = Style.random(dice, dice.between(0.015, 0.035))
    split = -width / 2 + share * width
    body = moved([shell((share * width, depth, height), wall)], ((share - 1) * width / 2, 0, 0))
    body.append(between((split, -depth / 2 - style.thick, 0), (width / 2, depth / 2, height)))
    body += feet(dice, width * 0.9, depth * 0.9, 0.015)
    opening = Opening(share * width, height, depth - wall)
    middle = (split - width / 2) / 2
    parts = [moved(door(dice, opening, style, -1), (middle, -depth / 2, height / 2))]
    face, pad = (split + width / 2) / 2, (1 - share) * width
    plane = -depth / 2 - style.thick
    if dice.chance(0.5):
        rows = dice.whole(2, 5)
        key = box((0.22 * pad, 0.006, 0.07 * height))
        places = [
            (face + c * 0.28 * pad, plane, (0.15 + 0.1 * r) * height) for r in range(rows) for c in (-1, 0, 1)
        ]
        parts += [at(key, places)]
    else:
        levels = (0.3, 0.6)[: dice.whole(1, 2)]
        parts += [moved(knob(dice, 0.25 * pad), (face, plane, level * height)) for level in levels]
    if dice.chance(0.7):
        plate = cylinder(0.4 * min(share * width, depth), 0.008, 20)
        parts.append([plate + [middle, 0, wall + 0.02]])
    return [body, *parts]


def _washer(dice: Dice) -> list[Pieces]:
    width, depth, height = dice.between(0.5, 0.7), dice.between(0.45, 0.7), dice.between(0.75, 1.0)
    radius, level = dice.between(0.25, 0.36) * width, dice.between(0.42, 0.5) * height
    front = -depth / 2
    body: Pieces = [pierced(width, height, radius * 0.85, level) + [0, front, 0]]
    body.append(shell((width, depth, height), dice.between(0.005, 0.02)))
    drum = vessel(ngon(20), (1.7 * radius, 1.7 * radius, depth * 0.8), 0.015)
    drum = turned([drum], rotation((1, 0, 0), np.pi / 2))[0] + [0, front + depth * 0.8, level]
    leaf = _porthole(dice, radius)
    if dice.chance(0.35):
        leaf = turned(leaf, rotation((0, 0, -1), dice.between(0.2, 2.2)), (-radius, 0, 0))
    parts = [moved(leaf, (0, front, level)), [drum]]
    top = height - dice.between(0.05, 0.09)
    parts += [
        moved(one, (width * 0.15, front, top)) for one in dials(dice, width * 0.6, 0.03, dice.whole(1, 3))
    ]
    if dice.chance(0.6):
        soap = Opening(width * 0.28, 0.08, depth * 0.5)
        parts.append(moved(drawer(dice, soap, Style.random(dice, 0.015)), (-width * 0.33, front, top)))
    return [body, *parts]


def _porthole(dice: Dice, radius: float) -> Pieces:
    """A round door with a bulging glass, on the plane y = 0."""
    ring = pointed(torus(radius * 0.85, radius * 0.15, 20, radius * 0.12), Y)
    bulge = dice.between(-0.3, 0.5) * radius
    profile = [(1.5 * radius, 1.5 * radius, 0), (radius, radius, bulge), (0, 0, bulge)]
    glass = pointed(loft(ngon(20), profile), Y)
    grip = box((radius * 0.15, radius * 0.15, radius * 0.4), (radius * 0.85, -radius * 0.15, 0))
    return [ring, glass, grip]


def _hood(dice: Dice) -> list[Pieces]:
    """A cooker hood or an air conditioner: a body with vents, lamps and buttons."""
    width, depth, height = dice.between(0.6, 1.0), dice.between(0.2, 0.5), dice.between(0.1, 0.4)
    body: Pieces = [prism(rounded(0.1, height / depth), (height, depth, width))]
    body = [pointed(body[0], 0)]
    count = dice.whole(4, 12)
    slat = box((width * 0.8, 0.01, 0.4 * height / count))
    slats = at(slat, [(0, -depth / 2, height * (k / count - 0.4)) for k in range(count)])
    if dice.chance(0.4):
        duct = tube([(0, 0, 0), (0, 0, height), (0, depth * 0.2, height * 2)], 0.25 * depth, 10)
        return [body + [duct], slats]
    buttons = at(box((0.03, 0.02, 0.02)), [(x, -depth / 2, -0.45 * height) for x in (-0.1, -0.05, 0.0, 0.05)])
    return [body, slats, buttons]
