"""Switches, button boxes, panels of knobs and thermostats: small parts on a plate or a box."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, prism, revolve, rod, superquadric
from . import looks
from .assembling import Assembly, dial, disc, press, swing, turning
from .category import Category
from .objects import Body, Look, Motion, hinge, slide


def _plate(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A flat plate from y = 0 to y = thick."""
    outline = dice.pick((SQUARE, rounded(0.08, height / width), rounded(0.2, height / width)))
    return [pointed(prism(outline, (height, width, thick)), Y) + [0, thick / 2, 0]]


def _switch(dice: Dice) -> list[Body]:
    if dice.chance(0.2):
        return _lever_box(dice)
    kit = Assembly("plate")
    pale = looks.plastic(dice) if dice.chance(0.4) else Look("plastic", (238, 236, 230))
    key = pale if dice.chance(0.5) else looks.plastic(dice)
    cell = dice.between(0.03, 0.07)
    columns, rows = dice.weighted(
        [(4, (1, 1)), (3, (2, 1)), (2, (3, 1)), (2, (1, 2)), (1, (4, 1)), (1, (2, 2)), (1, (6, 1))]
    )
    border = dice.between(0.008, 0.025)
    size = (columns * cell + 2 * border, rows * cell + 2 * border)
    if dice.chance(0.2):
        size = (size[0] + cell, size[1])
    kit.fix(_plate(dice, size[0], size[1], dice.between(0.006, 0.012)), pale)
    if dice.chance(0.5):
        back = (size[0] * 0.85, dice.between(0.02, 0.045), size[1] * 0.85)
        kit.fix(moved([box(back)], (0, 0.006 + back[1] / 2, 0)), looks.darker(pale, 0.8))
    make = dice.weighted([(5, _rocker), (2, _toggle), (2, _push), (2, _dimmer), (1, _slider)])
    seed, mixed = dice.whole(0, 2**31), dice.chance(0.15)
    for row in range(rows):
        for column in range(columns):
            spot = np.array([(column - (columns - 1) / 2) * cell, 0, (row - (rows - 1) / 2) * cell])
            if mixed and dice.chance(0.4):
                _socket(kit, spot, cell, pale)
                mixed = False
                continue
            unit = Assembly()
            make(Dice(seed), unit, cell, key)
            kit.graft(unit, spot)
    return kit.done(rotation((1, 0, 0), -np.pi / 2) if dice.chance(0.1) else None)


def _socket(kit: Assembly, spot: FloatArray, cell: float, look: Look) -> None:
    """A socket, which looks like a knob and is none."""
    kit.fix(moved([disc(cell * 0.38, 0.004, 18)], spot), looks.darker(look, 0.8))
    kit.fix(
        moved([disc(cell * 0.05, 0.0045, 8) + [s * cell * 0.13, 0, 0] for s in (-1, 1)], spot),
        looks.darker(look, 0.3),
    )


def _rocker(dice: Dice, kit: Assembly, cell: float, look: Look) -> None:
    """A wedge that tips about its middle, across or along."""
    wide, high = cell * dice.between(0.35, 0.95), cell * dice.between(0.6, 0.95)
    off, tip = 0.004, dice.between(0.06, 0.2)
    bend = dice.between(0.001, 0.005)
    shape: Pieces = [box((wide, off + bend, high), (0, -(off + bend) / 2 + 0.001, 0))]
    if dice.chance(0.6):
        shape = [_wedge(wide, high, off, bend)]
    elif high < 1.4 * wide:  # a rib along the line shows which way it tips
        shape.append(box((wide, 0.0012, 0.05 * high), (0, -off - bend, 0)))
    if dice.chance(0.3):
        shape.append(box((wide * 0.1, 0.001, high * 0.1), (0, -off - bend, high * 0.3)))
    if dice.chance(0.2):
        shape = turned(shape, rotation((0, 1, 0), np.pi / 2))
        kit.add("rocker", hinge((0, 0, 0), (0, 0, 1), tip, -tip), [(shape, look)])
        return
    kit.add("rocker", hinge((0, 0, 0), (1, 0, 0), tip, -tip), [(shape, look)])


def _wedge(wide: float, high: float, off: float, bend: float) -> FloatArray:
    """A key before y = 0, hollow along its middle, where it is `bend` lower than at its ends."""
    profile = np.array(
        [(-high / 2, 0), (high / 2, 0), (high / 2, -off - bend), (0, -off), (-high / 2, -off - bend)]
    )
    piece = loft(profile, [(0, 1, -wide / 2), (1, 1, -wide / 2), (1, 1, wide / 2), (0, 1, wide / 2)])
    return np.asarray(piece[..., [2, 1, 0]])


