"""Saws that run by a motor: mitre saws, table saws and chain saws."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.legs import leg
from ...shapes.placing import X, Y, at, corners, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, open_box, rod, tube
from ...shapes.primitives import superquadric as soft
from . import looks
from .assembling import Assembly, dial, disc, press, turning
from .machine_tools_parts import DARK, handwheel, lobed_knob, sideways, sleeve
from .objects import Body, Look, hinge, slide, spin
from .rigging import DOWN, FRONT, LEFT, RIGHT, UP, ball_knob, lying, plate, profile, ribbon


def _arc(radius: float, width: float, thick: float, ends: tuple[float, float], x: float = 0.0) -> FloatArray:
    """A bent strip about x through 0, between two angles from +y over +z."""
    angle = np.linspace(*ends, 22)
    path = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return pointed(ribbon(path, width, thick, x - thick / 2), X)


def _blade(radius: float, thick: float) -> Pieces:
    """A toothed disc about x through 0, with flanges and an arbor."""
    tooth = box((0.9 * thick, 0.07 * radius, 0.07 * radius), (0, 0, 0.96 * radius))
    teeth = [turned([tooth], rotation(RIGHT, k * np.pi / 12))[0] for k in range(24)]
    return [lying(0.97 * radius, thick, X, 32), lying(0.2 * radius, 5 * thick), *teeth]


def _mitre_base(dice: Dice, kit: Assembly, wide: float, top: float, coat: Look, metal: Look) -> int:
    """A foot with wings and a fence, and the round table that turns in it; gives the table's number."""
    wing, foot = dice.between(0.08, 0.2), top - 0.031
    floor = [cylinder(wide, foot - 0.012, 28) + [0, 0, (foot + 0.012) / 2]]
    for s in (-1, 1):
        floor.append(
            box((wing, 0.9 * wide, top - 0.012), (s * (wide + 0.003 + wing / 2), 0, top / 2 + 0.006))
        )
        floor.append(box((0.5 * wide, 0.7 * wide, foot - 0.012), (s * 0.9 * wide, 0, (foot + 0.012) / 2)))
    kit.fix(floor, coat)
    spots = corners(2 * wide + 1.2 * wing, 0.7 * wide, 0.006)
    kit.fix(at(cylinder(0.014, 0.012, 10), spots), looks.rubber(dice))
    long, tall = wide + wing - 0.035, dice.between(0.03, 0.045)
    fence = [
        box((long, 0.014, tall), (s * (0.035 + long / 2), 0.02, top + 0.002 + tall / 2)) for s in (-1, 1)
    ]
    fence += [box((0.5 * wing, 0.05, 0.02), (s * (wide + wing / 2), 0.05, top + 0.01)) for s in (-1, 1)]
    kit.fix(fence, metal)
    angle, neck = np.linspace(0.1, np.pi - 0.1, 14), dice.between(0.05, 0.11)
    half = plate(np.column_stack([np.sin(angle), np.cos(angle)]) * wide, 0.03)
    half = half - [half[..., 0].min() - 0.013, 0, 0.0151 - top]
    ends = [box((0.05, 0.02, 0.028), (0, s * (wide - 0.008), top - 0.016)) for s in (-1, 1)]
    arm = [between((-0.035, -wide - neck, top - 0.03), (0.035, -0.95 * wide, top - 0.008))]
    grip = [tube([(0, -wide - neck, top - 0.02), (0, -wide - neck - 0.09, top - 0.026)], 0.014, 10)]
    turn = hinge((0, 0, top), UP, dice.between(0.75, 0.9), -dice.between(0.7, 0.85))
    look = looks.metal(dice)
    table = kit.add("turntable", turn, [([half, half * [-1, -1, 1], *ends, *arm], look), (grip, DARK)])
    if dice.chance(0.5):
        spot = np.array([0, -wide - 0.5 * neck, top - 0.007])
        kit.add(
            "lever",
            hinge(spot, LEFT, 0.35),
            [([box((0.02, 0.06, 0.008), spot + [0, -0.02, 0.005])], DARK)],
            table,
        )
    if dice.chance(0.6):
        spot = np.array([-wide - 0.5 * wing, 0.075, top])
        post = [rod(spot, spot + [0, 0, 0.16], 0.008, 10), box((0.02, 0.12, 0.018), spot + [0, -0.05, 0.15])]
        kit.fix(post, metal)
        spot = spot + [0, -0.1, 0.15]
        screw = [
            rod(spot - [0, 0, 0.08], spot + [0, 0, 0.06], 0.006, 10),
            cylinder(0.018, 0.008) + spot - [0, 0, 0.08],
        ]
        kit.add("clamp", slide(DOWN, 0.05), [(screw, metal), (lobed_knob(0.02, spot + [0, 0, 0.06]), DARK)])
    return table


