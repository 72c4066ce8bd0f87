"""Fins with flush flaps, hulls with such fins, propellers, handwheels, and leaves on knuckles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, revolve, rod, sheet, superquadric, torus
from . import looks
from .assembling import Assembly, disc, holder
from .objects import Look, hinge, spin
from .rigging import plate

_RIGHT, _BACK = (1, 0, 0), (0, 1, 0)
SKYWARD = rotation(_RIGHT, -np.pi / 2)
"""Turns what looks to -y up."""
_Size = tuple[float, float, float]


def slab(line: ArrayLike, thick: ArrayLike) -> FloatArray:
    """A flat piece about x = 0 of (N, 2) corners of y and z, at each of which it has a thickness."""
    ring = np.insert(np.asarray(line, dtype=np.float64), 0, np.asarray(thick) / 2, axis=1)
    ahead = np.roll(ring, -1, axis=0)
    if (ring[:, 1] * ahead[:, 2] - ring[:, 2] * ahead[:, 1]).sum() < 0:
        ring = ring[::-1]
    ring = np.concatenate([ring, ring[:1]])
    middle, other = np.broadcast_to(ring[:-1].mean(axis=0), ring.shape), [-1, 1, 1]
    return sheet(np.stack([middle * other, ring * other, ring, middle]))


def flapped_fin(dice: Dice, size: _Size, label: str, look: Look) -> Assembly:
    """A fin from z = 0 up with a thin flap that hangs at its back edge, about a line up from y = 0."""
    chord, span, thick = size
    kit, style, cut = Assembly(), dice.pick(("pins", "brackets", "barrels", "plain")), dice.chance(0.55)
    gap, nose = max(0.0012, thick * dice.between(0.12, 0.4)), thick / 2
    back, lean = chord * dice.between(0.18, 0.4), dice.pick((0, 0, dice.between(0.05, 0.3)))
    room, begin = (gap + 1.2 * nose,) * 2 if style == "barrels" else (gap + nose, 0.0)
    low, high, dip = span * dice.between(0.06, 0.25), span * dice.between(0.75, 0.94), -0.2 * span

    def spot(z: float, off: float = 0.0) -> tuple[float, float]:
        return lean * z + off, z

    def along(bottom: float, top: float, radius: float) -> FloatArray:
        return rod((0, *spot(bottom)), (0, *spot(top)), radius, 10)

    def part(bottom: float, top: float, start: float) -> FloatArray:
        ring = [spot(bottom, start), spot(bottom, back), spot(top, back), spot(top, start)]
        return slab(ring, [thick, 0.3 * thick, 0.3 * thick, thick])

    rows = np.linspace(0, 1, 8)
    lead = (back - chord) * (1 - dice.between(0.0, 0.6) * rows ** dice.pick((1, 1, 3)))
    front = [spot(dip, lead[0]), *(spot(span * u, y) for u, y in zip(rows, lead, strict=True))]
    body = [slab([*front, spot(span, -room), spot(dip, -room)], [0.35 * thick] * 9 + [thick] * 2)]
    body += [part(dip, low, -room), part(high, span, -room)] if cut else []
    play = gap + 0.15 * back * lean
    low, high = (low + play, high - play) if cut else (0.02 * span + play, span)
    flap, pad = [part(low, high, begin)], (0.7 * thick, 2 * room)
    if style != "barrels":
        flap.append(along(low, high, nose))
    each = (high - low) * dice.between(0.04, 0.08)
    for share in dice.pick(((0.15, 0.85), (0.13, 0.5, 0.87))) if style == "barrels" else ():
        for step, side in ((-1.05, -1), (0, 1), (1.05, -1)):
            z = low + share * (high - low) + step * each
            strap = box((*pad, 0.9 * each), (0, *spot(z, side * room)))
            (flap if side > 0 else body).extend([along(z - each / 2, z + each / 2, 1.15 * nose), strap])
    if style == "pins" and cut:
        flap += [along(z - play, z + 0.8 * play, 0.6 * nose) for z in (low + 0.1 * play, high + 0.1 * play)]
    if style == "brackets" and not cut:
        body += [box((2.4 * thick, 8 * nose + 2 * room, 2 * gap), (0, *spot(high + 2 * gap, -2 * nose)))]
        body += [along(high + 0.3 * gap, high + 4 * gap, 0.6 * nose)]
    if dice.chance(0.4):
        tall, s, z = 0.2 * back + thick, dice.sign(), low + (high - low) * dice.between(0.3, 0.7)
        horn = plate([[0.0, 0.0], [s * tall, 0.1 * tall], [s * tall, 0.4 * tall], [0.0, tall]], thick / 2)
        flap.append(horn + [0, *spot(z, begin)])
    kit.fix(body, look)
    most = dice.between(0.3, 0.6)
    kit.add(label, hinge((0, 0, 0), (0, lean, 1), most, -most), [(flap, looks.darker(look, 0.8))])
    return kit


def finned_hull(dice: Dice, kit: Assembly, long: float, radius: float, size: _Size, level: str) -> FloatArray:
    """A hull about y with three or four fins of a size behind; its (N, 2) places along y and radii."""
    t, nose, tail = np.linspace(0, 1, 29), dice.between(0.15, 0.45), dice.between(0.4, 0.65)
    wide = np.sqrt(1 - np.clip(1 - t / nose, 0, 1) ** 2) * (
        1 - 0.9 * np.clip((t - 1 + tail) / tail, 0, 1) ** 2
    )
    line, look = np.column_stack([radius * wide, (t - 0.5) * long]), looks.painted_metal(dice)
    kit.fix([pointed(revolve([*line, (0, long / 2)], dice.pick((10, 24, 28))), Y)], look)
    plus, cross = (0, 1, 2, 3), (0.5, 1.5, 2.5, 3.5)
    turns, y = (
        dice.pick((plus, plus, cross, (0, 4 / 3, 8 / 3), (2, 2 / 3, 10 / 3))),
        dice.between(0.32, 0.37) * long,
    )
    fins = [flapped_fin(dice, size, label, look) for label in ("rudder", level)]
    off = float(np.interp(y, line[:, 1], line[:, 0]))
    for angle in np.pi / 2 * np.array(turns):
        fin = fins[int(turns is not cross and abs(np.sin(angle)) > 0.1)]
        kit.graft(fin, (off * np.sin(angle), y, off * np.cos(angle)), rotation(_BACK, angle))
    return line[:, ::-1]


def twisted_blades(dice: Dice, reach: float, count: int, way: int = 1) -> Pieces:
    """Twisted blades on a hub about y; the hub's nose points to the front (1) or the back (-1)."""
    hub, wide = reach * dice.between(0.1, 0.2), reach * min(dice.between(0.12, 0.6), 2.4 / count)
    blade = superquadric((reach - 0.5 * hub, wide, 0.04 * reach), 1.0, 1.0, 7) + [reach / 2, 0, 0]
    if dice.chance(0.6):
        shape = np.array([[0.05, -0.3], [0.4, -0.5], [1, -dice.between(0.1, 0.4)], [1, 0.2], [0.05, 0.3]])
        blade = plate(shape * [reach, wide], 0.03 * reach)
    blades = around(turned([blade], rotation(_RIGHT, dice.between(0.25, 0.8))), count, dice.between(0, 3))
    cone = [(0, -0.8), (1, -0.8), (1, 0.5), (0.6, dice.between(0.7, 1.2)), (0, dice.between(1.2, 2))]
    return turned([*blades, revolve(np.array(cone) * hub, 14)], rotation(_RIGHT, way * np.pi / 2))


