"""Shapes of a URDF link: mesh files and primitives at their places."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from ...arrays import FloatArray
from ...errors import BadInputError
from .mesh_files import Triangles, joined, moved, read_triangles
from .primitives import box, capsule, cylinder, ellipsoid
from .urdf_tree import origin
from .xml_files import numbers

_SHAPES = ("mesh", "box", "cylinder", "sphere", "capsule")


def link_surface(link: Element, folder: Path) -> Triangles | None:
    """The visual shapes of a link as one surface in its frame; its collision shapes where it has no visual.

    Args:
        link: a `<link>` element.
        folder: of the URDF file. Mesh files may lie anywhere, as in `../meshes`, but must be mesh files.

    Returns:
        None where it has no shape at all.

    Raises:
        BadInputError: a shape that is unknown or incomplete, or a mesh file that is missing or damaged.
    """
    shapes = link.findall("visual") or link.findall("collision")
    try:
        pieces = [moved(_surface(shape, folder), origin(shape)) for shape in shapes]
    except BadInputError as error:
        raise BadInputError(f"link '{link.get('name')}': {error}") from error
    return joined(pieces) if pieces else None


def shape_of(element: Element) -> Element:
    """The one shape of a `<visual>` or `<collision>`; raises BadInputError when there is none, or several."""
    geometry = element.find("geometry")
    found = [] if geometry is None else [child for child in geometry if child.tag in _SHAPES]
    if len(found) != 1:
        raise BadInputError(f"a <{element.tag}> needs a <geometry> with one of {', '.join(_SHAPES)}")
    return found[0]


def primitive(shape: Element) -> Triangles:
    """The surface of a shape without a mesh file; raises BadInputError for sizes that are none."""
    if shape.tag == "box":
        return box(_sizes(shape, "size", 3))
    radius = _sizes(shape, "radius", 1)[0]
    if shape.tag == "sphere":
        return ellipsoid((radius, radius, radius))
    return (cylinder if shape.tag == "cylinder" else capsule)(radius, _sizes(shape, "length", 1)[0])


def mesh_scale(mesh: Element) -> FloatArray:
    """(4, 4) scaling of a `<mesh>`, by one number or three; raises BadInputError for anything else."""
    words = mesh.get("scale", "1 1 1").split()
    scale = numbers(mesh, "scale", len(words) if len(words) in (1, 3) else 3, "1 1 1")
    return np.diag([*(scale * np.ones(3)), 1.0])


def _surface(element: Element, folder: Path) -> Triangles:
    shape = shape_of(element)
    if shape.tag != "mesh":
        return primitive(shape)
    return moved(read_triangles(mesh_file(shape.get("filename", ""), folder)), mesh_scale(shape))


def _sizes(shape: Element, attribute: str, count: int) -> tuple[float, ...]:
    sizes = numbers(shape, attribute, count, "")
    if (sizes < 0).any():
        raise BadInputError(f'<{shape.tag} {attribute}="{shape.get(attribute)}"> should not be below 0')
    return tuple(float(size) for size in sizes)


def mesh_file(name: str, folder: Path) -> Path:
    """The file that a mesh's `filename` means.

    A package is a folder of its name in or around the URDF's folder, else one around it with a package.xml,
    else the URDF's folder itself.
    """
    scheme, path = _split(name)
    if scheme == "file":
        return Path(path)
    if not scheme:
        return folder / path
    if scheme not in ("package", "model"):
        raise BadInputError(f"mesh '{name}': '{scheme}:' is not followed: download it and name the file")
    package, _, rest = path.partition("/")
    places = [outer / package / rest for outer in (folder, *folder.resolve().parents)]
    places += [outer / rest for outer in folder.resolve().parents if (outer / "package.xml").is_file()]
    return next((place for place in places if place.is_file()), folder / rest)


def _split(name: str) -> tuple[str, str]:
    found = re.fullmatch(r"(\w+)://(.*)", name)
    return (found[1], found[2]) if found else ("", name)
