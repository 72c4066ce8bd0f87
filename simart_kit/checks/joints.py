"""Check `joints`: joints sit on the object, travel a sensible way, and no stage has flagged them.

What no Joint can be built with is not asked again: unit axes, finite limits around 0, a tree.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..asset import Asset, Joint
from . import CheckResult

MIN_TURN, MAX_TURN = np.deg2rad(1.0), 4 * np.pi  # [rad]
MIN_TRAVEL, MAX_TRAVEL = 0.01, 1.0  # of the asset's diagonal
MAX_DISTANCE = 0.05  # of a joint's origin from the bounding box, of the asset's diagonal


def check_joints(asset: Asset) -> CheckResult:
    """Every moving joint can move, not absurdly far, about a point on the object."""
    rows, problems = {}, []
    for joint in asset.joints:
        rows[joint.name] = row = _evidence(asset, joint)
        problems += [f"{joint.name}: {text}" for text in _problems(asset, joint, row)]
    moving = sum(j.moves for j in asset.joints)
    text = "; ".join(problems) or (f"{moving} moving joints are sound" if moving else "static: nothing moves")
    return CheckResult("joints", not problems, text, {"moving": moving, "joints": rows})


def _evidence(asset: Asset, joint: Joint) -> dict[str, Any]:
    lower, upper = asset.mesh.bounds
    origin = np.array(joint.origin)
    travel = joint.limits.upper - joint.limits.lower if joint.limits else None
    return {
        "kind": joint.kind,
        "travel": travel,
        "distance_from_bounds": float(np.linalg.norm(origin - np.clip(origin, lower, upper))),
        "flags": list(joint.flags),
    }


def _problems(asset: Asset, joint: Joint, row: dict[str, Any]) -> list[str]:
    size, travel = asset.mesh.diagonal, row["travel"]
    found = list(joint.flags)
    if row["distance_from_bounds"] > MAX_DISTANCE * size:
        found.append(f"its origin is {row['distance_from_bounds']:.3g} m away from the object")
    if travel is not None:
        low, high, unit = (
            (MIN_TURN, MAX_TURN, "rad")
            if joint.kind == "revolute"
            else (MIN_TRAVEL * size, MAX_TRAVEL * size, "m")
        )
        if not low <= travel <= high:
            found.append(f"it travels {travel:.3g} {unit}, expected {low:.2g} to {high:.3g} {unit}")
    return found
