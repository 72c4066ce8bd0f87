"""Kitchen machines that mix, chop, steam and spin: mixers, blenders, rice cookers, salad spinners."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, at, moved, pointed, rotation, turned
from ...shapes.primitives import box, cylinder, loft, prism, rod
from . import looks
from .assembling import Assembly, dial, disc, turning
from .category import Category
from .mixing_machines_blenders import blender
from .mixing_machines_cookers import rice_cooker
from .mixing_machines_parts import (
    BACK,
    DARK,
    DOWN,
    LEFT,
    RIGHT,
    UP,
    beater,
    cup,
    ear,
    hull,
    ring,
)
from .mixing_machines_spinners import salad_spinner
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import lying


@dataclass(frozen=True)
class _Frame:
    """Sizes of a stand mixer, whose bowl stands about the z axis.

    Attributes:
        mouth, tall: radius and height of the bowl.
        floor, rim, under: levels of the bowl's foot and mouth, and of the head's underside.
        front, back: of the column.
        wide: of the column.
        half, tail: half the head's width, and half its height at the tail.
        lifted: whether the bowl is lifted rather than the head tipped.
    """

    mouth: float
    tall: float
    floor: float
    rim: float
    under: float
    front: float
    back: float
    wide: float
    half: float
    tail: float
    lifted: bool

    @property
    def pin(self) -> FloatArray:
        """(3,) where the head turns."""
        return np.array([0.0, self.back - self.tail, self.under + self.tail])


def _stand_mixer(dice: Dice) -> list[Body]:
    """A head with beaters over a bowl: it tips about a pin at its tail, or the bowl is lifted to it."""
    kit, coat, metal = Assembly("base"), looks.painted_metal(dice), looks.metal(dice)
    mouth, high, lifted = dice.between(0.085, 0.12), dice.between(0.028, 0.05), dice.chance(0.3)
    tall, tail = mouth * dice.between(1.0, 1.35), dice.between(0.042, 0.06)
    floor = high + (dice.between(0.06, 0.09) if lifted else 0.0015)
    rim, front = floor + tall, mouth + dice.between(0.03, 0.05)
    back, half = front + tail * 2 + dice.between(-0.02, 0.02), tail * dice.between(0.95, 1.25)
    under, wide = rim + dice.between(0.012, 0.03), 2 * half * dice.between(0.95, 1.3)
    size = _Frame(mouth, tall, floor, rim, under, front, back, wide, half, tail, lifted)
    long, foot = mouth * 1.15 + back + 0.01, max(wide * 1.15, mouth * dice.between(1.5, 2.0))
    base = prism(rounded(dice.between(0.2, 0.5), foot / long), (foot, long, high))
    kit.fix([base + [0, long / 2 - 1.15 * mouth, high / 2]], coat)
    spots = [(x * 0.36 * foot, y, -0.003) for x in (-1, 1) for y in (-0.6 * mouth, back - 0.04)]
    kit.fix(at(cylinder(0.014, 0.008, 12), spots), looks.rubber(dice))
    top, deep = under - 0.002 + (0.012 if lifted else 0), back - front
    flare = dice.between(1.0, 1.25)
    stages = [(0, 0, high - 0.002), (wide * flare, deep, high - 0.002), (wide, deep, top), (0, 0, top)]
    kit.fix([loft(rounded(0.25), stages) + [0, (front + back) / 2, 0]], coat)
    head = _mixer_head(dice, kit, size, coat, metal)
    _beaters(dice, kit, size, head)
    holder = _bowl_lift(dice, kit, size, metal) if lifted else 0
    _mixing_bowl(dice, kit, size, holder, high)
    _mixer_controls(dice, kit, size, head, high)
    return kit.done()


def _mixer_head(dice: Dice, kit: Assembly, size: _Frame, coat: Look, metal: Look) -> int:
    """A hull from its tail, round about the pin, to its nose; gives its number."""
    pin, r = size.pin, size.tail
    nose = -dice.between(0.05, 0.08)
    stations = [
        (pin[1] + r * np.cos(a), pin[2], 0.85 * size.half, r * np.sin(a) + 1e-4) for a in (0.05, 0.5, 1)
    ]
    reach, rise = pin[1] - nose, dice.between(0.0, 0.35) * r
    for share, wide, more in ((0, 0.85, 0), (0.3, 0.86, 0.4), (0.5, 1, 1), (0.85, 1, 0.7), (0.97, 0.85, 0.1)):
        lean = more * rise / 2
        stations.append((pin[1] - share * reach, pin[2] + lean, wide * size.half, r + lean))
    stations.append((nose, pin[2], 0.6 * size.half, 0.7 * r))
    bend = dice.between(0.45, 0.9)
    parts = [([hull(stations, bend)], coat)]
    parts.append(([cylinder(0.032, 0.02, 20) + [0, 0, size.under + 0.002]], metal))
    if dice.chance(0.7):
        parts.append(([disc(0.5 * r, 0.014, 20) + [0, nose + 0.002, pin[2]]], metal))
    if dice.chance(0.4):
        strip = box((1.6 * size.half, 0.6 * reach, 0.004), (0, pin[1] - 0.55 * reach, pin[2] - 0.995 * r))
        parts.append(([strip], metal))
    if size.lifted:
        for pieces, look in parts:
            kit.fix(pieces, look)
        return 0
    x = 0.85 * size.half + 0.006
    cheek = prism(ngon(16), (0.036, 0.036, 0.008))
    sides = at(pointed(cheek, X), [(s * x, pin[1], pin[2]) for s in (-1, 1)])
    sides += [box((0.008, 0.034, r + 0.02), (s * x, pin[1], pin[2] - r / 2 - 0.01)) for s in (-1, 1)]
    sides += [box((0.014, 0.04, 0.012), (s * (x - 0.003), pin[1], size.under - 0.008)) for s in (-1, 1)]
    kit.fix(sides, coat)
    parts.append(([lying(0.008, 2 * x + 0.014) + pin], metal))
    return kit.add("head", hinge(pin, LEFT, dice.between(0.6, 1.0)), parts)


def _beaters(dice: Dice, kit: Assembly, size: _Frame, head: int) -> None:
    """One beater in a turning disc, in the middle or off it, or two side by side."""
    metal, pin = looks.metal(dice), size.pin
    low = size.floor + dice.between(0.14, 0.25) * size.tall
    rise, drop = pin[2] - size.rim, pin[2] - low
    room = np.sqrt((pin[1] + size.mouth - 0.01) ** 2 + rise**2 - drop**2) - pin[1]
    most = min(0.6 * size.mouth, 0.6 * size.mouth if size.lifted else room)
    level = size.under - 0.009
    if dice.chance(0.25):
        radius = min(0.45 * most, 0.03)
        for s in (-1, 1):
            spot = np.array([s * (radius + 0.004), 0, level])
            label, shape = beater(dice, radius, level - low)
            kit.add(label, spin(spot, UP), [(moved(shape, spot), metal)], head)
        return
    spot = np.array([0, 0, level - 0.012])
    plate = cylinder(0.028, 0.011, 20) + [0, 0, level - 0.0062]
    off = dice.pick((0.0, 0.25, 0.3)) * most
    label, shape = beater(dice, most - off, spot[2] - low)
    if not off:
        kit.add(label, spin(spot, UP), [(moved(shape, spot), metal), ([plate], metal)], head)
        return
    arm = [plate, cylinder(0.011, 0.006, 12) + [0, -off, level - 0.0135]]
    disc_ = kit.add("rotor", spin(spot, UP), [(arm, looks.metal(dice))], head)
    spot = spot - [0, off, 0.005]
    kit.add(label, spin(spot, UP), [(moved(shape, spot), metal)], disc_)


def _mixing_bowl(dice: Dice, kit: Assembly, size: _Frame, holder: int, high: float) -> None:
    """A bowl on the base, to lift off, to twist out, or on a turntable; or on the arms of a lift."""
    m, tall, look = size.mouth, size.tall, looks.glass(dice) if dice.chance(0.15) else looks.metal(dice)
    foot = dice.between(0.55, 0.7)
    line = [(foot * m, 0), ((foot + 0.03) * m, 0.01), (0.87 * m, 0.3 * tall), (0.97 * m, 0.65 * tall)]
    line += [(m, tall - 0.004), (m + 0.004, tall - 0.003), (m + 0.004, tall)]
    shape = [cup(line, 0.003, 30) + [0, 0, size.floor]]
    if holder:
        pegs = [box((0.012, 0.02, 0.008), (s * (m + 0.007), 0, size.rim - 0.036)) for s in (-1, 1)]
        kit.add("bowl", free(), [(shape + pegs, look)], holder)
        return
    if dice.chance(0.2):
        plate = cylinder(foot * m * 0.95, 0.006, 24) + [0, 0, high + 0.004]
        shape = moved(shape, (0, 0, 0.007))
        kit.add("bowl", spin((0, 0, 0), UP), [(shape, look), ([plate], DARK)])
        return
    kit.fix([ring(foot * m + 0.006, foot * m + 0.014, high - 0.002, high + 0.006)], looks.metal(dice))
    if dice.chance(0.5):
        bow = moved(ear(0.93 * m, 0.45 * tall, 0.85 * tall, 0.05, 0.006), (0, 0, size.floor))
        shape += turned(bow, rotation(UP, dice.pick((0.0, np.pi, 0.4, -0.5))))
    kit.add("bowl", free(), [(shape, look)])


def _bowl_lift(dice: Dice, kit: Assembly, size: _Frame, metal: Look) -> int:
    """Arms beside the bowl on a slide before the column, and the lever that moves it; gives their number."""
    x, level = size.mouth + 0.016, size.rim - 0.048
    rails = [
        box(
            (0.014, 0.012, size.rim - size.floor + 0.05),
            (s * 0.3 * size.wide, size.front - 0.004, level - 0.03),
        )
        for s in (-1, 1)
    ]
    kit.fix(rails, metal)
    y = size.front - 0.017
    arms = [box((2 * x + 0.012, 0.011, 0.03), (0, y, level))]
    arms += [box((0.012, y + 0.02, 0.014), (s * x, (y - 0.02) / 2, level)) for s in (-1, 1)]
    arms += [cylinder(0.005, 0.012, 10) + [s * x, 0, level + 0.01] for s in (-1, 1)]
    arms.append(box((0.5 * size.wide, 0.012, 0.05), (0, y - 0.001, level - 0.01)))
    yoke = kit.add("bracket", slide(DOWN, dice.between(0.03, 0.05)), [(arms, looks.painted_metal(dice))])
    pin = np.array([(size.wide * 0.62 + 0.004), (size.front + size.back) / 2, dice.between(0.12, 0.17)])
    kit.fix([lying(0.014, 0.04) + pin - [0.022, 0, 0]], metal)
    lever = [lying(0.012, 0.01), rod((0, 0, 0), (0.012, 0.02, -0.07), 0.005, 8)]
    lever.append(rod((0.012, 0.02, -0.07), (0.04, 0.02, -0.07), 0.008, 10))
    motion = hinge(pin, RIGHT, dice.between(1.2, 2.6))
    kit.add("lever", motion, [(moved(lever, pin + [0.004, 0, 0]), metal)])
    return yoke


def _mixer_controls(dice: Dice, kit: Assembly, size: _Frame, head: int, high: float) -> None:
    """A speed knob on the column or the head, a slider on the head, and a lock for the pin."""
    side, look, metal = -1 if size.lifted else dice.sign(), looks.plastic(dice), looks.metal(dice)
    aside, pin = rotation(UP, side * np.pi / 2), size.pin
    middle = (size.front + size.back) / 2
    if dice.chance(0.55):
        spot = np.array([side * size.wide * 0.56, middle, high + 0.35 * (size.under - high)])
        kit.fix([lying(0.03, 0.03, X, 20) + spot - [side * 0.014, 0, 0]], metal)
        knob = moved(turned(dial(dice, 0.026), aside), spot + [side * 0.0015, 0, 0])
        kit.add("knob", turning(dice, spot, RIGHT), [(knob, look)])
    else:
        spot = np.array([side * size.half, pin[1] * 0.45, pin[2]])
        kit.fix([box((0.008, 0.08, 0.014), spot - [side * 0.003, 0, 0])], metal, head)
        cap = [
            box((0.016, 0.006, 0.006), (side * 0.0095, 0, 0)),
            box((0.01, 0.012, 0.016), (side * 0.017, 0, 0)),
        ]
        kit.add("slider", slide(BACK, 0.03, -0.03), [(moved(cap, spot), look)], head)
    if not size.lifted and dice.chance(0.6):
        spot = np.array([-side * size.wide * 0.56, middle, size.under - 0.045])
        kit.fix([lying(0.009, 0.03) + spot + [side * 0.012, 0, 0]], metal)
        arm = [lying(0.008, 0.008), box((0.006, 0.04, 0.01), (0, -0.016, 0))]
        kit.add("lever", hinge(spot, LEFT, 0.7), [(moved(arm, spot - [side * 0.0085, 0, 0]), look)])
    elif dice.chance(0.4):
        spot = np.array([dice.between(-0.2, 0.2) * size.wide, size.back, 0.6 * size.under])
        back = moved(turned([disc(0.011, 0.006, 16)], rotation(UP, np.pi)), spot)
        kit.add("button", slide((0, -1, 0), 0.003), [(back, look)])
    if dice.chance(0.3):
        spot = np.array([side * size.half * 0.99, -0.02, pin[2]])
        screw = [
            rod((0, 0, 0), (side * 0.02, 0, 0), 0.004, 8),
            lying(0.012, 0.012, X, 8) + [side * 0.02, 0, 0],
        ]
        kit.add("knob", spin(spot, RIGHT), [(moved(screw, spot), look)], head)


CATEGORIES: tuple[Category, ...] = (
    Category("stand_mixer", _stand_mixer),
    Category("blender", blender),
    Category("rice_cooker", rice_cooker),
    Category("salad_spinner", salad_spinner),
)
