"""Lint of MJCF tells of each seeded defect by exactly its rule, and of nothing in good files."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from xml.etree.ElementTree import Element

import pytest
from simart_kit_exporters.mjcf import Mjcf

from simart_kit.lint import lint
from simart_kit.testing.meshes import chain_asset

from .lint_cases import (
    assert_told,
    export,
    good_asset,
    rules,
    rules_of,
    seeded_xml,
    set_at,
    with_text,
    without,
)

Seed = Callable[[Element], None]
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
# A solid box 0.4 x 0.4 x 0.6 of 12 kg: 12 / 12 * (.16 + .36) = 0.52 and 12 / 12 * .32 = 0.32.
# A door 0.02 x 0.4 x 0.6 of 3 kg: 3 / 12 * .52 = 0.13, 3 / 12 * .3604 = 0.0901, 3 / 12 * .1604 = 0.0401.
MODEL = """<mujoco model="box">
  <compiler angle="radian" meshdir="assets"/>
  <default><default class="hinge"><joint damping="0.05" armature="0.001" range="-1.5 0"/></default></default>
  <asset><mesh name="knob" file="knob.obj" scale="0.03 0.03 0.03"/></asset>
  <worldbody>
    <body name="box">
      <inertial pos="0 0 0.3" mass="12" diaginertia="0.52 0.52 0.32"/>
      <geom name="solid" type="box" size="0.2 0.2 0.3" pos="0 0 0.3"/>
      <body name="door" pos="0.22 -0.2 0.3">
        <inertial pos="0 0.2 0" mass="3" fullinertia="0.13 0.0901 0.0401 0 0 0"/>
        <joint name="hinge" class="hinge" axis="0 0 1"/>
        <geom name="panel" type="box" size="0.01 0.2 0.3" pos="0 0.2 0"/>
        <geom name="knob" type="mesh" mesh="knob" pos="0.01 0.3 0" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
DOOR, HINGE, PANEL = ".//body[@name='door']", ".//joint[@name='hinge']", ".//geom[@name='panel']"
INERTIAL, MESH = f"{DOOR}/inertial", "asset/mesh"


def shapeless(root: Element) -> None:
    for geom in root.iter("geom"):
        geom.attrib.update(contype="0", conaffinity="0")


def principal(moments: str) -> Seed:
    def seed(root: Element) -> None:
        inertial = root.find(INERTIAL)
        assert inertial is not None
        del inertial.attrib["fullinertia"]
        inertial.set("diaginertia", moments)

    return seed


def paired(root: Element) -> None:
    """The door collides by a pair alone."""
    set_at(PANEL, contype="0", conaffinity="0")(root)
    with_text(".", '<contact><pair geom1="solid" geom2="panel"/></contact>')(root)


def stripped(root: Element) -> None:
    set_at("compiler", strippath="true")(root)
    set_at(MESH, file="elsewhere/knob.obj")(root)


