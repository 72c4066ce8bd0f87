"""URDF as a source: its links are the parts, its joints the joints (http://wiki.ros.org/urdf/XML).

Read as leniently as the benchmark reads it (`simart_kit.bench.formats.urdf`), with looks, masses and drives
besides. The object stands with every joint at 0, or as near to it as its limits allow.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

import numpy as np

from simart_kit import BadInputError, Joint, Note, Segmentation
from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Articulation, Link, LinkJoint, ordered
from simart_kit.bench.formats.partnet_mobility import labelled, link_kinds
from simart_kit.bench.formats.urdf import PARTNET_FILE
from simart_kit.bench.formats.urdf_tree import read_tree
from simart_kit.bench.formats.xml_files import numbers, read_xml
from simart_kit.kinematics import turned_about

from ..loaders.guards import reading
from ..loaders.pieces import Piece, bounded, joined
from .stated_joints import Stated, stated
from .urdf_looks import Looks

if TYPE_CHECKING:
    from simart_kit import Mesh

_MOST_NAMED = 5


def read_urdf(path: Path) -> Segmentation:
    """Read a URDF file and its meshes: parts and joints on a mesh in the frame of the root link [m], +Z up.

    Raises:
        BadInputError: the file or one of its meshes is missing or damaged; names the file.
    """
    with reading(path, "URDF"):
        return _read(path)


def _read(path: Path) -> Segmentation:
    robot = read_xml(path, "robot")
    tree, elements = read_tree(robot), robot.findall("link")
    links, rest_T_zero, notes = _at_rest(tree.links)
    is_partnet = (path.parent / PARTNET_FILE).is_file()
    if is_partnet:
        kinds = link_kinds(path.parent / PARTNET_FILE)
        links = tuple(labelled(link, kinds) for link in links)
    mesh = _mesh(robot, path.parent, rest_T_zero @ tree.poses)
    if is_partnet:
        mesh = replace(mesh, metres_per_unit=None)  # its objects have no unit
    assert mesh.face_node is not None
    found = stated(Articulation(path.stem, mesh.vertices, mesh.faces, mesh.face_node, links))
    weights, doubts = _masses(elements, found)
    drives = {element.get("name", ""): element for element in robot.findall("joint")}
    texts = [*notes, *found.notes, *doubts, *_mimics(drives)]
    return Segmentation(
        found.face_part,
        tuple(replace(part, mass=weights.get(i)) for part, i in zip(found.parts, found.places, strict=True)),
        joints=_driven(found, drives),
        notes=tuple(Note("load", "warning", text) for text in texts),
        mesh=mesh,
    )


def _at_rest(links: tuple[Link, ...]) -> tuple[tuple[Link, ...], FloatArray, list[str]]:
    """Links in the pose nearest to 0 that limits allow.

    Returns:
        The links with positions counted from there, (L, 4, 4) motion from position 0 to that pose, and notes.
    """
    result, moved, notes = list(links), np.tile(np.eye(4), (len(links), 1, 1)), []
    for index in ordered(links):
        joint, parent = links[index].joint, links[index].parent
        carried = moved[parent] if parent >= 0 else np.eye(4)
        shift = _nearest(joint)
        joint = joint.transformed(carried)
        moved[index] = _motion(joint, shift) @ carried
        if shift and joint.lower is not None and joint.upper is not None:
            notes.append(
                f"joint '{joint.name}' cannot be at 0: its positions are counted from {shift:.4g}, "
                "where it stands"
            )
            joint = replace(joint, lower=joint.lower - shift, upper=joint.upper - shift)
        result[index] = replace(links[index], joint=joint)
    return tuple(result), moved, notes


def _nearest(joint: LinkJoint) -> float:
    """The position nearest to 0 within limits; 0 where there are none, or reversed ones."""
    if joint.kind not in ("revolute", "prismatic") or joint.lower is None or joint.upper is None:
        return 0.0
    return min(max(0.0, joint.lower), joint.upper) if joint.lower <= joint.upper else 0.0


def _motion(joint: LinkJoint, position: float) -> FloatArray:
    """(4, 4) motion of what a joint carries, in the frame that the joint is in."""
    matrix = np.eye(4)
    if not position or joint.axis is None or joint.origin is None:
        return matrix
    axis = np.array(joint.axis)
    if joint.kind != "prismatic":
        return turned_about(axis, np.array(joint.origin), position)
    matrix[:3, 3] = axis * position
    return matrix


def _mesh(robot: Element, folder: Path, world_T_link: FloatArray) -> Mesh:
    """All links as one mesh; `face_node` is the link of each face."""
    looks, pieces = Looks(robot, folder), list[Piece]()
    for index, link in enumerate(robot.findall("link")):
        try:
            pieces += [replace(p.moved(world_T_link[index]), node=index) for p in looks.pieces(link)]
        except BadInputError as error:
            raise BadInputError(f"link '{link.get('name')}': {error}") from error
    if not any(len(piece.faces) for piece in pieces):
        raise BadInputError("no link has a shape")
    return joined(bounded(pieces), looks.materials, "+z", 1.0, True, looks.warnings)


def _masses(elements: list[Element], found: Stated) -> tuple[dict[int, float], list[str]]:
    """Masses [kg] by index of the link, and what is doubtful about them."""
    given = {}
    for index, element in enumerate(elements):
        mass = element.find("inertial/mass")
        if mass is not None:
            given[index] = float(numbers(mass, "value", 1, "")[0])
    known = {index: mass for index, mass in given.items() if mass > 0}
    alike = set(known.values())
    if len(known) > 1 and len(alike) == 1:
        text = f"every link weighs {alike.pop():g} kg: a placeholder, so masses are by volume and material"
        return {}, [text]
    lost = [elements[i].get("name", "") for i in known if i not in found.places]
    if not lost:
        return known, []
    more = f" and {len(lost) - _MOST_NAMED} more" if len(lost) > _MOST_NAMED else ""
    named = ", ".join(f"'{name}'" for name in lost[:_MOST_NAMED])
    return known, [f"the mass of links without a shape is left out: {named}{more}"]


def _driven(found: Stated, drives: dict[str, Element]) -> tuple[Joint, ...]:
    """The joints with the drive that the file gives each."""
    given = zip(found.joints, found.joint_sources, strict=True)
    return tuple(
        _with_drive(joint, drives[name]) if name in drives else joint for joint, name in given if joint
    )


def _with_drive(joint: Joint, element: Element) -> Joint:
    """The joint with damping, friction, effort and velocity; 0 counts as not given, as often written."""

    def given(tag: str, attribute: str, default: float) -> float:
        found = element.find(tag)
        return default if found is None else float(numbers(found, attribute, 1, "0")[0]) or default

    return replace(
        joint,
        damping=given("dynamics", "damping", joint.damping),
        friction=given("dynamics", "friction", joint.friction),
        effort=given("limit", "effort", joint.effort),
        velocity=given("limit", "velocity", joint.velocity),
    )


def _mimics(drives: dict[str, Element]) -> list[str]:
    names = [name for name, element in drives.items() if element.find("mimic") is not None]
    return [f"joint '{name}' mimics another one: it moves by itself here" for name in names]
