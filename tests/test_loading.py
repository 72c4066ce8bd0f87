"""What is read from a mesh file: shape, frame, size, looks, and the order of its faces."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image as Pillow

from simart_kit.errors import PluginError
from simart_kit.hookspecs import hookimpl
from simart_kit.loading import Source, read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import box, cabinet_mesh

from .mesh_files import (
    CORNER_COLORS,
    SQUARE,
    SQUARE_FACES,
    box_dae,
    corners_picture,
    data_uri,
    gltf,
    save_glb,
    save_gltf,
    textured_square,
)

DATA = Path(__file__).resolve().parents[1].parent / "shared" / "data"
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="needs the development meshes in ../shared/data")


@pytest.fixture(scope="module")
def plugins() -> Plugins:
    return Plugins(installed=False, load=())


def read(path: Path, plugins: Plugins, **frame: Any) -> Mesh:
    return read_source(path, plugins, **frame).mesh


def volume(mesh: Mesh, faces: Any = slice(None)) -> float:
    a, b, c = mesh.triangles[faces].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def warnings(mesh: Mesh) -> list[str]:
    return [note.text for note in mesh.notes if note.level == "warning"]


def in_source(source: Source) -> np.ndarray:
    """(F, 3, 3) corners in the file's own coordinates."""
    source_from_asset = np.linalg.inv(source.asset_from_source)
    return source.mesh.triangles @ source_from_asset[:3, :3].T + source_from_asset[:3, 3]


def assert_picture_upright(mesh: Mesh, in_plane: tuple[int, int]) -> None:
    """Each corner of the unit square shows the colour that the picture has at that corner."""
    image = mesh.materials[0].base_color_image
    assert image is not None
    assert mesh.uv is not None
    square = mesh.vertices[:, in_plane] - mesh.vertices[:, in_plane].min(axis=0)
    assert len(square) >= 4
    for corner, (u, v) in zip(square, mesh.uv, strict=True):
        row, column = round((1 - v) * 31), round(u * 31)
        seen = image.pixels[row, column, :3].astype(int)
        assert np.abs(seen - CORNER_COLORS[tuple(np.round(corner))]).max() < 20  # JPEG rings


# Formats


@pytest.mark.parametrize(
    ("kind", "up", "metres"),
    [
        ("glb", 1, 1.0),
        ("gltf", 1, 1.0),
        ("obj", 1, 1.0),
        ("dae", 1, 1.0),
        ("ply", 2, 1.0),
        ("stl", 2, 1.0),
        ("off", 2, 1.0),
        ("3mf", 2, 0.001),
    ],
)
def test_every_format_keeps_faces_in_order_and_stands_up(
    kind: str, up: int, metres: float, tmp_path: Path, plugins: Plugins
) -> None:
    truth = cabinet_mesh()
    written = trimesh.Trimesh(truth.vertices, truth.faces, process=False).export(file_type=kind)
    for name, data in (written if kind == "gltf" else {f"model.{kind}": written}).items():
        (tmp_path / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    source = read_source(tmp_path / f"model.{kind}", plugins)
    np.testing.assert_allclose(in_source(source), truth.triangles, atol=1e-6)
    lower, upper = source.mesh.bounds
    size = np.ptp(truth.vertices, axis=0) * metres
    assert upper[2] - lower[2] == pytest.approx(size[up], abs=1e-6)
    np.testing.assert_allclose([lower[2], *(lower + upper)[:2]], 0, atol=1e-6)
    assert volume(source.mesh) > 0


def test_gltf_front_becomes_front(tmp_path: Path, plugins: Plugins) -> None:
    # glTF's front is +Z and its up +Y; ours are -Y and +Z.
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    mesh = read(save_gltf(tmp_path / "a.gltf", gltf(vertices, faces)), plugins)
    expected = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, -1, 0]])[faces]
    np.testing.assert_allclose(mesh.triangles - mesh.triangles[0, 0], expected, atol=1e-6)


def test_up_and_unit_override_what_the_file_says(tmp_path: Path, plugins: Plugins) -> None:
    path = tmp_path / "box.stl"
    trimesh.Trimesh(*box((0, 0, 0), (300, 400, 500)), process=False).export(path)
    mesh = read(path, plugins, up="+y", unit="mm")
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), [0.3, 0.5, 0.4], atol=1e-6)
    assert any("no unit" in n.text for n in read(path, plugins).notes)


