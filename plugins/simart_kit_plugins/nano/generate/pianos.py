"""Pianos: upright and grand, with key lids, top lids, pedals and keys that go down."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import front
from ...shapes.legs import leg
from ...shapes.placing import moved
from ...shapes.primitives import between, box, sheet
from . import looks
from .assembly import Assembly, Leaf
from .carcass import board
from .category import Category
from .objects import Body, Look, Motion, hinge, surface
from .piano_keys import DIP, key_row


def _piano(dice: Dice) -> Sequence[Body]:
    return dice.weighted([(5, _upright), (3, _grand)])(dice)


def _keys(made: Assembly, dice: Dice, width: float, front_y: float, level: float) -> None:
    """White and black keys above a key bed, so high that they can go down."""
    count = dice.pick((52, 45, 36, 22)) if width > 0.9 else dice.whole(8, 22)
    long = min(0.15, 0.13 * width + 0.02)
    ivory, ebony = looks.ceramic(dice), looks.darker(looks.rubber(dice), 0.5)
    spot = (0.0, front_y, level + DIP * long + 0.002)
    for motion, parts in key_row(spot, count, width / count, long, ivory, ebony):
        surfaces = tuple(surface(pieces, look) for pieces, look in parts)
        made.add(Leaf("key", "key", surfaces, motion))


def _pedals(made: Assembly, dice: Dice, y: float, level: float) -> None:
    """Two or three, that go down in front."""
    brass, count, long = looks.metal(dice), dice.whole(2, 3), dice.between(0.07, 0.12)
    for k in range(count):
        x = (k - (count - 1) / 2) * 0.08
        plate = box((0.03, long, 0.008), (x, y - long / 2, level))
        motion = hinge((x, y, level), (1, 0, 0), 0.6 * level / long if level < 0.06 else 0.2)
        made.add(Leaf("pedal", "pedal", (surface([plate], brass),), motion))


def _upright(dice: Dice) -> Sequence[Body]:
    look, toy = looks.wood(dice), dice.chance(0.2)
    scale = dice.between(0.3, 0.45) if toy else 1.0
    width, depth, height = (
        scale * v for v in (dice.between(1.35, 1.55), dice.between(0.3, 0.4), dice.between(1.0, 1.35))
    )
    made, x, y, side = Assembly("body"), width / 2, depth / 2, 0.04 * scale
    bed, reach = 0.56 * height, dice.between(0.25, 0.3) * scale
    made.fix([between((s, -y, 0), (s + side, y, height)) for s in (-x, x - side)], look)
    made.fix([between((-x + side, y - 0.02, 0), (x - side, y, height))], look)
    inner = x - side
    for low, high in ((0.05 * height, bed - 0.05 * scale), (bed + 0.2 * scale, height - 0.002)):
        panel = front(dice, 2 * inner, high - low, 0.02 * scale)
        made.fix(moved(panel, (0, -y + 0.02 * scale, (low + high) / 2)), look)
    made.fix([between((-inner, -y - reach, bed - 0.05 * scale), (inner, y - 0.02, bed))], look)
    cheeks = [
        between((s, -y - reach, bed - 0.05 * scale), (s + side, -y, bed + 0.14 * scale))
        for s in (-x, x - side)
    ]
    made.fix(cheeks, look)
    legs = leg(dice, bed - 0.05 * scale, 0.07 * scale)
    flip = np.array([-1, 1, 1])
    one = legs + [-x + 0.06 * scale, -y - reach + 0.06 * scale, bed - 0.05 * scale]
    made.fix([one, one * flip], look)
    _keys(made, dice, 2 * inner * 0.94, -y - reach + 0.02 * scale, bed)
    made.fix(
        [
            box(
                (inner * 0.055, 0.1 * scale, 0.03 * scale),
                (s * inner * 0.97, -y - reach + 0.07 * scale, bed + 0.015 * scale),
            )
            for s in (-1, 1)
        ],
        look,
    )
    back = -y - reach + 0.02 * scale + min(0.15, 0.13 * 2 * inner * 0.94 + 0.02)
    if dice.chance(0.65):
        made.add(_key_lid(dice, inner, back, -y, bed, scale, look))
    made.add(_top_lid(made, dice, width, depth, height, scale, look))
    if not toy:
        _pedals(made, dice, -y - 0.002, 0.05)
    return made.bodies()


def _key_lid(
    dice: Dice, inner: float, back: float, wall: float, bed: float, scale: float, look: Look
) -> Leaf:
    """Closed over the keys; it turns about its back edge."""
    thick, long = 0.015 * scale, dice.between(0.16, 0.19) * scale
    # Above the black keys, which are as high on a toy.
    high = bed + 0.042 + 0.012 * scale
    pin = np.array([0.0, min(back + 0.03 * scale, wall - thick - 0.002), high])
    plate = between((-inner + 0.002, -long, 0), (inner - 0.002, 0, thick))
    lip = between((-inner + 0.002, -long, -0.012 * scale), (inner - 0.002, -long + thick, 0))
    pieces = [plate, lip]
    motion = hinge(pin, (-1, 0, 0), np.radians(dice.between(85, 95)))
    return Leaf("key_lid", "lid", (surface(moved(pieces, pin), look),), motion)


def _top_lid(
    made: Assembly, dice: Dice, width: float, depth: float, height: float, scale: float, look: Look
) -> Leaf:
    """Hinged at the back, or in the middle with a front half."""
    thick, over = 0.02 * scale, 0.01
    part = dice.pick((1.0, 1.0, 0.5)) * depth
    plate = between(
        (-width / 2 - over, -depth / 2 - over, 0.001), (width / 2 + over, -depth / 2 + part, thick)
    )
    pin = (0, -depth / 2 + part, height)
    pieces = [plate + [0, 0, height]]
    if part < depth:
        fixed = between(
            (-width / 2 - over, -depth / 2 + part + 0.001, 0), (width / 2 + over, depth / 2, thick)
        )
        made.fix([fixed + [0, 0, height]], look)
    return Leaf(
        "top_lid", "lid", (surface(pieces, look),), hinge(pin, (-1, 0, 0), np.radians(dice.between(60, 100)))
    )


def _rim(width: float, long: float, sides: int = 10) -> FloatArray:
    """(K, 2) outline of a grand's body: straight at its left, bent in at its right; its front at y = 0."""
    along = np.linspace(0, 1, sides)
    bend = width / 2 - 0.55 * width * (0.5 - 0.5 * np.cos(np.pi * along)) ** 1.2
    right = np.column_stack([bend, (0.2 + 0.7 * along) * long])
    turn = np.linspace(0, np.pi / 2, 6)[1:]
    tail = right[-1, 0] + width / 2
    end = np.column_stack([-width / 2 + tail * np.cos(turn), 0.9 * long + 0.1 * long * np.sin(turn)])
    return np.concatenate([[[-width / 2, 0.0], [width / 2, 0.0]], right, end])


