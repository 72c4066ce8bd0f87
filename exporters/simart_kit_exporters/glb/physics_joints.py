"""Joints of KHR_physics_rigid_bodies: two attachment frames, and limits on how they may differ."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.kinematics import rest_origin

from .builder import Builder, Json

EXTENSION = "KHR_physics_rigid_bodies"
_X, _ACROSS, _ALL = [0], [1, 2], [0, 1, 2]  # X is along the joint's axis


def add_joints(builder: Builder, asset: Asset, nodes: list[Json]) -> list[Json]:
    """Add the attachment frames of every joint that is not free; returns the descriptions of the joints.

    Args:
        builder: that the nodes are in.
        asset: in the frame of the file.
        nodes: of the parts, in the asset's order; they get the frames as children.
    """
    joints = [joint for joint in asset.joints if joint.kind != "free"]
    for index, joint in enumerate(joints):
        turn = _x_to(np.array(joint.axis)) if joint.kind != "ball" else [0.0, 0.0, 0.0, 1.0]
        moved = builder.add("nodes", {"name": f"{joint.name}_moved", "rotation": turn})
        origin = rest_origin(asset, joint.child) - rest_origin(asset, joint.parent)
        ends = {"connectedNode": moved, "joint": index, "enableCollision": False}
        frame = {
            "name": f"{joint.name}_frame",
            "translation": origin.tolist(),
            "rotation": turn,
            "extensions": {EXTENSION: {"joint": ends}},
        }
        fixed = builder.add("nodes", frame)
        nodes[asset.part_index(joint.child)].setdefault("children", []).append(moved)
        nodes[asset.part_index(joint.parent)].setdefault("children", []).append(fixed)
    return [_description(joint) for joint in joints]


def _description(joint: Joint) -> Json:
    result: Json = {"limits": _limits(joint)}
    if joint.damping and (joint.turns or joint.kind == "prismatic"):
        drive = {
            "type": "angular" if joint.turns else "linear",
            "mode": "force",
            "axis": 0,
            "velocityTarget": 0.0,
            "damping": joint.damping,
        }
        if joint.effort:  # a limit of 0 would switch the damping off
            drive["maxForce"] = joint.effort
        result["drives"] = [drive]
    return result


def _limits(joint: Joint) -> list[Json]:
    """What is held, and the range of what is not; a direction that is not named is free."""
    still = {"min": 0.0, "max": 0.0}
    place, turn = {"linearAxes": _ALL, **still}, {"angularAxes": _ALL, **still}
    travel = {"min": joint.limits.lower, "max": joint.limits.upper} if joint.limits else {}
    if joint.kind == "ball":
        return [place]
    if joint.kind == "prismatic":
        return [turn, {"linearAxes": _ACROSS, **still}, {"linearAxes": _X, **travel}]
    if joint.turns:
        swing = [{"angularAxes": _X, **travel}] if travel else []
        return [place, {"angularAxes": _ACROSS, **still}, *swing]
    return [place, turn]


def _x_to(axis: FloatArray) -> list[float]:
    """Quaternion x, y, z, w of the shortest turn that takes +X to a (3,) unit axis."""
    cosine = float(axis[0])
    if cosine < -1.0 + 1e-9:
        return [0.0, 0.0, 1.0, 0.0]
    quaternion = np.array([0.0, -axis[2], axis[1], 1.0 + cosine])
    return [float(value) for value in quaternion / np.linalg.norm(quaternion) + 0.0]
