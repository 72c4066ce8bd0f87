"""Safes and mailboxes: doors with dials, handles, locks and flags."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.handles import knob
from ...shapes.placing import Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, open_box, rod, sheet, torus
from . import leaves, looks
from .assembling import press
from .assembly import Assembly, Leaf, until_moving
from .carcass import Size, any_size, even_or_random, shelves
from .category import Category
from .objects import Body, Look, hinge, spin, surface
from .styles import Face, Opening, Style, random_style


def _safe(dice: Dice) -> Sequence[Body]:
    look, trim = looks.painted_metal(dice), looks.metal(dice)
    size = any_size(dice, (0.25, 0.22, 0.18), (0.8, 0.7, 1.5))
    width, depth, height = size
    wall = dice.between(0.05, 0.14) * min(width, height)
    made, x, y = Assembly("body"), width / 2, depth / 2
    shell = [between((-x, -y, z), (x, y, z + wall)) for z in (0, height - wall)]
    shell += [between((s, -y, wall), (s + wall, y, height - wall)) for s in (-x, x - wall)]
    shell.append(between((-x + wall, y - wall, wall), (x - wall, y, height - wall)))
    made.fix(shell, look)
    thick = dice.between(0.5, 1.3) * wall
    inset = dice.chance(0.6)
    style = random_style(dice, look, thick)
    style = replace(
        style, lift=-thick if inset else 0.0, grips="none", look=dice.pick((look, looks.darker(look)))
    )
    opening = Opening(-x + wall, x - wall, wall, height - wall, -y, depth - wall, (wall * 0.9,) * 4)
    side = dice.sign()
    made.add(_safe_door(dice, style, opening, side, trim))
    shelves(made, dice, opening, look, style.reach + 0.08)
    if dice.chance(0.4):
        made.fix(_knobs_below(dice, size), looks.rubber(dice))
    if height > 0.9 and dice.chance(0.3):
        decoy = moved(
            [frame(width * 0.8, 0.2 * height, 0.004, 0.01)], (0, -y - style.thick - 0.001, 0.2 * height)
        )
        made.fix(decoy if inset else [], trim)
    return made.bodies()


def _safe_door(dice: Dice, style: Style, opening: Opening, side: int, trim: Look) -> Leaf:
    """A thick door with bolts at its free edge, and a dial, a keypad, a lever or a wheel on it."""
    face = Face.of(style, opening)
    plain = face.back - style.thick
    slab = box((face.width, style.thick, face.height), (face.x, face.back - style.thick / 2, face.z))
    parts = [surface([slab], style.look)]
    edge = (face.width - 0.02, face.height - 0.02)
    if dice.chance(0.5):
        rim = frame(*edge, 0.004, dice.between(0.05, 0.15) * min(edge))
        parts.append(surface(moved([rim], (face.x, plain, face.z)), dice.pick((style.look, trim))))
    levels = np.linspace(-0.35, 0.35, dice.whole(2, 4)) * face.height
    inner = face.back + 0.012
    free_edge = face.x - side * (opening.width / 2 - 0.035)
    bolts = [
        rod((free_edge - 0.02, inner, face.z + z), (free_edge + 0.02, inner, face.z + z), 0.009, 8)
        for z in levels
    ]
    parts.append(surface(bolts, trim))
    pin = np.array([face.x + side * face.width / 2, plain, face.z])
    barrels = [
        rod(pin + [0, 0, z * face.height - 0.03], pin + [0, 0, z * face.height + 0.03], 0.009, 8)
        for z in (-0.35, 0.35)
    ]
    parts.append(surface(barrels, trim))
    motion = hinge(pin, (0, 0, side), np.radians(dice.between(90, 130)))
    leaf = Leaf("door", "door", tuple(parts), motion)
    reach = min(face.width, face.height)
    spot = np.array([face.x - side * 0.1 * face.width, plain, face.z])
    rise = np.array([0, 0, dice.between(0.12, 0.2) * reach])
    lock = dice.weighted([(5, "dial"), (3, "keypad"), (2, "key")])
    handle = dice.weighted([(4, "lever"), (3, "wheel"), (1, "none")])
    leaf = _lock(dice, leaf, lock, spot + (rise if handle != "none" else 0), reach, trim)
    if handle == "none":
        return leaf
    turn = _lever(dice, reach, trim) if handle == "lever" else _spokes(dice, reach, trim)
    return leaf.with_children(turn.moved(spot - rise))


def _lock(dice: Dice, leaf: Leaf, kind: str, spot: FloatArray, reach: float, trim: Look) -> Leaf:
    """With a dial or key that turns, or with keys to press."""
    if kind == "keypad":
        high = 0.18 * reach
        plate = box((0.75 * high, 0.008, high), spot - [0, 0.004, 0])
        grid = [(x * 0.22 * high, -0.01, z * 0.2 * high) for x in (-1, 0, 1) for z in (-1.5, -0.5, 0.5, 1.5)]
        leaf = replace(leaf, surfaces=(*leaf.surfaces, surface([plate], looks.plastic(dice))))
        form = box((0.15 * high, 0.004, 0.13 * high))
        keys = [Leaf("key", "key", (surface([form + spot + place], trim),), press(0.003)) for place in grid]
        return leaf.with_children(*keys)
    radius = dice.between(0.05, 0.1) * reach if kind == "dial" else 0.012
    if kind == "dial":
        marks = turned(
            around([box((0.006, 0.002, 0.002), (radius * 1.25, 0, 0))], 12), rotation((1, 0, 0), np.pi / 2)
        )
        leaf = replace(leaf, surfaces=(*leaf.surfaces, surface(moved(marks, spot - [0, 0.001, 0]), trim)))
        dial = [pointed(cylinder(radius, 0.4 * radius, 18), Y) - [0, 0.2 * radius, 0]]
        dial += moved(knob(dice, 0.55 * radius), (0, -0.4 * radius, 0))
        return leaf.with_children(
            Leaf("dial", "dial", (surface(moved(dial, spot), trim),), spin(spot, (0, -1, 0)))
        )
    key = [pointed(cylinder(radius, 0.012, 12), Y) - [0, 0.006, 0], box((0.004, 0.03, 0.022), (0, -0.025, 0))]
    motion = hinge(spot, (0, -1, 0), np.pi / 2)
    return leaf.with_children(Leaf("key", "key", (surface(moved(key, spot), trim),), motion))


def _lever(dice: Dice, reach: float, trim: Look) -> Leaf:
    """A lever on a boss, level or upright, about y through 0."""
    long, thick = dice.between(0.12, 0.22) * reach, dice.between(0.012, 0.02)
    boss = pointed(cylinder(1.6 * thick, 0.02, 14), Y) - [0, 0.01, 0]
    stem = pointed(cylinder(0.7 * thick, 0.03, 10), Y) - [0, 0.03, 0]
    arm = box((long, thick, thick), (0.4 * long * dice.sign(), -0.045, 0))
    pieces = turned([boss, stem, arm], rotation((0, 1, 0), dice.pick((0.0, 0.0, np.pi / 2, np.pi / 4))))
    motion = hinge((0, 0, 0), (0, dice.sign(), 0), np.radians(dice.between(40, 95)))
    return Leaf("handle", "handle", (surface(pieces, trim),), motion)


def _spokes(dice: Dice, reach: float, trim: Look) -> Leaf:
    """Three to five arms on a hub, with or without a rim, about y through 0."""
    long, thick = dice.between(0.1, 0.17) * reach, 0.007
    count, out = dice.whole(3, 5), -0.04
    hub = pointed(cylinder(0.25 * long, 0.05, 14), Y) - [0, 0.025, 0]
    arm = rod((0, 0, 0), (long, 0, 0), thick, 8)
    arms = [pointed(piece, Y) + [0, out, 0] for piece in around([arm], count)]
    rim: Pieces = [pointed(torus(long, thick, 20), Y) + [0, out, 0]] if dice.chance(0.5) else []
    motion = (
        spin((0, 0, 0), (0, -1, 0))
        if rim
        else hinge((0, 0, 0), (0, -1, 0), np.radians(dice.between(60, 120)))
    )
    return Leaf("wheel", "handle wheel", (surface([hub, *arms, *rim], trim),), motion)


def _knobs_below(dice: Dice, size: Size) -> Pieces:
    radius, tall = dice.between(0.012, 0.03), dice.between(0.01, 0.03)
    spots = [(sx * 0.42 * size[0], sy * 0.42 * size[1], -tall / 2) for sx in (-1, 1) for sy in (-1, 1)]
    return [cylinder(radius, tall, 12) + np.array(spot) for spot in spots]


def _mailbox(dice: Dice) -> Sequence[Body]:
    return dice.weighted([(4, _tunnel), (4, _wall_box), (2, _lockers)])(dice)


def _tunnel(dice: Dice) -> Sequence[Body]:
    """A box with a round top on a post; a door at its end, a flag at its side."""
    width, long, side = dice.between(0.15, 0.3), dice.between(0.3, 0.55), dice.between(0.05, 0.2)
    look, made = looks.painted_metal(dice), Assembly("body")
    loop = _arch(width, side)
    shell = [
        np.insert(loop * scale, 1, y, axis=1)
        for scale, y in ((1.0, -long / 2), (1.0, long / 2), (0.0, long / 2))
    ]
    inner = [np.insert(loop * 0.97, 1, y, axis=1) for y in (-long / 2, long / 2 - 0.004)]
    rings = np.stack([*inner[::-1], *shell])
    made.fix([sheet(np.concatenate([rings, rings[:, :1]], axis=1))], look)
    low = float(loop[:, 1].min())
    post = dice.between(0.6, 1.1)
    wood = looks.wood(dice)
    if dice.chance(0.75):
        made.fix([between((-0.05, -0.05, low - post), (0.05, 0.05, low))], wood)
        made.fix([between((-0.6 * width, -0.45 * long, low - 0.02), (0.6 * width, 0.45 * long, low))], wood)
    cover = [
        np.insert(loop * scale, 1, y, axis=1) for scale, y in ((0, 0), (1.02, 0), (1.02, -0.012), (0, -0.012))
    ]
    stack = np.stack(cover)
    door = [sheet(np.concatenate([stack, stack[:, :1]], axis=1)) - [0, long / 2 + 0.001, 0]]
    parts = [surface(door, dice.pick((look, looks.darker(look))))]
    parts.append(
        surface(
            [box((0.03, 0.025, 0.012), (0, -long / 2 - 0.025, 0.75 * loop[:, 1].max()))], looks.metal(dice)
        )
    )
    pin = (0, -long / 2 - 0.006, low)
    motion = hinge(pin, (1, 0, 0), np.radians(dice.between(80, 130)))
    if dice.chance(0.2):
        end = dice.sign()
        motion = hinge(
            (end * width / 2, -long / 2 - 0.006, 0), (0, 0, end), np.radians(dice.between(80, 130))
        )
    made.add(Leaf("door", "door", tuple(parts), motion))
    if dice.chance(0.8):
        made.add(_flag(dice, width, long, low + 0.4 * side))
    return made.bodies()


def _arch(width: float, side: float) -> FloatArray:
    """(15, 2) outline of a tunnel in x and z about 0."""
    angle = np.linspace(0, np.pi, 13)
    top = np.column_stack([np.cos(angle), np.sin(angle)]) * width / 2
    loop = np.concatenate([top, [[-width / 2, -side], [width / 2, -side]]])
    return loop - [0, (width / 2 - side) / 2]


def _flag(dice: Dice, width: float, long: float, level: float) -> Leaf:
    """An arm with a plate at one side that lies along the box and turns up, or the other way round."""
    side, arm = dice.sign(), dice.between(0.12, 0.2)
    pin = np.array([side * (width / 2 + 0.006), dice.between(-0.1, 0.25) * long, level])
    strip = box((0.003, 0.018, arm), (0, 0, arm / 2 - 0.01))
    plate = box((0.003, 0.07, 0.05), (0, 0.026, arm - 0.03))
    pieces = [strip, plate, rod((-side * 0.006, 0, 0), (side * 0.004, 0, 0), 0.006, 8)]
    up = dice.chance(0.5)
    if not up:
        pieces = turned(pieces, rotation((1, 0, 0), np.pi / 2))
    motion = hinge(pin, (1 if up else -1, 0, 0), np.pi / 2)
    return Leaf("flag", "flag", (surface(moved(pieces, pin), looks.plastic(dice)),), motion)


def _wall_box(dice: Dice) -> Sequence[Body]:
    """A flat box for a wall: a sloped lid on top, a slot with a flap, a door with a lock below."""
    width, depth, height = any_size(dice, (0.22, 0.08, 0.25), (0.45, 0.2, 0.5))
    look, made = looks.painted_metal(dice), Assembly("body")
    x, y, wall, rise = width / 2, depth / 2, 0.004, dice.between(0.1, 0.6) * depth
    top = height - rise
    made.fix([between((-x, y - wall, 0), (x, y, height)), between((-x, -y, 0), (x, y - wall, wall))], look)
    cheek = box((wall, depth - wall, top - wall), (0, -wall / 2, (top + wall) / 2))
    cheek[..., 2] += np.where(cheek[..., 2] > wall + 1e-9, rise * (cheek[..., 1] + y) / depth, 0.0)
    made.fix([cheek + [s * (x - wall / 2), 0, 0] for s in (-1, 1)], look)
    style = replace(random_style(dice, look, 0.006), look=dice.pick((look, looks.darker(look))))
    low, below = wall, dice.chance(0.6)
    split = top * dice.between(0.45, 0.7) if below else low
    made.fix([between((-x + wall, -y, split), (x - wall, -y + wall, top))], look)
    if below:
        room = Opening(-x + wall, x - wall, low, split, -y, depth - wall)
        face = Face.of(style, room)
        kind = dice.chance(0.5)
        door = (
            leaves.flap(dice, style.bare(), room, -1, "door")
            if kind
            else leaves.door(dice, style.bare(), room, dice.sign())
        )
        made.add(door.with_children(leaves.lock(dice, face, style, 0.0, 0.35 * face.height)))
    tilt, along = np.arctan2(rise, depth), np.hypot(rise, depth) + dice.between(0.005, 0.04)
    plate = turned([between((-x - 0.005, -along, 0.001), (x + 0.005, 0, 0.006))], rotation((1, 0, 0), tilt))
    pin = (0, y, height)
    slotted = dice.chance(0.3)
    lid = Leaf(
        "lid",
        "lid",
        (surface(moved(plate, pin), style.look),),
        hinge(pin, (-1, 0, 0), np.radians(dice.between(50, 100))),
    )
    if slotted and below:
        made.fix_leaf(lid)
        _slot(made, dice, width, -y, split + 0.6 * (top - split), style)
    else:
        made.add(lid)
    if dice.chance(0.3):
        rolls = [torus(0.05, 0.004, 16)[..., [0, 2, 1]] + [s * 0.3 * width, 0, -0.055] for s in (-1, 1)]
        made.fix(rolls, looks.metal(dice))
    return made.bodies()


def _slot(made: Assembly, dice: Dice, width: float, near: float, level: float, style: Style) -> None:
    """A flap over the slot in the front, hinged at its top; it goes inwards and outwards or outwards only."""
    wide, high = 0.75 * width, min(0.04, 0.1 * width)
    plate = box((wide, 0.004, high), (0, near - 0.003, level))
    pin = (0, near - 0.003, level + high / 2)
    made.add(
        Leaf(
            "slot_flap",
            "flap",
            (surface([plate], style.grip),),
            hinge(pin, (-1, 0, 0), dice.between(0.8, 1.5)),
        )
    )


def _lockers(dice: Dice) -> Sequence[Body]:
    """A block of letter boxes, each with a door, some with locks."""
    across, up = dice.pick((dice.whole(1, 4), dice.whole(4, 8))), dice.whole(1, 6)
    cell, high, depth = dice.between(0.2, 0.35), dice.between(0.1, 0.3), dice.between(0.15, 0.4)
    look, made = looks.painted_metal(dice), Assembly("body")
    width, height, wall = across * cell, up * high, 0.01
    made.fix(
        [open_box((width, height, depth), wall)[..., [0, 2, 1]] * [1, -1, 1] + [0, depth / 2, height / 2]],
        look,
    )
    style = replace(
        random_style(dice, look, 0.01), lift=-0.01, grips=dice.pick(("none", "plate", "handle")), long=0.05
    )
    room = Opening(-width / 2 + wall, width / 2 - wall, wall, height - wall, -depth / 2, depth - wall)
    side, locks = dice.sign(), across * up <= 10 and dice.chance(0.6)
    for column in room.columns(even_or_random(dice, across) if dice.chance(0.2) else [1.0] * across, wall):
        if column.left > room.left:
            made.fix(
                [
                    between(
                        (column.left - wall, room.front, wall), (column.left, depth / 2 - wall, height - wall)
                    )
                ],
                look,
            )
        for one in column.rows([1.0] * up, wall):
            if one.low > room.low:
                made.fix(
                    [between((one.left, room.front, one.low - wall), (one.right, depth / 2 - wall, one.low))],
                    look,
                )
            _locker(made, dice, style, one, side, locks)
    return made.bodies()


def _locker(made: Assembly, dice: Dice, style: Style, room: Opening, side: int, locks: bool) -> None:
    face = Face.of(style, room)
    slot = box(
        (0.5 * face.width, 0.002, 0.015),
        (face.x, face.back - style.thick - 0.001, face.z + 0.3 * face.height),
    )
    leaf = leaves.door(dice, style, room, side)
    leaf = replace(leaf, surfaces=(*leaf.surfaces, surface([slot], looks.darker(style.look, 0.3))))
    if locks:
        leaf = leaf.with_children(
            leaves.lock(dice, face, style, -side * 0.35 * face.width, -0.25 * face.height)
        )
    made.add(leaf)


CATEGORIES: tuple[Category, ...] = (Category("safe", _safe), Category("mailbox", until_moving(_mailbox)))
