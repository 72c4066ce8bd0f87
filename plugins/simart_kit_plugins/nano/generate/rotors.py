"""Drones, wind turbines and satellites: rotors, folding arms, wings that unfold."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, around, at, corners, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, revolve, rod, superquadric
from . import looks
from .assembling import Assembly, disc
from .category import Category
from .objects import Body, Look, hinge, spin
from .rigging import ribbon
from .steering_parts import SKYWARD, hinged_leaf, slab, twisted_blades

_RIGHT, _BACK, _UP, _SIDES = (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 1)


def _drone(dice: Dice) -> list[Body]:
    """Two to eight rotors on arms, of which some fold down or aside; a camera and legs below."""
    kit, count, wide = Assembly("drone body"), dice.pick((2, 3, 4, 4, 4, 6, 6, 8)), dice.spread(0.08, 0.4)
    size = wide * np.array([1, dice.between(1, 2), dice.between(0.3, 0.6)])
    dark, paint, blades = looks.plastic(dice), looks.plastic(dice), dice.whole(2, 4)
    kit.fix([superquadric(size, dice.between(0.05, 0.9), dice.between(0.1, 0.9))], paint)
    angles = 2 * np.pi * (np.arange(count) + (0.5 if count > 2 else 0)) / count - (np.pi / 6) * (count == 3)
    aims = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    roots, reach = aims * (0.5 * size + 0.1 * wide) * [1, 1, 0], wide * dice.between(0.7, 1.5)
    thin, tips = wide * dice.between(0.025, 0.06), roots + reach * aims
    rotor = min(0.47 * np.linalg.norm(tips - np.roll(tips, 1, axis=0), axis=1).min(), 0.85 * reach)
    folds, rise = dice.pick(("no", "down", "aside")) if count > 2 else "no", 0.5 * size[2] + 2 * thin
    folds = "down" if folds == "aside" and (count != 4 or reach > 0.95 * size[1]) else folds
    boom, motor = Assembly(), [cylinder(1.8 * thin, rise + thin, 14) + [reach, 0, rise / 2 - thin]]
    boom.fix([rod((0, 0, 0), (reach - 3 * thin * (count < 4), 0, 0), thin, 8)], dark)
    tilt = boom.add("motor", hinge((reach, 0, 0), _RIGHT, 0.7, -0.7), [(motor, paint)]) if count < 4 else 0
    if tilt:
        boom.fix([pointed(cylinder(2.2 * thin, thin, 16), X) + [reach - 2.5 * thin, 0, 0]], paint)
        boom.fix([pointed(cylinder(thin, 1.6 * thin), X) + [reach - 1.1 * thin, 0, 0]], dark, tilt)
    else:
        boom.fix(motor, paint)
    for z in (rise + thin, -4.6 * thin)[: 2 if 3 < count < 8 and dice.chance(0.2) else 1]:
        screw = moved(turned(twisted_blades(dice, rotor, blades), SKYWARD), (reach, 0, z))
        boom.add("propeller", spin((reach, 0, z), _UP), [(screw, looks.plastic(dice))], tilt)
    for aim, root, angle in zip(aims, roots, angles, strict=True):
        turn, number = rotation(_UP, angle), 0
        axis = np.array([0.0, 0, 1]) if folds == "aside" else turn @ [0, 1, 0]
        kit.fix([rod(0.2 * root, root - (2 * thin if folds != "no" else 0) * aim, 1.3 * thin, 8)], paint)
        if folds != "no":
            sense, most = (-np.sign(aim[0] * aim[1]) or 1, 1.9) if folds == "aside" else (1, 1.4)
            barrel = [rod(root - 1.6 * thin * axis, root + 1.6 * thin * axis, 1.3 * thin, 12)]
            number = kit.add("arm", hinge(root, sense * axis, most), [(barrel, dark)])
            for off in (s * 2.2 * thin * axis for s in _SIDES):
                kit.fix([rod(root + 0.8 * off, root + 1.2 * off, 1.6 * thin, 12)], paint)
                kit.fix([rod(root + off, root - 3 * thin * aim + 0.4 * off, 0.8 * thin)], paint)
        kit.graft(boom, root, turn, number)
    _belly(dice, kit, size, dark, 0.2 if folds == "down" else 0.32)
    return kit.done()


def _belly(dice: Dice, kit: Assembly, size: FloatArray, look: Look, off: float) -> None:
    """A drone's camera in two joints, its skids that are fixed or fold up, and the door of its battery."""
    c, metal, (wide, long, tall) = size[0] * dice.between(0.1, 0.2), looks.metal(dice), size
    base, eye = np.array([0, -0.28 * long, -0.5 * tall]), np.array([0, -0.28 * long, -0.5 * tall - 1.5 * c])
    kit.fix([cylinder(0.5 * c, 0.4 * tall, 14) + base + [0, 0, 0.19 * tall]], look)
    yoke = [cylinder(0.6 * c, 0.3 * c) - [0, 0, 0.2 * c], box((1.9 * c, 0.5 * c, 0.2 * c), (0, 0, -0.45 * c))]
    sides = dice.pick((_SIDES, (1,)))
    yoke += at(box((0.2 * c, 0.5 * c, 1.6 * c)), [(s * 0.85 * c, 0, -1.2 * c) for s in sides])
    turns = kit.add("bracket", hinge(base, _UP, 1.3, -1.3), [(moved(yoke, base), metal)])
    camera = [superquadric((1.2 * c, 1.2 * c, 1.1 * c), *dice.pick(((0.05, 0.05), (0.8, 0.8))))]
    camera += [pointed(cylinder(0.15 * c, 1.64 * c), X), disc(0.36 * c, 0.9 * c, 16)]
    kit.add("camera", hinge(eye, _RIGHT, 1.4, -0.4), [(moved(camera, eye), looks.plastic(dice))], turns)
    folds, thin, high = dice.chance(0.5), 0.035 * wide, 3.2 * c + wide * dice.between(0.05, 0.4)
    for s in _SIDES:
        top, x = (
            np.array([s * off * wide, 0, -0.5 * tall - 0.02 * wide]),
            s * (0 if folds else off - 0.17) * wide,
        )
        skid = [rod((x, -0.35 * long, -high), (x, 0.35 * long, -high), thin, 8)]
        spots = [(0, t * 0.22 * long, 0) for t in _SIDES]
        skid += at(rod((0, 0, 0 if folds else 0.3 * tall), (x, 0, -high), 0.8 * thin, 8), spots)
        if folds:
            cheek = box((2 * thin, 0.03 * long, 0.3 * tall), (0, 0, 0.12 * tall))
            spots_by = [(0, t * long, 0) for t in (-0.31, -0.13, 0.13, 0.31)]
            kit.fix(moved(at(cheek, spots_by), top), metal)
            skid += at(pointed(cylinder(1.3 * thin, 0.12 * long), Y), spots)
            kit.add("leg", hinge(top, (0, -s, 0), 1.2), [(moved(skid, top), look)])
        else:
            kit.fix(moved(skid, top), look)
    if dice.chance(0.6):
        door = hinged_leaf(dice, 0.4 * wide, 0.4 * wide, "battery door", 0.2 * tall)
        kit.graft(door, (0, 0.12 * long, 0.5 * tall), SKYWARD)


