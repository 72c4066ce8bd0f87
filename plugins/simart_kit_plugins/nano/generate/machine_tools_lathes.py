"""Lathes for metal and for wood, from a watchmaker's to one on cabinets."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.legs import leg
from ...shapes.placing import X, at, corners, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, revolve, rod
from . import looks
from .assembling import Assembly, dial, disc, holder, press, shell, swing, turning
from .machine_tools_parts import DARK, clamp_lever, handwheel, sideways
from .objects import Body, Look, hinge, slide, spin
from .rigging import DOWN, FRONT, LEFT, RIGHT, UP, ball_knob, lying, ribbon


def _jaw_chuck(dice: Dice, radius: float, long: float) -> Pieces:
    """A chuck about x, from x = 0 to the right, with jaws and key holes."""
    pieces = [lying(radius, long, X, 24) + [long / 2, 0, 0], lying(0.5 * radius, 0.012) - [0.005, 0, 0]]
    count, out = dice.pick((3, 4)), dice.between(0.3, 0.6)
    for k in range(count):
        jaw = [boxes([(0.4 * long, 0.25 * radius, 0.6 * radius), (0.7 * long, 0.25 * radius, 0.3 * radius)],
                     [(1.2 * long, 0, out * radius), (1.35 * long, 0, (out - 0.15) * radius)])]  # fmt: skip
        jaw.append(box((0.2 * long, 0.12 * radius, 0.02 * radius), (0.5 * long, 0, radius)))
        pieces += turned(jaw, rotation(RIGHT, 2 * np.pi * k / count))
    if dice.chance(0.5):
        pieces.append(lying(0.2 * radius, 2.4 * long, X, 16) + [1.6 * long, 0, 0])
    return pieces


def _stand(dice: Dice, kit: Assembly, low: float, high: float, coat: Look) -> None:
    """What is below a bed from x = low to high, whose underside is at z = 0: feet, legs or cabinets."""
    style, long = dice.pick(("feet", "cabinets", "legs")), high - low
    if style == "feet":
        for x in (low + 0.08, high - 0.08):
            kit.fix([box((0.1, 0.2, 0.03), (x, 0, -0.015))], coat)
        return
    tall = dice.between(0.55, 0.75)
    kit.fix([box((long + 0.06, 0.36, 0.02), ((low + high) / 2, 0, -0.01))], looks.painted_metal(dice))
    if style == "legs":
        spots = corners(long - 0.1, 0.28, -0.02) + [(low + high) / 2, 0, 0]
        kit.fix(at(leg(dice, tall, 0.05), spots), coat)
        shelf = box((long - 0.1, 0.28, 0.02), ((low + high) / 2, 0, -0.75 * tall))
        kit.fix([shelf] if dice.chance(0.5) else [], coat)
        return
    wide = min(0.34 * long, 0.4)
    for x, side in ((low + wide / 2, -1), (high - wide / 2, 1)):
        case = moved([shell(wide, 0.32, tall, 0.012)], (x, 0, -tall - 0.02))
        if dice.chance(0.3):
            kit.fix([box((wide, 0.32, tall), (x, 0, -tall / 2 - 0.02))], coat)
            continue
        kit.fix(case, coat)
        front = [box((wide - 0.004, 0.014, tall - 0.006), (x, -0.169, -tall / 2 - 0.02))]
        grip = moved(holder(dice, 0.12, True), (x - side * 0.38 * wide, -0.176, -0.3 * tall))
        motion = swing(side, x + side * (wide / 2 - 0.002), -0.169, dice.between(1.5, 2.0))
        kit.add("door", motion, [(front, coat), (grip, looks.metal(dice))])


def _tail_stock(
    dice: Dice, kit: Assembly, x: float, bed: float, center: float, room: tuple[float, float]
) -> None:
    """A block on the bed with a quill, the hand wheel behind it, and a lever that holds it."""
    coat, metal, long = looks.painted_metal(dice), looks.metal(dice), dice.between(0.11, 0.16)
    body = [
        box((0.8 * long, 0.18, 0.035), (x, 0, bed + 0.0185)),
        box((0.6 * long, 0.05, center - bed - 0.03), (x, 0, (center + bed) / 2 + 0.012)),
    ]
    body += [lying(0.032, long, X, 18) + [x, 0, center], box((0.5 * long, 0.05, 0.02), (x, 0, bed - 0.012))]
    stock = kit.add("tail stock", slide(LEFT, *room), [(body, coat)])
    tip = revolve([[0.016, -0.05], [0.016, 0.02], [0.011, 0.025], [0, 0.055]], 14)
    quill = [pointed(tip, X) * [-1, 1, 1] + [x - long / 2 - 0.004, 0, center]]
    quill = [piece[:, ::-1] for piece in quill]
    kit.add("quill", slide(LEFT, 0.05), [(quill, looks.metal(dice))], stock)
    spot = np.array([x + long / 2 + 0.001, 0, center])
    wheel = moved(sideways(handwheel(dice, dice.between(0.045, 0.06)), 1), spot)
    kit.add("handwheel", spin(spot, RIGHT), [(wheel, metal)], stock)
    if dice.chance(0.6):
        clamp_lever(kit, (x + 0.4 * long + 0.001, -0.06, bed + 0.026), 0.08, metal, stock, 0.9)
    elif dice.chance(0.8):
        spot = np.array([x, 0, center + 0.032])
        lever = [
            cylinder(0.007, 0.03) + [0, 0, 0.014],
            rod((0, 0, 0.024), (0, -0.06, 0.034), 0.004),
            ball_knob(0.008) + [0, -0.06, 0.034],
        ]
        kit.add("lever", hinge(spot, UP, 0.8, -0.8), [(moved(lever, spot), metal)], stock)


def _carriage(
    dice: Dice, kit: Assembly, x: float, bed: float, room: tuple[float, float], plain: bool
) -> None:
    """A saddle with an apron, a cross slide, mostly a top slide unless plain, and a post with a tool."""
    coat, metal, wide = looks.painted_metal(dice), looks.metal(dice), dice.between(0.1, 0.14)
    body = [between((x - wide / 2, -0.13, bed + 0.001), (x + wide / 2, 0.085, bed + 0.022))]
    body.append(between((x - wide / 2, -0.13, bed - 0.09), (x + wide / 2, -0.108, bed + 0.001)))
    body.append(between((x - 0.025, -0.15, bed + 0.001), (x + 0.025, -0.13, bed + 0.03)))
    carriage = kit.add("carriage", slide(RIGHT, room[1], -room[0]), [(body, coat)])
    spot = np.array([x - 0.15 * wide, -0.131, bed - 0.045])
    kit.add("handwheel", spin(spot, FRONT), [(moved(handwheel(dice, 0.042), spot), metal)], carriage)
    spot = np.array([x, -0.151, bed + 0.015])
    kit.add("handwheel", spin(spot, FRONT), [(moved(handwheel(dice, 0.026), spot), metal)], carriage)
    if not plain and dice.chance(0.6):
        spot = np.array([x + 0.36 * wide, -0.131, bed - 0.05])
        lever = [
            disc(0.01, 0.014),
            rod((0, -0.01, 0), (0, -0.02, -0.05), 0.004),
            ball_knob(0.008) + [0, -0.02, -0.05],
        ]
        kit.add("lever", hinge(spot, FRONT, 0.5, -0.5), [(moved(lever, spot), metal)], carriage)
    z = bed + 0.023
    way = [
        between((x - 0.032, -0.125, z), (x + 0.032, 0.04, z + 0.018)),
        cylinder(0.03, 0.008, 20) + [x, -0.075, z + 0.022],
    ]
    cross = kit.add("slide", slide((0, 1, 0), 0.03, -0.05), [(way, metal)], carriage)
    if not plain and dice.chance(0.7):
        top = [between((x - 0.045, -0.1, z + 0.027), (x + 0.075, -0.05, z + 0.043))]
        cross = kit.add("slide", slide(LEFT, 0.03, -0.02), [(top, metal)], cross)
        spot = np.array([x + 0.076, -0.075, z + 0.035])
        wheel = moved(sideways(handwheel(dice, 0.02), 1), spot)
        kit.add("handwheel", spin(spot, RIGHT), [(wheel, metal)], cross)
    pin = np.array([x - 0.01, -0.075, z + 0.044])
    post = [
        box((0.044, 0.044, 0.03), (0, 0, 0.0155)),
        box((0.01, 0.08, 0.01), (-0.016, 0.02, 0.0155 + 0.012)),
    ]
    kit.fix([cylinder(0.008, 0.05) + pin + [0, 0, 0.008]], metal, cross)
    number = kit.add("holder", hinge(pin, UP, 1.5, -1.5), [(moved(post, pin), looks.metal(dice))], cross)
    lever = [
        cylinder(0.011, 0.014) + [0, 0, 0.041],
        rod((0, 0, 0.042), (0.03, -0.05, 0.06), 0.004),
        ball_knob(0.008) + [0.03, -0.05, 0.06],
    ]
    kit.add("lever", hinge(pin, UP, 1.2, -0.4), [(moved(lever, pin), metal)], number)


def _head_front(dice: Dice, kit: Assembly, low: float, high: float, y: float, z: float) -> None:
    """Knobs and buttons on the front of a head stock, from x = low to high, about a height."""
    count = dice.whole(1, 2)
    for k in range(count):
        spot = np.array([low + (k + 0.5) / count * (high - low), y, z + (0.02 if k % 2 else -0.01)])
        if dice.chance(0.6):
            knob = moved(dial(dice, 0.018), spot)
            kit.add("knob", turning(dice, spot), [(knob, DARK)])
        else:
            kit.fix([disc(0.02, 0.006) + spot], DARK)
            color = dice.pick(((200, 40, 40), (40, 150, 60), (30, 30, 32)))
            kit.add(
                "button",
                press(0.004),
                [([disc(0.014, 0.012) + spot - [0, 0.007, 0]], Look("plastic", color))],
            )


def _gear_door(dice: Dice, kit: Assembly, x: float, low: float, high: float, coat: Look) -> None:
    """A hollow cover at the left end of a head stock, hinged behind, with gears in it."""
    cover = turned([shell(0.19, 0.045, high - low, 0.004)], rotation(UP, np.pi / 2))
    cover = moved(cover, (x - 0.024, 0, low))
    grip = box((0.01, 0.014, 0.05), (x - 0.051, -0.07, (low + high) / 2))
    pins = [cylinder(0.005, 0.04) + [x - 0.006, 0.1, low + t * (high - low)] for t in (0.25, 0.75)]
    motion = hinge((x - 0.006, 0.1, 0), DOWN, dice.between(1.5, 2.2))
    kit.add("door", motion, [([*cover, grip], coat), (pins, looks.metal(dice))])
    tall = high - low
    for z, radius in ((low + 0.72 * tall, 0.17 * tall), (low + 0.3 * tall, 0.22 * tall)):
        teeth = [
            turned([box((0.012, 0.008, 0.012), (0, 0, radius))], rotation(RIGHT, k * np.pi / 9))[0]
            for k in range(18)
        ]
        gear = moved([lying(radius, 0.012, X, 18), *teeth, lying(0.2 * radius, 0.024)], (x - 0.014, 0, z))
        kit.add("gear", spin((x, 0, z), RIGHT), [(gear, looks.metal(dice))])


def _chuck_guard(dice: Dice, kit: Assembly, nose: FloatArray, out: float, coat: Look, metal: Look) -> None:
    """A bent shield before the nose of a head stock, on a rod behind, that tips back over it."""
    angle = np.linspace(0.0, dice.between(2.3, 2.9), 16)
    arch = ribbon(out * np.column_stack([np.cos(angle), np.sin(angle)]), 0.004, 0.07)
    hook = nose + [0.002, out + 0.004, 0]
    guard = [pointed(arch, X) + nose + [0.004, 0, 0], lying(0.007, 0.072) + hook + [0.037, 0, 0]]
    kit.fix(
        [lying(0.004, 0.1) + hook + [0.02, 0, 0], box((0.01, 0.03, 0.02), hook - [0.006, 0.008, 0])],
        metal,
    )
    clear = looks.glass(dice) if dice.chance(0.6) else coat
    kit.add("guard", hinge(hook, LEFT, dice.between(1.2, 1.7)), [(guard, clear)])


def _metal_lathe(dice: Dice) -> list[Body]:
    """A bed with a head stock, a chuck below a guard, a carriage, a tail stock and a lead screw."""
    kit, coat, metal = Assembly("bed"), looks.painted_metal(dice), looks.metal(dice)
    long, head, rise = dice.between(0.72, 1.2), dice.between(0.17, 0.24), dice.between(0.1, 0.13)
    bed, low = 0.12, -long / 2
    nose, radius, center = low + head, dice.between(0.05, 0.07), bed + rise
    kit.fix([boxes((long, 0.045, 0.03), [(0, s * 0.0575, bed - 0.015) for s in (-1, 1)])], metal)
    kit.fix(
        [
            boxes((long, 0.03, 0.09), [(0, s * 0.057, 0.045) for s in (-1, 1)]),
            box((long, 0.1, 0.02), (0, 0, 0.01)),
        ],
        coat,
    )
    top = center + radius + 0.02
    kit.fix(
        [between((low, -0.095, bed), (nose, 0.095, top)), lying(0.04, 0.016) + [nose + 0.006, 0, center]],
        coat,
    )
    pin = np.array([nose + 0.02, 0, center])
    kit.add("chuck", spin(pin, RIGHT), [(moved(_jaw_chuck(dice, radius, 0.04), pin), metal)])
    if dice.chance(0.75):
        _chuck_guard(dice, kit, np.array([nose, 0, center]), radius + 0.018, coat, metal)
    _head_front(dice, kit, low + 0.02, nose - 0.02, -0.095, (bed + top) / 2)
    geared = dice.chance(0.5)
    if geared:
        _gear_door(dice, kit, low, bed - 0.06, top, coat)
    right = -low
    start, end = nose + 0.2 + dice.between(0, 0.08), right - 0.13 - dice.between(0, 0.1)
    gap = end - 0.22 - start
    _carriage(dice, kit, start, bed, (start - nose - 0.19, max(0.7 * gap, 0.03)), geared)
    _tail_stock(dice, kit, end, bed, center, (max(0.3 * gap, 0.01), -min(right - end - 0.08, 0.1)))
    screw = [lying(0.007, long - head, X, 10) + [head / 2, -0.0975, bed - 0.045]]
    kit.fix(
        [
            box((0.02, 0.04, 0.04), (right - 0.01, -0.09, bed - 0.045)),
            box((0.03, 0.04, 0.06), (nose - 0.015, -0.085, bed - 0.04)),
        ],
        coat,
    )
    kit.add("screw", spin((0, -0.0975, bed - 0.045), RIGHT), [(screw, metal)])
    _stand(dice, kit, low, right, coat)
    if dice.chance(0.3):
        kit.fix(
            [
                between((low, 0.2, 0.0), (right, 0.21, top + 0.15)),
                *[between((x, 0.05, 0), (x + 0.03, 0.2, 0.02)) for x in (low + 0.1, right - 0.1)],
            ],
            coat,
        )
    small = dice.pick((1.0, 1.0, 0.35, 0.6)) if kit.points(0)[:, 2].min() > -0.1 else 1.0
    return kit.done(small * np.eye(3))


def _wood_lathe(dice: Dice) -> list[Body]:
    """Two bars with a head stock, turned wood between centres, a rest on a foot, and a tail stock."""
    kit, coat, metal = Assembly("bed"), looks.painted_metal(dice), looks.metal(dice)
    long, head, rise, bed = dice.between(0.8, 1.4), dice.between(0.14, 0.22), dice.between(0.14, 0.2), 0.07
    low, center = -long / 2, bed + rise
    nose, right = low + head, long / 2
    bars = [lying(0.03, long, X, 16) + [0, s * 0.055, bed - 0.03] for s in (-1, 1)]
    bars = (
        bars
        if dice.chance(0.4)
        else [boxes((long, 0.045, 0.07), [(0, s * 0.055, bed - 0.035) for s in (-1, 1)])]
    )
    kit.fix(bars, metal)
    kit.fix([box((0.05, 0.16, 0.06), (s * (right - 0.03), 0, 0.03)) for s in (-1, 1)], coat)
    top = center + 0.07
    case = [
        between((low, -0.08, bed), (low + 0.02, 0.09, top)),
        between((nose - 0.03, -0.08, bed), (nose, 0.09, top)),
    ]
    case += [
        between((low, 0.075, bed), (nose, 0.09, top)),
        between((low, -0.08, top - 0.012), (nose, 0.09, top)),
    ]
    case.append(between((low, -0.08, bed), (nose, 0.09, bed + 0.05)))
    kit.fix(case, coat)
    tall = top - 0.014 - bed - 0.052
    door = [box((head - 0.004, 0.01, tall), (0, 0, 0)), box((0.05, 0.012, 0.012), (0, -0.01, -0.35 * tall))]
    pins = [lying(0.006, 0.03) + [s * 0.3 * head, -0.003, tall / 2 - 0.006] for s in (-1, 1)]
    place = np.array([(low + nose) / 2, -0.087, bed + 0.051 + tall / 2])
    motion = hinge(place + [0, -0.003, tall / 2 - 0.006], LEFT, dice.between(1.4, 2.2))
    kit.add("door", motion, [(moved(door, place), coat), (moved(pins, place), metal)])
    end = right - 0.12 - dice.between(0, 0.15)
    reach = end - 0.135 - nose - 0.04
    rows = np.linspace(0, 1, 15)
    shape = 0.018 + 0.03 * dice.unit() + 0.012 * np.sin(rows * dice.between(8, 25) + dice.between(0, 6))
    line = np.column_stack([shape, rows * reach])
    work = [pointed(revolve([[0, 0], *line, [0, reach]], 18), X) + [nose + 0.03, 0, center]]
    pulley = [lying(0.05 - 0.012 * k, 0.018, X, 20) + [low + 0.05 + 0.02 * k, 0, center] for k in range(3)]
    spindle = [
        lying(0.014, head + 0.06) + [(low + nose) / 2, 0, center],
        lying(0.03, 0.012) + [nose + 0.024, 0, center],
        *pulley,
    ]
    spindle.append(lying(dice.between(0.04, 0.06), 0.018, X, 20) + [low - 0.022, 0, center])
    kit.add(
        "spindle", spin((low, 0, center), RIGHT), [(spindle, metal), (work, Look("wood", (196, 154, 108)))]
    )
    _tool_rest(dice, kit, nose + dice.between(0.3, 0.6) * reach, bed, center, 0.22 * reach)
    _tail_stock(dice, kit, end, bed, center, (0.004, -min(right - end - 0.08, 0.12)))
    spot = np.array([nose - 0.04 - 0.3 * head, -0.08, bed + 0.025])
    kit.add("knob", turning(dice, spot), [(moved(dial(dice, 0.018), spot), DARK)])
    _stand(dice, kit, low, right, coat)
    return kit.done()


def _tool_rest(dice: Dice, kit: Assembly, x: float, bed: float, center: float, room: float) -> None:
    """A foot that slides along a wood lathe's bed, and a rest that turns on its post before the work."""
    coat, metal = looks.painted_metal(dice), looks.metal(dice)
    foot = [
        box((0.07, 0.24, 0.03), (x, -0.06, bed + 0.016)),
        cylinder(0.026, 0.07, 16) + [x, -0.13, bed + 0.066],
    ]
    base = kit.add("carriage", slide(RIGHT, room, -room), [(foot, coat)])
    spot, long = np.array([x, -0.13, bed + 0.1]), dice.between(0.15, 0.3)
    bar = [
        cylinder(0.012, center - bed - 0.05) + [0, 0, (center - bed - 0.1) / 2 - 0.02],
        box((long, 0.016, 0.022), (0, 0.006, center - bed - 0.1)),
        box((long, 0.006, 0.045), (0, 0.014, center - bed - 0.092)),
    ]
    kit.add("rest", hinge(spot, UP, 0.4, -0.4), [(moved(bar, spot), metal)], base)
    clamp_lever(kit, (x + 0.027, -0.13, bed + 0.075), 0.07, metal, base, 0.9)


def lathe(dice: Dice) -> list[Body]:
    """A lathe for metal, or for wood."""
    return dice.weighted([(5, _metal_lathe), (3, _wood_lathe)])(dice)