def _toggle(dice: Dice, kit: Assembly, cell: float, look: Look) -> None:
    """A short lever in a collar that snaps up and down."""
    reach, thick = cell * dice.between(0.25, 0.5), cell * dice.between(0.05, 0.12)
    tip = dice.between(0.25, 0.5)
    lever: Pieces = [rod((0, 0.004, 0), (0, -reach, 0), thick, 8)]
    if dice.chance(0.5):
        lever = [
            pointed(
                revolve([[0, -0.004], [thick * 0.6, -0.004], [thick * 1.2, reach], [0, reach * 1.1]], 10), Y
            )
            * [1, -1, 1]
        ]
    # A slot shows which way it goes.
    kit.fix([frame(3.4 * thick, 7 * thick, 0.8 * thick, 0.6 * thick)], looks.metal(dice))
    if dice.chance(0.5):
        lever = turned(lever, rotation((1, 0, 0), tip))
        motion = hinge((0, 0, 0), (-1, 0, 0), 2 * tip)
    else:
        motion = hinge((0, 0, 0), (1, 0, 0), tip, -tip)
    kit.add("toggle", motion, [(lever, look if dice.chance(0.5) else looks.metal(dice))])


def _push(dice: Dice, kit: Assembly, cell: float, look: Look) -> None:
    off = dice.between(0.003, 0.009)
    if dice.chance(0.5):
        shape: Pieces = [disc(cell * dice.between(0.15, 0.42), off, 18)]
    else:
        shape = [box((cell * dice.between(0.3, 0.9), off, cell * dice.between(0.3, 0.9)), (0, -off / 2, 0))]
    kit.add("button", press(off * dice.between(0.4, 0.9)), [(shape, look)])


def _dimmer(dice: Dice, kit: Assembly, cell: float, look: Look) -> None:
    shape = dial(dice, cell * dice.between(0.2, 0.42))
    kit.add("knob", turning(dice, (0, 0, 0)), [(shape, look)])


def _slider(dice: Dice, kit: Assembly, cell: float, look: Look) -> None:
    """A cap on a slot, along z or x."""
    long = cell * dice.between(0.6, 0.85)
    cap = box((cell * 0.3, 0.008, cell * 0.12), (0, -0.005, -long * 0.4))
    slot = box((cell * 0.06, 0.001, long), (0, -0.0005, 0))
    unit = Assembly()
    unit.fix([slot], Look("plastic", (20, 20, 20)))
    unit.add("slider", slide((0, 0, 1), long * 0.8), [([cap], look)])
    kit.graft(unit, turn=rotation((0, 1, 0), np.pi / 2) if dice.chance(0.3) else None)


def _lever_box(dice: Dice) -> list[Body]:
    """A box with a large lever at its side or on its front, and mostly a lid."""
    size = np.array([dice.between(0.08, 0.3), dice.between(0.05, 0.14), dice.between(0.1, 0.4)])
    coat = looks.painted_metal(dice)
    kit = Assembly("box")
    kit.fix([box(size)], coat)
    red = Look("plastic", (190, 40, 35)) if dice.chance(0.5) else looks.plastic(dice)
    reach, thick = size[2] * dice.between(0.25, 0.5), dice.between(0.005, 0.012)
    upper = dice.between(0.8, 2.6)
    if dice.chance(0.5):
        side = dice.sign()
        pin = np.array([side * size[0] / 2, 0, dice.between(-0.2, 0.2) * size[2]])
        arm = rod((2 * thick, 0, 0), (2 * thick, -0.3 * reach, reach), thick, 8)
        tip = superquadric((4 * thick, 4 * thick, 5 * thick), rows=6) + [2 * thick, -0.3 * reach, reach]
        hub = pointed(cylinder(2.5 * thick, 3 * thick, 14), X) + [1.5 * thick, 0, 0]
        shape = moved([piece * [side, 1, 1] for piece in (arm, tip, hub)], pin)
        kit.add("lever", hinge(pin, (1, 0, 0), upper), [(shape, red)])
    else:
        pin = np.array([0, -size[1] / 2, dice.between(-0.25, 0.25) * size[2]])
        wide = size[0] * dice.between(0.3, 0.7)
        arms = boxes((thick, thick, reach), [(s * wide / 2, -thick, reach / 2) for s in (-1, 1)])
        grip = box((wide + 2 * thick, 2 * thick, 2 * thick), (0, -thick, reach))
        shape = moved(turned([arms, grip], rotation((1, 0, 0), 0.2)), pin)
        kit.add("lever", hinge(pin, (1, 0, 0), dice.between(0.7, 1.3)), [(shape, red)])
    if dice.chance(0.4):
        kit.fix(
            [cylinder(0.02, 0.06, 12) + [0, 0, s * (size[2] / 2 + 0.03)] for s in (-1, 1)], looks.metal(dice)
        )
    return kit.done()


