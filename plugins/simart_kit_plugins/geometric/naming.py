"""Names that a person would give: left_door, upper_drawer, drawer_2."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit import Segmentation
from simart_kit.arrays import FloatArray, frozen_ints

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


def in_order(found: Segmentation) -> Segmentation:
    """The same parts and joints, those that numbers tell apart in the order of these; all others in place.

    Joints come in the order of parts: positions of drawers 1 to 4 follow each other in a simulator.
    """
    kinds, numbers = zip(*(_numbered(guess.name) for guess in found.parts), strict=True)
    places = {kind: [i for i, other in enumerate(kinds) if other == kind] for kind in kinds}
    order = [0] * len(kinds)
    for same in places.values():
        for place, part in zip(same, sorted(same, key=lambda i: numbers[i]), strict=True):
            order[place] = part
    parts = tuple(found.parts[part] for part in order)
    rank = {guess.name: place for place, guess in enumerate(parts)}
    joints = found.joints and tuple(sorted(found.joints, key=lambda joint: rank[joint.child]))
    face_part = frozen_ints(np.argsort(order)[found.face_part])
    return replace(found, face_part=face_part, parts=parts, joints=joints)


def _numbered(name: str) -> tuple[str, int]:
    """What a name is without its number, and that; 0 without one."""
    numbered = re.fullmatch(r"(.+_)(\d+)", name)
    return (numbered[1], int(numbered[2])) if numbered else (name, 0)


def _center(scene: Scene, mover: Mover) -> FloatArray:
    return Box.around([scene.boxes[i] for i in mover.pieces]).center


def _sides(a: FloatArray, b: FloatArray) -> tuple[str, str]:
    words = (("left", "right"), ("front", "back"), ("lower", "upper"))
    apart = a - b
    axis = int(np.abs(apart).argmax())
    low, high = words[axis]
    return (low, high) if apart[axis] < 0 else (high, low)