def _tower(dice: Dice, kit: Assembly, tall: float, r: float) -> None:
    """A tube with a door, a lattice, or a pole with stays."""
    metal, top, make = (
        looks.metal(dice),
        np.array([0, 0, tall]),
        dice.pick(("tube", "tube", "lattice", "pole")),
    )
    feet = corners(4.4 * r, 4.4 * r)[[0, 1, 3, 2, 0]]
    kit.fix([cylinder(0.75 * r, 0.3 * r, 20) + top - [0, 0, 0.2 * r]], metal)
    if make == "tube":
        tube = revolve([(0, 0), (r, 0), (0.6 * r, tall), (0, tall)], 20)
        kit.fix([tube, cylinder(2 * r, 0.6 * r, 24)], looks.painted_metal(dice))
        kit.graft(hinged_leaf(dice, r, 2.1 * r, foot=0.3 * r), (0, -r, 1.5 * r))
    elif make == "pole":
        kit.fix([cylinder(0.4 * r, tall, 14) + top / 2, box((3 * r, 3 * r, 0.4 * r))], metal)
        kit.fix([rod(0.38 * top, 2.5 * foot, 0.05 * r, 4) for foot in feet[:4]], metal)
    else:
        kit.fix([rod(foot, 0.2 * foot + top, 0.13 * r) for foot in feet[:4]], metal)
        for u in np.linspace(0, 0.9, dice.whole(3, 8)):
            low, high = feet * (1 - 0.8 * u) + u * top, feet * (0.92 - 0.8 * u) + (u + 0.1) * top
            kit.fix([rod(low[k], high[k + 1], 0.06 * r, 4) for k in range(4)], metal)


