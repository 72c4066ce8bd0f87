"""Assets that every exporter must carry over, and what a reading of them must say."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, ConvexMesh, Joint, JointKind, MassProperties, Part
from simart_kit.kinematics import forward, rest_origin, rotation, sample_positions
from simart_kit.mesh import Mesh, VisualMaterial
from simart_kit.primitives import Primitive
from simart_kit.testing.meshes import box, cabinet_asset, chain_asset, static_asset

from .readers import Reading


def painted_asset() -> Asset:
    """The cabinet without texture, with a random colour a vertex."""
    asset = cabinet_asset(textured=False)
    rng = np.random.default_rng(3)
    colors = rng.integers(0, 256, (len(asset.mesh.vertices), 4), dtype=np.uint8)
    colors[:, 3] = 255
    return replace(asset, mesh=replace(asset.mesh, colors=colors))


def two_tone_asset() -> Asset:
    """The cabinet whose body has two materials: tinted glass, and a tinted texture."""
    asset = cabinet_asset()
    look = asset.mesh.materials[0]
    materials = (
        replace(look, base_color=(1.0, 0.5, 0.5, 1.0)),
        VisualMaterial("Glass / red", (0.8, 0.1, 0.1, 0.5), roughness=0.05),
    )
    face_material = np.zeros(len(asset.mesh.faces))
    face_material[48:60] = 1
    mesh = replace(asset.mesh, materials=materials, face_material=face_material)
    return replace(asset, mesh=mesh)


def sheet_asset() -> Asset:
    """A box that carries a single slanted triangle, which a spinning joint moves."""
    vertices, faces = box((0.0, 0.0, 0.0), (0.2, 0.2, 0.2))
    triangle = np.array([[0.3, 0.0, 0.0], [0.4, 0.0, 0.1], [0.3, 0.1, 0.1]])
    mesh = Mesh(np.concatenate([vertices, triangle]), np.concatenate([faces, [[8, 9, 10]]]))
    block = static_asset().parts[0]
    mass = MassProperties(0.1, (0.33, 0.03, 0.06), ((1e-4, 0.0, 0.0), (0.0, 1e-4, 0.0), (0.0, 0.0, 1e-4)))
    flag = Part("flag", mass=mass)
    joint = Joint("spin", "continuous", "body", "flag", (0.3, 0.0, 0.0), (0.0, 0.0, 1.0))
    return Asset("sheet", mesh, np.repeat([0, 1], [12, 1]), (block, flag), (joint,))


def overlapping_asset() -> Asset:
    """The cabinet with a collision box of the door that stands 2 mm deep in the drawer's and the body's."""
    asset = cabinet_asset()
    shape = ConvexMesh(*box((-0.28 - 0.002, -0.2, 0.1), (0.2, -0.18, 0.542)))
    return asset.with_parts({"door": replace(asset.part("door"), collision=(shape,))})


def turn(x: float, y: float, z: float) -> FloatArray:
    """(3, 3) rotation about the fixed axes x, then y, then z [rad], one after the other."""
    around = [rotation(angle * axis) for angle, axis in zip((x, y, z), np.eye(3), strict=True)]
    return around[2] @ around[1] @ around[0]


RIGHT = np.pi / 2
TURNS = {
    "none": turn(0.0, 0.0, 0.0),
    "slanted": turn(0.4, -0.9, 2.5),
    "half": turn(np.pi, 0.0, 0.0),
    "behind": turn(0.3, 2.0, -3.0),
    "lock": turn(0.7, RIGHT, 0.0),
    "lock_below": turn(-0.3, -RIGHT, 1.1),
    "almost_locked": turn(0.7, RIGHT - 1e-8, -2.0),
}
"""Rotations, some of them in gimbal lock or close to it, where roll and yaw turn about the same line."""


def primitives_asset(rotation: FloatArray = TURNS["slanted"]) -> Asset:
    """The cabinet whose drawer has a box, a cylinder, a sphere, and a box that is a mesh, turned alike."""
    shapes = []
    sizes = (("box", (0.2, 0.1, 0.05)), ("cylinder", (0.06, 0.06, 0.3)), ("sphere", (0.08, 0.08, 0.08)))
    for index, (kind, size) in enumerate(sizes):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation, (0.1 * index, -0.05 * index, 0.65)
        vertices, faces = box(*(sign * np.array(size) / 2 for sign in (-1, 1)))
        primitive = Primitive(kind, size, pose)
        shapes.append(ConvexMesh(vertices @ rotation.T + pose[:3, 3], faces, primitive))
    shapes.append(replace(shapes[0], primitive=None))
    asset = cabinet_asset()
    return asset.with_parts({"drawer": replace(asset.part("drawer"), collision=tuple(shapes))})


def with_joint_kind(kind: JointKind) -> Asset:
    """The cabinet with another kind of joint at its door."""
    asset = cabinet_asset()
    return asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), kind=kind, limits=None)})


CASES: dict[str, Callable[[], Asset]] = {
    "textured": cabinet_asset,
    "plain": lambda: cabinet_asset(textured=False),
    "chain": chain_asset,
    "static": static_asset,
    "painted": painted_asset,
    "two_tone": two_tone_asset,
    "sheet": sheet_asset,
    "primitives": primitives_asset,
}


def random_positions(asset: Asset) -> dict[str, float]:
    """The same random positions on every call."""
    return sample_positions(asset, np.random.default_rng(11))


def assert_same_robot(reading: Reading, asset: Asset, positions: dict[str, float]) -> None:
    """Poses, mass properties, limits and numbers of collision shapes are the asset's."""
    expected = forward(asset, positions)
    assert set(reading.poses) == set(expected)
    for name, pose in expected.items():
        np.testing.assert_allclose(reading.poses[name], pose, atol=1e-6, err_msg=name)
    for part in asset.parts:
        assert part.mass is not None
        found = reading.inertials[part.name]
        np.testing.assert_allclose(found.mass, part.mass.mass, rtol=1e-9, err_msg=part.name)
        center = np.array(part.mass.center) - rest_origin(asset, part.name)
        np.testing.assert_allclose(found.center, center, atol=1e-9, err_msg=part.name)
        np.testing.assert_allclose(found.inertia, part.mass.inertia, rtol=1e-5, atol=1e-8, err_msg=part.name)
    assert set(reading.limits) == {joint.name for joint in asset.joints}
    for joint in asset.joints:
        limits = (joint.limits.lower, joint.limits.upper) if joint.limits else None
        assert reading.limits[joint.name] == (pytest.approx(limits, rel=1e-9) if limits else None)
    for part in asset.parts:
        assert reading.colliders[part.name] == len(part.collision), part.name


def surface_count(asset: Asset) -> int:
    """Number of pairs of part and material."""
    return len(set(zip(asset.face_part.tolist(), asset.mesh.face_material.tolist(), strict=True)))


def absolute_paths(folder: Path) -> list[str]:
    """Words of the text files under a folder that start like an absolute path."""
    texts = [p.read_text() for p in folder.rglob("*") if p.suffix in (".urdf", ".xml", ".mtl", ".obj")]
    assert texts
    return [word for text in texts for word in re.findall(r"(?<![\w./:<])/\w+[^\s\"<>]*", text)]


def folder_hashes(folder: Path) -> dict[str, str]:
    """SHA-256 by relative path of every file under a folder."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {str(f.relative_to(folder)): hashlib.sha256(f.read_bytes()).hexdigest() for f in files}
