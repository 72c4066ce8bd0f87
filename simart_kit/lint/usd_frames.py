"""How far the two frames of a USD joint are apart at rest, and how much of that its motion explains."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from .usd_scene import UsdScene, stated

if TYPE_CHECKING:
    from pxr import Usd

AXES = {"X": 0, "Y": 1, "Z": 2}


@dataclass(frozen=True)
class Gap:
    """What is between the two frames of a joint at rest.

    Attributes:
        distance: that the joint cannot bridge [units of the stage].
        angle: that the joint cannot bridge [rad].
        position: of the joint, which its motion does bridge [rad or units of the stage].
    """

    distance: float
    angle: float
    position: float


def rest_gap(scene: UsdScene, joint: Usd.Prim) -> Gap | None:
    """The gap of a fixed, revolute, prismatic or spherical joint; None for others and for broken frames."""
    frames = (_frame(scene, joint, 0), _frame(scene, joint, 1))
    if frames[0] is None or frames[1] is None:
        return None
    between = np.linalg.inv(frames[0]) @ frames[1]
    shift, turn = between[:3, 3], between[:3, :3]
    axis = AXES.get(stated(joint, "physics:axis") or "X", 0)
    kind = joint.GetTypeName()
    if kind == "PhysicsFixedJoint":
        return Gap(_length(shift), _angle(turn), 0.0)
    if kind == "PhysicsSphericalJoint":
        return Gap(_length(shift), 0.0, 0.0)
    if kind == "PhysicsRevoluteJoint":
        # Only what leaves the axis where it is can be a turn about it.
        tilt = float(np.arctan2(_length(np.delete(turn[:, axis], axis)), turn[axis, axis]))
        one, two = (axis + 1) % 3, (axis + 2) % 3
        return Gap(_length(shift), tilt, float(np.arctan2(turn[two, one], turn[one, one])))
    if kind == "PhysicsPrismaticJoint":
        return Gap(_length(np.delete(shift, axis)), _angle(turn), float(shift[axis]))
    return None


def _frame(scene: UsdScene, joint: Usd.Prim, side: int) -> FloatArray | None:
    """(4, 4) frame of a joint on one side, without scale; None where its rotation is none."""
    from pxr import Gf

    targets = joint.GetRelationship(f"physics:body{side}").GetTargets()
    world_T_body = scene.pose(scene.stage.GetPrimAtPath(targets[0])) if targets else np.eye(4)
    point = stated(joint, f"physics:localPos{side}")
    turn = stated(joint, f"physics:localRot{side}") or Gf.Quatf(1.0)
    if not 0.5 < turn.GetLength() < 2.0:
        return None
    body_T_frame = np.eye(4)
    body_T_frame[:3, :3] = np.array(Gf.Matrix3d(Gf.Quatd(turn.GetNormalized()))).T
    body_T_frame[:3, 3] = (0.0, 0.0, 0.0) if point is None else point
    frame = world_T_body @ body_T_frame
    sizes = np.linalg.norm(frame[:3, :3], axis=0)
    if not np.isfinite(frame).all() or not sizes.all():
        return None
    frame[:3, :3] /= sizes
    return np.asarray(frame) if abs(np.linalg.det(frame)) > 1e-6 else None


def _length(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector))


def _angle(turn: FloatArray) -> float:
    """Angle of a (3, 3) rotation [rad], exact for small ones too."""
    sine = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return float(np.arctan2(_length(sine), np.trace(turn) - 1))