def _mitre_saw(dice: Dice) -> list[Body]:
    """A motor arm that tips about a pin behind a round table; some ride on rods."""
    kit, coat, metal, shell = Assembly("base"), looks.metal(dice), looks.metal(dice), looks.plastic(dice)
    radius, top = dice.between(0.1, 0.155), dice.between(0.06, 0.09)
    wide, rides = 1.3 * radius, dice.chance(0.45)
    carrier = _mitre_base(dice, kit, wide, top, coat, metal)
    pin = np.array([0, 1.05 * wide, top + dice.between(0.07, 0.11)])
    back = pin[1] + (0.16 if rides else 0.02)
    kit.fix([between((-0.033, wide - 0.01, top - 0.03), (0.033, back + 0.02, top - 0.003))], metal, carrier)
    cheeks = [
        boxes(
            (0.012, 0.045, pin[2] - top + 0.03),
            [(s * 0.034, pin[1], (pin[2] + top) / 2 + 0.01) for s in (-1, 1)],
        )
    ]
    if rides:
        tall, high = pin[2] - top + 0.05, pin[2] - 0.02
        post = [box((0.06, 0.05, tall), (0, back, top + tall / 2 - 0.02))]
        post += [pointed(sleeve(0.0125, 0.022, 0.06), Y) + [s * 0.053, back - 0.03, high] for s in (-1, 1)]
        kit.fix(post, metal, carrier)
        rods = [rod((s * 0.053, pin[1], high), (s * 0.053, back + 0.16, high), 0.0115, 12) for s in (-1, 1)]
        rods += [
            box((0.14, 0.03, 0.03), (0, pin[1] + 0.002, pin[2] - 0.045)),
            box((0.13, 0.012, 0.03), (0, back + 0.165, high)),
        ]
        rods += [boxes((0.03, 0.03, 0.05), [(s * 0.053, pin[1], pin[2] - 0.03) for s in (-1, 1)])]
        rods += [boxes((0.012, 0.04, 0.07), [(s * 0.034, pin[1], pin[2] - 0.01) for s in (-1, 1)])]
        carrier = kit.add("carriage", slide(FRONT, 0.5 * radius), [(rods, metal)], carrier)
    else:
        kit.fix(cheeks, metal, carrier)
    _mitre_arm(dice, kit, pin, radius, top, carrier, (shell, metal))
    return kit.done()


