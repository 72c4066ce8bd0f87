"""Things played and driven by keys, pedals, wheels and levers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, open_box, prism, rod, tube
from ...shapes.primitives import superquadric as soft
from . import fitted_leaves, fittings, looks
from .assembling import Assembly, disc, pull
from .carcass import posts
from .category import Category
from .objects import Body, Look, hinge, slide, spin
from .piano_keys import key_row
from .rigging import ball_knob, lying, profile

_DARK, _IVORY = Look("plastic", (28, 28, 30)), Look("plastic", (240, 236, 224))
_UP, _DOWN, _TURNS = (-1, 0, 0), (1, 0, 0), (0, 0, 1)  # what is before a pin goes up, down, to the right
_Spot = tuple[float, float, float] | FloatArray


def _two(size: _Spot, x: float, y: float, z: float) -> Pieces:
    """A box at both sides of x = 0."""
    return [boxes(size, [(-x, y, z), (x, y, z)])]


def _turn(
    kit: Assembly, label: str, pin: _Spot, axis: _Spot, stops: tuple[float, ...],
    of: tuple[Pieces, Look], half: float = 0.0, size: float = 0.016, to: int = 0,
) -> int:  # fmt: skip
    """Hangs pieces, made about 0, on a pin, which runs between lugs `half` off; without stops they spin."""
    line, (pieces, look) = np.abs(np.asarray(axis, dtype=np.float64)), of
    if half:
        kit.fix([box(size * (1 - 0.6 * line)) + pin + s * half * line for s in (-1, 1)], look, to)
        pieces = [*pieces, lying(0.25 * size, 2 * half + 0.6 * size, int(line.argmax()), 10)]
    motion = hinge(pin, axis, *stops) if stops else spin(pin, axis)
    return kit.add(label, motion, [(moved(pieces, pin), look)], to)


def _keys(kit: Assembly, spot: tuple[float, float, float], count: int, pitch: float, long: float) -> None:
    for motion, parts in key_row(spot, count, pitch, long, _IVORY, _DARK):
        kit.add("key", motion, parts)


def _octaves(dice: Dice, few: int, wide: float) -> tuple[int, float]:
    """How many white keys, and from one to the next [m]: those of a real keyboard, or a few wide ones."""
    if dice.chance(0.3):
        return few, wide
    return dice.pick((15, 22, 29, 36, 43, 52)), dice.between(0.0205, 0.0237)


def _controls(dice: Dice, wide: float, high: float) -> Assembly:
    """Knobs, sliders and switches on the plane y = 0."""
    kit, look = Assembly(), looks.plastic(dice)
    count = min(dice.whole(3, 12), int(wide / 0.026))
    size = min(1.3 * wide / count, high, dice.between(0.05, 0.1))
    room = fittings.Room(size, size, _DARK, look, look)
    every = (fittings.knob, fitted_leaves.slider, fittings.toggle)
    kinds = dice.pick((every[:1], every[1:2], every[:2], every))
    for k in range(count):
        place = (((k + 0.5) / count - 0.5) * wide, 0, (k % 2 - 0.5) * 0.45 * high if high > 0.12 else 0)
        kit.graft(dice.pick(kinds)(dice, room), place, rotation((0, 1, 0), np.pi / 2))
    return kit


def _synthesizer(dice: Dice) -> list[Body]:
    """A slab with keys before a panel, which in some tips up or lies below a lid; some on a stand."""
    kit, look = Assembly("body"), dice.pick((looks.plastic, looks.painted_metal, looks.wood))(dice)
    count, pitch = _octaves(dice, dice.whole(5, 9), dice.between(0.024, 0.055))
    base, long = dice.between(0.018, 0.05), max(pitch * dice.between(3, 4.5), dice.between(0.08, 0.14))
    strip, deep = dice.pick((0.0, 0.05, 0.08)), dice.between(0.07, 0.2)
    make, edge = dice.pick(("", "", "tilting", "lid")), dice.weighted([(3, 0.015), (1, 0.12)])
    level, back, wood = base + 0.004 + 0.05 * long, long + 0.004, looks.wood(dice)
    low, wide = level + dice.between(1.3, 2.2) * min(0.02, 0.5 * pitch), count * pitch + strip
    high, end = low + (0 if make else deep * dice.between(0, 0.7)), back + deep
    slab = [between((-wide / 2, -0.02, 0), (wide / 2, y, z)) for y, z in ((end, base), (-0.004, level))]
    brow = low + 0.004 if make or edge > 0.1 else level + 0.02
    cheek = [(-0.022, 0), (end, 0), (end, high + 0.004), (back, low + 0.004), (-0.022, brow)]
    kit.fix(slab + [profile(cheek, edge) + [s * (wide + edge) / 2, 0, 0] for s in (-1, 1)], look)
    _keys(kit, (strip / 2, 0, level), count, pitch, long)
    for k in range(round(strip / 0.03 - 0.6)):
        pin, rise = np.array([0.019 + 0.031 * k - wide / 2, 0.4 * long, level + 0.01]), level + 0.01 - base
        kit.fix(moved(_two((0.008, 0.7 * long, rise), 0.0105, 0, -rise / 2), pin), look)
        drum = [lying(rise - 0.002, 0.01, X, 20), box((0.01, 0.006, 0.004), (0, 0, rise - 0.001))]
        _turn(kit, "wheel", pin, _UP, (0.7, -0.7), (drum, _DARK))
    thick, parent = 0.016 if make == "tilting" else 0.0, 0
    housing = [(back, 0.001), (end - 0.001, 0.001), (end - 0.001, high - thick), (back, low - thick)]
    kit.fix([profile(housing, wide)], looks.darker(look))
    if make == "tilting":
        plate = [box((wide - 0.02, deep - 0.012, thick - 0.002), (0, deep / 2 - 0.004, -0.001 - thick / 2))]
        parent = _turn(kit, "panel", (0, back + 0.01, low), _DOWN, (1.0,), (plate, wood), wide / 2 - 0.004)
    elif make == "lid":
        tub = [open_box((wide + 2 * edge, end + 0.02, 0.06), 0.01) * [1, -1, -1] - [0, end / 2 + 0.01, -0.07]]
        tub += [box((0.1, 0.03, 0.012), (0, -end - 0.03, 0.03)), box((0.1, 0.006, 0.02), (0, 0, 0.004))]
        _turn(kit, "lid", (0, end + 0.008, low - 0.004), _UP, (1.9,), (tub, wood), 0.3 * wide)
    slope = rotation(_DOWN, np.arctan2(high - low, deep) - np.pi / 2)
    controls = _controls(dice, 0.92 * wide, 0.75 * deep)
    kit.graft(controls, (0, back + 0.53 * deep, (low + high) / 2), slope, parent)
    tall, reach, bar, metal = dice.between(0.5, 0.75), 0.42 * max(wide, 0.5), 0.6 * end, looks.metal(dice)
    for s in (-1, 1) if dice.chance(0.45) else ():  # two crossed frames
        frame = [rod((s * reach, 0.018 * s, tall / 2), (-s * reach, 0.018 * s, -tall / 2), 0.013, 8)]
        frame += [lying(0.013 + 0.001 * w, bar, Y, 10) + [s * w * reach, 0, w * tall / 2] for w in (-1, 1)]
        if s > 0:
            _turn(kit, "leg", (0, end / 2, -0.015 - tall / 2), (0, 1, 0), (0.45,), (frame, metal))
        else:
            kit.fix(moved([*frame, lying(0.01, 0.09, Y, 12)], (0, end / 2, -0.015 - tall / 2)), metal)
    return kit.done()


def _typewriter(dice: Dice) -> list[Body]:
    """Keys before a housing with a cover; a carriage on a rail, or a head that runs before a fixed roller."""
    kit, look = Assembly("body"), dice.pick((looks.painted_metal, looks.plastic))(dice)
    wide, rows, row = dice.between(0.26, 0.42), dice.whole(2, 4), dice.between(0.024, 0.034)
    front, high, metal = (rows + 1.9) * row, dice.between(0.1, 0.15), looks.metal(dice)
    deep, middle, own, to = front + 0.18, front + dice.between(0.06, 0.09), wide, 0
    cheek = [(0, 0), (deep, 0), (deep, high), (front, high), (front, dice.between(0.5, 1) * high), (0, 0.03)]
    spans = [(0, deep, 0, 0.012), (0, 0.005, 0.012, 0.028), (front, front + 0.005, 0.012, high)]
    spans += [(middle, deep - 0.005, high - 0.015, high), (deep - 0.005, deep, 0.012, high)]
    body = [between((0.008 - wide / 2, y, z), (wide / 2 - 0.008, end, top)) for y, end, z, top in spans]
    kit.fix(body + [profile(cheek, 0.008) + [s * (wide / 2 - 0.004), 0, 0] for s in (-1, 1)], look)
    _type_keys(dice, kit, (wide, row, front), rows)
    lid = [box((wide - 0.03, middle - front - 0.002, 0.005), (0, (middle - front) / 2, -0.003))]
    lid.append(box((0.2 * wide, 0.01, 0.01), (0, middle - front - 0.008, 0)))
    _turn(kit, "lid", (0, front, high + 0.009), _DOWN, (1.6,), (lid, looks.darker(look)), wide / 2 - 0.005)
    spot = np.array([0, (middle + deep) / 2 + 0.01, high + 0.008])
    if dice.chance(0.7):
        own, room = wide * dice.between(0.8, 1.2), dice.between(0.2, 0.4) * wide
        kit.fix([box((0.94 * wide, 0.03, 0.008), spot - [0, 0, 0.004])], metal)
        bed = [box((own, 0.09, 0.01), spot + [0, 0, 0.007])]
        to = kit.add("carriage", slide(_UP, room, -room), [(bed, metal)])
    else:
        spot[2] = high
        frame = [lying(0.003, wide, X, 8) + [0, -0.045, z] for z in (0.008, 0.028)]
        kit.fix(moved(frame + _two((0.006, 0.03, 0.05), wide / 2 - 0.003, -0.045, 0.017), spot), metal)
        ball = [box((0.04, 0.02, 0.036), (0, -0.045, 0.018)), ball_knob(0.014) + [0, -0.045, 0.04]]
        kit.add("head", slide(_DOWN, 0.4 * wide, -0.4 * wide), [(moved(ball, spot), _DARK)])
    radius, x = dice.between(0.015, 0.024), own / 2 - 0.004
    pin, reach, bar = spot + [0, 0, radius + 0.014], radius + 0.006, x - 0.01
    kit.fix(moved(_two((0.005, 2.4 * radius, 2 * radius + 0.02), x, 0, -0.004), pin), metal, to)
    drum = [lying(radius, 2 * x - 0.026, X, 18), lying(0.004, own + 0.03, X, 8)]
    drum += [lying(0.9 * radius, 0.02, X, 12) + [s * (x + 0.024), 0, 0] for s in (-1, 1)]
    _turn(kit, "knob", pin, _DOWN, (), (drum, _DARK), to=to)
    if dice.chance(0.7):
        bow = [tube([(-bar, 0, 0), (-bar, -reach, reach), (bar, -reach, reach), (bar, 0, 0)], 0.0025)]
        _turn(kit, "bar", pin, _UP, (0.9,), (bow, metal), to=to)
    if dice.chance(0.7):
        rest = turned([box((0.5 * own, 0.003, 0.09), (0, 0, 0.045))], rotation(_UP, 0.3))
        _turn(kit, "paper rest", spot + [0, 0.036, 0.008], _UP, (0.8,), (rest, metal), 0.27 * own, to=to)
    pin = spot - [x + 0.012, 1.2 * radius + 0.01, -0.02]
    kit.fix([box((0.03, 0.03, 0.004), pin + [0.004, 0.01, -0.005])], metal, to)
    arm = [tube([(0, 0, 0), (-0.03, -0.03, 0.006), (-0.055, -0.055, 0.025)], 0.004), cylinder(0.006, 0.006)]
    _turn(kit, "lever", pin, _TURNS, (0.7,), (arm, metal), to=to)
    return kit.done()


def _type_keys(dice: Dice, kit: Assembly, size: tuple[float, float, float], rows: int) -> None:
    """Caps on arms that tip about a bar, or caps that go down into steps."""
    (wide, row, front), look, metal, tips = size, looks.plastic(dice), looks.metal(dice), dice.chance(0.5)
    columns, step, disks = dice.pick((4, 6, 8, 10)), dice.between(0.006, 0.014), dice.chance(0.6)
    pitch = 0.84 * wide / columns  # an even number of columns leaves the middle to the space bar's arm
    thin = min(0.0024, 0.25 * pitch / rows)
    for r in range(-1, rows):
        y, z, count = (r + 1.5) * row, 0.05 + r * step, columns if r >= 0 else 1
        steps = [box((wide - 0.02, row, z - 0.024), (0, y + 0.006, z / 2))]
        bar = [lying(0.0025, wide - 0.012, X, 8) + [0, front - 0.008, 0.026]] if r < 0 else []
        kit.fix(bar if tips else steps, _DARK)
        for c in range(count):
            x = (c - (count - 1) / 2 + (0.7 * (r + 0.5) / rows - 0.35) * (r >= 0)) * pitch
            flat = box((0.8 * pitch if r >= 0 else 0.5 * wide, 0.72 * row, 0.006))
            cap = [(cylinder(0.42 * min(pitch, row), 0.006, 14) if disks and r >= 0 else flat) + [x, y, z]]
            stem, motion = [rod((x, y, z - 0.02), (x, y, z), 0.004, 8)], slide((0, 0, -1), 0.006)
            if tips:
                arm = [(x, front - 0.008, 0.026), (x, y + 0.004, 0.026), (x, y, 0.029), (x, y, z)]
                stem = [tube(arm, thin), lying(0.005, 2.5 * thin, X, 10) + arm[0]]
                motion = hinge(arm[0], _DOWN, 0.009 / (front - y))
            kit.add("key", motion, [(cap, look), (stem, metal)])


def _sewing_machine(dice: Dice) -> list[Body]:
    """Bed, pillar and arm, by themselves, with a foot pedal, or on a table with a treadle."""
    kit, look = Assembly("body"), dice.pick((looks.plastic, looks.painted_metal))(dice)
    long, deep, bed = dice.between(0.32, 0.44), dice.between(0.15, 0.2), dice.between(0.03, 0.09)
    thick, tall, arm = deep * dice.between(0.5, 0.75), bed + dice.between(0.2, 0.27), dice.between(0.06, 0.09)
    outline, wide = dice.pick((SQUARE, rounded(0.2), rounded(0.45))), dice.between(0.07, 0.11)
    right, left, chin = (long - wide) / 2, wide / 2 - long / 2 + 0.02, bed + dice.between(0.07, 0.1)
    middle, half, metal = (left + right) / 2, (right - left) / 2, looks.metal(dice)
    body = [pointed(prism(outline, (0.98 * thick, arm, 2 * half)), X) + [middle, 0, tall - arm / 2]]
    for x, z in ((right, bed), (left, chin)):
        body.append(prism(outline, (wide, thick, tall - z)) + [x, 0, (tall + z) / 2])
    kit.fix([*body, box((long, deep, bed), (0, 0, bed / 2))], look)
    _needle(kit, np.array([left, 0, chin]), bed - chin, (wide, thick, tall - chin), metal)
    accent, room = looks.plastic(dice), fittings.Room(0.15, 0.15, metal, metal, metal)
    kit.graft(fittings.handwheel(dice, room), (long / 2, 0, tall - arm / 2), rotation(_TURNS, np.pi / 2))
    for x, z in ((right, 0.3 * arm), (right, tall - bed - 0.06), (middle, arm / 2))[: dice.whole(1, 3)]:
        knob = fittings.knob(dice, fittings.Room(0.05, 0.05, metal, look, accent))
        kit.graft(knob, (x, -thick / 2, tall - z))
    if dice.chance(0.5):
        plate = [box((2 * half - 0.01, thick, 0.008), (0, -thick / 2, -0.002))]
        _turn(kit, "lid", (middle, thick / 2, tall + 0.008), _UP, (1.7,), (plate, accent), half)
    else:
        handle = fittings.bail(dice, fittings.Room(1.4 * half, 0.8 * thick, metal, accent, accent))
        kit.graft(handle, (middle, 0, tall), rotation(_UP, np.pi / 2))
    make = dice.pick(("", "pedal", "treadle"))
    if make == "treadle":
        _treadle_table(dice, kit, long + dice.between(0.25, 0.5))
    elif make == "pedal":
        pin = np.array([dice.sign() * 0.1, -0.38, 0.02])
        cord = tube([(0, 0.12, -0.016), (0.1, 0.2, -0.016), (right - pin[0], 0.38 - deep / 2, 0)], 0.003)
        kit.fix(moved([cord, box((0.1, 0.15, 0.008), (0, 0.06, -0.015))], pin), _DARK)
        plate = turned([box((0.086, 0.135, 0.01), (0, 0.06, 0.006))], rotation(_DOWN, 0.22))
        _turn(kit, "pedal", pin, _UP, (0.2,), (plate, look), 0.05)
    return kit.done()


def _needle(kit: Assembly, at: FloatArray, low: float, head: tuple[float, float, float], metal: Look) -> None:
    """Needle bar, presser foot with its lever, and the lever in the slot that takes up the thread."""
    wide, thick, tall = head
    tubes = [fittings.sleeve_of(0.0045, 0.008, 0.008, 12) + [0, y, -0.008] for y in (-0.008, 0.014)]
    slot = [box((0.008, 0.003, 0.07), (0, -thick / 2, tall - 0.055)), box((0.04, 0.05, 0.004), (0, 0, low))]
    kit.fix(moved(tubes + slot, at), metal)
    lines = [(0.02, low + 0.04, 0.004), (low + 0.05, low + 0.036, 0.006), (low + 0.04, low + 0.013, 0.0013)]
    needle = [rod((0, -0.008, a), (0, -0.008, b), radius, 8) for a, b, radius in lines]
    kit.add("needle bar", slide(_TURNS, 0.02, -0.006), [(moved(needle, at), metal)])
    bar = rod((0, 0.014, 0.02), (0, 0.014, low + 0.009), 0.004, 8)
    foot = [bar, *_two((0.007, 0.03, 0.004), 0.0075, -0.006, low + 0.006)]
    foot.append(box((0.022, 0.016, 0.004), (0, 0.012, low + 0.007)))
    kit.add("presser foot", slide(_TURNS, 0.01), [(moved(foot, at), metal)])
    tip = [lying(0.009, 0.008), tube([(0, 0, 0), (0, -0.03, -0.02), (0, -0.04, -0.02)], 0.004)]
    _turn(kit, "lever", at + [wide / 2 + 0.007, 0.2 * thick, 0.02], _UP, (1.0,), (tip, metal))
    hook = tube([(0, 0, 0), (0, -0.016, 0), (0, -0.02, -0.006), (0, -0.014, -0.01)], 0.002)
    kit.add("lever", slide((0, 0, -1), 0.04), [([hook + at + [0, -thick / 2 - 0.001, tall - 0.032]], metal)])


def _treadle_table(dice: Dice, kit: Assembly, wide: float) -> None:
    """A table below the machine: a treadle and a wheel between iron legs, a drawer, a leaf that drops."""
    deep, tall, own = dice.between(0.38, 0.46), dice.between(0.66, 0.75), wide * dice.between(0.35, 0.5)
    x, y, look, iron = wide / 2 - 0.05, deep / 2 - 0.04, looks.wood(dice), looks.metal(dice)
    kit.fix([box((wide, deep, 0.028), (0, 0, -0.0145))], look)
    legs = [rod((s * x, t * y, -tall), (s * x, -t * y, -0.02), 0.013, 8) for s in (-1, 1) for t in (-1, 1)]
    kit.fix([*legs, *_two((0.03, 2 * y + 0.06, 0.02), x, 0, -tall)], iron)
    bars = [box((own, 0.03, 0.012), (0, v, 0.008)) for v in np.linspace(-0.12, 0.12, 5)]
    bars += [*_two((0.025, 0.28, 0.012), own / 2, 0, 0.004), lying(0.014, 0.9 * own)]
    _turn(kit, "treadle", (0, 0, 0.08 - tall), _UP, (0.24, -0.24), (bars, iron), x, 0.04)
    room = fittings.Room(0.3, 0.3, iron, iron, iron)
    kit.graft(fittings.wheel(dice, room), (-x, 0, -0.5 * tall), rotation(_TURNS, np.pi / 2))
    if dice.chance(0.6):
        kit.graft(fitted_leaves.drawer(dice, fittings.Room(0.2, 0.1, look, look, iron)), (0, 0, -0.079))
    if dice.chance(0.6):
        leaf = [box((0.3, deep - 0.04, 0.024), (-0.15, 0, -0.004))]
        _turn(kit, "leaf", (-wide / 2 - 0.009, 0, -0.01), (0, -1, 0), (1.5,), (leaf, look), deep / 2 - 0.012)


def _driving_rig(dice: Dice) -> list[Body]:
    """The driver looks to y: a wheel on a desk, on a post that folds, or before a seat on rails."""
    kit, metal, make = Assembly("frame"), looks.painted_metal(dice), dice.pick(("desk", "stand", "seat"))
    level, far, x, to = dice.between(0.62, 0.75), dice.between(0.35, 0.5), dice.between(0.24, 0.32), 0
    seat, desk, slope = make == "seat", make == "desk", rotation(_UP, dice.between(0.15, 0.5))
    start = -0.95 if seat else -0.15
    kit.graft(_pedals(dice), (0.06, far, 0.0 if desk else 0.05))
    if desk:
        wide = dice.between(0.8, 1.2)
        top = [*posts(wide, 0.55, level - 0.12, 0.04), box((wide, 0.55, 0.025), (0, 0, level - 0.1075))]
        kit.fix(moved(top, (0, 0.275, 0)), looks.wood(dice))
        clamp = [box((0.1, 0.1, 0.03), (0, 0.05, -0.08)), box((0.04, 0.02, 0.1), (0, -0.014, -0.11))]
        kit.fix(moved([*clamp, box((0.04, 0.09, 0.012), (0, 0.025, -0.156))], (0, 0, level)), metal)
        screw = [cylinder(0.008, 0.07, 10) - [0, 0, 0.01], cylinder(0.02, 0.02, 8) - [0, 0, 0.05]]
        _turn(kit, "clamp screw", (0, 0.04, level - 0.16), _TURNS, (), (screw, _DARK))
    else:
        frame = [box((2 * x, 0.06, 0.04), (0, y, 0.024)) for y in (start + 0.03, 0.1, far)]
        kit.fix(frame + _two((0.05, far + 0.15 - start, 0.05), x, (far + 0.05 + start) / 2, 0.025), metal)
        foot, half = np.array([0, 0.1, 0.09]), x - 0.08
        post = _two((0.04, 0.04, level - 0.14), half - 0.04, 0, level / 2 - 0.08)
        post.append(box((2 * half, 0.2, 0.02), (0, 0, level - 0.165)))
        if not seat or dice.chance(0.4):
            post += [lying(0.024, 0.02, X, 8) + [s * (half + 0.036), 0, 0] for s in (-1, 1)]
            to = _turn(kit, "post", foot, _DOWN, (dice.between(0.5, 0.9),), (post, metal), half, 0.06)
        else:
            kit.fix(moved(post + _two((0.03, 0.03, 0.1), half - 0.04, 0, -0.03), foot), metal)
        if seat:
            _rig_seat(dice, kit, x, start)
    motor = [prism(rounded(dice.between(0.05, 0.4)), (0.16, 0.16, 0.13)) + [0, 0.09, 0]]
    kit.fix(moved(turned(motor, slope), (0, 0.02, level)), _DARK, to)
    kit.graft(_steering(dice), (0, 0.02, level), slope, to)
    side, off, low = dice.sign(), 0.26 if desk else x + 0.02, level - (0.095 if desk else 0.075)
    for s in (side, -side)[: dice.whole(0, 2)]:
        kit.fix([] if desk else [box((x, 0.06, 0.02), (s * (off - x / 2), 0.1, low - 0.01))], metal, to)
        _stick(dice, kit, (s * off, 0.1, low), to)
    return kit.done(rotation(_TURNS, np.pi) if seat else None)


def _steering(dice: Dice) -> Assembly:
    """A wheel before y = 0, round or flat below, some with paddles behind it."""
    kit, metal, radius = Assembly(), looks.metal(dice), dice.between(0.13, 0.17)
    kit.fix([disc(0.05, 0.012)], metal)
    cut, most = dice.pick((0.0, 0.5, 0.7)), dice.pick((1.57, 2.3, np.pi))
    angle, drop = np.linspace(cut - np.pi / 2, 1.5 * np.pi - cut, 25), radius * np.cos(cut)
    ring = np.column_stack([np.cos(angle), 0 * angle, np.sin(angle)]) * radius - [0, 0.075, 0]
    parts = [tube(np.concatenate([ring, ring[:2]]), dice.between(0.01, 0.016), 8)]
    parts += [disc(0.03, 0.06) - [0, 0.013, 0], disc(0.32 * radius, 0.02) - [0, 0.07, 0]]
    parts += [box((2 * radius, 0.01, 0.02), (0, -0.077, 0)), box((0.02, 0.01, drop), (0, -0.077, -drop / 2))]
    wheel = _turn(kit, "steering wheel", (0, 0, 0), (0, 1, 0), (most, -most), (parts, looks.rubber(dice)))
    for s in (-1, 1) if dice.chance(0.6) else ():
        kit.fix([box((0.04, 0.012, 0.006), (s * 0.034, -0.05, v)) for v in (-0.019, 0.019)], metal, wheel)
        blade = [box((0.4 * radius, 0.004, 0.05), (s * 0.3 * radius, 0, 0.015)), cylinder(0.006, 0.03)]
        _turn(kit, "paddle", (s * 0.046, -0.05, 0), (0, 0, -s), (0.15,), (blade, metal), to=wheel)
    return kit


def _pedals(dice: Dice) -> Assembly:
    """Two or three, on arms that stand on a plate or hang from a bar, between lugs with a pin."""
    kit, metal, base, count = Assembly(), looks.metal(dice), looks.painted_metal(dice), dice.whole(2, 3)
    pitch, reach, s = dice.between(0.09, 0.12), dice.between(0.13, 0.22), dice.pick((1, 1, -1))
    wide, high = (count + 0.3) * pitch, 0.03 if s > 0 else reach + 0.07
    rack = [*_two((0.016, 0.05, high), wide / 2, 0.03, high / 2), box((wide, 0.02, 0.03), (0, 0.027, high))]
    kit.fix([box((wide, 0.2, 0.012), (0, 0, 0.006)), *(rack if s < 0 else [])], base)
    for x in pitch * (np.arange(count) - (count - 1) / 2):
        arm = [box((0.014, 0.012, reach), (0, 0, s * reach / 2)), lying(0.012, 0.024, X, 12)]
        pad = prism(rounded(0.2), (dice.between(0.05, 0.11), dice.between(0.04, 0.075), 0.01))
        arm.append(pointed(pad, Y) + [0, -0.012, s * (reach - 0.02)])
        arm, most = turned(arm, rotation((s, 0, 0), dice.between(0.2, 0.35))), dice.between(0.3, 0.45)
        _turn(kit, "pedal", (x, 0, high), (-s, 0, 0), (most,), (arm, metal), 0.022, 0.036)
    return kit


def _stick(dice: Dice, kit: Assembly, spot: _Spot, to: int) -> None:
    """A lever between lugs on a box: with a ball to shift, or with a grip to brake."""
    high, brakes, long = dice.between(0.03, 0.09), dice.chance(0.4), dice.between(0.1, 0.25)
    kit.fix(moved([box((0.08, 0.13, high), (0, 0, high / 2))], spot), _DARK, to)
    grip = rod((0, 0, 0), (0, 0, 0.6 * long), 0.015, 12) if brakes else ball_knob(0.024)
    arm = [rod((0, 0, 0), (0, 0, long), 0.007, 8), lying(0.012, 0.024, X, 12), grip + [0, 0, long]]
    pin, look = np.array(spot) + [0, 0, high + 0.015], looks.metal(dice)
    label, stops = ("handbrake", (0.6,)) if brakes else ("gear lever", (0.3, -0.3))
    _turn(kit, label, pin, _DOWN, stops, (arm, look), 0.022, 0.032, to)


def _rig_seat(dice: Dice, kit: Assembly, x: float, start: float) -> None:
    """A seat on two rails, whose back leans on pins."""
    high, tall, wide = dice.between(0.2, 0.32), dice.between(0.5, 0.75), min(0.46, 2 * x - 0.02)
    at, cover, metal = np.array([0, start + 0.36, high]), looks.fabric(dice), looks.metal(dice)
    frame = _two((0.04, 0.52, 0.02), 0.17, 0, -0.04)
    for y in (-0.22, 0.22):
        frame += [*_two((0.04, 0.04, high - 0.1), x, y, -high / 2), box((2 * x, 0.04, 0.03), (0, y, -0.065))]
    kit.fix(moved(frame, at), metal)
    shoes = _two((0.05, 0.3, 0.026), 0.17, 0, -0.014) + _two((0.012, 0.2, 0.1), wide / 2 + 0.006, -0.2, 0.05)
    parts = [([soft((wide, 0.46, 0.12), 0.4, 0.35, 8) + at + [0, 0, 0.06]], cover), (moved(shoes, at), metal)]
    seat = kit.add("seat", slide((0, 1, 0), dice.between(0.08, 0.18), -0.05), parts)
    back = [soft((wide - 0.02, 0.1, tall), 0.35, 0.4, 8) + [0, -0.04, tall / 2], lying(0.015, wide + 0.05)]
    back += [soft((0.6 * wide, 0.09, 0.2), 0.4, 0.5, 7) + [0, -0.05, tall + 0.06]] if dice.chance(0.6) else []
    back = turned(back, rotation(_DOWN, 0.15))
    _turn(kit, "backrest", at + [0, -0.24, 0.07], _DOWN, (0.7, -0.1), (back, cover), to=seat)


def _pump_organ(dice: Dice) -> list[Body]:
    """Treadles below, keys under a fall board, stop knobs above them, a music desk and a lid on top."""
    kit, look, brass, dark = Assembly("body"), looks.wood(dice), looks.metal(dice), looks.wood(dice)
    count, pitch = _octaves(dice, dice.whole(5, 8), dice.between(0.06, 0.12))
    long = dice.between(0.12, 0.15)
    wide, deep, bed = count * pitch + dice.between(0.06, 0.3), dice.between(0.22, 0.5), dice.between(0.6, 0.7)
    tall, reach, gap = bed + dice.between(0.28, 0.8), long + 0.08, dice.between(0.28, 0.36)
    spans = [(-0.1, deep, 0, 0.04), (-reach, deep, bed - 0.04, bed), (-0.02, 0, bed, bed + 0.05)]
    spans += [(deep - 0.015, deep, 0.04, tall), (0, 0.02, gap, tall - 0.02), (0, deep, tall - 0.02, tall)]
    case = [between((-wide / 2, y, z), (wide / 2, end, top)) for y, end, z, top in spans]
    case += _two((0.024, deep, tall), wide / 2 + 0.012, deep / 2, tall / 2)
    case += _two((0.024, reach, 0.09), wide / 2 + 0.012, -reach / 2, bed + 0.005)
    legs = _two((0.04, 0.04, bed - 0.04), wide / 2 - 0.02, 0.025 - reach, bed / 2 - 0.02)
    kit.fix(case + (legs if dice.chance(0.6) else []), look)
    _keys(kit, (0, 0.02 - reach, bed + 0.01), count, pitch, long)
    board = [box((wide - 0.01, reach - 0.03, 0.012), (0, 0.015 - reach / 2, 0))]
    board.append(box((0.2, 0.012, 0.02), (0, 0.04 - reach, 0.014)))
    _turn(kit, "lid", (0, -0.025, bed + 0.064), _UP, (1.5,), (board, dark), wide / 2 + 0.006, 0.024)
    high, most = tall - bed - 0.22, dice.between(0.4, 0.8)
    rest = [box((0.5 * wide, y, z), (0, -y / 2, z / 2 - 0.004)) for y, z in ((0.008, high), (0.03, 0.008))]
    _turn(kit, "desk", (0, -0.008, bed + 0.18), _DOWN, (most,), (rest, dark), 0.25 * wide + 0.006)
    cover = [box((wide + 0.1, deep + 0.03, 0.02), (0, -deep / 2, 0.02)), box((0.3, 0.01, 0.02), (0, 0, 0))]
    _turn(kit, "lid", (0, deep + 0.009, tall - 0.01), _UP, (1.6,), (cover, look), 0.4 * wide)
    stops, radius, arms = dice.whole(3, 6), dice.between(0.011, 0.016), dice.chance(0.5)
    for k in range(stops):
        spot = np.array([(k - (stops - 1) / 2) * 0.8 * wide / stops, 0, bed + 0.13])
        kit.fix([disc(1.3 * radius, 0.004) + spot], brass)
        knob = [disc(0.4 * radius, 0.06) + [0, 0.042, 0], disc(radius, 0.012) - [0, 0.016, 0]]
        kit.add("knob", pull(0.035), [(moved(knob, spot), _IVORY)])
    for s in (-1, 1):
        plate = turned([box((0.2 * wide, 0.26, 0.016), (0, 0.125, 0))], rotation(_DOWN, 0.38))
        _turn(kit, "pedal", (s * wide / 5, -0.07, 0.06), _UP, (0.3,), (plate, brass), 0.1 * wide + 0.01, 0.04)
        if arms:
            candle = [tube([(0, 0, 0), (0, -0.1, 0), (0, -0.1, 0.07)], 0.007), disc(0.012, 0.1)]
            _turn(kit, "arm", (s * 0.4 * wide, -0.009, bed + 0.2), (0, 0, s), (1.2,), (candle, brass), 0.014)
    return kit.done()


_MAKERS = (_synthesizer, _typewriter, _sewing_machine, _driving_rig, _pump_organ)
CATEGORIES: tuple[Category, ...] = tuple(Category(make.__name__[1:], make) for make in _MAKERS)
