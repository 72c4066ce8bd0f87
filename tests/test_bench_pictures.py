"""Pictures of objects for the page of a benchmark run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from simart_kit.bench.articulation import Articulation, LinkJoint
from simart_kit.bench.pictures import BACKGROUND, PICTURES, SIZE, write_pictures
from simart_kit.mesh import Mesh, VisualMaterial, canonical

from .bench_objects import block, cabinet, fan, prediction, truth, with_joint

Pixels = NDArray[np.int64]
TURNED = np.diag([-1.0, 1.0, -1.0, 1.0])  # half a turn about +Y, which is up
Z_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])


def pixels(path: Path) -> Pixels:
    return np.asarray(Image.open(path)).astype(np.int64)


def coloured(picture: Pixels) -> NDArray[np.bool_]:
    """Pixels of moving parts: body, ground and background are nearly grey."""
    return np.asarray(np.ptp(picture, axis=-1) > 60)


def solid(picture: Pixels) -> NDArray[np.bool_]:
    """Pixels that are much darker than the background, or coloured."""
    return np.asarray(coloured(picture) | (np.abs(picture - BACKGROUND).max(axis=-1) > 45))


def test_every_picture_has_a_file_and_the_same_size(tmp_path: Path) -> None:
    files = write_pictures(tmp_path, truth(cabinet()), prediction(cabinet()), None)
    assert files == {key: f"{key}.png" for key in PICTURES}
    assert {pixels(tmp_path / file).shape for file in files.values()} == {(SIZE, SIZE, 3)}


def test_without_a_prediction_only_the_truth_is_drawn(tmp_path: Path) -> None:
    files = write_pictures(tmp_path, truth(cabinet()), None, None)
    assert list(files) == ["input", "truth", "truth_open"]
    assert {path.name for path in tmp_path.iterdir()} == set(files.values())


def test_a_right_prediction_looks_like_the_truth(tmp_path: Path) -> None:
    write_pictures(tmp_path, truth(cabinet()), prediction(cabinet()), None)
    for end in ("", "_open"):
        same = [(tmp_path / f"{name}{end}.png").read_bytes() for name in ("truth", "prediction")]
        assert same[0] == same[1]


def test_a_predicted_part_has_the_colour_of_its_true_part_whatever_its_order(tmp_path: Path) -> None:
    right = cabinet()
    order = [0, 3, 1, 2]  # of the links, told anew
    links = tuple(right.links[i] for i in order)
    other = replace(right, links=links, labels=np.argsort(order)[right.labels])
    write_pictures(tmp_path, truth(right), prediction(other), None)
    assert (tmp_path / "truth.png").read_bytes() == (tmp_path / "prediction.png").read_bytes()


def test_moving_parts_are_coloured_each_in_its_own_and_the_body_is_grey(tmp_path: Path) -> None:
    write_pictures(tmp_path, truth(cabinet()), None, None)
    red, green, blue = np.moveaxis(pixels(tmp_path / "truth.png"), -1, 0)
    # The palette begins with blue, orange and green: the two doors and the drawer.
    for seen in ((blue > red + 60) & (blue > green + 60), (red > green + 40) & (green > blue + 40)):
        assert seen.sum() > 300
    assert ((green > red + 60) & (green > blue + 30)).sum() > 300
    assert not coloured(pixels(tmp_path / "input.png")).any()


def test_opening_moves_the_parts_and_leaves_the_camera(tmp_path: Path) -> None:
    write_pictures(tmp_path, truth(cabinet()), None, None)
    closed, opened = (pixels(tmp_path / f"{name}.png") for name in ("truth", "truth_open"))
    assert (coloured(closed) != coloured(opened)).sum() > 1000
    # Nothing leaves the picture: the camera frames the open object, too.
    border = np.ones((SIZE, SIZE), dtype=bool)
    border[5:-5, 5:-5] = False
    assert not (solid(opened) & border).any()


def test_an_object_that_faces_the_other_way_is_seen_from_its_front(tmp_path: Path) -> None:
    counts = []
    for name, placed in (("one", cabinet()), ("other", cabinet().transformed(TURNED))):
        (tmp_path / name).mkdir()
        write_pictures(tmp_path / name, truth(placed), None, None)
        counts.append(coloured(pixels(tmp_path / name / "truth.png")).sum())
    assert counts[0] > 3000  # three fronts that fill the front of a cabinet
    assert abs(int(counts[0]) - int(counts[1])) < 0.02 * counts[0]


def test_an_object_with_z_up_is_drawn_as_the_same_with_y_up(tmp_path: Path) -> None:
    upright = replace(truth(cabinet().transformed(Z_UP)), up="+z")
    for name, case in (("y", truth(cabinet())), ("z", upright)):
        (tmp_path / name).mkdir()
        write_pictures(tmp_path / name, case, None, None)
    one, other = (pixels(tmp_path / name / "truth_open.png") for name in "yz")
    assert np.abs(one - other).max(axis=-1).mean() < 0.5


def test_what_can_turn_without_end_is_drawn_at_rest_and_then_half_a_turn_on(tmp_path: Path) -> None:
    # A joint of unknown kind has the same colour and no travel: it can only be drawn at rest.
    still = with_joint(fan(), 1, LinkJoint("unknown"))
    write_pictures(tmp_path, truth(fan()), prediction(still), None)
    assert (tmp_path / "truth.png").read_bytes() == (tmp_path / "prediction.png").read_bytes()
    red, _, blue = np.moveaxis(pixels(tmp_path / "truth_open.png"), -1, 0)
    still_red, _, still_blue = np.moveaxis(pixels(tmp_path / "prediction_open.png"), -1, 0)
    # The orange weight slides to x 0.5..0.6 of a blade from -0.8 to 0.8; half a turn takes it to -0.6..-0.5.
    column, other = (np.nonzero(r > b + 60)[1].mean() for r, b in ((red, blue), (still_red, still_blue)))
    assert column < other - SIZE / 4


def test_nothing_opens_in_a_static_object(tmp_path: Path) -> None:
    write_pictures(tmp_path, truth(block()), prediction(block()), None)
    assert (tmp_path / "truth.png").read_bytes() == (tmp_path / "truth_open.png").read_bytes()
    assert solid(pixels(tmp_path / "truth.png")).sum() > 1000


def test_the_look_lies_where_the_true_object_is_whatever_its_size_and_place(tmp_path: Path) -> None:
    known = cabinet()
    red = VisualMaterial("red", (0.8, 0.0, 0.0, 1.0))
    surface = Mesh(known.vertices, known.faces, materials=(red,), up="+y", metres_per_unit=0.01)
    look, _ = canonical(surface)
    write_pictures(tmp_path, truth(known), None, look)
    one, other = (solid(pixels(tmp_path / f"{name}.png")) for name in ("input", "truth"))
    assert coloured(pixels(tmp_path / "input.png")).sum() > 0.9 * one.sum()
    assert (one & other).sum() > 0.95 * (one | other).sum()


def test_a_part_that_is_sent_far_away_leaves_the_picture(tmp_path: Path) -> None:
    wild = with_joint(cabinet(), 3, LinkJoint("prismatic", (0, 0, 1), (0, 0, 0), 0.0, 1e9))
    write_pictures(tmp_path, truth(cabinet()), prediction(wild), None)
    body = solid(pixels(tmp_path / "prediction_open.png"))
    assert 0.5 < body.sum() / solid(pixels(tmp_path / "truth_open.png")).sum() < 1.0


def test_a_prediction_of_another_size_altogether_is_an_empty_picture(tmp_path: Path) -> None:
    shift = np.eye(4)
    shift[0, 3] = 1e6
    write_pictures(tmp_path, truth(cabinet()), prediction(cabinet().transformed(shift)), None)
    assert (pixels(tmp_path / "prediction.png") == BACKGROUND).all()


def test_a_cloud_of_points_is_drawn_in_the_colours_of_its_parts(tmp_path: Path) -> None:
    known, random = cabinet(), np.random.default_rng(0)
    face = random.integers(len(known.faces), size=3000)
    weights = random.dirichlet(np.ones(3), size=3000)
    points = np.einsum("nk,nkd->nd", weights, known.triangles[face])
    cloud = Articulation("cloud", points, np.zeros((0, 3), dtype=np.int64), known.labels[face], known.links)
    files = write_pictures(tmp_path, truth(cloud), prediction(cloud), None)
    assert list(files) == list(PICTURES)
    assert coloured(pixels(tmp_path / "truth.png")).sum() > 1000
