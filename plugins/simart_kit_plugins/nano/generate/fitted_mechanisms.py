"""Fittings of several parts, or of several alike: casters, wheels in forks, keys, pedals, masts."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, prism, revolve, rod, superquadric
from .assembling import Assembly, disc, press
from .fittings import Room, sleeve_of, standing
from .objects import hinge, slide, spin


def caster(dice: Dice, room: Room) -> Assembly:
    """A wheel in a fork that turns about its stem."""
    kit, radius = Assembly(), room.least * dice.between(0.15, 0.3)
    wide, trail = radius * dice.between(0.4, 1.0), radius * dice.between(0.0, 0.6)
    stem, thin = radius * dice.between(0.15, 0.5), 0.15 * radius
    kit.fix([disc(radius * dice.between(0.3, 0.8), 0.1 * radius, 12)], room.base)
    reach = stem + 1.3 * radius
    x = wide / 2 + 0.8 * thin
    cheeks = boxes(
        (thin, reach - stem, 0.6 * radius), [(s * x, -(reach + stem) / 2, 0.5 * trail) for s in (-1, 1)]
    )
    bridge = box((2 * x + thin, thin, 0.6 * radius + trail), (0, -stem, 0.3 * trail))
    fork: Pieces = [disc(0.2 * radius, stem + 0.5 * thin, 10) - [0, 0.05 * radius, 0], cheeks, bridge]
    tyre = [pointed(cylinder(radius, wide, 16), X), pointed(cylinder(0.25 * radius, 1.6 * wide, 8), X)]
    hub = np.array([0, -reach, trail])
    yaw = rotation((0, 1, 0), 2 * np.pi * dice.unit())
    parent = kit.add("caster", spin((0, 0, 0), (0, 1, 0)), [(turned(fork, yaw), room.base)])
    wheel = turned(moved(tyre, hub), yaw)
    kit.add("wheel", spin(yaw @ hub, yaw @ [1, 0, 0]), [(wheel, room.own)], parent)
    return kit


def forked_wheel(dice: Dice, room: Room) -> Assembly:
    """A wheel or a drum at the end of two long bars."""
    kit, radius = Assembly(), room.least * dice.between(0.2, 0.45)
    long = min(room.wide * 0.8, radius * dice.between(0.3, 3.0))
    thin, reach = radius * dice.between(0.06, 0.15), radius * dice.between(1.1, 3.0)
    spread = dice.between(0.0, 0.3) * reach
    for side in (-1, 1):
        x = side * (long / 2 + 1.1 * thin)
        start, end = np.array([x + side * spread, 0, 0]), np.array([x, -reach - thin, 0])
        kit.fix([rod(start, end, thin, 6)], room.base)
    hub = np.array([0, -reach, 0])
    pieces = [pointed(cylinder(radius, long, dice.whole(12, 22)), X)]
    pieces.append(pointed(cylinder(0.15 * radius, long + 4 * thin, 10), X))
    if dice.chance(0.5):
        pieces.append(pointed(cylinder(0.5 * radius, 1.04 * long, 12), X))
    kit.add("wheel", spin(hub, (1, 0, 0)), [(moved(pieces, hub), room.own)])
    return kit


def key_row(dice: Dice, room: Room) -> Assembly:
    """Long keys side by side that go down at their free end; they turn at the other, below a bar."""
    kit, count = Assembly(), dice.pick((dice.whole(3, 10), dice.whole(10, 40)))
    pitch, long = room.wide * 0.95 / count, room.high * dice.between(0.4, 0.9)
    thick = float(np.clip(pitch, 0.1 * long, 0.3 * long)) * dice.between(0.3, 0.9)
    wide = pitch * dice.between(0.7, 0.94)
    dip = 0.25 * thick
    back = long / 2
    bar = box((room.wide, 2.2 * thick + dip, 0.15 * long), (0, -1.1 * thick - dip / 2, back + 0.06 * long))
    kit.fix([bar], room.base)
    size = (wide, thick, long)
    shape = box(size) if dice.chance(0.7) else superquadric(size, 0.2, 0.3, 6)
    for k in range(count):
        place = np.array([(k - (count - 1) / 2) * pitch, -dip - thick / 2, 0])
        pin = place + [0, 0, back - 0.04 * long]
        kit.add("key", hinge(pin, (1, 0, 0), dip / long), [([shape + place], room.own)])
    return kit


def pedals(dice: Dice, room: Room) -> Assembly:
    """One to three bars that stand off through slots in a plate and tip about a pin in it."""
    kit, count = Assembly(), dice.whole(1, 3)
    pitch, thick = room.wide * 0.25, room.least * dice.between(0.03, 0.08)
    reach, wide = room.least * dice.between(0.25, 0.7), pitch * dice.between(0.2, 0.7)
    kit.fix([box((count * pitch, 0.5 * thick, 5 * thick), (0, -0.25 * thick, 0))], room.base)
    sense, most = dice.sign(), dice.between(0.15, 0.5)
    for k in range(count):
        place = np.array([(k - (count - 1) / 2) * pitch, -0.6 * thick, 0])
        pieces: Pieces = [box((0.4 * wide, reach, thick), place - [0, reach / 2, 0])]
        pieces.append(
            superquadric((wide, 0.5 * reach, 1.4 * thick), 0.4, 0.6, 6) + place - [0, 0.8 * reach, 0]
        )
        pieces.append(pointed(cylinder(0.4 * thick, 0.8 * pitch, 8), X) + place)
        motion = hinge(place, (sense, 0, 0), most)
        kit.add(dice.pick(("pedal", "lever")), motion, [(pieces, room.own)])
    return kit


def mast(dice: Dice, room: Room) -> Assembly:
    """One to three tubes that come out of each other."""
    kit, radius = Assembly(), room.least * dice.between(0.05, 0.15)
    long = room.least * dice.between(0.4, 1.2)
    sides = dice.pick((4, 6, 14))
    kit.fix(standing([sleeve_of(0.84 * radius, radius, long, sides)]), room.base)
    parent, out = 0, 0.0
    for _ in range(dice.whole(1, 3)):
        radius, start = 0.8 * radius, out
        out += long * dice.between(0.05, 0.5)
        pieces = moved(
            standing([sleeve_of(0.84 * radius, radius, 0.95 * long, sides)]), (0, -out - 0.02 * long, 0)
        )
        motion = slide((0, -1, 0), 0.85 * long - (out - start), start - out)
        parent = kit.add("rod", motion, [(pieces, room.own)], parent)
    end = -out - 0.98 * long
    if dice.chance(0.6):
        head = prism(dice.pick((ngon(12), rounded(0.2))), (4 * radius, 4 * radius, radius))
        kit.fix([pointed(head, Y) + [0, end - 0.4 * radius, 0]], room.accent, parent)
    return kit


def push_pad(dice: Dice, room: Room) -> Assembly:
    """One large button in a collar or a well: a plate, a dome or a bar."""
    kit, size = Assembly(), room.least * dice.between(0.3, 0.8)
    high = size * dice.between(0.06, 0.2)
    style = dice.unit()
    if style < 0.4:
        cap = disc(size / 2, high, 18)
    elif style < 0.7:
        cap = pointed(superquadric((size, size, 2 * high), 0.8, 1.0, 8), Y)
    else:
        cap = box((min(2 * size, room.wide), high, 0.6 * size), (0, -high / 2, 0))
    rim = revolve([(0.56, 0), (0.68, 0), (0.68, 0.5), (0.56, 0.5), (0.56, 0)], 20) * [size, size, high]
    kit.fix(standing([rim]) if style < 0.7 and dice.chance(0.7) else [], room.base)
    kit.add("button", press(high * dice.between(0.3, 0.7)), [([cap], room.accent)])
    return kit
