"""Solids of closed faces, and faces that hold none."""

from __future__ import annotations

import numpy as np
import pytest

from simart_kit.arrays import IntArray
from simart_kit.pieces import solid_body
from simart_kit.testing.meshes import box

CUBE = box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
OPEN = {
    "without a side": CUBE[1][2:],
    "with a fin": np.concatenate([CUBE[1], [(*CUBE[1][0, :2], 7)]]),
    "with a side twice": np.concatenate([CUBE[1], CUBE[1][:1]]),
    # manifold3d 3.5.4 ends the process when it is given these.
    "a pyramid without a base, and a leaf": np.array([[6, 7, 5], [1, 3, 0], [2, 1, 0], [4, 2, 0], [3, 4, 0]]),
}


@pytest.mark.parametrize("turned", [False, True])
def test_a_closed_surface_is_a_solid_whichever_way_it_is_wound(turned: bool) -> None:
    vertices, faces = CUBE
    body = solid_body(vertices, faces[:, ::-1] if turned else faces)
    assert body is not None
    assert body.volume() == pytest.approx(1.0)


@pytest.mark.parametrize("faces", OPEN.values(), ids=OPEN)
def test_a_surface_that_closes_nothing_is_none(faces: IntArray) -> None:
    assert solid_body(CUBE[0], faces) is None
