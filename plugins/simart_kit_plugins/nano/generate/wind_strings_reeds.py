"""Woodwind instruments: clarinets, saxophones and flutes, with keys on rods along their tubes."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, pointed, rotation, turned
from ...shapes.primitives import box, cylinder, revolve, rod, superquadric, torus, tube
from . import looks
from .assembling import Assembly
from .objects import Body, Look, hinge
from .wind_strings_parts import (
    FRONT,
    LEFT,
    RIGHT,
    UP,
    arc,
    bell,
    brassy,
    cup_key,
    laid,
    tipping,
)


def _row(
    dice: Dice, kit: Assembly, bore: FloatArray, span: tuple[float, float], turn: float, count: int,
    size: float, look: Look, open_: bool, ring: float = 0.0,
) -> None:  # fmt: skip
    """Keys one above the other on a tube about z, whose bore goes from the first to the last of `bore`."""
    side, step = dice.sign(), (span[1] - span[0]) / count
    for k in range(count):
        z = span[0] + (k + 0.5) * step
        here = float(np.interp(z, span, bore))
        wide = min(size, (step - 0.012) / 2.2)
        spare = step - 2.2 * wide - 0.012
        touch = 0.0 if open_ and dice.chance(0.7) else min(0.5 * spare, 0.03)
        lift = dice.between(0.0025, 0.004) if open_ else 0.0
        cup_key(kit, here, (z, turn), wide, look, side, lift, touch, open_ and dice.chance(ring))


def _clarinet(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A straight tube of joints with a bell and a mouthpiece: a clarinet, an oboe or a straight saxophone."""
    long, bore = dice.between(0.4, 0.62), dice.between(0.0125, 0.016)
    wood = dice.pick((Look("wood", (34, 28, 26)), Look("plastic", (24, 24, 26)), looks.wood(dice), look))
    size, cuts = dice.between(0.006, 0.009), (0.0, 0.48, 0.9)
    kit.fix([cylinder(bore, long, 18) + [0, 0, long / 2]], wood)
    kit.fix([cylinder(1.25 * bore, 0.014, 18) + [0, 0, c * long] for c in cuts], look)
    flare = bell(bore, dice.between(1.8, 2.8) * bore, dice.between(0.08, 0.13), dice.between(2, 5))
    kit.fix([turned([flare], rotation(RIGHT, np.pi))[0]], wood)
    beak = revolve(
        [[0.0, 0.0], [bore, 0.0], [bore, 0.02], [0.7 * bore, 0.03], [0.35 * bore, 0.085], [0.0, 0.085]], 16
    )
    kit.fix([beak + [0, 0, long]], Look("plastic", (20, 20, 22)))
    clamp = cylinder(1.06 * bore, 0.02, 18) + [0, 0, long + 0.012]
    kit.fix(
        [
            clamp,
            *(
                rod((-0.012, 1.1 * bore, long + z), (0.014, 1.1 * bore, long + z), 0.002)
                for z in (0.007, 0.017)
            ),
        ],
        look,
    )
    both, ring = np.array([bore, bore]), dice.pick((0.0, 0.7, 1.0))
    front = -np.pi / 2
    _row(dice, kit, both, (0.05 * long, 0.46 * long), front, dice.whole(3, 4), size, look, True, ring)
    _row(dice, kit, both, (0.51 * long, 0.88 * long), front, dice.whole(3, 4), size, look, True, ring)
    for turn in (front + 2.1, front - 2.1)[: dice.whole(1, 2)]:
        low = dice.pick((0.04, 0.5))
        _row(dice, kit, both, (low * long, (low + 0.4) * long), turn, dice.whole(1, 3), size, look, False)
    if dice.chance(0.8):
        tipping(kit, (0, 0, 0.68 * long), -UP, -FRONT, bore, (0.03, dice.between(0.02, 0.04)), 0.011, look)
    rest = tube(
        [(0, 0.8 * bore, 0.3 * long), (0, bore + 0.02, 0.3 * long), (0, bore + 0.026, 0.3 * long - 0.01)],
        0.004,
    )
    kit.fix([rest, box((0.014, 0.004, 0.03), (0, bore, 0.3 * long))], look)
    return laid(dice, kit, np.eye(3), rotation(RIGHT, np.pi / 2), rotation((0, 1, 0), np.pi / 2))


