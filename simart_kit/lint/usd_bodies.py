"""USD rigid bodies: placement, mass and inertia."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from .findings import Finding
from .numbers import inertia_findings, mass_findings, spread_findings
from .usd_scene import UsdScene, body_of, stated

if TYPE_CHECKING:
    from pxr import Gf, Usd


def body_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by rigid bodies."""
    if not scene.bodies:
        yield Finding("body-missing", "", "no prim has RigidBodyAPI: apply it to what moves")
    for body in scene.bodies:
        where = str(body.GetPath())
        turn = scene.pose(body)[:3, :3]
        if np.abs(turn.T @ turn - np.eye(3)).max() > 1e-4:
            yield Finding("body-scaled", where, "it is scaled or sheared: bake that into its shapes")
        above = body_of(body.GetParent())
        if above:
            text = f"it stands below body {above.GetPath()}: make them siblings"
            yield Finding("body-nested", where, text)
        if not stated(body, "physics:kinematicEnabled"):
            yield from _mass_findings(scene, body)


def quaternion_findings(where: str, name: str, turn: Gf.Quatf | None) -> Iterator[Finding]:
    """Breaches by a rotation; NaN is told of elsewhere."""
    length = 1.0 if turn is None else float(turn.GetLength())
    if abs(length - 1) > 1e-3:
        text = f"{name} has length {length:g}: write a unit quaternion, (1, 0, 0, 0) for none"
        yield Finding("quaternion-not-unit", where, text)


def _mass_findings(scene: UsdScene, body: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdPhysics

    where = str(body.GetPath())
    mass = stated(body, "physics:mass") if body.HasAPI(UsdPhysics.MassAPI) else None
    if mass is None:
        if any(_weighs(prim) for prim in (body, *scene.shapes(body))):
            yield Finding("mass-guessed", where, "its mass is that of its colliders: author mass and inertia")
        else:
            yield Finding("mass-missing", where, "it has no mass: apply MassAPI with mass and inertia")
        return
    yield from mass_findings(where, mass)
    moments = stated(body, "physics:diagonalInertia")
    if moments is None:
        yield Finding("inertia-missing", where, "it has no diagonalInertia: author it, with principalAxes")
        return
    found = tuple(inertia_findings(where, np.array(moments, dtype=np.float64)))
    yield from found
    yield from quaternion_findings(where, "principalAxes", stated(body, "physics:principalAxes"))
    if not found:
        yield from _spread_findings(scene, body, mass)


def _weighs(prim: Usd.Prim) -> bool:
    """Whether mass or density is authored on a prim."""
    from pxr import UsdPhysics

    return prim.HasAPI(UsdPhysics.MassAPI) and any(
        (stated(prim, name) or 0) > 0 for name in ("physics:mass", "physics:density")
    )


def _spread_findings(scene: UsdScene, body: Usd.Prim, mass: float) -> Iterator[Finding]:
    center, bounds = stated(body, "physics:centerOfMass"), scene.bounds(body)
    if center is None or bounds is None or not np.isfinite(center).all():
        return
    moments = np.array(stated(body, "physics:diagonalInertia"), dtype=np.float64)
    yield from spread_findings(str(body.GetPath()), mass, moments, np.array(center, dtype=np.float64), bounds)
