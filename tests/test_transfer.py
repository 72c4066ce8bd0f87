"""Transfer of part seeds to face labels: the kernel, the smoothing, the votes, and whole objects."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.testing.meshes import box, boxes_mesh, cabinet_mesh
from simart_kit.topology import edge_ends, half_edges
from simart_kit.transfer import transfer
from simart_kit.transfer.edge_links import edge_links
from simart_kit.transfer.mesh_graph import hearing, smoothed
from simart_kit.transfer.part_seeds import PartSeeds
from simart_kit.transfer.part_votes import agree_in_segments
from simart_kit.voxels import cube_frame, voxelise

from .real_objects import DATA, needs_data, overlap

CABINET = cabinet_mesh(textured=False)
CABINET_PARTS = np.repeat([0, 1, 2], [60, 24, 24])
MODES = pytest.mark.parametrize("mode", ["seeds", "segments"])


def voxel_seeds(mesh, face_part):
    """The middles of the 64^3 voxels that each part touches, in the object's frame."""
    frame = cube_frame(mesh.bounds, 64)
    return [voxelise(mesh.triangles[face_part == p], frame).centers for p in range(face_part.max() + 1)]


def shares(mesh, found, face_part):
    """Intersection over union by area of each part."""
    return [overlap(mesh.face_areas, found == p, face_part == p) for p in range(face_part.max() + 1)]


# The bounding box of these two triangles has a diagonal of 5, so sigma = 0.2 means a length of 1.
PAIR = Mesh(
    np.array([[0.0, 0, 0], [0, 0.1, 0], [0.1, 0, 0], [3, 4, 0], [3, 3.9, 0], [2.9, 4, 0]]),
    np.array([[0, 1, 2], [3, 4, 5]]),
)


def test_probabilities_follow_the_gaussian_kernel():
    seeds = [[[0.0, 0, 1]], [[0.0, 0, 2]], [[3.0, 4, 0]]]
    found = transfer(PAIR, seeds, sigma=0.2, iterations=0).probabilities
    # Vertex 0 is at 1, 2 and 5: exp(-1/2) : exp(-4/2) : exp(-25/2); the last is next to nothing.
    odds = np.exp([-0.5, -2.0])
    np.testing.assert_allclose(found[0], [*odds / odds.sum(), 0], rtol=1e-5)
    # Vertex 3 is on the third seed, 25 + 1 away (squared) from the next: nothing else is possible.
    assert found[3].tolist() == [0, 0, 1]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1.0))
def test_leaving_out_impossible_parts_changes_no_probability(number, sigma):
    rng = np.random.default_rng(number)
    part = np.r_[np.arange(4), rng.integers(0, 4, 30)]
    seeds, points = rng.random((34, 3)), rng.random((50, 3)) * 2
    distance = np.stack([cdist(points, seeds[part == p]).min(axis=1) for p in range(4)], axis=1)
    kernel = np.exp((distance.min(axis=1, keepdims=True) ** 2 - distance**2) / (2 * sigma**2))
    found = PartSeeds(seeds, part, 4, sigma).probabilities(points)
    # At most three parts of less than a thousandth each are left out.
    np.testing.assert_allclose(found, kernel / kernel.sum(axis=1, keepdims=True), atol=3.1e-3)
    np.testing.assert_allclose(found.sum(axis=1), 1, atol=1e-5)


def test_smoothing_moves_half_way_to_what_is_heard_and_stays_within_a_piece():
    faces = np.array([[0, 1, 2], [3, 4, 5]])
    listens, creased = np.array([True] * 3 + [False] * 3), np.array([False, True] + [False] * 4)
    weights = hearing(edge_ends(faces, half_edges(faces)[1]), listens, creased, faces[:0])
    values = np.array([[1.0], [0], [0], [7], [8], [9]], dtype=np.float32)
    none = np.zeros((0, 1), dtype=np.float32)
    # 0 hears 1 (a crease: weight 0.1) and 2 (weight 1): (0 * 0.1 + 0 * 1) / 1.1 = 0. 1 hears 0 and 2: 1/2.
    # 2 hears 0 and 1: 1 / 1.1. Each goes half-way.
    expected = [0.5, 0.25, 1 / 2.2, 7, 8, 9]
    np.testing.assert_allclose(smoothed(values, none, weights, 1)[:, 0], expected, rtol=1e-6)


