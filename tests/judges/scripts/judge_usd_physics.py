"""OpenUSD's physics parser: what a simulator that uses it is told of bodies, joints and colliders."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pxr import Usd, UsdPhysics
from verdict import Positions, Reading, inertial, main, turn, turned


def read(path: Path, _: Positions) -> Reading:
    """What the parser's descriptors and the bodies' MassAPI say."""
    stage = Usd.Stage.Open(str(path))
    found = {
        kind.name: dict(zip(paths, items, strict=True))
        for kind, (paths, items) in UsdPhysics.UsdPhysicsLoadStageFromPrimRange(stage, ["/"]).items()
    }
    invalid = [f"{kind} {path} is not valid" for kind in found for path in invalid_paths(found[kind])]
    bodies = found.get("RigidBody", {})
    return {
        "errors": invalid + wrong_roots(found.get("Articulation", {}), bodies),
        "inertials": {path.name: link_inertial(stage.GetPrimAtPath(path)) for path in bodies},
        "limits": joint_limits(found),
        "colliders": {path.name: len(body.collisions) for path, body in bodies.items()},
    }


def invalid_paths(items: Mapping[Any, Any]) -> list[Any]:
    """Where the parser found what it cannot use."""
    return [path for path, item in items.items() if not item.isValid]


def wrong_roots(articulations: Mapping[Any, Any], bodies: Mapping[Any, Any]) -> list[str]:
    """An articulated object has one articulation; a single body may do without."""
    if len(articulations) == 1 or (len(bodies) == 1 and not articulations):
        return []
    return [f"{len(articulations)} articulations, expected 1"]


def joint_limits(found: Mapping[str, Mapping[Any, Any]]) -> dict[str, list[float] | None]:
    """Limits by joint, angles in radians."""
    units = {"RevoluteJoint": math.pi / 180, "PrismaticJoint": 1.0}
    return {
        path.name: [joint.limit.lower * unit, joint.limit.upper * unit] if joint.limit.enabled else None
        for kind, unit in units.items()
        for path, joint in found.get(kind, {}).items()
    }


def link_inertial(prim: Usd.Prim) -> dict[str, Any]:
    """The authored mass properties of a body."""
    api = UsdPhysics.MassAPI(prim)
    axes = api.GetPrincipalAxesAttr().Get()
    rotation = turn(*axes.GetImaginary(), axes.GetReal())
    moments = turned(api.GetDiagonalInertiaAttr().Get(), rotation)
    return inertial(api.GetMassAttr().Get(), api.GetCenterOfMassAttr().Get(), moments)


if __name__ == "__main__":
    main(read)
