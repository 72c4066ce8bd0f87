"""Joints and bodies as plain tables, for formats that have no place of their own for them."""

from __future__ import annotations

from typing import Any

from simart_kit.asset import Asset, Joint, Part

SCHEMA = 1
UNITS = {"length": "m", "angle": "rad", "mass": "kg", "time": "s", "force": "N"}
FRAME = "right-handed, +Y up, front +Z, ground at y = 0, everything at rest"


def joint_table(joint: Joint) -> dict[str, Any]:
    """A joint in the frame of its asset; `axis` and `limits` are None where its kind has none."""
    has_axis = joint.turns or joint.kind == "prismatic"
    return {
        "name": joint.name,
        "kind": joint.kind,
        "parent": joint.parent,
        "child": joint.child,
        "origin": list(joint.origin),
        "axis": list(joint.axis) if has_axis else None,
        "limits": [joint.limits.lower, joint.limits.upper] if joint.limits else None,
        "damping": joint.damping,
        "friction": joint.friction,
        "effort": joint.effort,
        "velocity": joint.velocity,
    }


def body_table(part: Part) -> dict[str, Any]:
    """A part as a body in the frame of its asset; mass properties are None where they are not known."""
    mass = part.mass
    return {
        "name": part.name,
        "label": part.label,
        "material": part.material.name,
        "friction": part.material.friction,
        "restitution": part.material.restitution,
        "mass": mass and mass.mass,
        "center_of_mass": mass and list(mass.center),
        "inertia": mass and [list(row) for row in mass.inertia],
    }


def heading(asset: Asset) -> dict[str, Any]:
    """What the tables are about, and in which units and frame."""
    return {
        "schema": SCHEMA,
        "name": asset.name,
        "units": UNITS,
        "frame": FRAME,
        "floating": asset.floating,
    }
