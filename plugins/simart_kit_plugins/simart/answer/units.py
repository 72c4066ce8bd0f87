"""Parts and joints to the answer that a model is to give, and an answer to parts and joints."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from simart_kit import Joint, Limits, Note, PartGuess
from simart_kit.arrays import UP, Vec3, vec3
from simart_kit.asset import JointKind, Material, clean_name, unique_names
from simart_kit.errors import BadInputError
from simart_kit.materials import MATERIALS
from simart_kit.voxels import GridFrame

from ..tokens import VoxelTokens
from .choices import choose_material, material_of, material_text, said
from .scales import (
    FULL_TURN,
    direction,
    grid_point,
    metres,
    point_of,
    radians,
    slide,
    turn,
    unit_of,
)
from .tree import Place, ordered
from .values import Motion, ObjectAnswer, PartAnswer, PartType

_STAGE = "segment"
_DIGITS = 3
_SUFFIX: dict[JointKind, str] = {
    "fixed": "mount",
    "revolute": "hinge",
    "continuous": "spin",
    "prismatic": "slide",
    "ball": "ball",
    "free": "free",
}
_NAMELESS, _NAMELESS_PART = "object", "part"


def answer_of(
    name: str,
    longest_side: float,
    parts: Sequence[PartGuess],
    joints: Sequence[Joint],
    tokens: Sequence[VoxelTokens],
    frame: GridFrame,
    materials: Sequence[Material | None] | None = None,
) -> ObjectAnswer:
    """The answer that says these parts and joints, rounded to its whole numbers (see `scales`).

    Parts come root first, level by level. A part that no joint moves is fixed to the root, which is the one
    with most cells of those. Continuous joints are turns by (-100, 100); ball joints are of type hinge.

    Args:
        name: of the object, any text.
        longest_side: its longest side in reality [m].
        parts: (P,) with unique names.
        joints: in the mesh's frame [m].
        tokens: (P,) of each part.
        frame: the object's cube, `codec.object_frame`.
        materials: (P,) density and stiffness of each part, None where they are not said; without the list,
            those of the rows of the material table that the parts name.

    Raises:
        BadInputError: no part, a length that is none, tokens or materials of another number than parts, or
            joints that are no tree of these parts.
    """
    if len(tokens) != len(parts):
        raise BadInputError(f"{len(tokens)} token sequences for {len(parts)} parts")
    if not (math.isfinite(longest_side) and longest_side > 0):
        raise BadInputError(f"a longest side of {longest_side} m is no length")
    matter = materials if materials is not None else [MATERIALS.get(part.material) for part in parts]
    if len(matter) != len(parts):
        raise BadInputError(f"{len(matter)} materials for {len(parts)} parts")
    places = ordered(parts, joints, [len(sequence.index) for sequence in tokens])
    told = tuple(_part(p, parts[p.part], matter[p.part], tokens[p.part], frame) for p in places)
    return ObjectAnswer(said(name) or _NAMELESS, _rounded(longest_side * 100), told)


def joints_of(
    answer: ObjectAnswer,
    names: Sequence[str],
    frame: GridFrame,
    confidence: Sequence[float] | None = None,
) -> tuple[tuple[Joint, ...], tuple[Note, ...]]:
    """The joints of an answer, one for every part but the root, and what could not be taken as it is said.

    Args:
        answer: what the model said.
        names: (P,) unique names of its parts, such as those of `guesses_of`.
        frame: the object's cube.
        confidence: (P,) of the joint that moves each part, 0..1; None: 1 for all.
    """
    if len(names) != len(answer.parts):
        raise BadInputError(f"{len(names)} names for {len(answer.parts)} parts")
    sure = confidence if confidence is not None else [1.0] * len(names)
    called = unique_names([_joint_name(n, part) for n, part in zip(names, answer.parts, strict=True)])
    joints: list[Joint] = []
    notes: list[Note] = []
    for number, part in enumerate(answer.parts):
        if part.parent is None:
            continue
        joint = Joint(
            called[number],
            _joint_kind(part),
            names[part.parent],
            names[number],
            _origin(part, frame),
            unit_of(part.motion.axis) if part.motion and part.motion.axis else UP,
            _joint_limits(part, frame),
            confidence=sure[number],
        )
        joints.append(joint)
        notes += [Note(_STAGE, "warning", f"joint '{joint.name}': {text}") for text in _doubts(part)]
    return tuple(joints), tuple(notes)


def guesses_of(answer: ObjectAnswer) -> tuple[PartGuess, ...]:
    """The parts of an answer, in its order: names clean and unique, materials those of the table."""
    names = unique_names([_part_name(number, part) for number, part in enumerate(answer.parts)])
    return tuple(
        PartGuess(
            name,
            label=_label(part.name),
            material=material_of(part.material, part.density),
            description=part.name,
            material_stated=True,
        )
        for name, part in zip(names, answer.parts, strict=True)
    )


def material_notes(answer: ObjectAnswer) -> tuple[Note, ...]:
    """What `guesses_of` made of materials that are not in the table."""
    notes = []
    for number, part in enumerate(answer.parts):
        choice = choose_material(part.material, part.density)
        said_so = f"material '{part.material}'" if part.material else "no material"
        if choice.by == "density":
            text = f"part {number}: {said_so}, density {part.density:g} g/cm^3: taken for {choice.material}"
            notes.append(Note(_STAGE, "info", text))
        elif choice.by == "default":
            text = f"part {number}: {said_so} of the table and no density: {choice.material} is used"
            notes.append(Note(_STAGE, "warning", text))
    return tuple(notes)


def _part(
    place: Place, guess: PartGuess, material: Material | None, tokens: VoxelTokens, frame: GridFrame
) -> PartAnswer:
    return PartAnswer(
        _part_type(place.joint),
        tokens,
        said(guess.name) or _NAMELESS_PART,
        place.parent,
        _motion(place.joint, frame) if place.joint else None,
        material_text(guess.material),
        _rounded(material.density / 1000) if material else None,
        _rounded(material.youngs_modulus / 1e9) if material else None,
    )


def _part_type(joint: Joint | None) -> PartType:
    if joint is None:
        return "fixed"
    if joint.kind == "ball":
        return "hinge"
    return "revolute" if joint.kind == "continuous" else joint.kind


def _motion(joint: Joint, frame: GridFrame) -> Motion | None:
    if joint.kind in ("fixed", "free"):
        return None
    if joint.kind == "ball":
        return Motion(grid_point(joint.origin, None, frame))
    center = grid_point(joint.origin, joint.axis, frame)
    axis = direction(joint.axis)
    if joint.limits is None:
        return Motion(center, axis.axis, (-FULL_TURN // 2, FULL_TURN // 2))
    lower, upper = joint.limits.lower, joint.limits.upper
    if joint.kind == "prismatic":
        return Motion(center, axis.axis, slide(lower, upper, axis.flipped, frame))
    return Motion(center, axis.axis, turn(lower, upper, axis.flipped))


def _joint_kind(part: PartAnswer) -> JointKind:
    if part.type in ("fixed", "free", "prismatic"):
        return part.type
    if part.motion is None or part.motion.limits is None:
        return "ball"
    lower, upper = part.motion.limits
    return "continuous" if upper - lower >= FULL_TURN else "revolute"


def _joint_limits(part: PartAnswer, frame: GridFrame) -> Limits | None:
    """Limits [rad or m], moved where need be so that they include 0, which is the pose of the input."""
    if part.motion is None or part.motion.limits is None or _joint_kind(part) == "continuous":
        return None
    lower, upper = min(part.motion.limits[0], 0), max(part.motion.limits[1], 0)
    if part.type == "prismatic":
        return Limits(metres(lower, frame), metres(upper, frame))
    return Limits(radians(lower), radians(upper))


def _origin(part: PartAnswer, frame: GridFrame) -> Vec3:
    """(3,) where the joint is [m]: its center, or the middle of a free part's cells."""
    if part.motion is not None:
        return point_of(part.motion.center, frame)
    if part.type != "free" or not len(part.voxels.index):
        return (0.0, 0.0, 0.0)
    shares = (part.voxels.coordinates + 0.5) / np.array(part.voxels.grid.shape)
    return vec3(frame.to_world(shares.mean(axis=0) * frame.resolution))


def _doubts(part: PartAnswer) -> list[str]:
    """What of a part's motion a joint cannot say as the answer does."""
    if part.motion is None:
        return []
    if part.motion.limits is None:
        return ["a hinge without axis and limits is taken for a ball joint, which has no limits here"]
    lower, upper = part.motion.limits
    if lower == upper:
        return [f"limits [{lower}, {upper}] leave no way to move"]
    if not lower <= 0 <= upper and _joint_kind(part) != "continuous":
        return [f"limits [{lower}, {upper}] do not include 0, the pose of the mesh: they are extended to it"]
    return []


def _joint_name(part_name: str, part: PartAnswer) -> str:
    return f"{clean_name(part_name)}_{_SUFFIX[_joint_kind(part)]}"


def _part_name(number: int, part: PartAnswer) -> str:
    return clean_name(part.name, fallback=f"part_{number}" if number else "base")


def _label(name: str) -> str:
    """What kind of thing a part is: its name without the number that tells it from its like."""
    return re.sub(r"[ _\-]*[0-9]+\Z", "", name)


def _rounded(value: float) -> float:
    """A number as an answer says it: three digits."""
    return float(f"{value:.{_DIGITS}g}")
