"""URDF as truth and prediction: poses worked out by hand, our own exports, and files that are damaged."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from simart_kit_exporters.urdf import Urdf

from simart_kit.asset import Asset
from simart_kit.asset_io import save_asset
from simart_kit.bench.articulation import Articulation, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats.urdf import UrdfPrediction, UrdfTruth, read_urdf
from simart_kit.bench.states import posed
from simart_kit.errors import BadInputError
from simart_kit.kinematics import rest_to_posed, sample_positions
from simart_kit.testing.meshes import cabinet_asset, chain_asset

BOX = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
BASE, LID = f'<link name="base">{BOX}</link>', f'<link name="lid">{BOX}</link>'
# A unit cube between 0 and 1: eight corners, four-sided faces.
CUBE = """# cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def write(path: Path, *elements: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<robot name="thing">{"".join(elements)}</robot>')
    return path


def joint(kind: str, inner: str = "", parent: str = "base", child: str = "lid") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="j_{child}" type="{kind}">{ends}{inner}</joint>'


def read(path: Path) -> Articulation:
    return UrdfTruth().read(path).articulation


def lid_joint(tmp_path: Path, kind: str, inner: str = "") -> LinkJoint:
    return read(write(tmp_path / "a.urdf", BASE, LID, joint(kind, inner))).links[1].joint


def link_bounds(found: Articulation, link: int) -> np.ndarray:
    corners = found.triangles[found.labels == link].reshape(-1, 3)
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def test_joints_and_shapes_go_through_the_chain_of_frames(tmp_path: Path) -> None:
    quarter = math.pi / 2
    found = read(
        write(
            tmp_path / "a.urdf",
            BASE,
            '<link name="arm"/>',
            '<link name="tip"><visual><origin xyz="0 0 1"/><geometry><box size="0.2 0.4 0.6"/></geometry>'
            f"</visual>{BOX}</link>",
            # The arm's frame: its x is the world's y, its y the world's -x.
            joint(
                "fixed", f'<origin xyz="1 0 0" rpy="0 0 {quarter}"/><axis xyz="1 0 0"/>', child="arm"
            ).replace("fixed", "revolute"),
            joint(
                "prismatic",
                f'<origin xyz="0 2 0" rpy="{quarter} 0 0"/><axis xyz="0 0 3"/>'
                '<limit lower="-0.1" upper="0.4"/>',
                "arm",
                "tip",
            ),
            '<link name="knob"/>',
            joint("fixed", "", "arm", "knob"),
        )
    )
    assert [link.name for link in found.links] == ["base", "arm", "tip", "knob"]
    assert [link.parent for link in found.links] == [-1, 0, 1, 1]
    arm, tip = found.links[1].joint, found.links[2].joint
    assert (arm.kind, arm.lower, arm.upper) == ("revolute", None, None)
    np.testing.assert_allclose([arm.axis, arm.origin], [(0, 1, 0), (1, 0, 0)], atol=1e-12)
    # The tip's z is the arm's -y, which is the world's x; it stands at (1, 0, 0) - 2 (1, 0, 0).
    assert (tip.kind, tip.lower, tip.upper, tip.name) == ("prismatic", -0.1, 0.4, "j_tip")
    np.testing.assert_allclose([tip.axis, tip.origin], [(1, 0, 0), (-1, 0, 0)], atol=1e-12)
    # Its first box is moved 1 along the world's x to the origin; its x, y, z lie along the world's y, z, x.
    first = found.triangles[found.labels == 2][:12].reshape(-1, 3)
    np.testing.assert_allclose(first.max(axis=0), (0.3, 0.1, 0.2), atol=1e-12)
    assert np.bincount(found.labels).tolist() == [12, 0, 24]


