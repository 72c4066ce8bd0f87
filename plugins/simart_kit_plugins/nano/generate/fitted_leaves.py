"""Fittings that cover or slide: leaves, drawers, slides, bolts, plungers, and what only looks so."""

from __future__ import annotations

import numpy as np

from ...shapes import fronts
from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, prism, rod
from .assembling import Assembly, disc, holder, shell
from .fittings import Room, sleeve_of, standing
from .objects import hinge, slide
from .rigging import ball_knob

_MAKES = (fronts.slab, fronts.slab, fronts.framed, fronts.raised, fronts.planked, fronts.louvred)


def leaf(dice: Dice, room: Room) -> Assembly:
    """A leaf hinged at its left edge, before the plane or in a rim."""
    kit = Assembly()
    rim = room.least * dice.between(0.02, 0.1) if dice.chance(0.35) else 0.0
    gap = room.least * dice.between(0.002, 0.01)
    wide, high = room.wide * dice.between(0.7, 1.0) - 2 * rim, room.high * dice.between(0.7, 1.0) - 2 * rim
    thick = room.least * dice.between(0.02, 0.08)
    back = gap * dice.pick((0.2, 1.0, 2.0))
    if rim:
        border, deep = rim + gap, (back + thick) * dice.between(0.6, 1.0)
        kit.fix([fronts.frame(wide + 2 * border, high + 2 * border, deep, rim)], room.base)
    pieces, grip = _panel(dice, wide, high, thick), _grip(dice, wide, high, thick)
    line = (-wide / 2, -back - (thick if rim else 0.0), 0)
    label = dice.pick(("door", "flap", "cover", "lid", "hatch"))
    looks = [(moved(pieces, (0, -back, 0)), room.own), (moved(grip, (0, -back, 0)), room.accent)]
    kit.add(label, hinge(line, (0, 0, -1), dice.between(1.0, 2.6)), looks)
    return kit


def pair(dice: Dice, room: Room) -> Assembly:
    """Two leaves that meet in the middle."""
    kit, half = Assembly(), Room(room.wide / 2, room.high, room.base, room.own, room.accent)
    gap, seed = room.least * 0.004, dice.whole(0, 2**31)
    thick, most = room.least * dice.between(0.02, 0.06), dice.between(1.2, 2.4)
    wide, high = half.wide - 2 * gap, half.high * 0.95
    for side in (-1, 1):
        same = Dice(seed)
        pieces = _panel(same, wide, high, thick) + _grip(same, wide, high, thick)
        flipped = [piece[:, ::-side] * [-side, 1, 1] for piece in pieces]
        there = moved(flipped, (side * (half.wide / 2), -gap, 0))
        line = (side * (half.wide / 2 + wide / 2), -gap, 0)
        kit.add("door", hinge(line, (0, 0, side), most), [(there, room.own)])
    return kit


def drawer(dice: Dice, room: Room) -> Assembly:
    """A case with a drawer or a tray in it."""
    kit, depth = Assembly(), max(room.wide, room.high) * dice.between(0.4, 1.0)
    wall = room.least * dice.between(0.03, 0.07)
    kit.fix(moved([shell(room.wide, depth, room.high, wall)], (0, -depth / 2, -room.high / 2)), room.base)
    gap = 0.15 * wall
    wide, high = room.wide - 2 * (wall + gap), room.high - 2 * (wall + gap)
    deep = (depth - wall) * dice.between(0.6, 0.95)
    tub = open_box((wide, deep, high * dice.between(0.4, 0.8)), 0.6 * wall)
    pieces = moved([tub], (0, -depth + wall + deep / 2, -high / 2))
    front = box((wide, wall, high), (0, -depth + wall / 2, 0))
    grip = moved(_grip(dice, wide, high, 0.0, middle=True), (0, -depth, 0))
    parts = [([*pieces, front], room.own), (grip, room.accent)]
    kit.add("drawer", slide((0, -1, 0), deep * dice.between(0.6, 0.95)), parts)
    return kit