def _upright_rotor(dice: Dice, reach: float, r: float) -> Pieces:
    """Straight blades on struts, bows or scoops, about a shaft from z = 0 up."""
    half, wide, make = reach * dice.between(0.6, 1.1), reach * dice.between(0.1, 0.2), dice.whole(0, 2)
    rows, count = np.linspace(-1, 1, 15), dice.whole(2, 5)
    path, round_ = np.column_stack([reach * (1 - rows**2), half * (1 + rows)]), 1.57 * (rows + 1)
    blade = turned([ribbon(path, 0.12 * wide, wide, -wide / 2)], rotation(_RIGHT, np.pi / 2))
    if make == 1:
        struts = [(reach / 2, 0, half * (1 + t)) for t in dice.pick(((0,), (-0.5, 0.5)))]
        blade = [box((0.15 * wide, wide, 1.9 * half), (reach, 0, half))]
        blade += at(box((reach, r / 3, r / 4)), struts)
    elif make == 2:
        path, count = 0.4 * reach * np.column_stack([1 - np.cos(round_), np.sin(round_)]), dice.whole(2, 3)
        blade = [ribbon(path, 0.02 * reach, 1.9 * half, 0.1 * half)]
    return [cylinder(0.25 * r, 2 * half) + [0, 0, half], *around(blade, count)]


def _blades(dice: Dice, kit: Assembly, hub: FloatArray, reach: float, girth: float, parent: int) -> None:
    """A rotor that faces -y, of one piece or with blades that turn in sockets on its hub."""
    count, coat, metal = dice.whole(2, 5), looks.painted_metal(dice), looks.metal(dice)
    if dice.chance(0.6):
        kit.add("rotor", spin(hub, _BACK), [(moved(twisted_blades(dice, reach, count), hub), coat)], parent)
        return
    nose = revolve(np.array([(0, -0.15), (0.3, -0.15), (0.25, 0.2), (0, 0.4)]) * girth, 16)
    sockets = around([rod((0, 0, 0), (0.45 * girth, 0, 0), 0.13 * girth, 12)], count, np.pi / 2)
    pieces = moved(turned([nose, *sockets], rotation(_RIGHT, np.pi / 2)), hub)
    rotor, wide, low = (
        kit.add("rotor", spin(hub, _BACK), [(pieces, metal)], parent),
        0.15 * reach,
        0.47 * girth,
    )
    shape = [(-0.3 * wide, low + wide), (0.7 * wide, low + wide), (0.2 * wide, reach), (-0.1 * wide, reach)]
    blade = [slab(shape, 0.1 * wide), rod((0, 0, low), (0, 0, low + 1.5 * wide), 0.09 * girth, 12)]
    for angle in 2 * np.pi * np.arange(count) / count:
        turn = rotation(_BACK, angle)
        pieces = moved(turned(blade, turn @ rotation(_UP, 1.3)), hub)
        kit.add("blade", hinge(hub, turn @ _UP, 1.3), [(pieces, coat)], rotor)


