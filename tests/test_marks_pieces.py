"""Pieces to number: never mixing what a mesh keeps apart, and never too many."""

import numpy as np
from simart_kit_plugins.marks.pieces import joined, numbered_pieces, split

from simart_kit import Mesh
from simart_kit.testing.meshes import box, boxes_mesh

APART = [((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1)), ((9, 0, 0), (9.5, 0.5, 0.5))]


def same(one, two):
    """Whether two labellings part the faces alike."""
    pairs = {(int(a), int(b)) for a, b in zip(one, two, strict=True)}
    return len(pairs) == len({a for a, _ in pairs}) == len({b for _, b in pairs})


def test_boxes_under_one_label_come_apart():
    mesh = boxes_mesh(APART)
    assert same(numbered_pieces(mesh, np.zeros(36, int), 10), np.repeat([0, 1, 2], 12))


def test_boxes_that_meet_at_an_edge_come_apart():
    # They share two vertices and no edge of two faces: the edge between them has four.
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1, 1, 0), (2, 2, 1))])
    assert same(numbered_pieces(mesh, np.zeros(24, int), 10), np.repeat([0, 1], 12))


def test_labels_of_the_proposer_stay_apart():
    mesh = boxes_mesh(APART[:1])
    halves = np.repeat([0, 1], 6)
    assert same(numbered_pieces(mesh, halves, 10), halves)


def test_creases_cut_a_box_into_its_sides_when_asked():
    mesh = boxes_mesh(APART[:1])
    assert same(split(mesh, np.zeros(12, int), np.deg2rad(30), 10), np.repeat(range(6), 2))
    assert same(split(mesh, np.zeros(12, int), np.pi, 10), np.zeros(12))


def test_what_would_come_apart_into_too_many_is_left_whole():
    loose = np.random.default_rng(0).random((60, 3)) + [5, 0, 0]
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    mesh = Mesh(np.concatenate([vertices, loose]), np.concatenate([faces, np.arange(60).reshape(-1, 3) + 8]))
    labels = np.repeat([0, 1], [12, 20])
    assert same(split(mesh, labels, np.pi, 10), labels)
    assert len(np.unique(split(mesh, labels, np.pi, 21))) == 21


def test_the_smallest_piece_joins_what_it_is_next_to():
    screw = ((3.0, 0.4, 0.4), (3.1, 0.5, 0.5))  # on the second box
    mesh = boxes_mesh([*APART[:2], screw])
    assert same(joined(mesh, np.repeat([0, 1, 2], 12), 2), np.repeat([0, 1, 1], 12))


def test_small_pieces_that_touch_join_each_other_before_the_large_one():
    knob = [((1.0, 0.4, 0.4), (1.1, 0.6, 0.6)), ((1.1, 0.4, 0.4), (1.2, 0.6, 0.6))]
    mesh = boxes_mesh([APART[0], *knob])
    assert same(joined(mesh, np.repeat([0, 1, 2], 12), 2), np.repeat([0, 1, 1], 12))


def test_thousands_of_pieces_are_joined_by_place():
    places = [(x, y, z) for x in range(12) for y in range(12) for z in range(5)]
    mesh = boxes_mesh([(p, np.add(p, 0.3)) for p in places])
    piece = numbered_pieces(mesh, np.repeat(np.arange(720), 12), 40)
    assert np.array_equal(np.unique(piece), np.arange(40))
    assert all(len(np.unique(piece[12 * i : 12 * i + 12])) == 1 for i in range(720))
    areas = np.bincount(piece, mesh.face_areas)
    assert np.all(np.diff(areas) <= 1e-9)  # largest first