def _mitre_arm(
    dice: Dice, kit: Assembly, pin: FloatArray, radius: float, top: float, to: int, of: tuple[Look, Look]
) -> None:
    """The arm with its motor, blade, guards and grip, raised."""
    (shell, metal), most = of, dice.between(0.5, 0.75)
    hub, up = np.array([0, -0.05 * radius, top - 0.014 + radius]), rotation(LEFT, most)
    toward = (pin - hub) / np.linalg.norm(pin - hub)
    arm = [rod(pin, hub + toward * (radius + 0.011), 0.02, 10), lying(0.022, 0.05) + pin]
    cap = [_arc(radius + 0.012, 0.004, 0.034, (-0.15, 3.3))]
    cap += [_arc(0.62 * radius + 0.006, 0.75 * radius, 0.003, (-0.15, 3.3), x) for x in (-0.0155, 0.0155)]
    long = dice.between(0.08, 0.14)
    motor = [lying(dice.between(0.034, 0.05), long, X, 18) + [0.02 + long / 2, 0, 0.15 * radius]]
    motor.append(lying(0.4 * radius, 0.02, X, 18) + [0.026, 0, 0.1 * radius])
    tall = radius + 0.014
    grip = tube(
        [
            (0, 0.1 * radius, tall),
            (0, 0, tall + 0.05),
            (0, -0.11, tall + 0.04),
            (0, -0.6 * radius, 0.8 * radius + 0.012),
        ],
        0.012,
        8,
    )
    if dice.chance(0.4):  # across instead of along
        grip = tube(
            [
                (-0.012, -0.7 * radius, 0.75 * radius),
                (-0.07, -0.9 * radius, radius),
                (0.07, -0.9 * radius, radius),
                (0.012, -0.7 * radius, 0.75 * radius),
            ],
            0.012,
            8,
        )
    body = [(turned(arm, up, pin), metal), (turned(moved(cap, hub), up, pin), metal)]
    body += [(turned(moved(motor, hub), up, pin), shell), (turned(moved([grip], hub), up, pin), DARK)]
    number = kit.add("arm", hinge(pin, RIGHT, most, -0.05), body, to)
    there = up @ (hub - pin) + pin
    kit.add("blade", spin(there, RIGHT), [(moved(_blade(radius, 0.0025), there), looks.metal(dice))], number)
    start = dice.between(2.8, 3.1)
    low = [_arc(radius + 0.0065, 0.002, 0.019, (start, start + 2.9))]
    low += [_arc(0.66 * radius, 0.6 * radius, 0.002, (start, start + 2.9), x) for x in (-0.0095, 0.0095)]
    low += [
        pointed(sleeve(0.24 * radius, 0.4 * radius, 0.002), X) + [x - 0.001, 0, 0] for x in (-0.0095, 0.0095)
    ]
    clear = looks.glass(dice) if dice.chance(0.5) else shell
    guard = turned(moved(low, hub), up, pin)
    kit.add("guard", hinge(there, RIGHT, dice.between(1.4, 2.0)), [(guard, clear)], number)


def _saw_stand(
    dice: Dice, kit: Assembly, half: FloatArray, level: float, thick: float, radius: float
) -> None:
    """What holds a saw's table up: a hollow cabinet, or a tub on legs; with wheels, buttons and a door."""
    coat, metal = looks.painted_metal(dice), looks.metal(dice)
    wide, deep, under = 1.5 * half[0], 1.6 * half[1], level - thick
    tub = under if dice.chance(0.5) else min(1.5 * radius, under)
    kit.fix([open_box((wide, deep, tub), 0.008) + [0, 0, under - tub]], coat)
    if tub < under:
        legs = at(leg(dice, under - tub * 0.5, 0.04), corners(wide + 0.05, deep - 0.06, under - 0.5 * tub))
        bars = at(box((0.03, deep - 0.06, 0.02)), [(s * (wide / 2 + 0.025), 0, 0.3 * under) for s in (-1, 1)])
        kit.fix(legs + bars, metal)
    wheel, face = dice.between(0.05, 0.085), -deep / 2
    spot = np.array([dice.between(-0.2, 0.2) * wide, face - 0.001, under - max(wheel + 0.02, 0.75 * radius)])
    kit.add("handwheel", spin(spot, FRONT), [(moved(handwheel(dice, wheel), spot), metal)])
    if dice.chance(0.6):
        spot = np.array([wide / 2 + 0.001, 0, spot[2]])
        kit.add("handwheel", spin(spot, RIGHT), [(moved(sideways(handwheel(dice, wheel), 1), spot), metal)])
    spot = np.array([-0.4 * wide, face, under - 0.09])
    kit.fix([box((0.06, 0.03, 0.1), spot - [0, 0.015, 0])], DARK)
    for k, color in enumerate(((40, 150, 60), (200, 40, 40))):
        cap = disc(0.016, 0.008, 14) + spot + [0, -0.031, 0.025 - 0.05 * k]
        kit.add("button", press(0.004), [([cap], Look("plastic", color))])
    if tub == under and under > 0.5 and dice.chance(0.6):
        door = [
            box((0.5 * deep, 0.014, 0.4 * under), (0, 0, 0)),
            box((0.02, 0.02, 0.09), (0.2 * deep, -0.014, 0)),
        ]
        spot = np.array([-wide / 2 - 0.009, 0, 0.3 * under])
        motion = hinge(spot + [0, 0.25 * deep, 0], DOWN, 1.8)
        kit.add("door", motion, [(moved(sideways(door, -1), spot), coat)])


