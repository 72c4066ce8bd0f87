"""Mesh: what it refuses and measures; canonical: the way from a file's frame to ours."""

from dataclasses import replace
from itertools import permutations, product
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.arrays import FloatArray
from simart_kit.errors import BadInputError
from simart_kit.kinematics import rotation
from simart_kit.mesh import Image, Mesh, UpAxis, canonical
from simart_kit.normals import with_normals
from simart_kit.testing.meshes import box, boxes_mesh, cabinet_mesh

CORNERS = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 5]])  # the last is used by no face
FACE = np.array([[0, 1, 2]])
UP_AXES: tuple[UpAxis, ...] = get_args(UpAxis)
vectors = st.tuples(*[st.floats(-3, 3)] * 3).map(np.array)


def direction(axis: str) -> FloatArray:
    return np.asarray(np.eye(3)["xyz".index(axis[1])] * (1.0 if axis[0] == "+" else -1.0))


class TestMesh:
    @pytest.mark.parametrize(
        ("change", "said"),
        [
            ({"faces": np.zeros((0, 3), dtype=int)}, "no faces: export it with triangles"),
            ({"faces": [[0, 1, 4]]}, "face index 4 is out of range: the mesh has 4 vertices"),
            ({"faces": [[0, 1, -1]]}, "face index -1 is out of range"),
            ({"faces": [[0, 1, 2, 3]]}, r"faces has shape \(1, 4\), expected \(1, 3\)"),
            ({"faces": [0, 1, 2]}, r"faces has shape \(3,\)"),
            ({"vertices": np.zeros((4, 2))}, r"vertices has shape \(4, 2\), expected \(4, 3\)"),
            ({"vertices": np.zeros((0, 3))}, "face index 2 is out of range: the mesh has 0 vertices"),
            ({"vertices": CORNERS * [1, np.nan, 1]}, "4 of 4 vertices are NaN or infinite"),
            ({"vertices": np.where(CORNERS == 5, np.inf, CORNERS)}, "1 of 4 vertices are NaN or infinite"),
            ({"normals": np.zeros((3, 3))}, r"normals has shape \(3, 3\), expected \(4, 3\)"),
            ({"normals": np.full((4, 3), np.nan)}, "normals holds values that are NaN"),
            ({"uv": np.zeros((4, 3))}, r"uv has shape \(4, 3\), expected \(4, 2\)"),
            ({"uv": np.full((4, 2), np.inf)}, "uv holds values that are NaN or infinite"),
            ({"colors": np.zeros((4, 3))}, r"colors has shape \(4, 3\), expected \(4, 4\)"),
            ({"face_material": [0, 0]}, r"face_material has shape \(2,\), expected \(1,\)"),
            ({"face_material": [1]}, r"face_material must lie in 0\.\.0"),
            ({"face_material": [-1]}, r"face_material must lie in 0\.\.0"),
            ({"face_node": [[0]]}, r"face_node has shape \(1, 1\), expected \(1,\)"),
            ({"up": "z"}, r"up axis 'z': use one of \+x, -x, \+y, -y, \+z, -z"),
        ],
    )
    def test_what_it_refuses(self, change: dict[str, Any], said: str) -> None:
        with pytest.raises(BadInputError, match=said):
            Mesh(**{"vertices": CORNERS, "faces": FACE, **change})

    def test_measures(self) -> None:
        mesh = Mesh(CORNERS, FACE)
        np.testing.assert_array_equal(mesh.triangles, CORNERS[None, :3])
        np.testing.assert_array_equal(mesh.face_areas, [1.0])
        np.testing.assert_array_equal(mesh.face_normals, [[0, 0, 1]])
        np.testing.assert_array_equal(mesh.bounds, [[0, 0, 0], [2, 1, 0]])
        assert mesh.diagonal == pytest.approx(np.sqrt(5))

    def test_a_face_without_area_has_no_normal(self) -> None:
        mesh = Mesh(CORNERS, np.array([[0, 1, 2], [0, 1, 1]]))
        np.testing.assert_array_equal(mesh.face_areas, [1, 0])
        np.testing.assert_array_equal(mesh.face_normals, [[0, 0, 1], [0, 0, 0]])

    def test_faces_have_the_default_material(self) -> None:
        np.testing.assert_array_equal(boxes_mesh([((0, 0, 0), (1, 1, 1))]).face_material, np.zeros(12))

    def test_arrays_are_copied_and_read_only(self) -> None:
        vertices, faces, uv = CORNERS.copy(), FACE.copy(), np.zeros((4, 2))
        mesh = Mesh(vertices, faces, uv=uv)
        vertices[:], faces[:], uv[:] = 7, 0, 9
        np.testing.assert_array_equal(mesh.vertices, CORNERS)
        np.testing.assert_array_equal(mesh.faces, FACE)
        for array in (mesh.vertices, mesh.faces, mesh.uv, mesh.triangles, mesh.face_normals, mesh.bounds):
            assert array is not None
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1

    @given(vectors, vectors, st.floats(0.1, 10))
    @settings(max_examples=60, deadline=None)
    def test_a_similarity_moves_points_and_turns_normals(
        self, turn: FloatArray, shift: FloatArray, factor: float
    ) -> None:
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = rotation(turn) * factor, shift
        mesh = with_normals(boxes_mesh([((0, 0, 0), (1, 2, 3))], textured=True))
        moved = mesh.transformed(matrix)
        assert mesh.normals is not None
        assert moved.normals is not None
        np.testing.assert_allclose(moved.vertices, (matrix[:3, :3] @ mesh.vertices.T).T + shift, atol=1e-9)
        np.testing.assert_allclose(moved.normals, mesh.normals @ rotation(turn).T, atol=1e-9)
        np.testing.assert_allclose(moved.face_normals, mesh.face_normals @ rotation(turn).T, atol=1e-9)
        assert moved.uv is not None
        assert mesh.uv is not None
        np.testing.assert_array_equal(moved.uv, mesh.uv)


