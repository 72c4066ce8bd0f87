"""Gates, garage doors and hatches."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame, front
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    boxes,
    cylinder,
    loft,
    prism,
    rod,
    superquadric,
    torus,
)
from . import looks
from .assembling import Assembly, disc, holder, lever, swing
from .category import Category
from .objects import Body, Look, hinge, slide, spin


def _gate(dice: Dice) -> list[Body]:
    """Leaves of bars or boards between posts, with a latch."""
    kit, look = Assembly("posts"), looks.metal(dice) if dice.chance(0.5) else looks.wood(dice)
    count, height = dice.whole(1, 2), dice.between(0.7, 1.9)
    wide = dice.between(0.6, 1.6)
    width, post = wide * count, dice.between(0.05, 0.2)
    posts = [(s * (width + post) / 2, 0, height * 0.53) for s in (-1, 1)]
    stone = Look("stone", (170, 165, 158)) if dice.chance(0.3) else look
    kit.fix(at(box((post, post, height * 1.06)), posts), stone)
    if dice.chance(0.5):
        kit.fix(
            at(
                superquadric((post * 1.3, post * 1.3, post * 0.6), rows=5),
                np.array(posts) * [1, 1, 2] + [0, 0, post * 0.2],
            ),
            stone,
        )
    seed, metal = dice.whole(0, 2**31), looks.metal(dice)
    slides = count == 1 and dice.chance(0.2)
    sides = (-1, 1) if count == 2 else (dice.sign(),)
    for side in sides:
        style, x = Dice(seed), side * (width - wide) / 2
        face = moved(_lattice(style, wide - 0.03, height * 0.9), (x, 0, height * 0.52))
        if slides:
            shift = (0, -post / 2 - 0.03, 0)
            kit.add("gate", slide((side, 0, 0), wide * 0.95), [(moved(face, shift), look)])
            continue
        pins = [
            rod((x + side * (wide / 2 - 0.015), 0, z), (side * width / 2, 0, z), 0.012)
            for z in (height * 0.2, height * 0.85)
        ]
        name = "gate" if count == 1 else ("left_gate" if side < 0 else "right_gate")
        leaf = kit.add(
            "gate",
            swing(side, side * width / 2 - side * 0.004, 0, dice.between(1.2, 1.57)),
            [(face, look), (pins, metal)],
            name=name,
        )
        if side == sides[-1]:
            _latch(
                dice, kit, leaf, x - side * (wide / 2 - 0.03), height * dice.between(0.5, 0.85), side, metal
            )
    return kit.done()


def _lattice(dice: Dice, width: float, height: float) -> Pieces:
    """Rails with pickets or bars, some with a brace, about 0."""
    thick = dice.between(0.02, 0.05)
    count, style = dice.whole(4, 12), dice.unit()
    rails = boxes(
        (width, thick, thick * 1.5),
        [(0, 0, z * height) for z in ((-0.4, 0.4) if style < 0.5 else (-0.48, 0.0, 0.48))],
    )
    across = (np.arange(count) + 0.5) / count * width - width / 2
    pieces: Pieces = [rails]
    bow = dice.between(-0.15, 0.15) if dice.chance(0.4) else 0.0
    for x in across:
        tall = height * (1 - abs(bow) + bow * (1 - (2 * x / width) ** 2))
        if style < 0.5:
            pieces.append(
                box((width / count * 0.75, thick * 0.6, tall), (x, -thick * 0.8, (tall - height) / 2))
            )
        else:
            pieces.append(rod((x, 0, -height / 2), (x, 0, tall - height / 2), thick * 0.25, 6))
    if dice.chance(0.4):
        pieces.append(
            rod(
                (-width / 2, thick * 0.3, -0.4 * height),
                (width / 2, thick * 0.3, 0.4 * height),
                thick * 0.4,
                4,
            )
        )
    return pieces + [box((thick, thick, height * 0.98), (s * (width - thick) / 2, 0, 0)) for s in (-1, 1)]


def _latch(dice: Dice, kit: Assembly, leaf: int, x: float, z: float, side: int, metal: Look) -> None:
    """A bolt that slides towards the post, or a bar that lifts."""
    spot = np.array([x, -0.05, z])
    if dice.chance(0.5):
        bar = [
            rod((side * 0.12, 0, 0), (-side * 0.02, 0, 0), 0.008, 8),
            rod((side * 0.05, 0, 0), (side * 0.05, -0.04, 0), 0.006),
        ]
        kit.fix(moved([box((0.1, 0.01, 0.06), (side * 0.06, 0.02, 0))], spot), metal, leaf)
        kit.add("bolt", slide((side, 0, 0), 0.05), [(moved(bar, spot), metal)], leaf)
    else:
        shape = moved([box((0.14, 0.008, 0.025), (-side * 0.04, 0, 0))], spot)
        pin = spot + [side * 0.02, 0, 0]
        kit.add("latch", hinge(pin, (0, side, 0), 0.7), [(shape, metal)], leaf)


def _garage(dice: Dice) -> list[Body]:
    """A door that lifts: in one piece, tilted or straight up, or sections of which each hangs on the last."""
    kit = Assembly("frame")
    width, height = dice.between(2.0, 4.5), dice.between(1.9, 2.6)
    border, deep = dice.between(0.08, 0.3), dice.between(0.1, 0.25)
    wall, coat = Look("stone", (205, 200, 190)), looks.painted_metal(dice)
    posts = boxes(
        (border, deep, height + border),
        [(s * (width + border) / 2, deep / 2, (height + border) / 2) for s in (-1, 1)],
    )
    kit.fix([posts, box((width, deep, border), (0, deep / 2, height + border / 2))], wall)
    thick, metal = dice.between(0.03, 0.06), looks.metal(dice)
    y = deep * dice.between(0.3, 0.7)
    style = dice.unit()
    if style < 0.45:
        face = moved(_big_face(dice, width - 0.02, height - 0.01, thick), (0, y, height / 2))
        grip = moved(holder(dice, 0.2), (0, y - thick, height * dice.between(0.1, 0.45)))
        motion = hinge((0, y - thick, height), (-1, 0, 0), dice.between(1.2, 1.57))
        leaf = kit.add("door", motion, [(face, coat), (grip, metal)])
        if dice.chance(0.4):
            pin = (0, y - thick, height * 0.5)
            kit.fix(moved([disc(0.04, 0.01, 12)], pin), metal, leaf)
            shape = moved([box((0.14, 0.015, 0.02), (0, -0.03, 0)), rod((0, 0, 0), (0, -0.03, 0), 0.01)], pin)
            kit.add("handle", hinge(pin, (0, 1, 0), 1.57), [(shape, metal)], leaf)
    else:
        # Behind the head, past which it goes up.
        _roller(dice, kit, (width, height), (deep + thick + 0.004, thick), coat, metal)
    return kit.done()


def _big_face(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    rows, columns = dice.whole(3, 5), dice.whole(2, 6)
    pieces: Pieces = [box((width, thick * 0.6, height), (0, -thick * 0.3, 0))]
    if dice.chance(0.3):
        return front(dice, width, height, thick)
    cell = np.array([width / columns, thick * 0.4, height / rows])
    inner = cell * [dice.between(0.6, 0.9), 1, dice.between(0.5, 0.85)]
    places = [
        ((c + 0.5) * cell[0] - width / 2, -thick * 0.8, (r + 0.5) * cell[2] - height / 2)
        for r in range(rows)
        for c in range(columns)
    ]
    return [*pieces, boxes(inner, places)]


def _roller(
    dice: Dice, kit: Assembly, size: tuple[float, float], at_: tuple[float, float], coat: Look, metal: Look
) -> None:
    """Sections or slats between rails that go straight up behind the head."""
    width, height = size
    y, thick = at_
    count = dice.pick((4, 5, 8, 14))
    step = height / count
    bars = [
        box((width - 0.06, thick * 0.8, step - 0.006), (0, y - thick / 2, (k + 0.5) * step))
        for k in range(count)
    ]
    if dice.chance(0.5):
        bars.append(boxes((width - 0.06, 0.01, 0.02), [(0, y - thick, k * step) for k in range(1, count)]))
    grip = moved(holder(dice, 0.18), (0, y - thick, step * 0.6))
    rails = boxes(
        (0.025, thick * 2, height), [(s * (width / 2 - 0.0125), y - thick / 2, height / 2) for s in (-1, 1)]
    )
    kit.fix([rails], metal)
    if dice.chance(0.6):
        kit.fix([box((width + 0.1, 0.3, 0.3), (0, y + 0.3, height + 0.2))], metal)
    kit.add("door", slide((0, 0, 1), height * dice.between(0.85, 0.97)), [(bars, coat), (grip, metal)])


def _hatch(dice: Dice) -> list[Body]:
    """A lid in a frame on the floor, in a wall or on a slope: square or round, with a wheel or a ring."""
    kit, coat = Assembly("frame"), looks.painted_metal(dice) if dice.chance(0.6) else looks.wood(dice)
    wide, high = dice.between(0.3, 0.9), dice.between(0.3, 0.9)
    border, thick = dice.between(0.03, 0.1), dice.between(0.015, 0.06)
    metal = looks.metal(dice)
    if dice.chance(0.35):
        high = wide
        ring = loft(
            ngon(24),
            [
                (wide, wide, 0),
                (wide + 2 * border, wide + 2 * border, 0),
                (wide + 2 * border, wide + 2 * border, thick * 2),
                (wide, wide, thick * 2),
                (wide, wide, 0),
            ],
        )
        kit.fix([ring], metal)
        level = thick * 2 + 0.002 if dice.chance(0.5) else thick
        across = wide + border if level > 2 * thick else wide - 0.006
        lid: Pieces = [cylinder(across / 2, thick, 24) + [0, 0, level + thick / 2]]
    else:
        kit.fix(
            [
                frame(wide + 2 * border, high + 2 * border, thick * 2, border)
                @ rotation((1, 0, 0), -np.pi / 2).T
            ],
            metal,
        )
        level, across = thick, high - 0.006
        outline = dice.pick((SQUARE, SQUARE, rounded(0.1, wide / high)))
        lid = [prism(outline, (wide - 0.006, high - 0.006, thick)) + [0, 0, level + thick / 2]]
    pin = np.array([0, across / 2 + (0.012 if level <= thick else 0), level + thick])
    lugs = at(pointed(cylinder(0.01, 0.08, 8), X), [(s * wide * 0.25, pin[1], pin[2]) for s in (-1, 1)])
    reach = across * 0.3
    lugs += at(box((0.03, reach, 0.006)), [(s * wide * 0.25, pin[1] - reach / 2, pin[2]) for s in (-1, 1)])
    leaf = kit.add("hatch", hinge(pin, (-1, 0, 0), dice.between(1.2, 1.9)), [(lid, coat), (lugs, metal)])
    top = level + thick
    _hatch_grip(dice, kit, leaf, min(wide, high), top, metal)
    ways = (
        np.eye(3),
        rotation((1, 0, 0), np.pi / 2),
        rotation((1, 0, 0), np.pi / 2) @ rotation((0, 0, 1), np.pi / 2),
        rotation((1, 0, 0), dice.between(0.2, 1.2)),
    )
    return kit.done(dice.pick(ways))


def _hatch_grip(dice: Dice, kit: Assembly, leaf: int, room: float, top: float, metal: Look) -> None:
    """A wheel, a folding ring, a lever or a fixed handle on a level lid."""
    style = dice.unit()
    up = rotation((1, 0, 0), -np.pi / 2)
    if style < 0.3:
        radius = room * dice.between(0.15, 0.3)
        spoke = rod((0, 0, 0), (radius, 0, 0), radius * 0.06)
        shape = [
            torus(radius, radius * 0.08, 20),
            cylinder(radius * 0.15, radius * 0.3, 10),
            *around([spoke], dice.whole(3, 6)),
        ]
        kit.fix([cylinder(0.015, 0.06, 10) + [0, 0, top + 0.03]], metal, leaf)
        kit.add("wheel", spin((0, 0, top), (0, 0, 1)), [(moved(shape, (0, 0, top + 0.06)), metal)], leaf)
    elif style < 0.5:
        pin = (0, -room * 0.3, top + 0.008)
        ring = [torus(0.035, 0.006, 18) + [0, -0.035, 0]]
        kit.add("ring", hinge(pin, (-1, 0, 0), 1.57), [(moved(ring, pin), metal)], leaf)
    elif style < 0.75:
        pin = (0, -room * 0.32, top)
        shape = moved(turned(lever(dice, 0.1, 0.008), up), pin)
        kit.add("handle", hinge(pin, (0, 0, dice.sign()), 1.57), [(shape, metal)], leaf)
    else:
        kit.fix(moved(turned(holder(dice, room * 0.4), up), (0, -room * 0.3, top)), metal, leaf)


CATEGORIES: tuple[Category, ...] = (
    Category("gate", _gate),
    Category("garage_door", _garage),
    Category("hatch", _hatch),
)
