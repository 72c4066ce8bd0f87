"""Closed skins: surface nets, what a skin of an object keeps, and `simart-kit generate --skins`."""

import json

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.nano.generate.objects import Body, GeneratedObject, Look, hinge, root, surface
from simart_kit_plugins.nano.generate.skins import skin_of
from simart_kit_plugins.nano.generate.writing import mesh_of
from simart_kit_plugins.shapes.dice import Dice
from simart_kit_plugins.shapes.primitives import between
from simart_kit_plugins.shapes.surface_nets import surface_nets, well_composed

from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.cli.main import run

WOOD, STEEL = Look("wood", (200, 150, 100)), Look("steel", (60, 60, 65))
CELLS = 40
VOXEL = 1 / CELLS


def solid_of(vertices, faces):
    return trimesh.Trimesh(vertices, faces, process=False)


def edge_use(faces):
    """How often each edge is walked from its lower to its higher corner, and back."""
    walked = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ways = np.sort(walked, axis=1)
    _, edge = np.unique(ways, axis=0, return_inverse=True)
    up = walked[:, 0] < walked[:, 1]
    return np.bincount(edge.ravel(), up), np.bincount(edge.ravel(), ~up)


def fans(faces):
    """Number of separate fans of faces about all vertices."""
    # A face's corner goes on to the next face of the fan across the edge that leaves the corner.
    corner = {(faces[f, k], faces[f, (k + 1) % 3]): (f, k) for f in range(len(faces)) for k in range(3)}
    left, count = set(corner.values()), 0
    while left:
        f, k = left.pop()
        count += 1
        while (step := corner[faces[f, k], faces[f, (k + 2) % 3]]) in left:
            left.remove(step)
            f, k = step
    return count


def grid_distance(size, distance):
    return distance(np.stack(np.mgrid[:size, :size, :size], axis=-1).astype(float))


def test_the_net_of_a_ball_is_closed_has_its_size_and_looks_out():
    middle, radius = np.array([11.3, 12.1, 11.8]), 8.0
    vertices, faces = surface_nets(
        grid_distance(24, lambda places: np.linalg.norm(places - middle, axis=-1) - radius)
    )
    ball = solid_of(vertices, faces)
    assert ball.euler_number == 2
    assert ball.volume == pytest.approx(4 / 3 * np.pi * radius**3, rel=0.02)
    assert np.allclose(np.linalg.norm(vertices - middle, axis=1), radius, atol=0.25)
    assert np.einsum("fi,fi->f", ball.face_normals, ball.triangles_center - middle).min() > 0


def test_the_net_of_a_ring_has_one_hole():
    def ring(places):
        x, y, z = np.moveaxis(places - 11.5, -1, 0)
        return np.hypot(np.hypot(x, y) - 7, z) - 3

    assert solid_of(*surface_nets(grid_distance(24, ring))).euler_number == 0


def test_a_net_of_anything_has_two_faces_an_edge_and_one_fan_a_vertex():
    values = np.ones((14, 14, 14))
    values[1:-1, 1:-1, 1:-1] = np.random.default_rng(5).normal(0.6, 1, (12, 12, 12))
    vertices, faces = surface_nets(values)
    there, back = edge_use(faces)
    assert len(faces) > 1000
    assert np.array_equal(there, np.ones_like(there))
    assert np.array_equal(back, np.ones_like(back))
    assert fans(faces) == len(vertices)
    assert solid_of(vertices, faces).volume > 0


def cells_on(*places):
    solid = np.zeros((6, 6, 6), dtype=bool)
    solid[tuple(np.array(places).T)] = True
    return solid


def test_cells_that_touch_at_an_edge_or_a_corner_are_joined_and_others_stay():
    at_edge, at_corner = cells_on((1, 1, 1), (2, 2, 1)), cells_on((1, 1, 1), (2, 2, 2))
    apart, beside = cells_on((1, 1, 1), (3, 1, 1)), cells_on((1, 1, 1), (2, 1, 1))
    # One more makes a way through faces about an edge, two more about a corner.
    assert well_composed(at_edge).sum() == 3
    assert well_composed(at_edge)[1:3, 1:3, 1].sum() == 3
    assert well_composed(at_corner).sum() == 4
    assert well_composed(at_corner)[1:3, 1:3, 1:3].sum() == 4
    assert np.array_equal(well_composed(apart), apart)
    assert np.array_equal(well_composed(beside), beside)
    # Of two holes that touch one is filled.
    assert well_composed(~at_edge).sum() == well_composed(~at_corner).sum() == 6**3 - 1


def test_a_net_that_would_be_cut_off_is_refused():
    with pytest.raises(ValueError, match="larger"):
        surface_nets(-np.ones((4, 4, 4)))


