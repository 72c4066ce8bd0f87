"""What is read from USD: the meshes that a renderer would show, where it shows them, and their looks."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as Pillow
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdUtils, Vt

from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import box

from .mesh_files import SQUARE, corners_picture
from .test_loading import assert_picture_upright, in_source, volume, warnings

FLOAT2S, FLOAT3S = Sdf.ValueTypeNames.TexCoord2fArray, Sdf.ValueTypeNames.Color3fArray


@pytest.fixture(scope="module")
def plugins() -> Plugins:
    return Plugins(installed=False, load=())


def new_stage(path: Path, up: str = "Z", metres: float = 1.0) -> Usd.Stage:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/top").GetPrim())
    return stage


def add_mesh(stage: Usd.Stage, path: str, points: Any, polygons: list[list[int]]) -> UsdGeom.Mesh:
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.array(points, dtype=np.float32)))
    mesh.CreateFaceVertexCountsAttr([len(p) for p in polygons])
    mesh.CreateFaceVertexIndicesAttr([int(i) for p in polygons for i in p])
    mesh.CreateSubdivisionSchemeAttr("none")
    return mesh


def add_box(stage: Usd.Stage, path: str, size: tuple[float, float, float]) -> UsdGeom.Mesh:
    vertices, faces = box((0, 0, 0), size)
    return add_mesh(stage, path, vertices, faces.tolist())


def add_square(stage: Usd.Stage) -> UsdGeom.Mesh:
    return add_mesh(stage, "/top/square", SQUARE, [[0, 1, 2, 3]])


def add_material(stage: Usd.Stage, name: str, **values: tuple[Any, Any]) -> tuple[UsdShade.Material, Any]:
    material = UsdShade.Material.Define(stage, f"/top/{name}")
    shader = UsdShade.Shader.Define(stage, f"/top/{name}/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    for key, (kind, value) in values.items():
        shader.CreateInput(key, kind).Set(value)
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    return material, shader


def connect_texture(
    stage: Usd.Stage, shader: Any, socket: str, file: str, channel: str, st: str = "st"
) -> Any:
    parent = shader.GetPath().GetParentPath()
    reader = UsdShade.Shader.Define(stage, parent.AppendChild("coordinates"))
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set(st)
    texture = UsdShade.Shader.Define(stage, parent.AppendChild(f"texture_{socket}"))
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(file)
    texture.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(reader.ConnectableAPI(), "result")
    kind = Sdf.ValueTypeNames.Float3 if channel == "rgb" else Sdf.ValueTypeNames.Float
    texture.CreateOutput(channel, kind)
    shader.CreateInput(socket, kind).ConnectToSource(texture.ConnectableAPI(), channel)
    return texture


def bind(prim: Any, material: UsdShade.Material) -> None:
    UsdShade.MaterialBindingAPI.Apply(prim.GetPrim()).Bind(material)


def set_primvar(mesh: UsdGeom.Mesh, name: str, kind: Any, interpolation: str, values: Any) -> UsdGeom.Primvar:
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(name, kind, interpolation)
    primvar.Set([tuple(float(v) for v in row) for row in values])
    return primvar


def read(stage: Usd.Stage, plugins: Plugins) -> Mesh:
    stage.GetRootLayer().Save()
    return read_source(Path(stage.GetRootLayer().realPath), plugins).mesh


def textured(tmp_path: Path, name: str = "a.usda") -> Usd.Stage:
    """A square with the corners picture, its coordinates a corner each."""
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "corners.png").write_bytes(corners_picture())
    stage = new_stage(tmp_path / name)
    square = add_square(stage)
    set_primvar(square, "map1", FLOAT2S, "faceVarying", SQUARE[:, :2])
    material, shader = add_material(stage, "paint")
    connect_texture(stage, shader, "diffuseColor", "./textures/corners.png", "rgb", st="map1")
    bind(square, material)
    return stage


# Geometry


@pytest.mark.parametrize("suffix", ["usd", "usda", "usdc"])
@pytest.mark.parametrize(("up", "size"), [("Z", (0.6, 0.4, 0.8)), ("Y", (0.6, 0.8, 0.4))])
def test_unit_and_up_axis(
    suffix: str, up: str, size: tuple[float, ...], tmp_path: Path, plugins: Plugins
) -> None:
    stage = new_stage(tmp_path / f"a.{suffix}", up, 0.01)
    add_box(stage, "/top/box", (60, 40, 80))
    mesh = read(stage, plugins)
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), size, rtol=1e-6)
    assert volume(mesh) == pytest.approx(0.192, rel=1e-5)


def test_transforms_references_and_instances(tmp_path: Path, plugins: Plugins) -> None:
    part = new_stage(tmp_path / "part.usda")
    add_box(part, "/top/box", (1, 2, 3))
    part.GetRootLayer().Save()
    stage = new_stage(tmp_path / "a.usda")
    for name, move, scale in (("a", (10, 0, 0), (1, 1, 1)), ("b", (0, 0, 5), (-1, 1, 2))):
        node = UsdGeom.Xform.Define(stage, f"/top/{name}")
        node.AddTranslateOp().Set(Gf.Vec3d(*move))
        node.AddScaleOp().Set(Gf.Vec3f(*scale))
        node.GetPrim().GetReferences().AddReference("./part.usda")
        node.GetPrim().SetInstanceable(True)
    stage.GetRootLayer().Save()
    source = read_source(tmp_path / "a.usda", plugins)
    assert source.mesh.face_node is not None
    assert source.mesh.face_node.tolist() == [0] * 12 + [1] * 12
    corners = in_source(source)
    np.testing.assert_allclose([corners[:12].min((0, 1)), corners[:12].max((0, 1))], [(10, 0, 0), (11, 2, 3)])
    np.testing.assert_allclose([corners[12:].min((0, 1)), corners[12:].max((0, 1))], [(-1, 0, 5), (0, 2, 11)])
    assert [volume(source.mesh, slice(0, 12)), volume(source.mesh, slice(12, 24))] == pytest.approx([6, 12])


def test_point_instancers(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    instancer = UsdGeom.PointInstancer.Define(stage, "/top/many")
    instancer.AddTranslateOp().Set(Gf.Vec3d(0, 0, 100))
    for name, size in (("small", (1, 1, 1)), ("large", (2, 2, 2))):
        UsdGeom.Xform.Define(stage, f"/top/many/{name}").AddTranslateOp().Set(Gf.Vec3d(0, 7, 0))
        add_box(stage, f"/top/many/{name}/box", size)
        instancer.GetPrototypesRel().AddTarget(f"/top/many/{name}")
    instancer.CreateProtoIndicesAttr([0, 1, 0])
    instancer.CreatePositionsAttr([Gf.Vec3f(0, 0, 0), Gf.Vec3f(10, 0, 0), Gf.Vec3f(20, 0, 0)])
    instancer.DeactivateId(2)
    stage.GetRootLayer().Save()
    corners = in_source(read_source(tmp_path / "a.usda", plugins))
    found = [(c.min((0, 1)).round(4).tolist(), c.max((0, 1)).round(4).tolist()) for c in np.split(corners, 2)]
    assert found == [([0, 7, 100], [1, 8, 101]), ([10, 7, 100], [12, 9, 102])]


def test_what_is_not_shown_is_not_read(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    add_box(stage, "/top/seen", (1, 1, 1))
    add_box(stage, "/top/guide", (2, 2, 2)).CreatePurposeAttr("guide")
    add_box(stage, "/top/proxy", (2, 2, 2)).CreatePurposeAttr("proxy")
    UsdGeom.Xform.Define(stage, "/top/hidden").MakeInvisible()
    add_box(stage, "/top/hidden/box", (2, 2, 2))
    add_box(stage, "/top/off", (2, 2, 2)).GetPrim().SetActive(False)
    UsdGeom.Sphere.Define(stage, "/top/ball")
    mesh = read(stage, plugins)
    assert np.ptp(mesh.vertices, axis=0).max() == pytest.approx(1)
    (warning,) = warnings(mesh)
    assert "Sphere" in warning


def test_polygons_and_left_handed_meshes(tmp_path: Path, plugins: Plugins) -> None:
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    stage = new_stage(tmp_path / "a.usda")
    vertices, _ = box((0, 0, 0), (1, 1, 1))
    add_mesh(stage, "/top/right", vertices, quads)
    left = add_mesh(stage, "/top/left", vertices + 5, [q[::-1] for q in quads])
    left.CreateOrientationAttr("leftHanded")
    pentagon = [(np.cos(a), np.sin(a), 0) for a in np.linspace(0, 2 * np.pi, 5, endpoint=False)]
    add_mesh(stage, "/top/pentagon", pentagon, [[0, 1, 2, 3, 4]])
    mesh = read(stage, plugins)
    assert [int((mesh.face_node == n).sum()) for n in range(3)] == [12, 12, 3]
    assert [volume(mesh, mesh.face_node == n) for n in range(2)] == pytest.approx([1, 1], rel=1e-4)
    area = mesh.face_areas[mesh.face_node == 2].sum()
    assert area == pytest.approx(2.5 * np.sin(2 * np.pi / 5), rel=1e-5)


def test_normals_a_corner_split_vertices_only_where_they_differ(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    roof = add_mesh(
        stage, "/top/roof", [(0, 0, 0), (0, 1, 0), (1, 0, 1), (1, 1, 1), (2, 0, 0), (2, 1, 0)],
        [[0, 2, 3, 1], [2, 4, 5, 3]],
    )  # fmt: skip
    roof.CreateNormalsAttr([Gf.Vec3f(-1, 0, 1)] * 4 + [Gf.Vec3f(1, 0, 1)] * 4)
    roof.SetNormalsInterpolation("faceVarying")
    mesh = read(stage, plugins)
    assert len(mesh.vertices) == 8
    np.testing.assert_allclose(mesh.normals[mesh.faces].mean(axis=1), mesh.face_normals, atol=1e-6)
    roof.SetNormalsInterpolation("vertex")
    roof.GetNormalsAttr().Set([Gf.Vec3f(0, 0, 1)] * 6)
    assert len(read(stage, plugins).vertices) == 6


def test_a_primvar_that_does_not_fit_is_told_and_left_out(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    set_primvar(add_square(stage), "st", FLOAT2S, "vertex", SQUARE[:3, :2])
    mesh = read(stage, plugins)
    assert mesh.uv is None
    (warning,) = warnings(mesh)
    assert "primvars:st" in warning


# Looks


def test_texture_is_upright(tmp_path: Path, plugins: Plugins) -> None:
    stage = textured(tmp_path)
    assert_picture_upright(read(stage, plugins), (0, 1))


def test_texture_inside_a_usdz(tmp_path: Path, plugins: Plugins) -> None:
    stage = textured(tmp_path)
    stage.GetRootLayer().Save()
    package = tmp_path / "elsewhere" / "a.usdz"
    package.parent.mkdir()
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "a.usda"), str(package))
    assert_picture_upright(read_source(package, plugins).mesh, (0, 1))


def test_values_of_a_preview_surface(tmp_path: Path, plugins: Plugins) -> None:
    kinds = Sdf.ValueTypeNames
    stage = new_stage(tmp_path / "a.usda")
    square = add_square(stage)
    material, _ = add_material(
        stage, "steel",
        diffuseColor=(kinds.Color3f, (0.1, 0.2, 0.3)), metallic=(kinds.Float, 0.75),
        roughness=(kinds.Float, 0.25), opacity=(kinds.Float, 0.5),
    )  # fmt: skip
    bind(square, material)
    set_primvar(square, "displayColor", FLOAT3S, "constant", [(1, 0, 0)])  # the material wins
    (look,) = read(stage, plugins).materials
    assert (look.name, look.metallic, look.roughness) == ("steel", 0.75, 0.25)
    np.testing.assert_allclose(look.base_color, (0.1, 0.2, 0.3, 0.5), atol=1e-6)


def test_metallic_and_roughness_pictures_become_one(tmp_path: Path, plugins: Plugins) -> None:
    for name, value, size in (("metal", 200, 8), ("rough", 90, 4)):
        Pillow.fromarray(np.full((size, size), value, dtype=np.uint8)).save(tmp_path / f"{name}.png")
    stage = textured(tmp_path)
    shader = UsdShade.Shader.Get(stage, "/top/paint/surface")
    connect_texture(stage, shader, "metallic", "./metal.png", "r")
    connect_texture(stage, shader, "roughness", "./rough.png", "r")
    (look,) = read(stage, plugins).materials
    assert look.metallic_roughness_image is not None
    assert look.metallic_roughness_image.pixels[0, 0, 1:3].tolist() == [90, 200]
    assert (look.metallic, look.roughness) == (1, 1)


def test_materials_of_subsets(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    mesh = add_mesh(stage, "/top/strip", [(x, y, 0) for x in range(4) for y in (0, 1)],
                    [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5]])  # fmt: skip
    color = Sdf.ValueTypeNames.Color3f
    red, _ = add_material(stage, "red", diffuseColor=(color, (1, 0, 0)))
    blue, _ = add_material(stage, "blue", diffuseColor=(color, (0, 0, 1)))
    bind(mesh, red)
    subset = UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).CreateMaterialBindSubset("middle", [1])
    bind(subset, blue)
    loaded = read(stage, plugins)
    assert [loaded.materials[m].name for m in loaded.face_material] == ["red"] * 2 + ["blue"] * 2 + [
        "red"
    ] * 2


def test_display_colors(tmp_path: Path, plugins: Plugins) -> None:
    stage = new_stage(tmp_path / "a.usda")
    square = add_square(stage)
    set_primvar(square, "displayColor", FLOAT3S, "vertex", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0.5, 0.5)])
    mesh = read(stage, plugins)
    colors = {tuple(v[:2].round(3)): c.tolist() for v, c in zip(mesh.vertices, mesh.colors, strict=True)}
    assert colors[-0.5, -0.5] == [255, 0, 0, 255]
    assert colors[-0.5, 0.5] == [188, 188, 188, 255]  # half the light is 0.735 of sRGB
    assert mesh.materials[0].base_color == (1, 1, 1, 1)
    set_primvar(square, "displayColor", FLOAT3S, "constant", [(0.25, 0.5, 1)])
    mesh = read(stage, plugins)
    assert mesh.colors is None
    assert mesh.materials[0].base_color == (0.25, 0.5, 1, 1)


def test_a_missing_texture_is_told_and_the_rest_is_read(
    tmp_path: Path, plugins: Plugins, capfd: pytest.CaptureFixture[str]
) -> None:
    stage = textured(tmp_path)
    (tmp_path / "textures" / "corners.png").unlink()
    mesh = read(stage, plugins)
    assert mesh.materials[0].base_color_image is None
    assert any("./textures/corners.png" in text for text in warnings(mesh))
    assert capfd.readouterr() == ("", "")
