"""Doors in their frames."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame, framed, glazed, louvred, planked, raised, slab
from ...shapes.handles import knob
from ...shapes.placing import Y, Z, at, mirrored, moved, pointed
from ...shapes.primitives import Pieces, box, boxes, cylinder
from . import looks
from .assembling import Assembly, disc, holder, lever, rosette, swing
from .category import Category
from .objects import Body, Look, hinge, slide

_Size = tuple[float, float]


def _door(dice: Dice) -> list[Body]:
    make = dice.weighted([(6, _hinged), (2, _sliding), (2, _folding)])
    kit = Assembly("frame")
    size = (dice.between(0.6, 1.05), dice.between(1.85, 2.3))
    make(dice, kit, size)
    return kit.done()


def _surround(dice: Dice, kit: Assembly, width: float, height: float, deep: float) -> Look:
    """Posts and a head about an opening that stands on z = 0, some with a sill, casings or a wall."""
    look, border = looks.wood(dice), dice.between(0.03, 0.1)
    posts = boxes(
        (border, deep, height + border),
        [(s * (width + border) / 2, deep / 2, (height + border) / 2) for s in (-1, 1)],
    )
    head = box((width, deep, border), (0, deep / 2, height + border / 2))
    kit.fix([posts, head], look)
    if dice.chance(0.4):
        stop = 0.012
        bars = boxes(
            (stop, stop, height), [(s * (width - stop) / 2, deep * 0.75, height / 2) for s in (-1, 1)]
        )
        kit.fix([bars, box((width - 2 * stop, stop, stop), (0, deep * 0.75, height - stop / 2))], look)
    if dice.chance(0.3):
        kit.fix([box((width, deep, 0.012), (0, deep / 2, -0.006))], looks.metal(dice))
    if dice.chance(0.25):
        wide = dice.between(0.1, 0.8)
        sides = (-1, 1) if dice.chance(0.6) else (dice.sign(),)
        walls = [
            box(
                (wide, deep * 0.8, height + border),
                (s * (width / 2 + border + wide / 2), deep / 2, (height + border) / 2),
            )
            for s in sides
        ]
        kit.fix(walls, Look("stone", (214, 208, 198)))
    return look


def leaf_face(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A door leaf from y = -thick to 0, about x = z = 0."""
    style = dice.unit()
    if style < 0.6:
        make = dice.pick((slab, framed, raised, planked, louvred, glazed))
        return make(dice, width, height, thick)
    if style < 0.75:
        return _panelled(dice, width, height, thick)
    share = dice.between(0.3, 0.6)
    upper = glazed(dice, width, height * share, thick)
    lower = raised(dice, width, height * (1 - share), thick)
    return moved(upper, (0, 0, height * (1 - share) / 2)) + moved(lower, (0, 0, -height * share / 2))


