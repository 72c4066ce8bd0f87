"""Check `mass`: every part has the inertial properties of a real body."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pydantic import Field

from ..arrays import FloatArray
from ..asset import MassProperties
from ..hulls import hull_corners
from ..physics import MIN_MASS
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .subject import Subject

_SKIN = 0.01  # [m] of material that a surface may stand for without enclosing it


class Mass(Check):
    """Every body has inertial properties of a real one; none that moves carries far more than it weighs."""

    name = "mass"

    class Options(StageOptions):
        """What is plausible."""

        mass_ratio: float = Field(
            default=1000.0, gt=1, description="What a moving body carries over its own mass."
        )
        inertia_ratio: float = Field(
            default=1e5, gt=1, description="Of principal moments; a thin rod has some thousands."
        )
        least_density: float = Field(default=1.0, ge=0, description="Over the hull [kg/m^3]: a wire basket.")
        most_density: float = Field(default=12000.0, gt=0, description="Over the hull [kg/m^3]: lead.")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Masses are positive, inertias possible, densities plausible."""
        problems: list[str] = []
        rows: dict[str, Any] = {}
        bodies = subject.mechanism.bodies
        for body in bodies:
            if body.mass is None:
                problems.append(f"{body.name} has no mass")
                continue
            if not _finite(body.mass):
                problems.append(f"{body.name}: mass, centre or inertia is not finite")
                continue
            points, area = _surface(subject, body.name)
            rows[body.name] = row = _evidence(body.mass, points, area)
            problems += [f"{body.name}: {text}" for text in self._problems(body.mass, row, points)]
        carrier, ratio = _heaviest_load(subject)
        if ratio > self.options.mass_ratio:
            problems.append(f"{carrier} carries {ratio:.0f} times its own mass")
        total = sum(body.mass.mass for body in bodies if body.mass)
        sound = f"{total:.3g} kg in all ({len(bodies)} parts), all inertias are possible"
        evidence = {"total": total, "mass_ratio": ratio, "parts": rows}
        return CheckResult(self.name, not problems, "; ".join(problems) or sound, evidence)

    def _problems(self, mass: MassProperties, row: dict[str, Any], points: FloatArray) -> list[str]:
        inertia = np.array(mass.inertia)
        small, middle, large = row["principal_inertia"]
        density, least, most = row["density_over_hull"], self.options.least_density, self.options.most_density
        found = {
            f"mass {mass.mass:g} kg is not positive": mass.mass <= 0,
            "inertia is not symmetric": np.abs(inertia - inertia.T).max() > 1e-9 * np.abs(inertia).max(),
            "inertia is not positive definite": small <= 0,
            "inertia breaks the triangle inequality": small + middle < large * (1 - 1e-6),
            f"principal inertias differ by a factor {large / small if small > 0 else np.inf:.0f}": (
                0 < small * self.options.inertia_ratio < large
            ),
            "centre of mass lies outside the part": _outside(mass, points),
            f"density over its hull is {density or 0:.3g} kg/m3": (
                mass.mass > MIN_MASS and density is not None and not least <= density <= most
            ),
        }
        return [text for text, wrong in found.items() if wrong]


def _finite(mass: MassProperties) -> bool:
    return all(map(math.isfinite, (mass.mass, *mass.center, *np.ravel(mass.inertia))))


def _surface(subject: Subject, name: str) -> tuple[FloatArray, float]:
    """(N, 3) points that bound a body, and the area of its surface [m^2] where that is known."""
    asset = subject.asset
    if asset is None:
        colliders = subject.mechanism.body[name].colliders
        return (np.concatenate(colliders) if colliders else np.zeros((0, 3))), 0.0
    faces = asset.face_part == asset.part_index(name)
    return asset.mesh.points_of(faces), float(asset.mesh.face_areas[faces].sum())


def _outside(mass: MassProperties, points: FloatArray) -> bool:
    if not len(points):
        return False
    lower, upper = points.min(axis=0), points.max(axis=0)
    slack = 0.01 * float(np.linalg.norm(upper - lower)) + 1e-6
    center = np.array(mass.center)
    return bool(((center < lower - slack) | (center > upper + slack)).any())


def _evidence(mass: MassProperties, points: FloatArray, area: float) -> dict[str, Any]:
    principal = np.linalg.eigvalsh(np.array(mass.inertia))
    hull = hull_corners(points) if len(points) > 3 else None
    room = (hull[1] if hull else 0.0) + _SKIN * area
    return {
        "mass": mass.mass,
        "principal_inertia": principal.tolist(),
        "density_over_hull": mass.mass / room if room > 0 else None,
        "method": mass.method,
    }


def _heaviest_load(subject: Subject) -> tuple[str, float]:
    """The moving body that carries most joints' load for its mass, and how much: solvers lose accuracy there.

    A light body on a heavy one does no harm; a fixed base counts as part of the world.
    """
    mechanism = subject.mechanism
    floating = subject.asset is not None and subject.asset.floating
    mass = {body.name: body.mass.mass if body.mass else 0.0 for body in mechanism.bodies}
    carrier = {link.child: link.parent for link in mechanism.links}
    carried = dict.fromkeys([*mass, *carrier.values()], 0.0)
    for body in reversed(mechanism.order):
        if body.name in carrier:
            carried[carrier[body.name]] += mass[body.name] + carried[body.name]
    moved = [name for name in mass if mass[name] > 0 and (floating or name in mechanism.moved)]
    ratios = {name: carried[name] / mass[name] for name in moved}
    worst = max(ratios, key=lambda name: ratios[name], default="")
    return worst, ratios.get(worst, 0.0)
