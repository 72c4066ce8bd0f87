"""How far things of a kind usually go; the modifier `sweep` then stops them where surfaces meet."""

from __future__ import annotations

import re

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import JointKind, Limits

# Turns by the last of these words in a name or label [degrees]: wide, for sweeps shorten them.
_TURNS: dict[str, tuple[float, float]] = {
    "door": (0, 110),
    "lid": (0, 100),
    "cover": (0, 100),
    "flap": (0, 90),
    "window": (0, 90),
    "gate": (0, 110),
    "laptop": (0, 130),
    "screen": (0, 130),
    "switch": (-20, 20),
    "lever": (-45, 45),
    "handle": (0, 60),
    "tap": (0, 90),
    "knob": (-135, 135),
}
_OTHER_TURN = (0.0, 90.0)
_OUT = 0.8  # of its own length, that something slides out
_FLAT = 0.05  # of the object's diagonal: what is thinner along its way slides by the parent's size
_OF_PARENT = 0.5
_PRESSED = ("button", "key", "switch", "slider")  # move by their own size, however thin


def usual_limits(kind: JointKind, words: str, length: float, parent: float, diagonal: float) -> Limits | None:
    """Limits of a joint whose axis points the way that it opens.

    Args:
        kind: of the joint; None for kinds without limits.
        words: label and name of the part.
        length: extent of the part along the axis [m].
        parent: extent of what carries it along the axis [m].
        diagonal: of the object [m].
    """
    if kind == "revolute":
        lower, upper = _turn(words)
        return Limits(float(np.deg2rad(lower)), float(np.deg2rad(upper)))
    if kind == "prismatic":
        thin = length < _FLAT * diagonal and not any(word in words for word in _PRESSED)
        return Limits(0.0, float(max(_OF_PARENT * parent if thin else _OUT * length, 1e-3 * diagonal)))
    return None


def extent(points: FloatArray, axis: FloatArray) -> float:
    """Length of (N, 3) points along a unit direction [m]."""
    return float(np.ptp(points @ axis))


def _turn(words: str) -> tuple[float, float]:
    spoken = re.findall(r"[a-z]+", words.lower())
    found = [_TURNS[stem] for word in spoken for stem in (word, word.removesuffix("s")) if stem in _TURNS]
    return found[-1] if found else _OTHER_TURN