@pytest.mark.parametrize(
    ("unit", "axis", "frame", "size"),
    [
        ("0.01", "Y_UP", True, (1.0, 2.0, 0.5)),
        ("0.0254", "Z_UP", True, (2.54, 1.27, 5.08)),
        ("9", "X_UP", False, (100.0, 200.0, 50.0)),  # not written: COLLADA's defaults
    ],
)
def test_dae_unit_and_up_axis(
    unit: str, axis: str, frame: bool, size: tuple[float, ...], tmp_path: Path, plugins: Plugins
) -> None:
    path = tmp_path / "a.dae"
    path.write_text(box_dae(unit, axis, frame))
    source = read_source(path, plugins)
    np.testing.assert_allclose(np.ptp(source.mesh.vertices, axis=0), size, rtol=1e-6)
    assert in_source(source)[..., 1].min() == pytest.approx(10)  # the node's translation


@pytest.mark.parametrize(("unit", "metres"), [("micron", 1e-6), ("inch", 0.0254), (None, 0.001)])
def test_3mf_units(unit: str | None, metres: float, tmp_path: Path, plugins: Plugins) -> None:
    import zipfile

    path = tmp_path / "box.3mf"
    trimesh.Trimesh(*box((0, 0, 0), (30, 40, 50)), process=False).export(path)
    with zipfile.ZipFile(path) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    written = f'unit="{unit}"'.encode() if unit else b""
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in entries.items():
            archive.writestr(name, data.replace(b'unit="millimeter"', written))
    np.testing.assert_allclose(np.ptp(read(path, plugins).vertices, axis=0), np.array([30, 40, 50]) * metres)


# Scenes


def test_gltf_nodes_instances_and_mirrors(tmp_path: Path, plugins: Plugins) -> None:
    vertices, faces = box((0, 0, 0), (1, 2, 3))
    header = gltf(vertices, faces)
    header["scenes"] = [{"nodes": [0, 2]}]
    header["nodes"] = [
        {"translation": [10, 0, 0], "children": [1]},
        {"mesh": 0, "rotation": [0, 0, np.sqrt(0.5), np.sqrt(0.5)]},  # a quarter turn about z
        {"mesh": 0, "scale": [-1, 1, 2]},
    ]
    path = save_gltf(tmp_path / "a.gltf", header)
    source = read_source(path, plugins)
    mesh, corners = source.mesh, in_source(source)
    assert mesh.face_node is not None
    nodes = [np.flatnonzero(mesh.face_node == node) for node in np.unique(mesh.face_node)]
    assert [len(n) for n in nodes] == [12, 12]
    boxes = {
        tuple(np.round(np.concatenate([corners[n].min((0, 1)), corners[n].max((0, 1))]), 5)) for n in nodes
    }
    assert boxes == {(8, 0, 0, 10, 1, 3), (-1, 0, 0, 0, 2, 6)}
    assert sorted(volume(mesh, n) for n in nodes) == pytest.approx([6, 12], rel=1e-5)
    reference = trimesh.load(path, process=False, force="mesh")
    np.testing.assert_allclose(corners, reference.triangles, atol=1e-5)


def test_primitives_of_a_node_share_its_number_and_keep_their_materials(
    tmp_path: Path, plugins: Plugins
) -> None:
    header = gltf(*box((0, 0, 0), (1, 1, 1)))
    first = header["meshes"][0]["primitives"][0]
    header["meshes"][0]["primitives"] = [
        first | {"material": 1},
        first | {"material": 0},
        first | {"material": 1},
    ]
    header["materials"] = [
        {
            "name": "paint",
            "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5], "metallicFactor": 0.25},
        },
        {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 0.2]}, "alphaMode": "BLEND"},
    ]
    mesh = read(save_gltf(tmp_path / "a.gltf", header), plugins)
    assert mesh.face_node is not None
    assert len(np.unique(mesh.face_node)) == 1
    looks = [mesh.materials[i] for i in mesh.face_material[[0, 12, 24]]]
    assert looks[0] is looks[2]
    np.testing.assert_allclose([m.base_color for m in looks[:2]], [(0, 0, 1, 0.2), (1, 0, 0, 1)], atol=0.01)
    assert [(m.metallic, m.roughness) for m in looks[:2]] == [(1.0, 1.0), (0.25, 1.0)]
    assert len({m.name for m in mesh.materials}) == 2