def _table_saw(dice: Dice) -> list[Body]:
    """A blade that looks out of a table, below a guard, with a fence and a mitre gauge that slide."""
    kit, metal, shell = Assembly("table"), looks.metal(dice), looks.plastic(dice)
    radius, thick, level = dice.between(0.1, 0.16), 0.02, dice.pick((0.3, 0.34, 0.8, 0.88))
    half = np.array([dice.between(0.3, 0.5), dice.between(0.26, 0.4)])
    (x, y), groove, reach = half, -0.4 * half[0], 0.97 * radius
    spans = [(-x, groove - 0.011, -y, y), (groove + 0.011, -0.012, -y, y), (0.012, x, -y, y)]
    spans += [(-0.012, 0.012, -y, -reach), (-0.012, 0.012, 1.3 * reach, y)]
    top = [between((a, c, level - thick), (b, d, level)) for a, b, c, d in spans]
    top.append(box((0.05, 2 * y, 0.008), (groove, 0, level - thick + 0.003)))
    hub = np.array([0, 0, level - dice.between(0.25, 0.4) * radius])
    knife = _arc(radius + 0.016, 0.022, 0.002, (0.15, 1.05)) + hub
    kit.fix([*top, knife, lying(0.05, 0.1) + hub + [0.075, 0, -0.03]], metal)
    _saw_stand(dice, kit, half, level, thick, radius)
    kit.add("blade", spin(hub, RIGHT), [(moved(_blade(radius, 0.0025), hub), looks.metal(dice))])
    if dice.chance(0.85):
        tall = hub[2] + radius + 0.02 - level
        pin = np.array([0, 0.62 * radius, level + tall - 0.012])
        sides = [
            between((s * 0.012 - 0.002, -1.75 * radius, 0.006 - tall), (s * 0.012 + 0.002, 0.03, 0.014))
            for s in (-1, 1)
        ]
        cover = [*sides, between((-0.012, -1.75 * radius, 0.01), (0.012, 0.02, 0.014)), lying(0.006, 0.036)]
        clear = looks.glass(dice) if dice.chance(0.5) else shell
        kit.add("guard", hinge(pin, LEFT, dice.between(0.8, 1.3)), [(moved(cover, pin), clear)])
    _saw_fences(dice, kit, half, level, groove)
    return kit.done()


def _saw_fences(dice: Dice, kit: Assembly, half: FloatArray, level: float, groove: float) -> None:
    """A rail with a fence on it that a lever locks, and a mitre gauge in its groove."""
    (x, y), metal, shell = half, looks.metal(dice), looks.plastic(dice)
    rail = np.array([0, -y - 0.025, level - 0.02])
    kit.fix(
        [
            box((2 * x, 0.02, 0.03), rail),
            *at(box((0.03, 0.016, 0.02)), [(s * 0.8 * x, -y - 0.008, rail[2]) for s in (-1, 1)]),
        ],
        metal,
    )
    place, tall = dice.between(0.35, 0.7) * x, dice.between(0.04, 0.07)
    body = [
        between((-0.02, -y - 0.06, 0.002), (0.02, y, tall)),
        between((-0.06, -y - 0.06, 0.002), (0.06, -y - 0.01, 0.03)),
    ]
    body.append(between((-0.05, -y - 0.06, -0.05), (0.05, -y - 0.038, 0.002)))
    motion = slide(RIGHT, 0.95 * x - place, 0.05 - place)
    fence = kit.add("fence", motion, [(moved(body, (place, 0, level)), metal)])
    pin = np.array([place, -y - 0.066, level - 0.012])
    lever = [
        lying(0.006, 0.05),
        box((0.016, 0.012, 0.09), (0, -0.012, -0.04)),
        ball_knob(0.014) + [0, -0.014, -0.09],
    ]
    kit.add("lever", hinge(pin, LEFT, dice.between(0.8, 1.4)), [(moved(lever, pin), shell)], fence)
    if dice.chance(0.75):
        start = dice.between(-0.7, -0.3) * y
        bar = [
            box((0.02, 0.24, 0.008), (groove, start, level - 0.0055)),
            cylinder(0.008, 0.012) + [groove, start - 0.08, level + 0.002],
        ]
        gauge = kit.add("slide", slide((0, 1, 0), 0.8 * y - start, -0.3 * y), [(bar, metal)])
        spot, angle = np.array([groove, start - 0.08, level + 0.006]), np.linspace(0, np.pi, 10)
        head = [
            plate(0.07 * np.column_stack([np.cos(angle), -np.sin(angle)]), 0.008),
            box((0.17, 0.012, 0.04), (0, 0.006, 0.018)),
        ]
        turn = hinge(spot, UP, 0.8, -0.8)
        number = kit.add("head", turn, [(moved(head, spot), metal)], gauge)
        if dice.chance(0.6):
            spot = spot + [0, -0.035, 0.004]
            grip = [cylinder(0.006, 0.03) + [0, 0, 0.015], cylinder(0.015, 0.03) + [0, 0, 0.04]]
            kit.add("knob", turning(dice, spot, UP), [(moved(grip, spot), DARK)], number)


