"""The GLB exporter's draft of rigid bodies: bodies, convex colliders, and frames with limits."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from simart_kit.testing.meshes import cabinet_asset, chain_asset

from .export_cases import overlapping_asset
from .glb_reader import Glb, rotation
from .test_glb import export, in_scene
from .usd_cases import many_kinds_asset

NAME = "KHR_physics_rigid_bodies"


def test_only_on_request_and_never_required(tmp_path: Path) -> None:
    plain = Glb.read(export(cabinet_asset(), tmp_path / "plain")).json
    physical = Glb.read(export(cabinet_asset(), tmp_path / "physical", physics=True)).json
    assert "extensionsUsed" not in plain
    assert physical["extensionsUsed"] == [NAME]
    assert "extensionsRequired" not in physical


def test_bodies_have_their_mass_center_and_inertia(tmp_path: Path) -> None:
    asset = chain_asset()
    glb = Glb.read(export(asset, tmp_path, physics=True))
    assert "extensions" not in glb.json["nodes"][glb.node("base")]  # it stands still
    turn = in_scene(np.eye(4))[:3, :3]
    assert np.array_equal(turn, np.eye(3))
    poses = glb.poses()
    for name in ("post", "arm"):
        motion = glb.json["nodes"][glb.node(name)]["extensions"][NAME]["motion"]
        mass = asset.part(name).mass
        assert mass is not None
        assert motion["mass"] == mass.mass
        x, y, z = mass.center
        assert poses[name][:3, 3] + motion["centerOfMass"] == pytest.approx([x, z, -y], abs=1e-6)
        axes = rotation(np.array(motion["inertiaOrientation"]))
        inertia = axes @ np.diag(motion["inertiaDiagonal"]) @ axes.T
        old = np.array(mass.inertia)[np.ix_([0, 2, 1], [0, 2, 1])] * np.outer([1, 1, -1], [1, 1, -1])
        np.testing.assert_allclose(inertia, old, atol=1e-12)


def test_every_collision_shape_is_a_convex_collider_of_its_part(tmp_path: Path) -> None:
    asset = cabinet_asset()
    glb = Glb.read(export(asset, tmp_path, physics=True))
    poses = glb.poses()
    for part in asset.parts:
        children = [glb.json["nodes"][i] for i in glb.json["nodes"][glb.node(part.name)]["children"]]
        found = [c["extensions"][NAME]["collider"] for c in children if "_collision_" in c["name"]]
        assert len(found) == len(part.collision)
        for collider, shape in zip(found, part.collision, strict=True):
            assert collider["geometry"]["convexHull"] is True
            (primitive,) = glb.json["meshes"][collider["geometry"]["mesh"]]["primitives"]
            points = glb.array(primitive["attributes"]["POSITION"]) + poses[part.name][:3, 3]
            assert points == pytest.approx(shape.vertices[:, [0, 2, 1]] * [1, 1, -1], abs=1e-6)
    drawn = {node["mesh"] for node in glb.json["nodes"] if "mesh" in node}
    assert len(drawn) == len(asset.parts)  # shapes are not drawn


def test_frames_of_a_joint_coincide_at_rest_with_x_along_its_axis(tmp_path: Path) -> None:
    asset = many_kinds_asset()
    glb = Glb.read(export(asset, tmp_path, physics=True))
    poses = glb.poses()
    for joint in asset.joints:
        frame = glb.json["nodes"][glb.node(f"{joint.name}_frame")]["extensions"][NAME]["joint"]
        assert frame["connectedNode"] == glb.node(f"{joint.name}_moved")
        one, two = poses[f"{joint.name}_frame"], poses[f"{joint.name}_moved"]
        np.testing.assert_allclose(one, two, atol=1e-6)
        x, y, z = joint.origin
        assert one[:3, 3] == pytest.approx([x, z, -y], abs=1e-6)
        if joint.kind in ("prismatic", "revolute"):
            x, y, z = joint.axis
            assert one[:3, 0] == pytest.approx([x, z, -y], abs=1e-6)


def test_limits_hold_all_directions_but_that_of_the_joint(tmp_path: Path) -> None:
    asset = many_kinds_asset()
    glb = Glb.read(export(asset, tmp_path, physics=True))
    described = glb.json["extensions"][NAME]["physicsJoints"]
    found = {}
    for joint in asset.joints:
        index = glb.json["nodes"][glb.node(f"{joint.name}_frame")]["extensions"][NAME]["joint"]["joint"]
        found[joint.name] = described[index]

    def ranges(name: str) -> dict[str, tuple[float, float]]:
        return {
            f"{key[0]}{axis}": (limit["min"], limit["max"])
            for limit in found[name]["limits"]
            for key in ("linearAxes", "angularAxes")
            for axis in limit.get(key, ())
        }

    held = (0.0, 0.0)
    place, turn = {"l0": held, "l1": held, "l2": held}, {"a0": held, "a1": held, "a2": held}
    assert ranges("weld") == place | turn
    assert ranges("slide") == place | turn | {"l0": (-0.2, 0.4)}
    assert ranges("wrist") == place | turn | {"a0": (-1.0, 2.0)}
    assert ranges("shoulder") == place
    assert found["slide"]["drives"][0]["damping"] == 3.0
    assert found["slide"]["drives"][0]["type"] == "linear"


def test_parts_that_overlap_do_not_collide(tmp_path: Path) -> None:
    glb = Glb.read(export(overlapping_asset(), tmp_path, physics=True))
    filters = glb.json["extensions"][NAME]["collisionFilters"]
    assert {f["collisionSystems"][0]: f["notCollideWithSystems"] for f in filters} == {
        "door": ["drawer"],
        "drawer": ["door"],
    }
