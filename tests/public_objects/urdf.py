"""An object that is a URDF file, such as PyBullet's samples."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Link, ordered
from simart_kit.bench.formats.mesh_files import Triangles, moved
from simart_kit.bench.formats.urdf_shapes import mesh_file, mesh_scale, primitive, shape_of
from simart_kit.bench.formats.urdf_tree import origin, read_tree
from simart_kit.bench.formats.xml_files import numbers, read_xml

from .rigged import GREY, Piece, Rigged, unlimited
from .sources import Entry


def read_urdf(path: Path, entry: Entry) -> Rigged:
    """Read a file at position 0 of its joints; metres, +z up.

    Raises:
        BadInputError: the file or one of its meshes is missing or damaged.
    """
    robot = read_xml(_tidied(path), "robot")
    tree = read_tree(robot)
    order = ordered(tree.links)
    number = {old: new for new, old in enumerate(order)} | {-1: -1}
    links = tuple(
        replace(k, parent=number[k.parent], joint=unlimited(k.joint)) for k in (tree.links[i] for i in order)
    )
    named = {element.get("name", ""): element for element in robot.findall("material")}
    pieces = [
        Piece(*moved(surface, world_T_link @ origin(visual)), colors, number[index])
        for index, (element, world_T_link) in enumerate(zip(robot.findall("link"), tree.poses, strict=True))
        for visual in element.findall("visual")
        for surface, colors in _surfaces(visual, path.parent, named)
    ]
    return _with_seen_base(tuple(pieces), links)


def _tidied(path: Path) -> Path:
    """A copy that parsers take: without what xacro left over, and without commas between numbers."""
    text = path.read_text(encoding="utf-8", errors="replace")
    text = text[max(text.find("<?xml"), 0) :]
    text = re.sub(r"\$\(optenv \S+ ([^)]*)\)", r"\1", text)
    text = re.sub(r'(?:xyz|rpy|size|scale)="[^"]*"', lambda found: found[0].replace(",", " "), text)
    copy = path.with_suffix(".tidied.urdf")
    copy.write_text(text, encoding="utf-8")
    return copy


def _surfaces(visual: Element, folder: Path, named: dict[str, Element]) -> list[tuple[Triangles, FloatArray]]:
    """The surfaces of a `<visual>` in its own frame, each with its colours; several of a DAE."""
    import trimesh

    shape, color = shape_of(visual), _color(visual, named)
    if shape.tag != "mesh":
        return [(primitive(shape), GREY if color is None else color)]
    name, found = shape.get("filename", ""), []
    near = mesh_file(name, folder)
    file = near if near.is_file() else mesh_file(name, folder.parent)  # PyBullet searches its data, too
    for mesh in trimesh.load_scene(file).dump():
        surface = moved(
            (np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces)), mesh_scale(shape)
        )
        own = color is None or file.suffix.lower() == ".dae"
        found.append((surface, _own_colors(mesh) if own else np.asarray(color)))
    return found


def _color(visual: Element, named: dict[str, Element]) -> FloatArray | None:
    """(3,) of its material, which may be one of the robot's by name; None where it has none."""
    material = visual.find("material")
    if material is None:
        return None
    rgba = material.find("color")
    if rgba is None and material.get("name", "") in named:
        rgba = named[material.get("name", "")].find("color")
    return None if rgba is None else np.asarray(numbers(rgba, "rgba", 4, "1 1 1 1")[:3] * 255)


def _own_colors(mesh: object) -> FloatArray:
    """(V, 3) of a mesh file; grey where it has none."""
    visual = mesh.visual  # type: ignore[attr-defined]
    if visual.kind == "texture" and visual.uv is None:
        return GREY
    colors = np.asarray(
        (visual.to_color() if visual.kind == "texture" else visual).vertex_colors, dtype=np.float64
    )
    return np.asarray(colors[:, :3]) if colors.ndim == 2 else GREY


def _with_seen_base(pieces: tuple[Piece, ...], links: tuple[Link, ...]) -> Rigged:
    """The object with the first link that hangs on the root as its base, where the root cannot be seen."""
    still = {0}
    still |= {index for index, link in enumerate(links) if link.parent in still and not link.joint.moves}
    if any(piece.link in still for piece in pieces):
        return Rigged(pieces, links)
    child = next(index for index, link in enumerate(links) if link.parent == 0)
    base, held = Link(links[child].name), Link(links[child].name, 0)
    return Rigged(pieces, (base, *links[1:child], held, *links[child + 1 :]))