def _wind_turbine(dice: Dice) -> list[Body]:
    """A rotor before a nacelle that yaws on a tower, or upright blades about a shaft."""
    kit, tall, metal, coat = (
        Assembly("tower"),
        dice.between(1.0, 3.2),
        looks.metal(dice),
        looks.painted_metal(dice),
    )
    reach, r = tall * dice.between(0.3, 0.6), tall * dice.between(0.03, 0.06)
    top, long = np.array([0, 0, tall]), max(reach * dice.between(0.25, 0.4), 3 * r)
    _tower(dice, kit, tall, r)
    if dice.chance(0.3):
        kit.add(
            "rotor", spin(top, _UP), [(moved(_upright_rotor(dice, reach, r), top + [0, 0, 0.1 * r]), coat)]
        )
        return kit.done()
    girth = long * dice.between(0.3, 0.5)
    mid, hub = top + [0, 0, 0.7 * girth], top + [0, -0.55 * long - 0.12 * girth, 0.7 * girth]
    shape = superquadric((girth, long, girth), dice.between(0.2, 0.9), dice.between(0.2, 0.9)) + mid
    neck = [cylinder(0.5 * r, 0.7 * girth) + top + [0, 0, 0.37 * girth]]
    neck.append(rod(mid, hub + [0, 0.05 * girth, 0], 0.1 * girth, 10))
    yaw = kit.add("nacelle", spin(top, _UP), [([shape, *neck], looks.painted_metal(dice))])
    _blades(dice, kit, hub, reach, girth, yaw)
    if dice.chance(0.4):
        door = hinged_leaf(dice, 0.5 * girth, 0.5 * girth, "hatch", 0.2 * girth)
        kit.graft(door, mid + [0, 0.1 * long, 0.5 * girth], SKYWARD, yaw)
        return kit.done()
    far, high, pin = (
        reach * dice.between(0.4, 0.8),
        reach * dice.between(0.12, 0.25),
        mid + [0, 0.58 * long, 0],
    )
    vane = [
        slab([(0.7 * far, -0.6 * high), (far, -high), (far, high), (0.7 * far, 0.6 * high)], 0.02 * reach)
    ]
    vane.append(rod((0, 0, 0), (0, 0.8 * far, 0), 0.05 * girth))
    if dice.chance(0.5):
        ears = [mid + [0, 0.5 * long, s * 0.16 * girth] for s in _SIDES]
        kit.fix(at(box((0.2 * girth, 0.3 * long, 0.08 * girth)), ears), metal, yaw)
        vane.append(cylinder(0.08 * girth, 0.2 * girth))
        kit.add("tail vane", hinge(pin, _UP, 1.2), [(moved(vane, pin), coat)], yaw)
    else:
        kit.fix(moved([*vane, rod((0, -0.2 * long, 0), (0, 0, 0), 0.05 * girth)], pin), coat, yaw)
    return kit.done()


def _wing(dice: Dice, wide: float, count: int, cells: Look, metal: Look) -> Assembly:
    """A yoke that turns in a drum at x = 0, and solar panels on it that unfold one from the other, to x."""
    kit, x, thick = Assembly(), 0.3 * wide, wide * dice.between(0.02, 0.04)
    long, tall = min(wide * dice.between(0.6, 1.5), 2.2 / count - 0.2 * wide), wide * dice.between(0.5, 1.0)
    r, each, columns, rows = 0.7 * thick, 0.06 * tall, dice.whole(2, 4), dice.whole(1, 3)
    cell = np.array([0.92 * long / columns, 0.3 * thick, 0.92 * tall / rows])
    grid = [((i + 0.5) / columns, (j + 0.5) / rows - 0.5) for i in range(columns) for j in range(rows)]
    spots = [(a * long + 2 * r, -thick / 2, b * tall) for a, b in grid]
    kit.fix([pointed(cylinder(2.4 * thick, 0.08 * wide, 16), X)], metal)
    yoke = [rod((0.05 * wide, 0, 0), (x, 0, 0), thick, 10), box((thick, thick, 0.9 * tall), (x, 0, 0))]
    number = kit.add("solar wing", spin((0, 0, 0), _RIGHT), [(yoke, metal)])
    for k in range(count):
        start, side = np.array([x + 0.5 * thick, 0, 0]), 1 - 2 * (k % 2)
        pin, lugs = start + [0.8 * r, side * (thick / 2 + r), 0], [Pieces(), Pieces()]
        for z in (t * tall + u * each for t in (-0.35, 0.35) for u in (-1.05, 0, 1.05)):
            own = abs(abs(z) - 0.35 * tall) < 0.1 * each
            strap = box((3 * r, 1.2 * r, 0.9 * each), ((1.4 if own else -1.4) * r, -0.4 * side * r, z))
            lugs[own] += moved([cylinder(r, each, 10) + [0, 0, z], strap], pin)
        kit.fix(lugs[0], metal, number)
        leaf = [box((long, thick, tall), (long / 2 + 2 * r, 0, 0)), boxes(cell, spots)]
        parts = [(moved(leaf[:1], start), metal), (moved(leaf[1:], start), cells), (lugs[1], metal)]
        most = 3.0 if 0 < k == count - 1 else 1.5
        number = kit.add("solar panel", hinge(pin, (0, 0, side), most), parts, number)
        x += long + 2 * r
    return kit


