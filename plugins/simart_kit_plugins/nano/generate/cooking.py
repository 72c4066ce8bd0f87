"""Ovens and stoves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame, slab
from ...shapes.legs import feet
from ...shapes.placing import around, at, moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, open_box, rod
from . import looks
from .assembling import Assembly, dial, fall, holder, lift, pull, rack, shell, swing, turning
from .category import Category
from .objects import Body, Look


@dataclass(frozen=True)
class _Range:
    """What the parts of an oven share."""

    width: float
    depth: float
    height: float
    wall: float
    thick: float
    coat: Look
    leaf: Look
    grip: Look
    knob: Look
    seed: int

    @property
    def front(self) -> float:
        """Where the leaves lie [m]."""
        return -self.depth / 2

    @classmethod
    def random(cls, dice: Dice) -> _Range:
        coat = looks.painted_metal(dice)
        return cls(
            width=dice.between(0.45, 0.95),
            depth=dice.between(0.45, 0.65),
            height=dice.between(0.55, 0.95),
            wall=dice.between(0.02, 0.06),
            thick=dice.between(0.015, 0.045),
            coat=coat,
            leaf=coat if dice.chance(0.5) else looks.painted_metal(dice),
            grip=looks.metal(dice),
            knob=looks.plastic(dice) if dice.chance(0.6) else looks.metal(dice),
            seed=dice.whole(0, 2**31),
        )


def _oven(dice: Dice) -> list[Body]:
    make = _Range.random(dice)
    kit = Assembly("case")
    panel = make.height * dice.between(0.08, 0.18)
    store = make.height * (dice.between(0.12, 0.25) if dice.chance(0.4) else 0.0)
    room = make.height - panel - store
    rooms = dice.whole(1, 2) if room > 0.6 else 1
    for k in range(rooms):
        low = store + k * room / rooms
        _chamber(dice, kit, make, low, low + room / rooms)
    if store:
        kit.fix([shell(make.width, make.depth, store, 0.01)], make.coat)
        _store(dice, kit, make, store)
    high = make.height
    kit.fix(
        [between((-make.width / 2, make.front, high - panel), (make.width / 2, -make.front, high))], make.coat
    )
    _controls(dice, kit, make, panel)
    if dice.chance(0.45):
        _hob(dice, kit, make, high)
    if dice.chance(0.4):
        low = dice.between(0.03, 0.1)
        kit.fix(feet(dice, make.width, make.depth, low), looks.darker(make.coat, 0.5))
    return kit.done()


def _chamber(dice: Dice, kit: Assembly, make: _Range, low: float, high: float) -> None:
    """A lined room with racks behind a door."""
    tall = high - low
    kit.fix([shell(make.width, make.depth, tall, make.wall) + [0, 0, low]], make.coat)
    wide, deep = make.width - 2 * make.wall, make.depth - 1.4 * make.wall
    skin = shell(wide - 0.004, deep, tall - 2 * make.wall - 0.004, 0.006)
    kit.fix([skin + [0, -0.4 * make.wall, low + make.wall + 0.002]], Look("steel", (60, 60, 66)))
    count = dice.whole(0, 3)
    for k in range(count):
        level = low + make.wall + (tall - 2 * make.wall) * (k + 1) / (count + 1)
        size = (wide - 0.05, deep * 0.86)
        if dice.chance(0.75):
            shape = moved(rack(dice, *size, 0.0), (0, 0, level))
        else:
            shape = moved([open_box((*size, 0.03), 0.003)], (0, 0, level))
        name = "rack" if dice.chance(0.8) else "tray"
        kit.add(name, pull(deep * dice.between(0.5, 0.8)), [(shape, looks.metal(dice))])
        rails = boxes(
            (0.018, deep * 0.9, 0.006), [(s * (wide / 2 - 0.015), 0, level - 0.008) for s in (-1, 1)]
        )
        kit.fix([rails], looks.metal(dice))
    _oven_door(kit, make, low, high)


def _oven_door(kit: Assembly, make: _Range, low: float, high: float) -> None:
    """A door with a window, hinged below or at a side; the same in every chamber."""
    dice = Dice(make.seed)
    width, height = make.width * dice.between(0.96, 1.0), high - low - 0.006
    border = dice.between(0.12, 0.25) * min(width, height)
    y = make.front - 0.003
    place = np.array([0, y, (low + high) / 2])
    parts: list[tuple[Pieces, Look]]
    style = dice.unit()
    if style < 0.5:
        pane = box((width - 2 * border, make.thick * 0.4, height - 2 * border), (0, -make.thick / 2, 0))
        parts = [([frame(width, height, make.thick, border)], make.leaf), ([pane], looks.glass(dice))]
    elif style < 0.75:
        pane = box((width - 2 * border, 0.004, height - 2 * border), (0, -make.thick - 0.002, 0))
        parts = [(slab(dice, width, height, make.thick), make.leaf), ([pane], looks.glass(dice))]
    else:
        parts = [
            (slab(dice, width, height, make.thick), looks.glass(dice) if dice.chance(0.5) else make.leaf)
        ]
    if dice.chance(0.6):
        inner = box((width - 3 * make.wall, 0.02, height - 3 * make.wall), (0, 0.0101, 0))
        parts.append(([inner], Look("steel", (70, 70, 74))))
    upright = dice.chance(0.25)
    side = dice.sign()
    if upright:
        grip = moved(
            holder(dice, height * dice.between(0.3, 0.8), upright=True),
            (-side * (width / 2 - 0.05), -make.thick, 0),
        )
        motion = swing(side, side * width / 2, y, dice.between(1.5, 2.0), place[2])
    else:
        grip = moved(holder(dice, width * dice.between(0.4, 0.9)), (0, -make.thick, height / 2 - 0.04))
        motion = fall(y, low + 0.003, dice.between(1.3, 1.57))
    parts.append((grip, make.grip))
    kit.add("door", motion, [(moved(pieces, place), look) for pieces, look in parts])


def _store(dice: Dice, kit: Assembly, make: _Range, high: float) -> None:
    """A drawer or a flap below the oven."""
    y = make.front - 0.003
    face = moved(slab(dice, make.width * 0.98, high - 0.008, make.thick), (0, y, high / 2))
    parts: list[tuple[Pieces, Look]] = [(face, make.leaf)]
    if dice.chance(0.6):
        grip = holder(dice, make.width * dice.between(0.2, 0.6))
        parts.append((moved(grip, (0, y - make.thick, high * 0.6)), make.grip))
    if dice.chance(0.8):
        tub = open_box((make.width - 0.06, make.depth * 0.85, (high - 0.03) * 0.7), 0.004)
        parts.append(([tub + [0, y + make.depth * 0.425, 0.015]], looks.metal(dice)))
        kit.add("drawer", pull(make.depth * 0.7), parts)
    else:
        kit.add("flap", fall(y, 0.004, 1.4), parts)


def _controls(dice: Dice, kit: Assembly, make: _Range, panel: float) -> None:
    """Knobs on the band above the door."""
    count = dice.whole(1, 7)
    radius = min(panel * 0.36, make.width / count * 0.3, 0.03)
    z = make.height - panel / 2
    seed = dice.whole(0, 2**31)
    spread = dice.between(0.6, 0.9) * make.width
    skip = count // 2 if count > 3 and dice.chance(0.5) else -1
    for k in range(count):
        spot = ((k + 0.5 - count / 2) * spread / count, make.front, z)
        if k == skip:
            clock = box((spread / count * 0.8, 0.004, panel * 0.4), (spot[0], make.front - 0.002, z))
            kit.fix([clock], looks.glass(dice))
            continue
        shape = moved(dial(Dice(seed), radius), spot)
        kit.add("knob", turning(Dice(seed + 1), spot), [(shape, make.knob)])


def _hob(dice: Dice, kit: Assembly, make: _Range, level: float) -> None:
    """Burners under grates, or plates, or a pane with rings."""
    spots = [(x * make.width / 4, y * make.depth / 4, level) for x in (-1, 1) for y in (-1, 1)]
    radius = min(make.width, make.depth) * dice.between(0.1, 0.17)
    dark = Look("steel", (40, 40, 42))
    style = dice.unit()
    if style < 0.3:
        kit.fix(
            [box((make.width * 0.98, make.depth * 0.96, 0.006), (0, 0, level + 0.003))], looks.glass(dice)
        )
        kit.fix(at(cylinder(radius, 0.002, 18), np.array(spots) + [0, 0, 0.007]), dark)
    else:
        kit.fix(at(cylinder(radius * 0.7, 0.02, 16), np.array(spots) + [0, 0, 0.01]), dark)
    if style > 0.6:
        bar = rod((radius * 0.3, 0, 0.035), (radius * 1.3, 0, 0.035), 0.005, 4)
        post = box((0.008, 0.008, 0.035), (radius * 1.3, 0, 0.0175))
        star = around([bar, post], 4)
        kit.fix([piece for one in star for piece in at(one, spots)], dark)
    if dice.chance(0.3):
        low, high = (
            (-make.width / 2, make.depth / 2 - 0.03, level),
            (make.width / 2, make.depth / 2, level + 0.12),
        )
        kit.fix([between(low, high)], make.coat)
    if dice.chance(0.2):
        lid = box((make.width, make.depth * 0.92, 0.012), (0, 0, level + 0.05))
        feet_ = boxes(
            (0.02, 0.02, 0.05), [(s * make.width * 0.45, make.depth * 0.45, level + 0.025) for s in (-1, 1)]
        )
        kit.fix([feet_], dark)
        kit.add(
            "lid",
            lift(make.depth * 0.46, level + 0.044, dice.between(1.4, 1.65)),
            [([lid], looks.glass(dice))],
        )


def _stove(dice: Dice) -> list[Body]:
    """A hob alone: on a case or let into a piece of worktop, with knobs on its front or its top."""
    make = _Range.random(dice)
    kit = Assembly("case")
    high = dice.between(0.05, 0.14)
    kit.fix([box((make.width, make.depth, high), (0, 0, high / 2))], make.coat)
    if dice.chance(0.6):
        kit.fix(feet(dice, make.width, make.depth, dice.pick((0.015, 0.03, 0.6))), looks.rubber(dice))
    _hob(dice, kit, make, high)
    count = dice.whole(1, 5)
    seed = dice.whole(0, 2**31)
    lean = rotation((1, 0, 0), dice.pick((0.0, 0.0, -0.5)))
    on_top = dice.chance(0.4)
    if on_top:
        lean = rotation((1, 0, 0), -np.pi / 2)
    radius = min(0.02, high * 0.4)
    reach = make.width * dice.between(0.4, 0.85)
    if not on_top and lean[1, 1] < 1:
        kit.fix(
            turned(
                [box((make.width, 0.03, high * 1.05), (0, make.front + 0.009, high / 2))],
                lean,
                (0, make.front, high / 2),
            ),
            make.coat,
        )
        make_front = make.front - 0.006
    else:
        make_front = make.front
    for k in range(count):
        x = (k + 0.5 - count / 2) * reach / count
        spot = (x, make.front + 0.035, high) if on_top else (x, make_front, high / 2)
        shape = moved(turned(dial(Dice(seed), radius), lean), spot)
        kit.add("knob", turning(Dice(seed + 1), spot, lean @ [0, 1, 0]), [(shape, make.knob)])
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("oven", _oven),
    Category("stove", _stove),
)
