"""Machines to exercise on: bicycles that stand and boats on a rail."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, rod, torus, tube
from ...shapes.primitives import superquadric as soft
from . import looks
from .assembling import Assembly, turning
from .category import Category
from .machine_tools_parts import DARK, lobed_knob
from .objects import Body, Look, hinge, slide, spin
from .rigging import BACK, LEFT, RIGHT, UP, lying


def _crank(side: int, reach: float, start: float) -> tuple[Pieces, FloatArray]:
    """An arm about x through 0 and where its pedal turns; the other side's points the other way."""
    yaw = rotation(RIGHT, start + (np.pi if side > 0 else 0))
    arm = [box((0.014, 0.028, reach), (side * 0.075, 0, -reach / 2)), lying(0.02, 0.02) + [side * 0.07, 0, 0]]
    return turned(arm, yaw), yaw @ np.array([side * 0.105, 0, -reach])


def _cranks(dice: Dice, kit: Assembly, hub: FloatArray) -> None:
    """An axle with two arms, each with a pedal."""
    start, reach = dice.between(0, 6.28), dice.between(0.15, 0.18)
    sides = {s: _crank(s, reach, start) for s in (-1, 1)}
    pieces = [lying(0.012, 0.15), *sides[-1][0], *sides[1][0]]
    crank = kit.add("crank", spin(hub, RIGHT), [(moved(pieces, hub), looks.metal(dice))])
    for name, (_, spot) in zip(("left_pedal", "right_pedal"), sides.values(), strict=True):
        step = [box((0.085, 0.1, 0.022)), lying(0.006, 0.1)]
        kit.add("pedal", spin(hub + spot, RIGHT), [(moved(step, hub + spot), DARK)], crank, name)


def _bike_frame(kit: Assembly, front: float, back: float, high: float, radius: float, coat: Look) -> None:
    """Tubes from foot to foot, to the saddle and to the bars, and a fork about the flywheel."""
    paths = [
        [(0, front, 0.03), (0, back, 0.03)],
        [(0, back - 0.1, 0.04), (0, 0.24, high)],
        [(0, front, high - 0.05), (0, 0.24, high - 0.25)],
    ]
    kit.fix([tube(path, 0.024, 10) for path in paths], coat)
    y, top = front + 0.02, 2 * radius + 0.1
    fork = [tube([(s * 0.07, y, 0.03), (s * 0.07, y, top)], 0.014, 8) for s in (-1, 1)]
    kit.fix([*fork, box((0.17, 0.05, 0.04), (0, y, 2 * radius + 0.11))], coat)


def _chain_case(kit: Assembly, hub: FloatArray, wheel: FloatArray) -> None:
    """A box beside the cranks, from them to the flywheel."""
    size = (0.02, abs(hub[1] - wheel[1]) + 0.1, 0.13)
    kit.fix([box(size, (0.05, (hub[1] + wheel[1]) / 2, (hub[2] + wheel[2]) / 2))], DARK)


def _flywheel(dice: Dice, radius: float) -> Pieces:
    """A disc about x, or a rim with spokes."""
    if dice.chance(0.6):
        return [lying(radius, 0.02, X, 32), lying(0.05, 0.05)]
    spoke = [rod((0, 0, 0), (0, 0, 0.9 * radius), 0.008)]
    spokes = [turned(spoke, rotation(RIGHT, k * 1.2566))[0] for k in range(5)]
    return [pointed(torus(0.92 * radius, 0.025, 28), X), lying(0.04, 0.05), *spokes]


def _bike_seat(dice: Dice, kit: Assembly, high: float, metal: Look) -> None:
    """A saddle on a post that slides up."""
    rise = dice.between(0.06, 0.14)
    post = [rod((0, 0.24, high - 0.1), (0, 0.24, high + rise), 0.017, 10)]
    saddle = [
        soft((0.2, 0.25, 0.07), 0.5, 0.8) + [0, 0.26, high + rise + 0.03],
        box((0.06, 0.12, 0.05), (0, 0.11, high + rise + 0.03)),
    ]
    kit.add("seat", slide(UP, 0.16, -0.5 * rise), [(post, metal), (saddle, looks.fabric(dice))])


