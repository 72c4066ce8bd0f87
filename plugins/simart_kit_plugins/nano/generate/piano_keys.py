"""A row of keys as pianos have them."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.placing import moved
from ...shapes.primitives import Pieces, between, box
from .objects import Look, Motion, hinge

Key = tuple[Motion, list[tuple[Pieces, Look]]]
DIP = 0.05
"""How far a key tips [rad]."""
_WIDE = 0.06
"""From this pitch on [m] black keys are a part of white ones, as on toys."""


def key_row(
    spot: tuple[float, float, float] | FloatArray,
    count: int,
    pitch: float,
    long: float,
    white: Look,
    black: Look,
) -> list[Key]:
    """Keys that tip about their back ends; black ones lie between narrow ones, and are part of wide ones.

    Args:
        spot: the middle of the front edge, at the height of the undersides.
        count: of white keys.
        pitch: from one white key to the next [m].
        long: of a key [m]; its front goes down by `DIP` times that.
        white: look of white ones.
        black: look of black ones.
    """
    (x, y, z), thick, cut, wide = spot, min(0.02, 0.5 * pitch), 0.29 * pitch, pitch >= _WIDE
    dark = [0 < k < count and not wide and (count + k) % 7 not in (2, 6) for k in range(count + 1)]
    form = box((2 * cut - 0.003, 0.61 * long, 1.6 * thick), (0, -0.305 * long, 0.8 * thick))
    row: list[Key] = []
    for k in range(count):
        at = np.array([x + (k - count / 2) * pitch, y + long, z])
        low, high = (cut if dark[k] else 0.0012), pitch - (cut if dark[k + 1] else 0.0012)
        key: Pieces = [between((0.0012, -long, 0), (pitch - 0.0012, -0.63 * long, thick))]
        key.append(between((low, -0.64 * long, 0), (high, 0, thick)))
        parts: list[tuple[Pieces, Look]] = [(moved(key, at), white)]
        if wide:
            parts.append(([form * [0.6, 1, 1] + at + [pitch / 2, 0, 0]], black))
        motion = hinge(at + [0, 0, thick], (1, 0, 0), DIP)
        row.append((motion, parts))
        if dark[k + 1]:
            row.append((motion, [([form + at + [pitch, 0, 0]], black)]))
    return row
