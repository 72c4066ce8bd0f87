"""Bounding boxes, against numpy's own reductions."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from simart_kit.arrays import FloatArray
from simart_kit.bounds import bounds_by, bounds_of, triangle_bounds

triangles3 = st.integers(1, 9).flatmap(
    lambda n: arrays(np.float64, (n, 3, 3), elements=st.floats(-1e6, 1e6, width=32))
)


@settings(max_examples=50, deadline=None)
@given(triangles=triangles3)
def test_boxes_of_points_and_of_triangles(triangles: FloatArray) -> None:
    lower, upper = bounds_of(triangles.reshape(-1, 3))
    np.testing.assert_array_equal(lower, triangles.min(axis=(0, 1)))
    np.testing.assert_array_equal(upper, triangles.max(axis=(0, 1)))
    lows, highs = triangle_bounds(triangles)
    np.testing.assert_array_equal(lows, triangles.min(axis=1))
    np.testing.assert_array_equal(highs, triangles.max(axis=1))


@given(triangles=triangles3, label=st.lists(st.integers(0, 3), min_size=9, max_size=9))
def test_boxes_by_label_are_those_of_the_triangles_that_have_it(triangles, label) -> None:
    _, labels = np.unique(label[: len(triangles)], return_inverse=True)
    expected = [bounds_of(triangles[labels == one].reshape(-1, 3)) for one in range(labels.max() + 1)]
    np.testing.assert_array_equal(bounds_by(triangles, labels), expected)


def test_no_triangles_have_no_boxes() -> None:
    lows, highs = triangle_bounds(np.zeros((0, 3, 3)))
    assert lows.shape == highs.shape == (0, 3)