def _bars(kit: Assembly, y: float, level: float, metal: Look) -> None:
    """Two horns and a screen on a post that slides up."""
    top = level + 0.1
    bar = [rod((0, y, level - 0.08), (0, y, top), 0.018, 10)]
    for s in (-1, 1):
        path = [(s * 0.02, y, top), (s * 0.2, y + 0.02, level + 0.12), (s * 0.22, y + 0.16, level + 0.16)]
        bar.append(tube(path, 0.014, 8))
    bar.append(box((0.14, 0.02, 0.09), (0, y - 0.01, level + 0.17)))
    kit.add("handlebar", slide(UP, 0.14, -0.06), [(bar, metal)])


def _exercise_bike(dice: Dice) -> list[Body]:
    """A frame on two feet with a flywheel, cranks, a saddle and bars that slide, and a knob to brake."""
    kit, coat, metal = Assembly("frame"), looks.painted_metal(dice), looks.metal(dice)
    long, wide, radius = dice.between(0.9, 1.1), dice.between(0.4, 0.55), dice.between(0.16, 0.24)
    front, back = -long / 2, long / 2
    hub = np.array([0, 0.02, dice.between(0.3, 0.36)])
    wheel = np.array([0, front + radius + 0.05, radius + 0.08])
    kit.fix([lying(0.03, wide) + [0, y, 0.03] for y in (front, back)], coat)
    high = dice.between(0.7, 0.8)
    _bike_frame(kit, front, back, high, radius, coat)
    neck = rod((0, front + 0.02, 2 * radius + 0.12), (0, front, high + 0.1), 0.028, 10)
    kit.fix([neck, lying(0.035, 0.1) + hub], coat)
    _chain_case(kit, hub, wheel)
    kit.add("flywheel", spin(wheel, RIGHT), [(moved(_flywheel(dice, radius), wheel), metal)])
    _cranks(dice, kit, hub)
    _bike_seat(dice, kit, high, metal)
    _bars(kit, front, high + 0.1, metal)
    for spot in (np.array([0, 0.29, high - 0.12]), np.array([0, front + 0.07, 0.82 * high])):
        knob = turned([*lobed_knob(0.022, (0, 0, 0.03)), cylinder(0.007, 0.06)], rotation(RIGHT, -np.pi / 2))
        kit.add("knob", turning(dice, spot, BACK), [(moved(knob, spot), DARK)])
    return kit.done()


def _rail(
    kit: Assembly, ends: tuple[float, float], level: float, long: float, coat: Look, metal: Look
) -> None:
    """A rail along y, with a foot behind and a foot with a neck before."""
    front, back = ends
    kit.fix([box((0.06, 0.95 * long, 0.06), (0, (front + back) / 2 + 0.1, level - 0.03))], metal)
    post = box((0.05, 0.05, level - 0.05), (0, back, level / 2))
    kit.fix([box((0.45, 0.06, 0.05), (0, back, 0.025)), post], coat)
    neck = tube([(0, front - 0.2, 0.04), (0, front + 0.1, level)], 0.03, 8)
    kit.fix([box((0.55, 0.06, 0.05), (0, front - 0.2, 0.025)), neck], coat)


def _fan(kit: Assembly, hub: FloatArray, level: float, radius: float, coat: Look, metal: Look) -> None:
    """A fan about x between two struts."""
    strut = (0.012, 0.06, hub[2] - level + 0.1)
    sides = [box(strut, (s * 0.09, hub[1], (hub[2] + level) / 2 - 0.03)) for s in (-1, 1)]
    kit.fix([*sides, box((0.19, 0.2, 0.04), (0, hub[1] + 0.05, level - 0.06))], coat)
    blade = [box((0.13, 0.006, 0.7 * radius), (0, 0, 0.55 * radius))]
    blades = [turned(blade, rotation(RIGHT, k * np.pi / 4))[0] for k in range(8)]
    rims = [lying(0.6 * radius, 0.004, X, 24) + hub + [s * 0.06, 0, 0] for s in (-1, 1)]
    kit.add("fan", spin(hub, RIGHT), [([lying(0.05, 0.16) + hub, *moved(blades, hub), *rims], metal)])


