"""Checks of stated numbers: `mass`, `joints` and `collision` pass sound ones and bite on broken ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from simart_kit import CheckResult, Subject
from simart_kit.arrays import mat3
from simart_kit.asset import Asset, ConvexMesh, Joint, Limits, MassProperties
from simart_kit.testing.meshes import box, cabinet_asset, static_asset

from .checks_cases import judged, mjcf, subject_in


def check(name: str, asset: Asset, **options: Any) -> CheckResult:
    return judged(name, Subject({}, asset), **options)


def with_door_mass(**changes: Any) -> Asset:
    asset = cabinet_asset()
    door = asset.part("door")
    assert door.mass is not None
    return asset.with_parts({"door": replace(door, mass=replace(door.mass, **changes))})


def with_hinge(**changes: Any) -> Asset:
    asset = cabinet_asset()
    return asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), **changes)})


def with_door_shapes(*shapes: ConvexMesh) -> Asset:
    asset = cabinet_asset()
    return asset.with_parts({"door": replace(asset.part("door"), collision=shapes)})


class TestMass:
    @pytest.mark.parametrize(
        ("changes", "told"),
        [
            ({"mass": 0.0}, "not positive"),
            ({"mass": float("nan")}, "not finite"),
            ({"center": (0.0, float("inf"), 0.0)}, "not finite"),
            ({"inertia": mat3(np.diag([1.0, float("nan"), 1.0]))}, "not finite"),
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
        result = check("mass", with_door_mass(**changes))
        assert not result.passed
        assert told in result.text
        assert "door" in result.text

    def test_a_part_without_mass(self) -> None:
        result = check("mass", cabinet_asset(physics=False))
        assert not result.passed
        assert "body has no mass; door has no mass" in result.text

    def test_evidence_is_the_mass_and_its_principal_moments(self) -> None:
        """A box of 0.4 x 0.3 x 0.5 m at 600 kg/m^3: m = 36 kg, m/12 (a^2 + b^2) about each axis."""
        row = check("mass", static_asset()).evidence["parts"]["body"]
        assert row["mass"] == 36.0
        assert row["principal_inertia"] == pytest.approx(
            [3 * (0.16 + 0.09), 3 * (0.09 + 0.25), 3 * (0.16 + 0.25)]
        )

    def test_a_light_part_that_carries_a_heavy_one(self) -> None:
        light = MassProperties(0.0015, (0.0, -0.19, 0.3), mat3(np.eye(3) * 1e-6))
        asset = cabinet_asset()
        asset = asset.with_parts({"door": replace(asset.part("door"), mass=light)})
        assert "times its own mass" not in check("mass", asset).text  # it hangs on the body alone
        hung = replace(asset.joint("drawer_slide"), parent="door")
        result = check("mass", asset.with_joints({"drawer_slide": hung}))
        drawer = asset.part("drawer").mass
        assert drawer is not None
        assert f"door carries {drawer.mass / 0.0015:.0f} times its own mass" in result.text
        assert result.evidence["mass_ratio"] == pytest.approx(drawer.mass / 0.0015)

    def test_a_fixed_base_may_be_as_light_as_it_likes(self) -> None:
        asset = cabinet_asset()
        mass = asset.part("body").mass
        assert mass is not None
        light = replace(asset.part("body"), mass=replace(mass, mass=0.001))
        asset = asset.with_parts({"body": light})
        assert "times its own mass" not in check("mass", asset).text
        assert "body carries" in check("mass", replace(asset, floating=True)).text
        assert "times its own mass" not in check("mass", replace(asset, floating=True), mass_ratio=1e9).text

    def test_files_of_others_are_judged_by_their_shapes(self, tmp_path: Path) -> None:
        """A steel ball stated at the weight of a feather, and one at its own."""
        stated = '<inertial pos="0 0 1" mass="{}" diaginertia="1e-4 1e-4 1e-4"/>'
        ball = '<body name="ball">{}<geom type="sphere" size="0.1" pos="0 0 1"/></body>'
        light = judged("mass", mjcf(tmp_path / "a", ball.format(stated.format(2e-3))))
        assert not light.passed
        assert (
            "ball: density over its hull is 0.5" in light.text
        )  # 2 g in the 4.0 litres between points on it
        assert judged("mass", mjcf(tmp_path / "b", ball.format(stated.format(32.0)))).passed


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
        result = check("joints", with_hinge(**changes))
        assert not result.passed
        assert told in result.text
        assert "door_hinge" in result.text

    @pytest.mark.parametrize("travel", [0.001, 300.0])
    def test_a_drawer_that_hardly_moves_or_leaves_the_room(self, travel: float) -> None:
        asset = cabinet_asset()
        slide = replace(asset.joint("drawer_slide"), limits=Limits(0.0, travel))
        assert "drawer_slide: it travels" in check("joints", asset.with_joints({"drawer_slide": slide})).text

    def test_fixed_joints_do_not_count_as_moving(self) -> None:
        fixed = Joint("door_hinge", "fixed", "body", "door")
        result = check("joints", cabinet_asset().with_joints({"door_hinge": fixed}))
        assert result.passed
        assert result.evidence["moving"] == 1

    def test_evidence_is_the_travel_and_the_distance_from_the_object(self) -> None:
        """The cabinet ends at x = -0.30 and z = 0.8; the axis stands 0.3 m left of it and 0.4 m above."""
        result = check("joints", with_hinge(origin=(-0.6, 0.0, 1.2)))
        row = result.evidence["joints"]["door_hinge"]
        assert row["distance_from_bounds"] == pytest.approx(0.5)
        assert row["travel"] == pytest.approx(1.5)
        assert "0.5 m away" in result.text

    @pytest.mark.parametrize("kind", ["urdf", "mjcf", "usd"])
    def test_files_without_their_asset_are_judged_alike(self, kind: str, tmp_path: Path) -> None:
        asset = with_hinge(limits=Limits(-90.0, 0.0))
        files = subject_in(tmp_path, asset, kind).files
        assert "door_hinge: it travels 90 rad" in judged("joints", Subject(files)).text


class TestCollision:
    sound = ConvexMesh(*box((-0.275, -0.23, 0.025), (0.275, -0.18, 0.52)))

    def test_the_shape_used_below_is_sound(self) -> None:
        assert check("collision", with_door_shapes(self.sound)).passed

    def test_a_part_without_a_shape(self, tmp_path: Path) -> None:
        asset = with_door_shapes()
        assert "door has no collision shape" in check("collision", asset).text
        alone = judged("collision", Subject(subject_in(tmp_path, asset, "urdf").files))
        assert (alone.passed, alone.text) == (False, "no collision shape: door")

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
        result = check("collision", with_door_shapes(ConvexMesh(vertices, faces)))
        assert not result.passed
        assert "door has a shape that is not convex" in result.text

    def test_shapes_somewhere_else_or_too_small(self) -> None:
        away = ConvexMesh(self.sound.vertices + [0.0, 0.0, 0.3], self.sound.faces)
        small = ConvexMesh(*box((-0.05, -0.23, 0.2), (0.05, -0.18, 0.3)))
        moved = check("collision", with_door_shapes(away))
        assert "door: its shapes stand out of its bounds" in moved.text
        assert moved.evidence["parts"]["door"]["stands_out"] == pytest.approx(0.3)
        short = check("collision", with_door_shapes(small))
        assert "door: its shapes miss its bounds by 0.225 m" in short.text  # 0.275 - 0.05 m on both sides
        assert short.evidence["parts"]["door"]["misses"] == pytest.approx(0.225)
        assert not moved.passed
        assert not short.passed
        assert check("collision", with_door_shapes(small), missing=0.5).passed
