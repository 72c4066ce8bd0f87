"""The ray-cast renderer, checked against geometry that is known by hand."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.camera import Camera, framed, isometric
from simart_kit.drawing import lit_mesh
from simart_kit.kinematics import rest_to_posed
from simart_kit.mesh import Image, Mesh, VisualMaterial
from simart_kit.normals import with_normals
from simart_kit.posing import PosableMesh
from simart_kit.render import face_ids, isometric_view, render, rest_caster
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, cabinet_mesh, chain_asset

UNIT_BOX = ((-0.5, -0.5, 0.0), (0.5, 0.5, 1.0))
# Orthographic, from the front; the picture is 2 m wide and high, its middle (0, 0, 0.5).
AHEAD = Camera((0.0, -5.0, 0.5), (0.0, 0.0, 0.5), 2.0, perspective=False)
SIZE = 64


def coloured(mesh: Mesh, *factors: tuple[float, float, float, float]) -> Mesh:
    """The mesh with plain materials, one for each 12 faces of a box."""
    materials = tuple(VisualMaterial(f"m{i}", f) for i, f in enumerate(factors))
    return replace(mesh, materials=materials, face_material=np.arange(len(mesh.faces)) // 12)


def upright_quad(texture: np.ndarray, y: float = 0.0, repeat: float = 1.0) -> Mesh:
    """A 1 x 1 m square that faces the front, its texture upright."""
    uv = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    vertices = np.column_stack([uv[:, 0] - 0.5, np.full(4, y), uv[:, 1]])
    material = VisualMaterial("picture", (1.0,) * 4, base_color_image=Image.from_pixels(texture))
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]), uv=uv * repeat, materials=(material,))


def blocks(*colors: tuple[int, ...]) -> np.ndarray:
    """An 8 x 8 picture of four colours: top left, top right, bottom left, bottom right."""
    small = np.array(colors, dtype=np.uint8).reshape(2, 2, -1)
    return small.repeat(4, axis=0).repeat(4, axis=1)


def dominant(pixel: np.ndarray) -> int:
    return int(np.argmax(pixel[:3]))


def test_a_red_box_straight_ahead_is_red_in_the_middle_and_white_around() -> None:
    mesh = coloured(boxes_mesh([UNIT_BOX]), (0.8, 0.0, 0.0, 1.0))

    picture = render(mesh, AHEAD, SIZE, SIZE)

    assert picture.shape == (SIZE, SIZE, 4)
    assert picture.dtype == np.uint8
    assert picture[32, 32, 0] > 150
    assert (picture[32, 32, 1:3] == 0).all()
    # The box spans half of the picture: pixels 16 to 47.
    assert (picture[[2, 2, 61, 32, 32], [2, 32, 61, 14, 49]] == 255).all()
    assert (picture[32, [17, 46], 1] == 0).all()


def test_texture_corners_appear_where_they_should() -> None:
    texture = blocks((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255))

    picture = render(upright_quad(texture), AHEAD, SIZE, SIZE)

    assert dominant(picture[22, 22]) == 0, "top left is red"
    assert dominant(picture[22, 42]) == 1, "top right is green"
    assert dominant(picture[42, 22]) == 2, "bottom left is blue"
    assert np.ptp(picture[42, 42, :3].astype(int)) < 12, "bottom right is white"
    assert picture[22, 22, 1] < 20


def test_textures_repeat() -> None:
    texture = blocks((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255))

    picture = render(upright_quad(texture, repeat=2.0), AHEAD, SIZE, SIZE)

    # Each repetition is 16 pixels wide: red lies at the top left of every one.
    assert [dominant(picture[r, c]) for r in (20, 36) for c in (20, 36)] == [0, 0, 0, 0]


def test_base_colour_multiplies_the_texture_in_linear_light() -> None:
    quad = upright_quad(np.full((4, 4, 3), 255, np.uint8))
    plain = render(coloured_like(quad, 0.2), AHEAD, SIZE, SIZE)[32, 32, :3]
    # 0.2 in linear light is sRGB 124: the same surface by texture instead of by factor.
    grey = render(upright_quad(np.full((4, 4, 3), 124, np.uint8)), AHEAD, SIZE, SIZE)[32, 32, :3]

    assert np.abs(plain.astype(int) - grey).max() <= 1


def coloured_like(mesh: Mesh, factor: float) -> Mesh:
    return replace(mesh, materials=(replace(mesh.materials[0], base_color=(factor, factor, factor, 1.0)),))


def test_vertex_colours_are_shown() -> None:
    mesh = boxes_mesh([UNIT_BOX])
    colors = np.tile(np.array([[20, 20, 220, 255]], np.uint8), (len(mesh.vertices), 1))

    picture = render(replace(mesh, colors=colors), AHEAD, SIZE, SIZE)

    assert dominant(picture[32, 32]) == 2


def test_large_textures_are_averaged_where_they_are_small() -> None:
    noise = np.random.default_rng(0).integers(0, 2, (512, 512, 1)) * 255
    texture = np.tile(noise, (1, 1, 3)).astype(np.uint8)

    inside = render(upright_quad(texture), AHEAD, SIZE, SIZE)[18:46, 18:46, 0]

    # A pixel covers 16 x 16 texels, black or white by chance: their mean varies by 1/32 of the range.
    assert inside.std() < 15


@pytest.mark.parametrize("perspective", [False, True])
def test_silhouette_of_a_sphere_has_the_analytic_area(perspective: bool) -> None:
    radius, distance, view_height, size = 0.4, 2.0, 1.2, 200
    ball = trimesh.creation.icosphere(subdivisions=4, radius=radius)
    camera = Camera((0.0, -distance, 0.0), (0.0, 0.0, 0.0), view_height, perspective)

    picture = render(Mesh(ball.vertices, ball.faces), camera, size, size, background=None)

    area = picture[..., 3].sum() / 255 * (view_height / size) ** 2
    # In perspective the rim lies where rays touch the sphere: tan = r / sqrt(d^2 - r^2).
    seen = distance * radius / np.sqrt(distance**2 - radius**2) if perspective else radius
    assert area == pytest.approx(np.pi * seen**2, rel=0.01)


def test_ids_name_the_face_at_each_pixel() -> None:
    mesh = boxes_mesh([UNIT_BOX])
    camera = framed(mesh.vertices, 0.6, 0.5)

    ids = face_ids(mesh, camera, 120, 90)

    centers = mesh.triangles.mean(axis=1)
    toward = np.einsum("ij,ij->i", mesh.face_normals, np.array(camera.position) - centers) > 0
    columns, rows = camera.project(centers, 120, 90).astype(int).T
    assert toward.sum() == 6
    np.testing.assert_array_equal(ids[rows, columns][toward], np.flatnonzero(toward))
    assert set(np.unique(ids)) == {-1, *np.flatnonzero(toward)}
    assert ids.dtype == np.int32


def test_what_stands_in_front_hides_what_is_behind() -> None:
    mesh = boxes_mesh([((-0.2, 1.0, 0.3), (0.2, 1.2, 0.7)), UNIT_BOX])
    mesh = coloured(mesh, (0.8, 0.0, 0.0, 1.0), (0.0, 0.8, 0.0, 1.0))

    picture, ids = render(mesh, AHEAD, SIZE, SIZE), face_ids(mesh, AHEAD, SIZE, SIZE)

    assert not (picture[..., 0].astype(int) > picture[..., 1].astype(int) + 5).any()
    assert ids.max() >= 12
    assert not ((ids >= 0) & (ids < 12)).any()


def test_rays_pass_through_holes_of_a_texture() -> None:
    # The upper half of the front square is cut out.
    texture = blocks((255, 0, 0, 0), (255, 0, 0, 0), (255, 0, 0, 255), (255, 0, 0, 255))
    front, back = upright_quad(texture), upright_quad(np.full((2, 2, 3), (0, 0, 255), np.uint8), y=0.5)
    mesh = Mesh(
        np.concatenate([front.vertices, back.vertices]),
        np.concatenate([front.faces, back.faces + 4]),
        uv=np.concatenate([front.uv, back.uv]),
        materials=front.materials + back.materials,
        face_material=np.array([0, 0, 1, 1]),
    )

    picture, ids = render(mesh, AHEAD, SIZE, SIZE), face_ids(mesh, AHEAD, SIZE, SIZE)

    assert (dominant(picture[24, 32]), dominant(picture[40, 32])) == (2, 0)
    assert ids[24, 20] in (2, 3)
    assert ids[40, 20] in (0, 1)
    assert face_ids(front, AHEAD, SIZE, SIZE)[24, 20] == -1


def test_glass_shows_what_is_behind_it_and_itself() -> None:
    boxes = boxes_mesh([UNIT_BOX, ((-0.2, 1.0, 0.3), (0.2, 1.2, 0.7))])
    mesh = coloured(boxes, (0.0, 0.0, 0.8, 0.3), (0.8, 0.0, 0.0, 1.0))

    picture, ids = render(mesh, AHEAD, SIZE, SIZE), face_ids(mesh, AHEAD, SIZE, SIZE)

    middle, beside = picture[32, 32].astype(int), picture[20, 32].astype(int)
    assert middle[0] > middle[1] + 40, "red behind the glass is seen"
    assert middle[2] > middle[1] + 20, "the glass tints it"
    assert beside[2] > beside[0] > 100, "white behind the glass becomes bluish"
    assert ids[32, 32] < 12, "a pane can be pointed at"


def test_faces_are_lit_from_both_sides() -> None:
    quad = upright_quad(np.full((2, 2, 3), 200, np.uint8))

    front, back = (render(m, AHEAD, SIZE, SIZE)[32, 32, 0] for m in (quad, flipped(quad)))

    assert front == back
    assert front > 120


def flipped(mesh: Mesh) -> Mesh:
    return replace(mesh, faces=mesh.faces[:, ::-1])


def test_the_key_light_comes_from_the_left_of_the_camera_and_throws_shadows() -> None:
    mesh = boxes_mesh([((-1.0, -1.0, -0.1), (1.0, 1.0, 0.0)), ((-0.1, -0.1, 0.0), (0.1, 0.1, 0.5))])
    camera = isometric(mesh.bounds, "right")
    # Light falls towards (-0.24, 0.97): two points as far from the post, one in its shadow, one before it;
    # and two sides of the post that see as much of the sky as each other.
    points = [[-0.08, 0.34, 0.0], [0.08, -0.34, 0.0], [0.0, -0.1, 0.25], [0.1, 0.0, 0.25]]

    columns, rows = camera.project(points, 400, 400).astype(int).T
    shadow, before, left, right = render(mesh, camera, 400, 400)[rows, columns, 0].astype(int)

    assert shadow < before - 40
    assert right < left - 30


def test_the_ground_is_darker_beside_the_object_and_untouched_far_away() -> None:
    mesh = boxes_mesh([UNIT_BOX])
    camera = Camera((0.0, -6.0, 3.0), (0.0, 0.0, 0.5), 8.0)
    background = (240, 242, 245)

    picture = render(mesh, camera, 160, 160, ground=0.0, background=background)

    # The key light stands left of the camera: the shadow falls to the right and to the back.
    columns, rows = camera.project([[0.8, 0.6, 0.0], [-2.5, -2.0, 0.0]], 160, 160).astype(int).T
    shadow, open_ground = picture[rows, columns, :3].astype(int)
    assert (shadow < np.array(background) - 12).all()
    assert (open_ground <= np.array(background)).all()
    assert (shadow < open_ground - 8).all()
    np.testing.assert_array_equal(picture[0, 0], [*background, 255])


def test_paint_colours_faces_and_keeps_their_texture() -> None:
    mesh = upright_quad(blocks((230,) * 3, (60,) * 3, (230,) * 3, (60,) * 3))

    picture = render(mesh, AHEAD, SIZE, SIZE, paint=np.tile([0.0, 0.2, 1.0, 0.7], (2, 1))).astype(int)

    bright, dark = picture[32, 22], picture[32, 42]
    assert bright[2] > bright[0] + 40
    assert dark[2] > dark[0] + 40
    assert bright.sum() > dark.sum() + 60


def test_pictures_do_not_depend_on_how_many_rows_are_cast_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = cabinet_mesh()
    camera = framed(mesh.vertices, -0.5, 0.4)
    whole = render(mesh, camera, 90, 70, ground=0.0)

    monkeypatch.setattr(lit_mesh, "_RAYS_AT_ONCE", 90 * 4 * 8)

    np.testing.assert_array_equal(render(mesh, camera, 90, 70, ground=0.0), whole)


def test_mesh_without_normals_and_with_computed_ones_look_alike() -> None:
    mesh = cabinet_mesh()
    camera = framed(mesh.vertices, -0.5, 0.4)

    np.testing.assert_array_equal(render(mesh, camera, 50, 50), render(with_normals(mesh), camera, 50, 50))


@pytest.mark.parametrize("perspective", [False, True])
@pytest.mark.parametrize("elevation", [-0.4, 0.3, np.pi / 2])
def test_project_inverts_rays(perspective: bool, elevation: float) -> None:
    camera = framed(cabinet_mesh().vertices, 0.7, elevation, perspective=perspective)
    pixels = np.random.default_rng(0).uniform(0, 100, (50, 2))

    origins, directions = camera.rays(pixels, 120, 100)

    np.testing.assert_allclose(camera.project(origins + 2.5 * directions, 120, 100), pixels, atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0)


@pytest.mark.parametrize("perspective", [False, True])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.0])
def test_framed_camera_holds_all_points_and_touches_two_borders(perspective: bool, aspect: float) -> None:
    points = np.random.default_rng(1).normal(size=(200, 3)) * [1.0, 0.3, 2.0]
    camera = framed(points, -0.5, 0.4, aspect=aspect, perspective=perspective, margin=0.1)

    height = 100
    columns, rows = camera.project(points, round(height * aspect), height).T
    left, right = columns.min() / (height * aspect), 1 - columns.max() / (height * aspect)
    top, bottom = rows.min() / height, 1 - rows.max() / height
    assert min(left, right, top, bottom) == pytest.approx(0.1, abs=1e-6)
    assert min(left + right, top + bottom) == pytest.approx(0.2, abs=1e-6)


@pytest.mark.parametrize(("side", "x"), [("left", -1.0), ("right", 1.0)])
def test_isometric_camera_sees_front_top_and_one_side_alike(side: str, x: float) -> None:
    mesh = boxes_mesh([UNIT_BOX])

    ids = face_ids(mesh, isometric(mesh.bounds, side), 200, 200)

    seen = {tuple(np.round(mesh.face_normals[f]).astype(int)): 0 for f in np.unique(ids[ids >= 0])}
    assert set(seen) == {(x, 0, 0), (0, -1, 0), (0, 0, 1)}
    areas = [(mesh.face_normals[ids[ids >= 0]] @ np.array(n) > 0.5).sum() for n in seen]
    assert max(areas) < 1.02 * min(areas), "an isometric view shortens the three axes alike"


def test_isometric_view_is_252_pixels_on_white() -> None:
    picture = isometric_view(cabinet_mesh())

    assert picture.shape == (252, 252, 3)
    assert (picture[[0, 0, -1, -1], [0, -1, 0, -1]] == 255).all()
    assert 0.2 < (picture < 250).any(axis=2).mean() < 0.8


def test_the_caster_that_pictures_of_an_asset_share_changes_no_pixel() -> None:
    asset = cabinet_asset()

    shared = isometric_view(asset.mesh, 64, caster=rest_caster(asset))

    np.testing.assert_array_equal(shared, isometric_view(asset.mesh, 64))


def test_a_moved_door_changes_the_picture_where_the_door_goes() -> None:
    asset = cabinet_asset(textured=False)
    posable = PosableMesh.of(asset)
    closed, open_ = posable.posed({}), posable.posed({"door_hinge": -1.5})
    camera = framed(np.concatenate([closed.vertices, open_.vertices]), 0.6, 0.4)
    door = asset.part_index("door")

    def shows_door(mesh: Mesh) -> np.ndarray:
        ids = face_ids(mesh, camera, 150, 150)
        return (ids >= 0) & (asset.face_part[ids] == door)

    arrives = shows_door(open_) & ~shows_door(closed)
    before, after = (render(m, camera, 150, 150)[..., :3].astype(int) for m in (closed, open_))

    assert arrives.sum() > 300
    assert (np.abs(after - before).max(axis=2)[arrives] > 3).mean() > 0.95
    where = np.argwhere(shows_door(open_)).mean(axis=0)
    # The far edge of the open door stands before the hinge, 0.55 m to the front.
    expected = camera.project([[-0.275 + 0.275 * np.cos(1.5), -0.19 - 0.275 * np.sin(1.5), 0.27]], 150, 150)
    np.testing.assert_allclose(where[::-1] + 0.5, expected[0], atol=6)


def test_parts_that_share_vertices_are_parted_when_they_move() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
    joint = Joint("slide", "prismatic", "a", "b", axis=(0.0, -1.0, 0.0), limits=Limits(0.0, 0.5))
    mesh = Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))
    asset = Asset("pair", mesh, np.array([0, 1]), (Part("a"), Part("b")), (joint,))

    moved = PosableMesh.of(asset).posed({"slide": 0.5}).triangles

    np.testing.assert_allclose(moved[0], mesh.triangles[0])
    np.testing.assert_allclose(moved[1], mesh.triangles[1] - [0, 0.5, 0])


def test_posed_mesh_follows_forward_kinematics() -> None:
    asset = chain_asset()
    positions = {"post_spin": 1.1, "arm_hinge": -0.4}

    posed = PosableMesh.of(asset).posed(positions)

    for name, posed_T_rest in rest_to_posed(asset, positions).items():
        faces = np.flatnonzero(asset.face_part == asset.part_index(name))
        expected = asset.mesh.triangles[faces] @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3]
        np.testing.assert_allclose(posed.triangles[faces], expected, atol=1e-12)
        np.testing.assert_allclose(posed.normals[posed.faces[faces, 0]], posed.face_normals[faces], atol=1e-6)


def test_importing_the_renderer_imports_neither_pillow_nor_embree() -> None:
    code = (
        "import sys, simart_kit.render, simart_kit.drawing.preview;"
        "print(sorted({'PIL', 'embreex', 'trimesh', 'scipy'} & set(sys.modules)))"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert found.stdout.strip() == "[]"
