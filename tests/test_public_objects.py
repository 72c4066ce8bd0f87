"""Real objects of public packages, made of tiny files of each kind whose parts and joints are known."""

from __future__ import annotations

import base64
import hashlib
import io
import json
import struct
import tarfile
import threading
import zipfile
from collections import Counter
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from simart_kit.bench.articulation import Articulation, LinkJoint
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.errors import BadInputError

from .public_objects import fetching
from .public_objects.__main__ import main
from .public_objects.controller import read_controller
from .public_objects.fetching import unpack
from .public_objects.making import make_objects
from .public_objects.mjcf import read_mjcf
from .public_objects.rigged import Rigged
from .public_objects.skinned import add_skin
from .public_objects.sources import Entry, Source, known_sources
from .public_objects.sweet_home import read_sweet_home
from .public_objects.urdf import read_urdf
from .public_objects.writing import Origin, write_object

MJCF = """<?xml version="1.0"?>
<mujoco>
  <worldbody>
    <body name="table"><geom type="box" size="1 1 .1"/></body>
    <body name="cabinet" pos="3 0 .5">
      <geom type="box" size=".2 .2 .5" rgba="1 0 0 1"/>
      <geom type="box" size=".3 .3 .6" group="3"/>
      <body name="door" pos="-.2 -.21 0">
        <joint name="hinge" axis="0 0 1" range="-90 0"/>
        <geom type="box" pos=".2 0 0" size=".2 .005 .5"/>
        <body name="knob"><geom type="box" pos=".3 -.02 0" size=".01 .01 .01"/></body>
      </body>
      <body name="drawer">
        <joint name="rail" type="slide" axis="0 -1 0" range="0 .3"/>
        <geom type="box" size=".1 .1 .1"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
URDF = """<?xml version="1.0"?>
<robot name="cart">
  <link name="root"/>
  <link name="board"><visual><geometry><box size="2,1,.2"/></geometry></visual></link>
  <link name="wheel"><visual><geometry><box size=".5 .5 .5"/></geometry></visual></link>
  <link name="flap"><visual><geometry>
    <mesh filename="parts/flap.stl" scale="2 2 2"/></geometry></visual></link>
  <joint name="held" type="fixed"><parent link="root"/><child link="board"/></joint>
  <joint name="axle" type="revolute"><parent link="board"/><child link="wheel"/>
    <origin xyz="1 0 -.5"/><axis xyz="0 1 0"/></joint>
  <joint name="strap" type="revolute"><parent link="board"/><child link="flap"/>
    <origin xyz="0 0 1"/><axis xyz="1 0 0"/><limit lower="0" upper="1.5"/></joint>
