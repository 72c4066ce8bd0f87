"""The material table, and mass properties from geometry."""

from __future__ import annotations

from .arrays import FloatArray, IntArray, mat3, vec3
from .asset import MassProperties, Material
from .moments import inertia
from .solids import THICKNESS, Solid, solid

DEFAULT_MATERIAL = "wood"
MIN_MASS = 0.001  # [kg]; lighter bodies make simulators stiff

# Typical values of engineering tables; densities are of the solid material.
MATERIALS: dict[str, Material] = {
    m.name: m
    for m in (
        Material("wood", 600.0, 0.5, 0.2),
        Material("mdf", 750.0, 0.5, 0.2),
        Material("glass", 2500.0, 0.4, 0.3),
        Material("steel", 7850.0, 0.5, 0.3),
        Material("aluminium", 2700.0, 0.45, 0.3),
        Material("plastic", 1050.0, 0.4, 0.3),
        Material("ceramic", 2300.0, 0.45, 0.2),
        Material("rubber", 1100.0, 0.9, 0.6),
        Material("fabric", 300.0, 0.6, 0.05),
        Material("stone", 2600.0, 0.6, 0.2),
    )
}


def mass_properties(
    vertices: FloatArray, faces: IntArray, density: float = 600.0, thickness: float = THICKNESS
) -> MassProperties:
    """Mass, centre and inertia of the material that a surface bounds; see `solids.solid` for open surfaces.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3) triangles, closed or not, wound either way.
        density: [kg/m^3].
        thickness: of boards drawn as a single surface [m].
    """
    return weigh(solid(vertices, faces, thickness), density)


def weigh(body: Solid, density: float) -> MassProperties:
    """Mass properties at a density [kg/m^3], `MIN_MASS` at least; always valid for a simulator."""
    mass = density * float(body.moments[3, 3])
    method = body.method if mass >= MIN_MASS else f"{body.method}, at least {MIN_MASS * 1000:g} g"
    mass = max(mass, MIN_MASS)
    center, unit_inertia = inertia(body.moments)
    return MassProperties(mass, vec3(center), mat3(mass * unit_inertia), method)
