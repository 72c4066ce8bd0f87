"""What lies apart and is as large is several parts, unless it is nearly sure to be one."""

from dataclasses import dataclass, field

import numpy as np
import pytest
from simart_kit_plugins.nano.grouping import Group, group_of
from simart_kit_plugins.nano.parting import parted
from simart_kit_plugins.nano.scene import pieces_of

from .test_nano_siblings import cloud_of

LEAF, HANDLE = (0.3, 0.02, 0.5), (0.02, 0.04, 0.1)


@dataclass
class Told:
    """What the network says of boxes of (middle, size): all move, two are together with one chance."""

    boxes: list
    chance: float
    together: np.ndarray = field(init=False)

    def __post_init__(self):
        self.cloud = cloud_of(self.boxes)
        count = self.cloud.count
        self.area = np.bincount(self.cloud.piece, self.cloud.area, count)
        self.gap = pieces_of(self.cloud).gap
        self.moves = np.ones(count)
        self.together = np.full((count, count), self.chance)
        np.fill_diagonal(self.together, 1.0)

    def parts_of(self, *found):
        groups = [Group(np.array(pieces), 0.5) for pieces in found]
        return [group.pieces.tolist() for group in parted(groups, self, self.cloud, self.area)]


@pytest.mark.parametrize(("chance", "expected"), [(0.8, [[0], [1]]), (0.9, [[0, 1]])])
def test_two_leaves_that_lie_apart_are_one_part_only_if_that_is_nearly_sure(chance, expected):
    told = Told([((-0.2, 0, 0), LEAF), ((0.2, 0, 0), LEAF)], chance)
    assert told.parts_of([0, 1]) == expected


def test_leaves_that_touch_are_one_part():
    told = Told([((-0.15, 0, 0), LEAF), ((0.15, 0, 0), LEAF)], 0.6)
    assert told.parts_of([0, 1]) == [[0, 1]]


def test_a_small_piece_apart_stays_with_what_it_belongs_with():
    handles = [((-0.1, -0.1, 0), HANDLE), ((0.1, -0.1, 0), HANDLE)]
    told = Told([((-0.2, 0, 0), LEAF), ((0.2, 0, 0), LEAF), *handles], 0.6)
    assert told.parts_of([0, 2]) == [[0, 2]]
    for leaf, handle in ((0, 2), (1, 3)):
        told.together[leaf, handle] = told.together[handle, leaf] = 0.7
    assert told.parts_of([0, 1, 2, 3]) == [[0, 2], [1, 3]]


def test_clusters_beside_much_else_are_no_parts():
    small = [((x, 0, z), (0.05, 0.05, 0.05)) for x in (-0.3, 0.3) for z in (-0.3, 0, 0.3)]
    told = Told([((-0.1, 0, 0), (0.1, 0.1, 0.1)), ((0.1, 0, 0), (0.1, 0.1, 0.1)), *small], 0.6)
    assert told.parts_of(range(8)) == [list(range(8))]


@pytest.mark.parametrize(("third", "expected"), [(LEAF, [[0], [1], [2]]), ((0.1, 0.02, 0.5), [[0, 1], [2]])])
def test_what_is_shaped_as_another_part_is_a_part_however_sure_it_is_to_be_more(third, expected):
    boxes = [((-0.35, 0, 0), LEAF), ((-0.04, 0, 0), LEAF), ((0.3, 0, 0), third)]
    assert Told(boxes, 0.95).parts_of([0, 1], [2]) == expected


def test_each_part_has_the_sureness_of_its_own_pieces():
    told = Told([((-0.2, 0, 0), LEAF), ((0.2, 0, 0), LEAF)], 0.6)
    told.moves[:] = 0.9, 0.7
    (one, other) = parted([Group(np.array([0, 1]), 0.5)], told, told.cloud, told.area)
    assert (one.score, other.score) == (pytest.approx(0.9), pytest.approx(0.7))
    both = group_of(np.array([0, 1]), told.moves, told.together, told.area)
    assert both.score == pytest.approx(0.8 * 0.8)
