"""The hollow test, in MuJoCo: drawers hold what lies in them, closed doors keep out, open ones let in."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import manifold3d
import mujoco
import numpy as np
import pytest
from simart_kit_exporters.mjcf import Mjcf
from simart_kit_plugins.modifiers.collision import Collision
from simart_kit_plugins.modifiers.mass import Mass

import simart_kit as sk
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.separation import overlaps
from simart_kit.testing.meshes import box, boxes_mesh

from .furniture import Box, sideboard

CUBE = 0.1
OPEN = 0.25
DRAWER_FLOOR = 0.498  # of `sideboard`, [m] above the ground
DOOR_HEIGHT = 0.24
BODY, DOOR, DRAWER = 0, 1, 2
BOARDS = [BODY] * 6 + [DOOR] * 2 + [DRAWER] * 7  # of `sideboard`, in its order
Surface = tuple[FloatArray, IntArray]
Build = Callable[[list[Box]], Surface]


def in_boards(boxes: list[Box]) -> Surface:
    mesh = boxes_mesh(boxes)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


def in_one_shell(boxes: list[Box]) -> Surface:
    """The same solid without what is inside of it: one connected surface."""
    bodies = [
        manifold3d.Manifold.cube(tuple(np.subtract(upper, lower))).translate(lower) for lower, upper in boxes
    ]
    mesh = manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)


def in_sheets(boxes: list[Box]) -> Surface:
    """The box around all but a handle, without thickness and without its top; as it is where it is flat."""
    lower, upper = np.min([b[0] for b in boxes[:-1]], axis=0), np.max([b[1] for b in boxes[:-1]], axis=0)
    if (upper - lower).min() < 0.05 or len(boxes) != 7:
        return in_boards(boxes)
    lower[2] = DRAWER_FLOOR
    vertices, faces = box(tuple(lower), tuple(upper))
    return vertices, faces[~(vertices[faces][:, :, 2] == upper[2]).all(axis=1)]


def furniture(build: Build) -> sk.Asset:
    """The sideboard with a hinged door and a sliding drawer, its surface built part by part."""
    surfaces = [
        build([b for b, p in zip(sideboard(), BOARDS, strict=True) if p == part]) for part in range(3)
    ]
    starts = np.cumsum([0, *[len(v) for v, _ in surfaces]])
    mesh = Mesh(
        np.concatenate([v for v, _ in surfaces]),
        np.concatenate([f + start for (_, f), start in zip(surfaces, starts[:-1], strict=True)]),
    )
    labels = np.repeat(np.arange(3), [len(f) for _, f in surfaces])
    hinge = sk.Joint("hinge", "revolute", "body", "door", (0.23, -0.2, 0.2), (0, 0, 1), sk.Limits(0.0, 2.0))
    slide = sk.Joint("slide", "prismatic", "body", "drawer", axis=(0, -1, 0), limits=sk.Limits(0.0, 0.3))
    parts = (sk.Part("body"), sk.Part("door"), sk.Part("drawer"))
    asset = sk.Asset("sideboard", mesh, labels, parts, (hinge, slide))
    return Collision().modify(Mass().modify(asset))


SURFACES = {"boards": in_boards, "one shell": in_one_shell, "sheets": in_sheets}


@pytest.fixture(scope="module", params=SURFACES)
def asset(request: pytest.FixtureRequest) -> sk.Asset:
    return furniture(SURFACES[request.param])


def scene(asset: sk.Asset, folder: Path) -> mujoco.MjSpec:
    """The exported asset; its drawer and door go where servos are told to."""
    spec = mujoco.MjSpec.from_file(str(Mjcf(Mjcf.Options()).export(asset, folder)))
    for joint, stiffness in (("slide", 2000.0), ("hinge", 200.0)):
        spec.add_actuator(
            name=joint,
            target=joint,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            gaintype=mujoco.mjtGain.mjGAIN_FIXED,
            biastype=mujoco.mjtBias.mjBIAS_AFFINE,
            gainprm=[stiffness] + [0.0] * 9,
            biasprm=[0.0, -stiffness, -0.08 * stiffness] + [0.0] * 7,
        )
    return spec


def add_thing(
    spec: mujoco.MjSpec, kind: mujoco.mjtGeom, size: float, position: tuple[float, float, float]
) -> None:
    body = spec.worldbody.add_body(name="thing", pos=position)
    body.add_freejoint()
    body.add_geom(type=kind, size=[size] * 3, mass=0.2, condim=4)


def go(model: mujoco.MjModel, data: mujoco.MjData, name: str, target: float, seconds: float) -> None:
    """Lead a servo from where it is to a position, and wait there a little."""
    steps = round(seconds / model.opt.timestep)
    start = data.actuator(name).ctrl[0]
    for step in range(2 * steps):
        data.actuator(name).ctrl[0] = start + (target - start) * min(step / steps, 1.0)
        mujoco.mj_step(model, data)


def test_nothing_overlaps_at_rest(asset: sk.Asset) -> None:
    assert overlaps(asset) == ()


def test_a_cube_stays_in_the_drawer_that_moves(asset: sk.Asset, tmp_path: Path) -> None:
    spec = scene(asset, tmp_path)
    add_thing(spec, mujoco.mjtGeom.mjGEOM_BOX, CUBE / 2, (0.0, -0.02 - OPEN, DRAWER_FLOOR + CUBE / 2 + 0.02))
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("slide").qpos[0] = data.actuator("slide").ctrl[0] = OPEN
    for target in (OPEN, 0.0, OPEN, 0.0, OPEN):
        go(model, data, "slide", target, 0.4)
        assert data.joint("slide").qpos[0] == pytest.approx(target, abs=0.01), "the drawer did not get there"
    x, y, z = data.body("thing").xpos - data.body("drawer").xpos
    assert abs(x) < 0.2
    assert -0.17 < y < 0.14
    assert z == pytest.approx(DRAWER_FLOOR + CUBE / 2, abs=0.006)


@pytest.mark.parametrize(("angle", "inside"), [(0.0, False), (1.9, True)], ids=["closed", "open"])
def test_only_a_closed_door_blocks_a_ball(
    asset: sk.Asset, angle: float, inside: bool, tmp_path: Path
) -> None:
    spec = scene(asset, tmp_path)
    add_thing(spec, mujoco.mjtGeom.mjGEOM_SPHERE, 0.04, (0.0, -0.5, DOOR_HEIGHT))
    spec.body("thing").gravcomp = 1.0  # pushed straight ahead, it neither falls nor rolls
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("hinge").qpos[0] = data.actuator("hinge").ctrl[0] = angle
    for _ in range(round(1.5 / model.opt.timestep)):
        data.body("thing").xfrc_applied[1] = 2.0
        mujoco.mj_step(model, data)
    y = float(data.body("thing").xpos[1])
    assert (y > 0.1) if inside else (y < -0.2)