</robot>
"""
HERE = Origin("nowhere", "1", "file", "CC0-1.0")
NONE = Entry(set="develop", file="")


def written(rigged: Rigged, folder: Path) -> Articulation:
    """The object as it is read again after it was written."""
    write_object(rigged, "object", "thing", HERE, folder)
    return SimartBench().read(folder).articulation


def assert_joint(joint: LinkJoint, kind: str, axis: Any, limits: tuple[float, float] | None) -> None:
    assert joint.kind == kind
    assert joint.axis == pytest.approx(axis, abs=1e-9)
    assert (joint.lower, joint.upper) == (pytest.approx(limits) if limits else (None, None))


def box_at(low: Any, high: Any) -> trimesh.Trimesh:
    return trimesh.creation.box(bounds=[low, high])


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.xml"
    path.write_text(MJCF, encoding="utf-8")
    return path


def test_a_body_of_an_mjcf_scene_is_an_object(scene: Path, tmp_path: Path) -> None:
    found = written(read_mjcf(scene, NONE.model_copy(update={"body": "cabinet"})), tmp_path / "out")
    assert [link.name for link in found.links] == ["cabinet", "door", "drawer"]
    assert found.labels.tolist() == [0] * 12 + [1] * 24 + [2] * 12  # no table, no shape for contact
    assert_joint(found.links[1].joint, "revolute", (0, 1, 0), (-np.pi / 2, 0))
    assert_joint(found.links[2].joint, "prismatic", (0, 0, 1), (0, 0.3))
    # From front to back, -.24 (the knob) to .2, the hinge is at -.21.
    assert found.links[1].joint.origin == pytest.approx((-0.2, 0.5, 0.19), abs=1e-6)
    assert found.bounds.ravel() == pytest.approx((-0.2, 0, -0.22, 0.2, 1, 0.22), abs=1e-6)
    colors = trimesh.load(tmp_path / "out" / "input.glb", force="mesh", process=False).visual.vertex_colors
    assert colors[:8].tolist() == [[255, 0, 0, 255]] * 8


def test_bodies_may_be_held_and_limits_counted_anew(scene: Path, tmp_path: Path) -> None:
    scene.write_text(MJCF.replace('range="-90 0"', 'range="-1.5 0"'), encoding="utf-8")
    entry = NONE.model_copy(update={"body": "cabinet", "fixed": ("drawer",), "radians": True})
    found = written(read_mjcf(scene, entry), tmp_path / "out")
    assert Counter(found.labels.tolist()) == {0: 24, 1: 24}
    assert_joint(found.links[1].joint, "revolute", (0, 1, 0), (-1.5, 0))


def test_includes_may_have_a_head(scene: Path, tmp_path: Path) -> None:
    outer = tmp_path / "outer.xml"
    outer.write_text('<!-- ours --><mujoco><include file="scene.xml"/></mujoco>', encoding="utf-8")
    assert len(read_mjcf(outer, NONE.model_copy(update={"body": "cabinet"})).pieces) == 4


def write_cart(folder: Path) -> Path:
    (folder / "cart" / "parts").mkdir(parents=True)
    box_at((-0.5, 0, 0), (0.5, 0.1, 0.1)).export(folder / "cart" / "parts" / "flap.stl")
    path = folder / "cart" / "cart.urdf"
    path.write_text(URDF, encoding="utf-8")
    return path


def test_a_urdf_is_an_object(tmp_path: Path) -> None:
    found = written(read_urdf(write_cart(tmp_path), NONE), tmp_path / "out")
    assert found.labels.tolist() == [0] * 12 + [1] * 12 + [2] * 12
    assert_joint(found.links[1].joint, "continuous", (0, 0, -1), None)  # it has no limits
    assert_joint(found.links[2].joint, "revolute", (1, 0, 0), (0, 1.5))
    # Along x -1 to 1.25, y -.5 to .5, z -.75 to 1.2.
    assert found.links[1].joint.origin == pytest.approx((0.875, 0.25, 0), abs=1e-6)
    assert found.bounds.ravel() == pytest.approx((-1.125, 0, -0.5, 1.125, 1.95, 0.5), abs=1e-6)


def write_obj(path: Path, groups: dict[str, trimesh.Trimesh]) -> None:
    lines, start = [], 1
    for name, mesh in groups.items():
        lines += [f"g {name}", *(f"v {x} {y} {z}" for x, y, z in mesh.vertices.tolist())]
        lines += [f"f {a + start} {b + start} {c + start}" for a, b, c in mesh.faces.tolist()]
        start += len(mesh.vertices)
    path.write_text("\n".join(lines), encoding="utf-8")


def test_furniture_opens_on_its_hinges_and_rails(tmp_path: Path) -> None:
    groups = {
        "frame": box_at((0, 0, 0), (100, 200, 50)),
        "sweethome3d_hinge_1": box_at((0, 0, 50), (1, 200, 51)),
        "sweethome3d_opening_on_hinge_1_door": box_at((0, 0, 52), (100, 200, 54)),
        "sweethome3d_opening_on_hinge_1_sweethome3d_opening_on_rail_2_bolt": box_at(
            (40, 90, 55), (60, 95, 56)
        ),
        "sweethome3d_rail_2": box_at((30, 90, 57), (60, 92, 58)),
    }
    write_obj(tmp_path / "cupboard.obj", groups)
    catalogue = "model#1=/cupboard.obj\nname#1=Cupboard\nwidth#1=50\nheight#1=100\ndepth#1=29\n"
    (tmp_path / "PluginFurnitureCatalog.properties").write_text(catalogue, encoding="latin-1")
    rigged = read_sweet_home(tmp_path / "cupboard.obj", NONE)
    found = written(rigged, tmp_path / "out")
    assert rigged.category == "cupboard"
    assert found.labels.tolist() == [0] * 24 + [1] * 12 + [2] * 12 + [0] * 12
    assert [link.parent for link in found.links] == [-1, 0, 1]
    # The catalogue's 50 cm are 100 units. The bolt, 40 to 60, has 10 units of rail on its left.
    assert_joint(found.links[1].joint, "revolute", (0, 1, 0), None)
    assert found.links[1].joint.origin == pytest.approx((-0.2475, 0.5, 0.1075), abs=1e-6)
    assert_joint(found.links[2].joint, "prismatic", (1, 0, 0), (-0.05, 0))


def write_glb(path: Path, nodes: list[dict[str, Any]]) -> None:
    """A file with one mesh, the box from 0 to 1."""
    mesh = box_at((0, 0, 0), (1, 1, 1))
    corners, faces = (mesh.vertices.astype("<f4"), mesh.faces.astype("<u2"))
    document = {
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": len(corners)},
            {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": faces.size},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": corners.nbytes},
            {"buffer": 0, "byteOffset": corners.nbytes, "byteLength": faces.nbytes},
        ],
    }
    text = json.dumps(document).encode()
    data = corners.tobytes() + faces.tobytes()
    head = struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(data), len(text), b"JSON")
    path.write_bytes(head + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


def response(name: str, axis: str) -> dict[str, Any]:
    ends = {"minNodeName": f"{name}_min", "maxNodeName": f"{name}_max", "valueNodeName": f"{name}_value"}
    return {"visualResponses": {name: {"componentProperty": axis, "valueNodeProperty": "transform", **ends}}}


def test_a_controller_moves_between_its_end_nodes(tmp_path: Path) -> None:
    half = np.sin(np.radians(10)), np.cos(np.radians(10))  # of a turn of 20 degrees
    nodes: list[dict[str, Any]] = [
        {"name": "body", "mesh": 0, "scale": [8, 4, 8]},
        {"name": "trigger_min", "translation": [0, 5, 0]},
        {"name": "trigger_value", "mesh": 0, "translation": [0, 9, 0]},  # where it is does not count
        {"name": "trigger_max", "translation": [0, 4.5, 0]},
        {"name": "stick_min", "translation": [6, 5, 6], "rotation": [-half[0], 0, 0, half[1]]},
        {"name": "stick_value", "mesh": 0},
        {"name": "stick_max", "translation": [6, 5, 6], "rotation": [half[0], 0, 0, half[1]]},
        {"name": "dot", "mesh": 0, "translation": [0, 99, 0]},
    ]
    write_glb(tmp_path / "left.glb", nodes)
    components = {"trigger": response("trigger", "button"), "stick": response("stick", "yAxis")}
    components["trigger"]["touchPointNodeName"] = "dot"
    profile = {"layouts": {"left-right": {"components": components}}}
    (tmp_path / "profile.json").write_text(json.dumps(profile), encoding="utf-8")
    found = written(read_controller(tmp_path / "left.glb", NONE), tmp_path / "out")
    assert [link.name for link in found.links] == ["body", "trigger", "stick"]
    assert found.labels.tolist() == [0] * 12 + [1] * 12 + [2] * 12
    assert found.bounds.ravel() == pytest.approx((-4, 0, -4, 4, 6, 4), abs=1e-6)
    assert_joint(found.links[1].joint, "prismatic", (0, -1, 0), (0, 0.5))
    assert_joint(found.links[2].joint, "revolute", (1, 0, 0), (-np.radians(20), np.radians(20)))
    assert found.links[2].joint.origin == pytest.approx((2.5, 5, 2), abs=1e-6)


@pytest.fixture
def registry(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder that is served as the registry of npm."""
    folder = tmp_path / "registry"
    folder.mkdir()

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, format: str, *args: object) -> None:
            """Say nothing."""

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder))) as server:
        server.daemon_threads = False  # closing waits for answers that are under way, and their sockets
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
        monkeypatch.setattr(fetching, "NPM", f"http://127.0.0.1:{server.server_port}")
        yield folder
        server.shutdown()


