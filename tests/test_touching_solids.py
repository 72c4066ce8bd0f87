"""Solids of cells that share edges and faces with others, as modellers who snap to a grid make them."""

from itertools import product

import numpy as np
import pytest

from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments

BLOCK = set(product(range(3), range(3), range(3)))
DRAWER = {(1, 0, 1), (1, 1, 1)}
BODY = BLOCK - DRAWER
POLE = {(9, 9, z) for z in range(9)}  # apart from all else, so that nothing spans the object and is cut up


def surface(cells):
    """(F, 3, 3) triangles around cells of side 1, wound counter-clockwise from outside."""
    triangles = []
    for cell in sorted(cells):
        for axis, sign in product(range(3), (-1, 1)):
            step = np.zeros(3, dtype=int)
            step[axis] = sign
            if tuple(np.array(cell) + step) in cells:
                continue
            one, two = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            low = np.array(cell, dtype=float) + (step > 0)
            quad = [low, low + one, low + one + two, low + two][::sign]
            triangles += [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
    return np.array(triangles)


def segments_of(*solids):
    """Segments of the faces of some solids' triangles, beside a pole, one set a solid."""
    triangles = np.concatenate([*solids, surface(POLE)])
    vertices = triangles.reshape(-1, 3)
    mesh = Mesh(vertices, np.arange(len(vertices)).reshape(-1, 3))
    found = find_segments(mesh).face_segment
    return [set(part.tolist()) for part in np.split(found, np.cumsum([len(s) for s in solids]))[:-1]]


def test_a_drawer_that_fills_its_bay_is_a_segment_of_its_own():
    body, drawer = segments_of(surface(BODY), surface(DRAWER))
    assert (body, drawer) == ({0}, {2})


def test_a_peg_through_a_board_is_a_segment_of_its_own():
    board = {(x, 0, z) for x, z in product(range(5), range(5))} - {(2, 0, 2)}
    found = segments_of(surface(board), surface({(2, 0, 2)}))
    assert found == [{0}, {2}]


def test_faces_of_drawer_and_bay_may_be_cut_along_other_diagonals():
    drawer = surface(DRAWER).reshape(-1, 2, 3, 3)
    quads = np.stack([drawer[:, 0, 0], drawer[:, 0, 1], drawer[:, 0, 2], drawer[:, 1, 2]], axis=1)
    other = np.concatenate([quads[:, [0, 1, 3]], quads[:, [1, 2, 3]]])
    assert segments_of(surface(BODY), other) == [{0}, {2}]


def test_a_block_that_stands_on_another_stays_with_it():
    on_top = {(1, 1, 3)}
    assert segments_of(surface(BLOCK), surface(on_top)) == [{0}, {0}]


@pytest.mark.parametrize("cells", [BODY, BLOCK])
def test_the_back_of_a_surface_that_is_there_twice_stays_with_its_front(cells):
    assert segments_of(surface(cells), surface(cells)[:, ::-1]) == [{0}, {0}]


def test_solids_wound_at_random_stay_together():
    rng = np.random.default_rng(0)
    drawer = surface(DRAWER)
    turned = np.where(rng.random(len(drawer))[:, None, None] < 0.5, drawer, drawer[:, ::-1])
    assert segments_of(surface(BODY), turned) == [{0}, {0}]
