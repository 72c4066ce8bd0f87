"""The USD exporter: joint attributes of Newton and MuJoCo, and payload layers with variants for them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdPhysics, UsdShade, UsdUtils
from simart_kit_exporters.usd import Usd as UsdExporter

from simart_kit.asset import Asset
from simart_kit.kinematics import forward, sample_positions
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .usd_cases import export, glossy_asset, many_kinds_asset
from .usd_readers import forward as usd_forward
from .usd_readers import open_stage, read_inertials

DEGREE = np.pi / 180


@pytest.fixture(scope="module")
def layered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(tuned_asset(), tmp_path_factory.mktemp("layers") / "usd", layers=True)


def test_newton_reads_friction_armature_and_speed_in_degrees(tmp_path: Path) -> None:
    stage = open_stage(export(tuned_asset(), tmp_path / "usd"))
    assert written(stage, "door_hinge", "newton") == pytest.approx(
        {"armature": 0.003, "friction": 0.2, "velocityLimit": 1.5 / DEGREE}
    )
    assert written(stage, "drawer_slide", "newton") == pytest.approx(
        {"armature": 0.003, "friction": 0.2, "velocityLimit": 1.5}
    )


def test_mujoco_reads_friction_and_armature(tmp_path: Path) -> None:
    stage = open_stage(export(tuned_asset(), tmp_path / "usd"))
    for joint in ("door_hinge", "drawer_slide"):
        assert written(stage, joint, "mjc") == pytest.approx({"armature": 0.003, "frictionloss": 0.2})


def test_damping_is_written_once(tmp_path: Path) -> None:
    # A simulator that read a drive and an attribute would damp twice; a ball joint has no drive.
    stage = open_stage(export(many_kinds_asset(), tmp_path / "usd"))
    assert "damping" not in written(stage, "slide", "newton") | written(stage, "slide", "mjc")
    assert not stage.GetPrimAtPath("/kinds/Joints/shoulder").HasAPI(UsdPhysics.DriveAPI)
    assert written(stage, "shoulder", "newton")["damping"] == pytest.approx(0.1 * DEGREE)
    assert written(stage, "shoulder", "mjc")["damping"] == pytest.approx(0.1)


def test_a_joint_without_a_speed_limit_is_not_held(tmp_path: Path) -> None:
    cabinet = cabinet_asset()
    free = cabinet.with_joints({"door_hinge": replace(cabinet.joint("door_hinge"), velocity=0.0)})
    stage = open_stage(export(free, tmp_path / "usd"))
    assert "velocityLimit" not in written(stage, "door_hinge", "newton")


def test_fixed_joints_have_no_attributes_of_simulators(tmp_path: Path) -> None:
    stage = open_stage(export(many_kinds_asset(), tmp_path / "usd"))
    assert written(stage, "weld", "newton") == written(stage, "weld", "mjc") == {}


def test_schemas_are_named_whether_installed_or_not(tmp_path: Path) -> None:
    layer = Sdf.Layer.FindOrOpen(str(export(tuned_asset(), tmp_path / "usd")))
    joint = layer.GetPrimAtPath("/cabinet/Joints/door_hinge").GetInfo("apiSchemas")
    assert {"NewtonJointAPI", "MjcJointAPI"} <= set(joint.GetAppliedItems())
    shape = layer.GetPrimAtPath("/cabinet/door/collision_1").GetInfo("apiSchemas")
    marks = {"NewtonCollisionAPI", "NewtonMeshCollisionAPI", "MjcCollisionAPI", "MjcMeshCollisionAPI"}
    assert marks <= set(shape.GetAppliedItems())


def test_what_only_some_simulators_read_is_told() -> None:
    told = " ".join(UsdExporter().unsupported(tuned_asset()))
    assert "Newton" in told
    assert "MuJoCo" in told
    assert UsdExporter().unsupported(static_asset()) == ()


@pytest.mark.parametrize("runtime", [None, "Newton", "MuJoCo"])
def test_layers_hold_the_same_object_whatever_the_variant(layered: Path, runtime: str | None) -> None:
    asset, stage = tuned_asset(), selected(layered, runtime)
    positions = sample_positions(asset, np.random.default_rng(3))
    read = usd_forward(stage, positions)
    for part, world_T_part in forward(asset, positions).items():
        assert read[part] == pytest.approx(world_T_part, abs=1e-6), part
    masses = {name: inertial.mass for name, inertial in read_inertials(stage).items()}
    assert masses == pytest.approx({p.name: p.mass.mass for p in asset.parts if p.mass})
    colliders = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(colliders) == sum(len(part.collision) for part in asset.parts)
    drawn = stage.GetPrimAtPath("/cabinet/door/visual_1")
    assert UsdShade.MaterialBindingAPI(drawn).ComputeBoundMaterial()[0]


@pytest.mark.parametrize(("runtime", "spaces"), [(None, set()), ("Newton", {"newton"}), ("MuJoCo", {"mjc"})])
def test_a_variant_has_the_attributes_of_its_simulator_alone(
    layered: Path, runtime: str | None, spaces: set[str]
) -> None:
    stage = selected(layered, runtime)
    names = {a.GetName().partition(":")[0] for prim in stage.Traverse() for a in prim.GetAttributes()}
    assert names & {"newton", "mjc"} == spaces
    for space in spaces:
        assert written(stage, "door_hinge", space)["armature"] == pytest.approx(0.003)


def test_the_interface_is_small_and_its_variants_are_off(layered: Path) -> None:
    layer = Sdf.Layer.FindOrOpen(str(layered))
    (root,) = layer.rootPrims
    assert not root.nameChildren
    assert not root.properties
    assert [p.assetPath for p in root.payloadList.GetAppliedItems()] == ["./payloads/base.usda"]
    assert dict(root.variantSelections) == {"Newton": "Disabled", "MuJoCo": "Disabled"}
    entries = layer.customLayerData["SimReady_Metadata"]["Variants"]["Physics"]
    assert {name: entry["prim"] for name, entry in entries.items()} == {
        "Newton": "/cabinet",
        "MuJoCo": "/cabinet",
    }
    below = {str(p.relative_to(layered.parent)) for p in layered.parent.rglob("*.usd*")} - {layered.name}
    payloads = {f"payloads/{name}.usda" for name in ("base", "physics", "materials", "instances")}
    assert below == payloads | {
        "payloads/geometries.usdc",
        "runnables/physics/newton.usda",
        "runnables/physics/mujoco.usda",
    }


def test_layers_resolve_inside_the_folder_and_are_the_same_bytes(tmp_path: Path) -> None:
    paths = [export(glossy_asset(), tmp_path / name, layers=True) for name in ("one", "two")]
    layers, assets, unresolved = UsdUtils.ComputeAllDependencies(str(paths[0]))
    assert unresolved == []
    assert len(layers) == 8
    assert len(assets) == 3
    folder = paths[0].parent.resolve()
    named = [Path(layer.realPath) for layer in layers] + [Path(asset) for asset in assets]
    assert all(path.resolve().is_relative_to(folder) for path in named)
    first, second = (dict(contents(path.parent)) for path in paths)
    assert first == second


def tuned_asset() -> Asset:
    """The cabinet, with joints that have all there is to say of them."""
    cabinet = cabinet_asset()
    tuned = {j.name: replace(j, armature=0.003, friction=0.2, velocity=1.5) for j in cabinet.joints}
    return cabinet.with_joints(tuned)


def selected(path: Path, runtime: str | None) -> Usd.Stage:
    """The stage of a file with a variant enabled, in its session alone."""
    stage = open_stage(path)
    if runtime:
        stage.SetEditTarget(stage.GetSessionLayer())
        stage.GetDefaultPrim().GetVariantSet(runtime).SetVariantSelection("Enabled")
    return stage


def written(stage: Usd.Stage, joint: str, space: str) -> dict[str, float]:
    """The authored attributes of a joint in a namespace."""
    prim = stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendPath(f"Joints/{joint}"))
    return {a.GetBaseName(): a.Get() for a in prim.GetAuthoredPropertiesInNamespace(space)}


def contents(folder: Path) -> Iterator[tuple[str, str]]:
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        yield str(path.relative_to(folder)), hashlib.sha256(path.read_bytes()).hexdigest()
