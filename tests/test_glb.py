"""The GLB exporter: surfaces, looks and clips, as a reader of our own and trimesh find them."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image as Pillow
from simart_kit_exporters.glb import Glb as GlbExporter

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Limits
from simart_kit.kinematics import forward
from simart_kit.mesh import Image, VisualMaterial
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset

from .export_cases import CASES, with_joint_kind
from .glb_reader import Glb
from .usd_cases import glossy_asset, many_kinds_asset

# Written out: x stays, up becomes y, front (-y) becomes +z.
SCENE_T_ASSET = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
MOVING = {
    "cabinet": cabinet_asset,
    "chain": chain_asset,
    "kinds": many_kinds_asset,
}


def export(asset: Asset, folder: Path, *, physics: bool = False) -> Path:
    folder.mkdir(exist_ok=True)
    return GlbExporter(GlbExporter.Options(experimental_physics=physics)).export(asset, folder)


def in_scene(pose: FloatArray) -> FloatArray:
    """A (4, 4) pose of the asset's frame in the frame of the file; part frames turn with it."""
    return np.asarray(SCENE_T_ASSET @ pose @ SCENE_T_ASSET.T)


def sorted_rows(corners: FloatArray) -> FloatArray:
    rows = np.round(corners.reshape(-1, 9), 5) + 0.0
    return rows[np.lexsort(rows.T)]


@pytest.mark.parametrize("name", CASES)
def test_surfaces_stand_where_the_asset_has_them(name: str, tmp_path: Path) -> None:
    asset = CASES[name]()
    glb = Glb.read(export(asset, tmp_path))
    for index, part in enumerate(asset.parts):
        expected = asset.mesh.triangles[asset.face_part == index] @ SCENE_T_ASSET[:3, :3].T
        assert sorted_rows(glb.triangles(part.name)) == pytest.approx(sorted_rows(expected), abs=2e-5)


def test_trimesh_finds_the_same_tree(tmp_path: Path) -> None:
    asset = chain_asset()
    scene = trimesh.load(export(asset, tmp_path))
    assert scene.graph.transforms.parents["arm"] == "post"
    assert scene.graph.transforms.parents["post"] == "base"
    for part, pose in forward(asset).items():
        np.testing.assert_allclose(scene.graph.get(part)[0], in_scene(pose), atol=1e-6)
    assert scene.to_geometry().area == pytest.approx(asset.mesh.face_areas.sum(), rel=1e-5)


@pytest.mark.parametrize("name", MOVING)
def test_a_clip_moves_its_joint_alone_as_the_asset_does(name: str, tmp_path: Path) -> None:
    asset = MOVING[name]()
    glb = Glb.read(export(asset, tmp_path))
    for clip in glb.json["animations"]:
        told = clip["extras"]
        for time in np.linspace(0.0, told["times"][-1], 23):  # at keys and between them
            position = float(np.interp(time, told["times"], told["positions"]))
            for part, pose in forward(asset, {clip["name"]: position}).items():
                found = glb.poses(clip["name"], float(time))[part]
                np.testing.assert_allclose(found, in_scene(pose), atol=1e-6, err_msg=f"{part} at {time}")


def test_every_joint_of_one_axis_has_a_clip_that_goes_to_both_limits_and_back(tmp_path: Path) -> None:
    glb = Glb.read(export(many_kinds_asset(), tmp_path))
    clips = {clip["name"]: clip["extras"]["positions"] for clip in glb.json["animations"]}
    assert set(clips) == {"slide", "wrist"}  # the others are fixed, or turn about no axis
    assert clips["slide"] == pytest.approx([0.0, 0.4, -0.2, 0.0])
    assert (clips["wrist"][0], clips["wrist"][-1]) == (0.0, 0.0)
    assert (max(clips["wrist"]), min(clips["wrist"])) == (2.0, -1.0)
    assert np.abs(np.diff(clips["wrist"])).max() <= np.pi / 4 + 1e-9


def test_a_continuous_joint_makes_one_full_turn(tmp_path: Path) -> None:
    glb = Glb.read(export(chain_asset(), tmp_path))
    (post,) = [clip for clip in glb.json["animations"] if clip["name"] == "post_spin"]
    assert post["extras"]["positions"] == pytest.approx(np.arange(9) * np.pi / 4)
    output = glb.array(post["samplers"][0]["output"])
    assert np.linalg.norm(output, axis=1) == pytest.approx(1.0)
    assert (np.einsum("ij,ij->i", output[1:], output[:-1]) > 0).all()


