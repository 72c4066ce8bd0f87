"""Bent rods in straight runs: they hold what the rods do, cover them, and nothing else is touched."""

from __future__ import annotations

import manifold3d
import numpy as np
import pytest
import trimesh

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.decompose import Budget, decompose
from simart_kit.hulls import hull_of
from simart_kit.pieces import Piece, piece_of
from simart_kit.straightening import straightened
from simart_kit.triangles import unit_normals

Bar = tuple[tuple[float, float, float], tuple[float, float, float]]
THICK = 0.004
FRAME: list[Bar] = [
    ((0, 0, 0), (0.3, THICK, THICK)),
    ((0, 0.2 - THICK, 0), (0.3, 0.2, THICK)),
    ((0, 0, 0), (THICK, 0.2, THICK)),
    ((0.3 - THICK, 0, 0), (0.3, 0.2, THICK)),
]


def united(bars: list[Bar]) -> manifold3d.Manifold:
    cubes = [manifold3d.Manifold.cube(tuple(np.subtract(b, a))).translate(a) for a, b in bars]
    return manifold3d.Manifold.batch_boolean(cubes, manifold3d.OpType.Add)


def bent_rod(corners: FloatArray, radius: float = THICK / 2) -> manifold3d.Manifold:
    """Round bars from corner to corner of a (N, 3) way."""
    bars = [
        trimesh.creation.cylinder(radius, segment=ends, sections=8)
        for ends in np.stack([corners[:-1], corners[1:]], axis=1)
    ]
    solids = [
        manifold3d.Manifold(manifold3d.Mesh64(bar.vertices, bar.faces.astype(np.uint64))) for bar in bars
    ]
    return manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)


def held(pieces: list[Piece]) -> float:
    return float(sum(piece.hull_volume for piece in pieces))


def within(points: FloatArray, pieces: list[Piece]) -> BoolArray:
    """(N,) which of (N, 3) points lie in a piece's hull."""
    found = np.zeros(len(points), dtype=bool)
    for piece in pieces:
        hull = hull_of(piece.points)
        assert hull is not None
        normals = unit_normals(hull.vertices[hull.faces])
        ends = np.einsum("fi,fi->f", normals, hull.vertices[hull.faces[:, 0]])
        found |= (points @ normals.T <= ends + 1e-9).all(axis=1)
    return found


@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_a_frame_becomes_its_bars(turn: float) -> None:
    piece = piece_of(united(FRAME).rotate((0, 0, np.degrees(turn))))
    solid = THICK**2 * (0.3 + 0.3 + 2 * (0.2 - 2 * THICK))
    assert piece.hull_volume == pytest.approx(0.3 * 0.2 * THICK, rel=1e-6)
    runs = straightened([piece], 0)
    assert held(runs) < 1.5 * solid
    assert sum(run.volume for run in runs) == pytest.approx(solid, rel=0.05)


def test_a_wire_that_winds_up_and_down_is_covered_by_its_runs() -> None:
    ways = [(0.05 * (k // 2), 0.0, 0.1 * ((k + 1) // 2 % 2)) for k in range(12)]
    body = bent_rod(np.array(ways))
    runs = straightened([piece_of(body)], 0)
    assert held(runs) < 1.5 * body.volume()
    mesh = body.to_mesh64()
    triangles = np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts).astype(np.int64)]
    assert within(np.concatenate([triangles.reshape(-1, 3), triangles.mean(axis=1)]), runs).all()


def test_boards_solids_and_what_has_few_faces_stay_as_they_are() -> None:
    tray = united([((0, 0, 0), (0.3, 0.2, 0.02)), ((0, 0, 0), (0.02, 0.2, 0.1))])
    frame = piece_of(united(FRAME))
    assert frame.body is not None
    pieces = [piece_of(tray), Piece(np.eye(3), 1.0, 20.0, None)]
    assert straightened(pieces, 0) == pieces
    assert straightened([frame], frame.body.num_tri()) == [frame]


def test_a_basket_of_more_wires_than_shapes_stays_open() -> None:
    """A tub of wires, each bent twice: one hull a wire would fill it."""
    places = np.linspace(-0.2, 0.2, 10)
    ways = [np.array([(x, -0.2, 0.2), (x, -0.2, 0.0), (x, 0.2, 0.0), (x, 0.2, 0.2)]) for x in places]
    ways += [np.array([(-0.21, y, 0.2), (-0.21, y, 0.0), (0.21, y, 0.0), (0.21, y, 0.2)]) for y in places]
    meshes = [bent_rod(way).to_mesh64() for way in ways]
    vertices = [np.asarray(mesh.vert_properties)[:, :3] for mesh in meshes]
    starts = np.cumsum([0, *map(len, vertices[:-1])])
    faces = [
        np.asarray(mesh.tri_verts).astype(np.int64) + at for mesh, at in zip(meshes, starts, strict=True)
    ]
    budget = Budget(shapes=16, tool_seconds=0.0)
    found = decompose(np.concatenate(vertices), np.concatenate(faces), budget)
    assert len(found.shapes) <= 16
    inner = np.array([(x, y, z) for x in (-0.15, 0.0, 0.15) for y in (-0.15, 0.15) for z in (0.03, 0.15)])
    shapes = [Piece(shape.vertices, 0.0, 0.0, None) for shape in found.shapes]
    assert not within(inner, shapes).any()
