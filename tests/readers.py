"""What MuJoCo, yourdfpy, PyBullet and Pinocchio make of an exported file, in one form.

Frames of links are those that the loader reports; nothing of simart_kit takes part.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pybullet
import yourdfpy

from .readings import Array, Inertial


@dataclass(frozen=True)
class Reading:
    """A robot as a loader sees it.

    Attributes:
        poses: `world_T_link` (4, 4) by link, at the positions that were asked for.
        inertials: by link.
        limits: range of every joint with one axis [rad | m]; None for a continuous one.
        colliders: number of collision shapes by link.
        pictures: number of drawn shapes that have a texture; None where the loader does not load them.
    """

    poses: dict[str, Array]
    inertials: dict[str, Inertial]
    limits: dict[str, tuple[float, float] | None]
    colliders: Counter[str]
    pictures: int | None


Positions = Mapping[str, float]
Reader = Callable[[Path, Sequence[Positions]], list[Reading]]
"""Reads a file once and says how the robot is at each of the joint positions; those not named are zero."""


def read_mujoco(path: Path, asked: Sequence[Positions]) -> list[Reading]:
    """URDF or MJCF through MuJoCo."""
    model = mujoco.MjModel.from_xml_path(str(path))
    return [_mujoco_at(model, positions) for positions in asked]


def _mujoco_at(model: mujoco.MjModel, positions: Positions) -> Reading:
    data = mujoco.MjData(model)
    for name, position in positions.items():
        data.joint(name).qpos[0] = position
    mujoco.mj_kinematics(model, data)
    bodies = [model.body(index) for index in range(1, model.nbody)]
    one_axis = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    joints = [model.joint(index) for index in range(model.njnt) if int(model.jnt_type[index]) in one_axis]
    solid = [g for g in range(model.ngeom) if model.geom_contype[g]]
    drawn = [model.geom_matid[g] for g in range(model.ngeom) if model.geom_matid[g] >= 0]
    return Reading(
        poses={b.name: _pose(data.xpos[b.id], data.xmat[b.id].reshape(3, 3)) for b in bodies},
        inertials={
            b.name: Inertial(float(b.mass[0]), b.ipos, _turned(b.inertia, _matrix_wxyz(b.iquat)))
            for b in bodies
        },
        limits={j.name: tuple(j.range) if model.jnt_limited[j.id] else None for j in joints},
        colliders=Counter(model.body(model.geom_bodyid[g]).name for g in solid),
        pictures=int((model.mat_texid[drawn] >= 0).any(axis=1).sum()) if drawn else 0,
    )


def read_yourdfpy(path: Path, asked: Sequence[Positions]) -> list[Reading]:
    """URDF through yourdfpy and trimesh."""
    robot = yourdfpy.URDF.load(str(path))
    return [_yourdfpy_at(robot, positions) for positions in asked]


def _yourdfpy_at(robot: yourdfpy.URDF, positions: Positions) -> Reading:
    robot.update_cfg(dict.fromkeys(robot.actuated_joint_names, 0.0) | dict(positions))
    links = robot.robot.links
    inertials = {
        link.name: Inertial(link.inertial.mass, link.inertial.origin[:3, 3], link.inertial.inertia)
        for link in links
        if link.inertial
    }
    joints = {name: robot.joint_map[name] for name in robot.actuated_joint_names}
    shapes = robot.scene.geometry.values()
    return Reading(
        poses={link.name: robot.get_transform(link.name) for link in links},
        inertials=inertials,
        limits={
            n: (j.limit.lower, j.limit.upper) if j.type != "continuous" else None for n, j in joints.items()
        },
        colliders=Counter({link.name: len(link.collisions) for link in links}),
        pictures=sum(_has_picture(shape) for shape in shapes),
    )


def read_pybullet(path: Path, asked: Sequence[Positions]) -> list[Reading]:
    """URDF through PyBullet, with the inertia of the file."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(path), flags=pybullet.URDF_USE_INERTIA_FROM_FILE, physicsClientId=client)
        return [_pybullet_at(body, positions) for positions in asked]
    finally:
        pybullet.disconnect(client)


