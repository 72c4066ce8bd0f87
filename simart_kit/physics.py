"""Mass properties from geometry and materials."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .arrays import FloatArray, IntArray, mat3, vec3
from .asset import MassProperties
from .materials import DEFAULT_MATERIAL as DEFAULT_MATERIAL
from .materials import MATERIALS as MATERIALS
from .materials import Build
from .moments import inertia
from .solids import THICKNESS, Solid, solid

MIN_MASS = 0.001  # [kg]; lighter bodies make simulators stiff


def mass_properties(
    vertices: FloatArray,
    faces: IntArray,
    density: float = 600.0,
    thickness: float = THICKNESS,
    solid_up_to: float = math.inf,
) -> MassProperties:
    """Mass, centre and inertia of the material that a surface bounds; see `solids.solid` for the rules.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3) triangles, closed or not, wound either way.
        density: [kg/m^3].
        thickness: of boards drawn as a single surface, and of walls [m].
        solid_up_to: mean thickness beyond which closed shells have walls only [m].
    """
    return weigh(solid(vertices, faces, Build(thickness, solid_up_to)), density)


def weigh(body: Solid, density: float) -> MassProperties:
    """Mass properties at a density [kg/m^3], `MIN_MASS` at least; always valid for a simulator."""
    mass = density * float(body.moments[3, 3])
    method = body.method if mass >= MIN_MASS else f"{body.method}, at least {MIN_MASS * 1000:g} g"
    mass = max(mass, MIN_MASS)
    center, unit_inertia = inertia(body.moments)
    return MassProperties(mass, vec3(center), mat3(mass * unit_inertia), method)


def as_stated(properties: MassProperties, mass: float) -> MassProperties:
    """The same body with a mass that a person stated [kg]; the inertia follows."""
    scaled = mat3(np.array(properties.inertia) * (mass / properties.mass))
    return replace(properties, mass=mass, inertia=scaled, method=f"{properties.method}, as stated")