def test_a_face_that_brings_values_is_heard_by_its_corners():
    faces, everyone = np.array([[0, 1, 2]]), np.ones(3, dtype=bool)
    weights = hearing(edge_ends(faces, half_edges(faces)[1]), everyone, ~everyone, faces)
    values = smoothed(np.zeros((3, 1), np.float32), np.ones((1, 1), np.float32), weights, 1)
    # Each corner hears two others (0) and the face (1), so it goes half-way to 1/3.
    np.testing.assert_allclose(values[:, 0], 1 / 6, rtol=1e-6)


def test_boxes_that_touch_in_an_edge_are_linked_through_their_own_material():
    first, faces = box((0, 0, 0), (1, 1, 1))
    second, _ = box((1, 1, 0), (2, 2, 1))
    points, vertex = np.unique(np.concatenate([first, second]), axis=0, return_inverse=True)
    corners = vertex.reshape(-1)[np.concatenate([faces, faces + 8])]
    links = edge_links(points, corners)
    assert len(points) == 14  # two of sixteen vertices coincide
    assert ((links.left < 12) == (links.right < 12)).all()
    assert len(links.left) == 36  # 18 edges a box, each with two of its faces
    # 12 edges a box are bent, 6 are the diagonals of flat sides.
    assert links.bent.sum() == 24


def test_a_repeated_face_is_linked_to_the_first_alone_but_a_back_side_is_no_repeat():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    links = edge_links(points, np.array([[0, 1, 2], [1, 3, 2], [1, 2, 0], [0, 2, 1]]))
    assert links.repeats.tolist() == [[2, 0]]


@MODES
def test_touching_boxes_get_their_own_labels_back(mode):
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (1.5, 1, 1)), ((0, 0, 1), (1, 1, 1.01))])
    labels = np.repeat([0, 1, 2], 12)
    assert transfer(mesh, voxel_seeds(mesh, labels), mode=mode).face_part.tolist() == labels.tolist()


@MODES
def test_a_cabinet_of_thin_boards_gets_its_door_and_drawer_back(mode):
    found = transfer(CABINET, voxel_seeds(CABINET, CABINET_PARTS), mode=mode)
    assert min(shares(CABINET, found.face_part, CABINET_PARTS)) >= (1.0 if mode == "segments" else 0.95)
    assert found.face_part.dtype == np.int32
    assert found.probabilities.shape == (len(CABINET.vertices), 3)
    assert found.probabilities.dtype == np.float32
    assert not found.probabilities.flags.writeable
    assert not found.face_part.flags.writeable
    assert found.notes == ()


@MODES
def test_a_tray_exactly_on_a_board_keeps_its_bottom_though_all_cells_are_shared(mode):
    # The bottom of the inner box coincides with the inside of the outer one, wound the other way.
    outer, faces = box((0, 0, 0), (1, 1, 1))
    cavity, _ = box((0.1, 0.1, 0.5), (0.9, 0.9, 1))
    tray, _ = box((0.1, 0.1, 0.5), (0.9, 0.9, 0.8))
    inside = faces[:, ::-1][np.flatnonzero(cavity[faces][:, :, 2].min(axis=1) < 1)]
    body = faces[np.flatnonzero(outer[faces][:, :, 2].min(axis=1) < 1)]
    mesh = Mesh(np.concatenate([outer, cavity, tray]), np.concatenate([body, inside + 8, faces + 16]))
    labels = np.repeat([0, 1], [len(body) + len(inside), len(faces)])
    found = transfer(mesh, voxel_seeds(mesh, labels), mode=mode).face_part
    bottom = (mesh.triangles[:, :, 2] == 0.5).all(axis=1)
    assert found[bottom].tolist() == labels[bottom].tolist() == [0, 0, 1, 1]


@settings(max_examples=4, deadline=None)
@given(st.permutations(range(len(CABINET.faces))), st.sampled_from(["seeds", "segments"]))
def test_faces_in_another_order_keep_their_labels(order, mode):
    seeds = voxel_seeds(CABINET, CABINET_PARTS)
    found = transfer(CABINET, seeds, mode=mode).face_part
    again = transfer(Mesh(CABINET.vertices, CABINET.faces[list(order)]), seeds, mode=mode).face_part
    assert again.tolist() == found[list(order)].tolist()


@MODES
@pytest.mark.parametrize(("scale", "move"), [(1e-3, (0, 0, 0)), (1000.0, (0, 0, 0)), (2.0, (5, -7, 3))])
def test_size_and_place_do_not_matter(scale, move, mode):
    seeds = voxel_seeds(CABINET, CABINET_PARTS)
    placed = Mesh(CABINET.vertices * scale + move, CABINET.faces)
    found = transfer(placed, [points * scale + move for points in seeds], mode=mode)
    expected = transfer(CABINET, seeds, mode=mode)
    assert found.face_part.tolist() == expected.face_part.tolist()
    np.testing.assert_allclose(found.probabilities, expected.probabilities, atol=1e-4)


