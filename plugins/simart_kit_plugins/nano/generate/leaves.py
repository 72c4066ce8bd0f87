"""What moves in the openings of furniture: doors, flaps, drawers, sliding leaves.

An opening is a rectangle in a plane of x and z; its case lies behind it, towards +y. Leaves are made in the
frame of the object, closed; `Leaf.turned` puts them on other sides of a case.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import fronts
from ...shapes.dice import Dice
from ...shapes.handles import knob
from ...shapes.placing import Y, moved, pointed, rotation
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, open_box, rod
from .assembly import Leaf
from .objects import Surface, hinge, slide, surface
from .styles import Face, Opening, Style, grip, panel


def door(dice: Dice, style: Style, opening: Opening, side: int, name: str = "door") -> Leaf:
    """A door hinged on its left (side -1) or right (1), its handle on the other side."""
    face = Face.of(style, opening)
    wide, high = face.width, face.height
    edge = max(0.0, wide / 2 - min(0.05, 0.15 * wide))
    rise = high * Dice((style.seed, 2)).between(-0.38, 0.38)
    upright = Dice((style.seed, 3)).chance(0.8)
    pieces = panel(style, face)
    pieces += grip(style, face, -side * edge, rise * 0.8, upright, 0.4 * high if upright else 0.3 * wide)
    pin = np.array([face.x + side * wide / 2, face.back - style.thick, face.z])
    if not style.inset:
        pin[1] += style.thick * Dice((style.seed, 4)).pick((0.0, 0.5, 1.0, 1.0))
    pieces += _knuckles(style, pin, high)
    pieces += _lining(dice, style, opening, face)
    upper = np.radians(dice.between(85, 125))
    return Leaf(name, "door", tuple(pieces), hinge(pin, (0, 0, side), upper))


def pair(dice: Dice, style: Style, opening: Opening, name: str = "door") -> list[Leaf]:
    """Two doors that meet in the middle."""
    halves = opening.columns((1, 1), 0.0)
    return [
        door(dice, style, half, side, f"{end}_{name}")
        for half, side, end in zip(halves, (-1, 1), ("left", "right"), strict=True)
    ]


def folding(dice: Dice, style: Style, opening: Opening, side: int, name: str = "folding_door") -> Leaf:
    """A door hinged on its left (side -1) or right (1), and a second one hinged to the first."""
    halves = opening.columns((1, 1), 0.0)
    near, far = halves if side < 0 else halves[::-1]
    first = door(dice, style.bare(), near, side, name)
    face = Face.of(style, far)
    pieces = panel(style, face)
    pieces += grip(style, face, 0.35 * side * face.width, 0, True, 0.3 * face.height)
    # The two fold outwards, back to back, so that their common line is at the back.
    pin = (face.x + side * face.width / 2, face.back, face.z)
    second = Leaf("folding_leaf", "door", tuple(pieces), hinge(pin, (0, 0, -side), np.radians(165)))
    return replace(first, motion=replace(first.motion, upper=np.radians(85.0))).with_children(second)


def turning_grip(dice: Dice, style: Style, opening: Opening, side: int) -> Leaf:
    """A knob, lever or key that turns on a door hinged on this side; the door's own grip should be "none"."""
    face = Face.of(style, opening)
    size = dice.between(0.012, 0.025)
    place = np.array([face.x - side * (face.width / 2 - 2.2 * size), face.back - style.thick, face.z])
    place[2] += face.height * dice.between(-0.2, 0.2)
    if dice.chance(0.5):
        pieces = knob(dice, size)
    else:
        reach = dice.between(3, 5) * size * dice.sign()
        arm = between((-size / 2, -3 * size, min(0.0, reach)), (size / 2, -2.2 * size, max(0.0, reach)))
        pieces = [pointed(cylinder(size * 0.6, 3 * size, 10), Y) - [0, 1.5 * size, 0], arm]
    motion = hinge(place, (0, -1, 0), np.pi / 2, lower=-np.pi / 2 if dice.chance(0.4) else 0.0)
    return Leaf("handle", "handle", (surface(moved(pieces, place), style.grip),), motion)


def flap(dice: Dice, style: Style, opening: Opening, side: int, name: str = "flap") -> Leaf:
    """A door hinged at its bottom (side -1) or top (1), its handle at the other edge."""
    face = Face.of(style, opening)
    pieces = panel(style, face)
    pieces += grip(style, face, 0, -side * 0.38 * face.height, False, 0.6 * face.width)
    pin = (face.x, face.back - style.thick * (1.0 if style.inset else 0.0), face.z + side * face.height / 2)
    upper = np.radians(dice.between(75, 95) if side < 0 else dice.between(70, 110))
    return Leaf(name, "flap", tuple(pieces), hinge(pin, (-side, 0, 0), upper))


def drawer_front(style: Style, opening: Opening) -> list[Surface]:
    """What shows of a drawer: a panel with a handle, or two."""
    face = Face.of(style, opening)
    pieces = panel(style, face)
    twice = face.width > 0.45 and face.width > 2.5 * face.height and style.seed % 3 == 0
    rise = face.height * Dice((style.seed, 5)).pick((0.0, 0.0, 0.3))
    for x in (-face.width / 4, face.width / 4) if twice else (0.0,):
        pieces += grip(style, face, x, rise, False, min(0.6 * face.width, 2.5 * face.height))
    return pieces


