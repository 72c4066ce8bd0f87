"""The farthest of many points: the same as asking all of them."""

import numpy as np
import pytest

from simart_kit.farthest import farthest

COUNT = 40_000


def ball():
    return np.random.default_rng(0).normal(size=(COUNT, 3))


def sheet():
    return np.random.default_rng(1).random((COUNT, 3)) * [1, 1, 0]


def one_place():
    return np.ones((COUNT, 3))


def repeated():
    return np.tile(np.random.default_rng(2).normal(size=(COUNT // 4, 3)), (4, 1))


@pytest.mark.parametrize("make", [ball, sheet, one_place, repeated])
def test_cells_leave_out_no_point_that_is_farthest(make):
    points = make()
    directions = np.concatenate([np.eye(3), -np.eye(3), np.random.default_rng(3).normal(size=(40, 3))])
    found = farthest(points, directions)
    products = directions @ points.T
    assert np.allclose(products[np.arange(len(found)), found], products.max(axis=1), rtol=0, atol=1e-12)


def test_of_several_the_first_is_named():
    assert farthest(repeated(), np.array([[0.6, 0.0, 0.8]])) < COUNT // 4
    few = np.array([[0.0, 0, 0], [2, 1, 0], [2, 3, 0]])
    assert farthest(few, np.array([[1.0, 0, 0], [0, 1, 0]])).tolist() == [1, 2]
