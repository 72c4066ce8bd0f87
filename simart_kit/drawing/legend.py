"""Colours and words for the joints of an asset."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..asset import Asset, Joint
from ..colors import Color, part_color
from ..kinematics import ordered_joints


@dataclass(frozen=True)
class Entry:
    """One line of the legend.

    Attributes:
        joint: a joint that moves.
        color: of its part in pictures.
        text: the part's name, the kind of joint and its range.
    """

    joint: Joint
    color: Color
    text: str


def legend(asset: Asset) -> tuple[Entry, ...]:
    """An entry for every joint that moves, in the asset's order; none for a static object."""
    return tuple(_entry(asset, joint) for joint in asset.joints if joint.moves)


def part_entries(asset: Asset) -> dict[str, Entry]:
    """By part name, the entry of the nearest joint that moves it; parts of the body are left out."""
    entries = {e.joint.name: e for e in legend(asset)}
    found: dict[str, Entry] = {}
    for joint in ordered_joints(asset):
        entry = entries.get(joint.name) or found.get(joint.parent)
        if entry:
            found[joint.child] = entry
    return found


def summary(asset: Asset) -> str:
    """One line: the name and what moves."""
    moving = sum(j.moves for j in asset.joints)
    if not moving:
        return f"{asset.name}, static: nothing moves"
    return f"{asset.name}: {_count(len(asset.parts), 'part')}, {_count(moving, 'joint')}"


def _entry(asset: Asset, joint: Joint) -> Entry:
    text = f"{joint.child}: {joint.kind}{_range(joint)}{', flagged' * bool(joint.flags)}"
    return Entry(joint, part_color(asset.part_index(joint.child)), text)


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' * (number != 1)}"


def _range(joint: Joint) -> str:
    if joint.limits is None:
        return ""
    lower, upper = joint.limits.lower, joint.limits.upper
    if joint.kind == "prismatic":
        return f", {_number(100 * lower, 1)} to {_number(100 * upper, 1)} cm"
    return f", {_number(np.rad2deg(lower), 0)} to {_number(np.rad2deg(upper), 0)}°"


def _number(value: float, digits: int) -> str:
    return f"{round(float(value), digits) + 0.0:.{digits}f}".removesuffix(".0")
