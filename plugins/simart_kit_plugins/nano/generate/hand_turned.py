"""Fishing reels and jacks, which one turns by hand."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, torus, tube
from ...shapes.primitives import superquadric as soft
from . import looks
from .assembling import Assembly, turning
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, hinge, slide, spin
from .rigging import FRONT, RIGHT, UP, lying


def _fishing_reel(dice: Dice) -> list[Body]:
    """A body below a foot, with a crank, a rotor with a bail, and a spool with a knob on it."""
    kit, metal, coat = Assembly("body"), looks.metal(dice), looks.plastic(dice)
    size = dice.between(0.02, 0.03)
    kit.fix(
        [
            soft((1.3 * size, 2.6 * size, 2.2 * size), 0.6, 0.6),
            box((0.4 * size, 0.7 * size, 2.2 * size), (0, 0.2 * size, 1.9 * size)),
            soft((0.7 * size, 4 * size, 0.4 * size), 0.6, 0.8) + [0, 0, 3.0 * size],
        ],
        coat,
    )
    hub = np.array([0, -1.35 * size, 0])
    rotor = [pointed(cylinder(0.9 * size, 0.4 * size, 20), Y) - [0, 0.2 * size, 0]]
    rotor += [box((0.3 * size, 1.7 * size, 0.6 * size), (s * 1.25 * size, -0.9 * size, 0)) for s in (-1, 1)]
    rotor += [box((1.4 * size * 2 - 0.2 * size, 0.3 * size, 0.4 * size), (0, -0.15 * size, 0))]
    number = kit.add("rotor", spin(hub, FRONT), [(moved(rotor, hub), coat)])
    arc = np.linspace(0, np.pi, 12)
    pin = hub + [0, -1.5 * size, 0]
    bail = [
        tube(
            np.column_stack([-1.5 * size * np.cos(arc), -0.5 * size * np.sin(arc), 1.4 * size * np.sin(arc)]),
            0.06 * size,
            6,
        ),
        *[lying(0.2 * size, 0.16 * size) + [s * 1.5 * size, 0, 0] for s in (-1, 1)],
    ]
    kit.add("bail", hinge(pin, RIGHT, 0.2, -1.2), [(moved(bail, pin), metal)], number)
    spool = [pointed(cylinder(1.05 * size, 0.12 * size, 24), Y) - [0, y * size, 0] for y in (0.55, 1.6)] + [
        pointed(cylinder(0.85 * size, 1.0 * size, 24), Y) - [0, 1.08 * size, 0]
    ]
    reel = kit.add("spool", slide(FRONT, 0.4 * size), [(moved(spool, hub), metal)])
    cap = [
        pointed(cylinder(0.5 * size, 0.3 * size, 14), Y) - [0, 1.85 * size, 0],
        box((0.9 * size, 0.2 * size, 0.16 * size), (0, -2.0 * size, 0)),
    ]
    kit.add("knob", turning(dice, hub, FRONT), [(moved(cap, hub), DARK)], reel)
    s = dice.sign()
    spot = np.array([s * 0.66 * size, 0.2 * size, 0])
    yaw = rotation(RIGHT, dice.between(0, 6.28))
    crank = [
        lying(0.2 * size, 0.9 * size) + [s * 0.45 * size, 0, 0],
        box((0.2 * size, 0.35 * size, 2 * size), (s * 0.9 * size, 0, 0.9 * size)),
    ]
    turn = kit.add("crank", spin(spot, RIGHT), [(moved(turned(crank, yaw), spot), metal)])
    end = spot + yaw @ np.array([s * 1.0 * size, 0, 1.75 * size])
    grip = [
        soft((0.9 * size, 0.7 * size, 0.9 * size), 0.7, 0.7) + [s * 0.75 * size, 0, 0],
        lying(0.12 * size, 0.4 * size) + [s * 0.2 * size, 0, 0],
    ]
    kit.add("grip", spin(end, RIGHT), [(moved(grip, end), DARK)], turn)
    return kit.done(rotation(RIGHT, np.pi) if dice.chance(0.4) else None)


def _scissor_jack(dice: Dice) -> list[Body]:
    """Four arms between a foot and a saddle, on a screw with an eye or a crank."""
    kit, metal = Assembly("foot"), looks.painted_metal(dice)
    reach, angle = dice.between(0.16, 0.24), dice.between(0.3, 0.8)
    width = dice.between(0.03, 0.045)
    x, z = reach * np.cos(angle), reach * np.sin(angle)
    kit.fix(
        [
            box((0.12, 2.2 * width, 0.006), (0, 0, 0.003)),
            boxes((0.09, 0.004, 0.05), [(0, s * width, 0.03) for s in (-1, 1)]),
        ],
        metal,
    )
    arms = []
    for s in (-1, 1):
        pin = np.array([s * 0.02, 0, 0.04])
        motion = hinge(pin, (0, -s, 0), 1.2 - angle, 0.15 - angle)
        arm = moved(_lower_arm(s, reach, width, angle), pin)
        arms.append(kit.add("arm", motion, [(arm, metal)], name="left_arm" if s < 0 else "right_arm"))
    saddle = [
        box((0.06, 1.6 * width, 0.012), (0, 0, 0.055 + 2 * z)),
        box((0.05, 1.3 * width, 0.03), (0, 0, 0.04 + 2 * z)),
    ]
    for s, number in zip((-1, 1), arms, strict=True):
        pin = np.array([s * (0.02 + x), 0, 0.04 + z])
        kit.add(
            "arm",
            hinge(pin, (0, s, 0), 2 * (1.2 - angle), -2 * angle + 0.3),
            [
                (moved(_upper_arm(s, reach, width, np.pi - angle), pin), metal),
                (saddle if s > 0 else [], DARK),
            ],
            number,
            "left_upper_arm" if s < 0 else "right_upper_arm",
        )
    pin = np.array([0, 0, 0.04 + z])
    screw = moved(_jack_screw(dice, 0.02 + x), pin)
    kit.add("screw", spin(pin, RIGHT), [(screw, looks.metal(dice))], arms[1])
    return kit.done()


def _lower_arm(s: int, reach: float, width: float, angle: float) -> Pieces:
    """An arm of the left (-1) or right (1) side that rises outwards from its pin at the foot."""
    arm = [
        boxes((reach, 0.004, 0.028), [(reach / 2, t * (width - 0.006), 0) for t in (-1, 1)]),
        box((0.7 * reach, 1.7 * width, 0.004), (0.5 * reach, 0, -0.012)),
        pointed(cylinder(0.006, 2.2 * width), Y),
    ]
    return _on_side(turned(arm, rotation(FRONT, angle)), s)


def _upper_arm(s: int, reach: float, width: float, angle: float) -> Pieces:
    """An arm of the left (-1) or right (1) side that rises inwards from its pin at the screw."""
    arm = [
        boxes((reach, 0.004, 0.026), [(reach / 2, t * (width - 0.011), 0) for t in (-1, 1)]),
        box((0.6 * reach, 1.4 * width, 0.004), (0.5 * reach, 0, 0.011)),
        pointed(cylinder(0.011, 2.1 * width, 14), Y),
    ]
    return _on_side(turned(arm, rotation(FRONT, angle)), s)


def _on_side(arm: Pieces, s: int) -> Pieces:
    """An arm of the right side as it is (1), or turned to the left (-1)."""
    return arm if s > 0 else turned(arm, rotation(UP, np.pi))


def _jack_screw(dice: Dice, end: float) -> Pieces:
    """A screw along x, out to the arms at -end and end, with an eye or a crank on its right."""
    screw = [lying(0.006, 2 * end + 0.1) + [0.02, 0, 0], lying(0.012, 0.03) + [end + 0.05, 0, 0]]
    if dice.chance(0.5):
        return [*screw, pointed(torus(0.014, 0.004, 16), Y) + [end + 0.08, 0, 0]]
    crank = box((0.012, 0.012, 0.1), (end + 0.07, 0, 0.045))
    return [*screw, crank, lying(0.008, 0.09) + [end + 0.12, 0, 0.09]]


CATEGORIES = (
    Category("fishing_reel", _fishing_reel),
    Category("scissor_jack", _scissor_jack),
)