@pytest.fixture
def carts(registry: Path) -> Source:
    """A package with the cart, which the registry has."""
    write_cart(registry / "package")
    archive = registry / "carts" / "-" / "carts-1.0.tgz"
    archive.parent.mkdir(parents=True)
    with tarfile.open(archive, "w:gz") as tar:
        tar.add(registry / "package", "package")
    return Source(
        kind="npm",
        package="carts",
        version="1.0",
        hash="sha512-" + base64.b64encode(hashlib.sha512(archive.read_bytes()).digest()).decode(),
        megabytes=1,
        reader="urdf",
        licence="MIT",
        root="package/cart",
        objects={"cart": Entry(set="verify", file="cart.urdf", category="cart")},
    )


def test_a_package_becomes_objects_that_say_where_they_are_from(carts: Source, tmp_path: Path) -> None:
    told: list[str] = []
    assert make_objects({"carts": carts}, tmp_path / "out", told.append) == (tmp_path / "out/verify/cart",)
    assert told == ["carts 1.0: 1 MB"]
    table = json.loads((tmp_path / "out/verify/cart/gt.json").read_text(encoding="utf-8"))
    assert (table["case"], table["category"], table["terms"]) == ("cart", "cart", "evaluation only")
    assert (table["source"], table["version"], table["licence"]) == ("npm carts", "1.0", "MIT")
    assert table["file"] == "package/cart/cart.urdf"
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["verify"]  # the package is gone
    with pytest.raises(BadInputError, match=r"cart exists: remove it"):
        make_objects({"carts": carts}, tmp_path / "out", told.append)


