"""What one looks, weighs and draws with: microscopes, telescopes, balances, easels and drawing tables."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, rod
from . import looks
from .assembling import Assembly, dial, disc, turning
from .category import Category
from .machine_tools_parts import DARK, handwheel, lobed_knob, sideways
from .mixing_machines_parts import cup
from .objects import Body, Look, hinge, slide, spin
from .rigging import BACK, FRONT, LEFT, RIGHT, UP, lying


def _microscope(dice: Dice) -> list[Body]:
    """An arm over a foot; a turret, a stage, its slider, focus knobs, a lamp's dial and a tube that turns."""
    kit, coat, metal = (
        Assembly("stand"),
        looks.plastic(dice) if dice.chance(0.5) else looks.painted_metal(dice),
        looks.metal(dice),
    )
    wide, deep, level = dice.between(0.12, 0.18), dice.between(0.18, 0.24), dice.between(0.11, 0.15)
    top = level + dice.between(0.11, 0.14)
    kit.fix([box((wide, deep, 0.04), (0, 0, 0.02)), cylinder(0.028, 0.02, 18) + [0, -0.2 * deep, 0.05]], coat)
    y = deep / 2 - 0.03
    kit.fix(
        [
            box((0.05, 0.05, top - 0.03), (0, y, 0.5 * top + 0.02)),
            box((0.05, 0.2 * deep + y + 0.03, 0.035), (0, (y - 0.2 * deep) / 2, top + 0.015)),
        ],
        coat,
    )
    eye = np.array([0, -0.2 * deep, top])
    kit.add("turret", spin(eye - [0, 0, 0.003], UP), [(_turret(dice, eye), metal)])
    head = [cylinder(0.032, 0.02, 18) + eye + [0, 0, 0.0435], cylinder(0.03, 0.05, 18) + eye + [0, 0, 0.075]]
    lean = rotation(RIGHT, dice.between(0.6, 0.9))
    for x in dice.pick(((0.0,), (-0.03, 0.03))):
        barrel = [cylinder(0.014, 0.11, 14) + [0, 0, 0.06], cylinder(0.017, 0.02, 14) + [0, 0, 0.12]]
        head += moved(turned(barrel, lean), eye + [x, 0, 0.09])
    kit.add("head", spin(eye + [0, 0, 0.035], UP), [(head, coat)])
    stage = [
        box((0.15, 0.13, 0.008), (0, -0.2 * deep, level)),
        box((0.06, y - 0.03 + 0.2 * deep - 0.06, 0.016), (0, (y - 0.03 - 0.2 * deep + 0.06) / 2, level)),
    ]
    carrier = kit.add("stage", slide(UP, 0.012, -0.02), [(stage, DARK)])
    if dice.chance(0.6):
        holder = [
            box((0.09, 0.02, 0.006), (0, -0.2 * deep + 0.03, level + 0.0085)),
            box((0.008, 0.05, 0.004), (0.042, -0.2 * deep, level + 0.0065)),
        ]
        kit.add("slide holder", slide(RIGHT, 0.02, -0.02), [(holder, metal)], carrier)
    else:
        for s in (-1, 1):
            pin = np.array([s * 0.05, -0.2 * deep + 0.045, level + 0.0045])
            clip = [cylinder(0.006, 0.006) + [0, 0, 0.0035], box((0.006, 0.06, 0.0015), (0, -0.03, 0.005))]
            kit.add("clip", hinge(pin, UP, 0.6, -0.6), [(moved(clip, pin), metal)], carrier)
    low = np.array([0.0251, y, dice.between(0.07, 0.09)])
    for s in (-1, 1):
        knob = [*sideways([disc(0.024, 0.016, 20)], s), *sideways([disc(0.016, 0.03, 16)], s)]
        spot = low * [s, 1, 1]
        kit.add(
            "knob",
            turning(dice, spot, LEFT),
            [(moved(knob, spot), DARK)],
            name="left_focus" if s < 0 else "right_focus",
        )
    if dice.chance(0.6):
        spot = np.array([wide / 2 + 0.0005, 0.1 * deep, 0.022])
        kit.add("dial", turning(dice, spot, LEFT), [(moved(sideways(dial(dice, 0.011), 1), spot), DARK)])
    return kit.done()


