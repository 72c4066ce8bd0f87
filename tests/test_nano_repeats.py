"""What nearly touches is several parts where its sets of pieces repeat other parts, and are surer alone."""

import numpy as np
import pytest
from simart_kit_plugins.nano.grouping import Group
from simart_kit_plugins.nano.piece_boxes import PieceBoxes
from simart_kit_plugins.nano.repeats import repeated

from .test_nano_parting import Told

HEAD, TAIL, WIDE = (0.04, 0.1, 0.02), (0.03, 0.2, 0.02), (0.09, 0.1, 0.02)


def keys(count, head=HEAD):
    """Boxes of keys beside each other, of a head and a tail each."""
    return [box for k in range(count) for box in (((0.041 * k, 0, 0), head), ((0.041 * k, 0.15, 0), TAIL))]


def told(boxes, between=0.8, within=0.97):
    """Two boxes after each other are a key, with one chance, and of two keys with another."""
    said = Told(boxes, between)
    for k in range(0, len(boxes) - 1, 2):
        said.together[k, k + 1] = said.together[k + 1, k] = within
    return said


def parts(said, *found):
    groups = [Group(np.array(pieces), 0.5) for pieces in found]
    return [sorted(g.pieces.tolist()) for g in repeated(groups, said, PieceBoxes.of(said.cloud), said.area)]


def test_two_keys_that_others_look_like_are_two():
    assert parts(told(keys(4)), [0, 1], [2, 3], [4, 5, 6, 7]) == [[0, 1], [2, 3], [4, 5], [6, 7]]


@pytest.mark.parametrize(
    ("between", "within"), [(0.96, 0.99), (0.8, 0.5)], ids=["nearly sure", "surer together"]
)
def test_what_is_surely_one_or_as_surely_as_each_key_stays_one(between, within):
    groups = [0, 1], [2, 3], [4, 5, 6, 7]
    assert parts(told(keys(4), between, within), *groups) == list(groups)


def test_a_single_other_part_of_that_shape_may_be_chance():
    groups = [0, 1], [2, 3, 4, 5]
    assert parts(told(keys(3)), *groups) == list(groups)
    odd = told([*keys(3), ((0.5, 0, 0), WIDE), ((0.5, 0.15, 0), WIDE), ((0.7, 0, 0), WIDE)])
    assert parts(odd, *groups, [6], [7, 8]) == [*groups, [6], [7, 8]]


def test_a_piece_that_repeats_nothing_keeps_all_of_them_together():
    said = told([*keys(4), ((0.3, 0, 0.1), WIDE)])
    groups = [0, 1], [2, 3], [4, 5, 6, 7, 8]
    assert parts(said, *groups) == list(groups)


def test_what_was_parted_is_what_others_repeat():
    white, black = keys(4), [((0.041 * k + 0.02, 0.2, 0.03), (0.015, 0.1, 0.02)) for k in range(4)]
    said = told([*white, *black])
    found = parts(said, [0, 1], [2, 3], [4, 5, 6, 7, 8], [9], [10], [11])
    assert found == [[0, 1], [2, 3], [4, 5], [6, 7], [8], [9], [10], [11]]
    said = told(keys(7))
    said.together[:] = np.where(said.together < 0.9, 0.8, said.together)
    chain = parts(said, [0, 1, 2, 3], [4, 5], [6, 7], [8, 9, 10, 11, 12, 13])
    assert chain == [[2 * k, 2 * k + 1] for k in range(7)]


def test_of_very_many_pieces_it_is_not_asked():
    groups = [0, 1], [2, 3], list(range(4, 14))
    assert parts(told(keys(7)), *groups) == list(groups)


@pytest.mark.parametrize("found", [[], [[0]], [[0], [1]]])
def test_of_few_parts_nothing_repeats(found):
    assert parts(told(keys(1)), *found) == found
