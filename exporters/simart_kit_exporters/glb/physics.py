"""Rigid bodies by KHR_physics_rigid_bodies, a draft whose layout may still change.

The layout is that of the proposal since mesh colliders name their mesh themselves (2026):
https://github.com/KhronosGroup/glTF/pull/2424
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from simart_kit.asset import Asset, ConvexMesh, MassProperties, Material, Part
from simart_kit.kinematics import rest_origin

from ..usd.frames import principal_axes
from .builder import VERTICES, Builder, Json
from .meshes import add_indices
from .physics_joints import EXTENSION, add_joints


def add_physics(builder: Builder, asset: Asset, nodes: list[Json], apart: Iterable[tuple[str, str]]) -> Json:
    """Add colliders, bodies and joints to the nodes of an asset's parts; returns top-level members.

    Args:
        builder: that the nodes are in.
        asset: in the frame of the file.
        nodes: of the parts, in the asset's order; they get children and the extension.
        apart: pairs of parts without contact, besides those that a joint connects.
    """
    materials = list(dict.fromkeys(part.material for part in asset.parts))
    filters = _filters(apart)
    for part, node in zip(asset.parts, nodes, strict=True):
        if part is not asset.root or asset.floating:
            node["extensions"] = {EXTENSION: {"motion": _motion(asset, part)}}
        settings: Json = {"physicsMaterial": materials.index(part.material)}
        if part.name in filters:
            settings["collisionFilter"] = list(filters).index(part.name)
        for number, shape in enumerate(part.collision, 1):
            collider = _add_collider(builder, asset, part, shape, number, settings)
            node.setdefault("children", []).append(collider)
    top: Json = {"physicsMaterials": [_contact(material) for material in materials]}
    joints = add_joints(builder, asset, nodes)
    if joints:
        top["physicsJoints"] = joints
    if filters:
        top["collisionFilters"] = list(filters.values())
    return {"extensionsUsed": [EXTENSION], "extensions": {EXTENSION: top}}


def _motion(asset: Asset, part: Part) -> Json:
    """Mass properties in the part's frame; without them simulators take those of the shapes."""
    return _inertial(part.mass, asset, part.name) if part.mass else {}


def _inertial(mass: MassProperties, asset: Asset, part: str) -> Json:
    from scipy.spatial.transform import Rotation

    moments, axes = principal_axes(mass.inertia)
    return {
        "mass": mass.mass,
        "centerOfMass": (np.array(mass.center) - rest_origin(asset, part)).tolist(),
        "inertiaDiagonal": moments.tolist(),
        "inertiaOrientation": Rotation.from_matrix(axes).as_quat().tolist(),
    }


def _add_collider(
    builder: Builder, asset: Asset, part: Part, shape: ConvexMesh, number: int, settings: Json
) -> int:
    """Add a node with a convex shape, whose mesh no node draws."""
    name = f"{part.name}_collision_{number}"
    vertices = (shape.vertices - rest_origin(asset, part.name)).astype(np.float32)
    attributes = {"POSITION": builder.add_array(vertices, VERTICES, bounds=True)}
    primitive = {"attributes": attributes, "indices": add_indices(builder, shape.faces, len(vertices))}
    mesh = builder.add("meshes", {"name": name, "primitives": [primitive]})
    collider = {"geometry": {"mesh": mesh, "convexHull": True}, **settings}
    return builder.add("nodes", {"name": name, "extensions": {EXTENSION: {"collider": collider}}})


def _contact(material: Material) -> Json:
    return {
        "staticFriction": material.friction,
        "dynamicFriction": material.friction,
        "restitution": material.restitution,
    }


def _filters(apart: Iterable[tuple[str, str]]) -> dict[str, Json]:
    """By part, with which others it has no contact."""
    without: dict[str, list[str]] = {}
    for first, second in apart:
        without.setdefault(first, []).append(second)
        without.setdefault(second, []).append(first)
    return {
        part: {"collisionSystems": [part], "notCollideWithSystems": others}
        for part, others in without.items()
    }