def _turret(dice: Dice, eye: FloatArray) -> Pieces:
    """Objectives on a slanted disc below the arm."""
    pieces: Pieces = [cylinder(0.03, 0.012, 20) + eye - [0, 0, 0.0085]]
    for k, long in enumerate((0.02, 0.028, 0.036, 0.042)[: dice.whole(3, 4)]):
        lens = turned(
            [cylinder(0.009, long, 12) - [0, 0, long / 2], cylinder(0.006, 0.006, 10) - [0, 0, long + 0.002]],
            rotation(BACK, -0.25),
        )
        pieces += moved(turned(moved(lens, (0.019, 0, 0)), rotation(UP, k * np.pi / 2)), eye - [0, 0, 0.013])
    return pieces


def _telescope(dice: Dice) -> list[Body]:
    """A tube on a mount that turns and tips, on splayed legs, with a focuser, a finder and caps."""
    kit, metal, coat = Assembly("legs"), looks.metal(dice), looks.painted_metal(dice)
    top = _tripod(dice, kit, metal) + 0.026
    arms = dice.pick(((-1, 1), (1,)))
    radius, long = dice.between(0.04, 0.08), dice.between(0.5, 0.9)
    gap, rise = radius + 0.02, dice.between(0.12, 0.2)
    fork = [
        cylinder(0.06, 0.03, 18) + [0, 0, top + 0.0155],
        box((2 * gap + 0.02, 0.06, 0.02), (0, 0, top + 0.035)),
    ]
    fork += [box((0.018, 0.06, rise), (s * gap, 0, top + 0.04 + rise / 2)) for s in arms]
    mount = kit.add("mount", spin((0, 0, top), UP), [(fork, metal)])
    pin, lean = np.array([0, 0, top + 0.03 + rise]), rotation(RIGHT, -dice.between(0, 0.6))
    place = dice.between(-0.15, 0.15) * long
    back = place + long / 2
    body = _telescope_tube(radius, long, place)
    body += [lying(0.016, gap - radius + 0.004) + [s * (gap + radius) / 2, 0, 0] for s in arms]
    draw, way = _draw_tube(dice, radius, long, place)
    tipped = kit.add(
        "tube",
        hinge(pin, LEFT, 0.9, -0.5),
        [(moved(turned(body, lean), pin), coat), (moved(turned(_finder(radius, back), lean), pin), DARK)],
        mount,
    )
    kit.add("focuser", slide(lean @ way, 0.04), [(moved(turned(draw, lean), pin), metal)], tipped)
    spot = np.array([radius + 0.001, back - 0.06, 0])
    knob = moved(sideways([disc(0.006, 0.012), *moved(dial(dice, 0.016), (0, -0.012, 0))], 1), spot)
    motion = turning(dice, lean @ spot + pin, lean @ np.array(RIGHT))
    kit.add("knob", motion, [(moved(turned(knob, lean), pin), DARK)], tipped)
    if dice.chance(0.5):
        spot = np.array([arms[0] * (gap + 0.0095), 0, 0]) + pin
        knob = sideways([disc(0.006, 0.01), *moved(_lobed_wheel(0.024), (0, -0.01, 0))], int(arms[0]))
        kit.add("knob", turning(dice, spot, RIGHT), [(moved(knob, spot), DARK)], mount)
    return kit.done()


def _tripod(dice: Dice, kit: Assembly, metal: Look) -> float:
    """Three splayed legs with a head on them and a plate between; gives how high they are."""
    high, spread = dice.between(0.7, 1.1), dice.between(0.35, 0.5)
    for a in np.arange(3) * 2 * np.pi / 3 + np.pi / 2:
        head = (0.05 * np.cos(a), 0.05 * np.sin(a), high)
        foot = (spread * np.cos(a), spread * np.sin(a), 0.0)
        kit.fix([rod(head, foot, 0.018, 8)], metal)
    kit.fix([cylinder(0.07, 0.05, 18) + [0, 0, high], cylinder(0.14, 0.01, 3) + [0, 0, 0.45 * high]], metal)
    return high