def _chain_saw(dice: Dice) -> list[Body]:
    """A motor with a bar before it, a bow and a rear grip; guard, trigger, lock, starter and caps move."""
    kit, shell, metal = Assembly("body"), looks.plastic(dice), looks.metal(dice)
    wide, long, tall = dice.between(0.13, 0.19), dice.between(0.2, 0.28), dice.between(0.14, 0.2)
    reach, high = dice.between(0.28, 0.6), dice.between(0.07, 0.1)
    blocks = [soft((wide, long, tall), 0.35, 0.3, 10), box((wide, long, tall))]
    kit.fix(
        [
            dice.pick(blocks) + [0, 0, tall / 2],
            box((0.02, 0.7 * long, 0.6 * tall), (wide / 2 + 0.005, 0, 0.4 * tall)),
        ],
        shell,
    )
    angle, half, x = np.linspace(-np.pi / 2, -3 * np.pi / 2, 10), dice.between(0.025, 0.04), wide / 2 - 0.012
    round_ = half * np.column_stack([np.cos(angle), np.sin(angle)]) + [-long / 2 - reach, high]
    path = np.concatenate([round_, [[-long * 0.3, high + 0.8 * half], [-long * 0.3, high - 0.8 * half]]])
    chain = pointed(ribbon(np.concatenate([path, path[:1]]), 0.009, 0.007, -0.0035), X)
    kit.fix([profile(path, 0.004) + [x, 0, 0], chain + [x, 0, 0]], metal)
    rear = long / 2 + dice.between(0.14, 0.18)
    loop = np.array(
        [
            (0.45 * long, 0.85 * tall),
            (rear, 0.8 * tall),
            (rear + 0.02, 0.5 * tall),
            (rear, 0.12 * tall),
            (0.45 * long, 0.1 * tall),
        ]
    )
    kit.fix([tube(np.insert(loop, 0, 0.0, axis=1), 0.014, 8)], DARK)
    bow, y = wide / 2 + 0.03, -0.12 * long
    arch = [
        (wide / 2 - 0.01, y, 0.75 * tall),
        (bow, y, tall),
        (bow - 0.02, y, tall + 0.06),
        (-bow, y, tall + 0.06),
        (-bow - 0.02, y, 0.5 * tall),
        (-wide / 2 + 0.01, y, 0.25 * tall),
    ]
    kit.fix([tube(arch, 0.011, 8)], DARK)
    pin, side = np.array([0, y - 0.05, 0.7 * tall]), wide / 2 + 0.012
    shield = [box((0.008, 0.022, 0.35 * tall + 0.02), (s * (side - 0.005), 0, 0.15 * tall)) for s in (-1, 1)]
    shield += [box((2 * side, 0.008, 0.075), (0, 0, 0.3 * tall + 0.045)), lying(0.008, 2 * side)]
    shield = turned(shield, rotation(RIGHT, dice.between(0, 0.1)))
    kit.add("guard", hinge(pin, RIGHT, 0.35, -0.15), [(moved(shield, pin), DARK)])
    _chain_saw_controls(dice, kit, (wide, long, tall), rear, shell)
    if dice.chance(0.3):
        _sheath(dice, kit, x, -long / 2, (reach, half, high))
    return kit.done()


