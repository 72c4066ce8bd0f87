"""URDF links: mass, inertia, and whether they collide."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from ..arrays import FloatArray
from .findings import Finding
from .numbers import inertia_findings, mass_findings, restitution_findings, sign_findings
from .urdf_text import value
from .urdf_tree import end

_CONTACT_SIGNS = ("lateral_friction", "rolling_friction", "spinning_friction", "stiffness", "damping")


def link_findings(robot: Element) -> Iterator[Finding]:
    """Breaches by what links weigh and where they collide."""
    links = robot.findall("link")
    moved = {end(joint, "child") for joint in robot.findall("joint") if joint.get("type") != "fixed"}
    for link in links:
        name = link.get("name", "")
        shaped = link.find("visual") is not None or link.find("collision") is not None
        if shaped or name in moved:  # frames without shape, fixed to something, weigh nothing
            yield from _inertial_findings(name, link.find("inertial"))
        yield from _contact_findings(name, link)
    yield from _collider_findings(links)


def _inertial_findings(name: str, inertial: Element | None) -> Iterator[Finding]:
    mass = None if inertial is None else inertial.find("mass")
    inertia = None if inertial is None else inertial.find("inertia")
    if mass is None or inertia is None:
        lacking = "<inertial>" if inertial is None else "<mass>" if mass is None else "<inertia>"
        yield Finding("mass-missing", name, f"it has no {lacking}: state mass and inertia")
        return
    kilograms, tensor = value(mass, "value"), _tensor(inertia)
    if kilograms is not None:
        yield from mass_findings(name, kilograms)
    if tensor is not None:
        yield from inertia_findings(name, np.asarray(np.linalg.eigvalsh(tensor), dtype=np.float64))


def _tensor(inertia: Element) -> FloatArray | None:
    """(3, 3) of an `<inertia>`; None where a number is none."""
    found = [value(inertia, name) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")]
    # An entry that is left out is 0, as in the loaders; one that is no number is told of elsewhere.
    xx, xy, xz, yy, yz, zz = (0.0 if entry is None else entry for entry in found)
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return tensor if np.isfinite(tensor).all() else None


def _contact_findings(name: str, link: Element) -> Iterator[Finding]:
    """PyBullet's friction and restitution."""
    for contact in link.findall("contact"):
        found = {tag: value(contact.find(tag), "value") for tag in (*_CONTACT_SIGNS, "restitution")}
        known = {tag: number for tag, number in found.items() if number is not None}
        restitution = known.pop("restitution", None)
        yield from sign_findings("friction-negative", name, known)
        if restitution is not None:
            yield from restitution_findings(name, restitution)


def _collider_findings(links: list[Element]) -> Iterator[Finding]:
    bare = [link.get("name", "") for link in links if link.find("collision") is None]
    if len(bare) == len(links) > 0:
        yield Finding("collider-missing", "", "no link has a <collision>: add shapes")
        return
    drawn = [link.get("name", "") for link in links if link.find("visual") is not None]
    for name in bare:
        if name in drawn:
            yield Finding("body-collider-missing", name, "it has a <visual> and no <collision>: add a shape")
