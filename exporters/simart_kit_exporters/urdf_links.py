"""Links of URDF: mass, drawn surfaces, solid shapes, and friction in the tags of each simulator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import ConvexMesh, MassProperties, Part
from simart_kit.primitives import Primitive
from simart_kit.surfaces import Surface

from .obj_files import srgb_color, write_hull, write_surface
from .rotations import roll_pitch_yaw
from .sheets import backed, backed_hull, is_speck
from .urdf_text import numbers

_HERE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class MeshFolder:
    """Where meshes are written, and how links refer to it.

    Attributes:
        path: an existing folder.
        uri: the same folder in the file's words, such as "meshes".
    """

    path: Path
    uri: str


def add_link(
    robot: Element, part: Part, surfaces: Sequence[Surface], origin: FloatArray, folder: MeshFolder
) -> None:
    """Add the link of a part whose frame stands at (3,) `origin` in the asset frame."""
    link = SubElement(robot, "link", {"name": part.name})
    if part.mass:
        _add_inertial(link, part.mass, origin)
    for surface in surfaces:
        if not is_speck(surface):
            _add_visual(link, backed(surface), folder)
    for index, shape in enumerate(part.collision):
        _add_collision(link, part, index, shape, origin, folder)
    contact = SubElement(link, "contact")  # PyBullet's
    SubElement(contact, "lateral_friction", {"value": numbers(part.material.friction)})
    SubElement(contact, "restitution", {"value": numbers(part.material.restitution)})


def add_gazebo(robot: Element, part: Part) -> None:
    """Add Gazebo's own element about a link, which it looks for beside the links."""
    gazebo = SubElement(robot, "gazebo", {"reference": part.name})
    for name in ("mu1", "mu2"):
        SubElement(gazebo, name).text = numbers(part.material.friction)


def _add_inertial(link: Element, mass: MassProperties, origin: FloatArray) -> None:
    inertial = SubElement(link, "inertial")
    _add_origin(inertial, np.array(mass.center) - origin)
    SubElement(inertial, "mass", {"value": numbers(mass.mass)})
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
    moments = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
    SubElement(inertial, "inertia", {name: numbers(value) for name, value in moments.items()})


def _add_visual(link: Element, surface: Surface, folder: MeshFolder) -> None:
    name = f"{surface.part}_visual_{surface.index}"
    visual = SubElement(link, "visual", {"name": name})
    _add_origin(visual, np.array(_HERE))
    _add_mesh(visual, write_surface(surface, folder.path), folder)
    if surface.material.base_color_image is None:
        material = SubElement(visual, "material", {"name": name})
        SubElement(material, "color", {"rgba": numbers(*srgb_color(surface.material), digits=6)})


def _add_collision(
    link: Element, part: Part, index: int, shape: ConvexMesh, origin: FloatArray, folder: MeshFolder
) -> None:
    collision = SubElement(link, "collision", {"name": f"{part.name}_collision_{index}"})
    if shape.primitive:
        _add_primitive(collision, shape.primitive, origin)
    else:
        _add_origin(collision, np.array(_HERE))
        _add_mesh(collision, write_hull(part.name, backed_hull(shape), origin, folder.path), folder)
    properties = SubElement(collision, "drake:proximity_properties")
    for name in ("mu_dynamic", "mu_static"):
        SubElement(properties, f"drake:{name}", {"value": numbers(part.material.friction)})


def _add_primitive(parent: Element, shape: Primitive, origin: FloatArray) -> None:
    pose = shape.asset_T_shape
    _add_origin(parent, pose[:3, 3] - origin, roll_pitch_yaw(pose[:3, :3]))
    x, y, z = shape.size
    geometry = SubElement(parent, "geometry")
    if shape.kind == "box":
        SubElement(geometry, "box", {"size": numbers(x, y, z)})
    elif shape.kind == "cylinder":
        SubElement(geometry, "cylinder", {"radius": numbers(x / 2), "length": numbers(z)})
    else:
        SubElement(geometry, "sphere", {"radius": numbers(x / 2)})


def _add_origin(parent: Element, place: FloatArray, angles: Sequence[float] = _HERE) -> None:
    SubElement(parent, "origin", {"xyz": numbers(*place), "rpy": numbers(*angles)})


def _add_mesh(parent: Element, file: str, folder: MeshFolder) -> None:
    SubElement(SubElement(parent, "geometry"), "mesh", {"filename": f"{folder.uri}/{file}"})
