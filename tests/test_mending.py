"""Pieces that are put together again."""

import numpy as np

import simart_kit.mending as mending
from simart_kit.hulls import hull_corners
from simart_kit.pieces import hulled
from simart_kit.testing.meshes import box


def test_no_two_pieces_are_put_together_twice(monkeypatch):
    asked = []
    monkeypatch.setattr(mending, "hull_corners", lambda points: asked.append(points) or hull_corners(points))
    row = [hulled(box((0.1 * i, 0.0, 0.0), (0.1 * i + 0.1, 0.1 + 0.05 * i, 0.1))[0]) for i in range(6)]
    left = mending.mended(row, 3, 1.02, 1e-9)
    assert len(left) == 3
    assert len({points.tobytes() for points in asked}) == len(asked)
    assert np.isclose(sum(piece.volume for piece in left), sum(piece.volume for piece in row))
