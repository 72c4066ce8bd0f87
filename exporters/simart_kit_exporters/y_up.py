"""Assets in the frame of glTF, RealityKit and AR Quick Look: metres, +Y up, front +Z, the ground at y = 0."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, Vec3, mat3, vec3
from simart_kit.asset import Asset, ConvexMesh, Joint, MassProperties, Part
from simart_kit.mesh import z_up_from

# (x, y, z) -> (x, z, -y): the inverse of how glTF files are read.
_TURN = z_up_from("+y").T


def y_up(asset: Asset) -> Asset:
    """The asset turned as a whole: everything that is in the asset frame is then in the +Y up frame.

    Collision shapes are meshes alone: primitives are told in the +Z up frame.
    """
    new_from_old = np.eye(4)
    new_from_old[:3, :3] = _TURN
    return replace(
        asset,
        mesh=replace(asset.mesh.transformed(new_from_old), up="+y"),
        parts=tuple(_turned_part(part) for part in asset.parts),
        joints=tuple(_turned_joint(joint) for joint in asset.joints),
        asset_from_source=new_from_old @ asset.asset_from_source,
    )


def _turned_part(part: Part) -> Part:
    mass = part.mass and _turned_mass(part.mass)
    return replace(part, mass=mass, collision=tuple(_turned_shape(shape) for shape in part.collision))


def _turned_mass(mass: MassProperties) -> MassProperties:
    inertia = _TURN @ np.array(mass.inertia) @ _TURN.T
    return replace(mass, center=_turned(mass.center), inertia=mat3(inertia + 0.0))


def _turned_shape(shape: ConvexMesh) -> ConvexMesh:
    vertices: FloatArray = shape.vertices @ _TURN.T
    return ConvexMesh(vertices, shape.faces)


def _turned_joint(joint: Joint) -> Joint:
    return replace(joint, origin=_turned(joint.origin), axis=_turned(joint.axis))


def _turned(vector: Vec3) -> Vec3:
    return vec3(_TURN @ np.array(vector) + 0.0)  # + 0.0 turns -0.0 into 0
