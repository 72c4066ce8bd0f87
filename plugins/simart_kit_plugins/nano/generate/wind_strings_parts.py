"""Brass instruments, and the slides, keys, levers and pegs of wind and stringed instruments."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, unit

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, Z, moved, pointed, rotation, turned
from ...shapes.primitives import box, cylinder, revolve, rod, superquadric, torus, tube
from .assembling import Assembly
from .objects import Body, Look, hinge, slide, spin
from .rigging import ball_knob, lying

RIGHT, LEFT, FRONT, UP = np.eye(3)[0], -np.eye(3)[0], -np.eye(3)[1], np.eye(3)[2]
_BRASS = ((206, 168, 84), (188, 190, 196), (176, 112, 66), (226, 204, 140))


def arc(center: ArrayLike, first: ArrayLike, second: ArrayLike, turn: float = np.pi) -> FloatArray:
    """Points about a center, from center + first towards center + second and on by a turn [rad]."""
    angle = np.linspace(0, turn, max(9, round(4 * turn)))[:, None]
    round_: FloatArray = np.cos(angle) * np.asarray(first) + np.sin(angle) * np.asarray(second)
    return round_ + np.asarray(center, dtype=np.float64)


def basis(along: ArrayLike, out: ArrayLike) -> FloatArray:
    """The turn that takes x to `along` and z to `out`, which are at right angles."""
    first, last = unit(np.asarray(along, dtype=np.float64)), unit(np.asarray(out, dtype=np.float64))
    return np.column_stack([first, np.cross(last, first), last])


def bell(throat: float, mouth: float, long: float, curve: float) -> FloatArray:
    """A flaring, hollow horn about z, from a throat at z = 0 up to its mouth."""
    way = np.linspace(0, 1, 11)
    radius = throat + (mouth - throat) * (0.25 * way**2 + 0.75 * way**curve)
    outer = np.column_stack([radius, long * way])
    inner = np.column_stack([radius * 0.96 - 0.0006, long * way])[:1:-1]
    return revolve([[0, 0], *outer.tolist(), *inner.tolist(), [0, inner[-1, 1]]], 24)


def bow_slide(
    kit: Assembly, ends: tuple[FloatArray, FloatArray], along: ArrayLike, radius: float, reach: float,
    travel: float, look: Look, to: int = 0,
) -> int:  # fmt: skip
    """A bow whose two legs slide out of sleeves that end at `ends`; gives its number."""
    way, (first, second) = np.asarray(along, dtype=np.float64), ends
    half = (first - second) / 2
    turn = arc((first + second) / 2 + reach * way, half, np.linalg.norm(half) * way)
    legs = [rod(end - (travel + 0.003) * way, end + reach * way, 0.8 * radius, 8) for end in ends]
    rings = [rod(end + 0.0012 * way, end + 0.012 * way, 1.25 * radius, 8) for end in ends]
    feet = [rod(end + 0.006 * way, end + reach * way, radius, 8) for end in ends] if reach > 0.008 else []
    kit.fix([rod(end - 0.014 * way, end, 1.2 * radius, 8) for end in ends], look, to)
    parts = [([*legs, *rings, *feet, tube(turn, radius, 8)], look)]
    return kit.add("slide", slide(way, travel), parts, to)


def tipping(
    kit: Assembly, spot: ArrayLike, along: ArrayLike, out: ArrayLike, radius: float,
    arms: tuple[float, float], size: float, look: Look, to: int = 0,
) -> None:  # fmt: skip
    """A lever on a saddle on a tube: a pad behind the saddle, which lifts, and a touch before it."""
    turn, high = basis(along, out), radius + 0.55 * size + 0.003
    back, ahead = arms
    saddle = [box((0.4 * size, 0.14 * size, high - 0.5 * radius), (0, s * 0.42 * size, 0)) for s in (-1, 1)]
    saddle = moved(saddle, (0, 0, (high + 0.5 * radius) / 2 + 0.12 * size))
    hole = cylinder(0.4 * size, 0.5 * radius, 10) + [-back, 0, 0.78 * radius]
    kit.fix(moved(turned([*saddle, hole], turn), spot), look, to)
    bar = tube([(-back, 0, high), (0, 0, high), (0.6 * ahead, 0, high), (ahead, 0, high)], 0.16 * size, 6)
    deep = high - 1.03 * radius - 0.0008
    pad = cylinder(0.5 * size, deep, 12) + [-back, 0, high - deep / 2]
    touch = superquadric((1.1 * size, 0.8 * size, 0.3 * size), 0.6, 0.8, 6) + [ahead, 0, high + 0.1 * size]
    pin = lying(0.13 * size, 1.1 * size, Y, 8) + [0, 0, high]
    shape = moved(turned([bar, pad, touch, pin], turn), spot)
    most = min(0.3, 0.8 * (high - radius - 0.16 * size) / (ahead + 0.55 * size))
    kit.add("lever", hinge(np.asarray(spot) + high * turn[:, 2], turn[:, 1], most), [(shape, look)], to)


def cup_key(
    kit: Assembly, bore: float, spot: tuple[float, float], size: float, look: Look, side: int = 1,
    lift: float = 0.0, touch: float = 0.0, ring: bool = False,
) -> None:  # fmt: skip
    """A key on a tube about z, at a height and an angle: a cup or a ring that tips about a rod beside it.

    One that stands off by `lift` is pressed shut; one without opens, by a touch on the rod's other side.
    """
    height, turn = spot[0], rotation((0, 0, 1), spot[1])
    level, arm, half = bore + 0.0035 + lift, size + 0.0045, 1.1 * size + abs(touch)
    pin = np.array([level + 0.001, side * arm, 0])
    foot = 0.9 * bore * unit(pin)
    hole = pointed(cylinder(0.82 * size, 0.4 * bore + 0.0025, 12), X) + [0.8 * bore + 0.00125, 0, 0]
    posts = [rod(foot + [0, 0, z], pin + [0, 0, z], 0.0014) for z in (-half - 0.0022, half + 0.0022)]
    posts += [ball_knob(0.0024, 8) + pin + [0, 0, z] for z in (-half - 0.0022, half + 0.0022)]
    kit.fix(moved(turned([hole, *posts], turn), (0, 0, height)), look)
    shape = [lying(0.0017, 2 * half - 0.001, Z, 8) + pin, lying(0.0007, 2 * half + 0.003, Z, 6) + pin]
    shape.append(box((0.0022, arm - 0.5 * size, 0.35 * size + 0.001), (level + 0.002, side * arm * 0.62, 0)))
    if ring:
        shape.append(pointed(torus(0.92 * size, 0.0014, 14), X) + [level + 0.0015, 0, 0])
    else:
        shape.append(pointed(cylinder(size, 0.003, 14), X) + [level + 0.0015, 0, 0])
        shape.append(pointed(cylinder(0.55 * size, 0.002, 12), X) + [level + 0.0038, 0, 0])
    if touch:
        across = side * (-0.008 if lift else 0.009)
        leaf = superquadric((0.0026, 0.014, 0.022), 0.5, 0.7, 6)
        shape.append(leaf + pin + [0.0006, across, 0.8 * touch])
    stops = (0.0, -0.9 * lift / (arm + size)) if lift else (0.22, 0.0)
    motion = hinge(turn @ pin + [0, 0, height], (0, 0, side), *stops)
    kit.add("key", motion, [(moved(turned(shape, turn), (0, 0, height)), look)])


def paddles(
    kit: Assembly, spot: ArrayLike, turn: FloatArray, size: tuple[float, float], count: int, look: Look
) -> None:
    """Finger levers side by side on one rod along x, pointing to -y, after a turn."""
    (pitch, long), own = size, Assembly()
    half = count * pitch / 2 + 0.004
    high = 0.35 * long
    posts = [box((0.004, 0.01, high + 0.006), (s * half, 0, -high / 2)) for s in (-1, 1)]
    plate = box((2 * half + 0.004, 0.02, 0.004), (0, 0, -high - 0.004))
    own.fix([*posts, plate, lying(0.0018, 2 * half + 0.005, X, 8)], look)
    for k in range(count):
        x = (k - (count - 1) / 2) * pitch
        collar = lying(0.0042, 0.8 * pitch, X, 10)
        arm = tube([(0, 0.25 * long, -0.004), (0, 0, 0), (0, -0.5 * long, 0.006), (0, -long, 0.002)], 0.0024)
        leaf = superquadric((0.86 * pitch, 1.5 * pitch, 0.005), 0.5, 0.6, 6) + [0, -long, 0.004]
        shape = moved([collar, arm, leaf], (x, 0, 0))
        own.add("lever", hinge((x, 0, 0), (1, 0, 0), 0.22), [(shape, look)])
    kit.graft(own, spot, turn)


def peg(
    dice: Dice, kit: Assembly, spot: ArrayLike, along: ArrayLike, size: float, kind: str, look: Look,
    metal: Look,
) -> None:  # fmt: skip
    """A tuning peg whose shaft leaves a head at a spot: a machine's button, or a friction peg."""
    way = unit(np.asarray(along, dtype=np.float64))
    turn = basis(np.eye(3)[np.abs(way).argmin()], way)
    if kind == "friction":
        shaft = revolve([[0, -2.2], [0.16, -2.2], [0.22, 0.3], [0.3, 0.42], [0.2, 0.6], [0, 0.6]], 10)
        shape = [shaft, superquadric((1.3, 0.4, 1.0), 0.8, 0.9, 8) + [0, 0, 1.0]]
    else:
        shape = [revolve([[0, -0.4], [0.15, -0.4], [0.15, 0.7], [0.3, 0.75], [0.2, 0.9], [0, 0.9]], 10)]
        if kind == "round":
            shape.append(cylinder(0.5, 0.6, 14) + [0, 0, 1.1])
        else:
            edge = 1.0 if kind == "oval" else 0.45
            shape.append(superquadric((1.4, 0.5, 1.0), edge, edge, 7) + [0, 0, 1.3])
        bush = [cylinder(0.34, 0.3, 10) + [0, 0, 0.12]]
        kit.fix(moved(turned([size * piece for piece in bush], turn), spot), metal)
    shape = turned(turned([size * p for p in shape], rotation((0, 0, 1), dice.between(0, 3.1))), turn)
    kit.add("tuning peg", spin(spot, way), [(moved(shape, spot), look)])