def _pybullet_at(body: int, positions: Positions) -> Reading:
    joints = {
        info[1].decode(): info
        for info in (pybullet.getJointInfo(body, j) for j in range(pybullet.getNumJoints(body)))
    }
    for name, joint in joints.items():
        if joint[2] != pybullet.JOINT_FIXED:
            pybullet.resetJointState(body, joint[0], positions.get(name, 0.0))
    links = {pybullet.getBodyInfo(body)[0].decode(): -1}
    links |= {info[12].decode(): info[0] for info in joints.values()}
    return Reading(
        poses={name: _bullet_pose(body, link) for name, link in links.items()},
        inertials={name: _bullet_inertial(body, link) for name, link in links.items()},
        limits={
            name: (info[8], info[9]) if info[8] <= info[9] else None
            for name, info in joints.items()
            if info[2] != pybullet.JOINT_FIXED
        },
        colliders=Counter({n: len(pybullet.getCollisionShapeData(body, i)) for n, i in links.items()}),
        pictures=None,
    )


def read_pinocchio(path: Path, asked: Sequence[Positions]) -> list[Reading]:
    """URDF through Pinocchio, on a free base, so that the root link keeps its own inertia."""
    model = pinocchio.buildModelFromUrdf(str(path), pinocchio.JointModelFreeFlyer())
    shapes = pinocchio.buildGeomFromUrdf(
        model, str(path), pinocchio.GeometryType.COLLISION, package_dirs=[str(path.parent)]
    )
    return [_pinocchio_at(model, shapes, positions) for positions in asked]


def _pinocchio_at(model: pinocchio.Model, shapes: pinocchio.GeometryModel, positions: Positions) -> Reading:
    names = list(model.names)[2:]
    joints = {name: model.joints[model.getJointId(name)] for name in names}
    q = pinocchio.neutral(model)
    for name, position in positions.items():
        joint = joints[name]
        turn = [np.cos(position), np.sin(position)]
        q[joint.idx_q : joint.idx_q + joint.nq] = turn if joint.nq == 2 else position
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, q)
    frames = {f.name: i for i, f in enumerate(model.frames) if f.type == pinocchio.FrameType.BODY}
    moments = {name: model.inertias[model.frames[index].parentJoint] for name, index in frames.items()}
    return Reading(
        poses={name: data.oMf[index].homogeneous for name, index in frames.items()},
        inertials={name: Inertial(m.mass, m.lever, m.inertia) for name, m in moments.items()},
        limits={
            name: (model.lowerPositionLimit[j.idx_q], model.upperPositionLimit[j.idx_q])
            if j.nq == 1
            else None
            for name, j in joints.items()
        },
        colliders=Counter(model.frames[shape.parentFrame].name for shape in shapes.geometryObjects),
        pictures=None,
    )


def _has_picture(shape: object) -> bool:
    material = getattr(shape.visual, "material", None)
    return getattr(material, "image", None) is not None


def _bullet_pose(body: int, link: int) -> Array:
    """The frame of a link; PyBullet gives the base's centre of mass instead."""
    if link >= 0:
        state = pybullet.getLinkState(body, link, computeForwardKinematics=True)
        return _pose(state[4], _matrix_xyzw(state[5]))
    world_T_com = _pose(*_bullet_frame(*pybullet.getBasePositionAndOrientation(body)))
    dynamics = pybullet.getDynamicsInfo(body, link)
    return world_T_com @ np.linalg.inv(_pose(*_bullet_frame(dynamics[3], dynamics[4])))


def _bullet_frame(position: object, quaternion: object) -> tuple[object, Array]:
    return position, _matrix_xyzw(quaternion)


def _bullet_inertial(body: int, link: int) -> Inertial:
    dynamics = pybullet.getDynamicsInfo(body, link)
    turn = _matrix_xyzw(dynamics[4])
    return Inertial(dynamics[0], np.array(dynamics[3]), _turned(dynamics[2], turn))


def _matrix_xyzw(quaternion: object) -> Array:
    return np.array(pybullet.getMatrixFromQuaternion(quaternion)).reshape(3, 3)


def _matrix_wxyz(quaternion: Array) -> Array:
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def _turned(diagonal: object, turn: Array) -> Array:
    return turn @ np.diag(np.asarray(diagonal)) @ turn.T


def _pose(position: object, turn: Array) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, position
    return matrix


URDF_READERS: dict[str, Reader] = {
    "mujoco": read_mujoco,
    "yourdfpy": read_yourdfpy,
    "pybullet": read_pybullet,
    "pinocchio": read_pinocchio,
}
