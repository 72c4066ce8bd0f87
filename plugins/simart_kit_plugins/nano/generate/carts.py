"""What is pushed by hand: carts, trolleys and barrows."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import slab
from ...shapes.handles import handle
from ...shapes.placing import X, at, corners, moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, loft, open_box, rod, tube
from . import looks
from .category import Category
from .objects import Body, Look, hinge, slide, spin, surface
from .rigging import (
    FRONT,
    LEFT,
    RIGHT,
    UP,
    Rig,
    axle_wheel,
    caster_hub,
    caster_wheel,
    fork,
    lying,
)


def casters(dice: Dice, whole: Rig, spots: FloatArray, radius: float, fixed: int = 0) -> None:
    """Casters below these spots of the root; the last `fixed` ones do not swivel."""
    metal, rubber = looks.metal(dice), looks.rubber(dice)
    wide = radius * dice.between(0.4, 0.9)
    brake = dice.chance(0.3)
    for number, spot in enumerate(spots, 1):
        swivels = number <= len(spots) - fixed
        yaw = rotation(UP, dice.between(-0.8, 0.8)) if swivels else np.eye(3)
        holder = surface(moved(turned(fork(radius, wide), yaw), spot), metal)
        hub = yaw @ caster_hub(radius) + spot
        parent = 0
        if swivels:
            parent = whole.add("caster", spin(spot, UP), holder, name=f"caster_{number}")
        else:
            whole.dress(0, holder)
        roll = surface(moved(turned(caster_wheel(radius, wide), yaw), hub), rubber)
        whole.add("wheel", spin(hub, yaw @ RIGHT), roll, parent=parent, name=f"wheel_{number}")
        if brake and swivels:
            pin = spot + yaw @ np.array([0, 0.75 * radius, -0.2 * radius])
            pedal = box((wide, 0.8 * radius, 0.12 * radius), (0, 0.4 * radius, 0))
            flap = surface(moved(turned([pedal], yaw @ rotation(RIGHT, -0.2)), pin), looks.plastic(dice))
            whole.add("brake pedal", hinge(pin, yaw @ LEFT, 0.4), flap, parent=parent)


def _drawer(dice: Dice, size: tuple[float, float, float], look: Look, metal: Look) -> tuple[Pieces, Pieces]:
    """Front with box behind y = 0, and its handle; middle of the front at 0."""
    width, depth, high = size
    panel = slab(dice, width, high, 0.014)
    inner = open_box((width - 0.03, 0.9 * depth, 0.75 * high), 0.006) + [0, 0.45 * depth, -0.45 * high]
    return [*panel, inner], moved(handle(dice, min(0.14, 0.4 * width)), (0, -0.014, 0.1 * high))


def _cart(dice: Dice) -> list[Body]:
    width, depth, height = dice.between(0.4, 0.9), dice.between(0.35, 0.6), dice.between(0.45, 0.95)
    post, look, metal = dice.between(0.014, 0.03), looks.painted_metal(dice), looks.metal(dice)
    closed = dice.chance(0.45)
    level = np.linspace(0, height, dice.whole(2, 4))
    if closed:
        # A tool chest: shell open to the front.
        shell = [between((-width / 2, depth / 2 - 0.01, 0), (width / 2, depth / 2, height))]
        shell += [box((0.015, depth, height), (s * (width / 2 - 0.0075), 0, height / 2)) for s in (-1, 1)]
        shell += [box((width, depth, 0.018), (0, 0, z)) for z in (0.009, height)]
    else:
        shell = at(box((post, post, height), (0, 0, height / 2)), corners(width - post, depth - post))
        trays = [
            open_box((width, depth, 0.05), 0.008)
            if dice.chance(0.5)
            else box((width, depth, 0.02), (0, 0, 0.01))
        ]
        shell += [tray + [0, 0, z] for tray in trays for z in level]
    whole = Rig(surface(shell, look), label="frame")
    x = width / 2
    if dice.chance(0.7):
        loop = [
            (x, -0.4 * depth, height),
            (x + 0.1, -0.4 * depth, height + 0.08),
            (x + 0.1, 0.4 * depth, height + 0.08),
            (x, 0.4 * depth, height),
        ]
        whole.dress(0, surface([tube(np.array(loop), 0.012)], metal))
    if closed:
        count = dice.whole(1, 6)
        pitch = (height - 0.03) / count
        for k in range(count):
            size = (width - 0.036, depth - 0.04, pitch - 0.006)
            body, pull = _drawer(dice, size, look, metal)
            spot = (0, -depth / 2 + 0.014, 0.02 + (k + 0.5) * pitch)
            parts = (surface(moved(body, spot), look), surface(moved(pull, spot), metal))
            whole.add("drawer", slide(FRONT, 0.75 * depth), *parts, name=f"drawer_{k + 1}")
    elif dice.chance(0.4):
        body, pull = _drawer(dice, (width - 2 * post - 0.01, depth - 0.05, 0.09), look, metal)
        spot = (0, -depth / 2 + 0.005, height - 0.055)
        whole.add(
            "drawer",
            slide(FRONT, 0.6 * depth),
            surface(moved(body, spot), look),
            surface(moved(pull, spot), metal),
        )
    if dice.chance(0.25):
        leaf = box((0.3, depth, 0.02), (-x - 0.155, 0, height))
        whole.add("side leaf", hinge((-x - 0.004, 0, height - 0.012), (0, -1, 0), 1.5), surface([leaf], look))
    radius = dice.between(0.03, 0.07)
    casters(dice, whole, corners(width * 0.88, depth * 0.85), radius, dice.pick((0, 0, 2)))
    return whole.bodies()


def _platform_trolley(dice: Dice) -> list[Body]:
    width, long, deck = dice.between(0.45, 0.7), dice.between(0.7, 1.1), dice.between(0.025, 0.05)
    look, metal, tall = looks.plastic(dice), looks.metal(dice), dice.between(0.65, 0.9)
    whole = Rig(surface([box((width, long, deck), (0, 0, deck / 2))], look), label="deck")
    x, y, level = width / 2 - 0.05, long / 2 - 0.04, deck + 0.025
    path = [
        (-x, y, level),
        (-x, y, level + tall - 0.06),
        (-x + 0.06, y, level + tall),
        (x - 0.06, y, level + tall),
        (x, y, level + tall - 0.06),
        (x, y, level),
    ]
    bars: Pieces = [tube(np.array(path), 0.014, 8)]
    bars += [
        rod((-x, y, level + t * tall), (x, y, level + t * tall), 0.009)
        for t in (0.35, 0.65)[: dice.whole(0, 2)]
    ]
    ears = boxes((0.04, 0.05, 0.05), [(s * (x + 0.036), y, deck + 0.025) for s in (-1, 1)])
    whole.dress(0, surface([ears], metal))
    whole.add("handle", hinge((0, y, level), RIGHT, 1.5), surface(bars, metal))
    casters(dice, whole, corners(width * 0.8, long * 0.8), dice.between(0.04, 0.07), 2)
    return whole.bodies()


def _hand_truck(dice: Dice) -> list[Body]:
    width, tall, radius = dice.between(0.32, 0.5), dice.between(0.9, 1.25), dice.between(0.07, 0.14)
    look, x = looks.painted_metal(dice), dice.between(0.12, 0.18)
    low = 0.02
    uprights = [rod((s * x, 0, low), (s * x, 0, tall), 0.014, 8) for s in (-1, 1)]
    rails = [
        rod((-x, 0, z * tall), (x, 0, z * tall), 0.01) for z in np.linspace(0.15, 0.75, dice.whole(2, 5))
    ]
    axle = lying(0.01, width, X, 8) + [0, 0.09, radius]
    stays = [rod((s * x, 0, 0.3 * tall), (s * x, 0.09, radius), 0.01) for s in (-1, 1)]
    whole = Rig(surface([*uprights, *rails, axle, *stays], look), label="frame")
    toe = box((width * 0.9, dice.between(0.18, 0.3), 0.008))
    plate_ = surface([toe + [0, -float(np.ptp(toe[..., 1])) / 2 - 0.016, low]], looks.metal(dice))
    whole.add("toe plate", hinge((0, -0.016, low), LEFT, 1.5), plate_)
    top = [
        (-x, 0.0, tall - 0.3),
        (-x, 0.0, tall + 0.05),
        (-x * 0.8, 0.05, tall + 0.12),
        (x * 0.8, 0.05, tall + 0.12),
        (x, 0.0, tall + 0.05),
        (x, 0.0, tall - 0.3),
    ]
    grip = surface([tube(np.array(top), 0.01, 8)], looks.rubber(dice))
    whole.add("handle", slide(UP, 0.25), grip)
    form = axle_wheel(dice, radius)
    half = max(float(np.abs(piece[..., 0]).max()) for piece in form)
    for name, s in (("left_wheel", -1), ("right_wheel", 1)):
        hub = np.array([s * (width / 2 + half + 0.004), 0.09, radius])
        parts = (
            surface(moved(form, hub), looks.rubber(dice)),
            surface([lying(0.4 * radius, 2 * half + 0.004) + hub], look),
        )
        whole.add("wheel", spin(hub, RIGHT), *parts, name=name)
    return whole.bodies()


def _wheelbarrow(dice: Dice) -> list[Body]:
    """One or two wheels in front; the tub is fixed or tips forward."""
    width, long, high = dice.between(0.5, 0.7), dice.between(0.7, 0.95), dice.between(0.2, 0.35)
    radius, metal = dice.between(0.16, 0.22), looks.metal(dice)
    level, twin = 2 * radius + 0.02, dice.chance(0.3)
    x = 0.28 * width
    nose, tail = -0.5 * long - radius * 0.8, 0.5 * long + 0.6
    shafts = [
        tube(
            np.array(
                [
                    (s * 0.09 if not twin else s * x, nose, radius),
                    (s * x, -0.2 * long, level - 0.03),
                    (s * x, 0.3 * long, level - 0.02),
                    (s * 0.3, tail, level + 0.1),
                ]
            ),
            0.016,
        )
        for s in (-1, 1)
    ]
    legs = [
        tube(
            np.array(
                [(s * x, 0.3 * long, level - 0.03), (s * x, 0.35 * long, 0.02), (s * x, 0.5 * long, 0.02)]
            ),
            0.014,
        )
        for s in (-1, 1)
    ]
    grips = [
        rod((s * 0.29, tail - 0.14, level + 0.08), (s * 0.302, tail + 0.01, level + 0.102), 0.021, 8)
        for s in (-1, 1)
    ]
    ends = x + 0.05 if twin else 0.09
    axle = lying(0.01, 2 * ends, X, 8) + [0, nose, radius]
    whole = Rig(surface([*shafts, *legs, axle], metal), surface(grips, looks.rubber(dice)), label="frame")
    square = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    w, d = 0.65 * width, 0.65 * long
    tub = loft(
        square,
        [
            (0, 0, 0),
            (w, d, 0),
            (width, long, high),
            (width - 0.02, long - 0.02, high),
            (w - 0.02, d - 0.02, 0.01),
            (0, 0, 0.01),
        ],
    )
    piece = surface([tub + [0, -0.01, level]], looks.painted_metal(dice))
    whole.dress(0, piece)
    _barrow_wheels(dice, whole, radius, nose, x + 0.07 if twin else 0.0)
    return whole.bodies()


def _barrow_wheels(dice: Dice, whole: Rig, radius: float, nose: float, reach: float) -> None:
    """A wheel in the middle, or two when `reach` is not 0."""
    form = axle_wheel(dice, radius)
    half = max(float(np.abs(p[..., 0]).max()) for p in form)
    squeeze = min(1.0, 0.06 / half)
    for name, spot in (("left_wheel", -reach), ("right_wheel", reach)) if reach else (("wheel", 0.0),):
        hub = np.array([spot, nose, radius])
        whole.add(
            "wheel",
            spin(hub, RIGHT),
            surface(moved([p * [squeeze, 1, 1] for p in form], hub), looks.rubber(dice)),
            name=name,
        )


CATEGORIES: tuple[Category, ...] = (
    Category("cart", _cart),
    Category("platform_trolley", _platform_trolley),
    Category("hand_truck", _hand_truck),
    Category("wheelbarrow", _wheelbarrow),
)
