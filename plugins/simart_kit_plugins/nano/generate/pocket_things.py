"""Small things one carries: eyeglasses, watches, pens, lighters, sticks."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    boxes,
    cylinder,
    open_box,
    prism,
    revolve,
    rod,
    torus,
    tube,
)
from . import looks
from .category import Category
from .objects import Body, hinge, slide, spin, surface
from .rigging import BACK, DOWN, FRONT, LEFT, RIGHT, UP, Rig, lying, upright_ring


def _eyeglasses(dice: Dice) -> list[Body]:
    """Unfolded; the temples fold in, glasses clipped on in front flip up."""
    width, lens, thick = dice.between(0.12, 0.15), dice.between(0.021, 0.027), dice.between(0.0018, 0.0045)
    look, glass = looks.plastic(dice) if dice.chance(0.6) else looks.metal(dice), looks.glass(dice)
    squash, x = dice.between(0.65, 1.05), width / 4
    ring = upright_ring(lens, thick, dice.pick((6, 8, 18))) * [1, 1, squash]
    rims = [ring + [s * x, 0, 0] for s in (-1, 1)] if dice.chance(0.75) else []
    panes = [
        pointed(prism(ngon(18), (2 * lens, 2 * lens, 0.0012)), Y) * [1, 1, squash] + [s * x, 0, 0]
        for s in (-1, 1)
    ]
    bridge = tube(
        np.array([(-x + 0.9 * lens, 0, 0.004), (0, 0, 0.4 * lens * squash), (x - 0.9 * lens, 0, 0.004)]),
        0.5 * thick + 0.0006,
    )
    ears = [
        box((width / 2 - x - 0.8 * lens, thick, 0.006), (s * (width / 2 + x + 0.8 * lens) / 2, 0, 0.008))
        for s in (-1, 1)
    ]
    whole = Rig(surface([*rims, bridge, *ears], look), surface(panes, glass), label="front")
    long = dice.between(0.12, 0.145)
    for name, s in (("left", -1), ("right", 1)):
        pin = np.array([s * width / 2, thick, 0.008])
        bow = [
            tube(
                np.array(
                    [pin, pin + [s * 0.003, 0.7 * long, 0], pin + [0, long, -dice.between(0.01, 0.035)]]
                ),
                0.0018,
            )
        ]
        bow.append(box((0.004, 0.008, 0.005), pin))
        lean = np.array([0.06 * s, 0.0, -s])
        tilt = lean if dice.chance(0.4) else np.array([0, 0, -s])
        whole.add(
            "temple", hinge(pin, -tilt, 1.45 if s < 0 else 1.52), surface(bow, look), name=f"{name}_temple"
        )
    if dice.chance(0.3):
        pin = np.array([0, -thick - 0.002, lens * squash + 0.002])
        shade = surface([p + [0, -thick - 0.002, 0] for p in panes], looks.darker(glass))
        bar = surface([lying(0.0012, 2.2 * x, X, 6) + pin], look)
        whole.add("flip lenses", hinge(pin, LEFT, 1.6), shade, bar)
    return whole.bodies()


def _watch(dice: Dice) -> list[Body]:
    """Case, hands, crown, bezel and straps on hinges; or a pocket watch with its lid."""
    radius, high = dice.between(0.015, 0.024), dice.between(0.006, 0.012)
    metal, band = looks.metal(dice), looks.rubber(dice) if dice.chance(0.5) else looks.fabric(dice)
    round_case = dice.chance(0.7)
    case = (
        cylinder(radius, high, 20) if round_case else prism(rounded(0.15), (2 * radius, 2.2 * radius, high))
    )
    whole = Rig(
        surface(
            [case + [0, 0, high / 2], box((2.6 * radius, 0.004, 0.004), (0, 0, high / 2)) * [0.3, 1, 1]],
            metal,
        ),
        label="case",
    )
    top = high + 0.0004
    for name, reach in (("hour_hand", 0.5), ("minute_hand", 0.75)):
        pin = np.array([0, 0, top + 0.0005 * reach])
        hand = box((0.08 * radius, reach * radius, 0.0003), (0, 0.4 * reach * radius, 0))
        yaw = rotation(UP, dice.between(0, 6.2))
        whole.add(
            "hand", spin(pin, DOWN), surface(moved(turned([hand], yaw), pin), looks.plastic(dice)), name=name
        )
    if dice.chance(0.5):
        whole.add(
            "bezel",
            spin((0, 0, high), UP),
            surface([torus(0.93 * radius, 0.0016, 20, 0.001) + [0, 0, high]], looks.darker(metal)),
        )
    crown = np.array([radius + 0.002, 0, high / 2])
    whole.add("crown", spin(crown, RIGHT), surface([lying(0.0024, 0.004, X, 10) + crown], metal))
    edge = 1.1 * radius
    if dice.chance(0.25):
        pin = np.array([0, radius, top + 0.0015])
        lid = cylinder(radius, 0.0015, 20) + [0, 0, top + 0.0022]
        whole.add("lid", hinge(pin, LEFT, 2.0), surface([lid], metal))
        return whole.bodies()
    for name, s, long in (("upper_strap", 1, 0.075), ("lower_strap", -1, 0.11)):
        pin = np.array([0, s * edge, high / 2])
        strap = [
            prism(rounded(0.05), (1.1 * radius, long, 0.0028)) + pin + [0, s * long / 2, 0],
            lying(0.0016, 1.2 * radius, X, 8) + pin,
        ]
        part = whole.add("strap", hinge(pin, (-s, 0, 0), 1.5), surface(strap, band), name=name)
        if s > 0:
            end = pin + [0, long, 0]
            loop = [
                boxes((1.3 * radius, 0.0015, 0.002), [end + [0, 0.001, 0], end + [0, 0.013, 0]]),
                boxes((0.0015, 0.012, 0.002), [end + [t * 0.6 * radius, 0.007, 0] for t in (-1, 1)]),
            ]
            whole.add("buckle", hinge(end, LEFT, 1.2, -1.2), surface(loop, metal), parent=part)
    return whole.bodies()


def _usb_stick(dice: Dice) -> list[Body]:
    """A cap that comes off, a sleeve that swivels, or a plug that slides out."""
    long, wide, thick = dice.between(0.03, 0.05), dice.between(0.014, 0.02), dice.between(0.006, 0.01)
    shell, steel = looks.plastic(dice), looks.metal(dice)
    body = prism(rounded(dice.between(0.05, 0.3), wide / long), (wide, long, thick))
    plug = open_box((0.012, 0.0045, 0.013), 0.0004)[..., [0, 2, 1]] * [1, -1, 1] - [0, long / 2, 0]
    style = dice.unit()
    if style < 0.35:
        whole = Rig(surface([body], shell), surface([plug], steel))
        cap = open_box((wide, thick, 0.018), 0.001)[..., [0, 2, 1]] - [0, long / 2 + 0.0185, 0]
        whole.add("cap", slide(FRONT, dice.between(0.02, 0.04)), surface([cap], shell))
    elif style < 0.7:
        whole = Rig(surface([body], shell), surface([plug], steel))
        pin = np.array([0, 0.3 * long, 0])
        reach = 0.93 * long + 0.017
        sleeve = [
            box((wide + 0.001, reach, 0.001), (0, 0.42 * long - reach / 2, s * (thick / 2 + 0.001)))
            for s in (-1, 1)
        ]
        sleeve += [cylinder(0.3 * wide, 0.0012, 12) + pin + [0, 0, s * (thick / 2 + 0.0015)] for s in (-1, 1)]
        sleeve.append(box((wide + 0.001, 0.001, thick + 0.002), (0, 0.43 * long - reach, 0)))
        whole.add("sleeve", spin(pin, UP), surface(sleeve, steel))
    else:
        inner = open_box((wide, thick, long), 0.001)[..., [0, 2, 1]] * [1, -1, 1] + [0, long / 2, 0]
        whole = Rig(surface([inner], shell), label="shell")
        core = box((wide - 0.003, long * 0.7, thick - 0.003), (0, 0.1 * long, 0))
        slider = box((0.4 * wide, 0.008, 0.002), (0, 0, thick / 2 + 0.0012))
        whole.add(
            "plug",
            slide(FRONT, 0.014),
            surface([core, slider], looks.plastic(dice)),
            surface([plug + [0, 0.27 * long, 0]], steel),
        )
    if dice.chance(0.4):
        at = np.array([0, long / 2 + 0.006, 0])
        whole.dress(0, surface([upright_ring(0.006, 0.0012) + at], steel))
    return whole.bodies()


def _lighter(dice: Dice) -> list[Body]:
    wide, deep, high = dice.between(0.022, 0.04), dice.between(0.01, 0.014), dice.between(0.035, 0.065)
    shell, steel = looks.metal(dice) if dice.chance(0.6) else looks.plastic(dice), looks.metal(dice)
    case = prism(rounded(dice.between(0.03, 0.3), wide / deep), (wide, deep, high)) + [0, 0, high / 2]
    top, side = high, dice.sign()
    chimney = boxes((0.0008, 0.7 * deep, 0.012), [(s * 0.2 * wide, 0, top + 0.006) for s in (-1, 1)])
    whole = Rig(surface([case], shell), surface([chimney], steel))
    at = np.array([-side * 0.06 * wide, 0, top + 0.009])
    whole.add(
        "spark wheel", spin(at, BACK), surface([lying(0.0035, 0.5 * deep, Y, 14) + at], looks.darker(steel))
    )
    if dice.chance(0.4):
        pin = np.array([-side * 0.25 * wide, 0, top + 0.002])
        tab = box((0.2 * wide, 0.7 * deep, 0.003), (-side * 0.37 * wide, 0, top + 0.003))
        whole.add("lever", hinge(pin, (0, -side, 0), 0.3), surface([tab], looks.plastic(dice)))
    if dice.chance(0.75):
        lid = open_box((wide, deep, 0.019), 0.0008) * [1, 1, -1] + [0, 0, top + 0.0196]
        pin = np.array([side * wide / 2, 0, top + 0.0003])
        barrel = lying(0.0012, 0.8 * deep, Y, 8) + pin
        whole.add("lid", hinge(pin, (0, side, 0), dice.between(1.8, 2.6)), surface([lid, barrel], shell))
    return whole.bodies()


def _pen(dice: Dice) -> list[Body]:
    """With a push button, a cap, or a part that is turned; lying or upright."""
    long, radius = dice.between(0.12, 0.16), dice.between(0.0045, 0.009)
    shell, metal, style = looks.plastic(dice), looks.metal(dice), dice.unit()
    line = np.array([[0, 0], [0.15, 0], [0.2, 0.04], [0.8, 0.14], [1, 0.2], [1, 0.6]]) * [radius, long]
    lower = revolve(np.vstack([line, [0, 0.6 * long]]), 14)
    whole = Rig(surface([lower], shell), label="barrel")
    upper: Pieces = [cylinder(radius, 0.4 * long - 0.0005, 14) + [0, 0, 0.8 * long]]
    clip = box((0.4 * radius, 0.4 * radius, 0.28 * long), (0, -1.35 * radius, 0.84 * long))
    hold = box((0.4 * radius, 0.8 * radius, 0.004), (0, -1.1 * radius, 0.97 * long))
    if style < 0.4:
        button = cylinder(0.5 * radius, 0.012, 10) + [0, 0, long + 0.006]
        whole.dress(0, surface([*upper, clip, hold], metal))
        whole.add("button", slide(DOWN, 0.006), surface([button], shell))
    elif style < 0.65:
        whole.add("upper barrel", spin((0, 0, 0.6 * long), UP), surface([*upper, clip, hold], metal))
    else:
        whole.dress(0, surface([cylinder(0.95 * radius, 0.38 * long, 14) + [0, 0, 0.8 * long]], shell))
        profile = np.array(
            [[1.15, 0.24], [1.15, -0.06], [0, -0.06], [0, -0.05], [1.05, -0.05], [1.05, 0.24]]
        ) * [radius, long]
        pin = box((0.4 * radius, 0.4 * radius, 0.2 * long), (0, -1.5 * radius, 0.06 * long))
        whole.add(
            "cap", slide(DOWN, dice.between(0.15, 0.3) * long), surface([revolve(profile, 14), pin], metal)
        )
    return whole.bodies(rotation(RIGHT, np.pi / 2) if dice.chance(0.6) else None)


def _syringe(dice: Dice) -> list[Body]:
    long, radius = dice.between(0.06, 0.14), dice.between(0.005, 0.015)
    clear, white = looks.glass(dice), looks.plastic(dice)
    line = np.array(
        [[0.15, -0.12], [0.2, -0.02], [1, 0], [1, 1], [0.92, 1], [0.92, 0.02], [0.1, 0.0], [0.1, -0.12]]
    ) * [radius, long]
    wings = prism(rounded(0.4, 3), (5 * radius, 2.4 * radius, 0.0015)) + [0, 0, long]
    whole = Rig(surface([revolve(line, 16), wings], clear), label="barrel")
    out = dice.between(0.1, 0.8)
    seal = cylinder(0.88 * radius, 0.1 * long, 14) + [0, 0, (out + 0.06) * long]
    stem = [
        box((1.2 * radius, 0.25 * radius, long), (0, 0, (out + 0.6) * long)),
        box((0.25 * radius, 1.2 * radius, long), (0, 0, (out + 0.6) * long)),
    ]
    stem.append(cylinder(1.2 * radius, 0.003, 14) + [0, 0, (out + 1.1) * long])
    whole.add(
        "plunger",
        slide(UP, (0.85 - out) * long, -(out - 0.05) * long),
        surface(stem, white),
        surface([seal], looks.rubber(dice)),
    )
    if dice.chance(0.6):
        whole.dress(0, surface([rod((0, 0, -0.5 * long), (0, 0, -0.1 * long), 0.0006, 6)], looks.metal(dice)))
        cap = revolve(np.array([[0.4, -0.1], [0.35, -0.6], [0, -0.6]]) * [radius, long], 12)
        whole.add("needle cap", slide(DOWN, 0.45 * long), surface([cap], looks.plastic(dice)))
    return whole.bodies(rotation(RIGHT, np.pi / 2) if dice.chance(0.7) else None)


def _drawing_compass(dice: Dice) -> list[Body]:
    """Two legs on a pin with a grip; one may bend at its knee."""
    long, thick, spread = dice.between(0.1, 0.18), dice.between(0.004, 0.007), dice.between(0.05, 0.3)
    steel, pin = looks.metal(dice), np.array([0, 0, long])
    whole = Rig(
        surface(
            [cylinder(0.6 * thick, 0.02, 12) + pin + [0, 0, 0.016], box((2 * thick, thick, 0.016), pin)],
            steel,
        ),
        label="head",
    )
    for name, s in (("left_leg", -1), ("right_leg", 1)):
        along = np.array([s * np.sin(spread), 0, -np.cos(spread)])
        start, knee, tip = pin + [s * 0.5 * thick, 0, 0], pin + 0.55 * long * along, pin + long * along
        bends = s > 0 and dice.chance(0.6)
        leg = [
            rod(start, knee if bends else tip, 0.45 * thick, 6),
            lying(0.7 * thick, 1.3 * thick, Y, 10) + start,
        ]
        one = whole.add("leg", hinge(start, (0, -s, 0), 0.7, -spread * 0.9), surface(leg, steel), name=name)
        if bends:
            low = [rod(knee, tip, 0.4 * thick, 6), lying(0.6 * thick, 1.2 * thick, Y, 10) + knee]
            whole.add(
                "lower leg", hinge(knee, (0, s, 0), 0.9, -0.2), surface(low, looks.darker(steel)), parent=one
            )
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("eyeglasses", _eyeglasses),
    Category("watch", _watch),
    Category("usb_stick", _usb_stick),
    Category("lighter", _lighter),
    Category("pen", _pen),
    Category("syringe", _syringe),
    Category("drawing_compass", _drawing_compass),
)
