"""What a judge read, against the asset that was written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from simart_kit.asset import Asset, Joint
from simart_kit.kinematics import forward, rest_origin, sample_positions, span

POSE = 1e-6  # [m], and entries of rotations
NUMBER = 1e-5  # of masses, centres [m], inertias and limits
POSES = 3


@dataclass(frozen=True)
class Verdict:
    """What came of one file.

    Attributes:
        errors: what is wrong, a line each.
        pose_error: largest difference of any pose [m, and entries of rotations]; None where none was told.
        seconds: that reading took.
    """

    errors: tuple[str, ...]
    pose_error: float | None
    seconds: float


def positions_of(asset: Asset) -> list[dict[str, float]]:
    """Joint positions to ask for: the rest pose, and random ones within the limits."""
    rng = np.random.default_rng(7)
    return [{}, *(sample_positions(asset, rng) for _ in range(POSES - 1))]


def compare(asset: Asset, reading: Mapping[str, Any]) -> Verdict:
    """A judge's own errors, and where its reading differs from the asset; see `scripts/verdict.py`."""
    errors = [str(text) for text in reading["errors"]]
    pose_error = None
    if "poses" in reading:
        pose_error, wrong = _poses(asset, reading["poses"])
        errors += wrong
    if "inertials" in reading:
        errors += _inertials(asset, reading["inertials"])
    if "limits" in reading:
        errors += _limits(asset, reading["limits"])
    if "colliders" in reading:
        errors += _colliders(asset, reading["colliders"])
    return Verdict(tuple(errors), pose_error, float(reading["seconds"]))


def _poses(asset: Asset, read: Sequence[Mapping[str, Any]]) -> tuple[float, list[str]]:
    """The largest difference and what is wrong; the root stands at the origin, which not all tools tell."""
    worst, errors = 0.0, []
    for positions, poses in zip(positions_of(asset), read, strict=True):
        for name, world_T_part in forward(asset, positions).items():
            if name not in poses:
                errors += [] if name == asset.root.name else [f"no link '{name}'"]
                continue
            off = float(np.abs(np.array(poses[name]) - world_T_part).max())
            worst = max(worst, off)
            if not off < POSE:
                errors.append(f"link '{name}' is off by {off:.1e} at {_told(positions)}")
    return worst, sorted(set(errors))


def _inertials(asset: Asset, read: Mapping[str, Any]) -> list[str]:
    errors = []
    for part in asset.parts:
        if part.mass is None:
            continue
        if part.name not in read:
            errors.append(f"no mass of '{part.name}'")
            continue
        found, center = read[part.name], np.array(part.mass.center) - rest_origin(asset, part.name)
        inertia = np.array(part.mass.inertia)
        differences = {
            "mass": abs(found["mass"] / part.mass.mass - 1),
            "centre of mass": np.abs(np.array(found["center"]) - center).max(),
            "inertia": np.abs(np.array(found["inertia"]) - inertia).max() / np.abs(inertia).max(),
        }
        errors += [
            f"{what} of '{part.name}' is off by {d:.1e}" for what, d in differences.items() if not d < NUMBER
        ]
    return errors


def _limits(asset: Asset, read: Mapping[str, Any]) -> list[str]:
    errors = []
    for joint in asset.joints:
        if span(joint) == (0.0, 0.0):  # held, or of several axes
            continue
        if joint.name not in read:
            errors.append(f"no joint '{joint.name}'")
        elif not _same_range(joint, read[joint.name]):
            errors.append(f"limits of '{joint.name}' are {read[joint.name]}, expected {joint.limits}")
    return errors


def _same_range(joint: Joint, read: Sequence[float] | None) -> bool:
    if joint.limits is None or read is None:
        return joint.limits is None and read is None
    return bool(np.allclose(read, (joint.limits.lower, joint.limits.upper), rtol=0, atol=NUMBER))


def _colliders(asset: Asset, read: Mapping[str, int]) -> list[str]:
    written = {part.name: len(part.collision) for part in asset.parts}
    found = {name: read.get(name, 0) for name in [*written, *read]}
    return [
        f"'{name}' has {count} collision shapes, {written.get(name, 0)} were written"
        for name, count in found.items()
        if count != written.get(name, 0)
    ]


def _told(positions: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {value:.3f}" for name, value in positions.items()) or "rest"