def test_a_drawer_comes_forward_and_a_door_swings_out(tmp_path: Path) -> None:
    glb = Glb.read(export(cabinet_asset(), tmp_path))
    assert glb.poses("drawer_slide", 2.0)["drawer"][:3, 3] == pytest.approx([0.0, 0.65, 0.2 + 0.3], abs=1e-6)
    handle = glb.poses("door_hinge", 2.0)["door"] @ [
        0.485,
        0.3,
        0.04,
        1.0,
    ]  # at the door's right edge, in front
    assert handle[2] > 0.6


def test_extras_tell_joints_and_masses_in_the_frame_of_the_file(tmp_path: Path) -> None:
    asset = cabinet_asset()
    glb = Glb.read(export(asset, tmp_path))
    extras = glb.json["nodes"][glb.node("door")]["extras"]
    joint, body = extras["joint"], extras["body"]
    assert (joint["name"], joint["kind"], joint["parent"]) == ("door_hinge", "revolute", "body")
    assert joint["origin"] == pytest.approx([-0.275, 0.0, 0.19])
    assert joint["axis"] == pytest.approx([0.0, 1.0, 0.0])
    assert (joint["limits"], joint["damping"], joint["friction"]) == ([-1.5, 0.0], 0.05, 0.02)
    mass = asset.part("door").mass
    assert mass is not None
    assert body["mass"] == mass.mass
    x, y, z = mass.center
    assert body["center_of_mass"] == pytest.approx([x, z, -y])
    assert body["inertia"][1][1] == pytest.approx(mass.inertia[2][2])
    assert body["inertia"][0][2] == pytest.approx(-mass.inertia[0][1])
    scene = glb.json["scenes"][0]["extras"]
    assert (scene["schema"], scene["units"]["length"], scene["floating"]) == (1, "m", False)


