"""`mass`: mass, centre and inertia of every part; damping and friction of joints that have none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from pydantic import Field

import simart_kit as sk
from simart_kit.arrays import FloatArray
from simart_kit.asset import Joint
from simart_kit.hookspecs import Register
from simart_kit.kinematics import carried
from simart_kit.physics import MIN_MASS, weigh
from simart_kit.solids import THICKNESS, Solid, solid

# Resistance per inertia that the joint moves: a door of 3 kg gets 0.05 N m s/rad and 0.02 N m, a drawer of
# 3 kg 2 N s/m and 0.5 N. Proportional, for then doors of all sizes come to rest alike and none is stiff.
_TURN_DAMPING, _TURN_FRICTION = 0.2, 0.08  # [1/s], [rad/s^2]
_SLIDE_DAMPING, _SLIDE_FRICTION = 0.67, 0.17  # [1/s], [m/s^2]
_MOSTLY = 0.5  # share of a part's volume that open surfaces stand for, above which its mass is doubtful


class Mass(sk.Modifier):
    """Weigh every part by what its surface bounds and by its material."""

    name = "mass"

    class Options(sk.Options):
        """What the surface does not say."""

        density: float | None = Field(
            None,
            gt=0,
            allow_inf_nan=False,
            description="of all parts [kg/m^3]; without it, that of each part's material",
        )
        thickness: float = Field(
            THICKNESS, gt=0, le=1, description="of boards that are drawn as one open surface [m]"
        )

    options: Options

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset with mass properties, and with joints that resist a little."""
        vertices, faces = asset.mesh.vertices, asset.mesh.faces
        bodies = {
            part.name: solid(vertices, faces[asset.face_part == index], self.options.thickness)
            for index, part in enumerate(asset.parts)
        }
        weighed = asset.with_parts(
            {
                part.name: replace(
                    part, mass=weigh(bodies[part.name], self.options.density or part.material.density)
                )
                for part in asset.parts
            }
        )
        joints = {joint.name: _with_resistance(weighed, joint) for joint in asset.joints}
        changed = [name for name, joint in joints.items() if joint is not asset.joint(name)]
        texts = [_summary(weighed)]
        if changed:
            texts.append(f"damping and friction in proportion to what moves: {', '.join(changed)}")
        return (
            weighed.with_joints(joints)
            .with_notes("mass", "info", texts)
            .with_notes("mass", "warning", _doubts(weighed, bodies))
        )


def _summary(asset: sk.Asset) -> str:
    return "; ".join(f"{p.name} {p.mass.mass:.3g} kg ({p.mass.method})" for p in asset.parts if p.mass)


def _doubts(asset: sk.Asset, bodies: dict[str, Solid]) -> list[str]:
    tiny = [p.name for p in asset.parts if p.mass and p.mass.mass <= MIN_MASS]
    guessed = [name for name, body in bodies.items() if body.guessed > _MOSTLY and name not in tiny]
    texts = {
        f"too small to weigh, {MIN_MASS * 1000:g} g assumed: {', '.join(tiny)}": tiny,
        f"open surfaces, so their masses are guesses: {', '.join(guessed)}": guessed,
    }
    return [text for text, names in texts.items() if names]


def _with_resistance(asset: sk.Asset, joint: Joint) -> Joint:
    """The joint with damping and friction where it has 0, by the inertia that it moves."""
    if joint.kind in ("fixed", "free") or (joint.damping and joint.friction):
        return joint
    slides = joint.kind == "prismatic"
    load = _load(asset, joint)
    damping = load * (_SLIDE_DAMPING if slides else _TURN_DAMPING)
    friction = load * (_SLIDE_FRICTION if slides else _TURN_FRICTION)
    return replace(joint, damping=joint.damping or damping, friction=joint.friction or friction)


def _load(asset: sk.Asset, joint: Joint) -> float:
    """Mass [kg] that a slide moves with all that hangs on it; else inertia about its axis [kg*m^2]."""
    load, moved = 0.0, carried(asset, joint.child)
    for part in asset.parts:
        if part.name in moved and part.mass is not None:
            arm = np.array(part.mass.center) - np.array(joint.origin)
            inertia = np.array(part.mass.inertia)
            inertia += part.mass.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
            load += part.mass.mass if joint.kind == "prismatic" else _about(inertia, joint)
    return load


def _about(inertia: FloatArray, joint: Joint) -> float:
    """Inertia (3, 3) about the joint's axis; the mean over all axes for a ball joint."""
    if joint.kind == "ball":
        return float(np.trace(inertia) / 3)
    axis = np.array(joint.axis)
    return float(axis @ inertia @ axis)


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Mass)
