"""Links as a file states them, as the parts and joints of a Segmentation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit import BadInputError, Joint, Limits, PartGuess
from simart_kit.arrays import UP, FloatArray, IntArray, Vec3, frozen_ints, vec3
from simart_kit.asset import clean_name, unique_names
from simart_kit.bench.articulation import Articulation, Link, LinkJoint

from .empty_links import shaped_links

UNLIMITED_TURN = math.pi / 2
"""How far a turn goes either way where nobody said [rad]."""
UNLIMITED_SLIDE = 0.5
"""How far a slide goes then, as a share of the object's length; its part's length, if that is more."""


@dataclass(frozen=True, eq=False)
class Stated:
    """Parts and joints of an object, in its own frame.

    Attributes:
        face_part: (F,) part of each face.
        places: of each part, its index among the links that were given.
        parts: named as the links are, in clean and unique words.
        joints: (P,) joint that moves each part; None for a root.
        joint_sources: (P,) name of each joint in its source, "" where it has none.
        notes: what was decided or lost.
    """

    face_part: IntArray
    places: tuple[int, ...]
    parts: tuple[PartGuess, ...]
    joints: tuple[Joint | None, ...]
    joint_sources: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def hints(self) -> tuple[Joint, ...]:
        """The joints."""
        return tuple(joint for joint in self.joints if joint is not None)


def stated(whole: Articulation) -> Stated:
    """Parts and joints of an object whose every face has a link.

    Raises:
        BadInputError: a face has none, or nothing stands still (see `shaped_links`).
    """
    if whole.labels.min() < 0:
        raise BadInputError(f"{int((whole.labels < 0).sum())} faces are of no part")
    tree = shaped_links(whole.links, set(np.unique(whole.labels).tolist()))
    place_of = np.full(len(whole.links), -1)
    place_of[list(tree.places)] = range(len(tree.places))
    face_part, notes = place_of[whole.labels], [*tree.notes, *_left_out(tree.links)]
    names = unique_names([clean_name(link.name) for link in tree.links])
    told = [link.joint.name or f"{name}_joint" for link, name in zip(tree.links, names, strict=True)]
    joint_names = unique_names([clean_name(name, "joint") for name in told])
    joints: list[Joint | None] = []
    for index, link in enumerate(tree.links):
        joint = None
        if link.parent >= 0:
            corners = whole.triangles[face_part == index].reshape(-1, 3)
            limits, doubts = _limits(link.joint, joint_names[index], corners, whole.bounds)
            joint = _joint(
                link, names[link.parent], names[index], joint_names[index], _middle(corners), limits
            )
            notes += doubts
        joints.append(joint)
    return Stated(
        frozen_ints(face_part),
        tree.places,
        tuple(_guess(link, name) for link, name in zip(tree.links, names, strict=True)),
        tuple(joints),
        tuple(link.joint.name for link in tree.links),
        (*notes, *_renamed(tree.links, names)),
    )


def _guess(link: Link, name: str) -> PartGuess:
    return PartGuess(name, label=clean_name(link.label, "") if link.label else "", score=link.confidence)


def _joint(link: Link, parent: str, child: str, name: str, middle: Vec3, limits: Limits | None) -> Joint:
    """The joint of a link; one without a place is put in the middle of its part."""
    said = link.joint
    return Joint(
        name,
        "free" if said.kind == "unknown" else said.kind,
        parent,
        child,
        said.origin or middle,
        said.axis or UP,
        limits,
        confidence=link.confidence,
    )


def _limits(
    said: LinkJoint, name: str, corners: FloatArray, bounds: FloatArray
) -> tuple[Limits | None, list[str]]:
    """Limits that include 0, for the kinds that have any, and what had to be decided.

    Args:
        said: what the file says.
        name: of the joint.
        corners: (N, 3) of the faces that it moves.
        bounds: (2, 3) of the object.
    """
    if said.kind == "unknown":
        return None, [f"{name}: there is no kind of joint that moves so: it is left free"]
    if said.kind not in ("revolute", "prismatic"):
        return None, []
    if said.lower is None or said.upper is None:
        reach, amount = UNLIMITED_TURN, f"{math.degrees(UNLIMITED_TURN):.0f} degrees"
        if said.kind == "prismatic":
            axis = np.array(said.axis)
            reach = float(
                max(np.ptp(corners @ axis), UNLIMITED_SLIDE * np.ptp(bounds, axis=0) @ np.abs(axis))
            )
            amount = f"{reach:.3g} m"
        return Limits(-reach, reach), [f"{name}: no limits are given, {amount} either way is taken"]
    lower, upper = sorted((said.lower, said.upper))
    text = f"{name}: limits {said.lower:.4g} to {said.upper:.4g}"
    notes = [f"{text} are reversed: taken the other way round"] if said.lower > said.upper else []
    if not lower <= 0 <= upper:
        notes.append(f"{text} do not include 0, the pose of the mesh: extended to it")
    return Limits(min(lower, 0.0), max(upper, 0.0)), notes


def _middle(corners: FloatArray) -> Vec3:
    return vec3((corners.min(axis=0) + corners.max(axis=0)) / 2)


def _left_out(links: Sequence[Link]) -> list[str]:
    """Movements that a part of an asset cannot have."""
    roots = [link.name for link in links if link.parent < 0 and link.joint.kind not in ("fixed", "free")]
    texts = [f"'{name}' moves against the world: it is the base here, and stands still" for name in roots]
    several = [link for link in links if link.also]
    for link in several:
        kinds = " and ".join(joint.kind for joint in link.also)
        texts.append(f"'{link.name}' can move in several ways: only the first is kept, not the {kinds} one")
    return texts


def _renamed(links: Sequence[Link], names: Sequence[str]) -> list[str]:
    told = [f"'{link.name}' is {name}" for link, name in zip(links, names, strict=True) if link.name != name]
    more = f" and {len(told) - 5} more" if len(told) > 5 else ""
    return [f"names in plain letters: {', '.join(told[:5])}{more}"] if told else []