@MODES
def test_vertices_of_their_own_a_face_change_nothing(mode):
    seeds = voxel_seeds(CABINET, CABINET_PARTS)
    soup = Mesh(CABINET.triangles.reshape(-1, 3), np.arange(3 * len(CABINET.faces)).reshape(-1, 3))
    found, expected = transfer(soup, seeds, mode=mode), transfer(CABINET, seeds, mode=mode)
    assert found.face_part.tolist() == expected.face_part.tolist()
    corners = expected.probabilities[CABINET.faces].reshape(-1, 3)
    np.testing.assert_allclose(found.probabilities, corners, atol=1e-6)


@MODES
def test_faces_that_stand_twice_get_the_same_label(mode):
    twice = Mesh(CABINET.vertices, np.concatenate([CABINET.faces, CABINET.faces]))
    found = transfer(twice, voxel_seeds(CABINET, CABINET_PARTS), mode=mode).face_part
    assert found[:108].tolist() == found[108:].tolist()
    assert shares(CABINET, found[:108], CABINET_PARTS)[1] >= 0.95


@MODES
def test_open_parts_of_one_triangle_are_told_apart(mode):
    assert transfer(PAIR, [[[3, 4, 0]], [[0, 0, 0]]], mode=mode).face_part.tolist() == [1, 0]


def test_a_part_alone_takes_every_face():
    found = transfer(CABINET, [np.zeros((1, 3))])
    assert set(found.face_part) == {0}
    assert found.notes == ()
    np.testing.assert_allclose(found.probabilities, 1, rtol=1e-6)


def test_a_degenerate_face_gets_a_label():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    found = transfer(Mesh(points, [[0, 1, 2], [0, 0, 1], [1, 1, 1]]), [points[:1], points[1:2]])
    assert found.face_part.tolist()[2] == 1  # all of it lies on the seed of part 1


@MODES
def test_a_part_that_is_outvoted_takes_the_faces_nearest_to_its_seeds(mode):
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((3, 0, 0), (4, 1, 1))])
    seeds = voxel_seeds(mesh, np.repeat([0, 1], 12))
    # A seed outside, 0.2 from the side x = 0 of the first box, whose own seeds are everywhere nearer.
    found = transfer(mesh, [*seeds, [[-0.2, 0.6, 0.5]]], mode=mode)
    mine = np.flatnonzero(found.face_part == 2)
    assert len(mine) == 1
    assert (mesh.triangles[mine[0]][:, 0] == 0).all()
    assert found.notes == ("part 2 won no face by vote: it took the 1 nearest to its seeds",)


def test_a_part_does_not_take_the_last_face_of_another_but_the_next_nearest():
    points = np.concatenate([PAIR.vertices, PAIR.vertices[3:] + [0, 0, 0.5]])
    mesh = Mesh(points, np.arange(9).reshape(3, 3))
    found = transfer(mesh, [[[0, 0, 0]], points[3:], [[0.5, 0, 1.0]]])
    assert found.face_part.tolist() == [0, 1, 2]  # the third triangle is 0.5 nearer in z than the second
    assert found.notes == ("part 2 won no face by vote: it took the 1 nearest to its seeds",)


def test_a_part_that_can_take_no_face_is_named():
    found = transfer(PAIR, [[[0, 0, 0]], [[3, 4, 0]], [[0, 0, 0.1]]])
    assert found.face_part.tolist() == [0, 1]
    assert len(found.notes) == 1
    assert found.notes[0].startswith("part 2 has no face")


def test_parts_with_the_same_seeds_share_the_faces():
    found = transfer(CABINET, [CABINET.vertices, CABINET.vertices])
    assert 0 < (found.face_part == 1).sum() <= 54  # none gives more than half of its 108
    assert found.notes[0].startswith("part 1 won no face")


def test_a_segment_keeps_one_label_where_all_but_a_sliver_agrees():
    label, segment = np.array([0, 0, 1, 1, 0, 1]), np.array([0, 0, 0, 1, 2, 2])
    # Segment 0: 97 of 100 for part 0, and part 1 loses 3 of its 143. Segment 2 is torn 60 : 40.
    weight = np.array([90.0, 7, 3, 100, 60, 40])
    assert agree_in_segments(label, weight, segment, 2, 0.95).tolist() == [0, 0, 0, 1, 0, 1]
    assert agree_in_segments(label, weight, segment, 2, 0.98).tolist() == label.tolist()