DEFECTS: dict[str, tuple[str, Seed]] = {
    "range_reversed": ("limits-reversed", set_at(HINGE, range="1 -1")),
    "range_reversed_in_a_class": ("limits-reversed", set_at("default/default/joint", range="1 -1")),
    "range_without_rest": ("limits-rest", set_at(HINGE, range="0.5 1")),
    "range_not_in_force": ("limit-unused", set_at(HINGE, limited="false")),
    "range_without_autolimits": ("mujoco-refuses", set_at("compiler", autolimits="false")),
    "range_empty": ("mujoco-refuses", set_at(HINGE, range="0 0", limited="true")),
    "damping_negative": ("damping-negative", set_at(HINGE, damping="-1")),
    "friction_negative": ("friction-negative", set_at(PANEL, friction="-1 0 0")),
    "no_inertial": ("mass-guessed", without(DOOR, "inertial")),
    "inertial_overruled": ("mass-guessed", set_at("compiler", inertiafromgeom="true")),
    "mass_zero": ("mass-not-positive", set_at(INERTIAL, mass="0")),
    "mass_negative": ("mass-not-positive", set_at(INERTIAL, mass="-1")),
    "mass_nan": ("number-invalid", set_at(INERTIAL, mass="nan")),
    "inertia_negative": ("inertia-not-positive", principal("0.1 0.1 -0.1")),
    "inertia_not_definite": ("inertia-not-positive", set_at(INERTIAL, fullinertia="1 1 1 2 0 0")),
    "inertia_triangle": ("inertia-triangle", principal("0.1 0.1 0.3")),
    "inertia_in_centimetres": ("inertia-implausible", principal("1300 901 401")),
    "inertia_in_tonnes": ("inertia-implausible", principal("1.3e-7 9e-8 4.1e-8")),
    "center_elsewhere": ("com-outside", set_at(INERTIAL, pos="0 0 2")),
    "no_collider": ("collider-missing", shapeless),
    "no_collider_of_the_door": ("body-collider-missing", set_at(PANEL, contype="0", conaffinity="0")),
    "no_bodies": ("body-missing", without("worldbody", "body")),
    "mesh_missing": ("file-missing", set_at(MESH, file="none.obj")),
    "mesh_absolute": ("file-absolute", set_at(MESH, file="/home/me/knob.obj")),
    "mesh_escaping": ("file-escapes", set_at(MESH, file="../../outside.obj")),
    "folder_absolute": ("file-absolute", set_at("compiler", meshdir="/home/me")),
    "include_missing": ("file-missing", with_text(".", '<include file="none.xml"/>')),
    "include_escaping": ("file-escapes", with_text(".", '<include file="../outside.xml"/>')),
    "unknown_attribute": ("mujoco-refuses", set_at(HINGE, color="red")),
    "axis_zero": ("mujoco-refuses", set_at(HINGE, axis="0 0 0")),
    "one_name_twice": ("mujoco-refuses", set_at(DOOR, name="box")),
}
GOOD: dict[str, Seed] = {
    "endless_hinge": set_at(HINGE, range="0 0"),
    "rest_at_reference": set_at(HINGE, range="0.5 1", ref="0.7"),
    "pair": paired,
    "folder_stripped": stripped,
    "region": with_text(
        ".//body[@name='box']",
        '<body><geom size="1" mass="0" contype="0" conaffinity="0" rgba="0 1 0 0"/></body>',
    ),
    "cylinder": set_at(PANEL, type="cylinder", size="0.2 0.01"),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lint") / "mjcf"
    (folder / "assets").mkdir(parents=True)
    for name in ("outside.obj", "outside.xml"):
        (folder.parent / name).write_text("<mujoco/>")
    (folder / "assets" / "knob.obj").write_text(TETRAHEDRON)
    (folder / "box.xml").write_text(MODEL)
    return folder / "box.xml"


def test_good_model_has_no_findings(good: Path) -> None:
    assert lint(good) == ()


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_is_told_by_its_rule(name: str, good: Path) -> None:
    rule, defect = DEFECTS[name]
    assert_told(lint(seeded_xml(good, name, defect)), rule)


def test_every_rule_on_mjcf_has_a_defect() -> None:
    assert {rule for rule, _ in DEFECTS.values()} | {"unreadable"} == rules_of("mjcf")


@pytest.mark.parametrize("name", GOOD)
def test_what_is_allowed_has_no_findings(name: str, good: Path) -> None:
    assert lint(seeded_xml(good, name, GOOD[name])) == ()


@pytest.mark.parametrize("make", [good_asset, chain_asset])
def test_good_assets_have_no_findings(make: Callable[[], object], tmp_path: Path) -> None:
    assert lint(export(Mjcf, make(), tmp_path / "mjcf")) == ()


def test_included_files_are_looked_at_too(good: Path) -> None:
    part = '<mujoco><asset><mesh name="more" file="none.obj"/></asset></mujoco>'
    good.with_name("part.xml").write_text(part)
    found = lint(seeded_xml(good, "including", with_text(".", '<include file="part.xml"/>')))
    assert [(finding.rule, finding.where) for finding in found] == [("file-missing", "more")]


def test_archive_is_linted_as_its_folder(good: Path, tmp_path: Path) -> None:
    folder = tmp_path / "box"
    shutil.copytree(good.parent / "assets", folder / "assets")
    for name, defect in (("whole", None), ("broken", DEFECTS["mass_zero"][1])):
        source = seeded_xml(good, name, defect) if defect else good
        shutil.copy(source, folder / "box.xml")
        archive = Path(shutil.make_archive(str(tmp_path / name), "zip", folder)).rename(
            tmp_path / f"{name}.mjz"
        )
        assert rules(lint(archive)) == (set() if defect is None else {"mass-not-positive"})


@pytest.mark.parametrize("name", ["damaged.xml", "damaged.mjz"])
def test_damaged_file_is_a_finding(name: str, write: Callable[[str, str], Path]) -> None:
    assert rules(lint(write(name, "<mujoco><worldbody>"))) == {"unreadable"}


def test_doctype_is_refused(write: Callable[[str, str], Path]) -> None:
    (found,) = lint(write("bomb.xml", "<!DOCTYPE mujoco [<!ENTITY a 'b'>]><mujoco model='&a;'/>"))
    assert found.rule == "unreadable"
    assert "DOCTYPE" in found.text


def test_archive_with_damaged_contents_is_a_finding(good: Path, tmp_path: Path) -> None:
    archive = Path(shutil.make_archive(str(tmp_path / "box"), "zip", good.parent, "assets"))
    content = archive.read_bytes()
    middle = content.index(b"knob.obj") + 12
    (tmp_path / "box.mjz").write_bytes(content[:middle] + b"\xff" * 8 + content[middle + 8 :])
    assert rules(lint(tmp_path / "box.mjz")) == {"unreadable"}


def test_xml_of_a_robot_is_taken_as_urdf(write: Callable[[str, str], Path]) -> None:
    assert rules(lint(write("robot.xml", "<robot name='a'/>"))) == {"body-missing"}
