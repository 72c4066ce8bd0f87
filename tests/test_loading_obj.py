"""OBJ files as programs write them: materials beside them, polygons, comments, relative indices."""

from pathlib import Path

import numpy as np
import pytest

from simart_kit.loading import read_source
from simart_kit.plugins import Plugins

from .mesh_files import box_obj, corners_picture
from .test_loading import assert_picture_upright, in_source, read, volume, warnings


@pytest.fixture(scope="module")
def plugins() -> Plugins:
    return Plugins(installed=False, load=())


def test_obj_texture_is_upright_and_its_material_is_read(tmp_path: Path, plugins: Plugins) -> None:
    (tmp_path / "a.png").write_bytes(corners_picture())
    (tmp_path / "a.mtl").write_text(
        "newmtl paint\nKd 0 0 0\nmap_Kd C:\\somewhere\\a.png\nPr 0.3\nPm 0.9\n\n"
        "newmtl glass\nKd 0.1 0.2 0.3\nd 0.4\n"
    )
    (tmp_path / "a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "usemtl paint\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
    )
    mesh = read(tmp_path / "a.obj", plugins)
    assert_picture_upright(mesh, (0, 2))
    assert mesh.materials[0].base_color == (1, 1, 1, 1)
    assert (mesh.materials[0].roughness, mesh.materials[0].metallic) == (0.3, 0.9)
    assert warnings(mesh) == []
    with (tmp_path / "a.obj").open("a") as file:
        file.write("usemtl glass\nf 1/1 2/2 4/4\n")
    mesh = read(tmp_path / "a.obj", plugins)
    found = {mesh.materials[i].name: mesh.materials[i] for i in mesh.face_material}
    np.testing.assert_allclose(found["glass"].base_color, (0.1, 0.2, 0.3, 0.4))
    assert mesh.face_node is None


def test_obj_polygons_comments_and_relative_indices(tmp_path: Path, plugins: Plugins) -> None:
    plain = tmp_path / "plain.obj"
    plain.write_text(box_obj())
    relative, count = [], 0
    for line in box_obj().splitlines():
        words = line.split()
        count += words[0] == "v"
        if words[0] == "f":
            words = ["f", *(str(int(w) - count - 1) for w in words[1:])]
        relative.append(" ".join(words) + "  # a comment")
    other = tmp_path / "relative.obj"
    other.write_text("\n".join(relative) + "\nv 9 9 9\n")  # -1 now is another vertex
    mesh = read(plain, plugins)
    assert len(mesh.faces) == 12
    assert volume(mesh) == pytest.approx(1)
    np.testing.assert_allclose(in_source(read_source(other, plugins)), in_source(read_source(plain, plugins)))


def test_a_face_that_is_cut_off_is_told(tmp_path: Path, plugins: Plugins) -> None:
    (tmp_path / "a.obj").write_text(box_obj()[:-5])
    mesh = read(tmp_path / "a.obj", plugins)
    assert len(mesh.faces) == 10
    (warning,) = warnings(mesh)
    assert warning.startswith("1 face")


@pytest.mark.parametrize(
    ("mtl", "missing"),
    [
        (None, "gone.mtl"),
        ("newmtl a\nmap_Kd gone.png\n", "gone.png"),
        ("newmtl a\nmap_Kd ../../gone.png\n", "../../gone.png"),
    ],
)
def test_missing_files_of_an_obj_are_told_and_the_rest_is_read(
    mtl: str | None, missing: str, tmp_path: Path, plugins: Plugins, capfd: pytest.CaptureFixture[str]
) -> None:
    if mtl:
        (tmp_path / "gone.mtl").write_text(mtl)
    (tmp_path / "a.obj").write_text("mtllib gone.mtl\nusemtl a\n" + box_obj())
    mesh = read(tmp_path / "a.obj", plugins)
    assert len(mesh.faces) == 12
    (warning,) = warnings(mesh)
    assert f"'{missing}'" in warning
    assert capfd.readouterr() == ("", "")
