"""What stands in yards: lawn mowers, concrete mixers and reels for hoses."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, loft, revolve, rod, torus, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK, handwheel, sideways, sleeve
from .objects import Body, Look, hinge, spin
from .rigging import LEFT, RIGHT, UP, axle_wheel, lying


def _deck(kit: Assembly, wide: float, long: float, high: float, coat: Look) -> None:
    """What covers a mower's blade, with the motor on it."""
    skin = rounded(0.3, wide / long, 4)
    stages = [(0, 0, 0.06), (wide, long, 0.06), (wide, long, high), (0.8 * wide, 0.8 * long, high + 0.03)]
    kit.fix([loft(skin, [*stages, (0, 0, high + 0.03)])], coat)
    motor = [
        cylinder(0.11, 0.12, 20) + [0, -0.1 * long, high + 0.09],
        box((0.12, 0.14, 0.05), (0, -0.1 * long, high + 0.17)),
    ]
    kit.fix(motor, DARK)


def _mower_wheels(dice: Dice, kit: Assembly, wide: float, long: float) -> None:
    """Four wheels beside a deck, each on an axle."""
    front, back = dice.between(0.08, 0.11), dice.between(0.09, 0.14)
    for name, y, r in (("front", -1, front), ("rear", 1, back)):
        for s in (-1, 1):
            hub = np.array([s * (wide / 2 + 0.05), y * (long / 2 - r - 0.02), r])
            kit.fix([lying(0.012, 0.1) + [s * (wide / 2 - 0.02), hub[1], hub[2]]], looks.metal(dice))
            roll = [lying(r, 0.045, X, 20), lying(0.5 * r, 0.05)]
            side = "left" if s < 0 else "right"
            kit.add("wheel", spin(hub, RIGHT), [(moved(roll, hub), DARK)], name=f"{side}_{name}_wheel")


def _handle(dice: Dice, kit: Assembly, half: float, pin: FloatArray) -> None:
    """Bars that fold about a pin, mostly with a lever."""
    yaw = rotation(RIGHT, -dice.between(0.7, 0.9))
    kit.fix(
        [box((0.012, 0.06, 0.07), (s * half, pin[1], pin[2] - 0.015)) for s in (-1, 1)], looks.metal(dice)
    )
    edge, inner = half + 0.016, half - 0.04
    path = [(-edge, 0, 0), (-edge, 0, 0.9), (-inner, 0, 1.0), (inner, 0, 1.0), (edge, 0, 0.9), (edge, 0, 0)]
    bars = [
        tube(path, 0.011, 8),
        rod((-half - 0.01, 0, 0.6), (half + 0.01, 0, 0.6), 0.009),
        *at(lying(0.016, 0.012), [(s * edge, 0, 0) for s in (-1, 1)]),
    ]
    fold = hinge(pin, RIGHT, dice.between(0.2, 0.5), -0.1)
    number = kit.add("handle", fold, [(moved(turned(bars, yaw), pin), looks.metal(dice))])
    if dice.chance(0.7):
        _lever(kit, half, pin, yaw, number)


def _lever(kit: Assembly, half: float, pin: FloatArray, yaw: FloatArray, handle: int) -> None:
    """A bow at the top of a mower's handle, to be held while it runs."""
    spot = pin + yaw @ np.array([0, -0.016, 0.9])
    path = [(-half + 0.01, 0, 0), (-half + 0.06, 0, 0.08), (half - 0.06, 0, 0.08), (half - 0.01, 0, 0)]
    bow = moved(turned([tube(path, 0.005, 6)], yaw), spot - yaw @ np.array([0, 0.014, 0.0]))
    kit.add("lever", hinge(spot, LEFT, 0.15, -0.4), [(bow, DARK)], handle)


def _lawn_mower(dice: Dice) -> list[Body]:
    """A deck on four wheels with a motor, bars that fold, a lever at them, a flap behind and a cap."""
    kit, coat = Assembly("deck"), looks.painted_metal(dice) if dice.chance(0.6) else looks.plastic(dice)
    wide, long, high = dice.between(0.42, 0.55), dice.between(0.6, 0.75), dice.between(0.14, 0.18)
    _deck(kit, wide, long, high, coat)
    _mower_wheels(dice, kit, wide, long)
    _handle(dice, kit, 0.4 * wide, np.array([0, long / 2 - 0.03, high + 0.06]))
    edge = (0, long / 2 + 0.008, high)
    flap = [box((0.75 * wide, 0.01, 0.16), (0, 0.004, -0.075)), lying(0.008, 0.75 * wide)]
    lean_back = rotation(RIGHT, dice.between(0.2, 0.5))
    kit.add("flap", hinge(edge, RIGHT, 0.9), [(moved(turned(flap, lean_back), edge), DARK)])
    if dice.chance(0.6):
        cap = [cylinder(0.02, 0.02, 14) + [0, 0, 0.011], box((0.03, 0.006, 0.006), (0, 0, 0.023))]
        spot = np.array([0.25 * wide, -0.1 * long, high + 0.03]) + [0, -0.16 * long, 0]
        kit.add("cap", spin(spot, UP), [(moved(cap, spot), DARK)])
    return kit.done()


