"""Bottles, cans, tubes and cylinders, made in units of the radius of a neck or a body, then scaled."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, Y, Z, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, revolve, rod, superquadric, torus, tube
from . import looks
from .assembling import Assembly, disc
from .category import Category
from .fittings import sleeve_of
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import axle_wheel, lying, ribbon, upright_ring

Coats = tuple[Look, Look]  # of what a cap sits on, and of the cap
_NECK = revolve([(0, 0), (1, 0), (1, 1), (0.84, 1), (0.84, 0.12), (0, 0.12)], 22)  # with a hole
_SAME, _FORWARD = np.eye(3), rotation((1, 0, 0), np.pi / 2)  # the latter leads z to -y


def _two(piece: FloatArray, x: float, y: float = 0.0, z: float = 0.0) -> Pieces:
    """A piece at either side of x, or at either of y where x is 0."""
    return [piece + [s * x, y if x else s * y, z] for s in (-1, 1)]


def _hull(dice: Dice, skin: FloatArray, size: FloatArray, neck: float, rise: float, most: int) -> FloatArray:
    """A body on z = 0, plain (`most` 4) or (7) grooved, waisted, tapered, with shoulders up to its neck."""
    up, foot, arc = np.linspace(0.02, 1, 15), dice.between(0.7, 1.0), np.linspace(0, np.pi / 2, 7)
    waist, taper = 1 - 0.15 * np.exp(-(((up - 0.6) / 0.2) ** 2)), foot + (1 - foot) * up
    share = dice.pick(([0 * up + 1] * 4 + [1 - 0.04 * (np.arange(15) % 2), waist, taper])[:most])
    ease = dice.pick((np.cos(arc), np.cos(arc) ** 2, 1 - arc * 2 / np.pi))
    lift = np.sin(arc) if ease[3] > 0.6 else arc * 2 / np.pi
    lower = np.column_stack([np.outer(share, size[:2]), up * (size[2] - rise)])
    sides = 2 * neck + np.outer(ease, size[:2] - 2 * neck)
    upper, ends = np.column_stack([sides, size[2] - rise + rise * lift]), np.outer([0, 1], size) * [0, 0, 1]
    return loft(skin, np.vstack([ends[:1], lower[:1] * [0.93, 0.93, 0], lower, upper, ends[1:]]))


def _cap(dice: Dice, room: float, more: float = 0.0, calm: bool = False) -> Pieces:
    """A cap over a neck, with what fingers turn it by; `calm` ones have nothing on top."""
    outer, high = dice.between(1.17, 1.35), room + dice.between(0.12, 0.3) + more
    top, edge = outer * dice.between(0.65 if more else 0.88, 1.0), room + 0.6 * (high - room)
    wall = [(1.09, 0), (outer, 0), (outer, room), (top, edge), (0.93 * top, high), (0, high)]
    cap: Pieces = [revolve([*wall, (0, room), (1.09, room), (1.09, 0)], 24)]
    rib = tube([(outer, 0, 0.08 * room), (outer, 0, room), (top, 0, edge)], dice.between(0.03, 0.08), 4)
    lobe = cylinder(0.18, 0.9 * room, 8) + [1.05 * outer, 0, 0.47 * room]
    wing = box((0.9, 0.25, 0.6 * room), (1.25 * outer, 0, 0.5 * room))
    nut = dice.pick((cylinder(0.7 * top, 0.6, 6), box((1.7 * top, 0.3 * top, 0.6)))) + [0, 0, high + 0.3]
    few = [(6, (rib, dice.whole(10, 28))), (2, (lobe, dice.whole(5, 10)))]
    piece, count = dice.weighted([*few, (1.5, (wing, dice.whole(2, 4))), (1, (nut, 1))][: 2 if calm else 4])
    return cap + around([piece], count)


def _screw(dice: Dice, coats: Coats, tall: float, more: float = 0.0, calm: bool = False) -> Assembly:
    """A neck, its thread or tamper ring in sight, and body 1, a cap that turns on it."""
    kit, low, turn = Assembly(), tall * dice.between(0.2, 0.4), np.linspace(0, 6 * np.pi, 43)
    thread = tube(np.column_stack([np.cos(turn), np.sin(turn), np.linspace(0.1, 0.9, 43) * tall]), 0.05, 4)
    ring = sleeve_of(0.98, dice.between(1.15, 1.25), 0.5 * low, 22) + [0, 0, 0.3 * low]
    kit.fix([_NECK * [1, 1, tall], thread if dice.chance(0.55) else ring], coats[0])
    cap = moved(_cap(dice, 1.03 * tall - low, more, calm), (0, 0, low))
    kit.add("cap", spin((0, 0, low), (0, 0, 1)), [(cap, coats[1])])
    return kit


def _flip(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A smooth collar that stays, over a spout a lid on a hinge at its back with a lip in front."""
    kit, look, room, spot = Assembly(), coats[1], dice.between(0.25, 0.5), dice.pick((0.0, -0.3))
    kit.fix([cylinder(1.1, tall, 22) + [0, 0, tall / 2], cylinder(0.25, 0.2) + [0, spot, tall + 0.1]], look)
    wall = [(0.95, 0), (1.1, 0), (1.1, room), (1, 1.3 * room), (0, 1.3 * room + dice.between(0.1, 0.3))]
    lid = [revolve([*wall, (0, room), (0.95, room), (0.95, 0)], 22), box((0.6, 0.3, 0.14), (0, -1.15, 0.12))]
    pin = np.array([0, 1.18, tall + 0.05])
    kit.fix(moved(_two(lying(0.1, 0.24), 0.4), pin), look)
    parts = [([*moved(lid, (0, 0, tall + 0.05)), lying(0.1, 0.5) + pin], look)]
    kit.add("lid", hinge(pin, (-1, 0, 0), dice.between(1.6, 2.5)), parts)
    return kit


