"""Numbers and files of XML, as URDF writes them."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element


def numbers(*values: float, digits: int = 12) -> str:
    """Numbers with a space between; -0 is written as 0."""
    return " ".join(f"{value + 0.0:.{digits}g}" for value in values)


def write_xml(root: Element, path: Path) -> Path:
    """Write an element with all that is in it, indented; returns the path."""
    ElementTree.indent(root)
    path.write_bytes(ElementTree.tostring(root, "utf-8", xml_declaration=True) + b"\n")
    return path
