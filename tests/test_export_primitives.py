"""Boxes, cylinders and spheres: URDF and MJCF say so instead of writing a mesh, turned as in the asset."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pinocchio
import pytest
from simart_kit_exporters.mjcf import Mjcf
from simart_kit_exporters.overlaps import overlapping_parts
from simart_kit_exporters.rotations import roll_pitch_yaw
from simart_kit_exporters.urdf import Urdf

from simart_kit.asset import Asset, ConvexMesh, Part
from simart_kit.kinematics import rest_to_posed
from simart_kit.separation import overlaps
from simart_kit.testing.meshes import box, static_asset

from .export_cases import TURNS, primitives_asset, turn
from .readings import Array

OPENED = {"drawer_slide": 0.2, "door_hinge": -0.5}
SIZES = {"box": (0.2, 0.1, 0.05), "cylinder": (0.03, 0.3), "sphere": (0.04,)}


def export(exporter: Urdf | Mjcf, asset: Asset, folder: Path) -> Path:
    folder.mkdir()
    return exporter.export(asset, folder)


def expected(asset: Asset) -> list[Array]:
    """World poses of the drawer's three primitives when the parts are `OPENED`."""
    posed_T_rest = rest_to_posed(asset, OPENED)["drawer"]
    shapes = [shape.primitive for shape in asset.part("drawer").collision if shape.primitive]
    return [posed_T_rest @ shape.asset_T_shape for shape in shapes]


def replace_shapes(asset: Asset, shape: ConvexMesh, part: str = "body") -> Part:
    return replace(asset.part(part), collision=(shape,))


def in_mujoco(path: Path) -> list[tuple[str, tuple[float, ...], Array]]:
    """Kind, size as `SIZES` has it and world pose of what is solid and no mesh."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    for name, position in OPENED.items():
        data.joint(name).qpos[0] = position
    mujoco.mj_forward(model, data)
    found = []
    for geom in np.flatnonzero((model.geom_type != mujoco.mjtGeom.mjGEOM_MESH) & (model.geom_contype > 0)):
        kind = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower()
        x, y, z = model.geom_size[geom]
        size = {"box": (2 * x, 2 * y, 2 * z), "cylinder": (x, 2 * y), "sphere": (x,)}[kind]
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
        found.append((kind, size, pose))
    return found


def in_pinocchio(path: Path) -> list[tuple[str, tuple[float, ...], Array]]:
    model = pinocchio.buildModelFromUrdf(str(path))
    shapes = pinocchio.buildGeomFromUrdf(
        model, str(path), pinocchio.GeometryType.COLLISION, package_dirs=[str(path.parent)]
    )
    q = pinocchio.neutral(model)
    for name, position in OPENED.items():
        q[model.joints[model.getJointId(name)].idx_q] = position
    data, places = model.createData(), shapes.createData()
    pinocchio.updateGeometryPlacements(model, data, shapes, places, q)
    sizes: dict[str, Callable[[object], tuple[float, ...]]] = {
        "box": lambda s: tuple(2 * s.halfSide),
        "cylinder": lambda s: (s.radius, 2 * s.halfLength),
        "sphere": lambda s: (s.radius,),
    }
    kinds = [type(shape.geometry).__name__.lower() for shape in shapes.geometryObjects]
    return [
        (kind, sizes[kind](shape.geometry), place.homogeneous)
        for kind, shape, place in zip(kinds, shapes.geometryObjects, places.oMg, strict=True)
        if kind in sizes
    ]


READERS = {"mjcf": (Mjcf, in_mujoco), "urdf": (Urdf, in_mujoco), "urdf_pinocchio": (Urdf, in_pinocchio)}


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("case", TURNS)
def test_primitives_are_where_the_asset_has_them(case: str, reader: str, tmp_path: Path) -> None:
    asset = primitives_asset(TURNS[case])
    exporter, read = READERS[reader]
    found = read(export(exporter(), asset, tmp_path / "out"))
    assert [kind for kind, _, _ in found] == list(SIZES)
    for (kind, size, pose), place in zip(found, expected(asset), strict=True):
        np.testing.assert_allclose(size, SIZES[kind], rtol=1e-9)
        np.testing.assert_allclose(pose, place, atol=1e-9)


@pytest.mark.parametrize("exporter", [Urdf, Mjcf])
def test_a_primitive_writes_no_mesh_file(exporter: type[Urdf | Mjcf], tmp_path: Path) -> None:
    export(exporter(), primitives_asset(), tmp_path / "out")
    # The drawer's one shape that is a mesh, and those of the other parts.
    assert len(list(tmp_path.rglob("drawer_hull_*.obj"))) == 1
    assert len(list(tmp_path.rglob("body_hull_*.obj"))) == 5


def test_the_root_frame_of_a_primitive_is_the_asset_frame(tmp_path: Path) -> None:
    shape = primitives_asset().part("drawer").collision[1]
    asset = static_asset()
    asset = asset.with_parts({"body": replace_shapes(asset, shape)})
    robot = ElementTree.parse(export(Urdf(), asset, tmp_path / "urdf"))
    (origin,) = robot.findall("link/collision/origin")
    np.testing.assert_allclose(np.array(origin.attrib["xyz"].split(), dtype=float), [0.1, -0.05, 0.65])
    np.testing.assert_allclose(np.array(origin.attrib["rpy"].split(), dtype=float), [0.4, -0.9, 2.5])


def test_overlaps_are_those_of_the_primitive_and_not_of_its_mesh() -> None:
    # The corners of the box around a sphere of 80 mm stand in the door; the sphere stays 6 mm away from it.
    sphere = primitives_asset(turn(0.0, 0.0, np.pi / 4)).part("drawer").collision[2]
    middle = sphere.primitive.asset_T_shape[:3, 3]
    wall = ConvexMesh(*box(middle + (-0.3, -0.2, -0.1), middle + (0.3, -0.046, 0.1)))
    asset = primitives_asset()
    asset = asset.with_parts(
        {"door": replace_shapes(asset, wall, "door"), "drawer": replace_shapes(asset, sphere, "drawer")}
    )
    assert not overlapping_parts(asset)["door", "drawer"].at_rest
    as_mesh = ConvexMesh(sphere.vertices, sphere.faces)
    asset = asset.with_parts({"drawer": replace_shapes(asset, as_mesh, "drawer")})
    # The edge of the turned box is 40 * sqrt(2) = 56.57 mm from its middle.
    assert overlapping_parts(asset)["door", "drawer"].at_rest
    (depth,) = (o.depth for o in overlaps(asset) if (o.one, o.other) == ("door", "drawer"))
    assert depth == pytest.approx(0.04 * np.sqrt(2) - 0.046, abs=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_angles_give_back_the_rotation(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pitches = [*rng.uniform(-np.pi, np.pi, 20), *(np.pi / 2 - 10.0 ** rng.uniform(-12, -3, 20))]
    for pitch in pitches:
        rotation = turn(rng.uniform(-4, 4), pitch, rng.uniform(-4, 4))
        np.testing.assert_allclose(turn(*roll_pitch_yaw(rotation)), rotation, atol=1e-14)
