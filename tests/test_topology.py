"""How faces hang together, against numpy, networkx and hand-made cases."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.arrays import IntArray
from simart_kit.topology import (
    connected,
    edges,
    half_edges,
    neighbours,
    occurring,
    shared_by_two,
    stable_order,
    touching,
    unique_rows,
    without_gaps,
)

# Two triangles that share an edge, one that meets them in a corner, one alone.
FACES = np.array([[0, 1, 2], [2, 1, 3], [3, 4, 5], [6, 7, 8]])
few_faces = st.lists(st.tuples(*[st.integers(0, 6)] * 3), max_size=12).map(
    lambda rows: np.array(rows, dtype=np.int64).reshape(-1, 3)
)


@given(rows=few_faces)
def test_unique_rows_are_those_of_numpy(rows: IntArray) -> None:
    first, ids = unique_rows(rows)
    expected, expected_first, expected_ids = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    np.testing.assert_array_equal(rows[first], expected)
    np.testing.assert_array_equal(first, expected_first)
    np.testing.assert_array_equal(ids, expected_ids.reshape(-1))


@pytest.mark.parametrize("ids", [[], [0], [2, 0, 2, 1], [3, 1, 3], [[0, 7], [7, 1]], [900, 3, 900]], ids=str)
def test_ids_that_occur_are_those_of_numpy(ids):
    given = np.array(ids, dtype=np.int64)
    expected, which = np.unique(given, return_inverse=True)
    np.testing.assert_array_equal(occurring(given), expected)
    used, found = without_gaps(given)
    np.testing.assert_array_equal(used, expected)
    np.testing.assert_array_equal(found, which.reshape(given.shape))


def test_an_edge_has_one_id_whichever_way_it_is_walked() -> None:
    edge = edges(FACES)
    assert edge[0, 1] == edge[1, 0]  # 1 -> 2 and 2 -> 1
    assert len(np.unique(edge)) == 11


def test_neighbours_share_the_edge_between_them() -> None:
    edge, left, right = neighbours(FACES)
    assert (left.tolist(), right.tolist()) == ([0], [1])
    assert edge.tolist() == [edges(FACES)[0, 1]]


def test_three_faces_around_an_edge_are_two_pairs() -> None:
    edge, left, right = neighbours(np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]]))
    assert (left.tolist(), right.tolist()) == ([0, 1], [1, 2])
    assert edge[0] == edge[1]


def test_faces_that_share_a_corner_touch() -> None:
    label = touching(FACES)
    assert label[0] == label[1] == label[2] != label[3]


@given(faces=few_faces)
def test_pieces_are_the_components_of_the_graph_of_corners(faces: IntArray) -> None:
    graph = nx.Graph(
        [(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, 1), strict=True)]
    )
    pieces = [
        {i for i, face in enumerate(faces) if face[0] in part} for part in nx.connected_components(graph)
    ]
    label = touching(faces)
    found = [set(np.flatnonzero(label == i).tolist()) for i in np.unique(label)]
    assert sorted(map(sorted, found)) == sorted(map(sorted, pieces))


@pytest.mark.parametrize("links", [1, 256])
def test_a_link_may_be_given_many_times(links: int) -> None:
    assert connected(3, np.zeros(links, dtype=int), np.ones(links, dtype=int)).tolist() == [0, 0, 1]


@pytest.mark.parametrize("step", [1, 1 << 59])
def test_equal_keys_stay_in_order_also_where_no_bits_are_left_for_the_index(step):
    keys = np.array([3, 0, 3, 1, 0, 3]) * step
    order, ordered = stable_order(keys)
    assert order.tolist() == [1, 4, 3, 0, 2, 5]
    assert ordered.tolist() == (np.array([0, 0, 1, 3, 3, 3]) * step).tolist()


def test_rows_that_63_bits_cannot_hold_are_told_apart():
    rows = np.array([[1 << 40, 0, 5], [-(1 << 40), 7, 1 << 40], [1 << 40, 0, 5], [1 << 40, 0, -5]])
    first, ids = unique_rows(rows)
    assert first.tolist() == [1, 3, 0]
    assert ids.tolist() == [2, 0, 2, 1]


def test_only_edges_of_exactly_two_faces_are_pairs():
    # Edge 0-1 has three faces, 1-2 has two, all others one.
    half, edge = half_edges(np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4], [5, 2, 1]]))
    first = shared_by_two(edge)
    assert np.stack([half[first], half[first + 1]], axis=1).tolist() == [[1, 10]]  # 3 * face + side


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(*[st.integers(0, 30)] * 3), min_size=1, max_size=14), st.data())
def test_known_pieces_change_nothing_about_what_touches(rows, data):
    faces = np.array(rows)
    whole = touching(faces)
    # Any finer labelling is true: each piece cut in up to three.
    cut = data.draw(st.lists(st.integers(0, 2), min_size=len(rows), max_size=len(rows)))
    pieces = np.unique(whole * 3 + np.array(cut), return_inverse=True)[1].reshape(-1)
    assert touching(faces, pieces).tolist() == whole.tolist()