def _stand(dice: Dice, kit: Assembly, wide: float, high: float, coat: Look, metal: Look) -> None:
    """Legs to both sides of a mixer's drum, with bearings at their tops and a wheel each."""
    for s in (-1, 1):
        x = s * wide / 2
        feet = [(x, t * 0.35, 0.06 if t < 0 else 0.1) for t in (-1, 1)]
        kit.fix([rod((x, 0, high - 0.035), foot, 0.022, 8) for foot in feet], coat)
        kit.fix([pointed(sleeve(0.021, 0.038, 0.05), X) + [x - 0.025, 0, high]], coat)
        hub = np.array([s * (wide / 2 + 0.06), 0.35, 0.16])
        kit.fix([lying(0.014, 0.1) + [s * (wide / 2), 0.35, 0.16]], metal)
        wheel = moved(axle_wheel(dice, 0.16), hub)
        kit.add("wheel", spin(hub, RIGHT), [(wheel, DARK)], name="left_wheel" if s < 0 else "right_wheel")
    kit.fix([box((wide, 0.04, 0.04), (0, t * 0.35, 0.07 if t < 0 else 0.11)) for t in (-1, 1)], coat)


def _yoke(half: float, radius: float) -> Pieces:
    """A bow under a drum, with pins to both sides and a bearing in its middle."""
    side, drop, low = half - 0.06, -0.7 * radius, -radius - 0.1
    path = [(-side, 0, 0), (-side, 0, drop), (-0.2, 0, low), (0.2, 0, low), (side, 0, drop), (side, 0, 0)]
    pins = [lying(0.02, 0.16) + [s * half, 0, 0] for s in (-1, 1)]
    return [*pins, tube(path, 0.022, 8), cylinder(0.05, 0.07) - [0, 0, radius + 0.09]]


def _drum(radius: float) -> Pieces:
    """A vessel about z with a narrow mouth, paddles in it and a rim of teeth about it."""
    top = radius + 0.05
    outside = [(0, -top), (0.6, -top), (1.0, -0.4 * radius), (1.0, 0.3 * radius), (0.62, top), (0.6, top)]
    inside = [(0.96, 0.3 * radius), (0.96, -0.35 * radius), (0.55, -radius - 0.03), (0, -radius - 0.03)]
    drum = [revolve(np.array(outside + inside) * [radius, 1], 28), torus(1.03 * radius, 0.018, 28)]
    drum += around([box((0.02, 0.12, 0.3 * radius), (0.78 * radius, 0, 0))], 3)
    return [*drum, torus(0.62 * radius, 0.012, 24) + [0, 0, top]]


def _motor(kit: Assembly, low: FloatArray, coat: Look) -> None:
    """A box with a motor, and its cover, a door."""
    kit.fix([box((0.14, 0.2, 0.26), low), box((0.06, 0.05, 0.1), low + [0.08, 0.06, -0.05])], DARK)
    door = [
        box((0.012, 0.19, 0.25), low + [-0.0775, 0, 0]),
        box((0.02, 0.03, 0.03), low + [-0.09, -0.07, 0]),
    ]
    kit.add("cover", hinge(low + [-0.0775, 0.1, 0], (0, 0, -1), 1.8), [(door, coat)])


def _concrete_mixer(dice: Dice) -> list[Body]:
    """A drum that turns in a yoke, which a large wheel tips, on a stand with two wheels and a motor's box."""
    kit, coat, metal = Assembly("stand"), looks.painted_metal(dice), looks.metal(dice)
    wide, high, radius = dice.between(0.6, 0.8), dice.between(0.75, 0.95), dice.between(0.26, 0.33)
    wide = max(wide, 2 * radius + 0.16)
    _stand(dice, kit, wide, high, coat, metal)
    pin, tilt = np.array([0, 0, high]), dice.between(0.2, 0.7)
    yaw = rotation(LEFT, -tilt)
    half = wide / 2
    tip = hinge(pin, RIGHT, dice.between(0.8, 1.2), -0.9)
    number = kit.add("yoke", tip, [(moved(turned(_yoke(half, radius), yaw), pin), coat)])
    drum = moved(turned(_drum(radius), yaw), pin)
    kit.add("drum", spin(pin, yaw @ np.array(UP)), [(drum, looks.painted_metal(dice))], number)
    wheel = sideways(handwheel(dice, dice.between(0.18, 0.26)), 1)
    kit.fix(moved(wheel, pin + [half + 0.08, 0, 0]), metal, number)
    if dice.chance(0.7):
        _motor(kit, np.array([-half - 0.09, -0.06, 0.45 * high]), coat)
    return kit.done()