class TestCanonical:
    @pytest.mark.parametrize("up", UP_AXES)
    def test_up_comes_up_by_a_proper_rotation(self, up: UpAxis) -> None:
        _, asset_from_source = canonical(replace(cabinet_mesh(), up=up))
        turn = asset_from_source[:3, :3]
        np.testing.assert_array_equal(turn @ direction(up), [0, 0, 1])
        np.testing.assert_array_equal(turn @ turn.T, np.eye(3))
        assert np.linalg.det(turn) == pytest.approx(1.0)
        np.testing.assert_array_equal(asset_from_source[3], [0, 0, 0, 1])

    def test_gltf_front_becomes_front(self) -> None:
        """glTF: +Y up, front +Z, left of the asset +X; ours: +Z up, front -Y, so +X stays +X."""
        _, asset_from_source = canonical(replace(cabinet_mesh(), up="+y"))
        turn = asset_from_source[:3, :3]
        np.testing.assert_array_equal(turn @ [0, 0, 1], [0, -1, 0])
        np.testing.assert_array_equal(turn @ [1, 0, 0], [1, 0, 0])

    @pytest.mark.parametrize(("up", "metres"), list(product(UP_AXES, (None, 0.001, 0.0254))))
    def test_asset_from_source_maps_the_files_points(self, up: UpAxis, metres: float | None) -> None:
        source = replace(boxes_mesh([((1.0, 2.0, 3.0), (4.0, 9.0, 5.0))]), up=up, metres_per_unit=metres)
        mesh, asset_from_source = canonical(source)
        mapped = source.vertices @ asset_from_source[:3, :3].T + asset_from_source[:3, 3]
        np.testing.assert_allclose(mesh.vertices, mapped)
        assert (mesh.up, mesh.metres_per_unit) == ("+z", 1.0)
        height = {"x": 3.0, "y": 7.0, "z": 2.0}[up[1]] * (metres or 1.0)
        np.testing.assert_allclose(mesh.bounds[:, 2], [0.0, height], atol=1e-12)
        np.testing.assert_allclose(mesh.bounds.mean(axis=0)[:2], 0.0, atol=1e-12)

    def test_the_users_word_overrides_the_file(self) -> None:
        source = replace(boxes_mesh([((0, 0, 0), (1.0, 2.0, 3.0))]), up="+y", metres_per_unit=0.01)
        mesh, asset_from_source = canonical(source, up="-x", metres_per_unit=2.0)
        np.testing.assert_array_equal(asset_from_source[:3, :3] @ [-1, 0, 0], [0, 0, 2])
        assert mesh.bounds[1, 2] == pytest.approx(2.0)

    def test_vertices_that_no_face_uses_do_not_count(self) -> None:
        vertices, faces = box((0, 0, 0), (1, 1, 1))
        mesh, _ = canonical(Mesh(np.vstack([vertices, [[50.0, 50, -50]]]), faces))
        np.testing.assert_allclose(mesh.bounds, [[-0.5, -0.5, 0], [0.5, 0.5, 1]])

    def test_the_surface_stays_the_right_way_out(self) -> None:
        for up in UP_AXES:
            mesh, _ = canonical(replace(boxes_mesh([((0, 0, 0), (1, 2, 3))]), up=up))
            outward = np.einsum(
                "ij,ij->i", mesh.face_normals, mesh.triangles.mean(axis=1) - mesh.bounds.mean(axis=0)
            )
            assert (outward > 0).all()

    def test_no_two_up_axes_give_the_same_frame(self) -> None:
        frames = [canonical(replace(cabinet_mesh(), up=up))[1][:3, :3] for up in UP_AXES]
        assert not any(np.array_equal(a, b) for a, b in permutations(frames, 2))


class TestImage:
    @pytest.mark.parametrize("channels", [3, 4])
    def test_pixels_come_back(self, channels: int) -> None:
        pixels = np.random.default_rng(0).integers(0, 256, (5, 7, channels), dtype=np.uint8)
        image = Image.from_pixels(pixels)
        np.testing.assert_array_equal(image.pixels[..., :channels], pixels)
        assert channels == 4 or (image.pixels[..., 3] == 255).all()
        assert image.png.startswith(b"\x89PNG")

    def test_pixels_are_read_only(self) -> None:
        with pytest.raises(ValueError, match="read-only"):
            Image.from_pixels(np.zeros((2, 2, 3), dtype=np.uint8)).pixels[:] = 1