def test_rpy_turns_about_fixed_axes(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    for index, (angles, axis) in enumerate(rng.normal(size=(5, 2, 3))):
        text = " ".join(map(str, angles)), " ".join(map(str, axis))
        path = write(
            tmp_path / f"{index}.urdf",
            BASE,
            LID,
            joint("continuous", f'<origin rpy="{text[0]}"/><axis xyz="{text[1]}"/>'),
        )
        expected = Rotation.from_euler("xyz", angles).apply(axis / np.linalg.norm(axis))
        np.testing.assert_allclose(read(path).links[1].joint.axis, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("kind", "inner", "expected"),
    [
        ("revolute", '<limit effort="1" velocity="1"/>', ("revolute", None, None)),
        ("revolute", '<limit upper="1.5"/>', ("revolute", 0.0, 1.5)),
        ("revolute", '<limit lower="1" upper="-1"/>', ("revolute", 1.0, -1.0)),
        ("continuous", '<limit lower="-1" upper="1"/>', ("continuous", None, None)),
        ("prismatic", '<limit lower="0" upper="0.4"/>', ("prismatic", 0.0, 0.4)),
        ("floating", "", ("free", None, None)),
        ("spherical", "", ("ball", None, None)),
        ("planar", '<axis xyz="0 0 0"/>', ("unknown", None, None)),
        ("fixed", '<axis xyz="0 0 0"/>', ("fixed", None, None)),
    ],
)
def test_kinds_and_limits(
    kind: str, inner: str, expected: tuple[str, float | None, float | None], tmp_path: Path
) -> None:
    found = lid_joint(tmp_path, kind, inner)
    assert (found.kind, found.lower, found.upper) == expected


@pytest.mark.parametrize("world", ['<link name="world"/>', f'<link name="world">{BOX}</link>'])
def test_a_base_that_floats_against_an_empty_world_is_the_base(world: str, tmp_path: Path) -> None:
    float_ = '<joint name="float" type="floating"><parent link="world"/><child link="base"/></joint>'
    path = write(tmp_path / "a.urdf", world, float_, BASE, LID, joint("continuous"))
    kinds = {link.name: link.joint.kind for link in read(path).links}
    assert kinds == {"world": "fixed", "base": "free" if BOX in world else "fixed", "lid": "continuous"}


def test_the_default_axis_is_x(tmp_path: Path) -> None:
    assert lid_joint(tmp_path, "continuous").axis == (1.0, 0.0, 0.0)


def test_what_is_odd_is_noted(tmp_path: Path) -> None:
    links = [f'<link name="l{i}">{BOX}</link>' for i in range(4)]
    path = write(
        tmp_path / "a.urdf",
        BASE,
        *links,
        joint("planar", child="l0"),
        joint("continuous", '<mimic joint="j_l0"/>', child="l1"),
        joint("prismatic", child="l2"),
        joint("revolute", '<limit lower="0" upper="0"/>', child="l3"),
    )
    notes = UrdfTruth().read(path).notes
    words = ("planar", "mimics", "has no limits", "0 to 0: no travel")
    assert [word in note for word, note in zip(words, notes, strict=True)] == [True] * 4


def test_a_mesh_is_scaled_and_a_mirrored_one_stays_outside_out(tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "cube.obj").write_text(CUBE)
    shape = '<geometry><mesh filename="{}" scale="0.5 2 -1"/></geometry><origin xyz="0 0 3" rpy="0 0 0"/>'
    for index, name in enumerate(("../meshes/cube.obj", "package://thing/meshes/cube.obj")):
        link = f'<link name="base"><visual>{shape.format(name)}</visual></link>'
        found = read(write(tmp_path / str(index) / "a.urdf", link))
        np.testing.assert_allclose(found.bounds, [(0, 0, 2), (0.5, 2, 3)])
        # Signed volume by the divergence theorem: 0.5 x 2 x 1, positive only where faces look outward.
        assert np.linalg.det(found.triangles).sum() / 6 == pytest.approx(1.0)
        (tmp_path / "package.xml").write_text("<package/>")


def test_a_package_is_a_folder_around_the_file(tmp_path: Path) -> None:
    (tmp_path / "my_robot" / "meshes").mkdir(parents=True)
    (tmp_path / "my_robot" / "meshes" / "cube.obj").write_text(CUBE)
    link = (
        '<link name="b"><visual><geometry><mesh filename="package://my_robot/meshes/cube.obj"/>'
        "</geometry></visual></link>"
    )
    assert len(read(write(tmp_path / "my_robot" / "urdf" / "a.urdf", link)).faces) == 12


def test_primitives_have_their_sizes_and_collision_stands_in_for_a_missing_visual(tmp_path: Path) -> None:
    shapes = {
        '<cylinder radius="0.5" length="3"/>': (0.5, 0.5, 1.5),
        '<sphere radius="2"/>': (2, 2, 2),
        '<capsule radius="0.5" length="3"/>': (0.5, 0.5, 2.0),
    }
    for index, (shape, half) in enumerate(shapes.items()):
        link = f'<link name="b"><collision><geometry>{shape}</geometry></collision></link>'
        found = read(write(tmp_path / f"{index}.urdf", link))
        np.testing.assert_allclose(found.bounds, [-np.array(half), half], rtol=0.02)
    flat = '<link name="b"><visual><geometry><box size="2 0 4"/></geometry></visual></link>'
    np.testing.assert_allclose(read(write(tmp_path / "flat.urdf", flat)).bounds, [(-1, 0, -2), (1, 0, 2)])
    both = f'<link name="b">{BOX}<collision><geometry><sphere radius="9"/></geometry></collision></link>'
    assert read(write(tmp_path / "both.urdf", both)).bounds.max() == 0.5


def test_an_empty_link_between_two_joints_is_folded_into_what_it_carries(tmp_path: Path) -> None:
    path = write(
        tmp_path / "bottle.urdf",
        '<link name="helper"/>',
        LID,
        BASE,
        joint("continuous", '<axis xyz="0 1 0"/>', "helper", "lid"),
        joint("prismatic", '<axis xyz="0 0 1"/><limit lower="0" upper="0.2"/>', "base", "helper"),
    )
    truth = UrdfTruth().read(path)
    lid, base = truth.articulation.links
    assert (lid.name, lid.parent, base.name, base.parent) == ("lid", 1, "base", -1)
    assert (lid.joint.kind, lid.joint.upper, lid.joint.axis) == ("prismatic", 0.2, (0, 0, 1))
    assert [(j.kind, j.axis) for j in lid.also] == [("continuous", (0, 1, 0))]
    assert np.bincount(truth.articulation.labels).tolist() == [12, 12]
    assert truth.notes[-1].endswith("helper")


@pytest.mark.parametrize("build", [cabinet_asset, chain_asset])
def test_our_own_export_reads_back_as_the_asset(tmp_path: Path, build: object) -> None:
    asset: Asset = build()  # type: ignore[operator]
    found, _ = read_urdf(Urdf(Urdf.Options()).export(asset, tmp_path), "x")
    assert [link.name for link in found.links] == [part.name for part in asset.parts]
    positions = sample_positions(asset, np.random.default_rng(2))
    by_child = {j.child: positions.get(j.name, 0.0) for j in asset.joints}
    poses = posed(found, [by_child.get(link.name, 0.0) for link in found.links])
    for index, (link, pose) in enumerate(zip(found.links, poses, strict=True)):
        np.testing.assert_allclose(pose, rest_to_posed(asset, positions)[link.name], atol=1e-6)
        corners = asset.mesh.triangles[asset.face_part == index].reshape(-1, 3)
        np.testing.assert_allclose(
            link_bounds(found, index), [corners.min(axis=0), corners.max(axis=0)], atol=1e-6
        )
        expected = asset.joint_to(link.name)
        if expected is not None:
            limits = (expected.limits.lower, expected.limits.upper) if expected.limits else (None, None)
            assert (link.joint.kind, link.joint.name) == (expected.kind, expected.name)
            assert (link.joint.lower, link.joint.upper) == limits


@pytest.mark.parametrize(
    ("elements", "words"),
    [
        ((BASE, LID, joint("revolve")), "type 'revolve' is not one of revolute, continuous"),
        ((BASE, LID, joint("continuous", '<axis xyz="0 0 0"/>')), "a direction needs a length"),
        ((BASE, LID, joint("continuous", '<axis xyz="0 nan 0"/>')), "0 nan 0"),
        ((BASE, LID, joint("continuous", '<axis xyz="0 1"/>')), "3 finite number"),
        ((BASE, LID, joint("revolute", '<limit lower="nan" upper="1"/>')), 'lower="nan"'),
        ((BASE, LID, joint("fixed", '<origin xyz="a b c"/>')), "a b c"),
        ((BASE, LID, joint("fixed", parent="door")), "parent link 'door' does not exist"),
        ((BASE, LID, joint("fixed", child="door")), "child link 'door' does not exist"),
        ((BASE, LID, joint("fixed"), joint("fixed")), "two parents"),
        ((BASE, LID, joint("fixed"), joint("fixed", "", "lid", "base")), "loop"),
        ((BASE, LID, joint("fixed", "", "lid", "lid")), "loop"),
        ((BASE, BASE), "two links are named 'base'"),
        ((f"<link>{BOX}</link>",), "has no name"),
        (('<link name="a"/>',), "no link has a shape"),
        ((), "has no <link>"),
        (('<link name="a"><visual/></link>',), "link 'a': a <visual> needs"),
        ((BASE.replace('"1 1 1"', '"1 -1 1"'),), "not be below 0"),
        ((BASE.replace("<box size", '<mesh filename="gone.obj" s'),), "no such mesh file"),
        ((BASE.replace("<box size", '<mesh filename="/etc/passwd" s'),), "no mesh file: known are glb"),
        ((BASE.replace("<box size", '<mesh filename="http://a/b.obj" s'),), "not followed"),
    ],
)
def test_a_damaged_file_is_named_with_what_is_wrong(
    elements: tuple[str, ...], words: str, tmp_path: Path
) -> None:
    with pytest.raises(BadInputError) as caught:
        read(write(tmp_path / "bad.urdf", *elements))
    assert words in str(caught.value)
    assert "bad.urdf" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<robot><link", "no well-formed XML"),
        ("", "no well-formed XML"),
        ("<sdf/>", "its root is not <robot>"),
        ('<!DOCTYPE r [<!ENTITY a "aaaa">]><robot><link name="&a;"/></robot>', "DOCTYPE"),
        ('<!DOCTYPE r SYSTEM "file:///etc/passwd"><robot/>', "DOCTYPE"),
    ],
)
def test_xml_that_is_broken_or_has_a_doctype_is_refused(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "bad.urdf").write_text(text)
    with pytest.raises(BadInputError, match=words):
        read(tmp_path / "bad.urdf")
    with pytest.raises(BadInputError, match="missing"):
        read(tmp_path / "none.urdf")


