"""Drum kits: drums, cymbals, pedals, stands and stools."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, unit

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import box, cylinder, revolve, rod, superquadric, torus
from . import looks
from .assembling import Assembly
from .objects import Body, Look, hinge, slide, spin
from .rigging import ball_knob, lying
from .wind_strings_parts import UP, basis


def wing_nut(kit: Assembly, spot: ArrayLike, along: ArrayLike, size: float, look: Look, to: int = 0) -> None:
    """A nut with two wings before a spot."""
    way = unit(np.asarray(along, dtype=np.float64))
    turn = basis(np.eye(3)[np.abs(way).argmin()], way)
    hub = revolve([[0, 0.1], [0.4, 0.1], [0.3, 0.8], [0, 0.8]], 10)
    wings = [superquadric((0.9, 0.22, 0.9), 0.6, 0.8, 6) + [s * 0.6, 0, 0.85] for s in (-1, 1)]
    shape = moved(turned([size * piece for piece in (hub, *wings)], turn), spot)
    kit.add("wing nut", spin(spot, way), [(shape, look)], to)


def drum(dice: Dice, radius: float, deep: float, shell: Look, metal: Look) -> Assembly:
    """A drum about z, its middle at 0, with hoops, lugs and tension rods."""
    kit, count = Assembly(), dice.whole(5, 8)
    skin = Look("plastic", dice.pick(((244, 242, 236), (236, 230, 214), (30, 30, 32))))
    kit.fix([cylinder(radius, deep, 28)], shell)
    kit.fix([cylinder(1.005 * radius, deep + 0.008, 28)], skin)
    hoop = 1.04 * radius
    kit.fix([torus(hoop, 0.006, 28, 0.014) + [0, 0, s * (deep / 2 - 0.004)] for s in (-1, 1)], metal)
    lug = superquadric((0.026, 0.02, min(0.06, 0.3 * deep)), 0.4, 0.5, 5)
    bars = [rod((hoop, 0, -deep / 2), (hoop, 0, deep / 2), 0.003, 5)]
    kit.fix(around([lug + [radius + 0.008, 0, s * 0.25 * deep] for s in (-1, 1)] + bars, count), metal)
    return kit


def tripod(dice: Dice, high: float, reach: float, look: Look) -> Assembly:
    """Three braced legs about z, from z = 0 up to a collar, and a pipe on from there to `high`."""
    kit, collar = Assembly(), dice.between(0.75, 1.1) * reach
    leg = [rod((0.016, 0, collar), (reach, 0, 0.012), 0.007), ball_knob(0.014, 8) + [reach, 0, 0.014]]
    leg.append(rod((0.012, 0, 0.25 * collar), (0.5 * reach, 0, 0.5 * collar), 0.005))
    pipe = [rod((0, 0, 0.2 * collar), (0, 0, high), 0.0125, 10), cylinder(0.022, 0.04, 12) + [0, 0, collar]]
    kit.fix([*around(leg, 3, dice.between(0, 2)), *pipe, cylinder(0.019, 0.045, 12) + [0, 0, high]], look)
    return kit


def cymbal(radius: float, turn: float = 1.0) -> FloatArray:
    """A thin bowed plate with a cup, about z; upside down where turn is -1."""
    high = 0.16 * radius
    top = [[1.0, 0], [0.62, 0.35], [0.24, 0.6], [0.16, 0.95], [0.05, 1.05]]
    low = np.array(top) * [radius, high]
    outline = [*low.tolist(), [low[-1, 0], low[-1, 1] - 0.0025], *(low[-2:0:-1] - [0, 0.0025]).tolist()]
    shape = revolve([*outline, [radius, -0.001], [radius, 0]], 28)
    return shape if turn > 0 else turned([shape], rotation((1, 0, 0), np.pi))[0]


def pedal(kit: Assembly, spot: ArrayLike, long: float, look: Look, dark: Look, hits: float = 0.0) -> None:
    """A foot pedal hinged at its heel, pointing to y; with a beater on its own axle, `hits` behind it."""
    own, tip = Assembly(), 0.38
    own.fix([box((0.1, long + 0.05, 0.006), (0, 0.5 * long, 0.003))], look)
    own.fix([box((0.012, 0.02, 0.026), (s * 0.045, 0, 0.016)) for s in (-1, 1)], look)
    board = [box((0.075, long, 0.008), (0, 0.5 * long, 0.004)), lying(0.005, 0.098, X, 10)]
    board += [box((0.06, 0.006, 0.004), (0, share * long, 0.009)) for share in (0.3, 0.5, 0.7, 0.9)]
    board = moved(turned(board, rotation((1, 0, 0), tip)), (0, 0, 0.022))
    own.add("pedal", hinge((0, 0, 0.022), (-1, 0, 0), 0.24), [(board, dark)])
    if hits:
        pin = np.array([0, long + 0.012, 0.022 + 0.42 * long + 0.03])
        posts = [box((0.014, 0.02, pin[2] + 0.01), (s * 0.056, pin[1], pin[2] / 2)) for s in (-1, 1)]
        own.fix([*posts, box((0.126, 0.02, 0.008), (0, pin[1], 0.004))], look)
        head = [lying(0.005, 0.122, X, 10), rod((0, 0, 0), (0, 0, 0.17), 0.003), lying(0.014, 0.02, X, 12)]
        parts = [(moved(turned(head, rotation((1, 0, 0), 0.75)), pin), look)]
        ball = moved([pointed(cylinder(0.024, 0.04, 14), Y)], (0, 0, 0.17))
        parts.append((moved(turned(ball, rotation((1, 0, 0), 0.75)), pin), dark))
        own.add("beater", hinge(pin, (-1, 0, 0), 0.7), parts)
    kit.graft(own, np.asarray(spot) - [0, long + hits, 0] if hits else spot)


def cymbal_stand(dice: Dice, metal: Look, brass: Look) -> Assembly:
    """A tripod with a pipe that pulls out, a tilter at its top, and a cymbal that turns on it below a nut."""
    high, out = dice.between(0.5, 0.75), dice.between(0.1, 0.35)
    kit = tripod(dice, high, dice.between(0.2, 0.32), metal)
    wing_nut(kit, (0, -0.02, high), (0, -1, 0), 0.02, metal)
    pipe = rod((0, 0, high - 0.2), (0, 0, high + out), 0.0095, 10)
    tube_ = kit.add("pole", slide((0, 0, 1), dice.between(0.1, 0.18)), [([pipe], metal)])
    pin, boom = np.array([0, 0, high + out + 0.016]), dice.pick((0.05, 0.05, 0.25, 0.35))
    kit.fix([box((0.006, 0.022, 0.03), pin + [s * 0.011, 0, -0.004]) for s in (-1, 1)], metal, tube_)
    kit.fix([box((0.028, 0.022, 0.004), pin - [0, 0, 0.0175])], metal, tube_)
    lean = rotation((1, 0, 0), dice.between(0.1, 0.7) * (1 if boom < 0.1 else 1.4))
    top = pin + lean @ np.array([0, 0, boom])
    arm = [lying(0.009, 0.014, X, 12) + pin, lying(0.0035, 0.03, X, 8) + pin, rod(pin, top, 0.0055, 8)]
    up = lean @ np.array([0, 0, 1.0])
    arm += [rod(top, top + 0.05 * up, 0.004, 8), rod(top - 0.004 * up, top + 0.004 * up, 0.016, 12)]
    tilter = kit.add("arm", hinge(pin, (1, 0, 0), 0.3, -0.3), [(arm, metal)], tube_)
    plate = moved(turned([cymbal(dice.between(0.16, 0.27))], lean), top + 0.006 * up)
    kit.add("cymbal", spin(top, up), [(plate, brass)], tilter)
    wing_nut(kit, top + 0.054 * up, up, 0.012, metal, tilter)
    return kit


def hi_hat(dice: Dice, metal: Look, brass: Look) -> Assembly:
    """Two cymbals on one rod: the upper one comes down with it when the pedal is trodden."""
    high, radius = dice.between(0.6, 0.8), dice.between(0.15, 0.19)
    kit, gap = tripod(dice, high, dice.between(0.2, 0.28), metal), dice.between(0.015, 0.03)
    kit.fix(
        [cymbal(radius, -1) + [0, 0, high + 0.06], cylinder(0.014, 0.02, 12) + [0, 0, high + 0.03]], brass
    )
    kit.fix([cylinder(0.0125, 0.03, 12) + [0, 0, high + 0.02]], metal)
    upper = cymbal(radius) + [0, 0, high + 0.062 + gap]
    pole = [rod((0, 0, high - 0.1), (0, 0, high + 0.32), 0.0032, 8)]
    pole.append(cylinder(0.013, 0.05, 12) + [0, 0, high + 0.062 + gap + 0.17 * radius + 0.02])
    top = kit.add("cymbal", slide((0, 0, -1), 0.8 * gap), [([upper], brass), (pole, metal)])
    spot = (0, -0.0135, high + 0.062 + gap + 0.17 * radius + 0.03)
    wing_nut(kit, spot, (0, -1, 0), 0.013, metal, top)
    pedal(kit, (0, -0.26, 0), 0.22, metal, Look("steel", (52, 52, 56)))
    return kit


def stool(dice: Dice, metal: Look, cover: Look) -> Assembly:
    """A padded seat that turns on a tripod; its screw is held by a wing nut."""
    high, radius = dice.between(0.36, 0.48), dice.between(0.15, 0.19)
    kit = tripod(dice, high, dice.between(0.22, 0.28), metal)
    wing_nut(kit, (0, -0.02, high), (0, -1, 0), 0.022, metal)
    pad = superquadric((2 * radius, 2 * radius, 0.1), 0.4, dice.pick((0.6, 1.0)), 8)
    neck = [
        rod((0, 0, high - 0.1), (0, 0, high + 0.06), 0.011, 10),
        box((0.12, 0.12, 0.01), (0, 0, high + 0.05)),
    ]
    kit.add("seat", spin((0, 0, high), (0, 0, 1)), [([pad + [0, 0, high + 0.1]], cover), (neck, metal)])
    return kit


def snare(dice: Dice, shell: Look, metal: Look) -> Assembly:
    """A flat drum in the basket of a tripod, which tips, with a lever that throws its wires off."""
    high, radius, deep = dice.between(0.42, 0.55), 0.178, dice.between(0.1, 0.17)
    kit = tripod(dice, high, 0.24, metal)
    pin = np.array([0, 0, high + 0.045])
    kit.fix([box((0.006, 0.03, 0.05), pin + [s * 0.014, 0, -0.004]) for s in (-1, 1)], metal)
    arms = [rod((0, 0, 0.02), (0.21, 0, 0.035), 0.007), rod((0.206, 0, 0.035), (0.206, 0, 0.07), 0.008)]
    arms = [*around(arms, 3), rod((0, 0, 0), (0, 0, 0.03), 0.009, 10), lying(0.004, 0.04, X, 8)]
    basket = kit.add("basket", hinge(pin, (1, 0, 0), 0.25, -0.25), [(moved(arms, pin), metal)])
    kit.graft(drum(dice, radius, deep, shell, metal), pin + [0, 0, 0.06 + deep / 2], None, basket)
    seat = pin + [0, -radius - 0.005, 0.06 + 0.62 * deep]
    kit.fix([box((0.03, 0.02, 0.3 * deep), seat)], metal, basket)
    throw = [lying(0.004, 0.034, X, 8), box((0.02, 0.006, 0.05), (0, -0.004, 0.024))]
    kit.add(
        "lever",
        hinge(seat - [0, 0.0165, 0], (1, 0, 0), 1.3),
        [(moved(throw, seat - [0, 0.0165, 0]), metal)],
        basket,
    )
    return kit


def bass(dice: Dice, shell: Look, metal: Look, toms: int) -> Assembly:
    """A large drum on its side with a pedal before it, spurs that fold, and toms on arms above."""
    radius, deep = dice.between(0.22, 0.3), dice.between(0.35, 0.45)
    kit, middle = Assembly(), np.array([0, deep / 2, radius + 0.02])
    kit.graft(drum(dice, radius, deep, shell, metal), middle, rotation((1, 0, 0), np.pi / 2))
    pedal(kit, (0, -0.012, 0), dice.between(0.22, 0.27), metal, Look("steel", (52, 52, 56)), 0.02 + 0.05)
    for s in (-1, 1):
        pin = middle + [s * (radius + 0.012) * 0.94, 0.3 * deep, -0.34 * radius]
        kit.fix([lying(0.016, 0.03, X, 12) + pin - [s * 0.008, 0, 0]], metal)
        foot = np.array([pin[0] + s * 0.12, pin[1] + 0.06, 0.006])
        leg = [
            rod(pin + [s * 0.016, 0, 0], foot, 0.006),
            lying(0.014, 0.012, X, 12) + pin + [s * 0.014, 0, 0],
        ]
        kit.add("leg", hinge(pin, (1, 0, 0), 1.2), [([*leg, ball_knob(0.011, 8) + foot], metal)])
    for s in (-1, 1)[:toms]:
        size, tall = dice.between(0.125, 0.165), dice.between(0.16, 0.2)
        base = np.array([s * 0.06, 0.45 * deep, 2 * radius + 0.02])
        kit.fix([cylinder(0.019, 0.06, 12) + base], metal)
        tip = base + [s * 0.07, 0, 0.03 + tall]
        pipe = [rod(base - [0, 0, 0.03], tip * [0, 1, 1] + [base[0], 0, 0], 0.0095, 10)]
        pipe += [rod(tip * [0, 1, 1] + [base[0], 0, 0], tip, 0.0085, 8), ball_knob(0.013) + tip]
        arm = kit.add("arm", hinge(base, (0, 0, 1), 0.25, -0.25), [(pipe, metal)])
        own = drum(dice, size, dice.between(0.16, 0.2), shell, metal)
        own.fix([rod((-s * (size + 0.028), 0, 0), (-s * size, 0, 0), 0.018, 10)], metal)
        part = Assembly()
        tom = part.add("drum", hinge((0, 0, 0), (1, 0, 0), 0.3, -0.3), [([ball_knob(0.016)], metal)])
        part.graft(own, (s * (size + 0.03), 0, 0), None, tom)
        kit.graft(part, tip, None, arm)
    return kit


def drum_kit(dice: Dice) -> list[Body]:
    """Some of: a bass drum with toms, a snare drum, a hi-hat, cymbals and a stool; or one of them alone."""
    kit, metal = Assembly("body"), Look("steel", dice.pick(((192, 194, 198), (60, 60, 64), (150, 150, 154))))
    shell, cover = dice.pick((looks.plastic, looks.wood))(dice), looks.fabric(dice)
    golden = Look("steel", dice.pick(((206, 174, 92), (190, 150, 80), (222, 196, 128))))
    spots = {"bass": (0, 0), "snare": (-0.36, -0.32), "hat": (-0.78, -0.2), "ride": (0.72, 0.15)}
    spots |= {"crash": (-0.7, 0.42), "stool": (0.0, -0.95)}
    most = ("bass", "snare", "hat", "ride", "stool")
    sets = (most, most[:3], ("bass", "ride", "crash"), ("snare",), ("hat",), ("ride",), ("bass",))
    for name in dice.pick((*sets, ("snare", "hat", "stool"), ("hat", "ride", "crash"))):
        if name == "bass":
            part = bass(dice, shell, metal, dice.whole(0, 2))
        elif name == "snare":
            part = snare(dice, shell, metal)
        elif name == "hat":
            part = hi_hat(dice, metal, golden)
        else:
            part = stool(dice, metal, cover) if name == "stool" else cymbal_stand(dice, metal, golden)
        kit.graft(part, (*spots[name], 0))
    return kit.done(rotation(UP, dice.pick((0.0, 0.0, np.pi, 0.4, -0.5))))