def test_a_segment_does_not_swallow_a_small_part():
    label, segment = np.array([0, 1]), np.array([0, 0])
    assert agree_in_segments(label, np.array([99.0, 1.0]), segment, 2, 0.95).tolist() == [0, 1]
    assert agree_in_segments(label, np.array([99.0, 0.0]), segment, 2, 0.95).tolist() == [0, 1]


def test_a_button_modelled_in_one_piece_with_its_plate_stays_a_part():
    # A plate of 40 x 40 squares; the button is 2 x 2 of them, and no crease bounds it.
    x, y = np.meshgrid(np.arange(41.0), np.arange(41.0), indexing="ij")
    points = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    low = (np.arange(40)[:, None] * 41 + np.arange(40)).ravel()
    faces = np.concatenate([np.stack([low, low + 41, low + 42], 1), np.stack([low, low + 42, low + 1], 1)])
    mesh = Mesh(points, faces)
    button = (np.abs(mesh.triangles.mean(axis=1) - [20, 20, 0]) < 1).all(axis=1)
    found = transfer(mesh, voxel_seeds(mesh, button.astype(int)))
    # 8 faces, and the ring of squares around may be shared: its cells are.
    assert (found.face_part[button] == 1).all()
    assert found.face_part.sum() <= 8 + 24


@pytest.mark.parametrize(
    ("seeds", "options", "message"),
    [
        ([], {}, "no part has seeds"),
        ([np.zeros((1, 3)), np.zeros((0, 3))], {}, "part 1 has no seeds"),
        ([[[0, 0, np.nan]]], {}, "part 0 hold values that are NaN"),
        ([np.zeros(3)], {}, r"shape \(3,\), expected \(N, 3\)"),
        ([np.zeros((4, 2))], {}, r"shape \(4, 2\), expected \(N, 3\)"),
        ([[["a", "b", "c"]]], {}, "not numbers"),
        ([[[0, 0, 0]]], {"mode": "voxels"}, "use seeds or segments"),
        ([[[0, 0, 0]]], {"sigma": 0.0}, "sigma is 0.0"),
        ([[[0, 0, 0]]], {"sigma": np.nan}, "sigma is nan"),
        ([[[0, 0, 0]]], {"iterations": -1}, "use 0 or more"),
        ([[[0, 0, 0]]], {"agreement": 0.5}, "above 0.5"),
    ],
)
def test_bad_input_is_refused_in_one_line(seeds, options, message):
    with pytest.raises(BadInputError, match=message) as error:
        transfer(PAIR, seeds, **options)
    assert "\n" not in str(error.value)


def test_segments_of_another_mesh_are_refused():
    with pytest.raises(BadInputError, match="2 faces"):
        transfer(PAIR, [[[0, 0, 0]]], segments=find_segments(CABINET))


def test_a_mesh_without_size_is_refused():
    with pytest.raises(BadInputError, match="single point"):
        transfer(Mesh(np.zeros((3, 3)), [[0, 1, 2]]), [[[0, 0, 0]]])


@needs_data
@pytest.mark.parametrize("skin", ["input", "fused"])
@pytest.mark.slow
def test_real_parts_come_back_from_their_own_voxels(skin):
    found = {"seeds": [], "segments": []}
    for folder in sorted(DATA.iterdir()):
        stored = folder / ("gt.npz" if skin == "input" else "fused.npz")
        if not stored.exists():
            continue
        loaded = trimesh.load(folder / f"{skin}.glb", process=False, force="mesh")
        mesh = Mesh(loaded.vertices, loaded.faces)
        with np.load(stored) as arrays:
            labels = np.unique(arrays["face_part"], return_inverse=True)[1]
        if len(mesh.faces) > 60_000:
            continue  # only for the sake of time
        seeds, segments = voxel_seeds(mesh, labels), find_segments(mesh)
        for mode, scores in found.items():
            result = transfer(mesh, seeds, mode=mode, segments=segments)
            assert result.notes == (), folder.name
            scores.extend(shares(mesh, result.face_part, labels))
    assert np.mean(found["segments"]) >= 0.95
    assert np.mean(found["seeds"]) >= 0.85
    assert min(found["segments"]) >= 0.85
    assert min(found["seeds"]) >= 0.85