def test_normals_of_the_file_are_kept_and_turned(tmp_path: Path, plugins: Plugins) -> None:
    slanted = np.tile([0.6, 0.0, 0.8], (4, 1))
    header = gltf(SQUARE, SQUARE_FACES, NORMAL=slanted * 7)
    header["nodes"][0]["scale"] = [1, 1, 0.5]
    mesh = read(save_gltf(tmp_path / "a.gltf", header), plugins)
    expected = np.array([0.6, 0.0, 1.6]) / np.hypot(0.6, 1.6)  # by the inverse of the scale
    np.testing.assert_allclose(mesh.normals, np.tile([expected[0], -expected[2], 0], (4, 1)), atol=1e-6)
    bare = save_gltf(tmp_path / "b.gltf", gltf(SQUARE, SQUARE_FACES))
    assert plugins.manager.hook.load_mesh(path=bare).normals is None


def test_coincident_and_flat_faces_stay(tmp_path: Path, plugins: Plugins) -> None:
    faces = [[0, 1, 2], [0, 1, 2], [0, 0, 1], [0, 2, 3]]
    mesh = read(save_gltf(tmp_path / "a.gltf", gltf(SQUARE, faces)), plugins)
    np.testing.assert_allclose(
        mesh.triangles, (SQUARE[:, [0, 2, 1]] - (0.5, 0, 0))[np.array(faces)], atol=1e-7
    )


# Looks


@pytest.mark.parametrize("kind", ["PNG", "JPEG"])
def test_gltf_texture_is_upright(kind: str, tmp_path: Path, plugins: Plugins) -> None:
    (tmp_path / "wood panel.img").write_bytes(corners_picture(kind))
    mesh = read(save_gltf(tmp_path / "a.gltf", textured_square("wood%20panel.img")), plugins)
    assert_picture_upright(mesh, (0, 2))
    assert (mesh.materials[0].base_color_image.png == corners_picture(kind)) == (kind == "PNG")
    assert mesh.materials[0].name == "paint"


def test_vertex_colours_of_a_glb_are_kept(tmp_path: Path, plugins: Plugins) -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    colors = np.random.default_rng(0).integers(0, 255, (8, 4)).astype(np.uint8)
    path = tmp_path / "a.glb"
    trimesh.Trimesh(vertices, faces, vertex_colors=colors, process=False).export(path)
    mesh = read(path, plugins)
    np.testing.assert_array_equal(mesh.colors[mesh.faces], colors[faces])
    assert mesh.materials[0].base_color == (1, 1, 1, 1)


def test_white_vertex_colours_beside_a_texture_are_dropped(tmp_path: Path, plugins: Plugins) -> None:
    header = textured_square(data_uri(corners_picture()))
    plain = gltf(SQUARE, SQUARE_FACES, TEXCOORD_0=SQUARE[:, :2], COLOR_0=np.ones((4, 4)))
    for key in ("accessors", "bufferViews", "buffers"):
        header[key] = plain[key]
    header["meshes"][0]["primitives"][0] |= plain["meshes"][0]["primitives"][0]
    mesh = read(save_gltf(tmp_path / "a.gltf", header), plugins)
    assert mesh.colors is None
    assert mesh.materials[0].base_color_image is not None


def test_pieces_without_colours_are_white_beside_pieces_with(tmp_path: Path, plugins: Plugins) -> None:
    scene = trimesh.Scene()
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    red = np.tile(np.array([255, 0, 0, 255], dtype=np.uint8), (8, 1))
    scene.add_geometry(trimesh.Trimesh(vertices, faces, vertex_colors=red, process=False), "a")
    material = trimesh.visual.material.PBRMaterial(name="green", baseColorFactor=[0, 255, 0, 255])
    look = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
    scene.add_geometry(trimesh.Trimesh(vertices + 2, faces, visual=look, process=False), "b")
    scene.export(tmp_path / "a.glb")
    mesh = read(tmp_path / "a.glb", plugins)
    shown = {
        (mesh.materials[m].base_color[:3], tuple(mesh.colors[f[0]].tolist()))
        for m, f in zip(mesh.face_material, mesh.faces, strict=True)
    }
    assert shown == {((1, 1, 1), (255, 0, 0, 255)), ((0, 1, 0), (255, 255, 255, 255))}