def _sheath(dice: Dice, kit: Assembly, x: float, y: float, size: tuple[float, float, float]) -> None:
    """A cover that is pushed over the bar, which starts at y and is so long, half so wide and so high up."""
    (reach, half, high), start = size, y - size[0] - size[1] - 0.01
    floor, top = high - half - 0.012, high + half + 0.012
    cover = [
        between((x + s * 0.009 - 0.002, start, floor), (x + s * 0.009 + 0.002, y - 0.03, top))
        for s in (-1, 1)
    ]
    cover.append(between((x - 0.009, start, floor), (x + 0.009, y - 0.03, floor + 0.004)))
    kit.add("cover", slide(FRONT, reach + half + 0.05), [(cover, looks.plastic(dice))])


def _chain_saw_controls(
    dice: Dice, kit: Assembly, size: tuple[float, float, float], rear: float, shell: Look
) -> None:
    """Trigger and lock on the rear grip, and what starts and feeds the motor."""
    wide, long, tall = size
    red = Look("plastic", (200, 60, 30))
    pin = np.array([0, long / 2 + 0.045, 0.82 * tall - 0.018])
    trigger = [box((0.01, 0.045, 0.018), (0, 0.02, -0.012)), lying(0.004, 0.014)]
    kit.add("trigger", hinge(pin, RIGHT, 0.18), [(moved(trigger, pin), red)])
    if dice.chance(0.7):
        pin = np.array([0, rear - 0.015, 0.81 * tall + 0.018])
        lock = [box((0.012, 0.05, 0.007), (0, -0.022, 0.008)), lying(0.004, 0.014)]
        kit.add("lever", hinge(pin, RIGHT, 0.15), [(moved(lock, pin), red)])
    if dice.chance(0.65):
        spot = np.array([-wide / 2, 0.12 * long, 0.5 * tall])
        kit.fix(moved(sideways([disc(0.3 * tall, 0.012, 20)], -1), spot), DARK)
        grip = moved(
            sideways([box((0.07, 0.012, 0.02), (0, -0.02, 0)), disc(0.005, 0.016)], -1), spot - [0.0125, 0, 0]
        )
        kit.add("handle", slide(LEFT, dice.between(0.2, 0.5)), [(grip, red)])
        for k in (0, 1):
            spot = np.array([-wide / 2, (0.38 - 0.74 * k) * long, 0.2 * tall])
            cap = moved(sideways(dial(dice, 0.018), -1), spot)
            kit.add("cap", spin(spot, LEFT), [(cap, DARK)])
    else:
        spot = np.array([0, 0.2 * long, tall + 0.001])
        pack = [
            box((0.6 * wide, 0.35 * long, 0.05), (0, 0, 0.025)),
            box((0.3 * wide, 0.01, 0.012), (0, 0.18 * long, 0.03)),
        ]
        kit.add("battery", slide(UP, 0.1), [(moved(pack, spot), DARK)])
    if dice.chance(0.6):
        spot = np.array([wide / 2 + 0.015, -0.2 * long, 0.4 * tall])
        kit.add("knob", turning(dice, spot, LEFT), [(moved(sideways(dial(dice, 0.022), 1), spot), DARK)])
    else:
        nuts = [lying(0.009, 0.01, X, 6) + [wide / 2 + 0.019, s * 0.12 * long, 0.4 * tall] for s in (-1, 1)]
        kit.fix(nuts, looks.metal(dice))


def power_saw(dice: Dice) -> list[Body]:
    """A mitre saw, a table saw or a chain saw."""
    return dice.pick((_mitre_saw, _table_saw, _chain_saw))(dice)
