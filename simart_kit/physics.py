"""The material table, and mass, inertia and collision shapes from geometry."""

from __future__ import annotations

from .asset import Material

DEFAULT_MATERIAL = "wood"

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
