"""Bicycles, scooters, boards and toy trains."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, around, moved, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, prism, revolve, rod, superquadric, torus, tube
from . import looks
from .category import Category
from .objects import Body, hinge, slide, spin, surface
from .rigging import LEFT, RIGHT, UP, Rig, axle_wheel, lying, plate, profile


def _spoked(radius: float, tyre: float, spokes: int) -> tuple[Pieces, Pieces]:
    """Tyre, and spokes with a hub, about the x axis."""
    level = rotation((0, 1, 0), np.pi / 2)
    spoke = rod((0, 0, 0), (radius - tyre, 0, 0), 0.06 * tyre + 0.0015, 4)
    inner = [*around([spoke], spokes), cylinder(0.08 * radius, 0.24 * radius, 10)]
    return turned([torus(radius - tyre, tyre, 20)], level), turned(inner, level)


def _thin_wheel(dice: Dice, radius: float, width: float) -> Pieces:
    """A random wheel about x, squeezed to a width."""
    form = axle_wheel(dice, radius)
    half = max(float(np.abs(piece[..., 0]).max()) for piece in form)
    return [piece * [0.5 * width / half, 1, 1] for piece in form]


def _bicycle(dice: Dice) -> list[Body]:
    radius, base = dice.between(0.2, 0.35), dice.between(0.95, 1.1)
    tyre, paint, metal = dice.between(0.012, 0.028), looks.painted_metal(dice), looks.metal(dice)
    base *= radius / 0.32 * 0.4 + 0.6
    rear, front = np.array([0, base / 2, radius]), np.array([0, -base / 2, radius])
    lean = dice.between(0.25, 0.4)
    head = front + [0, lean * (radius + 0.22), radius + 0.22]
    crank = np.array([0, 0.08 * base, 0.85 * radius])
    saddle = crank + [0, 0.25 * base * 0.6, radius + 0.12]
    low = head + [0, -0.1 * lean, -0.1]
    thin = dice.between(0.011, 0.018)
    frame = [rod(crank, saddle, thin, 8)]
    frame.append(rod(low, crank, 1.2 * thin, 8))
    if dice.chance(0.7):
        frame.append(rod(head + [0, 0.02, -0.02], saddle - 0.1 * (saddle - crank), thin, 8))
    for s in (-1, 1):
        frame += [
            rod(crank + [s * 0.03, 0, 0], rear + [s * 0.06, 0, 0], 0.6 * thin),
            rod(saddle - [0, 0, 0.05], rear + [s * 0.06, 0, 0], 0.5 * thin),
        ]
    frame.append(rod(low, head + [0, 0.05 * lean, 0.05], 1.5 * thin, 8))
    whole = Rig(surface(frame, paint), label="frame")
    seat = [
        prism(rounded(0.4), (0.15, 0.26, 0.05)) + saddle + [0, 0.02, 0.1],
        rod(saddle, saddle + [0, 0.02, 0.1], 0.8 * thin),
    ]
    whole.add("saddle", slide(saddle - crank, 0.1), surface(seat, looks.rubber(dice)))
    axis = (head - front) / np.linalg.norm(head - front)
    bars = [rod(head, head + 0.12 * axis, 0.8 * thin)]
    bars += [
        rod(head - 0.14 * axis + [s * 0.05, 0, 0], front + [s * 0.05, 0, 0], 0.8 * thin) for s in (-1, 1)
    ]
    bars.append(rod(head - 0.14 * axis - [0.055, 0, 0], head - 0.14 * axis + [0.055, 0, 0], thin))
    bars.append(_grips(dice, head + 0.12 * axis, thin))
    steer = whole.add("handlebar", hinge(head, axis, 1.0, -1.0), surface(bars, metal))
    rubber, spokes = looks.rubber(dice), dice.whole(8, 14)
    rim, inner = _spoked(radius, tyre, spokes)
    for name, hub, parent in (("front_wheel", front, steer), ("rear_wheel", rear, 0)):
        whole.add(
            "wheel",
            spin(hub, RIGHT),
            surface(moved(rim, hub), rubber),
            surface(moved(inner, hub), metal),
            parent=parent,
            name=name,
        )
    _cranks(dice, whole, crank)
    if dice.chance(0.5):
        pin = crank + [-0.05, 0.08, -0.02]
        leg = surface([rod(pin, pin + [-0.06, 0.05, -0.8 * radius], 0.008)], metal)
        whole.add("kickstand", hinge(pin, RIGHT, 1.4), leg)
    return whole.bodies()


def _grips(dice: Dice, top: FloatArray, thin: float) -> FloatArray:
    """The bar across the steering post, straight or bent."""
    wide, bend = dice.between(0.22, 0.32), dice.between(-0.08, 0.15)
    ends = [[-wide, bend, 0.04], [-0.06, 0, 0], [0.06, 0, 0], [wide, bend, 0.04]]
    return tube(top + np.array(ends), 0.8 * thin, 8)


def _cranks(dice: Dice, whole: Rig, at: FloatArray) -> None:
    """Chain wheel with arms, and pedals on them."""
    metal, arm, angle = looks.metal(dice), 0.15, dice.between(0, 6)
    tip = np.array([0, np.cos(angle), np.sin(angle)]) * arm
    pieces = [lying(0.09, 0.006, X, 18) + at + [0.05, 0, 0], lying(0.012, 0.16, X, 8) + at]
    pieces += [rod(at + [s * 0.07, 0, 0], at + [s * 0.08, 0, 0] + s * tip, 0.01) for s in (-1, 1)]
    turn = whole.add("crank", spin(at, RIGHT), surface(pieces, metal))
    for name, s in (("left_pedal", -1), ("right_pedal", 1)):
        hub = at + [s * 0.13, 0, 0] + s * tip
        step = [box((0.08, 0.09, 0.02), hub), lying(0.006, 0.1, X, 8) + hub]
        whole.add("pedal", spin(hub, RIGHT), surface(step, looks.rubber(dice)), parent=turn, name=name)


def _scooter(dice: Dice) -> list[Body]:
    """A kick scooter: deck, steering post, which may fold, and two or three wheels."""
    long, wide, tall = dice.between(0.45, 0.7), dice.between(0.1, 0.16), dice.between(0.65, 1.0)
    radius, metal, rubber = dice.between(0.05, 0.11), looks.metal(dice), looks.rubber(dice)
    level, y = radius + 0.015, long / 2
    deck = prism(rounded(0.2, wide / long), (wide, long, 0.03)) + [0, 0, level]
    neck = [rod((0, -y + 0.03, level), (0, -y - 0.1, level + 0.12), 0.02, 8)]
    tail = boxes((0.01, radius + 0.08, 0.03), [(s * 0.03, y + radius / 2, level) for s in (-1, 1)])
    whole = Rig(surface([deck], looks.plastic(dice)), surface([*neck, tail], metal), label="deck")
    low = np.array([0, -y - 0.11, level + 0.12])
    parent, lean = 0, rotation(RIGHT, -dice.between(0.1, 0.25))
    axis = lean @ np.array(UP)
    if dice.chance(0.5):
        joint = surface([lying(0.024, 0.05, X, 12) + low], looks.darker(metal))
        parent = whole.add("folding joint", hinge(low, RIGHT, 1.4), joint)
    bars: Pieces = [rod(low - 0.09 * axis, low + tall * axis, 0.016, 8)]
    bars.append(lying(0.014, dice.between(0.3, 0.45), X, 10) + low + tall * axis)
    steer = whole.add("handlebar", hinge(low, axis, 0.9, -0.9), surface(bars, metal), parent=parent)
    front = low - 0.09 * axis
    front = front * [1, 1, 0] + [0, -0.02, radius]
    pair = dice.chance(0.3)
    whole.dress(
        steer,
        surface(
            [rod(low - 0.06 * axis + [s * 0.025, 0, 0], front + [s * 0.025, 0, 0], 0.008) for s in (-1, 1)],
            metal,
        ),
    )
    form = _thin_wheel(dice, radius, 0.032)
    for x in (-0.075, 0.075) if pair else (0.0,):
        hub = front + [x, 0, 0]
        whole.add(
            "wheel",
            spin(hub, RIGHT),
            surface(moved(form, hub), rubber),
            surface([lying(0.012, 0.045, X, 8) + hub], metal),
            parent=steer,
            name="front_wheel",
        )
    if pair:
        whole.dress(steer, surface([lying(0.008, 0.16, X, 8) + front], metal))
    hub = np.array([0, y + radius + 0.02, radius])
    whole.add("wheel", spin(hub, RIGHT), surface(moved(form, hub), rubber), name="rear_wheel")
    if dice.chance(0.5):
        pin = np.array([0, y, level + 0.03])
        reach = 1.6 * radius
        shape = np.array([[0, 0], [reach, 0.9 * radius], [reach, 0.9 * radius + 0.01], [0, 0.015]])
        brake = profile(shape, 0.05)
        whole.add("brake", hinge(pin, LEFT, 0.25), surface([brake + pin], rubber))
    if dice.chance(0.5):
        pin = np.array([-wide / 2, 0, level - 0.01])
        whole.add(
            "kickstand",
            hinge(pin, RIGHT, 1.5),
            surface([rod(pin, pin + [-0.03, 0.01, -level + 0.01], 0.006)], metal),
        )
    return whole.bodies()


def _skateboard(dice: Dice) -> list[Body]:
    long, wide = dice.between(0.55, 1.0), dice.between(0.15, 0.25)
    y = np.linspace(-0.5, 0.5, 9) * long
    rise = dice.between(0.02, 0.06) * np.maximum(np.abs(np.linspace(-1, 1, 9)) - 0.65, 0) / 0.35
    half = wide / 2 * np.array([0.45, 0.85, 1, 1, 1, 1, 1, 0.85, 0.45])
    sections = np.concatenate([np.stack([half, y, rise], 1), np.stack([-half, y, rise], 1)[::-1]])
    flat = plate(sections[:, :2], 0.011)
    flat[..., 2] += np.interp(flat[..., 1], y, rise)
    whole = Rig(surface([flat], looks.wood(dice)), label="deck")
    radius, metal, rubber = dice.between(0.025, 0.04), looks.metal(dice), looks.plastic(dice)
    for name, s in (("front", -1), ("rear", 1)):
        at = np.array([0, s * 0.3 * long, -0.02])
        whole.dress(0, surface([box((0.06, 0.08, 0.012), at + [0, 0, 0.008])], metal))
        lean = np.array([0, s * 0.7, 0.7])
        truck = [
            box((0.7 * wide, 0.03, 0.025), at + [0, 0, -0.03]),
            rod(at, at - 0.045 * lean, 0.012),  # the kingpin, about which it steers
            lying(0.006, wide, X, 8) + at + [0, 0, -0.035],
        ]
        steers = hinge(at, lean, 0.25, -0.25)
        parent = whole.add("truck", steers, surface(truck, metal), name=f"{name}_truck")
        for side, t in (("left", -1), ("right", 1)):
            hub = at + [t * 0.45 * wide, 0, -0.035]
            whole.add(
                "wheel",
                spin(hub, RIGHT),
                surface([lying(radius, 0.035, X, 16) + hub], rubber),
                parent=parent,
                name=f"{name}_{side}_wheel",
            )
    return whole.bodies()


def _toy_train(dice: Dice) -> list[Body]:
    """An engine and wagons on hinged couplings."""
    width, radius = dice.between(0.05, 0.09), dice.between(0.014, 0.024)
    long, deck = dice.between(0.12, 0.18), 0.012
    level, wood = radius + 0.004, looks.wood(dice)
    x, y = width / 2, long / 2
    boiler = lying(0.38 * width, 0.6 * long, 1, 16) + [0, -0.15 * long, level + deck + 0.38 * width]
    cab = [
        box((0.9 * width, 0.25 * long, 1.1 * width), (0, 0.36 * long, level + deck + 0.55 * width)),
        box((1.1 * width, 0.32 * long, 0.01), (0, 0.36 * long, level + deck + 1.1 * width)),
    ]
    stack = revolve(np.array([[0, 0], [0.12, 0], [0.1, 0.4], [0.2, 0.6], [0, 0.6]]) * width, 12) + [
        0,
        -0.33 * long,
        level + deck + 0.7 * width,
    ]
    whole = Rig(
        surface([box((width, long, deck), (0, 0, level + deck / 2))], wood),
        surface([boiler, stack], looks.plastic(dice)),
        surface(cab, looks.plastic(dice)),
        label="engine",
    )
    form, rubber = _thin_wheel(dice, radius, 0.008), looks.plastic(dice)
    parent = 0
    for number in range(dice.whole(0, 3) + 1):
        shift = number * (long + 0.03)
        if number:
            pin = np.array([0, shift - y - 0.015, level + deck / 2])
            bar = box((0.012, 0.03, 0.005), pin)
            load = (
                superquadric((0.85 * width, 0.85 * long, dice.between(0.5, 1.2) * width), 0.3, 0.3, 6)
                if dice.chance(0.5)
                else lying(0.4 * width, 0.8 * long, 1, 14)
            )
            high = float(np.ptp(load[..., 2]))
            pieces = [box((width, long, deck), (0, shift, level + deck / 2)), bar]
            parent = whole.add(
                "wagon",
                hinge(pin, UP, 0.5, -0.5),
                surface(pieces, wood),
                surface([load + [0, shift, level + deck + high / 2]], looks.plastic(dice)),
                parent=parent,
            )
        for spot in (-0.32 * long, 0.32 * long):
            hub = np.array([0, shift + spot, radius])
            axle = [lying(0.003, width + 0.012, X, 6) + hub]
            pair = [p + hub + [s * (x + 0.006), 0, 0] for p in form for s in (-1, 1)]
            whole.add(
                "wheel set",
                spin(hub, RIGHT),
                surface(axle, looks.metal(dice)),
                surface(pair, rubber),
                parent=parent,
            )
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("bicycle", _bicycle),
    Category("scooter", _scooter),
    Category("skateboard", _skateboard),
    Category("toy_train", _toy_train),
)
