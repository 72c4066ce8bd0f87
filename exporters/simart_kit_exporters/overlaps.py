"""Pairs of parts whose collision shapes overlap at rest, as MuJoCo sees them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.asset import Asset
from simart_kit.kinematics import rest_origin

from .mjcf_bodies import add_bodies
from .sheets import backed_hull

if TYPE_CHECKING:
    import mujoco

TOLERANCE = 1e-5
"""How deep shapes may overlap and still count as touching [m]."""


def overlapping_parts(asset: Asset) -> dict[tuple[str, str], float]:
    """Depth [m] by pair of part names, in the asset's order, for pairs that would collide at rest.

    Pairs that MuJoCo never collides, such as a moving part and the part that it moves on, are not among them.
    """
    import mujoco

    if not any(part.collision for part in asset.parts):
        return {}
    model = _collision_spec(asset).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    order = {part.name: index for index, part in enumerate(asset.parts)}
    depths: dict[tuple[str, str], float] = {}
    for contact in data.contact:
        names = [model.body(model.geom_bodyid[geom]).name for geom in contact.geom]
        first, second = sorted(names, key=order.__getitem__)
        depth = max(-float(contact.dist), depths.get((first, second), 0.0))
        if depth > TOLERANCE:
            depths[first, second] = depth
    return {pair: depths[pair] for pair in sorted(depths, key=lambda p: (order[p[0]], order[p[1]]))}


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
