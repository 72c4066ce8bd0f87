"""Geoms of MJCF: drawn surfaces, and solid shapes as MuJoCo's own types where they are primitives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Part
from simart_kit.primitives import Primitive
from simart_kit.surfaces import Surface

from .mjcf_model import Model
from .obj_files import write_hull, write_surface
from .sheets import backed_hull

if TYPE_CHECKING:
    import mujoco

_TORSIONAL, _ROLLING = 0.005, 0.0001  # MuJoCo's own defaults [m]


def add_visual(model: Model, body: mujoco.MjsBody, surface: Surface, material: str) -> None:
    """Draw a surface."""
    mesh = model.add_mesh(write_surface(surface, model.folder, with_material=False))
    name = model.flavor.visual_name.format(part=surface.part, index=surface.index)
    body.add_geom(model.spec.find_default("visual"), name=name, meshname=mesh, material=material)


def add_collision(model: Model, body: mujoco.MjsBody, part: Part, origin: FloatArray) -> None:
    """Add the solid shapes of a part whose frame stands at (3,) `origin` in the asset frame."""
    friction = [part.material.friction, _TORSIONAL, _ROLLING]
    for index, shape in enumerate(part.collision):
        name = model.flavor.collision_name.format(part=part.name, index=index)
        geom = body.add_geom(model.spec.find_default("collision"), name=name, friction=friction)
        if shape.primitive:
            set_primitive(geom, shape.primitive, origin)
        else:
            geom.meshname = model.add_mesh(write_hull(part.name, backed_hull(shape), origin, model.folder))


def set_primitive(geom: mujoco.MjsGeom, shape: Primitive, origin: FloatArray) -> None:
    """Make a box, cylinder or sphere of a geom in a body that stands at (3,) `origin` in the asset frame."""
    import mujoco

    types = {
        "box": mujoco.mjtGeom.mjGEOM_BOX,
        "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
        "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    }
    x, y, z = (0.5 * extent for extent in shape.size)
    sizes = {"box": [x, y, z], "cylinder": [x, z, 0.0], "sphere": [x, 0.0, 0.0]}
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(shape.asset_T_shape[:3, :3]).ravel())
    geom.type = types[shape.kind]
    geom.size = sizes[shape.kind]
    geom.pos = shape.asset_T_shape[:3, 3] - origin
    geom.quat = quaternion