def laid(dice: Dice, kit: Assembly, *turns: FloatArray) -> list[Body]:
    """The bodies in one of some poses, then turned about z."""
    return kit.done(rotation(UP, dice.pick((0.0, 0.0, 0.4, -0.5))) @ dice.pick(turns))


def brassy(dice: Dice) -> Look:
    """Brass, silver or copper."""
    return Look("steel", dice.pick(_BRASS))


def _piston(kit: Assembly, spot: FloatArray, radius: float, high: float, travel: float, look: Look) -> None:
    """A valve about z: a casing with caps, and a button on a stem that is pressed into it."""
    caps = [cylinder(1.12 * radius, 0.12 * high, 14) + [0, 0, s * 0.5 * high] for s in (-1, 1)]
    nipple = cylinder(0.35 * radius, 0.05 * high, 10) - [0, 0, 0.57 * high]
    kit.fix(moved([cylinder(radius, high, 14), *caps, nipple], spot), look)
    top = 0.56 * high + travel + 0.002
    stem = rod((0, 0, 0.3 * high), (0, 0, top), 0.28 * radius, 8)
    button = [cylinder(0.8 * radius, 0.003, 14) + [0, 0, top], cylinder(0.4 * radius, 0.004, 10)]
    button[1] = button[1] + [0, 0, top - 0.003]
    pearl = cylinder(0.62 * radius, 0.0024, 14) + [0, 0, top + 0.0015]
    parts = [(moved([stem, *button], spot), look), (moved([pearl], spot), Look("plastic", (238, 234, 226)))]
    kit.add("button", slide(-UP, 0.96 * travel), parts)


