"""URDF: NAME.urdf, package.xml and meshes/, with relative paths only.

The root part is the root link; no world link stands before it, for every simulator fixes or frees a root by
itself. Textured visuals carry no `<material>`: where both are given, some viewers drop the texture.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

import numpy as np
from pydantic import Field

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, ConvexMesh, Joint, MassProperties, Part
from simart_kit.bake import textured_surfaces
from simart_kit.hookspecs import Register, hookimpl
from simart_kit.kinematics import ordered_joints, rest_origin
from simart_kit.stages import Exporter
from simart_kit.stages import Options as StageOptions
from simart_kit.surfaces import Surface, asset_surfaces

from .gaps import joined, look_gaps, rigid
from .obj_files import srgb_color, write_hull, write_surface
from .sheets import backed, backed_hull, is_speck

_FOLDER = "meshes"


class Urdf(Exporter):
    """Writes URDF that MuJoCo, PyBullet, Pinocchio, yourdfpy, Drake and ROS read."""

    name = "urdf"

    class Options(StageOptions):
        """How URDF is written."""

        dynamics_friction: bool = Field(
            default=False,
            description="Write the dry friction of joints [N*m | N]; Drake is strict and refuses it.",
        )

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write the folder; returns NAME.urdf."""
        folder = directory / _FOLDER
        folder.mkdir()
        robot = Element("robot", {"name": asset.name, "xmlns:drake": "http://drake.mit.edu"})
        # Without these MuJoCo drops visuals, merges links and looks for meshes beside the file.
        flags = {"discardvisual": "false", "fusestatic": "false", "strippath": "false"}
        SubElement(SubElement(robot, "mujoco"), "compiler", flags)
        surfaces = textured_surfaces(asset)
        for part in asset.parts:
            _add_link(robot, part, surfaces[part.name], rest_origin(asset, part.name), folder)
        for joint in ordered_joints(asset):
            _add_joint(robot, joint, rest_origin(asset, joint.parent), self.options.dynamics_friction)
        for part in asset.parts:
            _add_gazebo(robot, part)
        _write_xml(_package(asset.name), directory / "package.xml")
        return _write_xml(robot, directory / f"{asset.name}.urdf")

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """A sentence for each thing that is lost."""
        joints, rough = asset.joints, not self.options.dynamics_friction
        found = (
            (
                "URDF has no ball joint: written as fixed",
                [j.name for j in joints if j.kind == "ball"],
            ),
            (
                "MuJoCo refuses and PyBullet ignores floating joints: written as fixed",
                [j.name for j in joints if j.kind == "free"],
            ),
            (
                "a joint without travel is written as fixed",
                [j.name for j in joints if rigid(j) and j.moves],
            ),
            (
                "dry friction is left out (option dynamics_friction)",
                [j.name for j in joints if j.moves and j.friction and rough],
            ),
            (
                "no mass is known: <inertial> is left out, and MuJoCo refuses the file where the part moves",
                [p.name for p in asset.parts if p.mass is None],
            ),
        )
        base = ("URDF cannot say that the base is free: load it without fixing the base",)
        return (base if asset.floating else ()) + joined(found) + look_gaps(asset_surfaces(asset))


def _add_link(
    robot: Element, part: Part, surfaces: Sequence[Surface], origin: FloatArray, folder: Path
) -> None:
    link = SubElement(robot, "link", {"name": part.name})
    if part.mass:
        _add_inertial(link, part.mass, origin)
    for surface in surfaces:
        if not is_speck(surface):
            _add_visual(link, backed(surface), folder)
    for index, hull in enumerate(part.collision):
        _add_collision(link, part, index, hull, origin, folder)
    contact = SubElement(link, "contact")
    SubElement(contact, "lateral_friction", {"value": _text(part.material.friction)})
    SubElement(contact, "restitution", {"value": _text(part.material.restitution)})


def _add_inertial(link: Element, mass: MassProperties, origin: FloatArray) -> None:
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "origin", {"xyz": _text(*(np.array(mass.center) - origin)), "rpy": "0 0 0"})
    SubElement(inertial, "mass", {"value": _text(mass.mass)})
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
    moments = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
    SubElement(inertial, "inertia", {name: _text(value) for name, value in moments.items()})


def _add_visual(link: Element, surface: Surface, folder: Path) -> None:
    name = f"{surface.part}_visual_{surface.index}"
    visual = SubElement(link, "visual", {"name": name})
    _add_mesh(visual, write_surface(surface, folder))
    if surface.material.base_color_image is None:
        material = SubElement(visual, "material", {"name": name})
        SubElement(material, "color", {"rgba": _text(*srgb_color(surface.material), digits=6)})


def _add_collision(
    link: Element, part: Part, index: int, hull: ConvexMesh, origin: FloatArray, folder: Path
) -> None:
    collision = SubElement(link, "collision", {"name": f"{part.name}_collision_{index}"})
    _add_mesh(collision, write_hull(part.name, backed_hull(hull), origin, folder))
    properties = SubElement(collision, "drake:proximity_properties")
    for name in ("mu_dynamic", "mu_static"):
        SubElement(properties, f"drake:{name}", {"value": _text(part.material.friction)})


def _add_mesh(parent: Element, file: str) -> None:
    SubElement(parent, "origin", {"xyz": "0 0 0", "rpy": "0 0 0"})
    SubElement(SubElement(parent, "geometry"), "mesh", {"filename": f"{_FOLDER}/{file}"})


def _add_joint(robot: Element, joint: Joint, parent_origin: FloatArray, friction: bool) -> None:
    kind = "fixed" if rigid(joint) or joint.kind in ("ball", "free") else joint.kind
    element = SubElement(robot, "joint", {"name": joint.name, "type": kind})
    SubElement(element, "origin", {"xyz": _text(*(np.array(joint.origin) - parent_origin)), "rpy": "0 0 0"})
    SubElement(element, "parent", {"link": joint.parent})
    SubElement(element, "child", {"link": joint.child})
    if kind == "fixed":
        return
    SubElement(element, "axis", {"xyz": _text(*joint.axis)})
    limit = {"effort": _text(joint.effort), "velocity": _text(joint.velocity)}
    if joint.limits:
        limit = {"lower": _text(joint.limits.lower), "upper": _text(joint.limits.upper)} | limit
    SubElement(element, "limit", limit)
    dynamics = {"damping": _text(joint.damping)}
    SubElement(element, "dynamics", dynamics | ({"friction": _text(joint.friction)} if friction else {}))


def _add_gazebo(robot: Element, part: Part) -> None:
    gazebo = SubElement(robot, "gazebo", {"reference": part.name})
    for name in ("mu1", "mu2"):
        SubElement(gazebo, name).text = _text(part.material.friction)


def _package(name: str) -> Element:
    package = Element("package", {"format": "3"})
    SubElement(package, "name").text = name
    SubElement(package, "version").text = "0.0.0"
    SubElement(package, "description").text = f"URDF of {name}"
    SubElement(package, "maintainer", {"email": "nobody@localhost"}).text = "nobody"
    SubElement(package, "license").text = "as the source mesh"
    return package


def _write_xml(root: Element, path: Path) -> Path:
    ElementTree.indent(root)
    path.write_bytes(ElementTree.tostring(root, "utf-8", xml_declaration=True) + b"\n")
    return path


def _text(*values: float, digits: int = 12) -> str:
    return " ".join(f"{value + 0.0:.{digits}g}" for value in values)


@hookimpl
def register_exporters(register: Register) -> None:
    """Offer URDF."""
    register(Urdf)