def test_there_is_one_variant(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no variant 'remeshed'"):
        UrdfTruth().read(write(tmp_path / "a.urdf", BASE), "remeshed")


def test_truths_are_found_by_folder_or_by_file(tmp_path: Path) -> None:
    expected = {
        "fridge": write(tmp_path / "fridge" / "robot.urdf", BASE),
        "oven": write(tmp_path / "kitchen" / "oven" / "urdf" / "model.urdf", BASE),
        "left": write(tmp_path / "pair" / "left.urdf", BASE),
        "right": write(tmp_path / "pair" / "right.urdf", BASE),
        "lamp": write(tmp_path / "lamp" / "lamp.urdf", BASE),
        "a_x_1": write(tmp_path / "a" / "x" / "1.urdf", BASE),
        "b_x_1": write(tmp_path / "b" / "x" / "1.urdf", BASE),
    }
    write(tmp_path / "lamp" / "lamp_simple.urdf", BASE)
    write(tmp_path / ".trash" / "old.urdf", BASE)
    write(tmp_path / "47648" / "mobility.urdf", BASE)
    (tmp_path / "47648" / "mobility_v2.json").write_text("[]")
    assert UrdfTruth().find(tmp_path) == expected
    assert UrdfTruth().find(expected["fridge"]) == {"fridge": expected["fridge"]}
    assert UrdfTruth().find(tmp_path / "pair") == {k: expected[k] for k in ("left", "right")}
    assert UrdfTruth().read(expected["left"]).name == "left"
    assert UrdfTruth().read(expected["oven"]).name == "oven"


def test_an_export_is_found_by_the_name_of_its_output_folder(tmp_path: Path) -> None:
    out = tmp_path / "washer"
    save_asset(cabinet_asset(), out)
    (out / "urdf").mkdir()
    path = Urdf(Urdf.Options()).export(cabinet_asset(), out / "urdf")
    assert UrdfTruth().find(tmp_path) == {"washer": path}
    assert UrdfTruth().read(path).name == "washer"


def test_predictions_are_found_as_systems_write_them(tmp_path: Path) -> None:
    expected = {
        "plain": write(tmp_path / "plain.urdf", BASE),
        "anything": write(tmp_path / "anything" / "basic.urdf", BASE),
        "particulate": write(tmp_path / "particulate" / "urdf_2026" / "model.urdf", BASE),
        "13": write(tmp_path / "label13.urdf", BASE),
        "own[1]": write(tmp_path / "own[1]" / "own[1].urdf", BASE),
    }
    write(tmp_path / "own[1]" / "mobility.urdf", BASE)
    write(tmp_path / "anything" / "another.urdf", BASE)
    for name in ("one", "two"):
        write(tmp_path / "unclear" / f"{name}.urdf", BASE)
    assert {name: UrdfPrediction().find(tmp_path, name) for name in expected} == expected
    assert UrdfPrediction().find(tmp_path, "missing") is None
    with pytest.raises(BadInputError, match=r"one.urdf, two.urdf: name the one to score unclear.urdf"):
        UrdfPrediction().find(tmp_path, "unclear")


def test_a_prediction_can_be_loaded_in_a_simulator(tmp_path: Path) -> None:
    path = write(tmp_path / "thing.urdf", BASE, LID, joint("continuous"))
    truth = Truth("thing", read(path))
    prediction = UrdfPrediction().read(path, truth)
    assert prediction.simulator_file == path
    assert prediction.articulation.name == "thing"
    assert len(prediction.articulation.moving) == 1
    assert "root link" in prediction.notes[-1]