def panel_slide(dice: Dice, room: Room) -> Assembly:
    """A panel between two rails that are longer."""
    kit = Assembly()
    wide, rail = room.wide * dice.between(0.35, 0.6), room.high * dice.between(0.03, 0.08)
    deep, high = room.least * dice.between(0.03, 0.1), room.high - 2 * rail
    spots = [(0, -deep / 2, s * (room.high - rail) / 2) for s in (-1, 1)]
    kit.fix([boxes((room.wide, deep, rail), spots)], room.base)
    thick, gap = deep * dice.between(0.3, 0.8), 0.01 * high
    place = (-room.wide / 2 + wide / 2, -deep * 0.1, 0)
    pieces = moved(_panel(dice, wide, high - 2 * gap, thick), place)
    grip = moved(_grip(dice, wide, high, thick), place)
    parts = [(pieces, room.own), (grip, room.accent)]
    kit.add("sliding door", slide((1, 0, 0), (room.wide - wide) * dice.between(0.7, 1.0)), parts)
    return kit


def slider(dice: Dice, room: Room) -> Assembly:
    """A small grip on a track."""
    kit, long = Assembly(), room.wide * dice.between(0.6, 0.95)
    wide, thick = room.least * dice.between(0.05, 0.2), room.least * dice.between(0.01, 0.04)
    kit.fix([box((long, thick, wide), (0, -thick / 2, 0))], room.base)
    own, deep, high = (
        long * dice.between(0.08, 0.25),
        wide * dice.between(0.8, 2.0),
        wide * dice.between(0.8, 2.5),
    )
    most = (long - own) / 2
    place = dice.between(-0.8, 0.8) * most
    piece = box((own, deep, high), (place, -thick - deep / 2, 0))
    motion = slide((1, 0, 0), most - place, -most - place)
    kit.add("slider", motion, [([piece], room.accent)])
    return kit


def plunger(dice: Dice, room: Room) -> Assembly:
    """A rod in a sleeve, with a knob, a plate or a bar at its end."""
    kit, radius = Assembly(), room.least * dice.between(0.04, 0.15)
    long, free = room.least * dice.between(0.3, 0.9), room.least * dice.between(0.2, 0.8)
    sleeve = sleeve_of(1.05 * radius, 1.35 * radius, long, 14)
    kit.fix(standing([sleeve]), room.base)
    tip = -long - free - 2.5 * radius
    most = min(0.8 * free, 0.4 * long)  # in, before it meets the plane
    pieces = [rod((0, -1.1 * most, 0), (0, tip, 0), radius, 12)]
    style = dice.unit()
    if style < 0.35:
        pieces += moved([ball_knob(radius * dice.between(1.3, 2.5))], (0, tip, 0))
    elif style < 0.7:
        pieces += moved([disc(radius * dice.between(1.5, 3.0), 0.5 * radius, 14)], (0, tip, 0))
    else:
        pieces.append(pointed(cylinder(radius, radius * dice.between(4, 8), 10), X) + [0, tip, 0])
    out, deep = 0.4 * long * dice.chance(0.6), most * dice.chance(0.7)
    if out + deep == 0:
        deep = most
    kit.add(dice.pick(("plunger", "rod", "handle")), slide((0, -1, 0), out, -deep), [(pieces, room.own)])
    return kit


def bolt(dice: Dice, room: Room) -> Assembly:
    """A bar in two or three guides, with a knob to shift it."""
    kit, radius = Assembly(), room.least * dice.between(0.03, 0.08)
    long, off = room.wide * dice.between(0.5, 0.9), radius * dice.between(1.1, 1.6)
    places = np.linspace(-0.3, 0.3, dice.whole(2, 3)) * long
    guide = box((long * 0.08, off + 1.6 * radius, 3.4 * radius), (0, -(off + 1.6 * radius) / 2, 0))
    kit.fix(at(guide, [(x, 0, 0) for x in places]), room.base)
    bar = pointed(cylinder(radius, long, 12), X) + [0, -off, 0]
    grip = rod((0, -off, 0), (0, -off - 4 * radius, 0), 0.7 * radius, 8)
    kit.add("bolt", slide((1, 0, 0), 0.12 * long, -0.12 * long), [([bar, grip], room.own)])
    return kit


