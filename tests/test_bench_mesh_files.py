"""Mesh files that URDFs and data sets name: faces in the order of the file, and damage that is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from simart_kit.bench.formats.mesh_files import read_triangles
from simart_kit.errors import BadInputError


def test_obj_faces_keep_the_order_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(
        "mtllib gone.mtl\nv 0 0 0 # first\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl b\no one\nf 1/1 2/2 3//3 4\n"
        "usemtl a\ng two\nv 0 0 5\nf -1 1 2\nusemtl b\nf 1 2 3\n"
    )
    vertices, faces = read_triangles(tmp_path / "a.obj")
    assert len(vertices) == 5
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [4, 0, 1], [0, 1, 2]]


@pytest.mark.parametrize("suffix", ["stl", "ply", "off", "glb", "dae"])
def test_other_mesh_files_are_read_and_nodes_of_glb_are_applied(suffix: str, tmp_path: Path) -> None:
    scene = trimesh.Scene()
    place = trimesh.transformations.translation_matrix((1, 2, 3))
    mesh = trimesh.creation.box((1, 1, 1))
    if suffix == "glb":
        scene.add_geometry(mesh, transform=place)
        scene.export(tmp_path / f"a.{suffix}")
    else:
        mesh.apply_transform(place).export(tmp_path / f"a.{suffix}")
    vertices, faces = read_triangles(tmp_path / f"a.{suffix}")
    assert len(faces) == 12
    np.testing.assert_allclose(
        [vertices.min(axis=0), vertices.max(axis=0)], [(0.5, 1.5, 2.5), (1.5, 2.5, 3.5)]
    )


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("empty.obj", ""),
        ("nan.obj", "v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"),
        ("far.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n"),
        ("zero.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n"),
        ("before.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -4 1 2\n"),
        ("cut.obj", "v 0 0 0\nv 1 0"),
        ("word.obj", "v 0 0 x\nf 1 1 1\n"),
        ("cut.stl", "solid a\nfacet normal 0 0"),
        ("cut.glb", "glTF"),
        ("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
        ("cut.dae", "<COLLADA>"),
        ("cut.off", "OFF\n3 1"),
    ],
)
def test_a_damaged_mesh_file_is_named(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(BadInputError) as caught:
        read_triangles(tmp_path / name)
    assert str(tmp_path / name) in str(caught.value)
    assert "\n" not in str(caught.value)