def _sliding_seat(dice: Dice, kit: Assembly, back: float, level: float, metal: Look) -> None:
    """A seat on four rolls that slides along a rail."""
    start = dice.between(0.3, 0.8) * back
    seat = [
        soft((0.3, 0.24, 0.06), 0.4, 0.4) + [0, start, level + 0.07],
        box((0.12, 0.16, 0.03), (0, start, level + 0.03)),
    ]
    spots = [[s * 0.05, start + t * 0.07, level + 0.021] for s in (-1, 1) for t in (-1, 1)]
    rolls = [lying(0.02, 0.03) + spot for spot in spots]
    kit.add("seat", slide(BACK, back - start - 0.1, -start), [(seat, DARK), (rolls, metal)])


def _footrests(kit: Assembly, y: float, level: float, metal: Look) -> None:
    """Two slanted steps beside a rail, each on an axle."""
    for s in (-1, 1):
        spot = np.array([s * 0.13, y, level])
        step = [box((0.12, 0.02, 0.28), (0, 0, 0.14)), box((0.12, 0.05, 0.02), (0, 0.02, 0.01))]
        kit.fix([lying(0.01, 0.14) + spot - [0.03 * s, 0, 0]], metal)
        leaf = moved(turned(step, rotation(RIGHT, -0.6)), spot + [0, 0.012, 0.012])
        name = "left_footrest" if s < 0 else "right_footrest"
        kit.add("footrest", hinge(spot, RIGHT, 0.4, -0.4), [(leaf, DARK)], name=name)


def _monitor(dice: Dice, kit: Assembly, pin: FloatArray, radius: float, coat: Look) -> None:
    """A screen that tips on a bow over a fan."""
    legs = [box((0.012, 0.03, radius), pin + [s * 0.094, 0, -radius / 2]) for s in (-1, 1)]
    kit.fix([box((0.2, 0.03, 0.02), pin), *legs], coat)
    arm = [
        box((0.03, 0.02, 0.14), (0, 0, 0.08)),
        box((0.16, 0.02, 0.12), (0, 0.01, 0.2)),
        lying(0.009, 0.05) + [0, 0, 0.014],
    ]
    motion = hinge(pin + [0, 0, 0.014], LEFT, 0.7, -0.7)
    kit.add("monitor", motion, [(moved(arm, pin), looks.plastic(dice))])


def _rowing_machine(dice: Dice) -> list[Body]:
    """A rail with a seat that slides on it, footrests, a fan and a bar to pull."""
    kit, coat, metal = Assembly("frame"), looks.painted_metal(dice), looks.metal(dice)
    long, level, radius = dice.between(1.7, 2.2), dice.between(0.25, 0.4), dice.between(0.2, 0.28)
    front, back = -0.4 * long, 0.6 * long
    _rail(kit, (front, back), level, long, coat, metal)
    hub = np.array([0, front - 0.1, max(level, radius + 0.06) + 0.1])
    _fan(kit, hub, level, radius, coat, metal)
    _sliding_seat(dice, kit, back, level, metal)
    grip = np.array([0, dice.between(0.05, 0.2) + front + 0.1, level + 0.2])
    kit.fix([box((0.03, 0.03, 0.2 - 0.02), (0, grip[1] - 0.03, level + 0.085))], coat)
    bar, clasp = lying(0.015, 0.5) + grip, box((0.04, 0.05, 0.03), grip - [0, 0.02, 0])
    kit.add("handle", slide(BACK, 0.6), [([bar], DARK), ([clasp], metal)])
    _footrests(kit, front + 0.32, level, metal)
    if dice.chance(0.6):
        _monitor(dice, kit, np.array([0, hub[1], hub[2] + radius + 0.03]), radius, coat)
    return kit.done()


CATEGORIES = (
    Category("exercise_bike", _exercise_bike),
    Category("rowing_machine", _rowing_machine),
)
