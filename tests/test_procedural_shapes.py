"""Made-up objects to train on."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from simart_kit_plugins.shapes.outlines import SQUARE, ngon, rounded
from simart_kit_plugins.shapes.primitives import (
    box,
    boxes,
    cylinder,
    open_box,
    tube,
)
from simart_kit_plugins.simart.training.grids import packed_size
from simart_kit_plugins.simart.training.procedural import (
    object_grids,
    procedural_grids,
    procedural_object,
)
from simart_kit_plugins.simart.training.procedural.shapes import FAMILIES, family
from simart_kit_plugins.simart.training.procedural.together import occupancies

from simart_kit.errors import BadInputError
from simart_kit.triangles import areas, crosses
from simart_kit.voxels import cube_frame, voxelise

OBJECTS = 60


def bounds(triangles):
    return np.stack([triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))])


def volume(triangles):
    """By the divergence theorem: right whatever way all faces turn."""
    return abs(np.einsum("fi,fi->", triangles[:, 0], crosses(triangles)) / 6)


@pytest.fixture(scope="module")
def objects():
    return [procedural_object((7, number)) for number in range(OBJECTS)]


def test_an_object_has_one_to_twelve_parts_of_finite_triangles(objects):
    assert {len(parts) for parts in objects} <= set(range(1, 13))
    assert len({len(parts) for parts in objects}) > 3
    for parts in objects:
        for part in parts:
            assert part.shape[1:] == (3, 3)
            assert np.isfinite(part).all()
            assert areas(part).max() > 0


def test_equal_seeds_give_equal_objects_and_unequal_ones_unequal(objects):
    again = [procedural_object((7, number)) for number in range(OBJECTS)]
    for parts, same in zip(objects, again, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(parts, same, strict=True))
    others = [procedural_object((8, number)) for number in range(OBJECTS)]
    prints = [b"".join(part.tobytes() for part in parts) for parts in objects + others]
    assert len(set(prints)) == 2 * OBJECTS


def test_a_slice_holds_the_objects_of_the_whole_list():
    whole, last = procedural_grids(6, seed=3), procedural_grids(2, seed=3, first=4)
    start = whole.names.index("object 4")
    assert whole.names[start:] == last.names
    assert np.array_equal(whole.packed[start:], last.packed)


def test_two_seeds_share_no_grid_of_a_whole_object():
    several = [procedural_grids(8, seed) for seed in (0, 1)]
    one, other = ({row.tobytes() for row in grids.packed} for grids in several)
    assert not one & other


def test_grids_are_the_whole_then_each_part_in_the_same_cube(objects):
    for number, parts in enumerate(objects[:12]):
        grids = object_grids(7, number, resolution=32)
        triangles = np.concatenate(parts)
        frame = cube_frame(bounds(triangles), 32)
        expected = [triangles, *(parts if len(parts) > 1 else ())]
        assert len(grids) == len(expected)
        for grid, surface in zip(grids, expected, strict=True):
            assert np.array_equal(grid, voxelise(surface, frame).occupancy)


def test_the_whole_fills_its_cube_and_is_the_union_of_its_parts_none_empty():
    for number in range(20):
        whole, *parts = object_grids(11, number)
        assert any(whole.any(axis=axes)[[0, -1]].all() for axes in ((1, 2), (0, 2), (0, 1)))
        assert all(part.any() for part in parts)
        assert len(parts) != 1
        if parts:
            assert np.array_equal(whole, np.logical_or.reduce(parts))


def test_parts_of_more_than_one_batch_are_voxelised_as_one_by_one():
    parts = [box((1 - k / 12, 1, 1), (-k / 24, 0, 0)) for k in range(11)]
    frame = cube_frame(bounds(parts[0]), 16)
    together = occupancies(parts, frame)
    assert np.array_equal(together, np.stack([voxelise(part, frame).occupancy for part in parts]))


def test_names_shapes_and_progress_tell_of_the_objects():
    told = []
    grids = procedural_grids(3, seed=5, resolution=16, progress=lambda *now: told.append(now))
    assert told == [(1, 3), (2, 3), (3, 3)]
    assert grids.packed.shape == (len(grids.names), packed_size(16))
    wholes = [k for k, name in enumerate(grids.names) if " part " not in name]
    assert [grids.names[k] for k in wholes] == ["object 0", "object 1", "object 2"]
    for first, end in pairwise([*wholes, len(grids)]):
        parts = [f"{grids.names[first]} part {k}" for k in range(end - first - 1)]
        assert list(grids.names[first + 1 : end]) == parts


def test_families_come_as_often_as_their_shares_say():
    count = 1000
    seen = Counter(family((2, number)) for number in range(count))
    assert sum(share for share, _ in FAMILIES.values()) == pytest.approx(1)
    for name, (share, _) in FAMILIES.items():
        # Four standard deviations of a binomial count.
        assert abs(seen[name] - count * share) < 4 * np.sqrt(count * share * (1 - share))


def test_most_objects_lie_along_the_axes():
    """Of furniture at least two thirds: most of its surface is level or upright along x or y."""
    along = []
    for number in range(120):
        if family((4, number)) not in ("case", "appliance"):
            continue
        triangles = np.concatenate(procedural_object((4, number)))
        normals = np.abs(crosses(triangles))
        along.append(normals.max(axis=1).sum() / np.linalg.norm(normals, axis=1).sum() > 0.97)
    assert len(along) > 20
    assert np.mean(along) > 2 / 3


@pytest.mark.parametrize(("count", "seed", "first"), [(0, 0, 0), (1, -1, 0), (1, 2**32, 0), (1, 0, -1)])
def test_numbers_out_of_range_are_refused(count, seed, first):
    with pytest.raises(BadInputError):
        procedural_grids(count, seed, first=first)


def test_primitives_have_the_bounds_and_volumes_of_their_formulas():
    assert volume(box((1, 2, 3), (5, 6, 7))) == pytest.approx(6)
    assert np.allclose(bounds(box((1, 2, 3), (5, 6, 7))), [[4.5, 5, 5.5], [5.5, 7, 8.5]])
    assert volume(boxes((1, 1, 2), [(0, 0, 0), (4, 0, 0)])) == pytest.approx(4)
    # A regular 12-gon of radius 2 has the area 12 / 2 * 2^2 * sin(30 degrees) = 12.
    assert volume(cylinder(2, 5, 12)) == pytest.approx(60)
    # Outside 4 x 4 x 3, inside 3 x 3 x 2.5.
    assert volume(open_box((4, 4, 3), 0.5)) == pytest.approx(48 - 22.5)
    # A hexagon of radius 1 has the area 3 / 2 * sqrt(3).
    assert volume(tube([(0, 0, 0), (0, 0, 1), (0, 0, 4)], 1.0)) == pytest.approx(4 * 1.5 * np.sqrt(3))


@pytest.mark.parametrize("outline", [SQUARE, ngon(8), rounded(0.2), rounded(0.1, 3.0)])
def test_outlines_fill_a_unit_square_and_run_counter_clockwise(outline):
    assert np.allclose([outline.min(axis=0), outline.max(axis=0)], [[-0.5, -0.5], [0.5, 0.5]])
    following = np.roll(outline, -1, axis=0)
    assert (outline[:, 0] * following[:, 1] - outline[:, 1] * following[:, 0]).min() > 0
