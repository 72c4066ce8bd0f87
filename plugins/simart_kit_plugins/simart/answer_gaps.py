"""What the paper's JSON cannot say of an asset: what differs when it is read back."""

from __future__ import annotations

import math

import numpy as np

from simart_kit.asset import Asset, Joint
from simart_kit.voxels import GridFrame

from .answer.scales import edge, metres, radians
from .answer.tree import ordered
from .answer.units import guesses_of, joints_of
from .answer.values import CENTER_MAX, SLIDE_MAX, Motion
from .asset_answer import answer_with, part_guesses
from .codec import object_frame
from .tokens import TokenGrid, VoxelTokens

_LEFT_OUT = "looks, labels, masses, collision shapes and the resistance of joints are left out"


def gaps(asset: Asset, codec: str) -> tuple[str, ...]:
    """A sentence for each thing that is lost, naming its joints or parts, and what is written instead.

    Args:
        asset: that was written.
        codec: fingerprint of the voxel model.
    """
    frame = object_frame(asset.mesh)
    nothing = VoxelTokens(TokenGrid(), np.zeros(0, np.int32), np.zeros(0, np.int32))
    answer = answer_with(asset, [nothing] * len(asset.parts), frame)
    places = ordered(part_guesses(asset), asset.joints, [0] * len(asset.parts))
    names = [asset.parts[place.part].name for place in places]
    joints = [place.joint for place in places if place.joint]
    heard, _ = joints_of(answer, names, frame)
    pairs = list(zip(joints, heard, strict=True))
    motions = [part.motion for part in answer.parts[1:]]
    called = [name for name, guess in zip(names, guesses_of(answer), strict=True) if guess.name != name]
    found = (
        ("names are shortened", called),
        (
            "a ball joint is a hinge with a center alone, which the paper does not tell of",
            [j.name for j in joints if j.kind == "ball"],
        ),
        ("where a free joint sits is not said", [j.name for j in joints if j.kind == "free"]),
        ("a turn of some 360 degrees or more has no ends", [j.name for j, h in pairs if _endless(j, h)]),
        ("limits are the nearest that can be said", [j.name for j, h in pairs if _cut(j, h, frame)]),
        (
            "the axis does not pass the object's cube: center is near it",
            [j.name for j, h in pairs if _moved(j, h, frame)],
        ),
        (
            "the axis has numbers below 0, which the paper's form has not",
            [j.name for j, motion in zip(joints, motions, strict=True) if _mixed(motion)],
        ),
    )
    return (
        _LEFT_OUT,
        f"codes are those of voxel model {codec}, which the form has no key for",
        *([_rounding(frame)] if any(motions) else []),
        *(["the first part is always fixed: that the object is free is not said"] if asset.floating else []),
        *(f"{text}: {', '.join(those)}" for text, those in found if those),
    )


def _rounding(frame: GridFrame) -> str:
    side = edge(frame)
    return (
        f"numbers are whole: centers are {side / CENTER_MAX:.2g} m apart, "
        f"limits of slides {side / SLIDE_MAX:.2g} m, those of turns {math.degrees(radians(1)):.2g} degrees"
    )


def _endless(joint: Joint, heard: Joint) -> bool:
    return joint.kind == "revolute" and heard.kind == "continuous"


def _cut(joint: Joint, heard: Joint, frame: GridFrame) -> bool:
    """Whether limits were changed by more than rounding does."""
    if joint.limits is None or heard.limits is None:
        return False
    ends = np.array([heard.limits.lower, heard.limits.upper])
    if np.dot(joint.axis, heard.axis) < 0:
        ends = -ends[::-1]
    half = (metres(1, frame) if joint.kind == "prismatic" else radians(1)) / 2
    change = np.abs(ends - [joint.limits.lower, joint.limits.upper])
    return bool(change.max() > half * (1 + 1e-9))


def _moved(joint: Joint, heard: Joint, frame: GridFrame) -> bool:
    """Whether the axis of a turn, or the middle of a ball, went farther than rounding moves it."""
    if not (joint.turns or joint.kind == "ball"):
        return False
    away = np.array(heard.origin) - np.array(joint.origin)
    if joint.turns:
        away -= np.array(joint.axis) * float(away @ np.array(joint.axis))
    most = math.sqrt(3) / 2 * edge(frame) / CENTER_MAX
    return bool(np.linalg.norm(away) > most * (1 + 1e-9))


def _mixed(motion: Motion | None) -> bool:
    return motion is not None and motion.axis is not None and min(motion.axis) < 0
