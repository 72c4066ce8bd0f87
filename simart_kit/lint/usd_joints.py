"""USD joints: ends, frames, limits and drives."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING

from .findings import Finding
from .numbers import limit_findings, sign_findings
from .usd_bodies import quaternion_findings
from .usd_frames import AXES, rest_gap
from .usd_scene import UsdScene, body_of, stated

if TYPE_CHECKING:
    from pxr import Usd

_INFINITY = float("inf")
_FARTHEST = 1e-4  # that frames may be apart for rounding [m]
_WIDEST = 1e-3  # [rad]
_SIGNED = ("damping", "stiffness", "maxForce", "friction", "frictionloss", "armature", "velocityLimit")


def joint_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by the joints, each by itself."""
    for joint in scene.joints:
        where = str(joint.GetPath())
        found = tuple(_end_findings(scene, joint))
        yield from found
        for side in (0, 1):
            name = f"localRot{side}"
            yield from quaternion_findings(where, name, stated(joint, f"physics:{name}"))
        axis = stated(joint, "physics:axis")
        if axis is not None and axis not in AXES:
            yield Finding("axis-token", where, f"axis '{axis}' is not one of {', '.join(AXES)}")
        values = {name: number for name in _signed(joint) if isinstance(number := stated(joint, name), float)}
        yield from sign_findings("damping-negative", where, values)
        yield from _motion_findings(scene, joint, placed=not found)


def ends(scene: UsdScene, joint: Usd.Prim) -> tuple[Usd.Prim | None, Usd.Prim | None]:
    """The bodies that a joint connects; None for the world, and for a body that does not exist."""
    first, second = (_targets(joint, side) for side in (0, 1))
    bodies = [body_of(scene.stage.GetPrimAtPath(paths[0])) if paths else None for paths in (first, second)]
    return bodies[0], bodies[1]


def missing_ends(scene: UsdScene, joint: Usd.Prim) -> list[object]:
    """Paths of the prims that a joint names and that do not exist."""
    return [p for side in (0, 1) for p in _targets(joint, side) if not scene.stage.GetPrimAtPath(p)]


def _targets(joint: Usd.Prim, side: int) -> list[object]:
    return list(joint.GetRelationship(f"physics:body{side}").GetTargets())


def _end_findings(scene: UsdScene, joint: Usd.Prim) -> Iterator[Finding]:
    where = str(joint.GetPath())
    missing = missing_ends(scene, joint)
    for path in missing:
        yield Finding("joint-target-missing", where, f"body {path} does not exist: name one that does")
    if missing:
        return
    first, second = ends(scene, joint)
    if not first and not second:
        yield Finding("joint-no-body", where, "it connects no rigid body: set body0 and body1")
    elif first == second:
        yield Finding("joint-self", where, "body0 and body1 are one body: name another one")


def _signed(joint: Usd.Prim) -> list[str]:
    """Attributes of drives, and of the schemas of Newton, MuJoCo and PhysX, that are never below 0."""
    return [n for n in joint.GetAuthoredPropertyNames() if n.rpartition(":")[2] in _SIGNED and ":" in n]


def _motion_findings(scene: UsdScene, joint: Usd.Prim, placed: bool) -> Iterator[Finding]:
    """Breaches by frames, where both are `placed` on something, and by limits."""
    where, position = str(joint.GetPath()), 0.0
    gap = rest_gap(scene, joint) if placed else None
    turns = joint.GetTypeName() == "PhysicsRevoluteJoint"
    if gap:
        if gap.distance * scene.metres > _FARTHEST or gap.angle > _WIDEST:
            apart = f"{gap.distance:.3g} and {degrees(gap.angle):.3g} degrees apart"
            text = f"its frames are {apart} at rest: align them"
            yield Finding("joint-frames", where, text)
        elif abs(gap.position) > (_WIDEST if turns else _FARTHEST / scene.metres):
            position = degrees(gap.position) if turns else gap.position
            yield Finding("joint-offset", where, f"it is at {position:.4g} at rest: make its frames coincide")
    limits = [stated(joint, f"physics:{name}Limit") for name in ("lower", "upper")]
    if joint.GetTypeName() in ("PhysicsRevoluteJoint", "PhysicsPrismaticJoint") and limits != [None, None]:
        lower, upper = (
            end if end is not None else sign * _INFINITY for end, sign in zip(limits, (-1, 1), strict=True)
        )
        yield from limit_findings(where, lower, upper, position)
