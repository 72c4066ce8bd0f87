"""Lint of URDF (https://wiki.ros.org/urdf/XML), read as XML: no loader takes part."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from ..bench.formats.xml_files import read_xml
from ..errors import BadInputError
from .findings import Finding
from .urdf_joints import joint_findings
from .urdf_links import link_findings
from .urdf_shapes import shape_findings
from .urdf_text import number_findings, tag_findings
from .urdf_tree import tree_findings


def lint_urdf(path: Path) -> tuple[Finding, ...]:
    """Findings about a URDF file and the files that it names, in the order of the rules."""
    try:
        robot = read_xml(path, "robot")
    except BadInputError as error:
        return (Finding("unreadable", path.name, f"{error}"),)
    with np.errstate(all="ignore"):  # squares of absurd numbers overflow
        return tuple(_findings(robot, path.parent))


def _findings(robot: Element, folder: Path) -> Iterator[Finding]:
    yield from tree_findings(robot)
    yield from number_findings(robot)
    yield from tag_findings(robot)
    yield from link_findings(robot)
    yield from shape_findings(robot, folder)
    yield from joint_findings(robot)
