"""Check `joints`: joints sit on the object, travel a sensible way, and no stage has flagged them.

What no Joint can be built with is not asked again: unit axes, finite limits around 0, a tree.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from ..arrays import FloatArray
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .mechanism import Link
from .subject import Subject


class Joints(Check):
    """Every joint can move, not absurdly far, about a point on the object, and no stage has flagged it."""

    name = "joints"

    class Options(StageOptions):
        """What is sensible."""

        least_turn: float = Field(default=0.0175, ge=0, description="Least travel of a hinge [rad].")
        most_turn: float = Field(default=12.57, gt=0, description="Most travel of a hinge [rad].")
        least_slide: float = Field(default=0.01, ge=0, description="Least travel of a slide [diagonal].")
        most_slide: float = Field(default=1.0, gt=0, description="Most travel of a slide [diagonal].")
        distance: float = Field(
            default=0.05, ge=0, description="Of a joint's origin from the bounding box, at most [diagonal]."
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """One row a joint."""
        asset, mechanism = subject.asset, subject.mechanism
        bounds = asset.mesh.bounds if asset else mechanism.bounds
        rows, problems = {}, []
        for link in mechanism.links:
            flags = list(asset.joint(link.name).flags) if asset else []
            rows[link.name] = row = _evidence(link, bounds) | {"flags": flags}
            problems += [f"{link.name}: {text}" for text in flags + self._problems(link, row, bounds)]
        moving = len(mechanism.moving)
        sound = f"{moving} moving joints are sound" if moving else "static: nothing moves"
        evidence = {"moving": moving, "joints": rows}
        return CheckResult(self.name, not problems, "; ".join(problems) or sound, evidence)

    def _problems(self, link: Link, row: dict[str, Any], bounds: FloatArray) -> list[str]:
        options, size = self.options, float(np.linalg.norm(bounds[1] - bounds[0]))
        found, travel = [], row["travel"]
        if row["distance_from_bounds"] > options.distance * size:
            found.append(f"its origin is {row['distance_from_bounds']:.3g} m away from the object")
        if travel is not None:
            low, high, unit = (
                (options.least_turn, options.most_turn, "rad")
                if link.kind == "revolute"
                else (options.least_slide * size, options.most_slide * size, "m")
            )
            if not low <= travel <= high:
                found.append(f"it travels {travel:.3g} {unit}, expected {low:.2g} to {high:.3g} {unit}")
        return found


def _evidence(link: Link, bounds: FloatArray) -> dict[str, Any]:
    origin = np.array(link.origin)
    limited = link.lower is not None and link.upper is not None
    return {
        "kind": link.kind,
        "travel": link.upper - link.lower if limited else None,  # type: ignore[operator]
        "distance_from_bounds": float(np.linalg.norm(origin - np.clip(origin, *bounds))),
    }