def drawer(dice: Dice, style: Style, opening: Opening, name: str = "drawer") -> Leaf:
    """A front with its handle and mostly a box behind it."""
    pieces = drawer_front(style, opening)
    deep = (opening.depth - style.reach) * dice.between(0.8, 0.98)
    if dice.chance(0.9):
        pieces.append(surface(_tray(dice, style, opening, deep), style.inner))
    return Leaf(name, "drawer", tuple(pieces), slide((0, -1, 0), deep * dice.between(0.6, 0.95)))


def sliding(dice: Dice, style: Style, opening: Opening, count: int, name: str = "door") -> list[Leaf]:
    """Leaves that run behind each other in two tracks inside the opening."""
    # A bowed leaf would go through the one behind it.
    make = fronts.slab if style.make is fronts.bowed else style.make
    slim = replace(style, make=make, lift=-style.thick * 1.05)
    lap = min(0.04, 0.1 * opening.width / count)
    wide = (opening.width + lap * (count - 1)) / count
    leaves = []
    first = dice.whole(0, 1)
    for k in range(count):
        track = (k + first) % 2
        left = opening.left + k * (wide - lap)
        room = replace(opening, left=left, right=left + wide, front=opening.front + track * 1.3 * style.thick)
        face = Face.of(slim, room)
        flat = replace(slim, grips="plate") if track else slim
        side = -1 if k == 0 else 1
        pieces = panel(flat, face)
        pieces += grip(flat, face, side * 0.42 * face.width, 0, True, 0.3 * face.height)
        travel = (wide - lap) * dice.between(0.85, 1.0)
        back = -travel if 0 < k < count - 1 else 0.0
        direction = 1 if k < count - 1 else -1
        leaves.append(Leaf(name, "door", tuple(pieces), slide((direction, 0, 0), travel, back)))
    return leaves


def lock(dice: Dice, face: Face, style: Style, x: float, z: float) -> Leaf:
    """A small lock cylinder that turns, at (x, z) from a face's middle."""
    radius = dice.between(0.007, 0.012)
    place = (face.x + x, face.back - style.thick, face.z + z)
    barrel = pointed(cylinder(radius, 0.012, 12), Y) - [0, 0.006, 0]
    key = box((0.003, 0.02, 0.018), (0, -0.02, 0))
    surfaces = (surface(moved([barrel, key], place), style.grip),)
    return Leaf("lock", "lock", surfaces, hinge(place, (0, -1, 0), np.pi / 2))


def flat_lid(style: Style, width: float, depth: float, border: float) -> list[Surface]:
    """A level frame about a pane, from y = 0 to -depth and from z = 0 up; a knob at its front."""
    rim = fronts.frame(width, depth, style.thick, border)
    pane = box((width - 2 * border, style.thick * 0.3, depth - 2 * border), (0, -style.thick / 2, 0))
    lying = rotation((1, 0, 0), -np.pi / 2)
    surfaces = [(rim, style.look), (pane, style.pane)]
    if style.grips != "none":
        pull = knob(Dice(style.seed), min(0.015, 0.4 * border))
        surfaces += [(piece + [0, -style.thick, -depth / 2 + border / 2], style.grip) for piece in pull]
    return [surface([piece @ lying.T + [0, -depth / 2, 0]], look) for piece, look in surfaces]


def facing(leaf: Leaf, quarter_turns: int) -> Leaf:
    """A leaf made for a case about the z axis, on another of its sides: 1 faces +x, 2 the back."""
    return leaf.turned(rotation((0, 0, 1), quarter_turns * np.pi / 2))


def _knuckles(style: Style, pin: FloatArray, high: float) -> list[Surface]:
    """Barrels of the hinges, on the pin, in some styles."""
    if style.seed % 5:
        return []
    long, radius = min(0.06, 0.15 * high), min(0.006, 0.4 * style.thick)
    ends = [pin + [0, 0, z * high] for z in (-0.4, 0.38)]
    return [surface([rod(end, end + [0, 0, long], radius, 8) for end in ends], style.grip)]


def _lining(dice: Dice, style: Style, opening: Opening, face: Face) -> list[Surface]:
    """A second skin or racks on the inside of a door."""
    if not dice.chance(0.18) or min(opening.width, opening.height) < 0.2:
        return []
    wide, high = 0.84 * opening.width, 0.88 * opening.height
    x, z = opening.center
    back = face.back
    if dice.chance(0.6):
        deep = min(0.02, 0.05 * opening.width)
        skin = between((x - wide / 2, back, z - high / 2), (x + wide / 2, back + deep, z + high / 2))
        return [surface([skin], style.inner)]
    deep = min(0.1, 0.18 * opening.width, 0.3 * opening.depth)
    levels = np.linspace(z - 0.42 * high, z + 0.3 * high, dice.whole(2, 3))
    racks = [
        open_box((wide, deep, min(0.08, 0.15 * high)), 0.004) + [x, back + deep / 2, level]
        for level in levels
    ]
    return [surface(racks, style.inner)]


def _tray(dice: Dice, style: Style, opening: Opening, deep: float) -> Pieces:
    """The box of a drawer, or a bottom with two rails."""
    side = min(0.015, 0.04 * opening.width)
    wide, high = opening.width - 2 * side, opening.height * dice.between(0.5, 0.85)
    wall = min(0.012, 0.1 * high)
    x, start = opening.center[0], opening.front + style.reach
    if not style.inset:
        start -= style.lift
    low = opening.low + 0.04 * opening.height
    if dice.chance(0.88):
        return moved([open_box((wide, deep, high), wall)], (x, start + deep / 2, low))
    rails = boxes((wall, deep, high / 2), [(s * (wide - wall) / 2, deep / 2, high / 4) for s in (-1, 1)])
    return moved([rails, box((wide, deep, wall), (0, deep / 2, wall / 2))], (x, start, low))
