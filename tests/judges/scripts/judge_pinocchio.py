"""Pinocchio: URDF, its inertias frame by frame, and its collision geometry through Coal."""

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio
from verdict import Positions, Reading, inertial, main, rows


def read(path: Path, positions: Positions) -> Reading:
    """What the model says; on a free base, so that the root link keeps its own inertia."""
    model = pinocchio.buildModelFromUrdf(str(path), pinocchio.JointModelFreeFlyer())
    shapes = pinocchio.buildGeomFromUrdf(
        model, str(path), pinocchio.GeometryType.COLLISION, package_dirs=[str(path.parent)]
    )
    joints = {name: model.joints[model.getJointId(name)] for name in list(model.names)[2:]}
    links = [frame for frame in model.frames if frame.type == pinocchio.FrameType.BODY]
    return {
        "errors": [],
        "poses": [poses(model, joints, at) for at in positions],
        "inertials": {frame.name: own_inertial(model, frame) for frame in links},
        "limits": {name: limits(model, joint) for name, joint in joints.items()},
        "colliders": Counter(model.frames[shape.parentFrame].name for shape in shapes.geometryObjects),
    }


def own_inertial(model: pinocchio.Model, link: pinocchio.Frame) -> dict[str, Any]:
    """Mass properties of a link: links behind fixed joints are added to the joint that carries them."""
    above = model.frames[link.parentFrame]
    if above.type == pinocchio.FrameType.FIXED_JOINT:
        own = above.inertia
    else:
        own = model.inertias[link.parentJoint]
        for frame in model.frames:
            if frame.type == pinocchio.FrameType.FIXED_JOINT and frame.parentJoint == link.parentJoint:
                own -= frame.placement.act(frame.inertia)
    return inertial(own.mass, own.lever, own.inertia)


def poses(
    model: pinocchio.Model, joints: Mapping[str, Any], positions: Mapping[str, float]
) -> dict[str, Any]:
    """Pose of every link at joint positions; one that turns for ever has cosine and sine."""
    q = pinocchio.neutral(model)
    for name, position in positions.items():
        joint = joints[name]
        value = [np.cos(position), np.sin(position)] if joint.nq == 2 else position
        q[joint.idx_q : joint.idx_q + joint.nq] = value
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, q)
    return {
        frame.name: rows(data.oMf[index].homogeneous)
        for index, frame in enumerate(model.frames)
        if frame.type == pinocchio.FrameType.BODY
    }


def limits(model: pinocchio.Model, joint: Any) -> list[float] | None:
    """Range of a joint, or None where it turns for ever."""
    if joint.nq == 2:
        return None
    return [float(model.lowerPositionLimit[joint.idx_q]), float(model.upperPositionLimit[joint.idx_q])]


if __name__ == "__main__":
    main(read)
