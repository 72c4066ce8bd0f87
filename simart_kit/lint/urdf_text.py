"""URDF as text: numbers that are none, elements that nobody reads."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from ..arrays import FloatArray
from .findings import Finding

# How many numbers each attribute holds, by element.
_NUMBERS = {
    "origin": {"xyz": 3, "rpy": 3},
    "mass": {"value": 1},
    "inertia": dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), 1),
    "axis": {"xyz": 3},
    "limit": {"lower": 1, "upper": 1, "effort": 1, "velocity": 1},
    "dynamics": {"damping": 1, "friction": 1},
    "mimic": {"multiplier": 1, "offset": 1},
    "mesh": {"scale": 3},
    "box": {"size": 3},
    "cylinder": {"radius": 1, "length": 1},
    "capsule": {"radius": 1, "length": 1},
    "sphere": {"radius": 1},
    "color": {"rgba": 4},
}
_MAY_BE_INFINITE = ("effort", "velocity")
# Elements of the specification and of simulators that read their own, by parent. Below others all is allowed.
_CHILDREN = {
    "robot": "link joint material transmission gazebo mujoco sensor ros2_control deformable",
    "link": "inertial visual collision contact gazebo sensor self_collision_checking",
    "joint": "origin parent child axis calibration dynamics limit mimic safety_controller hardwareInterface",
    "inertial": "origin mass inertia",
    "visual": "origin geometry material",
    "collision": "origin geometry verbose contact_coefficients",
    "geometry": "box cylinder sphere capsule mesh plane cdf",
    "material": "color texture specular",
}


def values(element: Element | None, attribute: str, count: int = 1) -> FloatArray | None:
    """(count,) numbers of an attribute, NaN and infinity included; None where it has no such."""
    text = None if element is None else element.get(attribute)
    try:
        found = np.array([float(word) for word in (text or "").split()])
    except ValueError:
        return None
    return found if found.shape == (count,) else None


def value(element: Element | None, attribute: str) -> float | None:
    """The number of an attribute, NaN and infinity included; None where it has no such."""
    found = values(element, attribute)
    return None if found is None else float(found[0])


def number_findings(robot: Element) -> Iterator[Finding]:
    """Attributes of links and joints that should be numbers and are not."""
    for owner in robot:
        if owner.tag not in ("link", "joint"):
            continue
        for element in owner.iter():
            for attribute, count in _NUMBERS.get(element.tag, {}).items():
                if attribute in element.attrib and not _holds(element, attribute, count):
                    shown = f'<{element.tag} {attribute}="{element.get(attribute)}">'
                    text = f"{shown} should be {count} finite number(s)"
                    yield Finding("number-invalid", owner.get("name", ""), text)


def _holds(element: Element, attribute: str, count: int) -> bool:
    found = values(element, attribute, count)
    if found is None or np.isnan(found).any():
        return False
    return bool(np.isfinite(found).all()) or attribute in _MAY_BE_INFINITE


def tag_findings(robot: Element) -> Iterator[Finding]:
    """Elements that no reader of URDF knows; those of another XML namespace are somebody's own."""
    for owner in (robot, *robot):
        below = [owner] if owner is robot else list(owner.iter()) if owner.tag in ("link", "joint") else []
        for parent in below:
            known = _CHILDREN.get(parent.tag, "").split()
            for child in parent if known else ():
                if isinstance(child.tag, str) and "{" not in child.tag and child.tag not in known:
                    text = f"<{child.tag}> in <{parent.tag}> is unknown: one of {', '.join(known)}?"
                    yield Finding("tag-unknown", owner.get("name", ""), text)
