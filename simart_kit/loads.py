"""What a joint moves: its inertia, and what gravity does to it on its way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .asset import Asset, Joint
from .kinematics import carried, span

GRAVITY = 9.81  # [m/s^2] along -z
_UPRIGHT = 0.999  # |z| of an axis from which on a turn about it leaves gravity's direction as it is
_STEPS = 33  # on either side of rest
# Rolling resistance over weight: tyres on asphalt have 0.01 to 0.015, casters on a floor 0.02 to 0.03.
_ROLLING = 0.02
_FOOT, _LEVEL = 0.01, 0.1  # how far above the floor a wheel may end [diagonal]; |z| of its axis


@dataclass(frozen=True, eq=False)
class Load:
    """What a joint carries, all other joints at rest.

    Attributes:
        mass: of all that it moves [kg].
        inertia: about its axis [kg*m^2], the mean over all axes for a ball joint; the mass [kg] for a slide.
        positions: (N,) over its travel, 0 among them [rad | m].
        gravity: (N,) what gravity exerts along the joint there [N*m | N].
        most: largest amount of that which can occur, other joints moved too [N*m | N].
    """

    mass: float
    inertia: float
    positions: FloatArray
    gravity: FloatArray
    most: float


def load(asset: Asset, joint: Joint) -> Load:
    """What a joint that moves carries; parts without mass properties weigh nothing."""
    mass, center, tensor = _carried(asset, joint)
    axis = np.array(joint.axis)
    lower, upper = (-2 * np.pi, 2 * np.pi) if joint.kind == "continuous" else span(joint)
    positions = np.concatenate([np.linspace(lower, 0.0, _STEPS)[:-1], np.linspace(0.0, upper, _STEPS)])
    turning = positions if joint.turns else np.zeros(1)
    along = _gravity(joint, mass, center, turning)
    if not joint.turns:
        along = np.full(len(positions), along[0])
    if joint.kind == "prismatic":
        inertia = mass
    else:
        inertia = float(np.trace(tensor) / 3 if joint.kind == "ball" else axis @ tensor @ axis)
    most = float(np.abs(along).max())
    if joint.kind == "ball" or _tilts(asset, joint):
        arm = center if joint.kind == "ball" else center - axis * (axis @ center)
        most = mass * GRAVITY * (1.0 if joint.kind == "prismatic" else float(np.linalg.norm(arm)))
    return Load(mass, inertia, positions, along, most)


def rolling_resistance(asset: Asset, joints: Sequence[Joint]) -> dict[str, float]:
    """What keeps a standing object from rolling away: dry friction of each wheel that carries it [N*m].

    A wheel turns without limits about a level axis and reaches down as far as the object does; all carry
    alike.

    Args:
        asset: with mass properties.
        joints: of it; those that are no such wheel are left out.
    """
    floor, slack = float(asset.mesh.bounds[0, 2]), _FOOT * asset.mesh.diagonal
    wheels = [j for j in joints if j.kind == "continuous" and abs(j.axis[2]) < _LEVEL]
    wheels = [j for j in wheels if _lowest(asset, j.child) < floor + slack]
    weight = GRAVITY * sum(part.mass.mass for part in asset.parts if part.mass)
    return {j.name: _ROLLING * weight / len(wheels) * max(j.origin[2] - floor, 0.0) for j in wheels}


def _lowest(asset: Asset, part: str) -> float:
    faces = asset.mesh.faces[asset.face_part == asset.part_index(part)]
    return float(asset.mesh.vertices[faces, 2].min())


def _carried(asset: Asset, joint: Joint) -> tuple[float, FloatArray, FloatArray]:
    """Mass [kg], centre (3,) from the joint's origin [m] and inertia (3, 3) about that origin [kg*m^2]."""
    moved = carried(asset, joint.child)
    total, moment, tensor = 0.0, np.zeros(3), np.zeros((3, 3))
    for part in asset.parts:
        if part.name in moved and part.mass is not None:
            arm = np.array(part.mass.center) - np.array(joint.origin)
            total += part.mass.mass
            moment += part.mass.mass * arm
            tensor += np.array(part.mass.inertia)
            tensor += part.mass.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return total, moment / total if total else moment, tensor


def _gravity(joint: Joint, mass: float, center: FloatArray, angles: FloatArray) -> FloatArray:
    """(N,) gravity's torque about a joint's axis at (N,) angles, or its force along a slide, once."""
    axis, down = np.array(joint.axis), np.array([0.0, 0.0, -mass * GRAVITY])
    if joint.kind == "prismatic":
        return np.array([axis @ down])
    arm = center - axis * (axis @ center)
    across = np.cross(axis, arm)
    return np.asarray(
        np.cos(angles) * (axis @ np.cross(arm, down)) + np.sin(angles) * (axis @ np.cross(across, down))
    )


def _tilts(asset: Asset, joint: Joint) -> bool:
    """Whether a joint further up may turn this one against gravity."""
    above = asset.joint_to(joint.parent)
    while above is not None:
        if above.kind in ("ball", "free") or (above.turns and abs(above.axis[2]) < _UPRIGHT):
            return True
        above = asset.joint_to(above.parent)
    return False
