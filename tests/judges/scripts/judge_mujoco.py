"""MuJoCo: compiles URDF or MJCF, poses it, and steps it for half a second."""

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from verdict import Positions, Reading, inertial, main, pose, rows, turned

# MuJoCo's enums are compared as integers: `in` says no to a numpy integer that `==` calls equal.
ONE_AXIS = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
STEPS = 250


def read(path: Path, positions: Positions) -> Reading:
    """What the compiled model says."""
    model = mujoco.MjModel.from_xml_path(str(path))
    bodies = [model.body(index) for index in range(1, model.nbody)]
    joints = [model.joint(index) for index in range(model.njnt) if int(model.jnt_type[index]) in ONE_AXIS]
    solid = [g for g in range(model.ngeom) if model.geom_contype[g] or model.geom_conaffinity[g]]
    return {
        "errors": unstable(model),
        "poses": [poses(model, at) for at in positions],
        "inertials": {
            body.name: inertial(body.mass[0], body.ipos, turned(body.inertia, matrix(body.iquat)))
            for body in bodies
        },
        "limits": {
            joint.name: rows(joint.range) if model.jnt_limited[joint.id] else None for joint in joints
        },
        "colliders": Counter(model.body(model.geom_bodyid[g]).name for g in solid),
    }


def poses(model: mujoco.MjModel, positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every body at joint positions."""
    data = mujoco.MjData(model)
    for name, position in positions.items():
        data.joint(name).qpos[0] = position
    mujoco.mj_kinematics(model, data)
    return {
        model.body(index).name: pose(data.xmat[index].reshape(3, 3), data.xpos[index])
        for index in range(1, model.nbody)
    }


def unstable(model: mujoco.MjModel) -> list[str]:
    """What goes wrong when the model is left alone."""
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, STEPS)
    warned = [str(mujoco.mjtWarning(kind)) for kind, warning in enumerate(data.warning) if warning.number]
    return [f"{kind} while simulated" for kind in warned]


def matrix(quaternion: np.ndarray) -> np.ndarray:
    """(3, 3) of a (4,) quaternion, real part first."""
    flat = np.zeros(9)
    mujoco.mju_quat2Mat(flat, quaternion)
    return flat.reshape(3, 3)


if __name__ == "__main__":
    main(read)
