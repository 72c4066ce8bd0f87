"""Pairs of parts whose collision shapes overlap, as MuJoCo sees them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, ConvexMesh
from simart_kit.kinematics import rest_origin, span

from .gaps import rigid
from .mjcf_bodies import add_bodies
from .mjcf_shapes import set_primitive
from .sheets import backed_hull

if TYPE_CHECKING:
    import mujoco

    Depths = dict[tuple[str, str], float]

TOLERANCE = 1e-5
"""How deep shapes may overlap and still count as touching [m]."""

_STOPS = 9


@dataclass(frozen=True)
class Overlap:
    """Why two parts must not touch.

    Attributes:
        depth: how deep their shapes overlap at most [m].
        at_rest: whether they do at rest; otherwise on the way of the joint between them alone.
    """

    depth: float
    at_rest: bool

    def words(self, first: str, second: str) -> str:
        """The pair, how deep and where."""
        where = "at rest" if self.at_rest else "on the way"
        return f"{first} and {second} ({1000 * self.depth:.2g} mm) {where}"


def overlapping_parts(asset: Asset) -> dict[tuple[str, str], Overlap]:
    """Pairs of parts that would collide where they should not, in the asset's order.

    These are pairs that overlap at rest, and a part and the one that it moves on where the joint's own travel
    makes them overlap: shapes are coarser than surfaces, and would stop a door short of its limit. Pairs that
    MuJoCo never collides, such as a part and the one that it moves on where the base is free, are left out.
    """
    import mujoco

    if not any(part.collision for part in asset.parts):
        return {}
    model = _collision_spec(asset).compile()
    data = mujoco.MjData(model)
    at_rest = _depths(model, data, {})
    deepest = dict(at_rest)
    for joint in asset.joints:
        if rigid(joint) or span(joint) == (0.0, 0.0):
            continue
        for position in np.linspace(*span(joint), _STOPS):
            on_the_way = _depths(model, data, {joint.name: float(position)})
            for pair, depth in on_the_way.items():
                if set(pair) == {joint.parent, joint.child}:
                    deepest[pair] = max(depth, deepest.get(pair, 0.0))
    overlaps = {pair: Overlap(depth, pair in at_rest) for pair, depth in deepest.items()}
    index = asset.part_index
    ordered = {(min(pair, key=index), max(pair, key=index)): found for pair, found in overlaps.items()}
    return {
        pair: ordered[pair] for pair in sorted(ordered, key=lambda pair: (index(pair[0]), index(pair[1])))
    }


def overlapping_strangers(asset: Asset) -> dict[tuple[str, str], Overlap]:
    """Those of `overlapping_parts` that no joint connects, for formats whose joints rule out contact."""
    jointed = [{j.parent, j.child} for j in asset.joints if j.kind != "free"]
    return {pair: found for pair, found in overlapping_parts(asset).items() if set(pair) not in jointed}


def told(overlaps: Mapping[tuple[str, str], Overlap]) -> tuple[str, list[str]]:
    """What it means, and each of `overlapping_parts` in words."""
    words = [overlap.words(*pair) for pair, overlap in overlaps.items()]
    return "collision shapes overlap, so contact between the parts is off", words


def _depths(model: mujoco.MjModel, data: mujoco.MjData, positions: dict[str, float]) -> Depths:
    """How deep parts overlap at joint positions [rad | m]; joints left out are at rest."""
    import mujoco

    mujoco.mj_resetData(model, data)
    for name, position in positions.items():
        data.joint(name).qpos[0] = position
    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)
    found, contact = np.unique(np.sort(model.geom_bodyid[data.contact.geom]), axis=0, return_inverse=True)
    deepest = np.zeros(len(found))
    np.maximum.at(deepest, contact.ravel(), -data.contact.dist)
    return {
        (model.body(first).name, model.body(second).name): float(depth)
        for (first, second), depth in zip(found, deepest, strict=True)
        if depth > TOLERANCE
    }


def _collision_spec(asset: Asset) -> mujoco.MjSpec:
    """The bodies and joints with collision shapes alone; every body has mass, so that all may move."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    for name, body in add_bodies(spec.worldbody, asset, {p.name: p.name for p in asset.parts}).items():
        body.mass, body.inertia, body.explicitinertial = 1.0, [1.0, 1.0, 1.0], True
        for index, shape in enumerate(asset.part(name).collision):
            _add_shape(spec, body, f"{name}_{index}_mesh", shape, rest_origin(asset, name))
    return spec


def _add_shape(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, mesh: str, shape: ConvexMesh, origin: FloatArray
) -> None:
    import mujoco

    geom = body.add_geom()
    if shape.primitive:
        set_primitive(geom, shape.primitive, origin)
        return
    hull = backed_hull(shape)
    vertices = (hull.vertices - origin).ravel()
    spec.add_mesh(name=mesh, uservert=vertices, userface=hull.faces.ravel())
    geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, mesh
