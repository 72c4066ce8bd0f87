"""Cannons, on carriages for fields or for decks."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, revolve, rod, torus
from . import looks
from .assembling import Assembly, scaled
from .category import Category
from .objects import Body, Look, hinge, spin
from .rigging import LEFT, RIGHT, lying


def _cheeks(kit: Assembly, gap: float, level: float, field: bool, wood: Look, metal: Look) -> None:
    """What bears a barrel to both sides, a trail behind it in a field, with caps over the trunnions."""
    for s in (-1, 1):
        x = s * (gap + 0.03)
        outline = [between((x - 0.03, -0.25, level - 0.22), (x + 0.03, 0.35, level - 0.055))]
        if field:
            outline.append(rod((x, 0.3, level - 0.14), (0.4 * x, 1.3, 0.06), 0.05, 4))
        else:
            outline.append(between((x - 0.03, 0.35, level - 0.22), (x + 0.03, 0.65, level - 0.12)))
        kit.fix(outline, wood)
        lugs = [box((0.05, 0.02, 0.09), (x, t * 0.05, level)) for t in (-1, 1)]
        kit.fix([box((0.05, 0.12, 0.02), (x, 0, level + 0.045)), *lugs], metal)
    kit.fix(
        [box((2 * gap, 0.08, 0.12), (0, y, level - 0.16 - (0.06 if y < 0.2 else 0))) for y in (-0.2, 0.3)],
        wood,
    )


def _wheel(big: float, field: bool) -> Pieces:
    """A wheel about x: with spokes for a field, a disc for a deck."""
    if not field:
        return [lying(big, 0.08, X, 22), lying(0.3 * big, 0.1)]
    spoke = [rod((0, 0, 0), (0, 0, 0.92 * big), 0.016)]
    spokes = [turned(spoke, rotation(RIGHT, n * np.pi / 5))[0] for n in range(10)]
    return [pointed(torus(0.94 * big, 0.06 * big, 32), X), lying(0.14 * big, 0.14), *spokes]


def _axles(kit: Assembly, gap: float, level: float, big: float, field: bool, wood: Look) -> None:
    """One axle, or two for a deck, each with two wheels."""
    reach = gap + (0.16 if field else 0.12)
    under = level - 0.22
    for k, y in enumerate((0.0,) if field else (-0.15, 0.5)):
        beam = box((2 * reach - 0.1, 0.09, 0.09), (0, y, big))
        kit.fix([beam, lying(0.025, 2 * reach + 0.12) + [0, y, big]], wood)
        if field:
            kit.fix([box((2 * gap + 0.06, 0.1, 0.12), (0, y, big))], wood)
        else:
            kit.fix([box((2 * gap + 0.06, 0.1, under - big), (0, y, (under + big) / 2))], wood)
        for s in (-1, 1):
            hub = np.array([s * reach, y, big])
            name = f"{'left' if s < 0 else 'right'}_wheel_{k + 1}"
            kit.add("wheel", spin(hub, RIGHT), [(moved(_wheel(big, field), hub), wood)], name=name)


def _line() -> FloatArray:
    """(12, 2) outline of a barrel: radius and place along it, as parts of its radius and length."""
    back = [(0, 0.42), (0.5, 0.42), (0.4, 0.38), (1.15, 0.34), (1.1, 0.0), (0.85, -0.3)]
    muzzle = [(0.7, -0.62), (0.85, -0.66), (0.8, -0.68)]
    bore = [(0.45, -0.68), (0.45, -0.3), (0, -0.3)]
    return np.array([*back, *muzzle, *bore])


def _barrel(long: float, radius: float, gap: float) -> Pieces:
    """A barrel along y with two rings and a knob behind, and trunnions through 0."""
    barrel = [pointed(revolve(_line() * [radius, long], 28), Y), lying(0.035, 2 * gap + 0.1)]
    barrel += [pointed(torus(1.02 * radius, 0.012, 24), Y) + [0, y * long, 0] for y in (0.15, -0.1)]
    return [*barrel, pointed(cylinder(0.03, 0.08), Y) + [0, 0.45 * long, 0]]


def _cannon(dice: Dice) -> list[Body]:
    """A barrel with trunnions that tilts, on a carriage with two or four wheels; some are toys."""
    kit, wood, metal = Assembly("carriage"), looks.wood(dice), looks.metal(dice)
    scale = dice.spread(0.15, 1.2)
    long, radius = dice.between(1.0, 1.6), dice.between(0.09, 0.13)
    field = dice.chance(0.5)
    big = dice.between(0.4, 0.55) if field else dice.between(0.12, 0.18)
    level = big + 0.16 if field else 2 * big + 0.22
    gap = radius + 0.05
    _cheeks(kit, gap, level, field, wood, metal)
    _axles(kit, gap, level, big, field, wood)
    pin, tilt = np.array([0, 0, level]), dice.between(-0.05, 0.2)
    barrel = moved(turned(_barrel(long, radius, gap), rotation(LEFT, tilt)), pin)
    kit.add("barrel", hinge(pin, LEFT, 0.35 - tilt, -0.1 - tilt), [(barrel, metal)])
    return scaled(kit.done(), scale)


CATEGORIES = (Category("cannon", _cannon),)