def _reel_cart(kit: Assembly, hub: FloatArray, gap: float, radius: float, look: Look) -> None:
    """Two bent legs to both sides of a reel, with a wheel each, and bars across."""
    top = hub[2] + radius + 0.3
    for s in (-1, 1):
        x = s * gap
        leg = tube([(x, -0.25, 0.0), (x, 0.0, hub[2]), (x, 0.25, top)], 0.013, 8)
        kit.fix([leg, rod((x, 0, hub[2]), (x, 0.22, 0.13), 0.012)], look)
        kit.fix([lying(0.03, 0.02) + hub + [x, 0, 0]], look)
        spot = np.array([s * (gap + 0.045), 0.22, 0.11])
        wheel = [lying(0.11, 0.04, X, 20) + spot, lying(0.03, 0.05) + spot]
        kit.add("wheel", spin(spot, RIGHT), [(wheel, DARK)], name="left_wheel" if s < 0 else "right_wheel")
    bars = [
        lying(0.008, 2 * gap + 0.14) + [0, 0.22, 0.11],
        lying(0.012, 2 * gap) + [0, 0.25, top],
        lying(0.012, 2 * gap) + [0, -0.25, 0.012],
    ]
    kit.fix(bars, look)


def _reel_bracket(kit: Assembly, hub: FloatArray, gap: float, radius: float, look: Look) -> int:
    """A plate for a wall, and a fork that swings on it; gives the fork's number."""
    pin = np.array([0, radius + 0.08, hub[2]])
    y = pin[1]
    lugs = [box((0.06, 0.05, 0.02), (0, y + 0.025, hub[2] + t * 0.09)) for t in (-1, 1)]
    kit.fix([box((0.2, 0.02, 0.3), (0, y + 0.05, hub[2])), *lugs], look)
    fork = [
        box((2 * gap + 0.02, 0.03, 0.05), (0, y, hub[2])),
        cylinder(0.012, 0.15) + pin,
        *[box((0.015, y, 0.05), (s * gap, y / 2, hub[2])) for s in (-1, 1)],
        *[lying(0.03, 0.02) + hub + [s * gap, 0, 0] for s in (-1, 1)],
    ]
    return kit.add("bracket", hinge(pin, UP, 1.2, -1.2), [(fork, look)])


def _hose(radius: float, wide: float) -> Pieces:
    """Turns of a hose, side by side about x."""
    turn = pointed(torus(radius, 0.012, 24), X)
    return [turn + [x, 0, 0] for x in np.arange(-0.42 * wide, 0.42 * wide, 0.027)]


def _hose_reel(dice: Dice) -> list[Body]:
    """A drum with a crank in a frame, on wheels or on a wall's bracket that swings."""
    kit, look = Assembly("frame"), looks.metal(dice) if dice.chance(0.5) else looks.plastic(dice)
    radius, wide = dice.between(0.16, 0.24), dice.between(0.22, 0.36)
    cart = dice.chance(0.5)
    hub = np.array([0, 0, radius + (0.25 if cart else 0.06)])
    gap = wide / 2 + 0.03
    number = 0
    if cart:
        _reel_cart(kit, hub, gap, radius, look)
    else:
        number = _reel_bracket(kit, hub, gap, radius, look)
    drum = [lying(0.55 * radius, wide, X, 24), lying(0.012, 2 * gap + 0.05)]
    drum += [lying(radius, 0.008, X, 28) + [s * wide / 2, 0, 0] for s in (-1, 1)]
    hose = _hose(0.55 * radius + 0.014, wide) if dice.chance(0.7) else []
    reach, start = 0.6 * radius, rotation(RIGHT, dice.between(0, 6.28))
    arm = box((0.012, 0.02, reach), (gap + 0.025, 0, reach / 2))
    crank = turned([arm, lying(0.011, 0.08) + [gap + 0.07, 0, reach]], start)
    kit.add(
        "drum",
        spin(hub, RIGHT),
        [(moved(drum, hub), look), (moved(hose, hub), looks.rubber(dice)), (moved(crank, hub), DARK)],
        number,
    )
    return kit.done()


CATEGORIES = (
    Category("lawn_mower", _lawn_mower),
    Category("concrete_mixer", _concrete_mixer),
    Category("hose_reel", _hose_reel),
)
