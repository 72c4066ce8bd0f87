"""Fittings that reach out: levers, arms of several links, pedals, pairs of jaws."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, moved, pointed
from ...shapes.primitives import Pieces, box, boxes, cylinder, rod, superquadric
from .assembling import Assembly, disc
from .fittings import Room
from .objects import hinge
from .rigging import ball_knob


def flat_lever(dice: Dice, room: Room) -> Assembly:
    """A lever or a hand on a boss, which turns along the plane."""
    kit, reach = Assembly(), room.wide * dice.between(0.4, 0.8)
    boss, off = room.least * dice.between(0.04, 0.12), room.least * dice.between(0.03, 0.15)
    start = -room.wide * dice.between(0.1, 0.35)
    kit.fix(moved([disc(boss, off, 12)], (start, 0, 0)), room.base)
    thick = boss * dice.between(0.5, 1.0)
    pieces = [_beam(dice, reach, thick), *_end(dice, reach, thick)]
    pieces.append(pointed(cylinder(boss, thick, 12), Y))
    most = dice.between(0.6, 2.6)
    motion = hinge((start, 0, 0), (0, 1, 0), most, -most * dice.pick((0, 0, 1)))
    kit.add("lever", motion, [(moved(pieces, (start, -off - thick / 2, 0)), room.own)])
    return kit


def lifted_arm(dice: Dice, room: Room) -> Assembly:
    """A long arm or plate along the plane that folds away from it, in a fork at one end."""
    kit, reach = Assembly(), room.wide * dice.between(0.6, 0.95)
    wide, thick = room.high * dice.between(0.15, 0.8), room.least * dice.between(0.03, 0.12)
    off = thick * dice.between(0.8, 2.5)
    start = -room.wide * 0.45
    cheek = room.least * 0.03
    spots = [(start, -(off + thick / 2) / 2, s * (wide / 2 + cheek)) for s in (-1, 1)]
    kit.fix([boxes((2 * thick, off + thick, cheek), spots)], room.base)
    pin = cylinder(0.3 * thick, wide + 3 * cheek, 10) + [start, -off, 0]
    pieces: Pieces = [box((reach, thick, wide), (start + reach / 2 - thick / 2, -off, 0)), pin]
    if dice.chance(0.4):
        pad = superquadric((0.2 * reach, thick, wide), 0.5, 0.5)
        pieces.append(pad + [start + 0.85 * reach, -off - thick, 0])
    most = dice.between(0.4, 1.8)
    label = dice.pick(("arm", "pedal", "lever"))
    kit.add(label, hinge((start, -off, 0), (0, 0, -1), most), [(pieces, room.own)])
    return kit


def standing_arm(dice: Dice, room: Room) -> Assembly:
    """One to three links that stand off, each in a fork or on a barrel at the end of the one before."""
    kit = Assembly()
    thick = room.least * dice.between(0.03, 0.1)
    place, parent = np.array([0.0, -1.5 * thick, 0.0]), 0
    spots = [(s * 1.1 * thick, -thick, 0) for s in (-1, 1)]
    kit.fix([boxes((0.8 * thick, 2 * thick, 2 * thick), spots)], room.base)
    lean, links = dice.between(-0.6, 0.6), dice.whole(1, 3)
    for link in range(links):
        reach = room.least * dice.between(0.4, 1.2) * 0.8**link
        end = place + reach * np.array([0.0, -np.cos(lean), np.sin(lean)])
        barrel = pointed(cylinder(0.8 * thick, 1.3 * thick, 12), X)
        pieces = [rod(place, end, 0.55 * thick, 10), barrel + place]
        if link == links - 1:
            pieces += _head(dice, end, thick, reach)
        else:
            spots_ = [end + [s * 1.1 * thick, 0, 0] for s in (-1, 1)]
            pieces.append(boxes((0.8 * thick, 1.6 * thick, 1.6 * thick), spots_))
        most = dice.between(0.4, 1.2)
        label = "arm" if link < links - 1 or dice.chance(0.4) else "head"
        parent = kit.add(label, hinge(place, (1, 0, 0), most, -most), [(pieces, room.own)], parent)
        place, lean = end, lean + dice.between(-1.2, 1.2)
    return kit


def jaws(dice: Dice, room: Room) -> Assembly:
    """Two arms that close on each other, or a fixed one and one that turns."""
    kit, reach = Assembly(), room.least * dice.between(0.5, 1.0)
    thick, apart = reach * dice.between(0.06, 0.14), reach * dice.between(0.12, 0.3)
    kit.fix([box((2.6 * apart, thick, 2 * thick), (0, -thick / 2, 0))], room.base)
    both = dice.chance(0.6)
    for side in (-1, 1):
        spot = np.array([side * apart, -1.5 * thick, 0.0])
        arm = box((thick, reach, 1.5 * thick), spot - [0, reach / 2 - thick / 2, 0])
        tip = box((0.5 * apart, thick, 1.5 * thick), spot + [-side * 0.2 * apart, -reach + thick, 0])
        pieces = [arm, tip, cylinder(0.8 * thick, 1.7 * thick, 12) + spot]
        if both or side > 0:
            # Outwards, and inwards until the tips meet.
            motion = hinge(spot, (0, 0, side), dice.between(0.3, 0.8), -0.3 * apart / reach)
            kit.add("jaw", motion, [(pieces, room.own)])
        else:
            kit.fix(pieces, room.own)
    return kit


def _beam(dice: Dice, reach: float, thick: float) -> FloatArray:
    if dice.chance(0.5):
        return rod((0, 0, 0), (reach, 0, 0), thick / 2, 8)
    return box((reach, thick, thick * dice.between(1.0, 3.0)), (reach / 2, 0, 0))


def _end(dice: Dice, reach: float, thick: float) -> Pieces:
    style = dice.unit()
    if style < 0.3:
        return moved([ball_knob(1.3 * thick)], (reach, 0, 0))
    if style < 0.6:
        return [rod((reach, 0, 0), (reach, -4 * thick, 0), 0.8 * thick, 10)]
    return []


def _head(dice: Dice, end: FloatArray, thick: float, reach: float) -> Pieces:
    """What the last link carries."""
    size = reach * dice.between(0.2, 0.6)
    style = dice.unit()
    if style < 0.3:
        return moved([box((size, 0.6 * thick, size))], end)
    if style < 0.6:
        return moved([cylinder(size / 2, 0.7 * size, 16)], end)
    if style < 0.8:
        return moved([ball_knob(1.5 * thick)], end)
    return []