def _button(dice: Dice, kit: Assembly, room: float, look: Look) -> None:
    """A push button: flat, domed, a mushroom, square, or a key that turns."""
    radius, off = room * dice.between(0.2, 0.4), room * dice.between(0.06, 0.25)
    style = dice.unit()
    collar = looks.metal(dice) if dice.chance(0.6) else looks.darker(look, 0.3)
    kit.fix([disc(radius * 1.15, off * 0.4, 18)], collar)
    travel = max(off * 0.5, 0.0015)
    if style < 0.35:
        shape: Pieces = [disc(radius * 0.95, off, 18)]
    elif style < 0.65:
        cap = [
            [0.0, 0.0],
            [radius * 0.5, 0],
            [radius * 0.5, off],
            [radius * 1.3, off * 1.1],
            [radius * 1.2, off * 1.8],
            [0, off * 2.2],
        ]
        shape = [pointed(revolve(cap, 18), Y) * [1, -1, 1]]
    elif style < 0.85:
        shape = [box((1.6 * radius, off, 1.3 * radius), (0, -off / 2 - 0.001, 0))]
    else:
        shape = moved(dial(dice, radius), (0, -off * 0.4, 0))
        return _add(kit, "knob", turning(dice, (0, 0, 0)), shape, look)
    return _add(kit, "button", press(travel), shape, look)


def _add(kit: Assembly, label: str, motion: Motion, shape: Pieces, look: Look) -> None:
    kit.add(label, motion, [(shape, look)])


