"""Check `collision`: every part has convex shapes, where the part is."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..asset import Asset, ConvexMesh, Part
from ..hulls import hull_of, volume
from . import CheckResult

MAX_HOLLOWNESS = 1e-4  # share of its own hull that a convex shape may miss: rounding only
_SLACK = 0.02, 0.005  # how far shapes may end from the part's bounding box: of the diagonal, and [m]


def check_collision(asset: Asset) -> CheckResult:
    """Shapes exist, are convex with outward triangles, and span the same box as their part."""
    problems: list[str] = []
    rows: dict[str, Any] = {}
    slack = _SLACK[0] * asset.mesh.diagonal + _SLACK[1]
    for index, part in enumerate(asset.parts):
        if not part.collision:
            problems.append(f"{part.name} has no collision shape")
            continue
        points = asset.mesh.vertices[asset.mesh.faces[asset.face_part == index].ravel()]
        bounds = np.array([points.min(axis=0), points.max(axis=0)])
        rows[part.name] = row = _evidence(part, bounds)
        if row["worst_hollowness"] > MAX_HOLLOWNESS:
            problems.append(f"{part.name} has a shape that is not convex or not wound outward")
        if row["bounds_error"] > slack:
            problems.append(f"{part.name}: its shapes miss its bounds by {row['bounds_error']:.3g} m")
    count = sum(len(p.collision) for p in asset.parts)
    text = "; ".join(problems) or f"every part has convex shapes where it is: {count} in all"
    return CheckResult("collision", not problems, text, {"shapes": count, "parts": rows})


def _evidence(part: Part, bounds: FloatArray) -> dict[str, Any]:
    points = np.concatenate([shape.vertices for shape in part.collision])
    ends = np.array([points.min(axis=0), points.max(axis=0)])
    return {
        "shapes": len(part.collision),
        "worst_hollowness": max(_hollowness(shape) for shape in part.collision),
        "bounds_error": float(np.abs(ends - bounds).max()),
    }


def _hollowness(shape: ConvexMesh) -> float:
    """Share of its convex hull that a shape does not fill: 0 for a convex shape; 1 for a flat one."""
    hull = hull_of(shape.vertices)
    return 1.0 - volume(shape) / volume(hull) if hull else 1.0
