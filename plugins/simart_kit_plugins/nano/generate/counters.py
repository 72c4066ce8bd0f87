"""What stands in shops and stations: cash machines, payphones, cash boxes, water coolers and food carts."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import Y, at, moved, pointed, rotation, turned
from ...shapes.primitives import between, box, cylinder, loft, open_box, revolve, rod, tube
from . import looks
from .assembling import Assembly, disc, holder, press, shell, swing, turning
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import BACK, FRONT, LEFT, RIGHT, axle_wheel, lying


def _keys(
    dice: Dice, kit: Assembly, spot: FloatArray, size: float, turn: FloatArray, count: int = 12
) -> None:
    """Rows of three keys before a plate, which faces -y before it is turned."""
    plate = box((4.2 * size, 0.006, (count // 3 + 0.6) * 1.3 * size), (0, -0.003, 0))
    kit.fix(moved(turned([plate], turn), spot), DARK)
    look = looks.metal(dice) if dice.chance(0.5) else looks.plastic(dice)
    for k in range(count):
        place = np.array([(k % 3 - 1) * 1.3 * size, -0.0065, ((count // 3 - 1) / 2 - k // 3) * 1.3 * size])
        cap = [box((size, 0.005, size), place - [0, 0.0025, 0])]
        kit.add("key", slide(turn @ np.array(BACK), 0.002), [(moved(turned(cap, turn), spot), look)])


def _cash_machine(dice: Dice) -> list[Body]:
    """A cabinet with a screen, keys on a ledge, slots, and a door below for who fills it."""
    kit, coat = Assembly("cabinet"), looks.painted_metal(dice)
    wide, deep, high = dice.between(0.5, 0.7), dice.between(0.5, 0.7), dice.between(1.3, 1.6)
    ledge = dice.between(0.9, 1.0)
    kit.fix(
        [
            between((-wide / 2, 0, ledge), (wide / 2, deep / 2, high)),
            shell(wide, deep, ledge - 0.06, 0.02),
            box((wide, deep, 0.06), (0, 0, ledge - 0.03)),
        ],
        coat,
    )
    kit.fix([box((0.35, 0.01, 0.26), (0, -0.004, ledge + 0.25))], looks.glass(dice))
    slot = box((0.14, 0.012, 0.02), (0.3 * wide, -0.006, ledge + 0.1))
    kit.fix([slot, box((0.2, 0.012, 0.025), (-0.15 * wide, -0.006, ledge + 0.06))], DARK)
    tip = rotation(RIGHT, -dice.between(0.9, 1.4))
    _keys(dice, kit, np.array([0.1 * wide, -0.2 * deep, ledge + 0.035]), 0.024, tip)
    kit.fix([box((0.14, 0.13, 0.03), (0.1 * wide, -0.2 * deep, ledge + 0.012))], coat)
    for s in (-1, 1):
        for k in range(dice.pick((0, 3, 3))):
            spot = np.array([s * 0.205, -0.0005, ledge + 0.18 + 0.07 * k])
            kit.fix([box((0.03, 0.012, 0.03), spot - [0, -0.002, 0])], DARK)
            kit.add("button", press(0.002), [([box((0.02, 0.005, 0.02), spot - [0, 0.007, 0])], coat)])
    side = dice.sign()
    face = -deep / 2 - 0.011
    leaf = [box((wide - 0.006, 0.02, ledge - 0.07), (0, face, (ledge - 0.06) / 2))]
    leaf += [box((0.03, 0.014, 0.1), (-side * (wide / 2 - 0.06), face - 0.016, 0.6 * ledge))]
    kit.add("door", swing(side, side * (wide / 2 - 0.003), face, dice.between(1.5, 2.0)), [(leaf, coat)])
    return kit.done()


def _payphone(dice: Dice) -> list[Body]:
    """A box on a wall or a post with keys, a handset in its cradle, a flap and at times a hook."""
    kit, coat = Assembly("case"), looks.painted_metal(dice)
    wide, deep, high = dice.between(0.24, 0.3), dice.between(0.12, 0.16), dice.between(0.4, 0.5)
    foot = dice.pick((0.0, 1.0))
    kit.fix([box((wide, deep, high), (0, 0, foot + high / 2))], coat)
    if foot:
        kit.fix([cylinder(0.05, foot, 16) + [0, 0, foot / 2], cylinder(0.18, 0.02, 20) + [0, 0, 0.01]], coat)
    face, z = -deep / 2, foot + 0.5 * high
    _keys(dice, kit, np.array([0.12 * wide, face, z + 0.02]), 0.02, np.eye(3))
    hang = np.array([-0.32 * wide, face - 0.03, z + 0.1 * high])
    kit.fix([box((0.03, 0.03, 0.025), hang + [0, 0.012, s * 0.05]) for s in (-1, 1)], DARK)
    ends = [cylinder(0.026, 0.03, 16) + [0, -0.01, s * 0.085] for s in (-1, 1)]
    phone = [box((0.028, 0.022, 0.2), (0, -0.018, 0)), *ends]
    kit.add("handset", free(), [(moved(phone, hang), DARK)])
    if dice.chance(0.6):
        pin = hang + [0.045, 0.029, 0.06]
        hook = moved([box((0.012, 0.05, 0.012), (0, -0.028, 0)), lying(0.008, 0.02)], pin)
        kit.add("hook", hinge(pin, RIGHT, 0.3, -0.1), [(hook, looks.metal(dice))])
    pin = np.array([0.25 * wide, face - 0.005, foot + 0.2 * high])
    kit.fix([box((0.07, 0.004, 0.07), pin + [0, 0.004, -0.02])], DARK)
    flap = moved([box((0.06, 0.006, 0.055), (0, -0.003, -0.026)), lying(0.003, 0.06)], pin)
    motion = hinge(pin, LEFT, 0.3, -1.0) if dice.chance(0.3) else hinge(pin, LEFT, 1.3)
    kit.add("flap", motion, [(flap, looks.metal(dice))])
    screen = box((0.4 * wide, 0.01, 0.06), (0.12 * wide, face - 0.003, foot + 0.85 * high))
    kit.fix([screen], looks.glass(dice))
    if dice.chance(0.5):
        spot = np.array([0.35 * wide, face - 0.0005, foot + 0.35 * high])
        kit.add("button", press(0.004), [([disc(0.014, 0.008, 14) + spot], looks.metal(dice))])
    return kit.done()


def _cash_box(dice: Dice) -> list[Body]:
    """A flat steel box with a lid, a bow on it, a lock, at times with a key, and a divided tray inside."""
    kit, coat = Assembly("box"), looks.painted_metal(dice)
    wide, deep, high = dice.between(0.2, 0.36), dice.between(0.15, 0.25), dice.between(0.05, 0.08)
    kit.fix([open_box((wide, deep, high), 0.002)], coat)
    tray = [open_box((wide - 0.01, deep - 0.01, 0.03), 0.002) + [0, 0, high - 0.034]]
    tray += [box((0.002, deep - 0.014, 0.024), (x * wide, 0, high - 0.02)) for x in (-0.25, 0.0, 0.25)]
    kit.add("tray", free(), [(tray, looks.plastic(dice))])
    rise, pin = dice.between(0.012, 0.03), np.array([0, deep / 2 + 0.004, high + 0.002])
    lid = turned([open_box((wide + 0.002, deep + 0.002, rise), 0.002)], rotation(RIGHT, np.pi))
    lid = moved(lid, (0, 0, high + 0.0012 + rise))
    number = kit.add("lid", hinge(pin, LEFT, dice.between(1.5, 1.8)), [(lid, coat)])
    top, half = high + rise + 0.0015, 0.2 * wide
    ears = np.array([0, 0.02, top + 0.006])
    posts = [box((0.012, 0.012, 0.012), ears + [s * (half + 0.007), 0, -0.001]) for s in (-1, 1)]
    kit.fix(posts, DARK, number)
    bow = [tube(np.array([(-half, 0, 0), (-half, -0.045, 0), (half, -0.045, 0), (half, 0, 0)]), 0.003, 6)]
    kit.add("handle", hinge(ears, LEFT, 1.6), [(moved(bow, ears), looks.metal(dice))], number)
    spot = np.array([0, -deep / 2 - 0.0015, 0.6 * high])
    kit.fix([disc(0.013, 0.003, 16) + spot], looks.metal(dice))
    if dice.chance(0.6):
        key = [disc(0.004, 0.012, 8), box((0.004, 0.016, 0.022), (0, -0.018, 0))]
        pin = spot - [0, 0.0035, 0]
        kit.add("key", turning(dice, pin), [(moved(key, pin), looks.metal(dice))])
    return kit.done()


def _cooler_bottle(kit: Assembly, radius: float, high: float) -> None:
    """A bottle that stands on its neck."""
    r = radius
    line = [(0, 0.002), (0.25 * r, 0.002), (0.25 * r, 0.04), (r, 0.1), (r, 0.38), (0.9 * r, 0.4), (0, 0.4)]
    bottle = moved([revolve(line, 24)], (0, 0.02, high))
    kit.add("bottle", free(), [(bottle, Look("glass", (150, 190, 225)))])


def _cooler_taps(dice: Dice, kit: Assembly, y: float, z: float) -> None:
    """Two or three taps, each with a lever in its color."""
    places = dice.pick(((-0.06, 0.06), (-0.07, 0.0, 0.07)))
    colors = ((40, 80, 190), (200, 50, 40), (240, 240, 240))
    for x, color in zip(places, colors, strict=False):
        spot = np.array([x, y, z])
        pipe = pointed(cylinder(0.012, 0.05), Y) + spot - [0, 0.01, 0]
        kit.fix([pipe, cylinder(0.01, 0.04) + spot - [0, 0.035, 0.015]], DARK)
        pin = spot + [0, -0.035, 0.0175]
        lever = [box((0.02, 0.05, 0.006), (0, -0.012, 0.004)), lying(0.004, 0.02)]
        kit.add("lever", hinge(pin, RIGHT, 0.35), [(moved(lever, pin), Look("plastic", color))])


def _water_cooler(dice: Dice) -> list[Body]:
    """A cabinet with taps and a door below, at times a bottle on top and a tray."""
    kit, coat = Assembly("cabinet"), looks.plastic(dice)
    wide, deep, high = dice.between(0.28, 0.34), dice.between(0.3, 0.36), dice.between(0.9, 1.05)
    cabinet = [
        shell(wide, deep, 0.6 * high, 0.02),
        between((-wide / 2, -deep / 2 + 0.1, 0.6 * high), (wide / 2, deep / 2, high)),
        between((-wide / 2, -deep / 2, 0.88 * high), (wide / 2, -deep / 2 + 0.1, high)),
    ]
    kit.fix(cabinet, coat)
    kit.fix([box((0.9 * wide, 0.1, 0.02), (0, -deep / 2 + 0.05, 0.6 * high + 0.01))], DARK)
    if dice.chance(0.75):
        _cooler_bottle(kit, 0.42 * wide, high)
    _cooler_taps(dice, kit, -deep / 2 + 0.09, 0.78 * high)
    face, side = -deep / 2 - 0.009, dice.sign()
    leaf = [
        box((wide - 0.006, 0.016, 0.58 * high), (0, face, 0.3 * high)),
        box((0.014, 0.014, 0.1), (-side * 0.4 * wide, face - 0.014, 0.45 * high)),
    ]
    kit.add("door", swing(side, side * (wide / 2 - 0.003), face, 1.7), [(leaf, coat)])
    if dice.chance(0.5):
        spots = [(0, -deep / 2 + 0.015 + 0.015 * k, 0.6 * high + 0.034) for k in range(5)]
        tray = [box((0.8 * wide, 0.09, 0.012), (0, -deep / 2 + 0.046, 0.6 * high + 0.0265))]
        tray += at(box((0.75 * wide, 0.006, 0.003)), spots)
        kit.add("tray", slide(FRONT, 0.06), [(tray, looks.metal(dice))])
    return kit.done()


def _cart_lids(dice: Dice, kit: Assembly, metal: Look, wide: float, deep: float, top: float) -> None:
    """One to three lids in a row, each with a handle, that open back."""
    count = dice.whole(1, 3)
    span = 0.94 * wide / count
    for k in range(count):
        x = (k - (count - 1) / 2) * span
        grip = turned(holder(dice, 0.12), rotation(RIGHT, -np.pi / 2))
        lid = [box((span - 0.03, 0.7 * deep, 0.012), (x, 0.0, top + 0.008))]
        lid += moved(grip, (x, -0.25 * deep, top + 0.0145))
        kit.add("lid", hinge((x, 0.35 * deep, top + 0.015), LEFT, 1.5), [(lid, metal)])


def _cart_wheels(dice: Dice, kit: Assembly, metal: Look, wide: float, low: float) -> None:
    """A large wheel on an axle and a post at both sides."""
    radius = dice.between(0.24, 0.3)
    for s in (-1, 1):
        hub = np.array([s * (wide / 2 + 0.06), 0.1, radius])
        post = box((0.03, 0.1, low - radius + 0.1), (s * (wide / 2 - 0.02), 0.1, (low + radius) / 2))
        kit.fix([lying(0.015, 0.1) + [s * wide / 2, 0.1, radius], post], metal)
        name = "left_wheel" if s < 0 else "right_wheel"
        kit.add("wheel", spin(hub, RIGHT), [(moved(axle_wheel(dice, radius), hub), DARK)], name=name)


def _cart_frame(kit: Assembly, metal: Look, wide: float, deep: float, low: float, top: float) -> None:
    """Two legs in front, and a bar at the right to push by."""
    kit.fix(at(box((0.04, 0.04, low)), [(s * 0.4 * wide, -0.4 * deep, low / 2) for s in (-1, 1)]), metal)
    near, far = wide / 2 - 0.01, wide / 2 + 0.35
    arms = [rod((near, s * 0.25, top - 0.1), (far, s * 0.25, top - 0.05), 0.014, 8) for s in (-1, 1)]
    kit.fix([*arms, pointed(cylinder(0.016, 0.52), Y) + [far, 0, top - 0.05]], metal)


def _canopy(dice: Dice, kit: Assembly, metal: Look, wide: float, deep: float, top: float) -> None:
    """A pointed roof of cloth on four posts."""
    spots = [(s * 0.45 * wide, t * 0.42 * deep, top) for s in (-1, 1) for t in (-1, 1)]
    kit.fix(at(rod((0, 0, 0), (0, 0, 1.0), 0.012, 8), spots), metal)
    square = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    stages = [(0, 0, top + 1.25), (1.1 * wide, 1.2 * deep, top + 1.0), (0, 0, top + 1.0)]
    kit.fix([loft(square, stages)], looks.fabric(dice))


def _cart_doors(dice: Dice, kit: Assembly, coat: Look, size: tuple[float, float, float], low: float) -> None:
    """Two doors in front, each with an upright handle."""
    wide, deep, high = size
    face = -deep / 2 - 0.009
    for s in (-1, 1):
        leaf = [box((wide / 2 - 0.005, 0.016, high - 0.01), (s * wide / 4, face, low + high / 2))]
        leaf += moved(holder(dice, 0.12, True), (s * 0.06, face - 0.008, low + 0.6 * high))
        motion = swing(s, s * (wide / 2 - 0.003), face, 1.8)
        kit.add("door", motion, [(leaf, coat)], name="left_door" if s < 0 else "right_door")


def _food_cart(dice: Dice) -> list[Body]:
    """A box on two large wheels with lids on top and doors, at times a canopy and a shelf that folds."""
    kit, coat, metal = Assembly("cart"), looks.painted_metal(dice), looks.metal(dice)
    wide, deep, high, low = dice.between(1.0, 1.5), dice.between(0.55, 0.75), dice.between(0.55, 0.65), 0.3
    top = low + high
    kit.fix([shell(wide, deep, high, 0.02) + [0, 0, low]], coat)
    _cart_lids(dice, kit, metal, wide, deep, top)
    _cart_wheels(dice, kit, metal, wide, low)
    _cart_frame(kit, metal, wide, deep, low, top)
    if dice.chance(0.7):
        _canopy(dice, kit, metal, wide, deep, top)
    _cart_doors(dice, kit, coat, (wide, deep, high), low)
    if dice.chance(0.6):
        pin = np.array([-wide / 2 - 0.012, 0, top - 0.03])
        board = [box((0.3, 0.8 * deep, 0.018), (-0.158, 0, 0)), pointed(cylinder(0.008, 0.8 * deep), Y)]
        kit.add("shelf", hinge(pin, FRONT, 1.5), [(moved(board, pin), looks.wood(dice))])
    return kit.done()


CATEGORIES = (
    Category("cash_machine", _cash_machine),
    Category("payphone", _payphone),
    Category("cash_box", _cash_box),
    Category("water_cooler", _water_cooler),
    Category("food_cart", _food_cart),
)
