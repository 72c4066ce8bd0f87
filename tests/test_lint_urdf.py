"""Lint of URDF tells of each seeded defect by exactly its rule, and of nothing in good files."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from xml.etree.ElementTree import Element

import pytest
from simart_kit_exporters.urdf import Urdf

from simart_kit.lint import lint

from .export_cases import CASES
from .lint_cases import (
    assert_told,
    export,
    first,
    good_asset,
    rules_of,
    seeded_xml,
    set_at,
    unset_at,
    with_text,
    without,
)

Seed = Callable[[Element], None]
DOOR, HINGE, SLIDE = "link[@name='door']", "joint[@type='revolute']", "joint[@type='prismatic']"
LIMIT, MASS, INERTIA = f"{HINGE}/limit", f"{DOOR}/inertial/mass", f"{DOOR}/inertial/inertia"
MESH = f"{DOOR}/visual/geometry/mesh"


def two(one: Seed, other: Seed) -> Seed:
    def seed(root: Element) -> None:
        one(root)
        other(root)

    return seed


def spinning(root: Element) -> None:
    """A continuous joint that keeps its limits."""
    set_at(HINGE, type="continuous")(root)


def in_place(text: str) -> Seed:
    """Another shape as the first collision of the door."""

    def seed(root: Element) -> None:
        first(root, f"{DOOR}/collision/geometry").clear()
        with_text(f"{DOOR}/collision/geometry", text)(root)

    return seed


def principal(xx: str, yy: str, zz: str) -> Seed:
    return set_at(INERTIA, ixx=xx, iyy=yy, izz=zz, ixy="0", ixz="0", iyz="0")


def emptied(root: Element) -> None:
    for child in list(root):
        root.remove(child)


def orphan(root: Element) -> None:
    with_text(".", '<link name="knob"/>')(root)


DEFECTS: dict[str, tuple[str, Seed]] = {
    # What loaders see, each some of it.
    "no_limit": ("limit-missing", without(HINGE, "limit")),
    "no_range": ("limit-missing", unset_at(LIMIT, "lower", "upper")),
    "no_effort": ("effort-missing", unset_at(LIMIT, "effort")),
    "no_velocity": ("effort-missing", unset_at(LIMIT, "velocity")),
    "limits_reversed": ("limits-reversed", set_at(LIMIT, lower="1", upper="-1")),
    "limit_nan": ("number-invalid", set_at(LIMIT, lower="nan")),
    "limit_infinite": ("number-invalid", set_at(LIMIT, upper="inf")),
    "axis_zero": ("axis-zero", set_at(f"{HINGE}/axis", xyz="0 0 0")),
    "axis_nan": ("number-invalid", set_at(f"{HINGE}/axis", xyz="0 nan 1")),
    "mass_zero": ("mass-not-positive", set_at(MASS, value="0")),
    "mass_negative": ("mass-not-positive", set_at(MASS, value="-2")),
    "mass_nan": ("number-invalid", set_at(MASS, value="NaN")),
    "inertia_zero": ("inertia-not-positive", principal("0", "0", "0")),
    "inertia_negative": ("inertia-not-positive", principal("1", "1", "-1")),
    "inertia_not_definite": ("inertia-not-positive", set_at(INERTIA, ixx="1", iyy="1", ixy="2")),
    "inertia_triangle": ("inertia-triangle", principal("0.1", "0.1", "0.3")),
    "mesh_missing": ("file-missing", set_at(MESH, filename="meshes/none.obj")),
    "mesh_unnamed": ("file-missing", set_at(MESH, filename="")),
    "mesh_absolute": ("file-absolute", set_at(MESH, filename="/home/me/door.obj")),
    "mesh_url": ("file-absolute", set_at(MESH, filename="file:///home/me/door.obj")),
    "mesh_on_windows": ("file-absolute", set_at(MESH, filename="C:\\me\\door.obj")),
    "mesh_escaping": ("file-escapes", set_at(MESH, filename="../outside.obj")),
    "texture_missing": (
        "file-missing",
        with_text(f"{DOOR}/visual", '<material name="m"><texture filename="none.png"/></material>'),
    ),
    "duplicate_link": ("name-duplicate", lambda root: root.append(deepcopy(first(root, DOOR)))),
    "duplicate_joint": ("name-duplicate", set_at(SLIDE, name="door_hinge")),
    "nameless_link": ("name-missing", two(set_at(DOOR, name=""), set_at(f"{HINGE}/child", link=""))),
    "bad_type": ("joint-type", set_at(HINGE, type="hinge")),
    "bad_parent": ("joint-target-missing", set_at(f"{HINGE}/parent", link="nothing")),
    "bad_child": ("joint-target-missing", set_at(f"{HINGE}/child", link="nothing")),
    "no_parent": ("joint-target-missing", without(HINGE, "parent")),
    "parent_is_child": ("joint-self", set_at(f"{HINGE}/parent", link="door")),
    "two_parents": (
        "joint-loop",
        with_text(".", '<joint name="j" type="fixed"><parent link="drawer"/><child link="door"/></joint>'),
    ),
    "ring": (
        "joint-loop",
        with_text(".", '<joint name="j" type="fixed"><parent link="door"/><child link="body"/></joint>'),
    ),
    "orphan": ("link-orphan", orphan),
    "no_links": ("body-missing", emptied),
    # What no loader tells of.
    "axis_not_unit": ("axis-not-unit", set_at(f"{HINGE}/axis", xyz="0 0 2")),
    "no_axis": ("axis-missing", without(HINGE, "axis")),
    "no_inertial": ("mass-missing", without(DOOR, "inertial")),
    "no_mass": ("mass-missing", without(f"{DOOR}/inertial", "mass")),
    "scale_negative": ("scale-negative", set_at(MESH, scale="1 -1 1")),
    "unknown_tag": ("tag-unknown", with_text(DOOR, "<intertial/>")),
    "unknown_tag_of_a_joint": ("tag-unknown", with_text(HINGE, "<limits/>")),
    # What else is wrong with files of others.
    "scale_zero": ("size-not-positive", set_at(MESH, scale="0 0 0")),
    "box_of_no_size": ("size-not-positive", in_place('<box size="0.1 0 0.1"/>')),
    "cylinder_without_length": ("size-not-positive", in_place('<cylinder radius="0.1"/>')),
    "number_is_text": ("number-invalid", set_at(MASS, value="heavy")),
    "too_few_numbers": ("number-invalid", set_at(f"{HINGE}/origin", xyz="0 1")),
    "no_shape": ("geometry-missing", without(f"{DOOR}/visual", "geometry")),
    "no_collision": ("collider-missing", without("link", "collision")),
    "no_collision_of_the_door": ("body-collider-missing", without(DOOR, "collision")),
    "package": ("file-package", set_at(MESH, filename="package://urdf/cabinet.urdf")),
    "limits_empty": ("limits-empty", set_at(LIMIT, lower="0", upper="0")),
    "limits_without_rest": ("limits-rest", set_at(LIMIT, lower="0.5", upper="1")),
    "limits_in_degrees": ("limits-large", set_at(LIMIT, lower="-90", upper="0")),
    "limits_of_a_wheel": ("limit-unused", spinning),
    "damping_negative": ("damping-negative", set_at(f"{HINGE}/dynamics", damping="-1")),
    "effort_negative": ("damping-negative", set_at(LIMIT, effort="-1")),
    "friction_negative": ("friction-negative", set_at(f"{DOOR}/contact/lateral_friction", value="-1")),
    "restitution_of_2": ("restitution-range", set_at(f"{DOOR}/contact/restitution", value="2")),
    "mimic": ("mimic", with_text(HINGE, '<mimic joint="drawer_slide"/>')),
    "mimic_of_nothing": ("mimic-target", with_text(HINGE, '<mimic joint="nothing"/>')),
    "mimic_of_itself": ("mimic-target", with_text(HINGE, '<mimic joint="door_hinge"/>')),
}
GOOD: dict[str, Seed] = {
    "box": in_place('<box size="0.1 0.2 0.1"/>'),
    "cylinder": in_place('<cylinder radius="0.1" length="0.2"/>'),
    "sphere": in_place('<sphere radius="0.1"/>'),
    "frame": two(
        orphan,
        with_text(".", '<joint name="j" type="fixed"><parent link="door"/><child link="knob"/></joint>'),
    ),
    "effort_infinite": set_at(LIMIT, effort="inf"),
    "transmission": with_text(".", '<transmission name="t"><joint name="door_hinge"/></transmission>'),
    "drake": with_text(HINGE, '<drake:rotor_inertia xmlns:drake="http://drake.mit.edu" value="1"/>'),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lint")
    (folder / "outside.obj").write_bytes(b"")
    return export(Urdf, good_asset(), folder / "urdf")


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_is_told_by_its_rule(name: str, good: Path) -> None:
    rule, defect = DEFECTS[name]
    assert_told(lint(seeded_xml(good, name, defect)), rule)


def test_every_rule_on_urdf_has_a_defect() -> None:
    assert {rule for rule, _ in DEFECTS.values()} | {"unreadable"} == rules_of("urdf")


@pytest.mark.parametrize("name", GOOD)
def test_what_is_allowed_has_no_findings(name: str, good: Path) -> None:
    assert lint(seeded_xml(good, name, GOOD[name])) == ()


@pytest.mark.parametrize("case", ["textured", "chain", "static", "two_tone"])
def test_good_assets_have_no_findings(case: str, tmp_path: Path) -> None:
    assert lint(export(Urdf, CASES[case](), tmp_path / "urdf")) == ()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<robot><link name='a'>",
        "<sdf/>",
        "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name='&a;'><link name='a'/></robot>",
    ],
)
def test_damaged_file_is_a_finding(text: str, write: Callable[[str, str], Path]) -> None:
    (found,) = lint(write("damaged.urdf", text))
    assert (found.rule, found.severity, found.where) == ("unreadable", "error", "damaged.urdf")


def test_mass_of_a_joint_that_moves_is_asked_for_without_shapes(good: Path) -> None:
    def bare(root: Element) -> None:
        for tag in ("visual", "collision", "inertial"):
            without(DOOR, tag)(root)

    (found,) = lint(seeded_xml(good, "bare", bare))
    assert (found.rule, found.where) == ("mass-missing", "door")