def _saxophone(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A conical tube with a bow and a bell that points up, a neck that turns in its top, and large cups."""
    scale = dice.between(0.75, 1.35)
    long, low, high, apart = 0.5 * scale, 0.029 * scale, 0.0125 * scale, 0.1 * scale
    line = np.concatenate([[(0, 0, long)], arc((0, -apart / 2, 0), (0, apart / 2, 0), (0, 0, -apart / 2))])
    kit.fix([tube(line, np.r_[high, np.linspace(low, 1.25 * low, len(line) - 1)], 16)], look)
    tall = dice.between(0.22, 0.32) * scale
    kit.fix(
        [bell(1.25 * low, dice.between(0.055, 0.075) * scale, tall, dice.between(4, 9)) - [0, apart, 0.001]],
        look,
    )
    kit.fix([rod((0, -0.5 * low, 0.1 * scale), (0, -apart + low, 0.1 * scale), 0.005, 8)], look)
    bore = np.array([low, high])
    for turn, share, count in ((0.3, 0.62, dice.whole(4, 6)), (np.pi - 0.3, 0.5, dice.whole(1, 4))):
        spans = (0.06 * long, 0.95 * long) if share > 0.6 else (0.1 * long, 0.8 * long)
        wide = np.interp(spans, (0, long), bore)
        _row(dice, kit, wide, spans, turn, count, dice.between(0.015, 0.022) * scale, look, share > 0.6)
    cups = Assembly()
    turn, size = dice.pick((0.0, np.pi)), dice.between(0.022, 0.028) * scale
    _row(
        dice, cups, np.array([1.3, 1.5]) * low, (0.005, 0.72 * tall), turn, dice.whole(1, 2), size, look, True
    )
    kit.graft(cups, (0, -apart, 0))
    if dice.chance(0.5):
        tipping(kit, (0, low - 0.3 * (low - high), 0.3 * long), UP, -FRONT, 0.004, (0.03, 0.03), 0.014, look)
    top = np.array([0, 0, long + 0.0012])
    kit.fix([cylinder(1.35 * high, 0.02, 16) + [0, 0, long - 0.0095]], look)
    bend = top + scale * np.array(
        [(0, 0, 0), (0, 0.002, 0.03), (0, 0.025, 0.055), (0, 0.06, 0.062), (0, 0.12, 0.045)]
    )
    neck = [
        tube(bend, np.linspace(high, 0.65 * high, 5), 14),
        cylinder(1.2 * high, 0.008, 16) + top + [0, 0, 0.004],
    ]
    neck.append(rod(top - [0, 0, 0.015], top + [0, 0, 0.002], 0.9 * high, 12))
    way = bend[4] - bend[3]
    beak = [rod(bend[4], bend[4] + 0.4 * way, 0.8 * high, 12)]
    beak.append(
        tube(
            [bend[4] + 0.3 * way, bend[4] + 0.9 * way, bend[4] + 1.5 * way],
            high * np.array([1.1, 1.0, 0.4]),
            12,
        )
    )
    part = kit.add("neck", hinge(top, UP, 0.7, -0.7), [(neck, look), (beak, Look("plastic", (22, 22, 24)))])
    out = np.cross(way, RIGHT) * np.sign(np.cross(way, RIGHT)[2])
    tipping(kit, bend[3], -way, out, 0.75 * high, (0.02 * scale, 0.022 * scale), 0.011, look, part)
    z = 0.42 * long
    hook = tube([(0, 0.6 * low, z), (0, low + 0.018, z), (0, low + 0.024, z - 0.014)], 0.004)
    hoop = pointed(torus(0.01, 0.002, 14), X) + [0, 0.7 * low + 0.016, 0.6 * long]
    kit.fix([hook, hoop], look)
    return laid(dice, kit, np.eye(3), rotation((0, 1, 0), np.pi / 2), rotation(RIGHT, np.pi / 2))


def _flute(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A thin tube that lies along x, with a lip plate and a row of cups, and trill keys beside it."""
    long, bore, size = dice.between(0.3, 0.68), dice.between(0.0085, 0.012), dice.between(0.006, 0.0085)
    kit.fix(
        [cylinder(bore, long, 18) + [0, 0, long / 2], cylinder(1.15 * bore, 0.012, 18) + [0, 0, 0.66 * long]],
        look,
    )
    crown = revolve(
        [[0.0, 0.0], [bore, 0.0], [1.1 * bore, 0.004], [1.1 * bore, 0.014], [0.6 * bore, 0.02], [0.0, 0.02]],
        16,
    )
    kit.fix([crown + [0, 0, long]], look)
    lip = superquadric((0.5 * bore, 2.6 * bore, 0.034), 0.5, 0.8, 8) + [1.02 * bore, 0, 0.86 * long]
    kit.fix([lip, pointed(cylinder(0.005, 0.002, 12), X) + [1.24 * bore, 0, 0.86 * long]], look)
    both, most = np.array([bore, bore]), max(4, min(9, int(0.6 * long / 0.033)))
    _row(
        dice,
        kit,
        both,
        (0.02 * long, 0.63 * long),
        0.0,
        dice.whole(4, most),
        size,
        look,
        True,
        dice.pick((0, 0.6)),
    )
    _row(
        dice,
        kit,
        both,
        (0.1 * long, 0.6 * long),
        dice.sign() * 2.0,
        dice.whole(1, 4),
        0.8 * size,
        look,
        False,
    )
    if dice.chance(0.6):
        tipping(kit, (0, 0, 0.4 * long), UP, LEFT, bore, (0.024, 0.024), 0.01, look)
    return laid(
        dice,
        kit,
        rotation((0, 1, 0), np.pi / 2),
        rotation(RIGHT, np.pi / 2) @ rotation(UP, np.pi / 2),
        np.eye(3),
    )


def woodwind(dice: Dice) -> list[Body]:
    """A clarinet or the like, a saxophone or a flute."""
    kit, look = Assembly("body"), Look("steel", (196, 198, 202)) if dice.chance(0.5) else brassy(dice)
    make = dice.weighted([(3, _clarinet), (4, _saxophone), (3, _flute)])
    return make(dice, kit, look)
