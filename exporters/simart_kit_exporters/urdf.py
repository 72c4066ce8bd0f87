"""URDF: NAME.urdf, package.xml and meshes/.

The root part is the root link; no world link stands before it, for every simulator fixes or frees a root by
itself. Textured visuals carry no `<material>`: where both are given, some viewers drop the texture.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

import numpy as np
from pydantic import Field

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.bake import textured_surfaces
from simart_kit.hookspecs import Register, hookimpl
from simart_kit.kinematics import ordered_joints, rest_origin
from simart_kit.stages import Exporter
from simart_kit.stages import Options as StageOptions
from simart_kit.surfaces import asset_surfaces

from .gaps import joined, look_gaps
from .overlaps import overlapping_parts, overlapping_strangers, told
from .urdf_links import MeshFolder, add_gazebo, add_link
from .urdf_text import numbers, write_xml

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
        package_uris: bool = Field(
            default=False,
            description="Write a folder NAME that is a ROS package, and refer to its meshes by "
            "package://NAME/... instead of by relative paths, which more loaders read.",
        )

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write the folder; returns NAME.urdf."""
        home, folder = self._folders(asset.name, directory)
        folder.path.mkdir(parents=True)
        robot = Element("robot", {"name": asset.name, "xmlns:drake": "http://drake.mit.edu"})
        # Without these MuJoCo drops visuals, merges links and looks for meshes beside the file.
        flags = {"discardvisual": "false", "fusestatic": "false", "strippath": "false"}
        SubElement(SubElement(robot, "mujoco"), "compiler", flags)
        surfaces = textured_surfaces(asset)
        for part in asset.parts:
            add_link(robot, part, surfaces[part.name], rest_origin(asset, part.name), folder)
        for joint in ordered_joints(asset):
            _add_joint(robot, joint, rest_origin(asset, joint.parent), self.options.dynamics_friction)
        for part in asset.parts:
            add_gazebo(robot, part)
        write_xml(_package(asset.name), home / "package.xml")
        return write_xml(robot, home / f"{asset.name}.urdf")

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
                [j.name for j in joints if j.rigid and j.moves],
            ),
            (
                "dry friction is left out (option dynamics_friction)",
                [j.name for j in joints if j.moves and j.friction and rough],
            ),
            (
                "URDF has no place for the inertia that solvers add (armature): none for",
                [j.name for j in joints if not j.rigid and j.armature],
            ),
            (
                "no mass is known: <inertial> is left out, and MuJoCo refuses the file where the part moves",
                [p.name for p in asset.parts if p.mass is None],
            ),
            *_touching(asset),
        )
        base = ("URDF cannot say that the base is free: load it without fixing the base",)
        return (base if asset.floating else ()) + joined(found) + look_gaps(asset_surfaces(asset))

    def _folders(self, name: str, directory: Path) -> tuple[Path, MeshFolder]:
        """Where the file is, and its meshes: many resolvers take a package's name for that of its folder."""
        if self.options.package_uris:
            home = directory / name
            return home, MeshFolder(home / _FOLDER, f"package://{name}/{_FOLDER}")
        return directory, MeshFolder(directory / _FOLDER, _FOLDER)


def _touching(asset: Asset) -> tuple[tuple[str, list[str]], ...]:
    """Pairs that should not touch, and what it means that they do: strangers, and a joint's own two."""
    strangers = overlapping_strangers(asset)
    own = {pair: overlap for pair, overlap in overlapping_parts(asset).items() if pair not in strangers}
    return (
        ("their shapes overlap, and URDF cannot rule out contact", told(strangers)[1]),
        (
            "their shapes overlap, and MuJoCo has them touch where others do not: give it the MJCF",
            told(own)[1],
        ),
    )


def _add_joint(robot: Element, joint: Joint, parent_origin: FloatArray, friction: bool) -> None:
    kind = "fixed" if joint.rigid or joint.kind in ("ball", "free") else joint.kind
    element = SubElement(robot, "joint", {"name": joint.name, "type": kind})
    SubElement(element, "origin", {"xyz": numbers(*(np.array(joint.origin) - parent_origin)), "rpy": "0 0 0"})
    SubElement(element, "parent", {"link": joint.parent})
    SubElement(element, "child", {"link": joint.child})
    if kind == "fixed":
        return
    SubElement(element, "axis", {"xyz": numbers(*joint.axis)})
    limit = {"effort": numbers(joint.effort), "velocity": numbers(joint.velocity)}
    if joint.limits:
        limit = {"lower": numbers(joint.limits.lower), "upper": numbers(joint.limits.upper)} | limit
    SubElement(element, "limit", limit)
    dynamics = {"damping": numbers(joint.damping)}
    SubElement(element, "dynamics", dynamics | ({"friction": numbers(joint.friction)} if friction else {}))


def _package(name: str) -> Element:
    package = Element("package", {"format": "3"})
    SubElement(package, "name").text = name
    SubElement(package, "version").text = "0.0.0"
    SubElement(package, "description").text = f"URDF of {name}"
    SubElement(package, "maintainer", {"email": "nobody@localhost"}).text = "nobody"
    SubElement(package, "license").text = "as the source mesh"
    return package


@hookimpl
def register_exporters(register: Register) -> None:
    """Offer URDF."""
    register(Urdf)
