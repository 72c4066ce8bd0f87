"""Check `collision`: every part has convex shapes, where the part is."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from ..arrays import FloatArray
from ..asset import Asset, ConvexMesh, Part
from ..hulls import hull_of, volume
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .mechanism import Mechanism
from .subject import Subject

_HOLLOW = 1e-4  # share of its own hull that a convex shape may miss: rounding only


class Collision(Check):
    """Every part has collision shapes; of an asset, they are convex and span the same box as their part."""

    name = "collision"

    class Options(StageOptions):
        """How far shapes may end from the bounding box of their part."""

        share: float = Field(default=0.02, ge=0, description="Beyond it, of the object's diagonal.")
        slack: float = Field(default=0.005, ge=0, description="And in addition [m].")
        missing: float = Field(
            default=0.1, ge=0, description="Short of it, where they gave way to a neighbour's [diagonal]."
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Shapes exist where the parts are."""
        if subject.asset is None:
            return _of_mechanism(subject.mechanism)
        size, options = subject.asset.mesh.diagonal, self.options
        return _of_asset(subject.asset, options.share * size + options.slack, options.missing * size)


def _of_mechanism(mechanism: Mechanism) -> CheckResult:
    bare = [body.name for body in mechanism.bodies if not body.colliders]
    count = sum(len(body.colliders) for body in mechanism.bodies)
    text = f"no collision shape: {', '.join(bare)}" if bare else f"every part has shapes: {count} in all"
    return CheckResult("collision", not bare, text, {"shapes": count})


def _of_asset(asset: Asset, slack: float, missing: float) -> CheckResult:
    problems: list[str] = []
    rows: dict[str, Any] = {}
    for index, part in enumerate(asset.parts):
        if not part.collision:
            problems.append(f"{part.name} has no collision shape")
            continue
        points = asset.mesh.vertices[asset.mesh.faces[asset.face_part == index].ravel()]
        bounds = np.array([points.min(axis=0), points.max(axis=0)])
        rows[part.name] = row = _evidence(part, bounds)
        if row["worst_hollowness"] > _HOLLOW:
            problems.append(f"{part.name} has a shape that is not convex or not wound outward")
        if row["stands_out"] > slack:
            problems.append(f"{part.name}: its shapes stand out of its bounds by {row['stands_out']:.3g} m")
        if row["misses"] > missing:
            problems.append(f"{part.name}: its shapes miss its bounds by {row['misses']:.3g} m")
    count = sum(len(p.collision) for p in asset.parts)
    text = "; ".join(problems) or f"every part has convex shapes where it is: {count} in all"
    return CheckResult("collision", not problems, text, {"shapes": count, "parts": rows})


def _evidence(part: Part, bounds: FloatArray) -> dict[str, Any]:
    points = np.concatenate([shape.vertices for shape in part.collision])
    ends = np.array([points.min(axis=0), points.max(axis=0)])
    return {
        "shapes": len(part.collision),
        "worst_hollowness": max(_hollowness(shape) for shape in part.collision),
        "stands_out": float(np.max([bounds[0] - ends[0], ends[1] - bounds[1]])),
        "misses": float(np.max([ends[0] - bounds[0], bounds[1] - ends[1]])),
    }


def _hollowness(shape: ConvexMesh) -> float:
    """Share of its convex hull that a shape does not fill: 0 for a convex shape; 1 for a flat one."""
    hull = hull_of(shape.vertices)
    return 1.0 - volume(shape) / volume(hull) if hull else 1.0