def _trumpet_horn(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A trumpet, cornet or flugelhorn along x: a loop of pipe through three valves, and its slides."""
    wide, back, front = dice.between(0.033, 0.044), dice.between(0.1, 0.18), dice.between(0.09, 0.17)
    pipe, flare, pitch = dice.between(0.0055, 0.007), dice.between(0.055, 0.085), 0.0275
    start = -back - dice.between(0.05, 0.14)
    lead = np.array([front, -0.02, wide])
    kit.fix(
        [rod((start, -0.02, wide), lead, pipe, 10), rod((pitch, 0, -wide), (0.03, -0.02, -wide), pipe)], look
    )
    kit.fix([rod((0.03, -0.02, -wide), (front, -0.02, -wide), pipe, 10)], look)
    cup = [
        [0.0, 0.0],
        [0.004, 0],
        [0.0046, 0.05],
        [0.012, 0.062],
        [0.0135, 0.084],
        [0.009, 0.084],
        [0.0, 0.07],
    ]
    kit.fix([pointed(revolve(cup, 16), X) * [-1, 1, -1] + [start, -0.02, wide]], look)
    bow = arc((-back, 0.016, 0), (0, 0.004, -wide), (-wide, 0, 0))
    bow = np.concatenate([[(-pitch, 0, -wide), (-pitch - 0.02, 0.008, -wide)], bow, [(0.02, 0.01, wide)]])
    kit.fix([tube(bow, np.linspace(pipe, 1.5 * pipe, len(bow)), 10)], look)
    horn = bell(1.5 * pipe, flare, front + dice.between(0.07, 0.16), dice.between(5, 9))
    kit.fix([pointed(horn, X) + [0.018, 0.0105, wide]], look)
    for k in (-1, 0, 1):
        _piston(kit, np.array([k * pitch, 0, 0]), 0.0115, dice.pick((0.1, 0.11)), 0.016, look)
    ends = (lead, lead * [1, 1, -1])
    main = bow_slide(kit, ends, RIGHT, 1.05 * pipe, dice.between(0.02, 0.05), dice.between(0.025, 0.04), look)
    if dice.chance(0.7):
        spot = lead + [0.016, 0, -2 * wide]
        tipping(kit, spot, LEFT, -UP, 1.05 * pipe, (0.012, 0.014), 0.01, look, main)
    gap = dice.between(0.009, 0.013)
    for way, valve, reach in ((RIGHT, 1, dice.between(0.02, 0.06)), (LEFT, -1, dice.between(0.005, 0.02))):
        x = way[0] * (pitch + 0.03)
        side = -0.002 if valve > 0 else 0.0
        pair = (np.array([x, side, gap]), np.array([x, side, -gap]))
        kit.fix([rod((valve * pitch, side, p[2]), p, 0.0055, 8) for p in pair], look)
        part = bow_slide(kit, pair, way, 0.0055, reach, 0.014, look)
        if dice.chance(0.6) and reach > 0.02:
            hoop = pointed(torus(0.011, 0.0016, 16), Y) + pair[0] + way * 0.011 + [0, 0, 0.0175]
            kit.fix([hoop], look, part)
    pair = (np.array([0, 0.026, gap - 0.018]), np.array([0, 0.026, -gap - 0.018]))
    kit.fix([rod(p * [1, 0, 1], p, 0.005, 8) for p in pair], look)
    bow_slide(kit, pair, -FRONT, 0.005, 0.003, 0.012, look)
    hook = arc((0.055, -0.02, wide + 0.014), (0, 0, -0.012), (0.012, 0, 0), 4.2)
    kit.fix([tube(hook, 0.0018), box((0.002, 0.014, 2 * wide), (0.055, -0.008, 0))][: dice.whole(0, 2)], look)
    return laid(dice, kit, np.eye(3), rotation(RIGHT, np.pi / 2), rotation((0, 1, 0), np.pi / 2))


def _trombone(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A long slide of two legs with braces, and a bell with a tuning slide; some have a thumb valve."""
    long, wide, pipe = dice.between(0.5, 0.68), dice.between(0.04, 0.055), dice.between(0.007, 0.0085)
    inner = [rod((-0.12, 0, s * wide), (long, 0, s * wide), 0.82 * pipe, 10) for s in (-1, 1)]
    inner += [rod((-0.12, 0, s * wide), (-0.02, 0, s * wide), 1.3 * pipe, 10) for s in (-1, 1)]
    kit.fix([*inner, rod((-0.05, 0, -wide), (-0.05, 0, wide), 0.006, 8)], look)
    cup = [[0.0, 0.0], [0.006, 0], [0.007, 0.05], [0.018, 0.066], [0.0195, 0.09], [0.013, 0.09], [0.0, 0.075]]
    kit.fix([pointed(revolve(cup, 16), X) * [-1, 1, -1] + [-0.12, 0, wide]], look)
    bend = arc((long, 0, 0), (0, 0, wide), (wide, 0, 0))
    outer = tube(np.concatenate([[(0.0, 0, wide)], bend, [(0.0, 0, -wide)]]), pipe, 10)
    rings = [rod((0, 0, s * wide), (0.03, 0, s * wide), 1.3 * pipe, 10) for s in (-1, 1)]
    brace = rod((0.015, 0, -wide), (0.015, 0, wide), 0.005, 8)
    bumper = [rod((long + wide, 0, 0), (long + wide + 0.02, 0, 0), 0.005, 8)] if dice.chance(0.5) else []
    moving = [outer, *rings, brace, *bumper]
    main = kit.add("slide", slide(RIGHT, 0.9 * long), [(moving, look)])
    tipping(kit, (long - 0.03, 0, -wide), LEFT, -UP, pipe, (0.02, 0.02), 0.014, look, main)
    side, rear, apart = dice.sign(), dice.between(0.24, 0.36), dice.between(0.08, 0.11)
    low, fare = np.array([-rear, 0, -wide]), np.array([-rear, side * 2 * apart, -wide])
    kit.fix([rod(low, (-0.12, 0, -wide), 1.1 * pipe, 10)], look)
    bow_slide(kit, (low, fare), LEFT, 1.15 * pipe, dice.between(0.01, 0.08), 0.05, look)
    far = long * dice.between(0.1, 0.5)
    horn = bell(1.3 * pipe, dice.between(0.09, 0.125), rear + far, dice.between(4, 8))
    kit.fix([pointed(horn, X) + fare], look)
    kit.fix([rod((x, 0, -wide), (x, side * 2 * apart, -wide), 0.005, 8) for x in (-0.14, 0.06 - rear)], look)
    if dice.chance(0.5):
        spot = np.array([0.03 - rear, side * apart, -wide])
        kit.fix([pointed(cylinder(0.022, 0.045, 16), X) + spot], look)
        pair = (spot + [0, -0.016 * side, 0.03], spot + [0, 0.016 * side, 0.03])
        kit.fix([rod(p - [0, 0, 0.03], p, 0.0085, 8) for p in pair], look)
        bow_slide(kit, pair, UP, 0.0085, dice.between(0.04, 0.12), 0.024, look)
        turn = basis(-side * FRONT, UP)
        tipping(kit, (-0.13, side * 0.025, -wide), turn[:, 0], UP, 0.005, (0.015, 0.026), 0.016, look)
    return laid(dice, kit, np.eye(3), rotation(RIGHT, np.pi / 2), rotation((0, 1, 0), -np.pi / 2))


def _tuba(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A wide pipe that winds up to a bell, with pistons or with levers before it, and slides below them."""
    scale, count = dice.between(0.55, 1.0), dice.whole(3, 4)
    wide, high, pipe = 0.16 * scale, dice.between(0.5, 0.62) * scale, 0.075 * scale
    path = [np.array([(wide, 0, high)]), arc((0, 0, 0), (wide, 0, 0), (0, 0, -wide))]
    path += [arc((-0.15 * wide, 0, high - wide), (-0.85 * wide, 0, 0), (0, 0, 0.85 * wide), 2.9)]
    path.append(np.array([(0.35 * wide, -0.3 * pipe, 0.5 * high), (0.3 * wide, -pipe, 0.3 * high)]))
    line = np.concatenate(path)
    kit.fix([tube(line, np.linspace(pipe, 0.25 * pipe, len(line)), 14)], look)
    horn = bell(pipe, dice.between(0.17, 0.24) * scale, dice.between(0.35, 0.5) * scale, dice.between(2, 5))
    kit.fix([horn + [wide, 0, high - 0.001]], look)
    front, pitch, tall = -1.9 * pipe - 0.02, 0.045 * scale, dice.between(0.12, 0.15) * scale
    spots = [np.array([(k - (count - 1) / 2) * pitch, front, 0.3 * high]) for k in range(count)]
    kit.fix([rod(spots[0], spots[-1], 0.012 * scale, 8)], look)
    kit.fix([rod((0.3 * wide, -pipe, 0.3 * high), spots[-1], 0.012 * scale, 8)], look)
    pistons = dice.chance(0.5)
    for spot in spots:
        if pistons:
            _piston(kit, spot, 0.019 * scale, tall, 0.024 * scale, look)
        else:
            drums = [cylinder(0.021 * scale, 0.05 * scale, 16), cylinder(0.012 * scale, 0.06 * scale, 12)]
            kit.fix([pointed(piece, Y) + spot for piece in drums], look)
    if not pistons:
        seat = np.array([0, front - 0.03, 0.3 * high + 0.09 * scale])
        kit.fix([box((0.02, 0.012, 0.1 * scale), seat - [0, -0.028, 0.055 * scale])], look)
        kit.fix([box((0.02, 0.06, 0.006), seat - [0, -0.005, 0.021 + 0.006])], look)
        paddles(kit, seat, np.eye(3), (0.024, dice.between(0.045, 0.065)), count, look)
    for k, spot in enumerate(spots):
        low = spot - [0, 0, (0.62 if pistons else 0.3) * tall]
        pair = (low + [0, 0.4 * pitch, -0.02], low - [0, 0.4 * pitch, 0.02])
        kit.fix([rod(p + [0, 0, 0.45 * tall], p, 0.0075 * scale, 8) for p in pair], look)
        bow_slide(kit, pair, -UP, 0.0075 * scale, dice.between(0.01, 0.04 + 0.03 * k), 0.03 * scale, look)
    lead = np.array([(-1.3, 0.4), (-1.3, 0.4), (-1.3, 0.9), (-0.9, 1.0)])[:, [0, 0, 1]] * [wide, 0, high]
    lead += [(0, front, 0), (0, front, 0), (0, front, 0), (0, front - 0.08, 0)]
    lead[0] = spots[0]
    kit.fix([tube(lead, 0.009 * scale, 8), rod(lead[1], (-wide, 0, 0.4 * high), 0.005)], look)
    cup = revolve([[0.0, 0.0], [0.011, 0.0], [0.02, 0.03], [0.014, 0.03], [0.0, 0.01]], 14)
    kit.fix([turned([cup], basis((1, 0, 0), -FRONT) @ rotation(RIGHT, np.pi))[0] + lead[-1]], look)
    return laid(dice, kit, np.eye(3), rotation(RIGHT, np.pi / 2))


def _french_horn(dice: Dice, kit: Assembly, look: Look) -> list[Body]:
    """A round coil of pipe with rotary valves in it, finger levers, slides across it and a wide bell."""
    size = dice.between(0.12, 0.16)
    coil = [
        arc((0, 0.03, 0), (size, 0, 0), (0, 0, size), 4.6),
        arc((0, 0, 0), (0, 0, -size), (0.9 * size, 0, 0), 5.6),
    ]
    coil += [arc((0, -0.03, 0), (-0.8 * size, 0, 0), (0, 0, 0.8 * size), 4.0)]
    for line, first, last in zip(coil, (0.02, 0.0085, 0.007), (0.0095, 0.0075, 0.006), strict=True):
        kit.fix([tube(line, np.linspace(first, last, len(line)), 10)], look)
    horn = bell(0.02, dice.between(0.13, 0.16), dice.between(0.24, 0.32), dice.between(2.5, 5))
    kit.fix([turned([horn], rotation(RIGHT, np.pi))[0] + [size, 0.03, 0.002]], look)
    count, pitch = dice.whole(3, 4), 0.038
    for k in range(count):
        spot = np.array([(k - (count - 1) / 2) * pitch, 0, 0.05])
        drums = [cylinder(0.016, 0.04, 16), cylinder(0.01, 0.05, 12)]
        kit.fix([pointed(piece, Y) + spot for piece in drums], look)
        pair = (spot + [-0.009, 0, -0.045], spot + [0.009, 0, -0.045])
        kit.fix([rod(p + [0, 0, 0.036], p, 0.006, 8) for p in pair], look)
        bow_slide(kit, pair, -UP, 0.006, dice.between(0.01, 0.03), 0.025, look)
    kit.fix([rod((-0.85 * size, 0, 0.05), (0.85 * size, 0, 0.05), 0.0065, 8)], look)
    kit.fix(
        [rod((0, 0, -size), (0, 0, -0.9 * size), 0.004), rod((0, -0.03, 0.8 * size), (0, 0.03, size), 0.004)],
        look,
    )
    seat = np.array([-size - 0.045, -0.01, 0.04])
    paddles(kit, seat, rotation(UP, -np.pi / 2), (0.022, dice.between(0.04, 0.055)), count, look)
    kit.fix([box((0.05, 0.02, 0.004), seat + [0.02, 0, -0.023])], look)
    end = coil[2][-1]
    lead = np.array([end, [-0.9 * size, -0.05, 1.1 * size], [-1.6 * size, -0.06, 1.5 * size]])
    kit.fix([tube(lead, 0.0055, 8), cylinder(0.01, 0.02, 12) + lead[-1]], look)
    return laid(dice, kit, rotation(RIGHT, np.pi / 2), rotation(RIGHT, -np.pi / 2), np.eye(3))


def trumpet(dice: Dice) -> list[Body]:
    """A trumpet, a trombone, a tuba or a horn."""
    kit, look = Assembly("body"), brassy(dice)
    make = dice.weighted([(4, _trumpet_horn), (3, _trombone), (3, _tuba), (2, _french_horn)])
    return make(dice, kit, look)
