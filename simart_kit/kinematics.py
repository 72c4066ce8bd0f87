"""Forward kinematics over an Asset's joint tree.

The frame of a part has the asset's axes at rest and sits at the origin of the joint that moves the part; the
root's frame is the asset frame. URDF, MJCF and USD exports use the same frames, so poses agree.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .arrays import FloatArray
from .asset import Asset, Joint
from .errors import BadInputError

Positions = Mapping[str, float | Sequence[float]]
"""Joint positions by name: an angle [rad] or travel [m]; (3,) rotation vector [rad] of a ball joint;
(6,) translation [m] then rotation vector [rad] of a free one. Joints left out stay at 0."""

LEAST_TRAVEL = 1e-4
"""What moves less is no movement [rad | m]; small buttons go tenths of a millimetre."""


def ordered_joints(asset: Asset) -> tuple[Joint, ...]:
    """The joints, each after the one that moves its parent; siblings in the asset's order."""
    children: dict[str, list[Joint]] = {}
    for joint in asset.joints:
        children.setdefault(joint.parent, []).append(joint)
    ordered = list(children.get(asset.root.name, []))
    for joint in ordered:  # grows while it is gone through
        ordered += children.get(joint.child, [])
    return tuple(ordered)


def carried(asset: Asset, part: str) -> set[str]:
    """Names of a part and of all that it carries."""
    found = {part}
    for joint in ordered_joints(asset):
        if joint.parent in found:
            found.add(joint.child)
    return found


def rest_origin(asset: Asset, part: str) -> FloatArray:
    """(3,) origin of a part's frame in the asset frame at rest [m]."""
    joint = asset.joint_to(part)
    return np.array(joint.origin if joint else (0.0, 0.0, 0.0))


def forward(asset: Asset, positions: Positions | None = None) -> dict[str, FloatArray]:
    """`world_T_part` (4, 4) by part name, root first.

    Args:
        asset: its root frame is the world.
        positions: see `Positions`; the default is the rest pose.

    Raises:
        BadInputError: a position for a joint that does not exist, or of a wrong size.
    """
    values = dict(positions or {})
    for name in values:
        asset.joint(name)
    world_T_part = {asset.root.name: np.eye(4)}
    for joint in ordered_joints(asset):
        parent_T_joint = np.eye(4)
        parent_T_joint[:3, 3] = np.array(joint.origin) - rest_origin(asset, joint.parent)
        motion = joint_motion(joint, values.get(joint.name, 0.0))
        world_T_part[joint.child] = world_T_part[joint.parent] @ parent_T_joint @ motion
    return world_T_part


def rest_to_posed(asset: Asset, positions: Positions | None = None) -> dict[str, FloatArray]:
    """`posed_T_rest` (4, 4) by part name: moves a part's vertices, given in the asset frame at rest."""
    result = {}
    for name, world_T_part in forward(asset, positions).items():
        part_T_world = np.eye(4)
        part_T_world[:3, 3] = -rest_origin(asset, name)
        result[name] = world_T_part @ part_T_world
    return result


def joint_motion(joint: Joint, position: float | Sequence[float]) -> FloatArray:
    """(4, 4) motion of the child's frame in the joint's frame, which has the asset's axes."""
    values = np.atleast_1d(np.asarray(position, dtype=np.float64))
    size = {"ball": 3, "free": 6}.get(joint.kind, 1)
    if values.shape == (1,) and values[0] == 0.0:
        values = np.zeros(size)
    if values.shape != (size,):
        raise BadInputError(
            f"joint '{joint.name}' is {joint.kind}: expected {size} value(s), got {values.size}"
        )
    motion = np.eye(4)
    axis = np.array(joint.axis)
    if joint.turns:
        motion[:3, :3] = rotation(axis * values[0])
    elif joint.kind == "prismatic":
        motion[:3, 3] = axis * values[0]
    elif joint.kind == "ball":
        motion[:3, :3] = rotation(values)
    elif joint.kind == "free":
        motion[:3, 3] = values[:3]
        motion[:3, :3] = rotation(values[3:])
    return motion


def moved_by(joint: Joint, position: float) -> FloatArray:
    """`posed_T_rest` (4, 4), in the asset frame, of what a one-axis joint moves while all others rest."""
    if joint.turns:
        return turned_about(np.array(joint.axis), np.array(joint.origin), position)
    return joint_motion(joint, position)


def reach_box(joint: Joint, points: FloatArray) -> FloatArray:
    """(2, 3) corners of a box that (N, 3) points, N > 0, do not leave while a one-axis joint moves them [m].

    Args:
        joint: hinges count as if they made a full turn.
        points: in the asset frame, at rest.
    """
    if not joint.turns:
        ends = np.outer([0.0, *span(joint)], joint.axis)
        return np.array([points.min(axis=0) + ends.min(axis=0), points.max(axis=0) + ends.max(axis=0)])
    axis, origin = np.array(joint.axis), np.array(joint.origin)
    away = points - origin
    along = away @ axis
    radius = float(np.linalg.norm(away - np.outer(along, axis), axis=1).max())
    ends = origin + np.outer([along.min(), along.max()], axis)
    wide = radius * np.sqrt(np.maximum(1 - axis**2, 0))
    return np.array([ends.min(axis=0) - wide, ends.max(axis=0) + wide])


def rotation(vector: FloatArray) -> FloatArray:
    """(3, 3) rotation about a (3,) rotation vector [rad] (Rodrigues' formula)."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-15:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross))


def turned_about(axis: FloatArray, origin: FloatArray, angle: float) -> FloatArray:
    """(4, 4) motion of what turns by an angle [rad] about the line along a (3,) unit axis through a point."""
    motion = np.eye(4)
    motion[:3, :3] = rotation(axis * angle)
    motion[:3, 3] = origin - motion[:3, :3] @ origin
    return motion


def span(joint: Joint) -> tuple[float, float]:
    """Range to show or sample a joint over [rad | m]; a continuous one makes a full turn."""
    if joint.limits:
        return joint.limits.lower, joint.limits.upper
    return (0.0, 2 * np.pi) if joint.kind == "continuous" else (0.0, 0.0)


def opened(asset: Asset, fraction: float) -> dict[str, float]:
    """Every one-axis joint at a fraction (0..1) of its longer way from rest [rad | m]."""
    result = {}
    for joint in asset.joints:
        lower, upper = span(joint)
        far = upper if upper >= -lower else lower
        if far:
            result[joint.name] = float(far * fraction)
    return result


def sample_positions(asset: Asset, rng: np.random.Generator) -> dict[str, float]:
    """A random position within limits for every one-axis joint [rad | m]."""
    moving = [j for j in asset.joints if span(j) != (0.0, 0.0)]
    return {j.name: float(rng.uniform(*span(j))) for j in moving}
