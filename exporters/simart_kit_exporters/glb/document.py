"""The table of contents of a GLB export: an asset as a tree of nodes."""

from __future__ import annotations

from simart_kit.asset import Asset
from simart_kit.kinematics import rest_origin
from simart_kit.surfaces import asset_surfaces

from ..both_sides import two_sided_parts
from ..joint_data import body_table, heading, joint_table
from ..overlaps import overlapping_strangers
from ..y_up import y_up
from .builder import Builder, Json
from .clips import add_clips
from .materials import add_materials, by_look
from .meshes import add_mesh
from .physics import add_physics


def glb_bytes(asset: Asset, physics: bool) -> bytes:
    """A GLB file of an asset; with `physics` also as rigid bodies, by a draft extension."""
    apart = tuple(overlapping_strangers(asset)) if physics else ()
    asset, builder = y_up(asset), Builder()
    surfaces, two_sided = asset_surfaces(asset), two_sided_parts(asset)
    materials = add_materials(builder, by_look((s for g in surfaces.values() for s in g), two_sided))
    nodes = [_node(asset, part.name) for part in asset.parts]
    for part, node in zip(asset.parts, nodes, strict=True):
        node["mesh"] = add_mesh(builder, surfaces[part.name], materials, part.name in two_sided)
        builder.add("nodes", node)
    add_clips(builder, asset)
    extensions = add_physics(builder, asset, nodes, apart) if physics else {}
    scene = {"name": asset.name, "nodes": [asset.part_index(asset.root.name)], "extras": heading(asset)}
    return builder.glb({**extensions, "scene": 0, "scenes": [scene]})


def _node(asset: Asset, part: str) -> Json:
    """A part's node, without its mesh; node i is part i."""
    result: Json = {"name": part}
    joint = asset.joint_to(part)
    if joint:
        origin = rest_origin(asset, part) - rest_origin(asset, joint.parent) + 0.0
        result["translation"] = origin.tolist()
    children = [asset.part_index(j.child) for j in asset.joints if j.parent == part]
    if children:
        result["children"] = children
    result["extras"] = {"body": body_table(asset.part(part))}
    if joint:
        result["extras"]["joint"] = joint_table(joint)
    return result
