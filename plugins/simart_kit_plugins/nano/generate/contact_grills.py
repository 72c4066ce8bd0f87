"""Two plates that close on each other: sandwich makers, waffle irons, presses."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, at, moved, pointed
from ...shapes.primitives import Pieces, box, boxes, cylinder, prism, superquadric
from . import looks
from .assembling import Assembly
from .category import Category
from .objects import Body, hinge


def _contact_grill(dice: Dice) -> list[Body]:
    """A lower half on feet and an upper one hinged behind, with grips before; some have a latch."""
    kit, coat = Assembly("base"), looks.plastic(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    metal, dark = looks.metal(dice), looks.plastic(dice)
    wide, deep = dice.between(0.2, 0.36), dice.between(0.18, 0.32)
    low, high, gap = dice.between(0.03, 0.06), dice.between(0.03, 0.06), dice.between(0.002, 0.006)
    outline = dice.pick((SQUARE, rounded(0.12), rounded(0.3), ngon(24)))
    kit.fix([prism(outline, (wide, deep, low)) + [0, 0, low / 2]], coat)
    spots = [(x * wide, y * deep, -0.006) for x in (-0.36, 0.36) for y in (-0.36, 0.36)]
    kit.fix(at(cylinder(0.012, 0.014, 10), spots), looks.rubber(dice))
    level = low + gap
    shape = prism(outline, (wide, deep, high)) + [0, 0, high / 2]
    if dice.chance(0.4):
        shape = superquadric((wide, deep, 2 * high), 0.4, 0.4, 10)
        shape[..., 2] = np.maximum(shape[..., 2], 0)
    upper: Pieces = moved([shape], (0, 0, level))
    grip = wide * dice.between(0.25, 0.7)
    for height, pieces in ((low / 2, None), (level + high / 2, upper)):
        bow = [box((grip, 0.02, 0.016), (0, -deep / 2 - 0.035, height))]
        bow.append(
            boxes((0.018, 0.05, 0.014), [(s * 0.42 * grip, -deep / 2 - 0.01, height) for s in (-1, 1)])
        )
        if pieces is None:
            kit.fix(bow if dice.chance(0.6) else [], dark)
        else:
            pieces += bow
    pin = np.array([0, deep / 2 + 0.008, level])
    posts = [(s * 0.3 * wide, pin[1], level) for s in (-1, 1)]
    kit.fix(at(pointed(cylinder(0.008, 0.03, 12), X), posts), metal)
    kit.fix(at(box((0.03, 0.02, low), (0, -0.008, -low / 2)), posts), coat)
    ears = at(box((0.025, 0.03, 0.012), (0, -0.012, 0.012)), np.array(posts) * [0.7, 1, 1])
    lid = kit.add("lid", hinge(pin, (-1, 0, 0), dice.between(1.4, 1.9)), [(upper, coat), (ears, coat)])
    if dice.chance(0.5):
        spot = np.array([0, -deep / 2 - 0.05, level + high / 2])
        bolt = pointed(cylinder(0.004, 0.03, 8), X) + spot
        plate = box((0.024, 0.004, low / 2 + high / 2 + gap), spot - [0, 0, (low + high) / 4])
        kit.add("latch", hinge(spot, (-1, 0, 0), 1.2), [([plate, bolt], metal)], lid)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (Category("contact_grill", _contact_grill),)