def _leaf(dice: Dice, wide: float, high: float, cells: Look, metal: Look) -> Assembly:
    """A solar panel before y = 0 that falls open, on knuckles at its lower edge."""
    kit, thick, rows = Assembly(), wide * dice.between(0.02, 0.04), dice.whole(2, 4)
    pin, each = np.array([0, -1.1 * thick, -high / 2 - 0.6 * thick]), 0.06 * wide
    panes = [(0, -1.6 * thick, (k + 0.5) * high / rows - high / 2) for k in range(rows)]
    leaf = [box((wide, thick, high), (0, -1.1 * thick, 0))]
    for x in (t * wide + u * each for t in (-0.32, 0.32) for u in (-1.05, 0, 1.05)):
        own = abs(abs(x) - 0.32 * wide) < 0.1 * each
        knuckle = [pointed(cylinder(0.6 * thick, each, 10), X), box((0.9 * each, 0.8 * thick, 1.6 * thick))]
        if own:
            leaf += moved([knuckle[0], knuckle[1] + [0, 0, 0.8 * thick]], pin + [x, 0, 0])
        else:
            lug = box((0.9 * each, 1.2 * thick, 0.8 * thick), (0, 0.6 * thick, 0))
            kit.fix(moved([knuckle[0], lug], pin + [x, 0, 0]), metal)
    solar = [boxes((0.94 * wide, 0.2 * thick, 0.9 * high / rows), panes)]
    kit.add("solar panel", hinge(pin, _RIGHT, dice.between(1.5, 2.1)), [(leaf, metal), (solar, cells)])
    return kit


def _satellite(dice: Dice) -> list[Body]:
    """A bus with wings that turn and unfold, a dish on two joints, and a hatch."""
    kit, wide, metal = Assembly("bus"), dice.spread(0.15, 1.0), looks.metal(dice)
    high, dish, door = (
        wide * dice.between(0.9, 2.0),
        wide * dice.between(0.25, 0.5),
        dice.between(0.4, 0.6) * wide,
    )
    foil = dice.pick((looks.metal(dice), Look("aluminium", (205, 160, 60)), looks.plastic(dice)))
    is_drum = dice.chance(0.35)
    kit.fix([cylinder(0.5 * wide, high, dice.pick((8, 24))) if is_drum else box((wide, wide, high))], foil)
    nozzle = np.array([(0, 0.1), (0.12, 0), (0.25, -0.3), (0.2, -0.3), (0, -0.05)]) * wide
    kit.fix([revolve(nozzle, 18) - [0, 0, 0.5 * high]], metal)
    cells, unfolds = (
        Look("glass", dice.pick(((30, 40, 90), (25, 25, 35), (60, 30, 40)))),
        is_drum or dice.chance(0.6),
    )
    wing = (
        _wing(dice, wide, dice.whole(1, 3), cells, metal)
        if unfolds
        else _leaf(dice, 0.9 * wide, 0.9 * high, cells, metal)
    )
    for turn in np.pi / 2 * np.array(dice.pick(((0, 2), (0, 2), (0, 1, 2), (2,))) if unfolds else (0, 1, 2)):
        side = rotation(_UP, turn)
        kit.graft(wing, side @ [0.5 * wide, 0, 0], side @ rotation(_UP, 0 if unfolds else np.pi / 2))
    foot, pin = np.array([0, 0, high / 2]), np.array([0, 0, high / 2 + 1.3 * dish])
    kit.fix([cylinder(0.2 * dish, 0.16 * dish, 18) + foot], metal)
    fork = [cylinder(0.14, 0.9, 14) + [0, 0, 0.54], box((0.6, 0.2, 0.1), (0, 0, 1))]
    fork += at(box((0.08, 0.2, 0.4)), [(s * 0.26, 0, 1.2) for s in _SIDES])
    turns = kit.add("bracket", spin(foot, _UP), [([piece * dish + foot for piece in fork], metal)])
    bowl = np.array([(u, 0.35 * u * u) for u in np.linspace(0, 1, 7)])
    parts = turned([revolve([*bowl, *(bowl + [0, 0.03])[::-1]], 24)], rotation(_RIGHT, np.pi / 2))
    parts = [parts[0] - [0, 0.15, 0], rod((0, -0.2, 0), (0, -0.9, 0), 0.02), disc(0.08, 0.1) - [0, 0.85, 0]]
    parts += [pointed(cylinder(0.06, 0.68), X), box((0.3, 0.22, 0.14), (0, -0.08, 0))]
    moves = hinge(pin, (-1, 0, 0), 1.2, -0.2)
    kit.add("dish", moves, [([piece * dish + pin for piece in parts], foil)], turns)
    hatch = hinged_leaf(dice, door, door, "hatch", 0.15 * wide)
    kit.graft(hatch, (0, -0.505 * wide, -0.1 * high))
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("drone", _drone),
    Category("wind_turbine", _wind_turbine),
    Category("satellite", _satellite),
)