def _telescope_tube(radius: float, long: float, place: float) -> Pieces:
    """A tube along y with a wide mouth in front and two rings about the pin."""
    tube = [
        pointed(cylinder(radius, long, 28), Y) + [0, place, 0],
        pointed(cylinder(1.15 * radius, 0.12 * long, 28), Y) + [0, place - 0.47 * long, 0],
    ]
    return tube + [pointed(cylinder(1.08 * radius, 0.03, 24), Y) + [0, s * 0.06, 0] for s in (-1, 1)]


def _finder(radius: float, back: float) -> Pieces:
    """A small telescope on two feet near the back end of the tube."""
    return [
        rod((0, back - 0.22, radius + 0.05), (0, back - 0.05, radius + 0.05), 0.014, 12),
        box((0.01, 0.02, 0.05), (0, back - 0.09, radius + 0.022)),
        box((0.01, 0.02, 0.05), (0, back - 0.18, radius + 0.022)),
    ]


def _draw_tube(dice: Dice, radius: float, long: float, place: float) -> tuple[Pieces, FloatArray]:
    """What slides to focus, with the way it goes: on top near the mouth, or at the back end."""
    if dice.chance(0.4):
        spot = np.array([0, place - 0.36 * long, radius])
        draw = [cylinder(0.018, 0.06) + spot + [0, 0, 0.032], cylinder(0.022, 0.02) + spot + [0, 0, 0.06]]
        return draw, np.array(UP)
    back = place + long / 2
    draw = [
        pointed(cylinder(0.5 * radius, 0.08, 16), Y) + [0, back + 0.041, 0],
        pointed(cylinder(0.3 * radius, 0.05, 12), Y) + [0, back + 0.1, 0],
    ]
    return draw, np.array(BACK)


def _lobed_wheel(radius: float) -> Pieces:
    """A lobed knob about y before y = 0."""
    return turned(lobed_knob(radius, (0, 0, 0.35 * radius)), rotation(RIGHT, np.pi / 2))


def _balance(dice: Dice) -> list[Body]:
    """A beam on a post with two pans that hang from its ends, or that ride on them."""
    kit, metal = Assembly("stand"), looks.metal(dice)
    long, high = dice.between(0.25, 0.5), dice.between(0.25, 0.45)
    hangs = dice.chance(0.65)
    high = high if hangs else dice.between(0.08, 0.14)
    kit.fix([box((0.5 * long, 0.3 * long, 0.03), (0, 0, 0.015))], looks.wood(dice))
    kit.fix(
        [
            cylinder(0.012, high, 12) + [0, 0.02, high / 2 + 0.02],
            rod((0, 0.024, high), (0, -0.008, high), 0.005, 8),
        ],
        metal,
    )
    pin, tilt = np.array([0, 0, high]), dice.between(-0.12, 0.12) if hangs else 0.0
    yaw = rotation(BACK, tilt)
    beam = [box((long, 0.008, 0.016)), *[lying(0.004, 0.02, Y) + [s * long / 2, 0, 0] for s in (-1, 1)]]
    if hangs:
        beam.append(box((0.004, 0.004, 0.4 * high), (0, -0.006, -0.2 * high)))
    if dice.chance(0.5):
        beam.append(boxes((0.45 * long, 0.006, 0.008), [(s * 0.24 * long, 0, 0.018) for s in (-1, 1)]))
    number = kit.add(
        "beam", hinge(pin, FRONT, 0.25 + tilt, -0.25 + tilt), [(moved(turned(beam, yaw), pin), metal)]
    )
    radius, drop = dice.between(0.15, 0.22) * long, dice.between(0.5, 0.6) * high
    for s in (-1, 1):
        end = pin + yaw @ np.array([s * long / 2, 0, 0])
        if hangs:
            cords = [
                rod((0, 0, -0.012), (radius * np.cos(a), radius * np.sin(a), -drop), 0.0015)
                for a in np.arange(3) * 2.094
            ]
            pan = [
                cylinder(radius, 0.006, 24) - [0, 0, drop],
                pointed(cylinder(0.007, 0.004), Y) - [0, 0, 0.01],
                *cords,
            ]
        else:
            pan = [
                cylinder(0.008, 0.05) + [0, 0, 0.03],
                cup([(radius, 0.055), (1.15 * radius, 0.075)], 0.002, 24),
                cylinder(0.9 * radius, 0.004, 20) + [0, 0, 0.056],
            ]
        kit.add(
            "pan",
            hinge(end, FRONT, 0.3, -0.3),
            [(moved(pan, end), metal)],
            number,
            "left_pan" if s < 0 else "right_pan",
        )
    return kit.done()


