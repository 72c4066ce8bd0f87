"""A joint of UsdPhysics as a Link."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray, vec3
from ..asset import JointKind
from .mechanism import Link
from .reading_usd_numbers import moved, number, rotation

if TYPE_CHECKING:
    from pxr import Usd, UsdPhysics

_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
_KINDS: dict[str, JointKind] = {
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsSphericalJoint": "ball",
    "PhysicsFixedJoint": "fixed",
}
_DEGREE = math.radians(1.0)


@dataclass(frozen=True, eq=False)
class Ends:
    """What a joint connects.

    Attributes:
        parent: name of the body that carries, or "world".
        child: name of the body that moves.
        world_T_child: (4, 4) its frame [m].
    """

    parent: str
    child: str
    world_T_child: FloatArray


def link_of(joint: UsdPhysics.Joint, ends: Ends, meters: float) -> Link:
    """A joint in the world's frame.

    Args:
        joint: its frame is that in its child.
        ends: what it connects.
        meters: of a unit of the stage.
    """
    prim = joint.GetPrim()
    kind = _KINDS.get(prim.GetTypeName(), "free")
    lower, upper = _limits(prim, kind, meters)
    if kind == "revolute" and lower is None:
        kind = "continuous"
    axis = ends.world_T_child[:3, :3] @ rotation(joint.GetLocalRot1Attr().Get()) @ _axis(prim)
    origin = moved(ends.world_T_child, np.array([joint.GetLocalPos1Attr().Get()], dtype=np.float64))[0]
    turns = kind in ("revolute", "continuous")
    damping = number(prim, f"drive:{'angular' if turns else 'linear'}:physics:damping")
    return Link(
        prim.GetName(),
        kind,
        ends.parent,
        ends.child,
        vec3(origin),
        vec3(axis / np.linalg.norm(axis)),
        lower,
        upper,
        damping / (_DEGREE if turns else 1.0),
        number(prim, "newton:friction"),
        number(prim, "newton:armature"),
    )


def _axis(prim: Usd.Prim) -> FloatArray:
    """(3,) in the joint's frame; z where the kind of joint has none."""
    attribute = prim.GetAttribute("physics:axis")
    return np.array(_AXES[str(attribute.Get()) if attribute else "Z"])


def _limits(prim: Usd.Prim, kind: JointKind, meters: float) -> tuple[float | None, float | None]:
    """Travel [rad | m]; USD says by infinity that there is no limit, which here both ends have or neither."""
    if kind not in ("revolute", "prismatic"):
        return None, None
    unit = _DEGREE if kind == "revolute" else meters
    lower, upper = (float(prim.GetAttribute(f"physics:{end}Limit").Get()) for end in ("lower", "upper"))
    return (lower * unit, upper * unit) if math.isfinite(lower) or math.isfinite(upper) else (None, None)
