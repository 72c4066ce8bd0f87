"""The modifiers `scale`, `mass` and `collision`."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from pydantic import ValidationError
from simart_kit_plugins.modifiers import collision, dynamics, mass, scale
from simart_kit_plugins.modifiers.collision import Collision
from simart_kit_plugins.modifiers.mass import Mass
from simart_kit_plugins.modifiers.scale import Scale, scaled

import simart_kit as sk
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.checks.collision import Collision as CollisionCheck
from simart_kit.checks.joints import Joints
from simart_kit.checks.mass import Mass as MassCheck
from simart_kit.checks.subject import Subject
from simart_kit.hulls import volume
from simart_kit.kinematics import forward, opened
from simart_kit.materials import MATERIALS
from simart_kit.physics import as_stated
from simart_kit.testing.meshes import box, boxes_mesh, cabinet_asset, chain_asset, static_asset


def rescaled(asset: sk.Asset, **options: float) -> sk.Asset:
    return Scale(Scale.Options(**options)).modify(asset)


def single(lower: tuple[float, float, float], upper: tuple[float, float, float]) -> sk.Asset:
    return sk.Asset("thing", boxes_mesh([(lower, upper)]), np.zeros(12, dtype=int), (sk.Part("body"),))


@pytest.mark.parametrize("module", [scale, mass, dynamics, collision])
def test_each_module_registers_its_modifier(module: object) -> None:
    found: list[type] = []
    module.register_modifiers(found.append)  # type: ignore[attr-defined]
    assert [stage.name for stage in found] == [module.__name__.rpartition(".")[2]]  # type: ignore[attr-defined]


class TestScale:
    def test_plausible_metres_are_trusted_and_nothing_changes(self) -> None:
        before = cabinet_asset()
        after = rescaled(before)
        assert after.mesh is before.mesh
        assert after.joints == before.joints
        assert after.scale.factor == 1.0
        assert "1.09 m" in after.scale.reason
        assert [n.level for n in after.notes] == ["info"]

    @pytest.mark.parametrize(
        ("unit", "factor"), [(1000.0, 0.001), (100.0, 0.01), (1e-3, 1000.0), (1e-2, 100.0)]
    )
    def test_unit_slips_are_undone_and_told(self, unit: float, factor: float) -> None:
        after = rescaled(scaled(cabinet_asset(), unit))
        assert after.scale.factor == factor
        assert after.mesh.diagonal == pytest.approx(cabinet_asset().mesh.diagonal)
        assert [n.level for n in after.notes] == ["warning"]
        assert after.notes[0].text == after.scale.reason

    def test_inches_are_tried_when_nothing_metric_fits(self) -> None:
        after = rescaled(scaled(cabinet_asset(), 1 / 0.0254), smallest=0.9, largest=1.2)
        assert after.scale.factor == 0.0254

    def test_a_size_that_no_unit_explains_becomes_one_metre(self) -> None:
        after = rescaled(scaled(cabinet_asset(), 1e6))
        assert after.mesh.diagonal == pytest.approx(1.0)
        assert after.notes[0].level == "warning"

    def test_primitives_and_stated_masses_stay_what_they_are(self) -> None:
        body = Collision(Collision.Options(mode="box")).modify(Mass().modify(single((0, 0, 0), (1, 2, 3))))
        part = replace(body.parts[0], stated_mass=4.5, mass=as_stated(body.parts[0].mass, 4.5))
        after = scaled(replace(body, parts=(part,)), 2.0).parts[0]
        (before,), (shape,) = part.collision, after.collision
        assert shape.primitive.kind == before.primitive.kind == "box"
        np.testing.assert_allclose(shape.primitive.size, 2 * np.array(before.primitive.size))
        np.testing.assert_allclose(
            shape.primitive.asset_T_shape[:3, 3], 2 * before.primitive.asset_T_shape[:3, 3]
        )
        assert after.mass.mass == 4.5
        np.testing.assert_allclose(after.mass.inertia, 4 * np.array(part.mass.inertia))

    def test_height(self) -> None:
        after = rescaled(cabinet_asset(), height=1.6)
        np.testing.assert_allclose(after.mesh.bounds[:, 2], [0.0, 1.6], atol=1e-12)
        assert after.scale.factor == pytest.approx(2.0)
        assert "1.6 m as asked" in after.scale.reason

    @pytest.mark.parametrize("options", [{"factor": 100.0}, {"height": 80.0}, {"height": 0.008}])
    def test_what_is_asked_for_is_obeyed_even_if_implausible_and_told(
        self, options: dict[str, float]
    ) -> None:
        after = rescaled(cabinet_asset(), **options)
        height = options.get("height", 80.0)
        assert after.mesh.bounds[1, 2] == pytest.approx(height)
        assert [n.level for n in after.notes] == ["warning"]
        assert "is unusual (0.02 to 8 m): is it meant?" in after.notes[0].text

    @pytest.mark.parametrize(
        "options", [{"factor": 1e3}, {"height": 1e9}, {"factor": 1e-4}, {"height": 1e-9}]
    )
    def test_what_nothing_can_be_done_with_is_refused(self, options: dict[str, float]) -> None:
        with pytest.raises(sk.BadInputError, match=r"simulators take 0.001 to 1000 m: check scale's height"):
            rescaled(cabinet_asset(), **options)

    def test_factors_of_two_steps_multiply(self) -> None:
        assert rescaled(rescaled(cabinet_asset(), factor=2.0), factor=3.0).scale.factor == pytest.approx(6.0)

    @pytest.mark.parametrize(
        "options",
        [
            {"height": 1.0, "factor": 2.0},
            {"height": 0.0},
            {"factor": -1.0},
            {"height": float("inf")},
            {"smallest": 9.0},
        ],
    )
    def test_senseless_options_are_refused(self, options: dict[str, float]) -> None:
        with pytest.raises(ValidationError):
            Scale.Options(**options)

    def test_the_refusal_says_what_to_do(self) -> None:
        with pytest.raises(ValidationError, match="give one, not both"):
            Scale.Options(height=1.0, factor=2.0)

    def test_height_of_something_flat_on_the_ground(self) -> None:
        flat = sk.Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]), np.array([[0, 1, 2]]))
        asset = sk.Asset("sheet", flat, np.zeros(1, dtype=int), (sk.Part("body"),))
        with pytest.raises(sk.BadInputError, match="factor"):
            rescaled(asset, height=1.0)

    def test_everything_is_scaled_alike(self) -> None:
        before = replace(cabinet_asset(), asset_from_source=np.diag([0.5, 0.5, 0.5, 1.0]))
        after = scaled(before, 2.0)
        np.testing.assert_allclose(after.mesh.vertices, before.mesh.vertices * 2)
        np.testing.assert_allclose(after.asset_from_source, np.eye(4))
        assert after.joint("door_hinge").limits == before.joint("door_hinge").limits
        assert after.joint("drawer_slide").limits == sk.Limits(0.0, 0.6)
        for old, new in zip(before.parts, after.parts, strict=True):
            assert volume(new.collision[0]) == pytest.approx(8 * volume(old.collision[0]))
        poses = [forward(a, opened(a, 0.7)) for a in (before, after)]
        for name in poses[0]:
            np.testing.assert_allclose(poses[1][name][:3, 3], 2 * poses[0][name][:3, 3], atol=1e-12)

    def test_mass_scales_as_if_it_were_weighed_again(self) -> None:
        after = scaled(cabinet_asset(), 0.5)
        again = Mass(Mass.Options(hollow=False)).modify(after)  # as the cabinet's own numbers are
        for old, new in zip(after.parts, again.parts, strict=True):
            assert old.mass is not None
            assert new.mass is not None
            assert old.mass.mass == pytest.approx(new.mass.mass)
            np.testing.assert_allclose(old.mass.center, new.mass.center, atol=1e-9)
            np.testing.assert_allclose(old.mass.inertia, new.mass.inertia, rtol=1e-6, atol=1e-9)


class TestMass:
    def test_the_material_decides(self) -> None:
        glass = sk.Material("glass", 2500.0)
        asset = single((0, 0, 0), (0.1, 0.1, 0.01)).with_parts({"body": sk.Part("body", material=glass)})
        part = Mass().modify(asset).part("body")
        assert part.mass is not None
        assert part.mass.mass == pytest.approx(0.25)

    def test_options(self) -> None:
        weighed = Mass(Mass.Options(density=100.0, hollow=False)).modify(cabinet_asset(physics=False))
        assert weighed.part("drawer").mass.mass == pytest.approx(26.118 / 6)  # type: ignore[union-attr]
        for wrong in ({"density": 0.0}, {"thickness": -1.0}, {"thickness": 2.0}):
            with pytest.raises(ValidationError):
                Mass.Options(**wrong)

    def test_how_each_part_was_weighed_is_told_once(self) -> None:
        (note,) = Mass().modify(single_with_hinge()).notes
        assert note.level == "info"
        # 0.58 m2 of 16 mm walls at 600 kg/m3: 10 cm thick things are not of solid wood
        assert "body 5.57 kg (hollow shell with walls of 16 mm)" in note.text
        assert "lid 2.4 kg (closed mesh)" in note.text

    def test_open_and_tiny_parts_are_doubtful(self) -> None:
        asset = cabinet_asset(physics=False)
        vertices, faces = box((0.0, 0.0, 0.0), (1e-4, 1e-4, 1e-4))
        mesh = sk.Mesh(
            np.concatenate([asset.mesh.vertices, vertices]),
            np.concatenate([asset.mesh.faces[1:], faces + len(asset.mesh.vertices)]),
        )
        screw = sk.Joint("screw_mount", "fixed", "body", "screw")
        asset = sk.Asset(
            "cabinet",
            mesh,
            np.concatenate([asset.face_part[1:], np.full(12, 3)]),
            (*asset.parts, sk.Part("screw")),
            (*asset.joints, screw),
        )
        texts = [n.text for n in Mass().modify(asset).notes if n.level == "warning"]
        assert len(texts) == 1
        assert texts[0].endswith("1 g assumed: screw")
        door_only = sk.Asset(
            "door", sk.Mesh(*box_without_back()), np.zeros(10, dtype=int), (sk.Part("door"),)
        )
        (warning,) = [n.text for n in Mass().modify(door_only).notes if n.level == "warning"]
        assert warning.endswith("guesses: door")

    def test_a_stated_mass_is_kept_to(self) -> None:
        asset = single((0, 0, 0), (0.1, 0.1, 0.1)).with_parts({"body": sk.Part("body", stated_mass=3.0)})
        part = Mass(Mass.Options(density=100.0)).modify(asset).part("body")
        assert part.mass is not None
        assert part.mass.mass == 3.0
        np.testing.assert_allclose(part.mass.inertia, np.eye(3) * 3.0 * 0.1**2 / 6, atol=1e-12)
        assert part.mass.method.endswith("as stated")

    def test_a_stated_mass_is_no_guess(self) -> None:
        door = sk.Part("door", stated_mass=4.0)
        asset = sk.Asset("door", sk.Mesh(*box_without_back()), np.zeros(10, dtype=int), (door,))
        assert [n.level for n in Mass().modify(asset).notes] == ["info"]

    @pytest.mark.parametrize(("name", "kilograms"), [("wood", 3.36), ("steel", 3.297), ("glass", 4.375)])
    def test_open_boards_are_as_thick_as_is_usual(self, name: str, kilograms: float) -> None:
        """0.5 x 0.7 m: 16 mm of wood at 600 kg/m3, 1.2 mm of steel at 7850, 5 mm of glass at 2500."""
        corners = np.array([[0.0, 0, 0], [0.5, 0, 0], [0.5, 0, 0.7], [0, 0, 0.7]])
        mesh = sk.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
        panel = sk.Part("panel", material=MATERIALS[name])
        asset = sk.Asset("panel", mesh, np.zeros(2, dtype=int), (panel,))
        mass = Mass().modify(asset).part("panel").mass
        assert mass is not None
        assert mass.mass == pytest.approx(kilograms, rel=1e-9)

    def test_hollow_can_be_switched_off(self) -> None:
        asset = single((0, 0, 0), (0.5, 0.5, 0.5))
        hollow, filled = (
            Mass(Mass.Options(hollow=on)).modify(asset).part("body").mass for on in (True, False)
        )
        assert hollow is not None
        assert filled is not None
        assert hollow.mass == pytest.approx(600 * 6 * 0.25 * 0.016)
        assert filled.mass == pytest.approx(600 * 0.125)

    def test_joints_are_left_to_dynamics(self) -> None:
        asset = without_resistance(cabinet_asset(physics=False))
        assert Mass().modify(asset).joints == asset.joints


class TestCollision:
    def shapes(self, asset: sk.Asset, **options: object) -> dict[str, int]:
        changed = Collision(Collision.Options(**options)).modify(asset)  # type: ignore[arg-type]
        return {part.name: len(part.collision) for part in changed.parts}

    def test_auto_keeps_the_cabinet_hollow(self) -> None:
        asset = Collision().modify(cabinet_asset(physics=False))
        assert {p.name: len(p.collision) for p in asset.parts} == {"body": 5, "door": 2, "drawer": 1}
        (note,) = asset.notes
        assert "body 5, door 2, drawer 1" in note.text

    def test_modes(self) -> None:
        asset = cabinet_asset()
        assert self.shapes(asset, mode="hull") == {"body": 1, "door": 1, "drawer": 1}
        assert self.shapes(asset, mode="box") == {"body": 1, "door": 1, "drawer": 1}
        assert self.shapes(asset, mode="none") == {"body": 0, "door": 0, "drawer": 0}

    def test_max_shapes(self) -> None:
        steps = boxes_mesh([((i, 0.0, i), (i + 1.0, 1.0, i + 1.0)) for i in range(6)])
        asset = sk.Asset("steps", steps, np.zeros(72, dtype=int), (sk.Part("body"),))
        assert self.shapes(asset) == {"body": 6}
        assert self.shapes(asset, max_shapes=3) == {"body": 3}

    def test_a_box_is_the_bounding_box(self) -> None:
        part = Collision(Collision.Options(mode="box")).modify(cabinet_asset()).part("body")
        assert volume(part.collision[0]) == pytest.approx(0.6 * 0.4 * 0.8)

    def test_parts_that_overlap_are_named(self) -> None:
        asset = Collision(Collision.Options(mode="box")).modify(cabinet_asset(physics=False))
        (text,) = [note.text for note in asset.notes if "overlap" in note.text]
        assert "body and drawer (" in text  # the drawer is inside the box around the body
        assert not [n for n in Collision().modify(cabinet_asset(physics=False)).notes if "overlap" in n.text]

    def test_boards_are_boxes(self) -> None:
        asset = Collision().modify(cabinet_asset(physics=False))
        kinds = {shape.primitive.kind for part in asset.parts for shape in part.collision if shape.primitive}
        assert kinds == {"box"}
        assert "7 box, 1 hull" in asset.notes[0].text

    def test_a_tool_that_is_not_installed_is_named(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
        with pytest.raises(
            sk.BadInputError, match=r"coacd is not installed: pip install 'simart-kit\[coacd\]'"
        ):
            Collision(Collision.Options(tool="coacd")).modify(cabinet_asset())

    @pytest.mark.parametrize(
        "wrong", [{"mode": "mesh"}, {"max_vertices": 4}, {"max_shapes": 0}, {"margin": -1.0}]
    )
    def test_senseless_options_are_refused(self, wrong: dict[str, object]) -> None:
        with pytest.raises(ValidationError):
            Collision.Options(**wrong)  # type: ignore[arg-type]

    def test_two_runs_agree_to_the_bit(self) -> None:
        one, two = (Collision().modify(cabinet_asset()) for _ in range(2))
        for a, b in zip(one.parts, two.parts, strict=True):
            for left, right in zip(a.collision, b.collision, strict=True):
                np.testing.assert_array_equal(left.vertices, right.vertices)
                np.testing.assert_array_equal(left.faces, right.faces)


@pytest.mark.parametrize("mode", ["auto", "hull", "box"])
def test_modified_assets_pass_the_checks(mode: Literal["auto", "hull", "box"]) -> None:
    for asset in (cabinet_asset(physics=False), chain_asset(), static_asset()):
        stack = (Scale(), Mass(), Collision(Collision.Options(mode=mode)))
        for stage in stack:
            asset = stage.modify(asset)
        for check in (MassCheck(), CollisionCheck(), Joints()):
            result = check.check(Subject({}, asset))
            assert result.passed, result.text


def without_resistance(asset: sk.Asset) -> sk.Asset:
    return replace(asset, joints=tuple(replace(j, damping=0.0, friction=0.0) for j in asset.joints))


def single_with_hinge() -> sk.Asset:
    """A chest with a lid of 2.4 kg, hinged along the lid's lower back edge."""
    mesh = boxes_mesh([((0, 0, 0), (0.5, 0.4, 0.1)), ((0, 0, 0.1), (0.5, 0.4, 0.12))])
    hinge = sk.Joint(
        "lid_hinge", "revolute", "body", "lid", (0.0, 0.4, 0.1), (-1.0, 0.0, 0.0), sk.Limits(0.0, 1.5)
    )
    return sk.Asset("chest", mesh, np.repeat([0, 1], 12), (sk.Part("body"), sk.Part("lid")), (hinge,))


def box_without_back() -> tuple[FloatArray, IntArray]:
    vertices, faces = box((0.0, 0.0, 0.0), (0.5, 0.02, 0.7))
    back = (vertices[faces][:, :, 1] == 0.02).all(axis=1)
    return vertices, faces[~back]