def _button_box(dice: Dice) -> list[Body]:
    """A box with buttons in a row or a grid, level or upright; some under a cover."""
    columns, rows = dice.weighted(
        [(3, (1, 1)), (3, (1, 2)), (2, (1, 3)), (2, (2, 2)), (1, (3, 2)), (1, (4, 1)), (1, (2, 5))]
    )
    room = dice.between(0.02, 0.07)
    margin = room * dice.between(0.05, 0.4)
    width, height, deep = columns * room + 2 * margin, rows * room + 2 * margin, dice.between(0.03, 0.1)
    coat = looks.plastic(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    kit = Assembly("box")
    kit.fix(_plate(dice, width, height, deep), coat)
    if dice.chance(0.4):
        kit.fix([box((width * 1.25, 0.004, height * 0.8), (0, deep - 0.002, 0))], looks.darker(coat, 0.6))
    if dice.chance(0.3):
        kit.fix([rod((0, deep / 2, height / 2), (0, deep / 2, height / 2 + 0.08), 0.006)], looks.rubber(dice))
    same, seed = dice.chance(0.5), dice.whole(0, 2**31)
    for k in range(columns * rows):
        spot = ((k % columns - (columns - 1) / 2) * room, 0, (k // columns - (rows - 1) / 2) * room)
        unit = Assembly()
        _button(Dice(seed if same else seed + k), unit, room, looks.plastic(dice))
        kit.graft(unit, spot)
    if dice.chance(0.2):
        _cover(dice, kit, width, height, room)
    return kit.done(rotation((1, 0, 0), -np.pi / 2) if dice.chance(0.4) else None)


def _cover(dice: Dice, kit: Assembly, width: float, height: float, room: float) -> None:
    """A clear cap over all buttons, on hinges at its top or a side."""
    off, wall = room * 0.75, 0.002
    faces = [
        box((width, wall, height), (0, -off, 0)),
        boxes((wall, off, height), [(s * (width - wall) / 2, -off / 2, 0) for s in (-1, 1)]),
        boxes((width, off, wall), [(0, -off / 2, s * (height - wall) / 2) for s in (-1, 1)]),
    ]
    shape = moved(faces, (0, -0.001, 0))
    motion = hinge((0, -0.001, height / 2), (-1, 0, 0), dice.between(1.6, 2.4))
    if dice.chance(0.5):
        side = dice.sign()
        motion = swing(side, side * width / 2, -0.001, dice.between(1.6, 2.6))
    kit.add("cover", motion, [(shape, Look("plastic", (200, 215, 220)))])


def _knob_panel(dice: Dice) -> list[Body]:
    """A flat or sloped case with rows of knobs, faders, buttons and toggles."""
    columns, rows = dice.pick((dice.whole(2, 7), dice.whole(7, 16))), dice.whole(1, 4)
    cell = dice.between(0.025, 0.06)
    width, height, deep = (columns + 0.6) * cell, (rows + 0.6) * cell, dice.between(0.02, 0.08)
    kit = Assembly("case")
    coat = looks.painted_metal(dice) if dice.chance(0.6) else looks.wood(dice)
    kit.fix(_plate(dice, width, height, deep), coat)
    if dice.chance(0.4):
        kit.fix(
            [box((0.012, deep * 1.2, height), (s * (width / 2 + 0.006), deep * 0.5, 0)) for s in (-1, 1)],
            looks.wood(dice),
        )
    makers = (_dimmer, _dimmer, _slider, _push, _toggle, _rocker)
    look, tall = looks.plastic(dice), dice.chance(0.3) and rows > 1
    for row in range(rows):
        make, seed = dice.pick(makers), dice.whole(0, 2**31)
        if tall and row == 0:
            make = _slider
        for column in range(columns):
            spot = ((column - (columns - 1) / 2) * cell, 0, (row - (rows - 1) / 2) * cell)
            unit = Assembly()
            make(Dice(seed), unit, cell * 0.9, look)
            kit.graft(unit, spot)
    if dice.chance(0.3):
        kit.fix([box((width * 0.5, 0.004, cell * 0.5), (0, 0, height / 2 - 0.0))], looks.glass(dice))
    return kit.done(rotation((1, 0, 0), dice.pick((0.0, -0.4, -0.9, -1.2, -np.pi / 2, -np.pi / 2))))


def _thermostat(dice: Dice) -> list[Body]:
    """A dial or a ring on a wall plate, or a slider on a box, some under a flap."""
    size = dice.between(0.07, 0.13)
    pale = looks.plastic(dice) if dice.chance(0.4) else Look("plastic", (240, 238, 232))
    kit = Assembly("plate")
    style, off = dice.unit(), dice.between(0.015, 0.035)
    if style < 0.5:
        base = (
            [disc(size / 2, off * 0.5, 20)]
            if dice.chance(0.6)
            else [box((size, off * 0.5, size), (0, -off * 0.25, 0))]
        )
        kit.fix(base, pale)
        radius = size * dice.between(0.3, 0.48)
        if dice.chance(0.5):
            ring = pointed(
                revolve(
                    np.array([[0.75, 0], [1, 0], [1, 1], [0.85, 1.1], [0.75, 0]]) * [radius, off * 0.6], 20
                ),
                Y,
            ) * [1, -1, 1]
            mark = box((0.004, 0.002, radius * 0.1), (0, -off * 0.66, radius * 0.9))
            spot = (0, -off * 0.5, 0)
            kit.add("ring", turning(dice, spot), [(moved([ring, mark], spot), looks.metal(dice))])
            kit.fix(moved([disc(radius * 0.72, off * 0.55, 18)], spot), looks.glass(dice))
        else:
            spot = (0, -off * 0.5, 0)
            kit.add("knob", turning(dice, spot), [(moved(dial(dice, radius), spot), pale)])
        return kit.done()
    width, height = size * dice.between(1.0, 1.8), size * dice.between(0.8, 1.2)
    kit.fix([box((width, off, height), (0, off / 2, 0))], pale)
    kit.fix([box((width * 0.6, 0.002, height * 0.35), (0, -0.001, height * 0.22))], looks.glass(dice))
    unit, seed = Assembly(), dice.whole(0, 2**31)
    make = dice.pick((_slider, _dimmer, _push))
    make(Dice(seed), unit, height * 0.4, looks.plastic(dice))
    kit.graft(unit, (dice.between(-0.2, 0.2) * width, 0, -height * 0.22))
    if dice.chance(0.5):
        face = [box((width * 0.98, 0.003, height * 0.46), (0, -0.014, -height * 0.26))]
        lugs = [(s * (width / 2 + 0.002), -0.005, -height * 0.49) for s in (-1, 1)]
        kit.fix([boxes((0.004, 0.018, 0.012), lugs)], pale)
        kit.add("flap", hinge((0, -0.014, -height * 0.49), (1, 0, 0), dice.between(1.4, 2.6)), [(face, pale)])
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("switch", _switch),
    Category("button_box", _button_box),
    Category("knob_panel", _knob_panel),
    Category("thermostat", _thermostat),
)
