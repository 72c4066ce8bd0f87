"""What food and drink are served from: heated dishes, presses, dispensers, pails, baskets, pasta machines."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import Y, around, at, corners, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, revolve, rod, sheet, torus, tube
from . import looks
from .assembling import Assembly, dial, holder, turning
from .category import Category
from .machine_tools_parts import DARK, sleeve
from .mixing_machines_parts import cup
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import DOWN, LEFT, RIGHT, UP, ball_knob, lying


def _vault(length: float, radius: float, ends: tuple[float, float], wall: float = 0.003) -> Pieces:
    """Part of a hollow cylinder about x, closed at its ends, between two angles from +y over +z."""
    angle = np.linspace(*ends, 18)
    ring = np.column_stack([0 * angle, np.cos(angle), np.sin(angle)])
    skins = []
    for r in (radius, radius - wall):
        skins.append(sheet(np.stack([r * ring + [s * length / 2, 0, 0] for s in (-1, 1)])))
    for s in (-1, 1):
        skins.append(sheet(np.stack([r * ring + [s * length / 2, 0, 0] for r in (0.25 * radius, radius)])))
    return skins


def _chafing_dish(dice: Dice) -> list[Body]:
    """A frame with a water pan, pans in it, and a lid that rolls back, tips back or is loose."""
    kit, metal = Assembly("frame"), looks.metal(dice)
    wide, deep, level = dice.between(0.34, 0.6), dice.between(0.28, 0.36), dice.between(0.2, 0.26)
    kit.fix([open_box((wide, deep, 0.1), 0.004) + [0, 0, level - 0.1]], metal)
    kit.fix(at(rod((0, 0, 0), (0, 0, level - 0.02), 0.008, 8), corners(wide + 0.014, deep + 0.014)), metal)
    kit.fix([box((wide, 0.012, 0.012), (0, s * (deep / 2 - 0.006), 0.06)) for s in (-1, 1)], metal)
    kit.fix([box((0.012, deep, 0.012), (s * (wide / 2 + 0.007), 0, 0.06)) for s in (-1, 1)], metal)
    kit.fix([box((0.7 * wide, deep, 0.006), (0, 0, 0.056))], metal)
    for s in (-1, 1):
        burner = moved([cup([(0.035, 0), (0.04, 0.05)], 0.003)], (0.2 * s * wide, 0, 0.0595))
        kit.add("burner", free(), [(burner, looks.metal(dice))])
    count = dice.whole(1, 2)
    for k in range(count):
        span = wide / count - 0.012
        x = (k - (count - 1) / 2) * wide / count
        pan = [open_box((span - 0.01, deep - 0.03, 0.07), 0.002) + [x, 0, level - 0.065]]
        pan += [boxes((span, 0.012, 0.003), [(x, s * (deep / 2 - 0.009), level + 0.0045) for s in (-1, 1)])]
        kit.add("pan", free(), [(pan, looks.metal(dice))])
    style, radius = dice.unit(), np.hypot(deep / 2, 0.112) + 0.008
    glass = looks.glass(dice) if dice.chance(0.3) else metal
    if style < 0.55:
        pin = np.array([0, 0, level + 0.012])
        dome = _vault(wide - 0.01, radius, (0.02, np.pi - 0.02))
        grip = turned(holder(dice, dice.between(0.1, 0.2)), rotation(RIGHT, -0.6))
        grip = moved(grip, (0, -radius * np.cos(0.6), radius * np.sin(0.6)))
        ends = [lying(0.014, 0.006) + [s * (wide / 2 - 0.003), 0, 0] for s in (-1, 1)]
        kit.fix([box((0.01, 0.03, 0.05), (s * (wide / 2 + 0.006), 0, level)) for s in (-1, 1)], metal)
        # It rolls around the pan, down to the burners.
        down = np.arcsin(min(1.0, (level - 0.1) / radius))
        kit.add("lid", hinge(pin, LEFT, down), [(moved(dome + ends, pin), glass), (moved(grip, pin), DARK)])
    else:
        rise = dice.between(0.06, 0.12)
        lid = [
            turned([open_box((wide, deep, rise), 0.003)], rotation(RIGHT, np.pi))[0]
            + [0, 0, level + 0.01 + rise]
        ]
        if style < 0.8:
            pin = np.array([0, deep / 2 + 0.008, level + 0.012])
            grip = moved(holder(dice, 0.15), (0, -deep / 2, level + 0.5 * rise))
            kit.add("lid", hinge(pin, LEFT, dice.between(1.4, 1.7)), [(lid, glass), (grip, DARK)])
        else:
            grip = moved(turned(holder(dice, 0.15), rotation(RIGHT, -np.pi / 2)), (0, 0, level + 0.01 + rise))
            kit.add("lid", free(), [(lid, glass), (grip, DARK)])
    return kit.done()


def _french_press(dice: Dice) -> list[Body]:
    """A glass in a frame with a handle; a plunger goes through its lid."""
    kit, metal = Assembly("beaker"), looks.metal(dice)
    radius, high = dice.between(0.038, 0.055), dice.between(0.14, 0.19)
    kit.fix([cup([(0.97 * radius, 0.012), (radius, 0.02), (radius, high)], 0.0025, 28)], looks.glass(dice))
    _press_frame(dice, kit, radius, high, metal)
    edge, level = 1.06 * radius, high + 0.002
    line = [(edge, level), (edge, high + 0.01), (0.5 * radius, high + 0.022), (0.006, high + 0.024)]
    dome = revolve([(0.006, level), *line, (0.006, level)], 28)
    lid = kit.add("lid", free(), [([dome], metal)])
    pressed, low = dice.between(0.0, 0.3), 0.03
    top = high + 0.05 + (1 - pressed) * (high - 0.07)
    shaft = [
        rod((0, 0, top - high - 0.02), (0, 0, top), 0.0035, 8),
        cylinder(radius - 0.004, 0.004, 24) + [0, 0, top - high - 0.018],
        torus(radius - 0.006, 0.0025, 24) + [0, 0, top - high - 0.011],
    ]
    knob = ball_knob(dice.between(0.01, 0.016)) if dice.chance(0.6) else cylinder(0.014, 0.02)
    room = max(top - high - 0.05, 0.02)
    motion = slide(DOWN, min(room, top - high - 0.018 - low + 0.02))
    kit.add("plunger", motion, [(shaft, metal), ([knob + [0, 0, top]], DARK)], lid)
    return kit.done()


def _press_frame(dice: Dice, kit: Assembly, radius: float, high: float, metal: Look) -> None:
    """A foot, a ring and three posts about a glass, with a handle to the right."""
    foot = cylinder(1.02 * radius, 0.009, 24) + [0, 0, 0.0045]
    kit.fix([foot, sleeve(radius + 0.001, radius + 0.004, 0.02) + [0, 0, 0.75 * high]], metal)
    for a in np.arange(3) * 2 * np.pi / 3 + np.pi / 2:
        spot = np.array([np.cos(a), np.sin(a), 0]) * (radius + 0.003)
        kit.fix([rod(spot, spot + [0, 0, 0.77 * high], 0.003, 8)], metal)
    reach, near = radius + dice.between(0.045, 0.065), radius + 0.003
    path = [(near, 0, 0.8 * high), (reach, 0, 0.82 * high), (reach, 0, 0.3 * high), (near, 0, 0.25 * high)]
    if dice.chance(0.6):
        kit.fix([tube(path, 0.008, 8)], DARK)
    else:
        kit.fix([box((0.02, 0.02, 0.6 * high), (reach - 0.01, 0, 0.5 * high))], DARK)
    middle = (reach + radius) / 2
    kit.fix([box((reach - radius, 0.012, 0.01), (middle, 0, z * high)) for z in (0.28, 0.78)], DARK)


def _drink_dispenser(dice: Dice) -> list[Body]:
    """A jar or an urn on a stand, with a lid and taps with levers."""
    kit, metal = Assembly("jar"), looks.metal(dice)
    radius, high, foot = dice.between(0.09, 0.15), dice.between(0.22, 0.4), dice.between(0.1, 0.2)
    urn = dice.chance(0.4)
    look = metal if urn else looks.glass(dice)
    top, neck = foot + high, 0.85 * radius
    line = [(0.9 * radius, foot), (radius, foot + 0.04), (radius, top - 0.03), (neck, top)]
    kit.fix([cup(line, 0.004, 28)], look)
    if urn:
        kit.fix([cylinder(neck, foot, 24) + [0, 0, foot / 2]], DARK)
        for s in (-1, 1):
            kit.fix([box((0.04, 0.1, 0.02), (s * (radius + 0.015), 0, foot + 0.8 * high))], DARK)
    else:
        leg = rod((0.8 * radius, 0, 0), (0.8 * radius, 0, foot), 0.006)
        kit.fix(around([leg], dice.pick((3, 4)), 0.5), metal)
        kit.fix([torus(0.8 * radius, 0.005, 24) + [0, 0, z] for z in (foot - 0.005, 0.03)], metal)
    level = top + 0.001
    line = [(0.9 * radius, level), (0.9 * radius, level + 0.01), (0.3 * radius, level + 0.035)]
    cover = revolve([(0, level), *line, (0, level + 0.035)], 28)
    grip = (
        [ball_knob(0.016) + [0, 0, level + 0.046]]
        if dice.chance(0.5)
        else moved([box((0.08, 0.015, 0.02), (0, 0, 0.042))], (0, 0, level))
    )
    kit.add("lid", free(), [([cover], metal if dice.chance(0.6) else looks.wood(dice)), (grip, DARK)])
    for x in dice.pick(((0.0,), (0.0,), (-0.05, 0.05))):
        _tap(dice, kit, np.array([x, -np.sqrt(radius**2 - x**2) - 0.035, foot + 0.03]), metal)
    return kit.done()


def _tap(dice: Dice, kit: Assembly, spot: FloatArray, metal: Look) -> None:
    """A tap that points to -y, with a lever that turns or tips, or a button."""
    spout = [
        pointed(cylinder(0.009, 0.06), Y) + spot,
        cylinder(0.011, 0.045) + spot - [0, 0.012, 0.015],
        pointed(cylinder(0.018, 0.006), Y) + spot + [0, 0.028, 0],
    ]
    kit.fix(spout, metal)
    style, top = dice.unit(), spot + [0, -0.012, 0.009]
    if style < 0.4:  # turns about its stem
        lever = [cylinder(0.008, 0.014) + [0, 0, 0.0075], box((0.05, 0.01, 0.006), (0.018, 0, 0.016))]
        kit.add("lever", hinge(top, UP, 1.57), [(moved(lever, top), DARK)])
    elif style < 0.75:  # tips forward
        handle = ball_knob(0.009) + [0, 0, 0.055]
        lever = [lying(0.005, 0.016), box((0.012, 0.008, 0.05), (0, 0, 0.025)), handle]
        pin = top + [0, 0, 0.005]
        kit.add("lever", hinge(pin, RIGHT, 0.6), [(moved(lever, pin), DARK)])
    else:
        button = [cylinder(0.009, 0.016) + [0, 0, 0.0085]]
        kit.add("button", slide(DOWN, 0.006), [(moved(button, top), DARK)])


def _bail(wide: float, y: float, z: float, rise: float, thick: float) -> FloatArray:
    """A bow between two ears at x = -wide / 2 and wide / 2, about a line along x at (y, z)."""
    angle = np.linspace(0, np.pi, 15)
    path = np.column_stack([-np.cos(angle) * wide / 2, 0 * angle + y, z + rise * np.sin(angle)])
    return tube(path, thick, 8)


def _bucket(dice: Dice) -> list[Body]:
    """A pail with a bow on two ears, and at times a lid or a spout."""
    kit, look = Assembly("bucket"), looks.metal(dice) if dice.chance(0.4) else looks.plastic(dice)
    radius, high, flare = dice.between(0.1, 0.16), dice.between(0.18, 0.34), dice.between(1.0, 1.3)
    rim = flare * radius
    kit.fix([cup([(radius, 0), (rim, high)], 0.003, 28), torus(rim, 0.005, 28) + [0, 0, high - 0.003]], look)
    if dice.chance(0.4):
        kit.fix([torus(radius + 0.6 * (rim - radius), 0.004, 28) + [0, 0, 0.6 * high]], look)
    level = high - dice.between(0.02, 0.04)
    kit.fix([box((0.02, 0.03, 0.03), (s * (rim + 0.004), 0, level)) for s in (-1, 1)], look)
    lies = dice.chance(0.5)
    rise, thick = rim + dice.between(0.02, 0.06), dice.between(0.0025, 0.004)
    bow = [_bail(2 * rim + 0.03, 0, 0, rise, thick)]
    if dice.chance(0.5):
        bow.append(lying(0.012, 0.1) + [0, 0, rise])
    pin, start = np.array([0, 0, level]), 1.35 if lies else 0.0
    bow = turned(bow, rotation(RIGHT, start))
    motion = hinge(pin, RIGHT, 1.4 - start, -1.4 - start)
    kit.add("handle", motion, [(moved(bow, pin), looks.metal(dice))])
    if lies and dice.chance(0.5):
        lid = [cylinder(rim + 0.004, 0.008, 28) + [0, 0, high + 0.0065]]
        lid.append(
            cylinder(0.03, 0.02) + [0, 0, high + 0.02]
            if dice.chance(0.5)
            else box((0.1, 0.02, 0.02), (0, 0, high + 0.02))
        )
        kit.add("lid", free(), [(lid, look)])
    return kit.done()


def _picnic_basket(dice: Dice) -> list[Body]:
    """A wicker box with two lids hinged at a bar across its middle, and a bow or two to carry it."""
    kit, look = Assembly("basket"), looks.wood(dice)
    wide, deep, high = dice.between(0.36, 0.5), dice.between(0.24, 0.34), dice.between(0.17, 0.25)
    kit.fix([open_box((wide, deep, high), 0.008)], look)
    if dice.chance(0.6):
        for z in np.linspace(0.15, 0.9, dice.whole(2, 5)) * high:
            kit.fix(
                [box((wide + 0.008, 0.005, 0.012), (0, s * (deep / 2 + 0.002), z)) for s in (-1, 1)],
                looks.darker(look),
            )
    single = dice.chance(0.35)
    if single:
        pin = np.array([0, deep / 2, high + 0.006])
        lid = [box((wide, deep, 0.012), (0, -deep / 2, 0.002))]
        kit.add(
            "lid",
            hinge(pin, LEFT, 1.8),
            [
                (moved(lid, pin), look),
                (moved([box((0.04, 0.012, 0.05), (0, -deep - 0.006, -0.012))], pin), DARK),
            ],
        )
    else:
        kit.fix([box((0.03, deep, 0.014), (0, 0, high + 0.007))], look)
        for s in (-1, 1):
            pin = np.array([s * 0.018, 0, high + 0.008])
            lid = [box((wide / 2 - 0.022, deep, 0.012), (s * (wide / 4 - 0.007), 0, 0))]
            lid.append(box((0.02, 0.08, 0.01), (s * (wide / 2 - 0.04), 0, 0.012)))
            kit.add(
                "lid",
                hinge(pin, (0, -s, 0), dice.between(1.3, 1.5)),
                [(moved(lid, pin), look)],
                name="left_lid" if s < 0 else "right_lid",
            )
    if single or dice.chance(0.4):
        pin = np.array([0, -deep / 2 - 0.008, 0.75 * high])
        bow = turned([_bail(0.14, 0, 0, 0.07, 0.006)], rotation(RIGHT, 2.9))
        kit.fix([box((0.02, 0.012, 0.02), pin + [s * 0.07, 0.004, 0]) for s in (-1, 1)], DARK)
        kit.add("handle", hinge(pin, LEFT, 2.6), [(moved(bow, pin - [0, 0.008, 0]), DARK)])
    else:
        bow = turned([_bail(deep + 0.03, 0, 0, 0.16 + high * 0.3, 0.009)], rotation(UP, np.pi / 2))
        pin = np.array([0, 0, high - 0.02])
        kit.fix([box((0.03, 0.012, 0.03), pin + [0, s * (deep / 2 + 0.006), 0]) for s in (-1, 1)], look)
        kit.fix(moved(bow, pin), look)
    return kit.done()


def _pasta_machine(dice: Dice) -> list[Body]:
    """Rollers between two cheeks, a dial for how thin, a crank, and a clamp below the table's edge."""
    kit, metal = Assembly("frame"), looks.metal(dice)
    wide, deep, high = dice.between(0.17, 0.22), dice.between(0.1, 0.14), dice.between(0.11, 0.15)
    kit.fix([box((0.018, deep, high), (s * wide / 2, 0, high / 2)) for s in (-1, 1)], metal)
    kit.fix(
        [
            box((wide, 0.9 * deep, 0.012), (0, 0, 0.006)),
            box((wide, 0.5 * deep, 0.003), (0, 0.3 * deep, 0.8 * high)),
        ],
        metal,
    )
    shell = turned([box((wide, 0.004, 0.5 * high), (0, -0.45 * deep, 0.55 * high))], rotation(RIGHT, 0.15))
    kit.fix(shell, metal)
    roll = dice.between(0.012, 0.018)
    for t in (-1, 1):
        hub = np.array([0, t * (roll + 0.0015), high - 0.02])
        roller = [lying(roll, wide - 0.022) + hub, box((wide - 0.04, 0.002, 0.002), hub + [0, 0, roll])]
        kit.add("roller", spin(hub, RIGHT), [(roller, looks.metal(dice))])
    spot = np.array([wide / 2 + 0.011, -0.3 * deep, 0.6 * high])
    crank = [
        lying(0.007, 0.05) + [0.025, 0, 0],
        box((0.008, 0.016, 0.11), (0.05, 0, 0.05)),
        lying(0.011, 0.06) + [0.082, 0, 0.1],
    ]
    crank = turned(crank, rotation(RIGHT, dice.between(0, 6.28)))
    kit.add("crank", spin(spot, RIGHT), [(moved(crank[:2], spot), metal), (moved(crank[2:], spot), DARK)])
    spot = np.array([-wide / 2 - 0.0105, 0, high - 0.025])
    knob = turned(dial(dice, 0.02), rotation(UP, -np.pi / 2))
    kit.add("knob", turning(dice, spot, LEFT), [(moved(knob, spot), DARK)])
    if dice.chance(0.7):
        y = -deep / 2
        kit.fix(
            [
                box((0.03, 0.05, 0.012), (0, y - 0.02, 0.006)),
                box((0.03, 0.012, 0.09), (0, y - 0.045, -0.035)),
                box((0.03, 0.06, 0.012), (0, y - 0.02, -0.08)),
            ],
            metal,
        )
        screw = [
            rod((0, y - 0.01, -0.13), (0, y - 0.01, -0.03), 0.005, 8),
            cylinder(0.014, 0.006) + [0, y - 0.01, -0.03],
            lying(0.004, 0.06) + [0, y - 0.01, -0.125],
        ]
        kit.add("screw", slide(UP, 0.02, -0.03), [(screw, looks.metal(dice))])
    if dice.chance(0.5):
        pin = np.array([0, 0.5 * deep, 0.82 * high])
        tray = [box((wide - 0.03, 0.12, 0.003), (0, 0.065, 0)), lying(0.003, wide - 0.03)]
        kit.add("tray", hinge(pin, RIGHT, 1.0, -0.4), [(moved(tray, pin), metal)])
    return kit.done()


CATEGORIES = (
    Category("chafing_dish", _chafing_dish),
    Category("french_press", _french_press),
    Category("drink_dispenser", _drink_dispenser),
    Category("bucket", _bucket),
    Category("picnic_basket", _picnic_basket),
    Category("pasta_machine", _pasta_machine),
)
