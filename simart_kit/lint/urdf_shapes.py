"""URDF shapes: sizes, scales and the files that they name."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from .findings import Finding
from .paths import path_finding
from .urdf_text import values

_SIZES = {
    "box": {"size": 3},
    "sphere": {"radius": 1},
    "cylinder": {"radius": 1, "length": 1},
    "capsule": {"radius": 1, "length": 1},
}
_PARENTS = 3  # folders above a file that a package may be


def shape_findings(robot: Element, folder: Path) -> Iterator[Finding]:
    """Breaches by visuals and collisions, and by the textures of materials, in a file of `folder`."""
    for link in robot.findall("link"):
        name = link.get("name", "")
        for shape in (*link.findall("visual"), *link.findall("collision")):
            geometry = shape.find("geometry")
            if geometry is None or len(geometry) == 0:
                yield Finding("geometry-missing", name, f"a <{shape.tag}> has no shape: add one, or drop it")
                continue
            for element in geometry:
                yield from _size_findings(name, element)
            for mesh in geometry.findall("mesh"):
                yield from _scale_findings(name, mesh)
                yield from _file_findings(name, mesh, folder)
        for texture in link.findall("visual/material/texture"):
            yield from _file_findings(name, texture, folder)
    for material in robot.findall("material"):
        for texture in material.findall("texture"):
            yield from _file_findings(material.get("name", ""), texture, folder)


def _size_findings(link: str, element: Element) -> Iterator[Finding]:
    for attribute, count in _SIZES.get(element.tag, {}).items():
        found = values(element, attribute, count)
        if attribute not in element.attrib:
            yield Finding("size-not-positive", link, f"<{element.tag}> has no {attribute}: add it")
        elif found is not None and (found <= 0).any():
            text = f'<{element.tag} {attribute}="{element.get(attribute)}"> should be above 0'
            yield Finding("size-not-positive", link, text)


def _scale_findings(link: str, mesh: Element) -> Iterator[Finding]:
    scale = values(mesh, "scale", 3)
    if scale is None:
        return
    shown = f'<mesh scale="{mesh.get("scale")}">'
    if (scale < 0).any():
        yield Finding("scale-negative", link, f"{shown} mirrors the mesh: mirror the mesh file itself")
    elif (scale == 0).any():
        yield Finding("size-not-positive", link, f"{shown} should be above 0")


def _file_findings(where: str, element: Element, folder: Path) -> Iterator[Finding]:
    name = element.get("filename", "")
    if not name:
        yield Finding("file-missing", where, f"<{element.tag}> names no file: add filename")
        return
    scheme, _, inner = name.partition("://")
    if inner and scheme in ("package", "model"):
        yield Finding("file-package", where, f"'{name}' needs a ROS package: name the file relatively")
        if not _in_package(inner, folder):
            yield Finding("file-missing", where, f"'{name}' is in no package around the file: add it")
        return
    found = path_finding(name, folder, folder, where)
    if found:
        yield found


def _in_package(inner: str, folder: Path) -> bool:
    """Whether a package that stands around the file, or is one of the folders above it, has a file."""
    package, _, rest = inner.partition("/")
    here = folder.resolve()
    homes = (here, *here.parents[:_PARENTS])
    return any(
        (home / inner).is_file() or (home.name == package and (home / rest).is_file()) for home in homes
    )
