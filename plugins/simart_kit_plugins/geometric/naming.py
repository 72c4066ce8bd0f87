"""Names that a person would give: left_door, upper_drawer, drawer_2."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from .movers import Mover
from .scene import Box, Scene


def names(scene: Scene, movers: Sequence[Mover]) -> list[str]:
    """A name a mover. Two of a kind are told apart by their side, more by a number from top left."""
    centers = [_center(scene, mover) for mover in movers]
    result = [""] * len(movers)
    for label in dict.fromkeys(mover.label for mover in movers):
        same = [i for i, mover in enumerate(movers) if mover.label == label]
        if len(same) == 1:
            result[same[0]] = label
        elif len(same) == 2:
            for index, side in zip(same, _sides(centers[same[0]], centers[same[1]]), strict=True):
                result[index] = f"{side}_{label}"
        else:
            reading = sorted(same, key=lambda i: (-round(centers[i][2], 2), centers[i][0], centers[i][1]))
            for number, index in enumerate(reading, start=1):
                result[index] = f"{label}_{number}"
    return result


def _center(scene: Scene, mover: Mover) -> FloatArray:
    return Box.around([scene.boxes[i] for i in mover.pieces]).center


def _sides(a: FloatArray, b: FloatArray) -> tuple[str, str]:
    words = (("left", "right"), ("front", "back"), ("lower", "upper"))
    apart = a - b
    axis = int(np.abs(apart).argmax())
    low, high = words[axis]
    return (low, high) if apart[axis] < 0 else (high, low)