def test_the_skin_of_an_object_is_closed_and_has_its_parts(carts: Source, tmp_path: Path) -> None:
    (folder,) = make_objects({"carts": carts}, tmp_path / "out", lambda text: None)
    add_skin(folder)
    skin = trimesh.load(folder / "fused.glb", process=False, force="mesh")
    assert isinstance(skin, trimesh.Trimesh)
    assert skin.is_watertight
    whole = trimesh.load(folder / "input.glb", process=False, force="mesh")
    assert isinstance(whole, trimesh.Trimesh)
    voxel = float(np.ptp(whole.bounds, axis=0).max()) / 112
    assert skin.bounds == pytest.approx(whole.bounds, abs=2 * voxel)
    part = np.load(folder / "fused.npz")["face_part"]
    assert len(part) == len(skin.faces)
    assert set(part.tolist()) == set(np.load(folder / "gt.npz")["face_part"].tolist())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"hash": "sha256:" + "0" * 64}, "carts 1.0 has hash sha256:.* it is not used"),
        ({"version": "2.0"}, "cannot download carts 2.0 from .*404"),
        ({"root": "package/lorry"}, "carts 1.0 has no package/lorry/cart.urdf"),
    ],
)
def test_a_package_that_is_not_as_expected_leaves_nothing(
    carts: Source, tmp_path: Path, change: dict[str, str], message: str
) -> None:
    sources = {"good": carts, "bad": carts.model_copy(update=change)}
    with pytest.raises(BadInputError, match=message) as raised:
        make_objects(sources, tmp_path / "out", lambda text: None)
    assert "\n" not in str(raised.value)
    assert not (tmp_path / "out").exists()


def test_archives_in_packages_are_unpacked_too(tmp_path: Path) -> None:
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as packed:
        packed.writestr("chair.obj", "v 0 0 0")
    with zipfile.ZipFile(tmp_path / "some.whl", "w") as packed:
        packed.writestr("share/Chairs.sh3f", inner.getvalue())
    unpack(tmp_path / "some.whl", tmp_path / "out")
    assert (tmp_path / "out" / "share" / "Chairs" / "chair.obj").read_text(encoding="utf-8") == "v 0 0 0"


def test_no_object_stands_twice_in_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    sources = known_sources()
    names = Counter(name for source in sources.values() for name in source.objects)
    assert max(names.values()) == 1
    assert main(["--list", "--source", "robel"]) == 0
    assert capsys.readouterr().out.split()[:4] == ["robel", sources["robel"].version, "8", "MB"]
