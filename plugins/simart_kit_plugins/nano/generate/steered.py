"""Boats, submarines and airships: rudders, planes, propellers and hatches."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, at, moved, pointed, rotation
from ...shapes.primitives import Pieces, box, boxes, cylinder, rod, sheet, superquadric
from . import looks, rotors
from .assembling import Assembly
from .category import Category
from .fittings import sleeve_of
from .objects import Body, hinge, slide, spin
from .rigging import plate
from .steering_parts import SKYWARD, finned_hull, flapped_fin, handwheel, hinged_leaf, slab, twisted_blades

_RIGHT, _BACK, _UP, _SIDES = (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 1)


def _oar(dice: Dice, inner: float) -> Assembly:
    """A rowlock that turns in a socket, and an oar that tips in it, to x."""
    kit, metal, low = Assembly(), looks.metal(dice), dice.between(0.05, 0.08)
    kit.fix([box((0.06, 0.09, 0.05))], metal)
    fork = [cylinder(0.008, low), *at(box((0.025, 0.01, 0.06)), [(0, s * 0.035, low) for s in _SIDES])]
    fork.append(box((0.03, 0.075, 0.012), (0, 0, low - 0.03)))
    lock = kit.add("rowlock", hinge((0, 0, 0), _UP, 0.7, -0.7), [(moved(fork, (0, 0, 0.03)), metal)])
    long, z = dice.between(0.9, 1.5), low + 0.032
    blade = box((0.4, 0.16, 0.012)) if dice.chance(0.5) else superquadric((0.5, 0.17, 0.03), 0.8, 0.8)
    oar = [rod((-inner, 0, z), (long, 0, z), 0.02, 10), blade + [long + 0.12, 0, z]]
    oar += [pointed(cylinder(0.03, 0.01, 12), X) + [s * 0.025, 0, z] for s in _SIDES]
    kit.add("oar", hinge((0, 0, z), _BACK, 0.25, -0.2), [(oar, looks.wood(dice))], lock)
    return kit


def _outboard(dice: Dice, top: float) -> Assembly:
    """A clamp on a stern at y = 0, a bracket that tips on it, a motor that turns in it, a propeller."""
    kit, metal, look, deep = Assembly(), looks.metal(dice), looks.plastic(dice), dice.between(0.6, 0.8)
    pin, axis = np.array([0, 0.05, top + 0.05]), np.array([0, 0.18, top + 0.05])
    cheeks = boxes((0.025, 0.13, 0.3), [(s * 0.09, 0, -0.1) for s in _SIDES])
    kit.fix(moved([cheeks, pointed(cylinder(0.012, 0.23), X)], pin), metal)
    clamp = [box((0.14, 0.07, 0.06)), box((0.08, 0.1, 0.16), (0, 0.06, -0.06))]
    clamp.append(cylinder(0.045, 0.2) + [0, 0.13, -0.06])
    tips = kit.add("bracket", hinge(pin, _RIGHT, 1.1), [(moved(clamp, pin), metal)])
    cowl = superquadric((0.26, 0.36, 0.34), dice.between(0.2, 0.6), dice.between(0.3, 0.6))
    leg = [slab([(0.05, 0.06), (0.17, 0.06), (0.13, -deep), (0.05, -deep)], 0.05)]
    leg += [rod((0, 0, 0.05), (0, 0, -0.2), 0.02), box((0.06, 0.16, 0.02), (0, 0.06, -0.19))]
    leg += [
        superquadric((0.08, 0.3, 0.08)) + [0, 0.09, -deep],
        box((0.16, 0.2, 0.01), (0, 0.12, 0.13 - deep)),
    ]
    leg += [rod((0, 0, 0.12), (0, -0.5, 0.17), 0.018, 8)] if dice.chance(0.6) else []
    parts = [
        (moved([(cowl + [0, 0.02, 0.24]) * dice.between(0.8, 1.1)], axis), look),
        (moved(leg, axis), metal),
    ]
    motor = kit.add("outboard motor", hinge(axis, _UP, 0.5, -0.5), parts, tips)
    hub = axis + [0, 0.26, -deep]
    screw = moved(twisted_blades(dice, 0.11, dice.whole(2, 4), -1), hub)
    kit.add("propeller", spin(hub, _BACK), [(screw, looks.metal(dice))], motor)
    return kit


def _hull(dice: Dice, long: float, beam: float, deep: float) -> tuple[Pieces, FloatArray]:
    """An open boat of two skins, its keel near z = 0, and its (N, 3) right gunwale from bow to stern."""
    t, s, power = np.linspace(0, 1, 15)[:, None], np.linspace(-1, 1, 11), dice.pick((1.3, 2.0, 4.0))
    blunt, top = dice.pick((0.02, 0.02, 0.3, 0.5)), deep * (1 + dice.between(0, 0.35) * (1 - t) ** 2)
    half = blunt + (1 - blunt) * (1 - np.clip(1 - t / 0.65, 0, 1) ** dice.between(1.7, 2.6))
    half *= beam / 2 * (1 - dice.between(0.05, 0.4) * np.clip((t - 0.6) / 0.4, 0, 1) ** 2)
    floor, skins = deep * dice.between(0.3, 0.8) * (1 - t) ** 3, []
    for inset in (0.0, 0.03):
        rise = np.abs(s) ** power * (top - floor - inset) + floor + inset
        across = (1 - (1 - np.abs(s)) ** 1.6) * np.sign(s) * np.maximum(half - inset, 0.2 * half)
        skins.append(np.stack([across, np.broadcast_to((t - 0.5) * long, across.shape), rise], axis=-1))
    ends = [pointed(plate(skins[0][k][:, [2, 0]], 0.03), Y) + [0, skins[0][k, 0, 1], 0] for k in (0, -1)]
    rims = [sheet(np.stack([skins[0][:, k], skins[1][:, k]])) for k in (0, -1)]
    return [sheet(skins[0]), sheet(skins[1]), *rims, *ends], skins[0][:, -1]


def _boat(dice: Dice) -> list[Body]:
    """A rowing, sailing or motor boat."""
    kit, make = Assembly("hull"), dice.pick(("row", "sail", "motor"))
    long, deep = dice.between(2.2, 3.4 if make == "row" else 5.0), dice.between(0.4, 0.65)
    wood, metal, stern = looks.wood(dice), looks.metal(dice), np.array([0, long / 2 + 0.02, 0])
    skins, rim = _hull(dice, long, dice.between(1.1, 1.5) * (0.8 + 0.06 * long), deep)
    kit.fix(skins, looks.painted_metal(dice))

    def edge(share: float, s: float = 1) -> FloatArray:
        return np.array([s, 1, 1]) * [np.interp(share * long, rim[:, 1], rim[:, k]) for k in range(3)]

    for y in np.linspace(0.05, 0.42, dice.whole(1, 3)) - (0.12 if make == "row" else 0):
        kit.fix([box((1.6 * edge(y)[0], 0.2, 0.025), (0, y * long, 0.62 * deep))], wood)
    cleat = [box((0.015, 0.14, 0.015), (0, 0, 0.03)), box((0.012, 0.05, 0.05))]
    kit.fix([piece for y in (-0.4, 0.46) for s in _SIDES for piece in moved(cleat, edge(y, s))], metal)
    if make != "row" or dice.chance(0.2):
        bow, wide = (
            np.array([*(p for p in rim if p[1] < -0.2 * long), edge(-0.19)]),
            0.3 * edge(-0.27)[0] + 0.1,
        )
        kit.fix([sheet(np.stack([bow * [s, 1, 1], bow * [-s, 1, 1]])) for s in _SIDES], wood)
        kit.graft(hinged_leaf(dice, wide, wide, "hatch", 0.05), edge(-0.29, 0), SKYWARD)
    for y in (-0.05, 0.25)[: dice.whole(1, 2)] if make == "row" else ():
        oar, yaw = _oar(dice, min(0.35, 0.7 * edge(y)[0])), rotation(_UP, dice.between(-0.3, 0.5))
        for s in _SIDES:
            kit.graft(oar, edge(y, s) + [0, 0, 0.02], np.diag([s, 1, 1]) @ yaw)
    if make == "sail":
        tall, z, y = dice.between(2.5, 4.8), deep + dice.between(0.3, 0.6), -0.16 * long
        kit.fix([rod((0, y, 0.1), (0, y, tall), 0.03, 12), cylinder(0.055, 0.02) + [0, y, z - 0.07]], metal)
        boom = [rod((0, y + 0.035, z), (0, y + 0.5 * long, z), 0.022, 10)]
        boom.append(sleeve_of(0.034, 0.05, 0.08, 14) + [0, y, z - 0.045])
        cloth = slab([(y + 0.06, z + 0.05), (y + 0.48 * long, z + 0.05), (y + 0.06, tall - 0.1)], 0.006)
        parts = [(boom, metal), ([cloth] if dice.chance(0.6) else [], looks.fabric(dice))]
        kit.add("boom", hinge((0, y, 0), _UP, 1.2, -1.2), parts)
    if make == "motor":
        z = deep + dice.between(0.1, 0.25)
        kit.fix([box((0.6, 0.25, z - 0.1), (0, -0.14, z / 2))], wood)
        kit.graft(handwheel(dice, 0.18, metal), (0, -0.01, z - 0.12), rotation(_UP, np.pi))
    if make != "row" and dice.chance(0.3):
        fin = flapped_fin(dice, (0.12 * long, 0.5, 0.04), "rudder", looks.painted_metal(dice))
        kit.graft(fin, (0, 0.4 * long, 0.05), rotation(_BACK, np.pi))
    elif make == "motor" or dice.chance(0.15):
        kit.graft(_outboard(dice, deep), stern)
    elif make == "sail" or dice.chance(0.5):
        eyes, high = np.array([[0, 0.07, 0.35 * deep], [0, 0.07, 0.85 * deep]]) + stern, 1.1 * deep + 0.03
        kit.fix(at(cylinder(0.022, 0.03), eyes) + at(box((0.03, 0.08, 0.024), (0, -0.04, 0)), eyes), metal)
        blade = [slab([(0.1, high), (0.1, 0), (0.16, -0.3), (0.29, -0.3), (0.35, 0)], 0.024)]
        blade += [
            rod((0, 0.06, high), (0, -0.7, high + 0.1), 0.018, 8),
            box((0.05, 0.25, 0.09), (0, 0.12, high)),
        ]
        iron = [rod((0, 0.07, 0.3 * deep), (0, 0.07, high), 0.009, 8)]
        parts = [(moved(blade, stern), wood), (moved(iron, stern), metal)]
        parts.append((at(box((0.04, 0.12, 0.03), (0, 0.03, 0.034)), eyes), metal))
        kit.add("rudder", hinge(eyes[0], _UP, 0.7, -0.7), parts)
    return kit.done()


def _submarine(dice: Dice) -> list[Body]:
    """A hull with flush planes and rudders, a screw, hatches, and masts that slide out of its tower."""
    kit, long, paint, metal = (
        Assembly("hull"),
        dice.between(0.8, 5.0),
        looks.painted_metal(dice),
        looks.metal(dice),
    )
    r = long * dice.between(0.06, 0.15)
    size = (long * dice.between(0.08, 0.13), r * dice.between(0.7, 1.2), 0.008 * long)
    line = finned_hull(dice, kit, long, r, size, "stern plane")
    for y in (-0.2 * long, 0.12 * long):
        kit.fix([box((0.2 * r, 0.08 * long, 0.6 * r), (0, y, -1.1 * r))], metal)
        kit.fix([box((1.6 * r, 0.09 * long, 0.15 * r), (0, y, -1.4 * r))], metal)
    hub, tall = np.array([0, 0.5 * long + 0.1 * r, 0]), r * dice.between(1.5, 2.2)
    screw = moved(twisted_blades(dice, r * dice.between(0.45, 0.8), dice.whole(3, 7), -1), hub)
    kit.add("propeller", spin(hub, _BACK), [(screw, metal)])
    wide, deep, y = (
        r * dice.between(0.4, 0.7),
        long * dice.between(0.13, 0.2),
        -dice.between(0.05, 0.15) * long,
    )
    tower = superquadric((wide, deep, 2 * tall), dice.between(0.1, 0.25), dice.between(0.6, 1.2))
    kit.fix([tower + [0, y, 0]], paint)
    plane = flapped_fin(dice, (0.09 * long, r * dice.between(0.6, 1.0), 0.008 * long), "bow plane", paint)
    place = (0.3 * wide, y, 0.75 * tall) if dice.chance(0.4) else (0.9 * r, -0.25 * long, 0)
    for s in _SIDES:
        kit.graft(plane, np.array([s, 1, 1]) * place, rotation(_BACK, s * np.pi / 2))
    for share in (0.06, 0.15, -0.34)[: dice.whole(1, 3)]:
        lid = min(0.7 * r, 0.075 * long)
        top = float(np.interp(share * long + lid * np.array(_SIDES) / 2, *line.T).max())
        kit.graft(hinged_leaf(dice, lid, lid, "hatch", 0.4 * r), (0, share * long, top), SKYWARD)
    thin, name = 0.09 * wide + 0.003, "periscope"
    for shift in (0, 0.25 * deep, -0.25 * deep)[: dice.whole(1, 3)]:
        foot, up = np.array([0, y + shift, tall]), np.array([0, 0, tall * dice.between(0.2, 0.6)])
        kit.fix([sleeve_of(1.15 * thin, 1.8 * thin, 0.14 * tall, 14) + foot - [0, 0, 0.04 * tall]], metal)
        mast = [rod(foot - [0, 0, 0.4 * tall], foot + up, thin, 12)]
        head = kit.add(name, slide(_UP, 0.35 * tall), [(mast, metal)])
        if name == "periscope":
            eye = [
                cylinder(1.7 * thin, 4 * thin, 14),
                box((2 * thin, 5 * thin, 2 * thin), (0, -2 * thin, thin / 2)),
            ]
            kit.add("head", spin(foot, _UP), [(moved(eye, foot + up + [0, 0, 2.2 * thin]), paint)], head)
        name = "mast"
    return kit.done()


def _airship(dice: Dice) -> list[Body]:
    """An envelope with flush rudders and elevators in its fins, a gondola with doors, and engines."""
    kit, long, metal, body = (
        Assembly("envelope"),
        dice.between(0.8, 5.5),
        looks.metal(dice),
        looks.painted_metal(dice),
    )
    r = long * dice.between(0.1, 0.17)
    size = (long * dice.between(0.12, 0.2), r * dice.between(0.7, 1.0), long * dice.between(0.004, 0.009))
    finned_hull(dice, kit, long, r, size, "elevator")
    wide, deep, high = r * dice.between(0.3, 0.5), long * dice.between(0.12, 0.25), r * dice.between(0.3, 0.5)
    middle = np.array([0, -dice.between(0.0, 0.15) * long, -r - 0.3 * high])
    kit.fix([superquadric((wide, deep, high), 0.2, dice.between(0.1, 0.4), 10) + middle], body)
    panes = [(s * 0.5 * wide, t * deep, 0.08 * high) for s in _SIDES for t in (-0.25, -0.05)]
    kit.fix(moved(at(box((0.02 * wide, 0.14 * deep, 0.3 * high)), panes), middle), looks.glass(dice))
    for s in _SIDES[: dice.whole(1, 2)]:
        door = hinged_leaf(dice, 0.2 * deep, 0.7 * high, foot=0.1 * wide)
        kit.graft(door, middle + [s * 0.5 * wide, 0.22 * deep, 0], rotation(_UP, s * np.pi / 2))
    tilts, way, arm, coat, blades = (
        dice.chance(0.5),
        dice.sign(),
        0.3 * r,
        looks.metal(dice),
        dice.whole(2, 4),
    )
    low, pod = [0.48 * wide, middle[1] - 0.1 * deep, middle[2]], [0.9 * r, middle[1] + 0.65 * deep, -0.35 * r]
    for spot in (np.array([s, 1, 1]) * p for p in dice.pick(([low], [pod], [low, pod])) for s in _SIDES):
        s, number = np.sign(spot[0]), 0
        end = spot + [s * 1.6 * arm, 0, 0]
        kit.fix([rod(spot - [s * 0.2 * r, 0, 0], end - [s * 0.35 * arm, 0, 0], 0.08 * arm, 10)], metal)
        parts = [superquadric((0.5 * arm, 1.4 * arm, 0.5 * arm), 0.9, 0.9) + end]
        parts.append(pointed(cylinder(0.16 * arm, 0.3 * arm, 14), X) + end - [s * 0.3 * arm, 0, 0])
        if tilts:
            number = kit.add("engine", hinge(end, (-1, 0, 0), 0.7, -0.7), [(parts, body)])
        else:
            kit.fix([parts[0], rod(end - [s * 0.5 * arm, 0, 0], end, 0.08 * arm)], body)
        hub = end - [0, way * 0.8 * arm, 0]
        screw = moved(twisted_blades(dice, 1.1 * arm, blades, way), hub)
        kit.add("propeller", spin(hub, _BACK), [(screw, coat)], number)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("boat", _boat),
    Category("submarine", _submarine),
    Category("airship", _airship),
    *rotors.CATEGORIES,
)