def chest(gap):
    """A hollow box of 1 x 1 x 1 m with a ball in it that nobody sees, and a lid so far above its rim."""
    boards = [
        between((0, 0, 0), (1, 1, 0.04)),
        between((0, 0, 0), (0.04, 1, 0.9)),
        between((0.96, 0, 0), (1, 1, 0.9)),
        between((0, 0, 0), (1, 0.04, 0.9)),
        between((0, 0.96, 0), (1, 1, 0.9)),
    ]
    lid = surface([between((0, 0, 0.9 + gap), (1, 1, 1))], STEEL)
    inside = surface([between((0.4, 0.4, 0.3), (0.6, 0.6, 0.5))], WOOD)
    return GeneratedObject(
        "chest",
        (
            root([surface(boards, WOOD)]),
            Body("lid", "lid", (lid,), 0, hinge((0.5, 1, 0.9), (1, 0, 0), 1.0)),
            Body("treasure", "treasure", (inside,), 0, None),
        ),
    )


def skin(gap, seed=0, cells=CELLS):
    return skin_of(mesh_of(chest(gap), Dice(1)), np.random.default_rng(seed), cells)


def test_a_skin_is_closed_and_as_large_as_the_object_within_a_voxel():
    made = skin(0.0)
    body = solid_of(made.vertices, made.faces)
    assert body.is_watertight
    assert body.is_winding_consistent
    # +Z up, front -Y in ours is +Y up, front +Z in the file.
    grown = (body.bounds - [[0, 0, -1], [1, 1, 0]]) * [[-1], [1]]
    assert (grown > 0.4 * VOXEL).all()
    assert (grown < VOXEL).all()
    assert made.vertices.dtype == np.float32


def test_a_closed_chest_is_solid_and_one_that_stands_open_shows_what_is_in_it():
    closed, opened = skin(0.01), skin(0.09)
    # The gap of 0.4 voxels is bridged, that of 3.6 is not.
    assert np.unique(closed.face_part).tolist() == [0, 1]
    assert np.unique(opened.face_part).tolist() == [0, 1, 2]
    grown = (1 + 2 * 0.66 * VOXEL) ** 3
    assert solid_of(closed.vertices, closed.faces).volume == pytest.approx(grown, rel=0.01)
    assert solid_of(opened.vertices, opened.faces).volume < 0.5
    assert solid_of(opened.vertices, opened.faces).is_watertight


def test_faces_of_a_skin_belong_to_the_part_they_lie_on_and_have_its_color():
    made = skin(0.0)
    middles = made.vertices[made.faces].mean(axis=1)
    above = middles[:, 1] > 0.9 + VOXEL
    below = middles[:, 1] < 0.9 - VOXEL
    assert (made.face_part[above] == 1).all()
    assert (made.face_part[below] == 0).all()
    of_lid = made.colors[made.vertices[:, 1] > 0.9 + VOXEL].astype(int)
    of_box = made.colors[made.vertices[:, 1] < 0.9 - VOXEL].astype(int)
    # Grain darkens wood by up to 22 % and steel by up to 2 %.
    assert np.abs(of_lid - STEEL.color).max() <= 2
    assert (of_box <= WOOD.color).all()
    assert (of_box >= 0.77 * np.array(WOOD.color)).all()


def test_chance_in_a_skin_comes_from_the_generator_alone():
    one, same, other = skin(0.0, 7, 20), skin(0.0, 7, 20), skin(0.0, 8, 20)
    assert np.array_equal(one.vertices, same.vertices)
    assert np.array_equal(one.faces, same.faces)
    assert not np.array_equal(one.vertices, other.vertices)


def test_the_command_writes_skins_that_the_bench_reads_and_the_rest_as_without(tmp_path, capsys):
    plain, one, two = (tmp_path / name for name in ("plain", "one", "two"))
    assert run(["generate", "floor_lamp", "--seed", "3", str(plain)]) == 0
    for out in (one, two):
        assert run(["generate", "floor_lamp", "--seed", "3", "--skins", str(out)]) == 0
    name = "floor_lamp_0000"
    for file in (one / name).iterdir():
        assert file.read_bytes() == (two / name / file.name).read_bytes()
    assert sorted(file.name for file in (one / name).iterdir()) == [
        "fused.glb",
        "fused.npz",
        "gt.json",
        "gt.npz",
        "input.glb",
    ]
    for file in (plain / name).iterdir():
        assert file.read_bytes() == (one / name / file.name).read_bytes()
    truth = SimartBench().read(one / name, "fused")
    labels = np.load(one / name / "fused.npz")["face_part"]
    assert len(truth.articulation.labels) == len(labels)
    assert labels.dtype == np.int32
    capsys.readouterr()
    assert run(["bench", "oracle", str(one), "--variant", "fused", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ok"]