def test_face_colours_of_a_ply_stay_on_their_faces(tmp_path: Path, plugins: Plugins) -> None:
    (tmp_path / "a.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"
    )
    mesh = read(tmp_path / "a.ply", plugins)
    assert mesh.colors[mesh.faces].tolist() == [[[255, 0, 0, 255]] * 3, [[0, 0, 255, 255]] * 3]


def test_opacity_of_a_picture_counts_only_where_the_material_says_so(
    tmp_path: Path, plugins: Plugins
) -> None:
    Pillow.fromarray(np.full((4, 4, 4), 99, dtype=np.uint8)).save(tmp_path / "a.png")
    opaque = read(save_gltf(tmp_path / "a.gltf", textured_square("a.png")), plugins)
    glass = read(save_gltf(tmp_path / "b.gltf", textured_square("a.png", alphaMode="BLEND")), plugins)
    alphas = [m.materials[0].base_color_image.pixels[0, 0, 3] for m in (opaque, glass)]
    assert alphas == [255, 99]


def test_a_damaged_texture_is_told_and_the_rest_is_read(tmp_path: Path, plugins: Plugins) -> None:
    (tmp_path / "a.png").write_bytes(corners_picture()[:60])
    mesh = read(save_gltf(tmp_path / "a.gltf", textured_square("a.png")), plugins)
    assert mesh.materials[0].base_color_image is None
    (warning,) = warnings(mesh)
    assert "'paint'" in warning


# Real files


@needs_data
@pytest.mark.parametrize(
    ("name", "height", "nodes"), [("painted_wooden_cabinet", 1.18, 5), ("painted_wooden_cabinet_02", 2.57, 3)]
)
def test_poly_haven_cabinets(name: str, height: float, nodes: int, plugins: Plugins) -> None:
    mesh = read(DATA / "polyhaven" / f"{name}_1k.gltf", plugins)
    assert mesh.bounds[0][2] == pytest.approx(0, abs=1e-9)
    assert mesh.bounds[1][2] == pytest.approx(height, abs=0.005)
    assert mesh.face_node is not None
    assert len(np.unique(mesh.face_node)) == nodes
    (material,) = mesh.materials
    assert None not in (material.base_color_image, material.metallic_roughness_image, material.normal_image)
    assert len(mesh.faces) == len(np.load(DATA / name / "gt.npz")["face_part"])


@needs_data
@pytest.mark.parametrize("case", sorted(p.parent.name for p in DATA.glob("*/input.glb")))
def test_faces_of_the_development_meshes_fit_their_labels(case: str, plugins: Plugins) -> None:
    labels = len(np.load(DATA / case / "gt.npz")["face_part"])
    for path in DATA.glob(f"{case}/input*.glb"):
        source = read_source(path, plugins)
        reference = trimesh.load(path, process=False, force="mesh")
        assert len(source.mesh.faces) == labels
        np.testing.assert_allclose(in_source(source), reference.triangles, atol=1e-5)
        assert source.mesh.colors is not None or source.mesh.materials[0].base_color_image is not None


# Loaders of others


@pytest.mark.parametrize(
    ("result", "said"), [(KeyError("oh"), "KeyError: 'oh'"), ("text", "str, not a Mesh")]
)
def test_a_loader_of_others_that_misbehaves_is_told(result: object, said: str, tmp_path: Path) -> None:
    class Loader:
        @hookimpl
        def load_mesh(self, path: Path) -> object:
            if isinstance(result, Exception):
                raise result
            return result

    plugins = Plugins(installed=False)
    plugins.register(Loader())
    (tmp_path / "a.xyz").write_text("1 2 3")
    with pytest.raises(PluginError, match=said):
        read_source(tmp_path / "a.xyz", plugins)


def test_glb_with_its_data_in_the_header_is_read(tmp_path: Path, plugins: Plugins) -> None:
    mesh = read(save_glb(tmp_path / "a.glb", gltf(*box((0, 0, 0), (1, 1, 1)))), plugins)
    assert volume(mesh) == pytest.approx(1)
