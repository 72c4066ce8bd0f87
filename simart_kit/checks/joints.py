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
from .mechanism import Body, Link
from .subject import Subject


class Joints(Check):
    """Every joint moves, not absurdly far, about a point on the object, and is not flagged, or held fixed."""

    name = "joints"

    class Options(StageOptions):
        """What is sensible."""

        least_turn: float = Field(default=0.0175, ge=0, description="Least travel of a hinge [rad].")
        most_turn: float = Field(default=12.57, gt=0, description="Most travel of a hinge [rad].")
        least_slide: float = Field(
            default=0.005,
            ge=0,
            description="Least travel of a slide, as a share of what it moves [diagonal].",
        )
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
            # What a stage holds fixed, doubting it, moves nothing wrongly: it is told, and no failure.
            doubts = flags if link.kind != "fixed" else []
            own = _size(mechanism.body[link.child], float(np.linalg.norm(bounds[1] - bounds[0])))
            problems += [f"{link.name}: {text}" for text in doubts + self._problems(link, row, bounds, own)]
        moving = len(mechanism.moving)
        sound = f"{moving} moving joints are sound" if moving else "static: nothing moves"
        held = [name for name, row in rows.items() if row["flags"] and row["kind"] == "fixed"]
        sound += f"; held fixed, see their flags: {', '.join(held)}" if held else ""
        evidence = {"moving": moving, "joints": rows}
        return CheckResult(self.name, not problems, "; ".join(problems) or sound, evidence)

    def _problems(self, link: Link, row: dict[str, Any], bounds: FloatArray, own: float) -> list[str]:
        """What is wrong with a joint; `own` is the size of what it moves [m]: buttons travel little."""
        options, size = self.options, float(np.linalg.norm(bounds[1] - bounds[0]))
        found, travel = [], row["travel"]
        if row["distance_from_bounds"] > options.distance * size:
            found.append(f"its origin is {row['distance_from_bounds']:.3g} m away from the object")
        if travel is not None:
            low, high, unit = (
                (options.least_turn, options.most_turn, "rad")
                if link.kind == "revolute"
                else (options.least_slide * own, options.most_slide * size, "m")
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


def _size(body: Body, most: float) -> float:
    """Diagonal of a body's shapes [m], at most `most`, which counts where it has none."""
    if not body.colliders:
        return most
    return min(most, float(np.linalg.norm(np.ptp(np.concatenate(body.colliders), axis=0))))