def _plug(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A cork or a stopper that stands in the neck and is drawn out."""
    kit, deep, out, cork = Assembly(), tall * dice.between(0.4, 0.8), dice.between(0.4, 1.2), dice.chance(0.6)
    kit.fix([_NECK * [1, 1, tall], torus(1, dice.between(0.08, 0.2)) + [0, 0, 0.95 * tall - 0.2]], coats[0])
    size = np.array([2.4, 2.4, dice.between(0.6, 0.9) if cork else dice.between(1.5, 4.0)])
    head = superquadric(size, dice.pick((0.3, 1.0, 1.8)), dice.pick((0.5, 1.0)))
    plug = [revolve([(0, -deep), (0.72, -deep), (0.8, out), (0, out)], 18)]
    plug += [] if cork and deep > 1 else [head + [0, 0, out + 0.45 * size[2]]]
    parts = [(moved(plug, (0, 0, tall)), Look("wood", (190, 150, 105)) if cork else coats[0])]
    kit.add("stopper", slide((0, 0, 1), deep + 0.5), parts)
    return kit


def _swing_top(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A stopper on a wire that tips back about pins, and a wire lever at the front that holds it down."""
    kit, steel, z, low = Assembly(), looks.metal(dice), tall - 0.3, tall - dice.between(1.3, 2.3)
    kit.fix([_NECK * [1, 1, tall]], coats[0])
    lugs = boxes((0.12, 0.6, 0.2), [(x, y, z) for x in (-0.6, 0.6) for y in (-1.1, 1.1)])
    kit.fix([lugs, *_two(lying(0.07, 2.2), 0, 1.35, z), torus(1.02, 0.09, 20) + [0, 0, z]], steel)
    line = [(0, -0.2), (0.6, -0.2), (0.65, 0), (1.1, 0.1), (1.05, 0.4), (0.5, 1), (0, 1.1)]
    spots = [(1.35, z), (1.35, tall + 0.5), (-1.1, tall + 0.5)]
    wire = tube([*((1, *yz) for yz in spots), *((-1, *yz) for yz in spots[::-1])], 0.08)
    parts = [([wire], steel), ([revolve(line, 20) + [0, 0, tall + 0.07]], looks.ceramic(dice))]
    kit.add("stopper", hinge((0, 1.35, z), (-1, 0, 0), dice.between(1.3, 2.0)), parts)
    hook = tube([(-0.9, -1.35, z), (-0.9, -1.6, low), (0.9, -1.6, low), (0.9, -1.35, z)], 0.08)
    grip = [hook, rod((0, -1.6, low), (0, -1.9, low - 0.5), 0.14)]
    kit.add("lever", hinge((0, -1.35, z), (-1, 0, 0), dice.between(1.0, 1.5)), [(grip, steel)])
    return kit


def _sport(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A screw cap with a spout to pull or to raise on it, or a bow to carry, or both."""
    kit, look = _screw(dice, coats, tall, dice.between(0.2, 0.5), calm=True), looks.plastic(dice)
    top, kind = kit.points(1).max(axis=0) * [0, 0, 1], dice.weighted([(3, "pull"), (3, "straw"), (2, "")])
    z, wide = float(top[2]) - 0.1, 1.08 * float(np.abs(kit.points(1)[:, :2]).max())
    if kind == "pull":
        kit.fix([cylinder(0.24, 0.6, 14) + top + [0, 0, 0.28]], coats[1], 1)
        wall = [(0.26, 0), (0.5, 0), (0.38, 0.25), (0.36, 0.7), (0.5, 0.8), (0.46, 1.0), (0, 1.05), (0, 0.65)]
        spout = revolve([*wall, (0.26, 0.65), (0.26, 0)], 18) + top + [0, 0, 0.05]
        kit.add("spout", slide((0, 0, 1), 0.3), [([spout], look)], 1)
    elif kind == "straw":
        pin = top + [0, 0.4, 0.26]
        kit.fix(moved(_two(box((0.1, 0.5, 0.5)), 0.34, 0, -0.05), pin), coats[1], 1)
        straw = [rod((0, 0.15, 0), (0, -1.1, 0), 0.2, 12), lying(0.1, 0.9)]
        kit.add("spout", hinge(pin, (-1, 0, 0), 1.5), [(moved(straw, pin), look)], 1)
    if not kind or dice.chance(0.4):
        kit.fix(_two(lying(0.11, 0.7), wide - 0.15, 0, z), coats[1], 1)
        angle, lean = np.linspace(0, np.pi, 13), dice.pick((0.0, 0.0, 0.9, -0.9))
        bow = np.column_stack([(wide + 0.1) * np.cos(angle), 0 * angle, 1.9 * np.sin(angle) ** 0.7])
        loop = moved(turned([tube(bow, 0.09, 8)], rotation((1, 0, 0), lean)), (0, 0, z))
        kit.add("handle", hinge((0, 0, z), (1, 0, 0), 1.2 - lean, -1.2 - lean), [(loop, look)], 1)
    return kit


def _cup(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A smooth measuring cup over a neck, with a wide rim to lift it off by."""
    kit, high, rim = Assembly(), tall * dice.between(1.2, 2.5), dice.between(1.4, 1.7)
    kit.fix([_NECK * [1, 1, tall], cylinder(0.95 * rim, 0.1, 20)], coats[0])
    wall = [(1.1, 0), (rim, 0), (rim, 0.1), (1.2, 0.15), (1.1, high), (0, high), (0, high - 0.1)]
    cup = revolve([*wall, (1, high - 0.1), (1.1, 0)], 22) + [0, 0, 0.08]
    kit.add("cap", free(), [([cup], coats[1])])
    return kit


_Row = tuple[float, float, float, float, float, Sequence[Callable[[Dice, Coats, float], Assembly]]]
# Width, height by width, neck by width, length of the neck by its radius, shoulders by height, and tops.
_BOTTLES: tuple[_Row, ...] = (
    (0.07, 3.0, 0.37, 1.0, 0.24, (_screw, _screw, _sport, _flip)),
    (0.075, 2.6, 0.35, 3.0, 0.26, (_plug, _plug, _screw, _swing_top, _swing_top)),
    (0.045, 1.7, 0.6, 0.8, 0.12, (_screw, _screw, _flip, _plug)),
    (0.08, 2.7, 0.7, 0.6, 0.1, (_sport, _sport, _screw)),
    (0.1, 1.8, 0.38, 0.9, 0.2, (_flip, _screw, _cup)),
    (0.12, 1.2, 0.3, 1.8, 0.45, (_plug, _plug, _swing_top)),
)


def _filled(dice: Dice, rows: Sequence[_Row]) -> Assembly:
    """A bottle of one of the kinds in a table."""
    kit, (*sizes, tops) = Assembly(), dice.pick(rows)
    look = dice.pick((looks.glass, looks.glass, looks.plastic, looks.painted_metal, looks.ceramic))(dice)
    wide, slim, mouth, long, rise = (size * dice.between(0.7, 1.35) for size in sizes)
    high, flat = wide * slim, dice.pick((1.0, 1.0, 1.0, dice.between(1.2, 2.0)))
    neck, square = wide / flat * mouth / 2, rounded(dice.between(0.08, 0.3) / flat, flat)
    outline = dice.weighted([(4, ngon(24)), (3, square), (0.7, ngon(dice.pick((6, 8)))), (0.5, SQUARE)])
    kit.fix([_hull(dice, outline, np.array([wide, wide / flat, high]), neck * 1.02, high * rise, 7)], look)
    coats = (look, looks.metal(dice) if dice.chance(0.3) else looks.plastic(dice))
    kit.graft(dice.pick(tops)(dice, coats, long), (0, 0, high), neck * _SAME)
    return kit


def _bottle(dice: Dice) -> list[Body]:
    return _filled(dice, _BOTTLES).done()


def _jerry_can(dice: Dice) -> list[Body]:
    """A can with bars to carry that stay, a cap or a spout that turns, some with a vent cap or what folds."""
    kit, side, narrow = Assembly(), dice.sign(), dice.between(0.8, 0.97)
    coats = ((looks.painted_metal if dice.chance(0.4) else looks.plastic)(dice), looks.plastic(dice))
    wide, high, thick = dice.between(0.16, 0.42), dice.between(0.18, 0.5), dice.between(0.007, 0.012)
    deep, wall, half = wide * dice.between(0.45, 0.8), high * dice.between(0.86, 0.99), narrow * wide / 2
    rows = [(0, 0), (0.95, 0), (1, 0.02 * high), (1, wall), (narrow, high), (0, high)]
    kit.fix([loft(rounded(0.12, wide / deep), [(f * wide, f * deep, z) for f, z in rows])], coats[0])
    ribs = box((0.7 * wide, 0.01, 0.7 * wall)) * [1, 1, dice.pick((1.0, 0.1, 0.02))]
    kit.fix(_two(ribs, 0, deep / 2, wall / 2), coats[0])
    radius = min(0.09 * wide, 0.24 * narrow * deep) * dice.between(0.7, 1.1)
    small, tilt, bent = radius * dice.pick((0, 0.5)) * (wide > 0.25), dice.pick((0.0, 0.4)), dice.chance(0.35)
    mouth = _screw(dice, coats, 1.0, calm=bent)
    if bent:
        top = mouth.points(1).max(axis=0) * [0, 0, 1]
        reach = np.array([side * dice.between(1.0, 3.0), 0, dice.between(3.0, 6.0)])
        path = np.array([(0, 0, -0.02), (0, 0, 0.3), (0.5, 0, 0.7), (1, 0, 1)]) * reach
        mouth.fix([tube(path + top, np.array([0.7, 0.55, 0.45, 0.38]), 12)], coats[1], 1)
        mouth.graft(_screw(dice, coats[::-1], 1.4), top + reach, 0.36 * rotation((0, 1, 0), 0.5 * side), 1)
    at = (side * (half - 1.7 * radius), 0, high - tilt * radius)
    kit.graft(mouth, at, radius * rotation((0, 1, 0), side * tilt))
    if small:
        kit.graft(_screw(dice, coats, 1.0), (1.9 * small * side - side * half, 0, high), small * _SAME)
    rise, y = high + dice.between(0.035, 0.055), dice.pick((0.0, 0.25 * deep))
    ends = sorted((side * (half - 4.0 * radius), side * (0.02 + 3.8 * small - half)))
    posts = [box((2 * thick, 2 * y + 1.8 * thick, rise - high), (x, 0, (high + rise) / 2)) for x in ends]
    bars = [rod((ends[0], s, rise), (ends[1], s, rise), thick, 8) for s in {-y, y}]
    kit.fix([*posts, *bars], coats[0])
    if dice.chance(0.4):
        pin, t = np.array([side * (wide / 2 + radius), 0, wall - 0.03]), radius / 2
        cheeks = _two(box((2.6 * t, 0.4 * t, 2 * t)), 0, 1.4 * t)
        kit.fix([*moved(cheeks, pin - [0.8 * side * t, 0, 0]), lying(0.35 * t, 4.2 * t, Y) + pin], coats[0])
        path = np.outer([-0.12, 0.4, 0.45, 1.0], [0, 0, -min(0.6 * wall, 12 * t)]) + pin
        spout = tube(path, t * np.array([0.9, 0.9, 0.65, 0.55]), 12)
        kit.add("spout", hinge(pin, (0, -side, 0), dice.between(1.6, 2.4)), [([spout], coats[1])])
    return kit.done(rotation((0, 0, 1), dice.pick((0.0, 0.0, np.pi / 2))))


def _squeeze_tube(dice: Dice) -> list[Body]:
    """A tube, its shoulder at z = 0, with a cap or a lid; some with a key that winds it up."""
    kit, slim, kind = Assembly(), dice.between(4.0, 7.5), dice.pick(("neck", "neck", "big", "flip", "flip"))
    coats = (dice.pick((looks.plastic, looks.metal))(dice), looks.plastic(dice))
    neck = dice.between(0.3, 0.55) if kind == "neck" else dice.between(0.75, 0.85)
    tail, end, share = 2 * dice.between(1.1, 1.4), slim * dice.between(0.05, 0.12), np.linspace(0, 1, 9)
    full, rise = share ** dice.between(0.5, 1.6), slim + dice.between(0.1, 0.5) * (1 - neck)
    rows = np.column_stack([tail + (2 - tail) * full, np.maximum(0.08, 2 * full), share * slim - rise])
    skin = loft(ngon(24), [(0, 0, -rise), *rows, (2 * neck, 2 * neck, 0), (0, 0, 0)])
    kit.fix([skin, box((tail, 0.13, end), (0, 0, end / 2 - rise))], coats[0])
    tall, more = dice.between(0.5, 0.9) * (2.0 if kind == "neck" else 1), dice.pick((0.0, 0.4, 1.0))
    top = _flip(dice, coats, tall) if kind == "flip" else _screw(dice, coats, tall, more, calm=True)
    kit.graft(top, turn=neck * _SAME)
    if dice.chance(0.35):
        at, grip = np.array([0, 0, -rise - 0.32]), dice.between(0.8, 1.3)
        wing = box((1.6 * grip, 0.15, dice.between(1.4, 2.2) * grip), (tail / 2 + 0.5 + 0.8 * grip, 0, 0))
        stem = rod((0, 0, 0), (tail / 2 + 0.6, 0, 0), 0.16)
        key = [lying(0.28, tail), *_two(lying(0.42, 0.15), tail / 2 + 0.1), wing, stem]
        kit.add("winding key", spin(at, (1, 0, 0)), [(moved(key, at), looks.metal(dice))])
    lie = dice.pick((np.pi, np.pi, np.pi / 2, np.pi / 2, 0.0))
    return kit.done(dice.between(0.009, 0.03) * rotation((1, 0, 0), lie))


def _gauge(dice: Dice, kit: Assembly, face: FloatArray, radius: float) -> None:
    """A dial that looks to -y, and a needle on it."""
    kit.fix([disc(radius, 0.6 * radius, 20) + face + [0, 0.6 * radius, 0]], looks.metal(dice))
    hand = [box((0.12, 0.1, 0.85), (0, -0.2, 0.26)) * radius, disc(0.2, 0.3, 8) * radius]
    parts = [(moved(hand, face - [0, 0.02, 0]), Look("plastic", (180, 30, 30)))]
    kit.add("pointer", hinge(face, (0, 1, 0), 1.8, -1.8), parts)


def _valve(dice: Dice, regulated: bool) -> Assembly:
    """A block with a handwheel and an outlet to -y, which a cap closes or a regulator sits on."""
    kit, brass, coats = Assembly(), Look("steel", (200, 170, 95)), (looks.metal(dice), looks.plastic(dice))
    wide, axis = dice.between(1.4, 2.1), dice.pick((X, Z, Z))
    kit.fix([cylinder(1, 3, dice.pick((4, 6, 16))) + [0, 0, 1.5], disc(0.6, 1.6) + [0, -0.4, 1.6]], brass)
    arms = around([rod((0, 0, 0), (wide, 0, 0), 0.22)], dice.whole(3, 6))
    lobes = around([cylinder(0.3, 0.8, 8) + [wide, 0, 0]], dice.whole(6, 12))
    wheel = dice.pick(([torus(wide, 0.3), cylinder(0.6, 0.9), *arms], [cylinder(wide, 0.8, 20), *lobes]))
    at = np.array([1.9, 0, 2.4] if axis == X else [0, 0, dice.between(3.7, 4.5)])
    kit.fix([rod((0, 0, 2.4), at, 0.3, 8)], brass)
    parts = [([pointed(piece, axis) + at for piece in wheel], coats[1])]
    kit.add("handle wheel", spin(at, np.eye(3)[axis]), parts)
    if not regulated:
        kit.graft(_screw(dice, (brass, coats[0]), 1.2), (0, -1.9, 1.6), 0.6 * _FORWARD)
        return kit
    kit.fix(moved([disc(0.9, 1, 6), disc(1.6, 1.8, 20) - [0, 0.9, 0]], (0, -1.9, 1.6)), brass)
    kit.fix([rod((0, -3.4, 1.6), (x, -3.6, z), 0.35) for x, z in ((-1.7, 3.4), (1.7, 3.4), (0, -1.2))], brass)
    kit.graft(_screw(dice, (brass, coats[1]), 1.0, 0.6), (0, -4.6, 1.6), dice.between(0.7, 1.0) * _FORWARD)
    for x in (-1.7, 1.7):
        _gauge(dice, kit, np.array([x, -4.0, 3.4]), 1.3)
    return kit


def _cylinder(dice: Dice, slim: float, kind: str) -> Assembly:
    """A cylinder on a foot with a valve, a regulator too, a guard about it, or a bell over it."""
    kit, coat, foot, dome = Assembly(), looks.painted_metal(dice), 0.2, dice.between(0.3, 0.9)
    arc, z = np.linspace(0, np.pi / 2, 7), slim + 0.97 * dome
    low = np.column_stack([np.sin(arc), foot + 0.3 - 0.3 * np.cos(arc)])
    skin = revolve(np.vstack([low, np.column_stack([np.cos(arc), slim + dome * np.sin(arc)])]), 24)
    kit.fix([skin, sleeve_of(0.75, 0.82, foot + 0.15, 20), cylinder(0.3, 0.2, 16) + [0, 0, z]], coat)
    kit.fix([torus(1, 0.03, 24) + [0, 0, slim * f] for f in dice.pick(((), (1,), (0.5,), (0.2, 1)))], coat)
    top = _valve(dice, kind == "regulator")
    if kind == "bell":
        top = _screw(dice, (coat, looks.painted_metal(dice)), 0.8, dice.between(0.8, 1.6), calm=True)
    kit.graft(top, (0, 0, z), (0.4 if kind == "bell" else dice.between(0.15, 0.2)) * _SAME)
    if kind == "guard":
        high, wide = dice.between(0.7, 1.1), dice.between(0.3, 0.7)
        plates = around([box((0.05, wide, high)) + [0.66, 0, z - 0.55 + high / 2]], 3, np.pi / 2)
        kit.fix([*plates, torus(0.68, 0.06, 24) + [0, 0, z - 0.55 + high]], coat)
    return kit


def _trolley(dice: Dice, kit: Assembly, half: float, slim: float) -> None:
    """A frame on two wheels behind things of radius 1 that are `half` as wide as it."""
    look, big, high, y = looks.painted_metal(dice), dice.between(0.6, 1.1), slim + dice.between(0.5, 3.0), 1.3
    hub, path = np.array([half + 0.7, y, big - 0.1]), [(0.8, y, 0), (0.8, y, high), (0.7, y + 1, high + 1)]
    frame = np.vstack([np.array(path) * [half, 1, 1], np.array(path[::-1]) * [-half, 1, 1]])
    band = ribbon([(-half, y), (-half, -1.06), (half, -1.06), (half, y), (-half, y)], 0.06, 0.2)
    kit.fix([tube(frame, 0.12, 8), band + [0, 0, 0.3 * slim], band + [0, 0, 0.75 * slim]], look)
    kit.fix([box((2 * half, 2.6, 0.1), (0, 0.2, -0.06)), lying(0.1, 2 * half + 2.0) + hub * [0, 1, 1]], look)
    for at in (hub, hub * [-1, 1, 1]):
        kit.add("wheel", spin(at, (1, 0, 0)), [(moved(axle_wheel(dice, big), at), looks.rubber(dice))])


def _gas_cylinder(dice: Dice) -> list[Body]:
    """One that stands, or one or two on a trolley."""
    kit, rolls, radius = Assembly(), dice.chance(0.35), dice.between(0.06, 0.13)
    slim = dice.between(1.2, 3.0) if dice.chance(0.5) and not rolls else dice.between(4.0, 9.0)
    count, kinds = dice.whole(1, 2) if rolls else 1, ("regulator", "regulator", "bell", "guard", "guard", "")
    for k in range(count):
        kit.graft(_cylinder(dice, slim, dice.pick(kinds)), ((k - (count - 1) / 2) * 2.3, 0, 0))
    if rolls:
        _trolley(dice, kit, 1.15 * count, 0.9 * slim)
    return kit.done((radius if slim > 3 else 1.3 * radius) * _SAME)


def _squeeze_head(dice: Dice, look: Look) -> Assembly:
    """A block with a handle to +x, a lever above it about a pin, a safety pin in cheeks, and a gauge."""
    kit, steel, wide, long = Assembly(), looks.metal(dice), dice.between(0.9, 1.3), dice.between(5.0, 8.0)
    kit.fix([cylinder(1.1, 2.4, dice.pick((6, 16))) + [0, 0, 1.2]], steel)
    lift, sink, pin = dice.between(0.3, 0.5), dice.between(-0.2, 0.1), np.array([-0.5, 0, 3.6])
    sides = _two(box((long - 2.5, 0.15, 0.5)), 0, wide / 2, -0.2)
    plates = [box((long, wide, 0.25), (long / 2 - 0.8, 0, 0)), *moved(sides, (long / 2 + 0.4, 0, 0))]
    kit.fix(moved(turned(plates, rotation((0, 1, 0), -sink)), (0, 0, 2.5)), look)
    kit.fix([*_two(box((2.4, 0.2, 1.8)), 0, wide / 2 + 0.25, 3.2), lying(0.2, wide + 1.1, Y) + pin], steel)
    lever = moved(turned(plates, rotation((0, 1, 0), -lift)), pin + [0, 0, 0.15])
    kit.add("lever", hinge(pin, (0, 1, 0), 0.7 * lift), [(lever, look)])
    loop = [upright_ring(0.7, 0.15, 14) - [0, 0.2, 0.5], rod((0, 0, 0), (0, wide + 1.5, 0), 0.13, 8)]
    parts = [(moved(loop, (0.75, -wide / 2 - 0.9, 2.95)), Look("steel", (210, 180, 60)))]
    kit.add("pin", slide((0, -1, 0), 1.2 * wide + 1.5), parts)
    if dice.chance(0.6):
        kit.fix([disc(0.4, 0.7, 8) + [0, -0.9, 1.2]], steel)
        _gauge(dice, kit, np.array([0, -1.9, 1.2]), 0.9)
    return kit


def _fire_extinguisher(dice: Dice) -> list[Body]:
    """A bottle with a head, a hose in a clamp or a horn that swings; some on wheels."""
    kit, black, slim, unit = Assembly(), looks.rubber(dice), dice.between(3.2, 7.0), dice.between(0.2, 0.28)
    coat = dice.pick((Look("steel", (190, 25, 25)), Look("steel", (175, 40, 30)), looks.metal(dice)))
    kit.fix([_hull(dice, ngon(24), np.array([2, 2, slim]), 0.3, dice.between(0.3, 0.9), 4)], coat)
    kit.graft(_squeeze_head(dice, dice.pick((coat, black))), (0, 0, slim), unit * _SAME)
    z, x = slim + 1.2 * unit, -1.35
    if dice.chance(0.65):
        thick, low, level = dice.between(0.09, 0.13), 0.16 * slim, slim * dice.between(0.4, 0.6)
        line = [(0, 0, z), (-0.8, 0, z), (-1.27, 0, z - 0.2), (x, 0, z - 0.6), (x, 0, low)]
        horn = tube([(x, 0, low + 0.5), (x, 0, low)], np.array([0.12, 0.2]), 12)
        kit.fix([tube(line, thick, 10), horn, sleeve_of(0.8, 1.03, 0.3, 24) + [0, 0, level - 0.15]], black)
        pin = np.array([-1.06, -thick - 0.09, level])
        kit.fix([box((0.75, 0.06, 0.22), (-1.3, thick + 0.08, level)), cylinder(0.04, 0.44) + pin], black)
        jaw = [box((0.6, 0.06, 0.2)) - [0.3, 0, 0], box((0.06, 0.3, 0.2), (-0.6, 0.12, 0))]
        kit.add("clamp", hinge(pin, (0, 0, 1), 1.5), [([*moved(jaw, pin), cylinder(0.08, 0.3) + pin], coat)])
    else:
        pin, reach = np.array([-1.4, 0, z]), dice.between(1.6, 2.4)
        kit.fix([rod((0, 0, z), pin + [0.2, 0, 0], 0.12, 10)], looks.metal(dice))
        cone = tube([(0, 0, 0), (0, 0, -0.4 * reach), (0, 0, -reach)], np.array([0.1, 0.12, 0.3]), 14)
        kit.add("nozzle", hinge(pin, (-1, 0, 0), 2.0), [(moved([cone, lying(0.2, 0.34)], pin), black)])
    if dice.chance(0.3):
        _trolley(dice, kit, 1.06, 0.9 * slim)
    return kit.done(dice.between(0.04, 0.1) * rotation((0, 0, 1), dice.pick((0.0, np.pi / 2, -np.pi / 2))))


def _spray_head(dice: Dice, coats: Coats, tall: float) -> Assembly:
    """A ring that screws, on it a head that turns, on that a trigger about a pin and a nozzle."""
    kit, look, other = _screw(dice, coats, tall, calm=True), coats[1], looks.plastic(dice)
    z, wide, long = float(kit.points(1)[:, 2].max()) + 0.05, dice.between(0.9, 1.3), dice.between(2.8, 3.6)
    high, back = z + dice.between(1.4, 2.2), dice.between(0.7, 1.6)
    stem = loft(rounded(0.3), [(0, 0, z), (1.5, 1.5, z), (wide, 1.3, high), (0, 0, high)])
    rows = np.array([(0, 0, -back), (0.75, 0.9, -back), (1, 1.2, 0.2), (0.9, 1.1, long), (0, 0, long)])
    beak = turned([loft(rounded(0.25), rows * [wide, 1, 1])], _FORWARD)
    head = kit.add("head", spin((0, 0, z), (0, 0, 1)), [([stem, *moved(beak, (0, 0, high + 0.4))], look)], 1)
    pin, reach = np.array([0, -0.72 * long, high - 0.42]), high - z + dice.between(0.8, 1.6)
    kit.fix(moved([*_two(box((0.12, 0.6, 0.7)), 0.4 * wide, 0, 0.1), lying(0.12, wide)], pin), look, head)
    bent = np.array([(0, 0, 0.02), (0, -0.3, -0.4), (0, -0.25, -0.7), (0, -0.7, -1)]) * [1, 1, reach]
    grip = tube(bent, np.array([0.2, 0.19, 0.18, 0.15]), 8) * [2.2, 1, 1] + pin
    kit.add("trigger", hinge(pin, (1, 0, 0), dice.between(0.6, 0.9) / reach), [([grip], other)], head)
    tip, knurls = np.array([0, -long - 0.1, high + 0.4]), around([cylinder(0.07, 0.7, 6) + [0.46, 0, 0]], 12)
    cap = dice.pick(([cylinder(0.45, 0.7), *knurls], [box((1, 1, 0.6)), cylinder(0.3, 0.9)]))
    kit.fix([disc(0.25, 0.3, 10) + tip + [0, 0.2, 0]], other, head)
    kit.add("nozzle", spin(tip, (0, 1, 0)), [(moved(turned(cap, _FORWARD), tip - [0, 0.4, 0]), other)], head)
    return kit


def _spray_bottle(dice: Dice) -> list[Body]:
    """A bottle with a head; some with a measuring cup on a neck behind."""
    kit = _filled(dice, ((0.09, 1.9, 0.33, 1.0, 0.2, (_spray_head,)),))
    wide, deep, high = kit.points(0).max(axis=0)
    if dice.chance(0.35):
        thick, low, coats = 0.25 * wide, 0.25 * high, (looks.plastic(dice), looks.plastic(dice))
        back, top = deep + 1.5 * thick, 0.75 * high
        kit.fix([tube([(0, 0.7 * deep, low), (0, back, low), (0, back, top)], thick, 12)], coats[0])
        kit.graft(_cup(dice, coats, 0.9), (0, back, top), thick * _SAME)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("bottle", _bottle),
    Category("jerry_can", _jerry_can),
    Category("squeeze_tube", _squeeze_tube),
    Category("gas_cylinder", _gas_cylinder),
    Category("fire_extinguisher", _fire_extinguisher),
    Category("spray_bottle", _spray_bottle),
)
