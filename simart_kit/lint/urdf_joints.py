"""URDF joints: type, axis, limits, dynamics and mimicry."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi
from xml.etree.ElementTree import Element

import numpy as np

from .findings import Finding
from .numbers import limit_findings, sign_findings
from .urdf_text import value, values

_TYPES = (
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
)  # last: PyBullet's
_WITH_AXIS = ("revolute", "continuous", "prismatic", "planar")


def joint_findings(robot: Element) -> Iterator[Finding]:
    """Breaches by the joints, each by itself."""
    names = {joint.get("name", "") for joint in robot.findall("joint")}
    for joint in robot.findall("joint"):
        name, kind = joint.get("name", ""), joint.get("type", "")
        if kind not in _TYPES:
            yield Finding("joint-type", name, f"type '{kind}' is not one of {', '.join(_TYPES)}")
            continue
        if kind in _WITH_AXIS:
            yield from _axis_findings(name, joint.find("axis"))
        if kind in ("revolute", "prismatic"):
            yield from _limit_findings(name, kind, joint.find("limit"))
        elif kind == "continuous":
            yield from _unused_findings(name, joint.find("limit"))
        yield from _sign_findings(name, joint)
        yield from _mimic_findings(name, joint.find("mimic"), names)


def _axis_findings(name: str, axis: Element | None) -> Iterator[Finding]:
    if axis is None:
        yield Finding("axis-missing", name, "it has no <axis>, which then is x: write it")
        return
    direction = values(axis, "xyz", 3)
    length = 1.0 if direction is None else float(np.linalg.norm(direction))
    if length == 0:
        yield Finding("axis-zero", name, "its axis is 0 0 0: give it a direction")
    elif abs(length - 1) > 1e-3:
        yield Finding("axis-not-unit", name, f"its axis is {length:g} long: divide it by that")


def _limit_findings(name: str, kind: str, limit: Element | None) -> Iterator[Finding]:
    if limit is None or not {"lower", "upper"} & set(limit.attrib):
        yield Finding("limit-missing", name, "it has no limits: add <limit lower upper effort velocity>")
        return
    lacking = [name for name in ("effort", "velocity") if name not in limit.attrib]
    if lacking:
        yield Finding("effort-missing", name, f"its <limit> has no {' and no '.join(lacking)}: add it")
    # One that is left out is 0, as the specification has it.
    lower = value(limit, "lower") if "lower" in limit.attrib else 0.0
    upper = value(limit, "upper") if "upper" in limit.attrib else 0.0
    if lower is None or upper is None:
        return
    yield from limit_findings(name, lower, upper)
    if kind == "revolute" and 4 * pi < max(abs(lower), abs(upper)) < inf:
        yield Finding("limits-large", name, f"limits {lower:g} to {upper:g} are in radians: convert degrees")


def _unused_findings(name: str, limit: Element | None) -> Iterator[Finding]:
    if limit is not None and {"lower", "upper"} & set(limit.attrib):
        yield Finding("limit-unused", name, "a continuous joint has no lower and upper: make it revolute")


def _sign_findings(name: str, joint: Element) -> Iterator[Finding]:
    wanted = {"limit": ("effort", "velocity"), "dynamics": ("damping", "friction")}
    found = {key: value(joint.find(tag), key) for tag, keys in wanted.items() for key in keys}
    yield from sign_findings("damping-negative", name, {k: v for k, v in found.items() if v is not None})


def _mimic_findings(name: str, mimic: Element | None, names: set[str]) -> Iterator[Finding]:
    if mimic is None:
        return
    target = mimic.get("joint", "")
    if target == name or target not in names:
        yield Finding("mimic-target", name, f"it mimics '{target}': name another joint that exists")
    else:
        yield Finding(
            "mimic", name, f"it mimics '{target}', which several simulators ignore: couple them there"
        )
