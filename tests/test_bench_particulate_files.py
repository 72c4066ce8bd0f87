"""Particulate's files: lines, truths as point clouds, and predictions brought to the truth's frame."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Articulation, Link
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats.particulate import ParticulatePrediction, ParticulateTruth
from simart_kit.bench.plucker import lines
from simart_kit.errors import BadInputError
from simart_kit.mesh import UpAxis

from .bench_objects import of_boxes

# A body 4 x 2 x 1 with a door and a drawer side by side before it, +Y up: box 0..4, 0..2, 0..1.5.
CABINET = of_boxes(
    "cabinet",
    [
        (Link("body"), (0, 0, 0), (4, 2, 1)),
        (Link("door", 0), (0, 0, 1), (2, 2, 1.5)),
        (Link("drawer", 0), (2, 0, 1), (4, 2, 1.5)),
    ],
)
TRUTH = Truth("cabinet", CABINET, up="+y")

# The door turns about +Y through (0, y, 1), the drawer slides 1 along +Z. In Particulate's frame, which is
# (x, -z, y) of (v - centre) / longest side with centre (2, 1, 0.75) and side 4, that is:
# axis (0, 0, 1) through (-0.5, -0.0625, 0), so that the moment l x p is (0.0625, -0.5, 0);
# direction (0, -1, 0), range 0.25.
MOTION: dict[str, Any] = {
    "motion_hierarchy": np.array([[0, 1], [0, 2]]),
    "is_part_revolute": np.array([False, True, False]),
    "is_part_prismatic": np.array([False, False, True]),
    "revolute_plucker": np.array([[0] * 6, [0, 0, 1, 0.0625, -0.5, 0], [0] * 6], dtype=np.float32),
    "revolute_range": np.array([[0, 0], [0, math.pi / 2], [0, 0]]),
    "prismatic_axis": np.array([[0, 0, 0], [0, 0, 0], [0, -1, 0]]),
    "prismatic_range": np.array([[0, 0], [0, 0], [0, 0.25]]),
}
CLOUD = {
    "points": np.array([[-0.5, -0.2, 0.0], [0.5, 0.2, 0.1], [-0.4, -0.2, 0.0], [0.4, -0.2, 0.0]]),
    "part_ids": np.array([0, 0, 1, 2]),
}
TO_PARTICULATE = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # (x, y, z) -> (x, -z, y)


def write_npz(path: Path, **changed: Any) -> Path:
    """An .npz with the motion of the cabinet; arrays can be replaced, added, or left out with None."""
    path.parent.mkdir(parents=True, exist_ok=True)
    arrays = {name: value for name, value in (MOTION | changed).items() if value is not None}
    np.savez(path, **arrays)
    return path


def write_prediction(folder: Path, vertices: FloatArray, **changed: Any) -> Path:
    """pred.npz and pred.obj of the cabinet with its vertices moved."""
    path = write_npz(folder / "pred.npz", **({"face_part_ids": CABINET.labels} | changed))
    text = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    text += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in CABINET.faces.tolist()]
    path.with_suffix(".obj").write_text("\n".join(text))
    return path


def normalised(vertices: FloatArray) -> FloatArray:
    """Box centred at 0, longest side 1."""
    return (vertices - [2, 1, 0.75]) / 4


def assert_is_the_cabinet(found: Articulation) -> None:
    """Geometry and joints are those of the cabinet, in its own frame."""
    np.testing.assert_allclose(found.vertices, CABINET.vertices, atol=1e-6)
    np.testing.assert_array_equal(found.faces, CABINET.faces)
    assert [link.parent for link in found.links] == [-1, 0, 0]
    body, door, drawer = (link.joint for link in found.links)
    assert [body.kind, door.kind, drawer.kind] == ["fixed", "revolute", "prismatic"]
    assert door.axis == pytest.approx((0, 1, 0), abs=1e-6)
    assert door.origin is not None
    assert (door.origin[0], door.origin[2]) == pytest.approx((0, 1), abs=1e-6)  # any y is on the axis
    assert (door.lower, door.upper) == pytest.approx((0, math.pi / 2))
    assert drawer.axis == pytest.approx((0, 0, 1), abs=1e-6)
    assert (drawer.lower, drawer.upper) == pytest.approx((0, 1))


def test_a_line_is_read_by_its_moment_l_cross_p() -> None:
    # Through (1, 2, 3) along +Z: l x p = (0*3 - 1*2, 1*1 - 0*3, 0) = (-2, 1, 0). Nearest to 0 is (1, 2, 0).
    # The same with l twice as long; and no line at all.
    plucker = np.array([[0, 0, 1, -2, 1, 0], [0, 0, 2, -4, 2, 0], [0, 0, 0, 0, 0, 0]], dtype=np.float64)
    directions, points = lines(plucker)
    assert directions.tolist() == [[0, 0, 1], [0, 0, 1], [0, 0, 0]]
    assert points.tolist() == [[1, 2, 0], [1, 2, 0], [0, 0, 0]]


def test_any_line_is_found_again() -> None:
    random = np.random.default_rng(0)
    direction, point = random.normal(size=(2, 50, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    directions, points = lines(np.hstack([direction, np.cross(direction, point)]))
    np.testing.assert_allclose(directions, direction)
    # Moved along the line to where it is nearest to 0, by projection.
    np.testing.assert_allclose(points, point - (point * direction).sum(axis=1, keepdims=True) * direction)


def test_a_truth_has_its_points_parts_and_joints(tmp_path: Path) -> None:
    truth = ParticulateTruth().read(write_npz(tmp_path / "cab.npz", **CLOUD))
    found = truth.articulation
    assert (truth.name, truth.up, truth.metres_per_unit) == ("cab", "+z", None)
    assert found.is_cloud
    np.testing.assert_array_equal(found.vertices, CLOUD["points"])
    assert found.labels.tolist() == [0, 0, 1, 2]
    door, drawer = found.links[1].joint, found.links[2].joint
    assert (door.kind, door.axis) == ("revolute", (0, 0, 1))
    assert door.origin == pytest.approx((-0.5, -0.0625, 0))
    assert (drawer.kind, drawer.axis, drawer.lower, drawer.upper) == ("prismatic", (0, -1, 0), 0, 0.25)
    assert any("nearest" in note for note in truth.notes)


@pytest.mark.parametrize(
    ("limits", "kind"),
    [
        ((0, 2 * math.pi), "continuous"),
        ((-math.pi, math.pi), "continuous"),
        ((0, np.float32(2 * math.pi)), "continuous"),
        ((0, 1.9 * math.pi), "revolute"),
        ((0.5, 1.0), "revolute"),  # rest lies outside
    ],
)
def test_a_full_turn_is_continuous(tmp_path: Path, limits: tuple[float, float], kind: str) -> None:
    ranges = np.array([[0, 0], limits, [0, 0]])
    truth = ParticulateTruth().read(write_npz(tmp_path / "cab.npz", **CLOUD, revolute_range=ranges))
    joint = truth.articulation.links[1].joint
    assert joint.kind == kind
    assert (joint.lower, joint.upper) == limits  # Particulate's states run from one to the other


def test_a_part_that_turns_and_slides_is_right_as_either_in_truth_and_revolute_in_a_prediction(
    tmp_path: Path,
) -> None:
    both = {
        "is_part_prismatic": np.array([0, 1, 1]),
        "prismatic_axis": np.array([[0, 0, 0], [1, 0, 0], [0, -1, 0]]),
    }
    truth = ParticulateTruth().read(write_npz(tmp_path / "cab.npz", **CLOUD, **both))
    door = truth.articulation.links[1]
    assert (door.joint.kind, [joint.kind for joint in door.also]) == ("revolute", ["prismatic"])
    assert door.also[0].axis == (1, 0, 0)
    path = write_prediction(tmp_path / "cabinet", CABINET.vertices, **both)
    predicted = ParticulatePrediction().read(path, TRUTH).articulation.links[1]
    assert (predicted.joint.kind, predicted.also) == ("revolute", ())


def test_a_static_object_has_no_pairs(tmp_path: Path) -> None:
    still = {
        "motion_hierarchy": np.array([]),  # what numpy makes of an empty list
        "is_part_revolute": np.zeros(1),
        "is_part_prismatic": np.zeros(1),
        "revolute_plucker": np.zeros((1, 6)),
        "revolute_range": np.zeros((1, 2)),
        "prismatic_axis": np.zeros((1, 3)),
        "prismatic_range": np.zeros((1, 2)),
    }
    points = {"points": CLOUD["points"], "part_ids": np.zeros(4)}
    truth = ParticulateTruth().read(write_npz(tmp_path / "cube.npz", **points, **still))
    assert truth.articulation.is_static
    assert truth.notes == ()


def test_truths_are_told_from_other_archives(tmp_path: Path) -> None:
    for name in ("b", "a"):
        write_npz(tmp_path / f"{name}.npz", **CLOUD)
    np.savez(tmp_path / "gt.npz", face_part=np.zeros(3))  # of SIMART-Bench
    write_npz(tmp_path / "pred.npz", face_part_ids=np.zeros(3))  # a prediction
    reader = ParticulateTruth()
    expected = {"a": tmp_path / "a.npz", "b": tmp_path / "b.npz"}
    assert list(reader.find(tmp_path).items()) == list(expected.items())
    assert reader.find(tmp_path / "a.npz") == {"a": tmp_path / "a.npz"}
    assert reader.find(tmp_path / "gt.npz") == {}
    (tmp_path / "b.npz").write_bytes((tmp_path / "b.npz").read_bytes()[:300])
    assert reader.find(tmp_path) == expected  # a damaged one among others is found, and then fails
    with pytest.raises(BadInputError, match=r"b\.npz"):
        reader.read(tmp_path / "b.npz")
    (tmp_path / "a.npz").unlink()
    assert reader.find(tmp_path) == {}


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"points": None}, "no array 'points'"),
        ({"revolute_plucker": None}, "no array 'revolute_plucker'"),
        ({"points": np.full((4, 3), np.nan)}, "NaN"),
        ({"points": np.zeros((4, 2))}, "shape"),
        ({"part_ids": np.array([0, 0, 1])}, "3 values for 4"),
        ({"part_ids": np.array([0, 0, 1, 3])}, "none of 0..2"),
        ({"part_ids": np.array([0, 0, 1, 1.5])}, "none of 0..2"),
        ({"part_ids": np.array(["a", "b", "c", "d"])}, "no numbers"),
        ({"part_ids": np.array([0, 0, 1, None])}, "cannot be read"),
        ({"is_part_prismatic": np.array([0, 1])}, "shape"),
        ({"revolute_plucker": np.zeros((3, 6))}, "axis"),
        ({"prismatic_axis": np.full((3, 3), np.inf)}, "infinite"),
        ({"revolute_range": np.array([[0, 0], [1, 0], [0, 0]])}, "runs from 1.0 to 0.0"),
        ({"motion_hierarchy": np.array([[0, 1], [1, 2], [2, 0]])}, "loop"),
        ({"motion_hierarchy": np.array([[0, 2], [1, 2]])}, "two parents"),
        ({"motion_hierarchy": np.array([[0, 3]])}, "parts are 0..2"),
        ({"motion_hierarchy": np.array([[0, 0.5]])}, "parts are 0..2"),
    ],
)
def test_a_damaged_truth_is_refused_in_one_line(tmp_path: Path, changed: dict[str, Any], told: str) -> None:
    path = write_npz(tmp_path / "cab.npz", **(CLOUD | changed))
    with pytest.raises(BadInputError, match=told) as error:
        ParticulateTruth().read(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_an_unknown_variant_or_a_lone_array_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no variant 'fused'"):
        ParticulateTruth().read(write_npz(tmp_path / "cab.npz", **CLOUD), "fused")
    np.save(tmp_path / "lone.npy", np.zeros(3))
    with pytest.raises(BadInputError, match=r"lone\.npy.*single array"):
        ParticulateTruth().read(tmp_path / "lone.npy")


@pytest.mark.parametrize("place", ["cabinet/pred.npz", "cabinet/eval/pred.npz", "cabinet.npz"])
def test_predictions_are_found_where_they_are_written(tmp_path: Path, place: str) -> None:
    reader = ParticulatePrediction()
    assert reader.find(tmp_path, "cabinet") is None
    write_npz(tmp_path / place, **CLOUD)
    assert reader.find(tmp_path, "cabinet") == tmp_path / place
    assert reader.find(tmp_path, "other") is None


def test_a_mesh_as_the_input_was_stays_and_its_joints_are_turned_back(tmp_path: Path) -> None:
    found = ParticulatePrediction().read(write_prediction(tmp_path, CABINET.vertices), TRUTH)
    assert_is_the_cabinet(found.articulation)
    assert found.notes == ("pred.obj lies in the truth's frame; joints turned back as if from --up_dir Y",)


def test_a_mesh_in_another_place_and_unit_is_fitted(tmp_path: Path) -> None:
    found = ParticulatePrediction().read(write_prediction(tmp_path, CABINET.vertices * 100 + 7), TRUTH)
    assert_is_the_cabinet(found.articulation)
    assert "fitted to the truth's box" in found.notes[0]


def test_a_normalised_mesh_is_turned_back_with_its_joints(tmp_path: Path) -> None:
    turned = normalised(CABINET.vertices) @ TO_PARTICULATE.T
    found = ParticulatePrediction().read(write_prediction(tmp_path, turned), TRUTH)
    assert_is_the_cabinet(found.articulation)
    assert found.notes[0].endswith("turned from +z up to +y up")


def test_a_normalised_mesh_that_had_not_been_turned_is_not_turned_back(tmp_path: Path) -> None:
    # The user said Z was up: joints were predicted in the input's own orientation, normalised.
    plucker = np.zeros((3, 6))
    plucker[1] = [0, 1, 0, *np.cross([0, 1, 0], [-0.5, 0, 0.0625])]
    axes = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 1]])
    path = write_prediction(
        tmp_path, normalised(CABINET.vertices), revolute_plucker=plucker, prismatic_axis=axes
    )
    found = ParticulatePrediction().read(path, TRUTH)
    assert_is_the_cabinet(found.articulation)
    assert "not turned" in found.notes[0]


def test_a_normalised_mesh_of_a_normalised_truth_is_the_input(tmp_path: Path) -> None:
    unit = np.diag([0.25, 0.25, 0.25, 1.0])
    unit[:3, 3] = [-0.5, -0.25, -0.1875]  # -centre / 4
    truth = Truth("cabinet", CABINET.transformed(unit), up="+y")
    path = write_prediction(tmp_path, normalised(CABINET.vertices))
    found = ParticulatePrediction().read(path, truth).articulation
    np.testing.assert_allclose(found.vertices, truth.articulation.vertices, atol=1e-12)
    assert found.links[1].joint.axis == pytest.approx((0, 1, 0))
    assert found.links[1].joint.origin == pytest.approx((-0.5, 0, 0.0625))


def test_where_the_box_does_not_tell_a_normalised_mesh_is_turned_back(tmp_path: Path) -> None:
    truth = Truth("cube", of_boxes("cube", [(Link("body"), (0, 0, 0), (3, 3, 3))]), up="+y")
    points = np.array([[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5], [0.1, 0.2, 0.5]])
    found = ParticulatePrediction().read(
        write_npz(tmp_path / "cube.npz", points=points, part_ids=np.zeros(3)), truth
    )
    # (x, y, z) -> (x, z, -y), times 3, about (1.5, 1.5, 1.5).
    np.testing.assert_allclose(found.articulation.vertices[2], [1.8, 3.0, 0.9])


def test_a_predicted_cloud_is_brought_to_the_frame_of_a_mesh(tmp_path: Path) -> None:
    points = normalised(CABINET.vertices) @ TO_PARTICULATE.T
    labels = np.repeat([0, 1, 2], 8)  # 8 corners a box
    path = write_npz(tmp_path / "cabinet.npz", points=points, part_ids=labels)
    found = ParticulatePrediction().read(path, TRUTH).articulation
    assert found.is_cloud
    np.testing.assert_allclose(found.vertices, CABINET.vertices, atol=1e-6)
    assert found.links[1].joint.axis == pytest.approx((0, 1, 0))


def test_a_predicted_cloud_of_a_true_cloud_is_left_where_it_is(tmp_path: Path) -> None:
    truth = ParticulateTruth().read(write_npz(tmp_path / "cab.npz", **CLOUD))
    sampled = CLOUD | {"points": CLOUD["points"] * 0.999}  # other points of the surface: another box
    path = write_npz(tmp_path / "predicted" / "cab.npz", **sampled)
    found = ParticulatePrediction().read(path, truth).articulation
    np.testing.assert_array_equal(found.vertices, sampled["points"])
    assert found.links == truth.articulation.links


@pytest.mark.parametrize("up", get_args(UpAxis))
def test_what_is_up_for_particulate_is_up_in_the_truth(tmp_path: Path, up: UpAxis) -> None:
    truth = Truth("cabinet", CABINET, up=up)
    found = ParticulatePrediction().read(write_prediction(tmp_path, CABINET.vertices), truth)
    expected = np.zeros(3)
    expected["xyz".index(up[1])] = 1 if up[0] == "+" else -1
    assert found.articulation.links[1].joint.axis == pytest.approx(tuple(expected))  # the door's is +Z there


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"face_part_ids": np.zeros(35)}, "35 values for 36"),
        ({"face_part_ids": np.full(36, -1)}, "none of 0..2"),
        ({"face_part_ids": None}, "no array 'points'"),
        ({"is_part_revolute": np.zeros(0)}, "shape"),
        ({"revolute_range": np.full((3, 2), np.nan)}, "NaN"),
    ],
)
def test_a_damaged_prediction_is_refused(tmp_path: Path, changed: dict[str, Any], told: str) -> None:
    path = write_prediction(tmp_path, CABINET.vertices, **changed)
    with pytest.raises(BadInputError, match=told):
        ParticulatePrediction().read(path, TRUTH)


def test_a_prediction_without_its_mesh_is_refused(tmp_path: Path) -> None:
    path = write_prediction(tmp_path, CABINET.vertices)
    path.with_suffix(".obj").unlink()
    with pytest.raises(BadInputError, match=r"pred\.obj"):
        ParticulatePrediction().read(path, TRUTH)
    path.write_bytes(b"PK")
    with pytest.raises(BadInputError, match=r"pred\.npz"):
        ParticulatePrediction().read(path, TRUTH)


def test_a_reversed_range_of_a_prediction_is_kept(tmp_path: Path) -> None:
    ranges = np.array([[0, 0], [1, 0], [0, 0]])
    path = write_prediction(tmp_path, CABINET.vertices, revolute_range=ranges)
    joint = ParticulatePrediction().read(path, TRUTH).articulation.links[1].joint
    assert (joint.lower, joint.upper) == (1, 0)
