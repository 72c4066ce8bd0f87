"""Check `agreement`: a file that says otherwise than its asset is told from one that does not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit import Subject
from simart_kit.arrays import Vec3, mat3
from simart_kit.asset import Asset, ConvexMesh, Joint, Limits, MassProperties
from simart_kit.checks.agreement import Agreement
from simart_kit.checks.mechanism import Mechanism, of_asset
from simart_kit.testing.meshes import chain_asset

from .checks_cases import SOUND, cabinet, export, judged, mjcf, subject_in

FORMATS = ("urdf", "mjcf", "usd")


def of_door(change: Callable[[MassProperties], MassProperties]) -> Callable[[Asset], Asset]:
    def edit(asset: Asset) -> Asset:
        door = asset.part("door")
        assert door.mass is not None
        return asset.with_parts({"door": replace(door, mass=change(door.mass))})

    return edit


def of_joint(name: str, **changes: object) -> Callable[[Asset], Asset]:
    return lambda asset: asset.with_joints({name: replace(asset.joint(name), **changes)})  # type: ignore[arg-type]


def one_shape_less(asset: Asset) -> Asset:
    door = asset.part("door")
    return asset.with_parts({"door": replace(door, collision=door.collision[:1])})


def shifted(center: Vec3) -> Vec3:
    return (center[0] + 0.003, center[1], center[2] + 0.004)


EDITS: dict[str, tuple[Callable[[Asset], Asset], str]] = {
    "mass": (of_door(lambda m: replace(m, mass=m.mass * 1.01)), "door: mass 3.33603 instead of 3.303 kg"),
    "center": (
        of_door(lambda m: replace(m, center=shifted(m.center))),
        "door: its centre of mass is 0.005 m away",
    ),
    "inertia": (
        of_door(lambda m: replace(m, inertia=mat3(np.array(m.inertia) * 1.5))),
        "door: its inertia differs by",
    ),
    "limit": (of_joint("door_hinge", limits=Limits(-1.4, 0.0)), "door_hinge goes to -1.4 instead of -1.5"),
    "axis": (of_joint("door_hinge", axis=(0.0, 0.0, -1.0)), "door moves elsewhere: poses differ by"),
    "origin": (of_joint("door_hinge", origin=(0.275, -0.2, 0.0)), "door moves elsewhere: poses differ by"),
    "kind": (
        of_joint("door_hinge", kind="continuous", limits=None),
        "door_hinge is continuous instead of revolute",
    ),
    "parent": (of_joint("drawer_slide", parent="door"), "drawer hangs on door instead of body"),
    "shapes": (one_shape_less, "door: 1 collision shapes instead of 2"),
}


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("edit", EDITS)
def test_each_difference_is_told(edit: str, kind: str, tmp_path: Path) -> None:
    asset, (change, told) = cabinet(), EDITS[edit]
    result = judged("agreement", Subject({kind: export(change(asset), tmp_path, kind)}, asset))
    assert not result.passed
    assert result.text.startswith(f"{kind}: ")
    assert told in result.text
    (difference,) = result.evidence["differences"][kind]
    assert told in difference


def test_the_door_weighs_what_the_sentence_says() -> None:
    """Its boxes: 0.55 x 0.02 x 0.495 and 0.02 x 0.03 x 0.1 m at 600 kg/m^3."""
    door = cabinet().part("door").mass
    assert door is not None
    assert door.mass == pytest.approx(600 * (0.55 * 0.02 * 0.495 + 0.02 * 0.03 * 0.1))


def test_a_text_edited_by_hand(tmp_path: Path) -> None:
    subject = subject_in(tmp_path, cabinet(), "urdf", "mjcf")
    assert judged("agreement", subject).text == "mjcf, urdf as the asset"
    urdf = subject.files["urdf"]
    text = urdf.read_text()
    assert text.count('upper="0.3"') == 1
    urdf.write_text(text.replace('upper="0.3"', 'upper="0.25"'))
    result = judged("agreement", Subject(subject.files, subject.asset))
    assert result.text == "urdf: drawer_slide goes to 0.25 instead of 0.3"
    assert result.evidence["differences"]["mjcf"] == []


def test_without_an_asset_files_are_compared_with_the_first(tmp_path: Path) -> None:
    asset = cabinet()
    files = {"mjcf": export(asset, tmp_path, "mjcf")}
    assert judged("agreement", Subject(files)).text == "nothing to compare with"
    files["urdf"] = export(EDITS["mass"][0](asset), tmp_path, "urdf")
    result = judged("agreement", Subject(files))
    assert "urdf: door: mass" in result.text
    assert result.evidence["reference"] == "mjcf"


def test_another_set_of_bodies(tmp_path: Path) -> None:
    bodies = '<body name="body"><geom type="box" size="1 1 1"/></body>'
    subject = Subject(mjcf(tmp_path, bodies).files, cabinet())
    assert judged("agreement", subject).text == "mjcf: bodies differ: door, drawer"


@pytest.mark.parametrize("kind", [*FORMATS, "asset"])
def test_a_part_that_lies_loose(kind: str, tmp_path: Path) -> None:
    """A format may have no joint for it at all; it is simulated as if it were fixed where it stands."""
    asset = cabinet()
    loose = asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), kind="free", limits=None)})
    subject = subject_in(tmp_path, loose, *([kind] if kind in FORMATS else []))
    assert judged("agreement", subject).passed
    assert judged("travel", subject).text == "1 joints reach both ends"


@pytest.mark.parametrize("options", [{"flavor": "robosuite"}, {"single_file": True}])
def test_flavours_of_mjcf_are_the_same_object(options: dict[str, object], tmp_path: Path) -> None:
    assert judged("agreement", subject_in(tmp_path, cabinet(), "mjcf", **options)).passed


@pytest.mark.parametrize("kind", FORMATS)
def test_what_a_format_writes_as_fixed_is_no_difference(kind: str, tmp_path: Path) -> None:
    """URDF has no ball joint, and a joint without travel is a fixed one."""
    asset = cabinet()
    ball = replace(asset.joint("door_hinge"), kind="ball", limits=None)
    still = replace(asset.joint("drawer_slide"), limits=Limits(0.0, 0.0))
    odd = asset.with_joints({"door_hinge": ball, "drawer_slide": still})
    assert judged("agreement", subject_in(tmp_path, odd, kind)).passed


def test_how_equal_is_a_threshold(tmp_path: Path) -> None:
    asset = cabinet()
    files = {"urdf": export(EDITS["mass"][0](asset), tmp_path, "urdf")}
    assert judged("agreement", Subject(files, asset), difference=0.011).passed
    assert not judged("agreement", Subject(files, asset), difference=0.009).passed


def differences(one: Mechanism, other: Mechanism) -> list[str]:
    return list(Agreement(Agreement.Options())._differences(one, other))


def test_what_is_not_a_number_differs() -> None:
    asset = cabinet()
    one = of_asset(asset)
    for field, told in (("mass", "mass nan"), ("center", "centre of mass"), ("inertia", "inertia")):
        door = one.body["door"].mass
        assert door is not None
        value = float("nan") if field == "mass" else np.full_like(getattr(door, field), np.nan)
        odd = replace(one.body["door"], mass=replace(door, **{field: value}))  # type: ignore[arg-type]
        bodies = tuple(odd if body.name == "door" else body for body in one.bodies)
        assert any(told in text for text in differences(one, Mechanism(bodies, one.links))), field
    hinge = replace(one.links[0], upper=float("nan"))
    assert "goes to nan" in differences(one, Mechanism(one.bodies, (hinge, one.links[1])))[0]


def test_a_part_without_mass_in_one_of_them() -> None:
    bare = of_asset(cabinet().with_parts({"door": replace(cabinet().part("door"), mass=None)}))
    assert differences(of_asset(cabinet()), bare) == ["door: mass is in one only"]


def test_joints_in_another_order_and_by_another_name_are_the_same(tmp_path: Path) -> None:
    one = of_asset(chain_asset())
    renamed = tuple(replace(link, name=f"other_{link.name}") for link in reversed(one.links))
    assert differences(one, Mechanism(one.bodies, renamed)) == []


def test_a_missing_joint() -> None:
    one = of_asset(SOUND["chain"]())
    (text,) = differences(one, Mechanism(one.bodies, one.links[1:]))
    assert text == "arm hangs on nothing instead of post"
    extra = replace(one.links[1], child="base", parent="world", name="swing")
    assert differences(one, Mechanism(one.bodies, (*one.links, extra))) == [
        "base hangs on world instead of nothing"
    ]


def test_a_joint_that_should_not_move() -> None:
    one = of_asset(cabinet())
    still = replace(one.links[0], lower=0.0, upper=0.0)
    fixed = replace(one.links[0], kind="fixed", lower=None, upper=None)
    for link in (still, fixed):
        rigid = Mechanism(one.bodies, (link, one.links[1]))
        assert len(differences(rigid, one)) == 1
        assert differences(rigid, Mechanism(one.bodies, (fixed, one.links[1]))) == []


def test_shapes_may_be_anywhere_but_as_many() -> None:
    """Where shapes stand is for `collision` to judge; here a reader that drops some would be seen."""
    asset = cabinet()
    shapes = tuple(ConvexMesh(s.vertices + 1.0, s.faces) for s in asset.part("door").collision)
    moved = asset.with_parts({"door": replace(asset.part("door"), collision=shapes)})
    assert differences(of_asset(asset), of_asset(moved)) == []
    fixed = Joint("door_hinge", "fixed", "body", "door")
    still = of_asset(asset.with_joints({"door_hinge": fixed}))
    assert differences(of_asset(asset), still) == ["door_hinge is fixed instead of revolute"]
