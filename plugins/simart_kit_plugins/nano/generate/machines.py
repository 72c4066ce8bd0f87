"""Tills, copiers, vending machines and radiators."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame, slab
from ...shapes.legs import feet
from ...shapes.placing import X, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, open_box, rod
from . import looks
from .assembling import Assembly, dial, disc, fall, holder, lift, press, pull, shell, swing, turning
from .category import Category
from .objects import Body, Look, hinge, slide, spin

_Size = tuple[float, float, float]


def _cash_register(dice: Dice) -> list[Body]:
    """A drawer below a desk with keys and a screen on a post; some have a crank."""
    kit, coat = Assembly("case"), looks.plastic(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    width, depth, low = dice.between(0.3, 0.48), dice.between(0.3, 0.46), dice.between(0.08, 0.13)
    kit.fix([shell(width, depth, low, 0.008)], coat)
    kit.fix(feet(dice, width * 0.9, depth * 0.9, 0.01), looks.rubber(dice))
    face = moved(slab(dice, width - 0.004, low - 0.006, 0.014), (0, -depth / 2 - 0.002, low / 2))
    face += moved([disc(0.012, 0.006, 14)], (0, -depth / 2 - 0.016, low * 0.6))
    tub = open_box((width - 0.03, depth * 0.85, low * 0.6), 0.004) + [0, -depth * 0.065, 0.012]
    walls = boxes(
        (0.003, depth * 0.8, low * 0.5),
        [(x * width, -depth * 0.065, 0.012 + low * 0.25) for x in (-0.25, 0.0, 0.25)],
    )
    kit.add(
        "drawer", pull(depth * dice.between(0.5, 0.75)), [(face, coat), ([tub, walls], looks.plastic(dice))]
    )
    back, lip = dice.between(0.08, 0.2), dice.between(0.02, 0.05)
    slope = np.arctan2(back - lip, depth * 0.7)
    kit.fix([box((width, depth, lip), (0, 0, low + lip / 2))], coat)
    board = turned([box((width, depth * 0.7 / np.cos(slope), 0.02))], rotation((1, 0, 0), slope))
    middle = np.array([0, -depth * 0.14, low + (back + lip) / 2])
    kit.fix(moved(board, middle), coat)
    wedge = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5)])
    side = loft(wedge, [(0, 0, -0.5), (1, 1, -0.5), (1, 1, 0.5), (0, 0, 0.5)])
    ramp = pointed(side, X) * [width, depth * 0.7, back - lip]
    kit.fix([ramp + middle], coat)
    kit.fix([box((width, depth * 0.32, back), (0, depth * 0.34, low + back / 2))], coat)
    _keys(dice, kit, (width, depth), middle, slope)
    _screen(dice, kit, depth * 0.36, low + back, width)
    return kit.done()


def _keys(dice: Dice, kit: Assembly, size: tuple[float, float], middle: FloatArray, slope: float) -> None:
    """Keys that go down into a sloped board."""
    rows, columns = dice.whole(3, 6), dice.pick((dice.whole(3, 5), dice.whole(5, 10)))
    turn = rotation((1, 0, 0), slope)
    cell = (size[0] * 0.7 / columns, size[1] * 0.55 / rows)
    look = looks.plastic(dice)
    for row in range(rows):
        for column in range(columns):
            spot = turn @ np.array(
                [
                    (column - (columns - 1) / 2) * cell[0] - 0.08 * size[0],
                    (row - (rows - 1) / 2) * cell[1],
                    0.01,
                ]
            )
            spot = spot + middle
            shape = moved(turned([box((cell[0] * 0.75, cell[1] * 0.75, 0.012), (0, 0, 0.006))], turn), spot)
            kit.add("key", slide(turn @ [0, 0, -1], 0.004), [(shape, look)])


def _screen(dice: Dice, kit: Assembly, y: float, level: float, width: float) -> None:
    """A display on a post that swivels or tilts, or none."""
    if dice.chance(0.25):
        return
    pin = np.array([dice.between(-0.2, 0.2) * width, y, level])
    rise, wide = dice.between(0.05, 0.16), dice.between(0.12, 0.3)
    post = [rod(pin, pin + [0, 0, rise], 0.012, 10)]
    panel = [box((wide, 0.025, wide * 0.5), pin + [0, -0.02, rise + wide * 0.2])]
    dark = Look("plastic", (30, 30, 34))
    if dice.chance(0.5):
        kit.fix([cylinder(0.02, 0.012, 14) + pin], dark)
        kit.add("screen", hinge(pin, (0, 0, 1), 1.4, -1.4), [(post + panel, dark)])
    else:
        barrel = [pointed(cylinder(0.014, 0.05, 12), X) + pin + [0, 0, rise]]
        kit.fix(post, dark)
        kit.add("screen", hinge(pin + [0, 0, rise], (1, 0, 0), 0.5, -0.3), [(panel + barrel, dark)])


def _printer(dice: Dice) -> list[Body]:
    """A case with trays that pull out, a lid over the glass, flaps for paper, and buttons."""
    kit, coat = Assembly("case"), looks.plastic(dice)
    tall = dice.chance(0.3)
    width, depth = dice.between(0.35, 0.6), dice.between(0.3, 0.55)
    height = dice.between(0.6, 1.0) if tall else dice.between(0.12, 0.4)
    trays = dice.whole(1, 4) if tall else dice.whole(0, 2)
    room = height * (0.7 if tall else 0.45) / max(trays, 1) if trays else 0.0
    room = min(room, 0.18)
    used = trays * room
    for k in range(trays):
        kit.fix([shell(width, depth, room, 0.01) + [0, 0, k * room]], coat)
        face = moved(
            slab(dice, width - 0.006, room - 0.006, 0.018), (0, -depth / 2 - 0.002, (k + 0.5) * room)
        )
        grip = moved(holder(dice, 0.12), (0, -depth / 2 - 0.02, (k + 0.6) * room)) if dice.chance(0.5) else []
        tub = open_box((width - 0.035, depth * 0.9, room * 0.55), 0.004) + [
            0,
            -depth * 0.04,
            k * room + 0.014,
        ]
        kit.add(
            "tray",
            pull(depth * dice.between(0.4, 0.7)),
            [(face + grip, coat), ([tub], looks.darker(coat, 0.6))],
        )
    kit.fix([box((width, depth, height - used), (0, 0, (height + used) / 2))], coat)
    if tall or dice.chance(0.5):
        low = 0.05 if tall else 0.012
        kit.fix(feet(dice, width * 0.9, depth * 0.9, low), looks.rubber(dice))
    if trays == 0 or dice.chance(0.8):
        _scan_lid(dice, kit, (width, depth, height), coat)
    if height - used > 0.1 and dice.chance(0.6):
        low, high = used + 0.02, used + min(0.16, (height - used) * 0.7)
        flap = [box((width * 0.7, 0.01, high - low), (0, -depth / 2 - 0.007, (high + low) / 2))]
        motion = fall(-depth / 2 - 0.002, low, dice.between(1.0, 1.57))
        kit.add("flap", motion, [(flap, looks.darker(coat, 0.8))], name="front_flap")
    if dice.chance(0.4):
        feeder = turned([box((width * 0.6, 0.008, 0.22), (0, 0, 0.11))], rotation((1, 0, 0), -0.3))
        pin = (0, depth / 2 + 0.008, height * 0.7)
        kit.add("paper rest", hinge(pin, (-1, 0, 0), 0.3, -0.25), [(moved(feeder, pin), coat)])
    return kit.done()


def _scan_lid(dice: Dice, kit: Assembly, size: _Size, coat: Look) -> None:
    """A lid, thick where it feeds sheets by itself, and a board of buttons before it."""
    width, depth, height = size
    board = dice.between(0.0, 0.1)
    deep, thick = depth - board, dice.between(0.015, 0.09)
    top = height + 0.003
    lid: Pieces = [box((width, deep, thick), (0, board / 2, top + thick / 2))]
    if dice.chance(0.4):
        lid.append(box((width * 0.6, deep * 0.5, 0.02), (0, board / 2, top + thick + 0.01)))
    kit.fix([box((width * 0.85, deep * 0.85, 0.002), (0, board / 2, height + 0.001))], looks.glass(dice))
    kit.add("lid", lift(depth / 2, top, dice.between(0.9, 1.5)), [(lid, coat)])
    if board > 0.04:
        count, dark = dice.whole(1, 6), looks.plastic(dice)
        kit.fix(
            [box((0.09, board * 0.6, 0.004), (-width * 0.2, -depth / 2 + board / 2, height + 0.002))],
            looks.glass(dice),
        )
        for k in range(count):
            spot = (width * 0.05 + k * 0.025, -depth / 2 + board / 2, height + 0.003)
            kit.add("button", slide((0, 0, -1), 0.002), [([box((0.016, 0.016, 0.006), spot)], dark)])


def _vending_machine(dice: Dice) -> list[Body]:
    """A tall case whose glazed front opens, with a flap below, keys and a slot at its side; or a kiosk."""
    kit, coat = Assembly("case"), looks.painted_metal(dice)
    width, depth, height = dice.between(0.5, 1.1), dice.between(0.4, 0.85), dice.between(1.2, 1.95)
    kit.fix([shell(width, depth, height, 0.035)], coat)
    levels = np.linspace(0.35, 0.9, dice.whole(2, 6)) * height
    kit.fix(
        at(box((width - 0.08, depth * 0.75, 0.012)), [(0, 0.05 * depth, z) for z in levels]),
        looks.metal(dice),
    )
    for z in levels[: dice.whole(0, len(levels))]:
        goods = at(box((0.06, 0.06, 0.1)), [(x * width, -0.2 * depth, z + 0.057) for x in (-0.3, -0.1, 0.1)])
        kit.fix(goods, looks.plastic(dice))
    if dice.chance(0.5):
        kit.fix(feet(dice, width, depth, 0.06), looks.metal(dice))
    side, thick = dice.sign(), dice.between(0.03, 0.08)
    y = -depth / 2 - 0.003
    wide, tall = width - 0.004, height - 0.004
    panel = wide * dice.between(0.2, 0.3)
    glass = wide - panel - 0.08
    x = side * panel / 2
    face: Pieces = [
        *moved([frame(glass + 0.08, tall * 0.72, thick, 0.04)], (x, y, height * 0.63)),
        box((wide, thick, tall * 0.27), (0, y - thick / 2, tall * 0.135 + 0.002)),
        box((panel, thick, tall * 0.72), (-side * (wide - panel) / 2, y - thick / 2, height * 0.63)),
    ]
    pane = [box((glass, 0.008, tall * 0.72 - 0.08), (x, y - thick / 2, height * 0.63))]
    motion = swing(side, side * width / 2, y, dice.between(1.4, 2.0), height / 2)
    door = kit.add("door", motion, [(face, coat), (pane, looks.glass(dice))])
    _vending_front(dice, kit, door, (-side * (wide - panel) / 2, y - thick, height), panel)
    flap = [box((glass * 0.7, 0.012, tall * 0.12), (x, y - thick - 0.007, tall * 0.14))]
    pin = (0, y - thick - 0.002, tall * 0.2)
    if dice.chance(0.85):
        kit.add("flap", hinge(pin, (-1, 0, 0), dice.between(0.6, 1.3)), [(flap, looks.plastic(dice))], door)
    return kit.done()


def _vending_front(dice: Dice, kit: Assembly, door: int, place: _Size, panel: float) -> None:
    """Keys, a slot, a lock and a handle on the narrow side of the front."""
    x, y, height = place
    dark = looks.plastic(dice)
    screen = box((panel * 0.6, 0.004, 0.06), (x, y - 0.002, height * 0.78))
    slot = box((panel * 0.3, 0.012, 0.05), (x, y - 0.006, height * 0.5))
    kit.fix([screen, slot], dark, door)
    key = min(panel * 0.2, 0.03)
    for k in range(dice.pick((0, 6, 9, 12))):
        spot = (x + (k % 3 - 1) * key * 1.25, y - 0.004, height * 0.62 + (k // 3) * key * 1.25)
        kit.add("button", press(0.003), [([box((key, 0.01, key), spot)], looks.metal(dice))], door)
    if dice.chance(0.7):
        spot = (x, y, height * 0.42)
        turn = [disc(0.03, 0.012, 14), box((0.012, 0.03, 0.1), (0, -0.026, 0))]
        kit.add("handle", hinge(spot, (0, 1, 0), 1.57), [(moved(turn, spot), looks.metal(dice))], door)
    else:
        kit.fix(moved(holder(dice, 0.25, upright=True), (x, y, height * 0.42)), looks.metal(dice), door)


def _valve(dice: Dice, kit: Assembly, side: int, size: tuple[float, float]) -> None:
    """Pipes at an end and a head that turns."""
    width, height = size
    level = 0.14 if dice.chance(0.5) else height + 0.06
    pin = np.array([side * (width / 2 + 0.05), 0, level])
    metal = looks.metal(dice)
    kit.fix([rod((side * width / 2, 0, level), pin, 0.011, 10), rod(pin, pin * [1, 1, 0], 0.009, 10)], metal)
    radius, long = dice.between(0.018, 0.027), dice.between(0.04, 0.09)
    style = dice.unit()
    axis = (
        np.array([side, 0, 0])
        if style < 0.4
        else (np.array([0, 0, 1]) if style < 0.75 else np.array([0, -1, 0]))
    )
    head = cylinder(radius, long, 12) + [0, 0, long / 2 + 0.012]
    ribs = [box((0.004, 0.004, long * 0.7), (radius, 0, long * 0.5 + 0.012))]
    turn = (
        rotation((0, 1, 0), side * np.pi / 2)
        if style < 0.4
        else (np.eye(3) if style < 0.75 else rotation((1, 0, 0), np.pi / 2))
    )
    shape = moved(turned([head, *ribs], turn), pin)
    kit.add("valve", turning(dice, pin, axis), [(shape, looks.plastic(dice))])


def _radiator(dice: Dice) -> list[Body]:
    """Ribs or a panel with a valve whose head turns; some heaters on feet with a dial."""
    kit, coat = (
        Assembly("radiator"),
        looks.painted_metal(dice) if dice.chance(0.4) else Look("steel", (240, 240, 236)),
    )
    height, count = dice.between(0.3, 0.9), dice.whole(4, 16)
    step, deep = dice.between(0.04, 0.07), dice.between(0.05, 0.14)
    width = count * step
    across = (np.arange(count) + 0.5) * step - width / 2
    if dice.chance(0.6):
        rib = box((step * 0.55, deep, height))
        kit.fix(at(rib, [(x, 0, height / 2 + 0.1) for x in across]), coat)
        kit.fix(
            [rod((-width / 2, 0, z), (width / 2, 0, z), step * 0.4, 10) for z in (0.14, height + 0.06)], coat
        )
    else:
        kit.fix([box((width, deep, height), (0, 0, height / 2 + 0.1))], coat)
        kit.fix(
            at(
                box((step * 0.4, 0.01, height * 0.85)),
                [(x, -deep / 2 - 0.005, height / 2 + 0.1) for x in across],
            ),
            coat,
        )
    side = dice.sign()
    _valve(dice, kit, side, (width, height))
    if dice.chance(0.3):
        spot = np.array([-side * (width / 2 + 0.012), 0, height + 0.06])
        vent = moved([pointed(cylinder(0.008, 0.024, 8), X)], spot)
        kit.add(
            "bleed screw",
            spin(spot, (side, 0, 0)),
            [([*vent, box((0.006, 0.004, 0.02), spot - [side * 0.013, 0, 0])], looks.metal(dice))],
        )
    if dice.chance(0.3):
        spot = np.array([width * 0.35, -deep / 2 - 0.01, height * 0.9 + 0.1])
        kit.fix(moved([box((0.07, 0.02, 0.1))], spot), coat)
        knob_at = spot - [0, 0.01, 0]
        kit.add("knob", turning(dice, knob_at), [(moved(dial(dice, 0.022), knob_at), looks.plastic(dice))])
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("cash_register", _cash_register),
    Category("printer", _printer),
    Category("vending_machine", _vending_machine),
    Category("radiator", _radiator),
)