def test_materials_keep_factors_and_all_three_textures(tmp_path: Path) -> None:
    asset = glossy_asset()
    glb = Glb.read(export(asset, tmp_path))
    wood, glass = glb.json["materials"]
    source = asset.mesh.materials[0]
    assert wood["name"] == "Chêne (wood) 01"
    pbr = wood["pbrMetallicRoughness"]
    assert (pbr["metallicFactor"], pbr["roughnessFactor"]) == (0.5, 0.25)
    slots = {
        "base_color_image": pbr["baseColorTexture"],
        "metallic_roughness_image": pbr["metallicRoughnessTexture"],
        "normal_image": wood["normalTexture"],
    }
    for name, slot in slots.items():
        image = glb.json["images"][glb.json["textures"][slot["index"]]["source"]]
        assert image["mimeType"] == "image/png"
        found = Image(glb.view(image["bufferView"]))
        assert np.array_equal(found.pixels, getattr(source, name).pixels), name
    assert "alphaMode" not in wood
    assert glass["alphaMode"] == "BLEND"
    assert glass["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.9, 0.9, 1.0, 0.25])
    (uv,) = {p["attributes"]["TEXCOORD_0"] for p in glb.json["meshes"][0]["primitives"]}
    assert sorted(set(glb.array(uv)[:, 1])) == pytest.approx(
        sorted(set(1.0 - asset.mesh.uv[asset.mesh.faces[:60]][..., 1].ravel()))
    )


def test_vertex_colors_are_linear_light(tmp_path: Path) -> None:
    asset = static_asset()
    colors = np.tile(np.array([255, 128, 0, 255], dtype=np.uint8), (8, 1))
    painted = replace(
        asset.mesh, materials=(VisualMaterial("paint", (1.0, 1.0, 1.0, 1.0)),), uv=None, colors=colors
    )
    glb = Glb.read(export(replace(asset, mesh=painted), tmp_path))
    (primitive,) = glb.json["meshes"][0]["primitives"]
    # sRGB 128 is 0.2158605 in linear light (IEC 61966-2-1).
    found = glb.array(primitive["attributes"]["COLOR_0"])
    assert found == pytest.approx(np.tile([1.0, 0.2158605, 0.0, 1.0], (len(found), 1)), abs=1e-5)
    assert "TEXCOORD_0" not in primitive["attributes"]


@pytest.mark.parametrize(("alpha", "mode"), [(255, None), (0, "MASK"), (100, "BLEND")])
def test_textures_with_holes_are_cut_and_hazy_ones_blended(
    alpha: int, mode: str | None, tmp_path: Path
) -> None:
    asset = static_asset()
    pixels = np.full((2, 2, 4), 255, dtype=np.uint8)
    pixels[0, 0, 3] = alpha
    leaf = VisualMaterial("leaf", base_color_image=Image.from_pixels(pixels))
    glb = Glb.read(export(replace(asset, mesh=replace(asset.mesh, materials=(leaf,))), tmp_path))
    assert glb.json["materials"][0].get("alphaMode") == mode


def test_normal_maps_come_with_tangents_along_u(tmp_path: Path) -> None:
    asset = static_asset()  # u is x / 0.5, v is z / 0.5
    flat = Image.from_pixels(np.full((2, 2, 3), (128, 128, 255), dtype=np.uint8))
    bumpy = replace(asset.mesh.materials[0], normal_image=flat)
    glb = Glb.read(export(replace(asset, mesh=replace(asset.mesh, materials=(bumpy,))), tmp_path))
    (primitive,) = glb.json["meshes"][0]["primitives"]
    normals, tangents = (glb.array(primitive["attributes"][name]) for name in ("NORMAL", "TANGENT"))
    assert np.linalg.norm(tangents[:, :3], axis=1) == pytest.approx(1.0, abs=1e-6)
    assert np.einsum("ij,ij->i", normals, tangents[:, :3]) == pytest.approx(0.0, abs=1e-6)
    for side, mirrored in ((1.0, 1.0), (-1.0, -1.0)):  # seen from behind, the picture is mirrored
        found = tangents[normals[:, 2] * side > 0.9]
        assert len(found) == 4
        assert found == pytest.approx(np.tile([1.0, 0.0, 0.0, mirrored], (4, 1)), abs=1e-6)


def test_open_surfaces_are_drawn_from_both_sides_and_closed_ones_are_not(tmp_path: Path) -> None:
    glb = Glb.read(export(CASES["sheet"](), tmp_path))

    def two_sided(part: str) -> bool:
        (primitive,) = glb.json["meshes"][glb.json["nodes"][glb.node(part)]["mesh"]]["primitives"]
        return bool(glb.json["materials"][primitive["material"]].get("doubleSided", False))

    assert two_sided("flag")
    assert not two_sided("body")
    inside_out = static_asset()
    turned = replace(inside_out.mesh, faces=inside_out.mesh.faces[:, ::-1])
    glb = Glb.read(export(replace(inside_out, mesh=turned), tmp_path))
    assert two_sided("body")


def test_pictures_lose_what_gltf_tells_readers_to_ignore(tmp_path: Path) -> None:
    asset = static_asset()
    picture = asset.mesh.materials[0].base_color_image
    assert picture is not None
    buffer = io.BytesIO()
    Pillow.fromarray(picture.pixels).save(buffer, "PNG", dpi=(300, 72), icc_profile=b"nonsense")
    assert b"iCCP" in buffer.getvalue()
    look = VisualMaterial("framed", base_color_image=Image(buffer.getvalue()))
    glb = Glb.read(export(replace(asset, mesh=replace(asset.mesh, materials=(look,))), tmp_path))
    data = glb.view(glb.json["images"][0]["bufferView"])
    assert b"iCCP" not in data
    assert b"pHYs" not in data
    assert np.array_equal(Image(data).pixels, picture.pixels)


def test_what_has_no_clip_is_told() -> None:
    exporter = GlbExporter(GlbExporter.Options())
    told = " ".join(exporter.unsupported(with_joint_kind("ball")))
    assert "none for: door_hinge" in told
    asset = cabinet_asset()
    stuck = asset.with_joints({"drawer_slide": replace(asset.joint("drawer_slide"), limits=Limits(0.0, 0.0))})
    assert "without travel has no clip: drawer_slide" in " ".join(exporter.unsupported(stuck))
    assert "joints" not in " ".join(exporter.unsupported(static_asset()))