def _grand(dice: Dice) -> Sequence[Body]:
    look = looks.wood(dice)
    width, long, bed, tall = (
        dice.between(1.4, 1.55),
        dice.between(1.4, 2.6),
        dice.between(0.6, 0.68),
        dice.between(0.25, 0.32),
    )
    made, loop = Assembly("body"), _rim(width, long)
    loop = loop - [0, long / 2]
    inner = loop * (0.95, 0.96)
    rings = [
        np.insert(one, 2, z, axis=1)
        for one, z in ((loop, bed), (loop, bed + tall), (inner, bed + tall), (inner, bed + 0.1))
    ]
    near = -long / 2
    stack = np.stack(rings)
    made.fix([sheet(np.concatenate([stack, stack[:, :1]], axis=1)), board(loop, 0.04) + [0, 0, bed]], look)
    made.fix([board(inner * 0.99, 0.01) + [0, 0, bed + 0.12]], looks.metal(dice))
    reach, side, turned_leg = 0.24, 0.05, dice.whole(0, 1000)
    made.fix([between((-width / 2, near - reach, bed - 0.03), (width / 2, near, bed + 0.02))], look)
    made.fix(
        [
            between((s, near - reach, bed + 0.02), (s + side, near, bed + 0.15))
            for s in (-width / 2, width / 2 - side)
        ],
        look,
    )
    _keys(made, dice, width - 2 * side - 0.02, near - reach + 0.02, bed + 0.02)
    for x, y in ((-0.42 * width, near + 0.02), (0.42 * width, near + 0.02), (-0.2 * width, 0.38 * long)):
        made.fix([leg(Dice(turned_leg), bed - 0.02, 0.11) + [x, y, bed - 0.02]], look)
    made.fix(
        [
            box((0.06, 0.06, bed - 0.1), (0, near + 0.1, bed / 2 + 0.05)),
            box((0.26, 0.1, 0.08), (0, near + 0.1, 0.1)),
        ],
        look,
    )
    _pedals(made, dice, near + 0.05, 0.08)
    made.add(_grand_lid(dice, loop, bed + tall, look))
    if dice.chance(0.7):
        made.add(_key_lid(dice, width / 2 - side, near - reach + 0.17, near - 0.005, bed + 0.03, 1.0, look))
    return made.bodies()


def _grand_lid(dice: Dice, loop: FloatArray, level: float, look: Look) -> Leaf:
    """Hinged along the straight side, with a front part that folds back on it."""
    thick = 0.018
    left, right = loop[:, 0].min() - 0.005, loop[:, 0].max() + 0.005
    near, fold = loop[:, 1].min(), loop[:, 1].min() + dice.between(0.15, 0.2) * np.ptp(loop[:, 1])
    behind = loop[loop[:, 1] > fold]
    outline = np.concatenate([[[left, fold], [right, fold]], behind * 1.005])
    plate = board(outline, thick) + [0, 0, level + 0.001 + thick / 2]
    motion: Motion = hinge((left, 0, level), (0, -1, 0), np.radians(dice.between(35, 60)))
    lid = Leaf("top_lid", "lid", (surface([plate], look),), motion)
    flap = between((left, near - 0.01, level + 0.001), (right, fold - 0.002, level + 0.001 + thick))
    pin = (0, fold - 0.001, level + 0.001 + thick)
    over = hinge(pin, (-1, 0, 0), np.radians(dice.between(150, 178)))
    return lid.with_children(Leaf("front_lid", "lid", (surface([flap], look),), over))


CATEGORIES: tuple[Category, ...] = (Category("piano", _piano),)
