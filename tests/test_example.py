"""The shipped example: what the generator writes, one welded mesh, and a ground truth that fits it."""

import json
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray, IntArray

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
FILES = ("cabinet.glb", "cabinet.gt.json", "cabinet.gt.npz")


def load(folder: Path) -> trimesh.Trimesh:
    return trimesh.load(folder / "cabinet.glb", process=False, force="mesh")


def pixels(mesh: trimesh.Trimesh) -> FloatArray:
    return np.asarray(mesh.visual.material.baseColorTexture.convert("RGB"))


@pytest.fixture(scope="module")
def shipped() -> trimesh.Trimesh:
    return load(EXAMPLES)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("made")
    subprocess.run([sys.executable, "-B", EXAMPLES / "make_cabinet.py", folder], check=True, timeout=120)
    return folder


@pytest.fixture(scope="module")
def truth() -> dict[str, Any]:
    table: dict[str, Any] = json.loads((EXAMPLES / "cabinet.gt.json").read_text(encoding="utf-8"))
    return table


@pytest.fixture(scope="module")
def face_part() -> IntArray:
    with np.load(EXAMPLES / "cabinet.gt.npz") as arrays:
        labels: IntArray = arrays["face_part"]
    return labels


def face_pieces(mesh: trimesh.Trimesh) -> IntArray:
    """(F,) connected piece of each face, coincident vertices merged."""
    _, welded = np.unique(mesh.vertices, axis=0, return_inverse=True)
    edges = np.concatenate([welded[mesh.faces][:, [0, 1]], welded[mesh.faces][:, [1, 2]]])
    labels: IntArray = trimesh.graph.connected_component_labels(edges, node_count=welded.max() + 1)
    pieces: IntArray = labels[welded[mesh.faces[:, 0]]]
    return pieces


def test_generator_writes_the_shipped_surface_truth_and_picture(made: Path, shipped: trimesh.Trimesh) -> None:
    again = load(made)
    assert np.array_equal(again.vertices, shipped.vertices)
    assert np.array_equal(again.faces, shipped.faces)
    assert np.array_equal(again.visual.uv, shipped.visual.uv)
    assert np.array_equal(pixels(again), pixels(shipped))
    assert (made / FILES[1]).read_bytes() == (EXAMPLES / FILES[1]).read_bytes()


@pytest.mark.skipif("ng" in zlib.ZLIB_RUNTIME_VERSION, reason="this zlib packs a PNG in other bytes")
def test_generator_writes_the_shipped_bytes(made: Path) -> None:
    differ = [name for name in FILES if (made / name).read_bytes() != (EXAMPLES / name).read_bytes()]
    assert differ == []


def test_is_one_mesh_of_furniture_size(shipped: trimesh.Trimesh) -> None:
    scene = trimesh.load(EXAMPLES / "cabinet.glb", process=False)
    assert len(scene.geometry) == len(scene.graph.nodes_geometry) == 1
    assert np.allclose(shipped.extents, (1.0, 0.9, 0.45), atol=0.01)
    assert shipped.bounds[0, 1] == 0.0
    assert 1500 <= len(shipped.faces) <= 3000
    assert (EXAMPLES / "cabinet.glb").stat().st_size < 1.5e6


def test_vertices_are_welded(shipped: trimesh.Trimesh) -> None:
    rows = np.concatenate([shipped.vertices, shipped.vertex_normals, shipped.visual.uv], axis=1)
    assert len(np.unique(rows, axis=0)) == len(rows)


def test_surface_is_closed_and_faces_outward(shipped: trimesh.Trimesh) -> None:
    merged = trimesh.Trimesh(shipped.vertices, shipped.faces)
    merged.merge_vertices(merge_norm=True, merge_tex=True)
    assert merged.is_watertight
    assert merged.is_winding_consistent
    assert merged.volume > 0
    shading = shipped.vertex_normals[shipped.faces]
    assert (np.einsum("fkc,fc->fk", shading, shipped.face_normals) > 0.5).all()


def test_truth_covers_the_faces(shipped: trimesh.Trimesh, truth: dict[str, Any], face_part: IntArray) -> None:
    assert face_part.shape == (len(shipped.faces),)
    assert np.bincount(face_part).tolist() == [part["faces"] for part in truth["parts"]]
    assert [part["id"] for part in truth["parts"]] == list(range(5))
    kinds = [part["joint"]["type"] for part in truth["parts"]]
    assert kinds == ["fixed", "revolute", "revolute", "prismatic", "prismatic"]


def test_parts_share_no_vertex(shipped: trimesh.Trimesh, face_part: IntArray) -> None:
    pieces = face_pieces(shipped)
    owners = [set(face_part[pieces == piece].tolist()) for piece in np.unique(pieces)]
    assert len(owners) > 5
    assert [ids for ids in owners if len(ids) > 1] == []


def test_pieces_of_a_part_touch_each_other(shipped: trimesh.Trimesh, face_part: IntArray) -> None:
    pieces = face_pieces(shipped)
    for part in range(5):
        corners = [
            shipped.triangles[pieces == p].reshape(-1, 3) for p in np.unique(pieces[face_part == part])
        ]
        low, high = (np.array([f(c, axis=0) for c in corners]) for f in (np.min, np.max))
        near = (low[:, None] <= high[None] + 1e-6).all(axis=2)
        links = np.argwhere(near & near.T)
        groups = trimesh.graph.connected_component_labels(links, node_count=len(corners))
        assert groups.max() == 0, f"part {part} falls into {groups.max() + 1} heaps"


def test_hinges_and_slides_lie_where_the_truth_says(
    shipped: trimesh.Trimesh, truth: dict[str, Any], face_part: IntArray
) -> None:
    for part in truth["parts"][1:]:
        corners = shipped.triangles[face_part == part["id"]].reshape(-1, 3)
        joint = part["joint"]
        if joint["type"] == "prismatic":
            assert joint["axis"] == [0.0, 0.0, 1.0]
            assert joint["lower"] == 0.0 < joint["upper"] < np.ptp(corners[:, 2])
            continue
        assert joint["axis"] == [0.0, 1.0, 0.0]
        outer = corners[np.abs(corners[:, 0]).argmax(), 0]
        assert 0 < abs(joint["origin"][0]) - abs(outer) < 0.003
        free_edge = corners[np.abs(corners[:, 0]).argmin()] - joint["origin"]
        opening = joint["upper"] or joint["lower"]
        assert np.cross(joint["axis"], free_edge)[2] * opening > 0, "doors open to the front"


def test_no_moving_part_touches_the_body_at_rest(shipped: trimesh.Trimesh, face_part: IntArray) -> None:
    body = shipped.triangles[face_part == 0]
    for part in range(1, 5):
        corners = shipped.triangles[face_part == part].reshape(-1, 3)
        low, high = corners.min(axis=0) - 0.002, corners.max(axis=0) + 0.002
        inside = ((body > low) & (body < high)).all(axis=2)
        assert not inside.any(), "a corner of the body is within 2 mm of a moving part's box"
