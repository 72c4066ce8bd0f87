"""Washing machines and dryers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import slab
from ...shapes.legs import feet
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, loft, open_box, revolve, vessel
from ...shapes.walls import pierced
from . import looks
from .assembling import PAD, Assembly, dial, fall, holder, lift, press, pull, shell, swing, turning
from .category import Category
from .objects import Body, Look, spin

_Size = tuple[float, float, float]


def _washer(dice: Dice) -> list[Body]:
    if dice.chance(0.3):
        return _top_loader(dice)
    return _front_loader(dice, drawers=True)


def _dryer(dice: Dice) -> list[Body]:
    return _front_loader(dice, drawers=False)


def _front_loader(dice: Dice, drawers: bool) -> list[Body]:
    size = (dice.between(0.45, 0.7), dice.between(0.4, 0.7), dice.between(0.7, 1.0))
    width, depth, height = size
    coat = looks.painted_metal(dice)
    kit = Assembly("case")
    band = dice.between(0.1, 0.16) * height
    radius = dice.between(0.24, 0.36) * min(width, height - band)
    level = (height - band) * dice.between(0.48, 0.58)
    kit.fix([shell(width, depth, height, dice.between(0.005, 0.02))], coat)
    hole = radius * 0.85
    kit.fix([pierced(width, height - band, hole, level) + [0, -depth / 2, 0]], coat)
    if dice.chance(0.4):
        lip = pointed(revolve([[hole, 0], [hole, -0.06]], 24), Y)
        kit.fix(moved([lip], (0, -depth / 2 + 0.06, level)), looks.rubber(dice))
    kit.fix(feet(dice, width, depth, dice.between(0.01, 0.04)), looks.rubber(dice))
    _drum(dice, kit, radius, depth, level)
    _panel(dice, kit, size, band, coat, drawers)
    _porthole(dice, kit, radius, (0, -depth / 2, level), coat)
    if dice.chance(0.3):
        _hatch(dice, kit, width, depth, coat)
    return kit.done()


def _drum(dice: Dice, kit: Assembly, radius: float, depth: float, level: float) -> None:
    metal = looks.metal(dice)
    tub = vessel(ngon(20), (1.7 * radius, 1.7 * radius, depth * 0.75), 0.008)
    tub = turned([tub], rotation((1, 0, 0), np.pi / 2))[0]
    vanes = around(
        [box((0.05 * radius, 0.14 * radius, depth * 0.6), (0, 0.77 * radius, 0))], dice.whole(2, 5)
    )
    vanes = [pointed(piece, Y) - [0, 0.375 * depth, 0] for piece in vanes]
    place = (0, -depth / 2 + 0.8 * depth, level)
    parts = [(moved([tub, *vanes], place), metal)]
    kit.add("drum", spin(place, (0, 1, 0)), parts)


def _panel(dice: Dice, kit: Assembly, size: _Size, band: float, coat: Look, drawers: bool) -> None:
    """The band with the dial, the buttons and the detergent drawer."""
    width, depth, height = size
    front, middle = -depth / 2, height - band / 2
    drawer = dice.between(0.22, 0.34) * width if drawers and dice.chance(0.85) else 0.0
    side = dice.sign() if dice.chance(0.3) else 1
    x = side * (drawer / 2)
    look = coat if dice.chance(0.5) else looks.darker(coat, 0.4)
    lip = dice.pick((0.0, 0.01, 0.02))
    kit.fix([box((width - drawer, 0.015 + lip, band), (x, front + 0.0075 - lip / 2, middle))], look)
    if drawer:
        _soap_drawer(dice, kit, size, (drawer, band, lip), -side * (width - drawer) / 2, coat)
    plane = front - lip
    room = width - drawer
    dark = looks.plastic(dice)
    if dice.chance(0.85):
        radius = min(band * 0.4, dice.between(0.02, 0.045))
        spot = (x + dice.between(-0.15, 0.15) * room, plane, middle)
        kit.add("knob", turning(dice, spot), [(moved(dial(dice, radius), spot), dark)])
    kit.fix([box((0.1, 0.004, band * 0.4), (x + 0.32 * room, plane - 0.002, middle))], looks.glass(dice))
    count = dice.whole(0, 6)
    key = min(0.02, 0.22 * room / max(count, 1))
    moves = dice.chance(0.6)
    for k in range(count):
        spot = (x - 0.45 * room + (k + 0.5) * key * 1.3, plane, middle)
        thick = 0.012 if moves else PAD
        shape = moved([box((key, thick, band * 0.2), (0, -thick / 2, 0))], spot)
        if moves:
            kit.add("button", press(0.004), [(shape, dark)])
        else:
            kit.fix(shape, dark)


def _soap_drawer(
    dice: Dice, kit: Assembly, size: _Size, cut: tuple[float, float, float], x: float, coat: Look
) -> None:
    wide, band, lip = cut
    deep = size[1] * dice.between(0.4, 0.6)
    place = np.array([x, -size[1] / 2, size[2] - band / 2])
    face = moved([box((wide - 0.005, 0.015 + lip, band - 0.004))], (0, 0.0075 - lip / 2, 0))
    grip = moved(holder(dice, wide * 0.6), (0, -lip, -0.1 * band)) if dice.chance(0.6) else []
    tray = moved([open_box((wide - 0.025, deep, band * 0.6), 0.003)], (0, deep / 2 + 0.015, -0.35 * band))
    walls = boxes(
        (0.003, deep * 0.9, band * 0.4), [(s * wide * 0.15, deep / 2 + 0.015, -0.15 * band) for s in (-1, 1)]
    )
    inside = Look("plastic", (225, 228, 232))
    parts = [(moved(face + grip, place), coat), (moved([*tray, walls], place), inside)]
    kit.add("drawer", pull(deep * 0.85), parts)


def _porthole(dice: Dice, kit: Assembly, radius: float, place: _Size, coat: Look) -> None:
    """A round or square door with a bulging glass."""
    side = dice.sign()
    round_ = dice.chance(0.8)
    outline = ngon(24) if round_ else rounded(dice.between(0.1, 0.3))
    wide, thick = radius * dice.between(1.05, 1.2), dice.between(0.02, 0.05)
    inner = radius * dice.between(0.6, 0.8)
    ring = [
        (inner, 0),
        (wide, 0),
        (wide, 0.6 * thick),
        (wide - 0.4 * thick, thick),
        (inner, thick * 0.8),
        (inner, 0),
    ]
    hoop = _outward(loft(outline, [(2 * r, 2 * r, z) for r, z in ring]))
    bulge = dice.between(0.2, 0.6) * radius
    bowl = loft(
        ngon(24), [(2 * inner, 2 * inner, 0.5 * thick), (1.7 * inner, 1.7 * inner, -bulge), (0, 0, -bulge)]
    )
    if not round_:
        bowl = loft(outline, [(2 * inner, 2 * inner, 0.5 * thick), (0, 0, 0.5 * thick)])
    parts: list[tuple[Pieces, Look]] = [
        ([hoop], coat if dice.chance(0.4) else looks.plastic(dice)),
        ([_outward(bowl)], looks.glass(dice)),
    ]
    if dice.chance(0.5):
        cover = loft(ngon(24), [(2 * inner, 2 * inner, 0.7 * thick), (0, 0, dice.between(0.7, 1.6) * thick)])
        parts.append(([_outward(cover)], looks.glass(dice)))
    edge = (wide + inner) / 2
    grip = moved(holder(dice, radius * 0.5, upright=True), (-side * edge, -thick * 0.8, 0))
    parts.append((grip, looks.metal(dice)))
    pin = side * wide
    block = [
        box((0.03, thick, radius * 0.25), (side * (wide - 0.01), -thick / 2, s * 0.25 * radius))
        for s in (-1, 1)
    ]
    parts.append((block, looks.metal(dice)))
    motion = swing(side, pin + place[0], place[1] - 0.002, dice.between(1.6, 2.8), place[2])
    spot = np.array(place) - [0, 0.002, 0]
    kit.add("door", motion, [(moved(pieces, spot), look) for pieces, look in parts])


def _outward(piece: FloatArray) -> FloatArray:
    """With what ran up along -y."""
    return turned([piece], rotation((1, 0, 0), np.pi / 2))[0]


def _hatch(dice: Dice, kit: Assembly, width: float, depth: float, coat: Look) -> None:
    """A flap low on the front, for the filter."""
    wide = dice.between(0.12, 0.25)
    x = dice.pick((-1, 1)) * (width / 2 - wide)
    face = moved(slab(dice, wide, 0.09, 0.008), (x, -depth / 2 - 0.001, 0.07))
    kit.add(
        "flap", fall(-depth / 2 - 0.001, 0.025, dice.between(1.2, 1.57)), [(face, looks.darker(coat, 0.9))]
    )


def _top_loader(dice: Dice) -> list[Body]:
    width, depth, height = dice.between(0.4, 0.7), dice.between(0.45, 0.7), dice.between(0.75, 1.0)
    coat = looks.painted_metal(dice)
    kit = Assembly("case")
    wall = dice.between(0.02, 0.05)
    kit.fix([open_box((width, depth, height), wall)], coat)
    kit.fix(feet(dice, width, depth, 0.02), looks.rubber(dice))
    console = dice.between(0.08, 0.16) if dice.chance(0.8) else 0.0
    radius = min(width - 2 * wall, depth - 2 * wall - console) / 2 * 0.9
    center = -console / 2
    drum: Pieces = [vessel(ngon(20), (2 * radius, 2 * radius, height * 0.6), 0.006)]
    if dice.chance(0.7):
        drum += around(
            [box((radius * 0.5, 0.02, 0.25 * height), (radius * 0.2, 0, 0.2 * height))], dice.whole(2, 4)
        )
    shape = moved(drum, (0, center, height * 0.25))
    kit.add("drum", spin((0, center, height * 0.25), (0, 0, 1)), [(shape, looks.metal(dice))])
    if console:
        foot = _console(dice, kit, (width, depth, height), console, coat)
        # The case goes on under the knobs: the lid is hung where it passes them.
        low, high = (-width / 2, depth / 2 - foot, height - 0.01), (width / 2, depth / 2 - console, height)
        kit.fix([between(low, high)], coat)
        console = foot
    _lid(dice, kit, (width, depth, height), console, coat)
    return kit.done()


def _console(dice: Dice, kit: Assembly, size: _Size, deep: float, coat: Look) -> float:
    """A block at the back with knobs, its face sloped; how far from the back a lid has to stay clear [m]."""
    width, depth, height = size
    tall, slope = dice.between(0.06, 0.2), dice.between(0.0, 0.6)
    profile = loft(SQUARE, [(0, 0, 0), (width, deep, 0), (width, deep * (1 - slope), tall), (0, 0, tall)])
    # Only the front leans: the back stays upright.
    profile[..., 1] += profile[..., 2] / tall * deep * slope / 2
    kit.fix([profile + [0, depth / 2 - deep / 2, height]], coat)
    lean = rotation((1, 0, 0), -np.arctan2(deep * slope, tall))
    count, dark = dice.whole(1, 4), looks.plastic(dice)
    radius = min(tall * 0.35, 0.035)
    seed, front = dice.whole(0, 2**31), depth / 2 - deep
    for k in range(count):
        x = (k + 0.5 - count / 2) * width / (count + 0.5)
        spot = (x, depth / 2 - deep + deep * slope / 2, height + tall / 2)
        shape = moved(turned(dial(Dice(seed), radius), lean), spot)
        front = min(front, *(float(piece[..., 1].min()) for piece in shape))
        kit.add("knob", turning(Dice(seed + 1), spot, lean @ [0, 1, 0]), [(shape, dark)])
    # Lids open a little beyond upright.
    return depth / 2 - front + 0.1 * tall


def _lid(dice: Dice, kit: Assembly, size: _Size, console: float, coat: Look) -> None:
    width, depth, height = size
    deep, thick = depth - console, dice.between(0.012, 0.04)
    gap = 0.003
    kinds = dice.whole(0, 2)
    front = -depth / 2
    hinge_y = depth / 2 - console - gap
    plate = between((-width / 2, front, height + gap), (width / 2, hinge_y, height + gap + thick))
    parts: list[tuple[Pieces, Look]] = [([plate], coat)]
    if kinds:
        border = dice.between(0.1, 0.2) * deep
        rim = [
            between((-width / 2, front, height + gap), (-width / 2 + border, hinge_y, height + gap + thick)),
            between((width / 2 - border, front, height + gap), (width / 2, hinge_y, height + gap + thick)),
            between(
                (-width / 2 + border, front, height + gap),
                (width / 2 - border, front + border, height + gap + thick),
            ),
            between(
                (-width / 2 + border, hinge_y - border, height + gap),
                (width / 2 - border, hinge_y, height + gap + thick),
            ),
        ]
        low, high = (
            (-width / 2 + border, front + border, height + gap + 0.3 * thick),
            (width / 2 - border, hinge_y - border, height + gap + 0.6 * thick),
        )
        parts = [(rim, coat), ([between(low, high)], looks.glass(dice))]
    if dice.chance(0.7):
        grip = moved(holder(dice, width * 0.3), (0, front, height + gap + thick / 2))
        parts.append((grip, looks.darker(coat, 0.6)))
    # Hung at its upper edge, so that opened it stands before its hinge.
    kit.add("lid", lift(hinge_y, height + gap + thick, dice.between(1.2, 1.65)), parts)


CATEGORIES: tuple[Category, ...] = (Category("washing_machine", _washer), Category("dryer", _dryer))
