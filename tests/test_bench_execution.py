"""Executability: what loads in MuJoCo, settles and travels, and what is said of the rest."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import mujoco
import pytest
from simart_kit_exporters.mjcf import Mjcf
from simart_kit_exporters.urdf import Urdf

import simart_kit as sk
from simart_kit.asset import Limits
from simart_kit.bench.execution import MOST_JOINTS, execute
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset

INERTIAL = (
    '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
)
AXIS, LIMIT = '<axis xyz="1 0 0"/>', '<limit lower="0" upper="0.5"/>'
PYRAMID = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
Write = Callable[[str, str], Path]


@pytest.fixture(autouse=True)
def _in_own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def urdf(
    drawer: str = "", wall: str = "", kind: str = "prismatic", inertial: str = INERTIAL, extra: str = ""
) -> str:
    """A drawer of half size 0.05 at the origin that slides along x from 0 to 0.5, of others' making."""
    return f"""<robot name="foreign">{extra}
      <link name="base">{wall}</link>
      <link name="drawer">{inertial}{drawer or box("0.1 0.1 0.1", "0 0 0")}</link>
      <joint name="slide" type="{kind}"><parent link="base"/><child link="drawer"/>{AXIS}{LIMIT}</joint>
      </robot>"""


def box(size: str, place: str) -> str:
    return f'<collision><origin xyz="{place}"/><geometry><box size="{size}"/></geometry></collision>'


def mesh(name: str, tag: str = "collision") -> str:
    return f'<{tag}><geometry><mesh filename="{name}"/></geometry></{tag}>'


def mjcf(bodies: str, option: str = "", extra: str = "") -> str:
    return (
        f'<mujoco><compiler angle="radian"/><option {option}/><worldbody>{bodies}</worldbody>{extra}</mujoco>'
    )


def body(joint: str, geom: str = 'size="0.05" mass="1"', children: str = "") -> str:
    return f"<body>{joint}<geom {geom}/>{children}</body>"


WALL = box("0.1 1 1", "0.3 0 0")  # its front is at x = 0.25


def test_a_good_cabinet_executes(tmp_path: Path) -> None:
    found = execute(Mjcf(Mjcf.Options()).export(cabinet_asset(), tmp_path))
    assert found.executable
    assert found.travels == 1.0
    assert found.reason == ""
    assert [(j.name, j.kind) for j in found.joints] == [("door_hinge", "hinge"), ("drawer_slide", "slide")]
    # 5 % of 1.5 rad and of 0.3 m
    assert [j.tolerance for j in found.joints] == pytest.approx([0.075, 0.015])


@pytest.mark.parametrize("kind", ["mjcf", "urdf"])
def test_what_we_convert_executes(converted: Callable[[str], sk.Result], kind: str) -> None:
    result = converted("example")
    found = execute(result.paths[kind])
    assert found.executable, found.reason
    assert {j.name for j in found.joints} == {j.name for j in result.asset.joints if j.moves}
    assert found.joints


@pytest.mark.parametrize("exporter", [Mjcf, Urdf])
def test_chains_and_static_objects_execute(tmp_path: Path, exporter: type[Mjcf] | type[Urdf]) -> None:
    for name, asset, count in (("chain", chain_asset(), 2), ("static", static_asset(), 0)):
        (tmp_path / name).mkdir()
        found = execute(exporter(exporter.Options()).export(asset, tmp_path / name))
        assert found.executable, found.reason
        assert len(found.joints) == count


def test_a_drawer_with_a_wall_before_it_does_not_travel(write: Write) -> None:
    found = execute(write("a.urdf", urdf(wall=WALL)))
    assert found.loads
    assert found.settles
    assert found.travels == 0.0
    assert not found.executable
    assert found.joints[0].reached_lower
    assert not found.joints[0].reached_upper
    stop = re.search(r"joint 'slide' stops at ([\d.]+) on its way to 0\.5", found.reason)
    # Its front starts at 0.05 and the wall's is at 0.25.
    assert stop
    assert float(stop.group(1)) == pytest.approx(0.2, abs=0.005)


