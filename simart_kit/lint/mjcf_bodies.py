"""MJCF bodies: mass, inertia and what collides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from .findings import Finding
from .numbers import inertia_findings, mass_findings, sign_findings, spread_findings

if TYPE_CHECKING:
    import mujoco


def body_findings(spec: mujoco.MjSpec) -> Iterator[Finding]:
    """Breaches by the bodies of a model that is not compiled yet."""
    bodies = [body for body in spec.bodies if body.name != "world"]
    if not bodies:
        yield Finding("body-missing", "", "there is no <body>: add one")
        return
    for body in bodies:
        yield from _mass_findings(spec, body)
    for geom in spec.geoms:
        signs = {"friction": float(np.min(geom.friction)), "density": float(geom.density)}
        yield from sign_findings("friction-negative", geom.name or named(geom.parent), signs)
    yield from _collider_findings(spec, bodies)


def _mass_findings(spec: mujoco.MjSpec, body: mujoco.MjsBody) -> Iterator[Finding]:
    import mujoco

    always = int(mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE)
    if not body.explicitinertial or int(spec.compiler.inertiafromgeom) == always:
        if any(_weighs(geom) for geom in body.geoms):
            yield Finding("mass-guessed", named(body), "its mass comes from its geoms: write <inertial>")
        return
    yield from mass_findings(named(body), float(body.mass))
    moments = _moments(body)
    if np.isfinite(moments).all():
        yield from inertia_findings(named(body), moments)


def named(body: mujoco.MjsBody) -> str:
    """What findings call a body."""
    return body.name or "an unnamed body"


def _weighs(geom: mujoco.MjsGeom) -> bool:
    """Whether a geom adds mass to its body; `mass` is NaN where density decides."""
    return bool(geom.density > 0) if np.isnan(geom.mass) else bool(geom.mass > 0)


def _moments(body: mujoco.MjsBody) -> FloatArray:
    """(3,) principal moments [kg*m^2]; `fullinertia` is xx yy zz xy xz yz, and NaN where not given."""
    if np.isnan(body.fullinertia[0]):
        return np.array(body.inertia)
    xx, yy, zz, xy, xz, yz = (float(value) for value in body.fullinertia)
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return np.asarray(np.linalg.eigvalsh(tensor)) if np.isfinite(tensor).all() else np.full(3, np.nan)


def _collider_findings(spec: mujoco.MjSpec, bodies: list[mujoco.MjsBody]) -> Iterator[Finding]:
    paired = {name for pair in spec.pairs for name in (pair.geomname1, pair.geomname2)}
    solid = [
        any(geom.contype or geom.conaffinity or (geom.name and geom.name in paired) for geom in body.geoms)
        for body in bodies
    ]
    if not any(solid):
        yield Finding("collider-missing", "", "no geom collides: set contype and conaffinity of some")
        return
    for body, collides in zip(bodies, solid, strict=True):
        if not collides and any(geom.rgba[3] > 0 for geom in body.geoms):
            text = "none of its geoms collides: add one that does"
            yield Finding("body-collider-missing", named(body), text)


def compiled_findings(model: mujoco.MjModel) -> Iterator[Finding]:
    """Breaches by the mass properties that MuJoCo computes with, against the sizes of bodies."""
    for body in range(1, model.nbody):
        bounds, mass = _bounds(model, body), float(model.body_mass[body])
        if bounds is None or mass <= 0:
            continue
        name, moments = model.body(body).name or "an unnamed body", np.array(model.body_inertia[body])
        yield from spread_findings(name, mass, moments, np.array(model.body_ipos[body]), bounds)


def _bounds(model: mujoco.MjModel, body: int) -> FloatArray | None:
    """(2, 3) corners of the box around a body's geoms in the body's frame [m]; None without geoms."""
    import mujoco

    corners = []
    start = int(model.body_geomadr[body])
    for geom in range(start, start + int(model.body_geomnum[body])):
        if int(model.geom_type[geom]) == int(mujoco.mjtGeom.mjGEOM_PLANE):
            return None
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        center, half = np.array(model.geom_aabb[geom]).reshape(2, 3)
        middle = model.geom_pos[geom] + turn.reshape(3, 3) @ center
        reach = np.abs(turn.reshape(3, 3)) @ half
        corners += [middle - reach, middle + reach]
    return np.array([np.min(corners, axis=0), np.max(corners, axis=0)]) if corners else None
