"""Pairs of parts whose collision shapes overlap, as MuJoCo sees them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.asset import Asset
from simart_kit.kinematics import rest_origin, span

from .gaps import rigid
from .mjcf_bodies import add_bodies
from .sheets import backed_hull

if TYPE_CHECKING:
    import mujoco

    Depths = dict[tuple[str, str], float]

TOLERANCE = 1e-5
"""How deep shapes may overlap and still count as touching [m]."""

_STOPS = 9


def overlapping_parts(asset: Asset) -> dict[tuple[str, str], float]:
    """Pairs of parts that would collide where they should not, and how deep [m], in the asset's order.

    These are pairs that overlap at rest, and a part and the one that it moves on where the joint's own travel
    makes them overlap: shapes are coarser than surfaces, and would stop a door short of its limit. Pairs that
    MuJoCo never collides, such as a part and the one that it moves on where the base is free, are left out.
    """
    import mujoco

    if not any(part.collision for part in asset.parts):
        return {}
    model = _collision_spec(asset).compile()
    data = mujoco.MjData(model)
    depths = _depths(asset, model, data, {})
    for joint in asset.joints:
        if rigid(joint) or span(joint) == (0.0, 0.0):
            continue
        for position in np.linspace(*span(joint), _STOPS):
            on_the_way = _depths(asset, model, data, {joint.name: float(position)})
            for pair, depth in on_the_way.items():
                if set(pair) == {joint.parent, joint.child}:
                    depths[pair] = max(depth, depths.get(pair, 0.0))
    order = _order(asset)
    return {pair: depths[pair] for pair in sorted(depths, key=lambda p: (order[p[0]], order[p[1]]))}


def overlapping_strangers(asset: Asset) -> dict[tuple[str, str], float]:
    """Those of `overlapping_parts` that no joint connects, for formats whose joints rule out contact."""
    jointed = [{j.parent, j.child} for j in asset.joints if j.kind != "free"]
    return {pair: depth for pair, depth in overlapping_parts(asset).items() if set(pair) not in jointed}


def told(pairs: Mapping[tuple[str, str], float]) -> tuple[str, list[str]]:
    """What it means, and the pairs of `overlapping_parts` in words."""
    words = [f"{first} and {second} ({1000 * depth:.2g} mm)" for (first, second), depth in pairs.items()]
    return "collision shapes overlap at rest or on the way, so contact between the parts is off", words


def _depths(asset: Asset, model: mujoco.MjModel, data: mujoco.MjData, positions: dict[str, float]) -> Depths:
    """How deep parts overlap at joint positions [rad | m]; joints left out are at rest."""
    import mujoco

    mujoco.mj_resetData(model, data)
    for name, position in positions.items():
        data.joint(name).qpos[0] = position
    mujoco.mj_forward(model, data)
    order = _order(asset)
    depths: Depths = {}
    for contact in data.contact:
        names = [model.body(model.geom_bodyid[geom]).name for geom in contact.geom]
        first, second = sorted(names, key=order.__getitem__)
        depth = max(-float(contact.dist), depths.get((first, second), 0.0))
        if depth > TOLERANCE:
            depths[first, second] = depth
    return depths


def _order(asset: Asset) -> dict[str, int]:
    return {part.name: index for index, part in enumerate(asset.parts)}


def _collision_spec(asset: Asset) -> mujoco.MjSpec:
    """The bodies and joints with collision shapes alone; every body has mass, so that all may move."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    for name, body in add_bodies(spec, asset, armature=0.0).items():
        body.mass, body.inertia, body.explicitinertial = 1.0, [1.0, 1.0, 1.0], True
        for index, shape in enumerate(asset.part(name).collision):
            hull = backed_hull(shape)
            mesh = f"{name}_{index}_mesh"
            vertices = (hull.vertices - rest_origin(asset, name)).ravel()
            spec.add_mesh(name=mesh, uservert=vertices, userface=hull.faces.ravel())
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh)
    return spec
