"""Hinges that show where doors and lids turn, as most real ones have them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.primitives import Pieces, rod
from . import looks
from .objects import Body, surface

# What has hinges that one can see: leaves, and no levers, arms or hands.
_LEAVES = frozenset(
    {
        "bonnet",
        "cover",
        "door",
        "flap",
        "gate",
        "hatch",
        "lid",
        "rear door",
        "shell",
        "shutter",
        "tailgate",
        "window",
    }
)
# Objects of which they show.
_SHOWN = 0.75
# Of a leaf's length along its hinge: from its end to a barrel, and the barrel; and the most of that [m].
_INSET, _LONG, _MOST_LONG = 0.12, 0.1, 0.06
# Radius of a barrel as a share of the leaf's width, and its bounds [m].
_THICK, _THIN, _MOST_THICK = 0.012, 0.001, 0.007
# A line farther from its leaf than this share of the width is not at its edge.
_BESIDE = 0.1


def hinged(maker: Callable[[Dice], Sequence[Body]], dice: Dice) -> list[Body]:
    """What a maker makes, mostly with two barrels on the line of each leaf, on the body that carries it."""
    made = list(maker(dice))
    if len(made) < 2 or not dice.chance(_SHOWN):
        return made
    metal = looks.metal(dice)
    for body in made[1:]:
        barrels = _barrels(body) if body.label in _LEAVES else []
        if barrels:
            carrier = made[body.parent]
            made[body.parent] = replace(carrier, surfaces=(*carrier.surfaces, surface(barrels, metal)))
    return made


def _barrels(leaf: Body) -> Pieces:
    """Two barrels on the line that a leaf turns about; none if that is not at its edge, or on the ground."""
    motion = leaf.motion
    if motion is None or motion.kind != "revolute":
        return []
    reach = leaf.triangles.reshape(-1, 3) - motion.origin
    along = reach @ motion.axis
    away = np.linalg.norm(reach - along[:, None] * motion.axis, axis=1)
    low, long, width = float(along.min()), float(np.ptp(along)), float(away.max())
    if away.min() > _BESIDE * width:
        return []
    length, radius = min(_LONG * long, _MOST_LONG), float(np.clip(_THICK * width, _THIN, _MOST_THICK))
    starts = (low + _INSET * long, low + (1 - _INSET) * long - length)
    barrels = [_barrel(motion.origin, motion.axis, start, length, radius) for start in starts]
    return barrels if min(float(piece[..., 2].min()) for piece in barrels) >= 0 else []


def _barrel(origin: FloatArray, axis: FloatArray, start: float, length: float, radius: float) -> FloatArray:
    return rod(origin + start * axis, origin + (start + length) * axis, radius, 8)