def handwheel(dice: Dice, radius: float, look: Look) -> Assembly:
    """A steering wheel or a handwheel before y = 0, on a boss."""
    kit, thick, off = Assembly(), radius * dice.between(0.07, 0.14), radius * dice.between(0.3, 0.7)
    ring = around([rod((0, 0, 0), (radius, 0, 0), 0.7 * thick)], dice.whole(2, 6))
    ring += [torus(radius, thick), cylinder(2.2 * thick, 2.4 * thick), cylinder(thick, 1.8 * off)]
    kit.fix([disc(2.5 * thick, 0.4 * off, 12)], look)
    kit.add("wheel", spin((0, 0, 0), _BACK), [([pointed(one, Y) - [0, off, 0] for one in ring], look)])
    return kit


def hinged_leaf(dice: Dice, wide: float, high: float, label: str = "door", foot: float = 0.0) -> Assembly:
    """A leaf before y = 0 on knuckles, mostly round where it is a hatch; its frame reaches `foot` behind."""
    kit, metal, is_round = Assembly(), looks.metal(dice), wide == high and dice.chance(0.7)
    size, s, look = min(wide, high), dice.sign(), looks.painted_metal(dice)
    thick = size * dice.between(0.04, 0.09)
    rim = thick * dice.between(0.4, 1.0)
    back = rim + 0.3 * thick
    base = box((1.06 * wide, foot + rim, high + 0.06 * wide), (0, (foot - rim) / 2, 0))
    kit.fix([disc(0.54 * wide, foot + rim, 22) + [0, foot, 0] if is_round else base], looks.darker(look))
    flat = disc(wide / 2, thick, 22) if is_round else box((wide, thick, high), (0, -thick / 2, 0))
    pin = np.array([s * (0.5 * wide + 0.55 * thick), -back - thick / 2, 0])
    each, long = high * dice.between(0.05, 0.1), (0.06 * wide if is_round else 0) + 0.9 * thick
    strap = box((long, 0.6 * thick, 0.8 * each), (-s * long / 2, 0, 0))
    lug = box((0.7 * thick, foot - pin[1], 0.8 * each), (0.1 * s * thick, (foot - pin[1]) / 2, 0))
    leaf = [flat - [0, back, 0]]
    for z in high * np.array(dice.pick(((0,), (-0.14, 0.14))) if is_round else (-0.33, 0.33)):
        leaf += moved([cylinder(thick / 2, each, 10), strap], pin + [0, 0, z])
        for there in (z - 1.05 * each, z + 1.05 * each):
            kit.fix(moved([cylinder(thick / 2, 0.9 * each, 10), lug], pin + [0, 0, there]), metal)
    number = kit.add(label, hinge(pin, (0, 0, s), dice.between(1.3, 2.0)), [(leaf, look)])
    front = np.array([0, -back - thick, 0])
    if dice.chance(0.4):
        bar = holder(dice, high * dice.between(0.2, 0.5), upright=True)
        kit.fix(moved(bar, front - [s * 0.34 * wide, 0, 0]), metal, to=number)
    else:
        kit.graft(handwheel(dice, size * dice.between(0.2, 0.38), metal), front, parent=number)
    return kit