def telescope(dice: Dice, room: Room) -> Assembly:
    """A bow on two rods that come out of sleeves along the plane."""
    kit, wide = Assembly(), room.wide * dice.between(0.3, 0.7)
    radius, long = room.least * dice.between(0.015, 0.04), room.high * dice.between(0.5, 0.8)
    low, off = -room.high / 2, 1.6 * radius
    sleeve = sleeve_of(1.05 * radius, 1.5 * radius, long, 10)
    kit.fix(at(sleeve, [(s * wide / 2, -off, low) for s in (-1, 1)]), room.base)
    start, top = low + 0.1 * long, low + long * dice.between(1.03, 1.4)
    bar = cylinder(radius, top - start, 10)
    bars = at(bar, [(s * wide / 2, -off, (start + top) / 2) for s in (-1, 1)])
    bars.append(pointed(cylinder(1.3 * radius, wide + 2 * radius, 10), X) + [0, -off, top])
    kit.add("handle", slide((0, 0, 1), 0.7 * long), [(bars, room.own)])
    return kit


def decoy(dice: Dice, room: Room) -> Assembly:
    """What does not move: a plate, a handle, ribs, heads of bolts, a pipe, a block."""
    kit, style, least = Assembly(), dice.unit(), room.least
    thick = least * dice.between(0.02, 0.1)
    if style < 0.3:
        outline = dice.pick((SQUARE, rounded(0.15)))
        size = (room.high * dice.between(0.3, 0.9), room.wide * dice.between(0.3, 0.9), thick)
        kit.fix([pointed(prism(outline, size), Y) - [0, thick / 2, 0]], room.own)
    elif style < 0.45:
        kit.fix(holder(dice, room.wide * dice.between(0.4, 0.8)), room.accent)
    elif style < 0.65:
        count = dice.whole(3, 8)
        places = [(0, -thick / 2, z) for z in np.linspace(-0.35, 0.35, count) * room.high]
        kit.fix(at(box((room.wide * 0.8, thick, 0.3 * room.high / count)), places), room.base)
    elif style < 0.8:
        spots = [(x * room.wide, 0, z * room.high) for x in (-0.4, 0.4) for z in (-0.4, 0.4)]
        kit.fix(at(disc(0.6 * thick, 0.4 * thick, 8), spots), room.accent)
    elif style < 0.9:
        kit.fix([cylinder(0.5 * thick, room.high, 10) + [0, -0.45 * thick, 0]], room.base)
    else:
        kit.fix([box((room.wide * 0.4, 3 * thick, room.high * 0.4), (0, -1.5 * thick, 0))], room.own)
    return kit


def _panel(dice: Dice, wide: float, high: float, thick: float) -> Pieces:
    """A front with its back at y = 0."""
    make = fronts.slab if min(wide, high) < 6 * thick else dice.pick(_MAKES)
    pieces = make(dice, wide, high, thick)
    back = max(float(piece[..., 1].max()) for piece in pieces)
    return moved(pieces, (0, -max(back, 0.0), 0))


def _grip(dice: Dice, wide: float, high: float, thick: float, middle: bool = False) -> Pieces:
    """A handle or a knob across from the left edge, or in the middle; some have none."""
    if dice.chance(0.25):
        return []
    least = min(wide, high)
    place = (0.0 if middle else wide * dice.between(0.35, 0.43), -thick, 0.0)
    if dice.chance(0.4):
        return moved([ball_knob(0.06 * least)], np.array(place) - [0, 0.05 * least, 0])
    long, radius, off = high * dice.between(0.15, 0.5), 0.02 * least, 0.08 * least
    if middle:
        long = min(0.4 * wide, 2 * long)
    post = box((radius, off, radius), (0, -off / 2, 0))
    pieces = [rod((0, -off, -long / 2), (0, -off, long / 2), radius, 8)]
    pieces += at(post, [(0, 0, s * 0.45 * long) for s in (-1, 1)])
    return moved(turned(pieces, rotation((0, 1, 0), np.pi / 2)) if middle else pieces, place)