def _easel(dice: Dice) -> list[Body]:
    """A frame on legs with a shelf and a clamp that slide on its mast, and a leg that folds back."""
    kit, wood = Assembly("frame"), looks.wood(dice)
    high, wide, lean = dice.between(1.4, 1.9), dice.between(0.5, 0.7), dice.between(0.1, 0.2)
    yaw = rotation(RIGHT, -lean)
    sides = [rod((s * wide / 2, 0, 0), (s * 0.06, 0, 0.95 * high), 0.018, 4) for s in (-1, 1)]
    sides += [box((wide * (1 - 0.8 * z), 0.02, 0.045), (0, 0.02, z * high)) for z in (0.2, 0.5)]
    mast = [
        box((0.05, 0.02, 0.9 * high), (0, 0.0, 0.55 * high)),
        box((0.16, 0.03, 0.04), (0, 0.01, 0.95 * high)),
    ]
    kit.fix(turned(sides + mast, yaw), wood)
    low = dice.between(0.3, 0.4) * high
    shelf = [
        box((0.9 * wide, 0.09, 0.018), (0, -0.065, low)),
        box((0.08, 0.014, 0.12), (0, -0.0185, low - 0.03)),
        box((0.9 * wide, 0.012, 0.03), (0, -0.105, low + 0.005)),
    ]
    up = yaw @ np.array(UP)
    kit.add("shelf", slide(up, 0.2, -0.1), [(turned(shelf, yaw), wood)])
    spot = np.array([0, -0.0265, low - 0.065])
    knob = [disc(0.008, 0.01), *moved(_lobed_wheel(0.02), (0, -0.01, 0))]
    kit.add(
        "knob", turning(dice, yaw @ spot, yaw @ np.array(FRONT)), [(turned(moved(knob, spot), yaw), DARK)], 1
    )
    tall = low + dice.between(0.4, 0.6)
    clamp = [box((0.08, 0.014, 0.1), (0, -0.0185, tall)), box((0.14, 0.07, 0.018), (0, -0.06, tall + 0.04))]
    kit.add("clamp", slide(up, 0.1, -0.25), [(turned(clamp, yaw), wood)])
    pin = yaw @ np.array([0, 0.04, 0.92 * high])
    foot = np.array([0, pin[1] + 0.35 * high, 0])
    leg = [rod(pin - [0, 0, 0.02], foot, 0.018, 4), lying(0.012, 0.05) + pin]
    kit.add("leg", hinge(pin, RIGHT, 0.1, -0.4), [(leg, wood)])
    if dice.chance(0.5):
        kit.fix(turned([box((0.7 * wide, 0.02, 0.6), (0, -0.05, low + 0.31))], yaw), looks.fabric(dice), 1)
    return kit.done()


