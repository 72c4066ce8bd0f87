"""Things on pivots of walls, ceilings and roadsides: cameras, spotlights, barriers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, rod, superquadric
from . import looks
from .assembling import Assembly, disc
from .category import Category
from .objects import Body, Look, hinge


def _yoked(
    dice: Dice,
    kit: Assembly,
    top: FloatArray,
    reach: float,
    body: tuple[Pieces, Look],
    metal: Look,
    label: str,
) -> None:
    """A body that tips about a pin in a yoke below a place; the yoke turns about its collar, or has none."""
    pieces, look = body
    wide = max(float(np.abs(piece[..., 0]).max()) for piece in pieces) * 1.15
    thin = 0.12 * wide
    cheeks = boxes((thin, 5 * thin, reach), [(s * (wide + thin / 2), 0, -reach / 2 - thin) for s in (-1, 1)])
    yoke: Pieces = [cheeks, box((2 * wide + 2 * thin, 5 * thin, thin), (0, 0, -thin / 2))]
    pin = np.array([0, 0, -reach])
    bolt = pointed(cylinder(thin, 2 * wide + 3 * thin, 10), X)
    parent = 0
    if dice.chance(0.6):
        yoke.append(cylinder(1.5 * thin, 2 * thin, 12))
        turn = dice.between(0.8, 2.8)
        parent = kit.add("bracket", hinge(top, (0, 0, 1), turn, -turn), [(moved(yoke, top), metal)])
    else:
        kit.fix(moved(yoke, top), metal)
    lean = rotation((1, 0, 0), dice.between(-0.6, 0.3))
    down, up = dice.between(0.3, 1.2), -dice.between(0.2, 0.7)
    parts = [(moved(turned(pieces, lean), top + pin), look), ([bolt + top + pin], metal)]
    kit.add(label, hinge(top + pin, (1, 0, 0), down, up), parts, parent)


def _camera_body(dice: Dice) -> Pieces:
    """A case about 0 that looks to -y, with a lens and some with a roof."""
    wide, long = dice.between(0.03, 0.05), dice.between(0.1, 0.2)
    is_round = dice.chance(0.5)
    case = pointed(cylinder(wide, long, 18), Y) if is_round else box((2 * wide, long, 1.8 * wide))
    pieces = [case, disc(0.6 * wide, 0.02, 18) - [0, long / 2, 0]]
    if dice.chance(0.6):
        pieces.append(box((2.1 * wide, 1.25 * long, 0.004), (0, -0.1 * long, 1.02 * wide)))
    return pieces


def _security_camera(dice: Dice) -> list[Body]:
    """On an arm from a wall, or below a ceiling."""
    kit, coat, metal = Assembly("base"), looks.plastic(dice), looks.metal(dice)
    reach = dice.between(0.06, 0.12)
    if dice.chance(0.5):
        kit.fix([cylinder(0.05, 0.02, 20) + [0, 0, 0.01], cylinder(0.014, 0.04, 12) - [0, 0, 0.02]], metal)
        top = np.array([0, 0, -0.04])
    else:
        off = dice.between(0.1, 0.25)
        kit.fix([disc(0.045, 0.012, 20), rod((0, 0, 0), (0, -off, 0), 0.012, 10)], metal)
        kit.fix([cylinder(0.016, 0.03, 12) + [0, -off, -0.01]], metal)
        top = np.array([0, -off, -0.025])
    _yoked(dice, kit, top, reach, (_camera_body(dice), coat), metal, "head")
    return kit.done()


def _shade(dice: Dice) -> Pieces:
    """A can or a cone about 0 that shines to -y, with a lamp in it."""
    wide, long = dice.between(0.03, 0.06), dice.between(0.06, 0.16)
    back = wide * dice.between(0.4, 1.0)
    stages = [(0, 0, 0), (2 * back, 2 * back, 0), (2 * wide, 2 * wide, long), (1.8 * wide, 1.8 * wide, long)]
    can = loft(ngon(18), [*stages, (1.8 * back, 1.8 * back, 0.1 * long), (0, 0, 0.1 * long)])
    lamp = superquadric((wide, wide, 0.6 * long), 1, 1, 6) + [0, 0, 0.55 * long]
    return moved(turned([can, lamp], rotation((1, 0, 0), np.pi / 2)), (0, 0.4 * long, 0))


def _spotlight(dice: Dice) -> list[Body]:
    """One to four lamps below a bar or a plate."""
    kit, metal = Assembly("base"), looks.metal(dice)
    coat = looks.painted_metal(dice)
    count, pitch = dice.whole(1, 4), dice.between(0.18, 0.3)
    if count == 1 or dice.chance(0.3):
        kit.fix([cylinder(0.06 + 0.5 * pitch * (count - 1), 0.025, 24) + [0, 0, 0.0125]], metal)
    else:
        kit.fix([box((count * pitch, 0.04, 0.025), (0, 0, 0.0125))], metal)
    seed, drop = dice.whole(0, 2**31), dice.between(0.01, 0.08)
    for k in range(count):
        same, x = Dice(seed), (k - (count - 1) / 2) * pitch
        kit.fix([cylinder(0.008, drop, 10) + [x, 0, -drop / 2]], metal)
        body = _shade(same)
        _yoked(same, kit, np.array([x, 0, -drop]), dice.between(0.06, 0.08), (body, coat), metal, "shade")
    # Some shine upwards or from a wall.
    turn = dice.pick((0.0, 0.0, np.pi / 2, np.pi))
    return kit.done(rotation((1, 0, 0), turn))


def _barrier(dice: Dice) -> list[Body]:
    """A boom over a road that lifts about a shaft in its post; some have a weight behind, and a rest."""
    kit, coat = Assembly("post"), looks.painted_metal(dice)
    high, wide, deep = dice.between(0.8, 1.2), dice.between(0.2, 0.4), dice.between(0.2, 0.4)
    kit.fix(
        [box((wide, deep, high), (0, 0, high / 2)), box((1.3 * wide, 1.3 * deep, 0.02), (0, 0, 0.01))], coat
    )
    long, thick = dice.between(2, 5), dice.between(0.05, 0.1)
    pin = np.array([0, -deep / 2 - 0.03 - thick / 2, 0.85 * high])
    side = dice.sign()
    behind = dice.between(0.1, 0.15) * long
    boom = box((long + behind, thick, dice.between(1.0, 2.0) * thick), (side * (long - behind) / 2, 0, 0))
    pieces: Pieces = [boom, pointed(cylinder(0.06, 1.3 * thick, 16), Y)]
    if dice.chance(0.6):
        pieces.append(box((0.7 * behind, 1.2 * thick, 3 * thick), (-side * 0.7 * behind, 0, 0)))
    if dice.chance(0.4):
        hung = [(side * x * long, 0, -0.25) for x in np.linspace(0.2, 0.95, dice.whole(4, 12))]
        pieces.append(boxes((0.02, 0.02, 0.5), hung))
    kit.fix([rod((0, -deep / 2, pin[2]), (0, pin[1], pin[2]), 0.03, 12)], looks.metal(dice))
    look = Look("steel", (205, 40, 35)) if dice.chance(0.4) else looks.painted_metal(dice)
    kit.add("boom", hinge(pin, (0, -side, 0), dice.between(1.2, 1.5)), [(moved(pieces, pin), look)])
    if dice.chance(0.4):
        x = side * 0.97 * long
        kit.fix([box((0.1, 0.1, pin[2] - 1.5 * thick), (x, pin[1], (pin[2] - 1.5 * thick) / 2))], coat)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("security_camera", _security_camera),
    Category("spotlight", _spotlight),
    Category("barrier", _barrier),
)
