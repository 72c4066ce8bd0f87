"""Examples seen from other sides and beside each other: what is told is what would be measured there."""

import numpy as np
import pytest
from simart_kit_plugins.nano.candidates import SLIDE, Candidates
from simart_kit_plugins.nano.cloud import Cloud
from simart_kit_plugins.nano.evidence import BOTH_WAYS, COUNT, WAY, evidence
from simart_kit_plugins.nano.examples import example
from simart_kit_plugins.nano.line_places import Details
from simart_kit_plugins.nano.mixing import beside, recolored, varied
from simart_kit_plugins.nano.scene import area_share, pieces_of
from simart_kit_plugins.nano.store import stored
from simart_kit_plugins.nano.turning import VIEWS, turned, turned_evidence, turned_pieces

from .test_generated_objects import MADE


def matrix_of(quarters, mirrored):
    angle = quarters * np.pi / 2
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    return np.round(turn @ np.diag([-1.0 if mirrored else 1.0, 1, 1]))


@pytest.fixture(scope="module")
def some():
    return [stored(example(MADE, np.random.default_rng(k), 0.3)) for k in range(6)]


@pytest.mark.parametrize(("quarters", "mirrored"), VIEWS)
def test_pieces_turn_as_their_points_do(quarters, mirrored):
    generator = np.random.default_rng(1)
    points, normals = generator.normal(size=(200, 3)), generator.normal(size=(200, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points /= np.ptp(points)
    matrix = matrix_of(quarters, mirrored)
    here, there = (
        pieces_of(
            Cloud(
                points @ m.T,
                normals @ m.T,
                np.full((200, 3), 0.3),
                np.arange(200) % 7,
                np.full(200, 1 / 200),
                7,
            )
        )
        for m in (np.eye(3), matrix)
    )
    assert np.allclose(turned_pieces(here.own, quarters, mirrored), there.own, atol=1e-6)


@pytest.mark.parametrize(("quarters", "mirrored"), VIEWS)
def test_evidence_turns_as_part_and_candidates_do(quarters, mirrored):
    generator = np.random.default_rng(2)
    part = generator.uniform([-0.5, -0.02, -0.3], [0.1, 0.02, 0.3], (300, 3))
    rest = generator.uniform([-0.5, 0.05, -0.5], [0.5, 0.5, 0.5], (9000, 3))
    axis = generator.normal(size=(12, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    source = np.array([SLIDE] * 4 + [1, 2, 3, 4] * 2)
    gap = generator.uniform(0, 0.1, 300)

    def told(m):
        origin = part[:12] @ m.T
        found = Candidates(axis @ m.T, origin, source, np.zeros(12, dtype=int), np.zeros(12))
        details = Details(m @ [-0.4, -0.05, 0.1], rest[:900] @ m.T)
        return evidence(found, part @ m.T, rest @ m.T, gap, details)

    expected = told(matrix_of(quarters, mirrored))
    got = turned_evidence(told(np.eye(3)), quarters, mirrored)
    assert got.shape == (12, COUNT)
    # Cells of the sweep's grid lie a little differently once all is turned.
    exact = np.delete(np.arange(COUNT), BOTH_WAYS)
    assert np.allclose(got[:, exact], expected[:, exact], atol=1e-5)
    assert np.abs(got[:, BOTH_WAYS] - expected[:, BOTH_WAYS]).mean() < 0.02
    assert np.ptp(expected[:, BOTH_WAYS]) > 0.3
    assert (np.ptp(expected[:, WAY], axis=0) > 0.3).all()


def test_a_mirror_turns_the_sense_of_turns_and_not_of_slides(some):
    asked = {True: 0, False: 0}
    for one in some:
        seen = turned(one, 1, True)
        for slide in asked:
            rows = (one.numbers[:, SLIDE] > 0) == slide
            asked[slide] += np.count_nonzero(one.right[rows])
            assert np.array_equal(seen.right[rows], one.right[rows] if slide else -one.right[rows])
    assert min(asked.values()) > 3


def test_four_quarters_and_two_mirrors_are_the_same_again(some):
    one = some[0]
    back = turned(turned(turned(one, 2, True), 0, True), 2, False)
    for name in ("points", "normals", "own", "numbers", "right"):
        assert np.allclose(getattr(back, name), getattr(one, name), atol=1e-6), name


def test_two_objects_beside_each_other_fill_the_unit_cube_and_keep_their_parts(some):
    for seed in range(10):
        both = beside(some[1], some[2], np.random.default_rng(seed))
        low = (both.own[:, :3] - both.own[:, 3:6]).min(axis=0)
        high = (both.own[:, :3] + both.own[:, 3:6]).max(axis=0)
        assert (high - low).max() == pytest.approx(1, abs=1e-5)
        assert np.allclose(low + high, 0, atol=1e-5)
        assert len(both.own) == len(some[1].own) + len(some[2].own) == len(both.gap)
        assert len(both.number) == len(some[1].number) + len(some[2].number)
        assert area_share(both.own[:, 21]).sum() == pytest.approx(1, abs=0.03)
        inside = np.abs(both.points - both.own[both.piece, :3]) - both.own[both.piece, 3:6]
        assert inside.max() < 0.02  # noise of the points aside, each lies in its piece's box
        assert len(np.unique(both.part)) == len(np.unique(some[1].part)) + len(np.unique(some[2].part)) - 1


def test_colours_change_alike_for_points_and_pieces(some):
    seen = recolored(some[3], np.random.default_rng(4))
    means = np.stack([np.bincount(seen.piece, c, len(seen.own)) for c in seen.colors.T], axis=1)
    means /= np.bincount(seen.piece, minlength=len(seen.own))[:, None]
    assert np.abs(means - 0.5 - seen.own[:, 18:21]).max() < 0.01
    assert np.abs(seen.own[:, 18:21] - some[3].own[:, 18:21]).max() > 0.01


def test_the_same_generator_varies_alike(some):
    one, two = (varied(some, np.random.default_rng(5)) for _ in range(2))
    assert all(np.array_equal(a.points, b.points) for a, b in zip(one, two, strict=True))
    assert any(not np.array_equal(a.points, b.points) for a, b in zip(one, some, strict=True))