def test_without_the_wall_it_travels(write: Write) -> None:
    assert execute(write("a.urdf", urdf())).executable


def test_a_drawer_that_opens_into_the_back_does_not_travel(tmp_path: Path) -> None:
    asset = cabinet_asset()
    wrong = replace(asset.joint("drawer_slide"), axis=(0.0, 1.0, 0.0))
    found = execute(Urdf(Urdf.Options()).export(asset.with_joints({wrong.name: wrong}), tmp_path))
    ends = {j.name: (j.reached_lower, j.reached_upper) for j in found.joints}
    assert ends["drawer_slide"] == (True, False)


def test_a_door_whose_corner_meets_the_side_jams(tmp_path: Path) -> None:
    # The hinge is 5 mm from the side board and in the middle of a door of 20 mm: at 0.52 rad they meet. The
    # URDF has no way to rule out that contact.
    found = execute(Urdf(Urdf.Options()).export(cabinet_asset(), tmp_path))
    door, drawer = found.joints
    assert (door.reached_lower, door.reached_upper) == (False, True)
    assert found.travels == 0.5
    assert drawer.reason == ""
    assert "door_hinge" in found.reason
    shallow = replace(cabinet_asset().joint("door_hinge"), limits=Limits(-0.5, 0.0))
    other = Urdf(Urdf.Options()).export(cabinet_asset().with_joints({"door_hinge": shallow}), _new(tmp_path))
    assert execute(other).executable


def test_of_two_joints_one_blocked_is_half(write: Write) -> None:
    post = '<geom type="box" pos="0.3 0 0" size="0.05 0.5 0.5"/>'
    slide = '<joint name="{}" type="slide" axis="{} 0 0" range="0 0.5"/>'
    bodies = (
        post + body(slide.format("into", 1)) + f'<body pos="0 1 0">{body(slide.format("off", -1))}</body>'
    )
    found = execute(write("a.xml", mjcf(bodies, 'gravity="0 0 0"')))
    assert found.travels == 0.5
    assert "'into'" in found.reason
    assert [not joint.reason for joint in found.joints] == [False, True]


