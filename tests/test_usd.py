"""The USD exporter: what OpenUSD's own tools read back equals the asset."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation
from simart_kit_exporters.usd import Usd as UsdExporter
from simart_kit_exporters.usd.frames import principal_axes, turn_x_to

from simart_kit.arrays import unit
from simart_kit.asset import Asset, Joint
from simart_kit.kinematics import forward, sample_positions
from simart_kit.lint.usd import lint_usd
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset

from .export_cases import overlapping_asset
from .usd_cases import ASSETS, children, export, many_kinds_asset, triangles
from .usd_readers import forward as usd_forward
from .usd_readers import open_stage, parsed, read_bodies, read_inertials, read_joints

SCHEMAS = {
    "fixed": "PhysicsFixedJoint",
    "revolute": "PhysicsRevoluteJoint",
    "continuous": "PhysicsRevoluteJoint",
    "prismatic": "PhysicsPrismaticJoint",
    "ball": "PhysicsSphericalJoint",
}


@pytest.fixture(scope="module", params=ASSETS)
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Asset, Path]:
    asset = ASSETS[request.param]
    return asset, export(asset, tmp_path_factory.mktemp("usd") / "usd")


def test_validators_of_openusd_find_nothing(case: tuple[Asset, Path]) -> None:
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) >= 20
    found = UsdValidation.ValidationContext(validators).Validate(open_stage(case[1]))
    assert [(e.GetName(), e.GetMessage()) for e in found] == []


def test_stage_is_a_component_in_metres_kilograms_and_z_up(case: tuple[Asset, Path]) -> None:
    stage = open_stage(case[1])
    assert case[1].name == f"{case[0].name}.usda"
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdPhysics.GetStageKilogramsPerUnit(stage) == 1.0
    assert stage.GetPseudoRoot().GetChildren() == [stage.GetDefaultPrim()]
    assert Usd.ModelAPI(stage.GetDefaultPrim()).GetKind() == "component"
    assert np.array_equal(UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetDefaultPrim()), np.eye(4))


def test_physics_parser_finds_the_bodies_and_joints_written(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    found, root = parsed(stage), stage.GetDefaultPrim().GetPath()
    assert set(found["RigidBody"]) == {p.name for p in asset.parts}
    assert all(item.primPath.GetParentPath() == root for item in found["RigidBody"].values())
    joints = {name: item for kind in found if kind.endswith("Joint") for name, item in found[kind].items()}
    base = set() if asset.floating else {"FixedBase"}
    assert set(joints) == {j.name for j in asset.joints} | base
    assert all(item.isValid for kind in found.values() for item in kind.values())
    if base:
        assert str(joints["FixedBase"].body0) == ""
        assert joints["FixedBase"].body1.name == asset.root.name
    for joint in asset.joints:
        assert (joints[joint.name].body0.name, joints[joint.name].body1.name) == (joint.parent, joint.child)


def test_limits_and_damping_are_those_of_the_asset(case: tuple[Asset, Path]) -> None:
    read = read_joints(open_stage(case[1]))
    for joint in case[0].joints:
        written = read[joint.name]
        assert written.schema == SCHEMAS[joint.kind]
        if joint.limits is None:
            assert written.limits is None
        else:
            assert written.limits == pytest.approx((joint.limits.lower, joint.limits.upper), abs=1e-6)
        if joint.kind != "ball":
            assert written.damping == pytest.approx(joint.damping, rel=1e-6)


def test_drives_are_passive_and_know_the_effort(tmp_path: Path) -> None:
    cabinet = cabinet_asset()
    loose = replace(cabinet.joint("drawer_slide"), effort=0.0)
    found = parsed(open_stage(export(cabinet.with_joints({"drawer_slide": loose}), tmp_path / "usd")))
    hinge = found["RevoluteJoint"]["door_hinge"].drive
    assert (hinge.enabled, hinge.stiffness, hinge.forceLimit, hinge.acceleration) == (True, 0.0, 50.0, False)
    # An effort of 0 is a joint without a motor; a drive of force 0 would not damp it either.
    slide = found["PrismaticJoint"]["drawer_slide"].drive
    assert (slide.damping, slide.forceLimit) == (2.0, float("inf"))


def test_articulation_root_is_on_the_base(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    roots = [p.GetName() for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI)]
    if asset.floating:
        assert roots == ([asset.root.name] if asset.joints else [])
    else:
        assert roots == ["FixedBase"]
    found = parsed(stage).get("Articulation", {})
    if asset.joints:
        (articulation,) = found.values()
        bodies_in = {path.name for path in articulation.articulatedBodies if not path.isEmpty}
        assert bodies_in == {p.name for p in asset.parts}


def test_mass_properties_equal_the_assets(case: tuple[Asset, Path]) -> None:
    read = read_inertials(open_stage(case[1]))
    assert set(read) == {p.name for p in case[0].parts}
    for part in case[0].parts:
        assert part.mass is not None
        inertia = np.array(part.mass.inertia)
        assert read[part.name].mass == pytest.approx(part.mass.mass, rel=1e-6)
        assert read[part.name].center == pytest.approx(part.mass.center, abs=1e-6)
        assert read[part.name].inertia == pytest.approx(inertia, abs=1e-6 * np.abs(inertia).max())


def test_joint_frames_coincide_at_rest(case: tuple[Asset, Path]) -> None:
    stage = open_stage(case[1])
    world_T_body = {None: np.eye(4), **read_bodies(stage)}
    for joint in read_joints(stage).values():
        world_T_parent_end = world_T_body[joint.parent] @ joint.parent_from_joint
        world_T_child_end = world_T_body[joint.child] @ joint.child_from_joint
        assert world_T_parent_end == pytest.approx(world_T_child_end, abs=1e-6), joint.name


def test_forward_kinematics_of_the_joint_frames_equals_the_assets(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    rng = np.random.default_rng(7)
    balls = [j.name for j in asset.joints if j.kind == "ball"]
    for _ in range(5):
        positions = sample_positions(asset, rng) | {name: rng.uniform(-1, 1, 3).tolist() for name in balls}
        read = usd_forward(stage, {name: np.array(value) for name, value in positions.items()})
        for part, world_T_part in forward(asset, positions).items():
            assert read[part] == pytest.approx(world_T_part, abs=1e-5), part


def test_colliders_are_the_convex_shapes_of_their_parts(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    found = parsed(stage)["RigidBody"]
    for part in asset.parts:
        prims = [p for p in children(stage, part.name) if p.HasAPI(UsdPhysics.CollisionAPI)]
        assert found[part.name].collisions == [p.GetPath() for p in prims]
        for prim, shape in zip(prims, part.collision, strict=True):
            assert UsdGeom.Imageable(prim).ComputePurpose() == "guide"
            assert UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() == "convexHull"
            assert triangles(prim) == pytest.approx(shape.vertices[shape.faces], abs=1e-6)
            bindings = UsdShade.MaterialBindingAPI(prim)
            assert not bindings.GetDirectBinding().GetMaterial()
            material = bindings.GetDirectBinding("physics").GetMaterial()
            slide = UsdPhysics.MaterialAPI(material.GetPrim())
            for attribute in (slide.GetStaticFrictionAttr(), slide.GetDynamicFrictionAttr()):
                assert attribute.Get() == pytest.approx(part.material.friction)
            assert slide.GetRestitutionAttr().Get() == pytest.approx(part.material.restitution)


def test_folder_is_self_contained_wherever_it_is_moved(case: tuple[Asset, Path], tmp_path: Path) -> None:
    shutil.copytree(case[1].parent, tmp_path / "moved")
    path = tmp_path / "moved" / case[1].name
    layers, assets, unresolved = UsdUtils.ComputeAllDependencies(str(path))
    arrays = path.parent / "payloads" / "geometries.usdc"
    assert {Path(layer.realPath) for layer in layers} == {path.resolve(), arrays.resolve()}
    assert unresolved == []
    assert {Path(a).resolve() for a in assets} == {p.resolve() for p in path.parent.glob("textures/*")}
    assert bool(assets) == any(m.base_color_image for m in case[0].mesh.materials)
    text = path.read_text()
    assert all(f"@{p}" not in text for p in ("/", "../"))
    assert str(case[1].parent) not in text
    assert Sdf.Layer.CreateAnonymous(".usda").ImportFromString(text)


def test_two_exports_are_the_same_bytes(case: tuple[Asset, Path], tmp_path: Path) -> None:
    again = export(case[0], tmp_path / "again")
    assert hashes(again.parent) == hashes(case[1].parent)


def test_binary_format_holds_the_same_scene_in_the_same_bytes(tmp_path: Path) -> None:
    asset = cabinet_asset(textured=False)  # a flattened stage names its textures by absolute paths
    first, second = (export(asset, tmp_path / n, format="usdc") for n in ("a", "b"))
    assert first.name == "cabinet.usdc"
    assert first.read_bytes().startswith(b"PXR-USDC")
    assert first.read_bytes() == second.read_bytes()
    text = export(asset, tmp_path / "text")
    binary, composed = (open_stage(p).Flatten(addSourceFileComment=False) for p in (first, text))
    # Layers put together hold the same lines, if in another order.
    assert sorted(binary.ExportToString().splitlines()) == sorted(composed.ExportToString().splitlines())


def test_base_stays_where_a_scene_puts_the_asset(tmp_path: Path) -> None:
    path = export(cabinet_asset(), tmp_path / "usd")
    scene = Usd.Stage.CreateInMemory()
    placed = UsdGeom.Xform.Define(scene, "/kitchen/placed")
    placed.AddTranslateOp().Set((3.0, 4.0, 5.0))
    placed.GetPrim().GetReferences().AddReference(str(path))
    base = parsed(scene)["FixedJoint"]["FixedBase"]
    assert str(base.body0) == ""
    assert tuple(base.localPose0Position) == pytest.approx((3.0, 4.0, 5.0))
    assert tuple(base.localPose1Position) == (0.0, 0.0, 0.0)


def test_parts_without_physics_are_bodies_without_mass_or_colliders(tmp_path: Path) -> None:
    stage = open_stage(export(cabinet_asset(physics=False), tmp_path / "usd"))
    assert set(read_bodies(stage)) == {"body", "door", "drawer"}
    assert read_inertials(stage) == {}
    assert "MeshShape" not in parsed(stage)


def test_parts_that_overlap_and_share_no_joint_are_filtered(tmp_path: Path) -> None:
    # Its door stands in both; a joint connects it to the body, which rules contact out by itself.
    asset = overlapping_asset()
    stage = open_stage(export(asset, tmp_path / "usd"))
    filtered = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.FilteredPairsAPI)]
    targets = {
        p.GetName(): UsdPhysics.FilteredPairsAPI(p).GetFilteredPairsRel().GetTargets() for p in filtered
    }
    assert {name: [str(path) for path in paths] for name, paths in targets.items()} == {
        "door": ["/cabinet/drawer"]
    }
    assert any("overlap" in s and "door and drawer (2 mm)" in s for s in UsdExporter().unsupported(asset))
    assert not any("overlap" in s for s in UsdExporter().unsupported(cabinet_asset()))


def test_a_free_joint_is_a_body_without_a_joint_and_is_told(tmp_path: Path) -> None:
    chain = chain_asset()
    free = Joint("post_spin", "free", "base", "post", (0.0, 0.0, 0.1))
    asset = replace(chain, joints=(chain.joints[0], free))
    assert set(read_joints(open_stage(export(asset, tmp_path / "usd")))) == {"FixedBase", "arm_hinge"}
    assert any("free joint" in s and "post_spin" in s for s in UsdExporter().unsupported(asset))


def test_what_lies_loose_and_carries_something_is_an_articulation_of_its_own(tmp_path: Path) -> None:
    chain = chain_asset()
    free = Joint("post_spin", "free", "base", "post", (0.0, 0.0, 0.1))
    file = export(replace(chain, joints=(chain.joints[0], free)), tmp_path / "usd")
    stage = open_stage(file)
    roots = {p.GetName() for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI)}
    assert roots == {"FixedBase", "post"}
    articulations = parsed(stage)["Articulation"].values()
    links = [{path.name for path in one.articulatedBodies if not path.isEmpty} for one in articulations]
    assert {"arm", "post"} in links
    assert not [found for found in lint_usd(file) if found.rule == "articulation-missing"]


def test_what_is_lost_is_told_with_its_names() -> None:
    lost = UsdExporter().unsupported(cabinet_asset())
    assert any("friction" in s and "door_hinge, drawer_slide" in s for s in lost)
    assert any("speed" in s for s in lost)
    assert any("ball" in s and "shoulder" in s for s in UsdExporter().unsupported(many_kinds_asset()))
    assert UsdExporter().unsupported(static_asset()) == ()
    box = static_asset()
    tinted = replace(
        box, mesh=replace(box.mesh, colors=np.full((len(box.mesh.vertices), 4), 200, dtype=np.uint8))
    )
    white = replace(
        box, mesh=replace(box.mesh, colors=np.full((len(box.mesh.vertices), 4), 255, dtype=np.uint8))
    )
    assert any("vertex" in s and "body" in s for s in UsdExporter().unsupported(tinted))
    assert UsdExporter().unsupported(white) == ()


@pytest.mark.parametrize(
    "axis",
    [
        *[(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, 0, -1), (0.6, 0.0, 0.8), (-0.6, -0.8, 0)],
        *[tuple(unit(np.array([-1.0, tilt, -2 * tilt]))) for tilt in (1e-3, 1e-4, 1e-5, 1e-9, 1e-14)],
    ],
)
def test_turn_takes_x_to_the_axis(axis: tuple[float, float, float]) -> None:
    assert tuple(turn_x_to(axis).Transform((1, 0, 0))) == pytest.approx(axis, abs=1e-6)


def test_principal_axes_rebuild_any_inertia_with_a_proper_rotation() -> None:
    rng = np.random.default_rng(3)
    for moments in [(1.0, 2.0, 2.5), (1.0, 1.0, 1.5), (2.0, 2.0, 2.0), (1e-6, 1.0, 1.0)] * 50:
        basis, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        inertia = basis @ np.diag(moments) @ basis.T
        found, axes = principal_axes(inertia)
        assert axes @ np.diag(found) @ axes.T == pytest.approx(inertia, abs=1e-12)
        assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(axes) == pytest.approx(1.0)


def test_principal_axes_of_a_diagonal_inertia_are_the_frame_itself() -> None:
    moments, axes = principal_axes(((3.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 2.0)))
    assert moments.tolist() == [3.0, 1.0, 2.0]
    assert np.array_equal(axes, np.eye(3))


def hashes(directory: Path) -> dict[str, str]:
    files = [p for p in sorted(directory.rglob("*")) if p.is_file()]
    return {str(p.relative_to(directory)): hashlib.sha256(p.read_bytes()).hexdigest() for p in files}