def _panelled(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A grid of fields let into a leaf, on both faces."""
    rows, columns = dice.whole(2, 4), dice.whole(1, 2)
    bar = dice.between(0.06, 0.12)
    pieces: Pieces = [box((width, thick * 0.4, height), (0, -thick / 2, 0))]
    levels = np.linspace(-height / 2 + bar / 2, height / 2 - bar / 2, rows + 1)
    pieces.append(boxes((width, thick, bar), [(0, -thick / 2, z) for z in levels]))
    across = np.linspace(-width / 2 + bar / 2, width / 2 - bar / 2, columns + 1)
    pieces.append(boxes((bar, thick, height), [(x, -thick / 2, 0) for x in across]))
    return pieces


def fittings(
    dice: Dice, kit: Assembly, leaf: int, spot: tuple[float, float, float], thick: float, point: int
) -> None:
    """Handles of a leaf whose front is at `spot`: a lever or a knob that turns on it, or a fixed grip.

    Args:
        dice: of the whole door, so that two leaves may have the same.
        kit: gets them.
        leaf: number of the body that they sit on.
        spot: where, on the front of the leaf.
        thick: of the leaf; the back has the same.
        point: x direction of a lever.
    """
    metal, style, both = looks.metal(dice), dice.unit(), dice.chance(0.75)
    back = np.array(spot) + [0, thick, 0]
    plates = rosette(dice, dice.between(0.04, 0.12))
    kit.fix(moved(plates, spot), metal, leaf)
    if both:
        kit.fix(moved(mirrored(plates, Y), back), metal, leaf)
    if style < 0.5:
        shape = lever(dice, dice.between(0.08, 0.14), dice.between(0.006, 0.011))
        shape = [piece * [point, 1, 1] for piece in shape]
        motion = hinge(spot, (0, point, 0), dice.between(0.5, 1.0))
    elif style < 0.7:
        shape = knob(dice, dice.between(0.02, 0.034))
        reach = dice.between(0.6, 1.2)
        motion = hinge(spot, (0, 1, 0), reach, -reach)
    else:
        shape = holder(dice, dice.between(0.15, 0.6), upright=True)
        motion = None
    pieces = moved(shape, np.array(spot) - [0, 0.006, 0])
    if both:
        pieces += moved(mirrored(shape, Y), back + [0, 0.006, 0])
    if motion is None:
        kit.fix(pieces, metal, leaf)
    else:
        kit.add("handle", motion, [(pieces, metal)], leaf)
    if dice.chance(0.4):
        _cylinder_lock(dice, kit, leaf, np.array(spot) - [0, 0, dice.between(0.07, 0.15)], metal)


def _cylinder_lock(dice: Dice, kit: Assembly, leaf: int, spot: FloatArray, metal: Look) -> None:
    """A lock below the handle, some with a thumb turn or a key of its own."""
    kit.fix(moved([disc(0.02, 0.006, 16)], spot), metal, leaf)
    if dice.chance(0.5):
        key = box((0.006, 0.022, 0.026), (0, -0.017, 0))
        kit.add(
            "key", hinge(spot, (0, 1, 0), dice.pick((1.57, 3.14, 6.28))), [(moved([key], spot), metal)], leaf
        )


def _extras(dice: Dice, kit: Assembly, leaf: int, middle: tuple[float, float, float], size: _Size) -> None:
    """A letter flap, a peephole, a kick plate, a flap for a cat."""
    metal = looks.metal(dice)
    x, y, z = middle
    width, height = size
    if dice.chance(0.15):
        wide = min(0.28, width * 0.5)
        level = z + dice.between(-0.15, 0.0) * height
        kit.fix([frame(wide + 0.04, 0.09, 0.006, 0.02) + [x, y, level]], metal, leaf)
        flap = [box((wide, 0.004, 0.048), (x, y - 0.004, level))]
        kit.add(
            "flap",
            hinge((x, y - 0.004, level + 0.025), (-1, 0, 0), dice.between(0.8, 1.5)),
            [(flap, metal)],
            leaf,
            "letter_flap",
        )
    if dice.chance(0.15):
        kit.fix([box((width * 0.9, 0.002, 0.2), (x, y - 0.001, z - height / 2 + 0.12))], metal, leaf)
    if dice.chance(0.1):
        kit.fix(moved([disc(0.01, 0.005, 10)], (x, y, z + 0.25 * height)), metal, leaf)
    if dice.chance(0.07) and width > 0.5:
        kit.fix([frame(0.28, 0.32, 0.012, 0.03) + [x, y, z - height / 2 + 0.3]], metal, leaf)
        flap = [box((0.215, 0.006, 0.255), (x, y - 0.008, z - height / 2 + 0.3))]
        motion = hinge((x, y - 0.008, z - height / 2 + 0.43), (1, 0, 0), 1.2, -1.2)
        kit.add("flap", motion, [(flap, looks.plastic(dice))], leaf, "pet_flap")


def _hinged(dice: Dice, kit: Assembly, size: _Size) -> None:
    """One leaf or two, hung on the frame."""
    count = dice.weighted([(3, 1), (1, 2)])
    width, height = size[0] * count * (0.85 if count == 2 else 1), size[1]
    thick, deep = dice.between(0.03, 0.06), dice.between(0.05, 0.2)
    _surround(dice, kit, width, height, deep)
    inset = dice.chance(0.6)
    y = thick if inset else -0.002
    wide = width / count - (0.006 if inset else -0.03 / count)
    tall = height - 0.01 if inset else height + 0.01
    seed, coat, metal = dice.whole(0, 2**31), looks.wood(dice), looks.metal(dice)
    upper, level = dice.between(1.3, 2.0), dice.between(0.95, 1.1)
    sides = (-1, 1) if count == 2 else (dice.sign(),)
    for side in sides:
        style = Dice(seed)
        x = side * width / 4 if count == 2 else 0.0
        pin = side * (width / 2 - 0.003 if inset else width / 2 + 0.015)
        face = moved(leaf_face(style, wide, tall, thick), (x, y, tall / 2 + 0.005))
        knuckle = pointed(cylinder(0.007, 0.09, 8), Z)
        pins = at(knuckle, [(pin, y - thick - 0.003, q * tall) for q in (0.15, 0.85)])
        name = "door" if count == 1 else ("left_door" if side < 0 else "right_door")
        motion = swing(side, pin, y - thick - 0.003, upper)
        leaf = kit.add("door", motion, [(face, coat), (pins if dice.chance(0.6) else [], metal)], name=name)
        passive = style.chance(0.3)
        if count == 2 and side < 0 and passive:
            continue
        grip_x = x - side * (wide / 2 - 0.07)
        fittings(style, kit, leaf, (grip_x, y - thick, level), thick, side)
        _extras(style, kit, leaf, (x, y - thick, tall / 2), (wide, tall))


def _sliding(dice: Dice, kit: Assembly, size: _Size) -> None:
    """Leaves on a rail before a wall or in each other's way."""
    width, height = size[0], size[1]
    thick = dice.between(0.025, 0.045)
    coat, metal, seed = looks.wood(dice), looks.metal(dice), dice.whole(0, 2**31)
    if dice.chance(0.5):
        side = dice.sign()
        _surround(dice, kit, width, height, dice.between(0.06, 0.15))
        rail_y = -thick / 2 - 0.03
        kit.fix([box((2.1 * width, 0.02, 0.05), (side * width / 2, rail_y, height + 0.12))], metal)
        kit.fix(
            at(
                box((0.03, 0.04, 0.03)),
                [(side * width * q, rail_y + 0.015, height + 0.12) for q in (-0.4, 0.4, 1.4)],
            ),
            metal,
        )
        face = moved(leaf_face(dice, width + 0.06, height + 0.03, thick), (0, -0.02, height / 2 + 0.015))
        straps = [
            box((0.04, 0.01, 0.16), (x, -0.045 - thick, height + 0.06)) for x in (-0.35 * width, 0.35 * width)
        ]
        rolls = [
            moved([disc(0.04, 0.02, 14)], (x, -0.03 - thick - 0.01, height + 0.15))[0]
            for x in (-0.35 * width, 0.35 * width)
        ]
        leaf = kit.add("door", slide((side, 0, 0), width * 0.95), [(face, coat), (straps + rolls, metal)])
        kit.fix(
            moved(holder(dice, 0.3, upright=True), (-side * 0.42 * width, -0.02 - thick, 1.0)), metal, leaf
        )
        return
    count = dice.whole(2, 3)
    _surround(dice, kit, width * count, height, thick * 2 + 0.05)
    step = width + 0.02
    for k in range(count):
        x = (k - (count - 1) / 2) * width * 0.98
        track = 0.01 + thick + (k % 2) * (thick + 0.01)
        style = Dice(seed)
        face = moved(leaf_face(style, step, height - 0.012, thick), (x, track, height / 2))
        parts: list[tuple[Pieces, Look]] = [(face, coat)]
        if style.chance(0.6):
            pull = moved(
                [disc(0.025, 0.004, 14)], (x + (-1 if k % 2 else 1) * 0.42 * width, track - thick, 1.0)
            )
            parts.append((pull, metal))
        way = 1 if k < count / 2 - 0.5 else -1
        kit.add("sliding door", slide((way, 0, 0), width * dice.between(0.85, 0.95)), parts)


def _folding(dice: Dice, kit: Assembly, size: _Size) -> None:
    """Two or four leaves in pairs: the second of a pair hangs on the first."""
    pairs = dice.weighted([(2, 1), (1, 2)])
    width, height, thick = size[0] * pairs, size[1], dice.between(0.02, 0.035)
    _surround(dice, kit, width, height, dice.between(0.06, 0.15))
    coat, metal, seed = looks.wood(dice), looks.metal(dice), dice.whole(0, 2**31)
    wide, y = width / (2 * pairs), thick
    first = dice.sign()
    for side in (-1, 1) if pairs == 2 else (first,):
        name = "left" if side < 0 else "right"
        edge = side * width / 2
        faces = []
        for k in range(2):
            x = edge - side * (k + 0.5) * wide
            faces.append(moved(leaf_face(Dice(seed), wide - 0.005, height - 0.01, thick), (x, y, height / 2)))
        outer = kit.add(
            "folding door",
            swing(side, edge, y - thick / 2, 1.45),
            [(faces[0], coat)],
            name=f"{name}_outer_leaf",
        )
        joint = edge - side * wide
        # The pin is at the front, so that the second leaf folds back against the first one's face.
        motion = hinge((joint, y, 0), (0, 0, -side), 2.9)
        inner = kit.add("folding door", motion, [(faces[1], coat)], outer, f"{name}_inner_leaf")
        if dice.chance(0.8):
            grip = moved(knob(Dice(seed), 0.018), (joint - side * wide * 0.2, y - thick, 1.0))
            kit.fix(grip, metal, inner)


CATEGORIES: tuple[Category, ...] = (Category("door", _door),)