def _drawing_table(dice: Dice) -> list[Body]:
    """A board that tips on a stand, with a ruler that slides on it, drawers and a wheel to set it."""
    kit, look, metal = Assembly("stand"), looks.painted_metal(dice), looks.metal(dice)
    wide, deep, high = dice.between(0.8, 1.3), dice.between(0.6, 0.85), dice.between(0.75, 0.95)
    x = 0.36 * wide
    kit.fix([box((0.06, 0.6 * deep, 0.03), (s * x, 0, 0.015)) for s in (-1, 1)], look)
    kit.fix([box((0.05, 0.05, high - 0.06), (s * x, 0.05, high / 2 - 0.02)) for s in (-1, 1)], look)
    kit.fix([box((2 * x, 0.03, 0.05), (0, 0.05, z * high)) for z in (0.3, 0.75)], look)
    pin, tilt = np.array([0, 0.05, high]), dice.between(0.0, 0.7)
    yaw = rotation(RIGHT, tilt)
    board = [
        box((wide, deep, 0.025), (0, -0.02, 0.05)),
        box((wide, 0.025, 0.02), (0, -0.02 - deep / 2 + 0.0125, 0.072)),
    ]
    irons = [box((0.04, 0.4 * deep, 0.03), (s * x, 0, 0.022)) for s in (-1, 1)] + [lying(0.014, 2 * x + 0.12)]
    tip = kit.add(
        "top",
        hinge(pin, LEFT, tilt, tilt - 1.1),
        [(moved(turned(board, yaw), pin), looks.wood(dice)), (moved(turned(irons, yaw), pin), metal)],
    )
    kit.fix([box((0.07, 0.07, 0.05), (s * (x + 0.0), 0.05, high - 0.05)) for s in (-1, 1)], look)
    if dice.chance(0.7):
        place = dice.between(-0.2, 0.2) * deep
        ruler = [box((0.96 * wide, 0.05, 0.008), (0, place, 0.0675))]
        ruler += [box((0.04, 0.07, 0.02), (s * 0.47 * wide, place, 0.0745)) for s in (-1, 1)]
        motion = slide(yaw @ np.array(BACK), 0.4 * deep - place - 0.04, -0.4 * deep - place + 0.04)
        kit.add("ruler", motion, [(moved(turned(ruler, yaw), pin), metal)], tip)
    spot = np.array([x + 0.0605, 0.05, high])
    wheel = (
        sideways(handwheel(dice, 0.05), 1)
        if dice.chance(0.5)
        else sideways([disc(0.01, 0.012), *moved(_lobed_wheel(0.035), (0, -0.012, 0))], 1)
    )
    kit.add("knob", turning(dice, spot, RIGHT), [(moved(wheel, spot), DARK)])
    if dice.chance(0.6):
        _table_drawers(dice, kit, 0.3 * high, look)
    return kit.done()


def _table_drawers(dice: Dice, kit: Assembly, level: float, look: Look) -> None:
    """A case in the middle of the stand, about a level, with drawers that open to -y."""
    count, tall = dice.whole(1, 3), 0.09
    wide, deep, high = 0.3, 0.35, tall * count + 0.02
    low = level - high / 2
    case = [box((wide, 0.01, high), (0, 0.21, low + high / 2))]
    case += [box((0.012, deep, high), (s * (wide / 2), 0.04, low + high / 2)) for s in (-1, 1)]
    kit.fix(case, look)
    kit.fix([box((wide, deep, 0.01), (0, 0.04, low + t * high)) for t in (0, 1)], look)
    for k in range(count):
        z = low + 0.012 + tall * (k + 0.5)
        tray = [
            box((wide - 0.02, 0.016, tall - 0.008), (0, -0.126, z)),
            between((-0.13, -0.118, z - 0.035), (0.13, 0.18, z - 0.03)),
        ]
        tray += [box((0.008, 0.28, 0.05), (s * 0.13, 0.03, z - 0.01)) for s in (-1, 1)]
        tray.append(box((0.1, 0.025, 0.012), (0, -0.145, z)))
        kit.add("drawer", slide(FRONT, 0.22), [(tray, look)])


CATEGORIES = (
    Category("microscope", _microscope),
    Category("telescope", _telescope),
    Category("balance", _balance),
    Category("easel", _easel),
    Category("drawing_table", _drawing_table),
)
