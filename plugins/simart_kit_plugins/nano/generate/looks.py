"""Colours and materials that things really have."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from .objects import Look

_WOODS = ((196, 154, 108), (133, 94, 66), (222, 196, 160), (92, 60, 42), (170, 120, 80), (205, 175, 130))
_PAINTS = ((245, 245, 240), (228, 224, 214), (60, 72, 90), (120, 140, 120), (180, 60, 50), (40, 40, 44))
_METALS = ((180, 182, 186), (150, 150, 152), (90, 92, 96), (212, 190, 130), (60, 60, 62))
_PLASTICS = ((30, 30, 32), (240, 240, 240), (200, 40, 40), (40, 90, 170), (230, 180, 40), (90, 150, 90))
_FABRICS = ((110, 110, 120), (150, 120, 100), (70, 90, 110), (190, 180, 165), (120, 50, 50))
_CERAMICS = ((250, 248, 242), (230, 225, 210), (70, 100, 140), (150, 80, 60))


def wood(dice: Dice) -> Look:
    """Bare or painted boards."""
    material = "mdf" if dice.chance(0.3) else "wood"
    return _look(dice, material, _PAINTS if dice.chance(0.35) else _WOODS)


def metal(dice: Dice) -> Look:
    """Steel or aluminium."""
    return _look(dice, "aluminium" if dice.chance(0.3) else "steel", _METALS)


def painted_metal(dice: Dice) -> Look:
    """Lacquered steel, such as of appliances."""
    return _look(dice, "steel", _PAINTS + _METALS[:3])


def plastic(dice: Dice) -> Look:
    """Any colour."""
    return _look(dice, "plastic", _PLASTICS)


def glass(dice: Dice) -> Look:
    """Nearly black, as a baked colour of glass mostly is, or light."""
    return _look(dice, "glass", ((25, 28, 32), (190, 210, 215)))


def rubber(dice: Dice) -> Look:
    """Black or grey."""
    return _look(dice, "rubber", ((28, 28, 28), (70, 70, 72)))


def fabric(dice: Dice) -> Look:
    """Muted colours."""
    return _look(dice, "fabric", _FABRICS)


def ceramic(dice: Dice) -> Look:
    """Glazed."""
    return _look(dice, "ceramic", _CERAMICS)


def darker(look: Look, share: float = 0.7) -> Look:
    """The same stuff in a darker shade."""
    red, green, blue = (round(share * value) for value in look.color)
    return Look(look.material, (red, green, blue))


def _look(dice: Dice, material: str, colors: tuple[tuple[int, int, int], ...]) -> Look:
    shade = np.clip(np.array(dice.pick(colors)) * dice.between(0.85, 1.1) + 8 * (dice.units(3) - 0.5), 0, 255)
    red, green, blue = (round(value) for value in shade.tolist())
    return Look(material, (red, green, blue))
