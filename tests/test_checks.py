"""Each check passes on sound assets and bites on broken ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from simart_kit.arrays import mat3
from simart_kit.asset import Asset, ConvexMesh, Joint, Limits, MassProperties
from simart_kit.checks import run_checks
from simart_kit.checks.collision import check_collision
from simart_kit.checks.joints import check_joints
from simart_kit.checks.mass import check_mass
from simart_kit.testing.meshes import box, cabinet_asset, chain_asset, static_asset


def with_door_mass(**changes: object) -> Asset:
    asset = cabinet_asset()
    door = asset.part("door")
    assert door.mass is not None
    return asset.with_parts({"door": replace(door, mass=replace(door.mass, **changes))})  # type: ignore[arg-type]


def with_hinge(**changes: object) -> Asset:
    asset = cabinet_asset()
    return asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), **changes)})  # type: ignore[arg-type]


def with_door_shapes(*shapes: ConvexMesh) -> Asset:
    asset = cabinet_asset()
    return asset.with_parts({"door": replace(asset.part("door"), collision=shapes)})


@pytest.mark.parametrize("make", [cabinet_asset, chain_asset, static_asset])
def test_sound_assets_pass_every_check_with_evidence(make: type) -> None:
    results = run_checks(make())
    assert [r.name for r in results] == ["collision", "joints", "mass"]
    for result in results:
        assert result.passed, result.text
        assert result.evidence
        assert "\n" not in result.text


class TestMass:
    @pytest.mark.parametrize(
        ("changes", "told"),
        [
            ({"mass": 0.0}, "not positive"),
            ({"mass": float("nan")}, "not finite"),
            ({"mass": 3000.0}, "density over its hull"),
            ({"mass": 0.002}, "density over its hull"),
            ({"center": (5.0, 0.0, 0.0)}, "centre of mass lies outside"),
            ({"inertia": mat3(np.diag([1.0, 1.0, 3.0]))}, "triangle inequality"),
            ({"inertia": mat3(np.diag([-1.0, 1.0, 1.0]))}, "not positive definite"),
            ({"inertia": mat3(np.diag([1e-9, 1.0, 1.0]))}, "differ by a factor"),
            ({"inertia": ((1.0, 0.5, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))}, "not symmetric"),
        ],
    )
    def test_it_bites(self, changes: dict[str, object], told: str) -> None:
        result = check_mass(with_door_mass(**changes))
        assert not result.passed
        assert told in result.text
        assert "door" in result.text

    def test_a_part_without_mass(self) -> None:
        result = check_mass(cabinet_asset(physics=False))
        assert not result.passed
        assert "body has no mass; door has no mass" in result.text

    def test_parts_of_very_different_mass(self) -> None:
        light = MassProperties(0.0015, (0.0, -0.19, 0.3), mat3(np.eye(3) * 1e-6))
        asset = cabinet_asset()
        asset = asset.with_parts({"door": replace(asset.part("door"), mass=light)})
        result = check_mass(asset)
        assert "times the lightest" in result.text
        assert result.evidence["mass_ratio"] == pytest.approx(26.118 / 0.0015)

    def test_a_fixed_base_may_be_heavy(self) -> None:
        asset = cabinet_asset()
        assert asset.root.mass is not None
        heavy = replace(asset.root.mass, mass=asset.root.mass.mass * 500)
        asset = asset.with_parts({"body": replace(asset.root, mass=heavy)})
        assert "times the lightest" not in check_mass(asset).text
        assert "times the lightest" in check_mass(replace(asset, floating=True)).text


class TestJoints:
    @pytest.mark.parametrize(
        ("changes", "told"),
        [
            ({"limits": Limits(0.0, 0.0)}, "travels 0 rad"),
            ({"limits": Limits(-90.0, 0.0)}, "travels 90 rad"),
            ({"origin": (-2.75, -1.9, 0.0)}, "away from the object"),
            ({"flags": ("sweep: the door hits the body",)}, "the door hits the body"),
        ],
    )
    def test_it_bites(self, changes: dict[str, object], told: str) -> None:
        result = check_joints(with_hinge(**changes))
        assert not result.passed
        assert told in result.text
        assert "door_hinge" in result.text

    @pytest.mark.parametrize("travel", [0.001, 300.0])
    def test_a_drawer_that_hardly_moves_or_leaves_the_room(self, travel: float) -> None:
        asset = cabinet_asset()
        slide = replace(asset.joint("drawer_slide"), limits=Limits(0.0, travel))
        assert "drawer_slide: it travels" in check_joints(asset.with_joints({"drawer_slide": slide})).text

    def test_fixed_joints_do_not_count_as_moving(self) -> None:
        asset = cabinet_asset()
        fixed = Joint("door_hinge", "fixed", "body", "door")
        result = check_joints(asset.with_joints({"door_hinge": fixed}))
        assert result.passed
        assert result.evidence["moving"] == 1


class TestCollision:
    sound = ConvexMesh(*box((-0.275, -0.23, 0.025), (0.275, -0.18, 0.52)))

    def test_the_shape_used_below_is_sound(self) -> None:
        assert check_collision(with_door_shapes(self.sound)).passed

    def test_a_part_without_a_shape(self) -> None:
        assert "door has no collision shape" in check_collision(with_door_shapes()).text

    @pytest.mark.parametrize("damage", ["dent", "inside out", "hole", "flat"])
    def test_a_shape_that_is_not_a_convex_solid(self, damage: str) -> None:
        vertices, faces = self.sound.vertices.copy(), self.sound.faces.copy()
        if damage == "dent":
            vertices = np.concatenate([vertices, [vertices.mean(axis=0) + [0.0, -0.02, 0.0]]])
            a, b, c = faces[4]
            faces = np.concatenate([np.delete(faces, 4, axis=0), [[a, b, 8], [b, c, 8], [c, a, 8]]])
        elif damage == "inside out":
            faces = faces[:, ::-1]
        elif damage == "hole":
            faces = faces[:-1]
        else:
            vertices[:, 1] = -0.2
        result = check_collision(with_door_shapes(ConvexMesh(vertices, faces)))
        assert not result.passed
        assert "door has a shape that is not convex" in result.text

    def test_shapes_somewhere_else_or_too_small(self) -> None:
        away = ConvexMesh(self.sound.vertices + [0.0, 0.0, 0.3], self.sound.faces)
        small = ConvexMesh(*box((-0.05, -0.23, 0.2), (0.05, -0.18, 0.3)))
        for shape in (away, small):
            result = check_collision(with_door_shapes(shape))
            assert not result.passed
            assert "door: its shapes miss its bounds" in result.text
