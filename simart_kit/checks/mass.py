"""Check `mass`: every part has the inertial properties of a real body."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..asset import Asset, MassProperties
from ..hulls import hull_of, volume
from ..physics import MIN_MASS
from . import CheckResult

MAX_MASS_RATIO = 1000.0  # of parts that move; solvers lose accuracy beyond
MAX_INERTIA_RATIO = 1e5  # of principal moments; a thin rod has some thousands
MIN_DENSITY, MAX_DENSITY = 1.0, 12000.0  # [kg/m^3] over the hull: a wire basket .. lead
_SKIN = 0.01  # [m] of material that a surface may stand for without enclosing it


def check_mass(asset: Asset) -> CheckResult:
    """Masses are positive, inertias possible, densities plausible, moving parts of comparable mass."""
    problems: list[str] = []
    rows: dict[str, Any] = {}
    for index, part in enumerate(asset.parts):
        if part.mass is None:
            problems.append(f"{part.name} has no mass")
            continue
        faces = asset.face_part == index
        points = asset.mesh.vertices[np.unique(asset.mesh.faces[faces])]
        rows[part.name] = row = _evidence(part.mass, points, float(asset.mesh.face_areas[faces].sum()))
        problems += [f"{part.name}: {text}" for text in _problems(part.mass, row, points)]
    ratio = _mass_ratio(asset)
    if ratio > MAX_MASS_RATIO:
        problems.append(f"the heaviest moving part weighs {ratio:.0f} times the lightest")
    total = sum(p.mass.mass for p in asset.parts if p.mass)
    text = (
        "; ".join(problems) or f"{total:.3g} kg in all ({len(asset.parts)} parts), all inertias are possible"
    )
    return CheckResult("mass", not problems, text, {"total": total, "mass_ratio": ratio, "parts": rows})


def _evidence(mass: MassProperties, points: FloatArray, area: float) -> dict[str, Any]:
    principal = np.linalg.eigvalsh(np.array(mass.inertia))
    hull = hull_of(points)
    room = (volume(hull) if hull else 0.0) + _SKIN * area
    return {
        "mass": mass.mass,
        "principal_inertia": principal.tolist(),
        "density_over_hull": mass.mass / room if room > 0 else None,
        "method": mass.method,
    }


def _problems(mass: MassProperties, row: dict[str, Any], points: FloatArray) -> list[str]:
    inertia = np.array(mass.inertia)
    if not (np.isfinite(inertia).all() and np.isfinite(mass.center).all() and np.isfinite(mass.mass)):
        return ["mass, centre or inertia is not finite"]
    small, middle, large = row["principal_inertia"]
    density = row["density_over_hull"]
    lower, upper = points.min(axis=0), points.max(axis=0)
    slack = 0.01 * float(np.linalg.norm(upper - lower)) + 1e-6
    outside = (np.array(mass.center) < lower - slack) | (np.array(mass.center) > upper + slack)
    found = {
        f"mass {mass.mass:g} kg is not positive": mass.mass <= 0,
        "inertia is not symmetric": not np.allclose(inertia, inertia.T, rtol=1e-9, atol=0),
        "inertia is not positive definite": small <= 0,
        "inertia breaks the triangle inequality": small + middle < large * (1 - 1e-6),
        f"principal inertias differ by a factor {large / small if small > 0 else np.inf:.0f}": (
            0 < small * MAX_INERTIA_RATIO < large
        ),
        "centre of mass lies outside the part": bool(outside.any()),
        f"density over its hull is {density or 0:.3g} kg/m3": (
            mass.mass > MIN_MASS and density is not None and not MIN_DENSITY <= density <= MAX_DENSITY
        ),
    }
    return [text for text, wrong in found.items() if wrong]


def _mass_ratio(asset: Asset) -> float:
    """Heaviest over lightest of the parts that may move; a fixed base counts as part of the world."""
    masses = [p.mass.mass for p in asset.parts if p.mass and (asset.floating or p is not asset.root)]
    positive = [m for m in masses if m > 0]
    return max(positive) / min(positive) if positive else 1.0