BROKEN = {
    "cut off": (urdf()[:300], "XML"),
    "empty": ("", "empty"),
    "no xml": ("hello", "XML"),
    "mesh missing": (urdf(mesh("meshes/gone.obj")), "no such mesh file: meshes/gone.obj"),
    "mesh of a format it has not": (urdf(mesh("junk.glb")), "junk.glb"),
    "mass zero": (urdf(inertial=INERTIAL.replace('mass value="1"', 'mass value="0"')), "mass"),
    "mass negative": (urdf(inertial=INERTIAL.replace('mass value="1"', 'mass value="-1"')), "mass"),
    "inertia NaN": (urdf(inertial=INERTIAL.replace('ixx="0.1"', 'ixx="nan"')), "inertia"),
    "inertia impossible": (urdf(inertial=INERTIAL.replace('ixx="0.1"', 'ixx="9"')), "inertia"),
    "nothing to weigh": (urdf(drawer=mesh("junk.glb", "visual"), inertial=""), "mass and inertia"),
    "axis NaN": (urdf().replace("1 0 0", "nan 0 0"), "jnt_axis"),
    "limits NaN": (urdf().replace('lower="0"', 'lower="nan"'), "jnt_range"),
    "parent unknown": (urdf().replace('parent link="base"', 'parent link="bass"'), "parent"),
    "MJCF mesh missing": (mjcf("", extra='<asset><mesh name="m" file="gone.obj"/></asset>'), "gone.obj"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_does_not_load_says_why(write: Write, case: str) -> None:
    text, reason = BROKEN[case]
    write("junk.glb", "junk")
    found = execute(write("a.xml", text))
    assert (found.loads, found.settles, found.travels, found.joints) == (False, False, 0.0, ())
    assert reason in found.reason
    assert "\n" not in found.reason
    assert not found.executable


def test_a_missing_file_does_not_load(tmp_path: Path) -> None:
    assert "gone.urdf" in execute(tmp_path / "gone.urdf").reason


@pytest.mark.parametrize(
    "name",
    ["meshes/a/x.obj", "package://cupboard/meshes/a/x.obj", "package://meshes/a/x.obj", r"meshes\a\x.obj"],
)
def test_meshes_are_found_where_others_put_them(write: Write, tmp_path: Path, name: str) -> None:
    write("cupboard/meshes/a/x.obj", PYRAMID)
    write("cupboard/look.glb", "junk")
    extra = '<mujoco><compiler discardvisual="false" strippath="true"/></mujoco><drake:unbound/>'
    text = urdf(mesh("look.glb", "visual") + mesh(name), extra=extra)
    file = write("cupboard/a.urdf", text)
    before = sorted(tmp_path.rglob("*"))
    found = execute(file)
    assert found.executable, found.reason
    assert sorted(tmp_path.rglob("*")) == before
    assert file.read_text() == text


def test_a_folder_that_was_moved_still_loads(tmp_path: Path) -> None:
    (tmp_path / "first").mkdir()
    Urdf(Urdf.Options()).export(chain_asset(), tmp_path / "first")
    shutil.move(tmp_path / "first", tmp_path / "second")
    assert execute(next((tmp_path / "second").glob("*.urdf"))).executable


def test_a_continuous_joint_makes_a_full_turn(write: Write) -> None:
    hinge = '<joint name="spin" type="hinge" axis="0 0 1"/>'
    rod = 'type="box" pos="0.5 0 0" size="0.4 0.02 0.02"'
    assert execute(write("a.xml", mjcf(body(hinge, rod)))).executable
    post = '<geom type="box" pos="-0.5 0 0" size="0.05 0.05 0.05"/>'
    found = execute(write("b.xml", mjcf(post + body(hinge, rod))))
    assert found.settles
    assert found.travels == 0.0
    assert "'spin'" in found.reason


def test_limits_that_mujoco_ignores_are_no_way_to_travel(write: Write) -> None:
    turned = urdf(kind="revolute").replace(LIMIT, '<limit lower="1" upper="0"/>')
    found = execute(write("a.urdf", turned))
    assert found.loads
    assert found.travels == 0.0
    assert "limits are 1 .. 0" in found.reason
    assert "limits are 1 .. 0" in execute(write("a.xml", mjcf(body('<joint range="1 0"/>')))).reason
    endless = execute(write("b.urdf", urdf().replace(LIMIT, "")))
    assert endless.loads
    assert endless.travels == 0.0
    assert "'slide' has no travel" in endless.reason


def test_friction_damping_and_weight_are_overcome(write: Write) -> None:
    lift = '<joint type="slide" axis="0 0 1" range="0 0.5" frictionloss="30" damping="100"/>'
    assert execute(write("a.xml", mjcf(body(lift)))).executable


def test_coupled_joints_follow(write: Write) -> None:
    slide = '<joint name="{}" type="slide" axis="1 0 0" range="0 0.5"/>'
    bodies = body(slide.format("a")) + f'<body pos="0 1 0">{body(slide.format("b"))}</body>'
    equal = '<equality><joint joint1="a" joint2="b"/></equality>'
    assert execute(write("a.xml", mjcf(bodies, extra=equal))).executable


def test_a_lid_that_falls_open_to_its_limit_settles(write: Write) -> None:
    hinge = '<joint type="hinge" axis="0 1 0" range="0 1.2" damping="0.05"/>'
    assert execute(write("a.xml", mjcf(body(hinge, 'pos="0.3 0 0" size="0.05" mass="1"')))).executable


def test_a_floating_base_is_fixed(write: Write) -> None:
    hinge = '<joint name="door" type="hinge" axis="0 0 1" range="0 1"/>'
    door = body(hinge, 'pos="0.3 0 0" size="0.05"')
    key = '<keyframe><key qpos="0 0 0 1 0 0 0 0"/></keyframe>'
    found = execute(write("a.xml", mjcf(body("<freejoint/>", children=door), extra=key)))
    assert found.executable
    assert [joint.name for joint in found.joints] == ["door"]


def test_a_part_may_overlap_its_base_whether_that_floats_or_not(write: Write) -> None:
    # MuJoCo rules contact with a parent out, but not with one that stands still, as a base does here.
    wheel = body('<joint name="spin" type="hinge" axis="0 0 1"/>', 'type="box" size="0.3 0.02 0.02"')
    post = '<geom type="box" pos="0 0.2 0" size="0.05 0.05 0.05"/>'
    floating = f'<body name="base"><freejoint/>{post}{wheel}</body>'
    assert execute(write("a.xml", mjcf(floating))).executable
    assert execute(write("b.xml", mjcf(floating.replace("<freejoint/>", "")))).travels == 0.0


@pytest.mark.parametrize(
    "inside", ['armature="1e4"', 'frictionloss="1e4"', 'stiffness="1e6"', 'damping="1e4"']
)
def test_what_resists_inside_a_joint_neither_blocks_nor_breaks_through(write: Write, inside: str) -> None:
    slide = f'<joint name="j" type="slide" axis="1 0 0" range="0 0.4" {inside}/>'
    assert execute(write("a.xml", mjcf(body(slide)))).travels == 1.0
    wall = '<geom type="box" pos="0.3 0 0" size="0.05 0.5 0.5"/>'
    assert execute(write("b.xml", mjcf(wall + body(slide)))).travels == 0.0


def test_a_range_of_next_to_nothing_is_no_travel(write: Write) -> None:
    found = execute(write("a.xml", mjcf(body('<joint name="j" type="slide" range="0 1e-6"/>'))))
    assert found.travels == 0.0
    assert "'j' has no travel" in found.reason


@pytest.mark.parametrize(
    ("joint", "reason"),
    [
        ('<joint name="j" type="slide" axis="0 0 1"/>', "joint 'j' still moves"),
        ('<joint name="j" type="hinge" axis="0 1 0"/>', "joint 'j' still moves"),
        (
            '<joint name="j" type="slide" axis="0 0 1" range="-1 1" stiffness="-1e9"/>',
            "MuJoCo warns of BADQACC",
        ),
    ],
)
def test_what_falls_swings_or_explodes_does_not_settle(
    write: Write, tmp_path: Path, capfd: pytest.CaptureFixture[str], joint: str, reason: str
) -> None:
    swing = 'pos="0.5 0 0" size="0.05" mass="1"'
    found = execute(write("a.xml", mjcf(body(joint, swing), 'integrator="Euler"')))
    assert found.loads
    assert not found.settles
    assert reason in found.reason
    assert [path.name for path in tmp_path.iterdir()] == ["a.xml"]  # no MUJOCO_LOG.TXT
    assert capfd.readouterr() == ("", "")


def test_shapes_that_overlap_push_a_joint_out_of_its_range(write: Write) -> None:
    slide = '<joint name="j" type="slide" axis="1 0 0" range="-0.05 0.05"/>'
    held = '<geom type="box" pos="-0.3 0 0" size="0.5 0.5 0.5"/>'
    found = execute(write("a.xml", mjcf(held + body(slide, 'type="box" size="0.2 0.2 0.2" density="1"'))))
    assert found.loads
    assert not found.executable
    assert "'j'" in found.reason


def test_the_warning_handler_of_others_is_put_back(write: Write) -> None:
    def mine(text: str) -> None:
        raise AssertionError(text)

    mujoco.set_mju_user_warning(mine)
    try:
        execute(write("a.urdf", urdf()))
        assert mujoco.get_mju_user_warning() is mine
    finally:
        mujoco.set_mju_user_warning(None)


def test_very_many_joints_take_bounded_time(write: Write) -> None:
    hinge = '<body pos="0 {} 0"><joint name="j{}" axis="0 0 1" range="0 1"/><geom size="0.1"/></body>'
    bodies = "".join(hinge.format(i, i) for i in range(MOST_JOINTS + 20))
    found = execute(write("a.xml", mjcf(bodies)), settle_seconds=0.05, travel_seconds=0.05)
    names = [joint.name for joint in found.joints]
    assert len(set(names)) == MOST_JOINTS
    assert names[0] == "j0"
    assert names[-1] == f"j{MOST_JOINTS + 19}"


def _new(folder: Path) -> Path:
    (folder / "other").mkdir()
    return folder / "other"
