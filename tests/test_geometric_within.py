"""`geometric` on tubs: drawers in cavities, lids, seats over bowls; and what looks like these."""

from itertools import pairwise

import numpy as np
import pytest
import trimesh

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import BOARD, CABINET, HIGH, INSET, Box, bar, box, carcass, joined, panel, turned
from .test_geometric import assert_hinge, found
from .test_geometric_racks import DOOR, case


def tub(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], thick: float = 0.01) -> Mesh:
    """A box without a top, in one piece, its walls of some thickness."""
    outer = trimesh.creation.box(bounds=np.array([x, y, z]).T)
    inner = trimesh.creation.box(
        bounds=np.array([(x[0] + thick, x[1] - thick), (y[0] + thick, y[1] - thick), (z[0] + thick, z[1])]).T
    )
    top = outer.vertices[:, 2] == z[1]
    rim = [np.flatnonzero(top), np.flatnonzero(inner.vertices[:, 2] == z[1])]
    middle = outer.vertices[:, :2].mean(axis=0)
    ring = [
        sorted(corners, key=lambda i: np.arctan2(*(shape.vertices[i, 1::-1] - middle[::-1])))
        for corners, shape in zip(rim, (outer, inner), strict=True)
    ]
    out, into = ring[0], [i + 8 for i in ring[1]]
    lip = [t for k in range(4) for t in _quad(out[k], out[(k + 1) % 4], into[(k + 1) % 4], into[k])]
    open_outer = outer.faces[~top[outer.faces].all(axis=1)]
    open_inner = inner.faces[~(inner.vertices[:, 2] == z[1])[inner.faces].all(axis=1)]
    faces = np.concatenate([open_outer, open_inner[:, ::-1] + 8, lip])
    return Mesh(np.concatenate([outer.vertices, inner.vertices]), faces.astype(np.int32))


def _quad(a: int, b: int, c: int, d: int) -> list[list[int]]:
    return [[a, b, c], [a, c, d]]


def solid(shape: trimesh.Trimesh) -> Mesh:
    return Mesh(np.asarray(shape.vertices), np.asarray(shape.faces, dtype=np.int32))


@pytest.mark.parametrize(("places", "moves"), [((0.0,), True), ((-0.2, -0.1, 0.0, 0.1, 0.2), False)])
def test_a_strip_with_many_things_on_it_is_for_controls(places: tuple[float, ...], moves: bool) -> None:
    strip = box((-0.24, 0.24), (-0.272, -0.252), (0.4, 0.49))
    knobs = [box((x - 0.02, x + 0.02), (-0.3, -0.272), (0.425, 0.465)) for x in places]
    result = found(joined(case(), boxes_mesh([strip, *knobs])))
    assert bool({"door", "drawer"} & result.kinds.keys()) is moves


class TestDrawersWithin:
    @pytest.mark.parametrize("quarter", range(4))
    def test_a_tub_between_the_walls_of_a_cavity_slides_out_of_it(self, quarter: int) -> None:
        inside = tub((-0.21, 0.21), (-0.2, 0.2), (0.035, 0.2))
        result = found(turned(joined(case(), boxes_mesh(DOOR), inside), 90.0 * quarter))
        assert result.kinds == {"door": "revolute", "drawer": "prismatic"}
        outward = np.array([(0, -1, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0)][quarter])
        np.testing.assert_allclose(result.joint("drawer").axis, outward, atol=1e-9)

    def test_its_front_and_handle_go_with_it(self) -> None:
        inside = tub((-0.21, 0.21), (-0.19, 0.2), (0.035, 0.2))
        front = boxes_mesh(
            [box((-0.215, 0.215), (-0.205, -0.1901), (0.033, 0.21)), bar(0, 0.12, -0.205, 0.03)]
        )
        result = found(joined(case(), boxes_mesh(DOOR), inside, front))
        assert result.kinds["drawer"] == "prismatic"
        assert len(result.faces("drawer")) == len(inside.faces) + 24

    def test_a_front_with_a_gap_to_its_tub_is_one_drawer_with_it(self) -> None:
        front = [panel((-0.215, 0.215), -0.27, (0.03, 0.3)), bar(0.0, 0.165, -0.27, upright=False)]
        inside = tub((-0.2, 0.2), (-0.22, 0.2), (0.04, 0.28))
        result = found(joined(case(), boxes_mesh(front), inside))
        assert result.kinds == {"drawer": "prismatic"}
        assert len(result.faces("drawer")) == len(inside.faces) + 24

    @pytest.mark.parametrize(
        "inside",
        [
            tub((-0.1, 0.1), (-0.2, 0.2), (0.035, 0.2)),
            boxes_mesh([box((-0.21, 0.21), (-0.2, 0.2), (0.035, 0.2))]),
        ],
        ids=["with room beside it", "closed above"],
    )
    def test_other_things_between_walls_stay(self, inside: Mesh) -> None:
        assert found(joined(case(), boxes_mesh(DOOR), inside)).kinds == {"door": "revolute"}

    def test_a_sink_has_nothing_above_it(self) -> None:
        counter = [box((-0.6, -0.26), (-0.3, 0.3), (0.8, 0.84)), box((0.26, 0.6), (-0.3, 0.3), (0.8, 0.84))]
        sides = [box((-0.6, -0.26), (-0.3, 0.3), (0.0, 0.8)), box((0.26, 0.6), (-0.3, 0.3), (0.0, 0.8))]
        sink = tub((-0.25, 0.25), (-0.25, 0.25), (0.65, 0.84))
        assert found(joined(boxes_mesh([*counter, *sides]), sink)).kinds == {}


class TestLids:
    TUB = ((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.3))

    @pytest.mark.parametrize("high", [0.02, 0.12], ids=["plate", "vault"])
    def test_what_covers_a_tub_opens_at_its_back(self, high: float) -> None:
        cover = solid(trimesh.creation.box(bounds=[(-0.305, -0.205, 0.301), (0.305, 0.205, 0.301 + high)]))
        result = found(joined(tub(*self.TUB), cover))
        assert list(result.kinds) == ["lid"]
        joint = result.joint("lid")
        assert joint.kind == "revolute"
        assert abs(joint.axis[0]) == pytest.approx(1)
        assert joint.origin[1] == pytest.approx(0.205, abs=0.02)

    def test_its_handle_goes_with_it(self) -> None:
        cover = boxes_mesh(
            [
                box((-0.305, 0.305), (-0.205, 0.205), (0.301, 0.32)),
                box((-0.05, 0.05), (-0.01, 0.01), (0.32, 0.35)),
            ]
        )
        assert len(found(joined(tub(*self.TUB), cover)).faces("lid")) == 24

    def test_the_top_of_a_cabinet_stays(self) -> None:
        assert found([*CABINET, box((-0.26, 0.26), (-0.21, 0.21), (0.7005, 0.72))]).kinds == {}


def bowl(width: float, length: float) -> Mesh:
    """A deep bowl without a top, closed below, on the ground."""
    x, y = (-width / 2, width / 2), (-length / 2, length / 2)
    return tub(x, y, (0.0, 0.4), thick=0.05)


def oval(width: float, length: float, z: tuple[float, float], hole: float) -> Mesh:
    """A flat oval, or a ring with a hole of some share of it."""
    if hole:
        shape = trimesh.creation.annulus(r_min=hole / 2, r_max=0.5, height=z[1] - z[0], sections=48)
    else:
        shape = trimesh.creation.cylinder(radius=0.5, height=z[1] - z[0], sections=48)
    shape.apply_scale([width, length, 1])
    shape.apply_translation([0, 0, sum(z) / 2])
    return solid(shape)


def toilet(width: float = 0.36, length: float = 0.46, hole: float = 0.65) -> Mesh:
    """A bowl with a seat on it and a lid on that, before a cistern."""
    ring = oval(width, length, (0.402, 0.42), hole)
    lid = oval(width, length, (0.422, 0.44), 0)
    cistern = boxes_mesh([box((-0.2, 0.2), (length / 2 + 0.01, length / 2 + 0.18), (0.0, 0.8))])
    return joined(bowl(0.8 * width, 0.8 * length), ring, lid, cistern)


class TestSeats:
    def test_a_seat_and_its_lid_turn_up_at_their_back(self) -> None:
        result = found(toilet())
        assert result.kinds == {"lid": "revolute", "seat": "revolute"}
        for name, height in (("seat", 0.41), ("lid", 0.43)):
            assert_hinge(result.joint(name), (0.0, 0.23, height), "x")
            assert result.travel(name)[:, 2].max() > 0.1  # up

    @pytest.mark.parametrize("shape", [toilet(0.4, 0.4), toilet(hole=0.2)], ids=["round", "a small hole"])
    def test_other_rings_stay(self, shape: Mesh) -> None:
        assert "seat" not in found(shape).kinds


class TestFrontsOfLayers:
    BOX = tub((-0.21, 0.21), (-0.181, 0.15), (0.05, 0.35))

    def drawer(self) -> list[Box]:
        """A plate, a smaller one on it that hides most of it, and a handle on that."""
        return [
            panel(INSET, -0.2, (0.025, 0.45)),
            box((-0.215, 0.215), (-0.212, -0.2), (0.04, 0.435)),
            bar(0.0, 0.24, -0.212, upright=False),
        ]

    def test_all_layers_are_of_the_drawer(self) -> None:
        shelf = box((-0.232, 0.232), (-0.18, 0.19), (0.46, 0.478))
        result = found(joined(boxes_mesh([*CABINET, shelf, *self.drawer()]), self.BOX))
        assert result.kinds == {"drawer": "prismatic"}
        assert len(result.faces("drawer")) == 3 * 12 + len(self.BOX.faces)

    def test_a_front_that_a_smaller_board_on_it_hides_opens_though_it_touches_its_case(self) -> None:
        front = [
            panel((-0.24, 0.24), -0.2 - BOARD, (0.01, 0.69)),
            box((-0.2, 0.2), (-0.228, -0.218), (0.06, 0.64)),
        ]
        result = found([*CABINET, *front])
        assert list(result.kinds.values()) == ["revolute"]
        assert len(result.faces(next(iter(result.kinds)))) == 24

    def test_a_plate_with_a_handle_let_into_a_door_is_of_the_door(self) -> None:
        leaf = panel(INSET, -0.2, HIGH)
        plate = box((-0.1, 0.1), (-0.2005, -0.19), (0.2, 0.5))
        result = found([*CABINET, leaf, plate, bar(0.05, 0.35, -0.2005)])
        assert list(result.kinds.values()) == ["revolute"]
        assert len(result.faces(next(iter(result.kinds)))) == 36


def test_the_lining_of_an_oven_stays_when_its_door_opens() -> None:
    lining = Mesh(case().vertices * (0.8, 0.9, 0.8) + (0, -0.02, 0.05), case().faces)
    result = found(joined(case(), lining, boxes_mesh(DOOR)))
    assert result.kinds == {"door": "revolute"}
    assert len(result.faces("door")) == 24


def test_two_leaves_before_their_frame_both_open() -> None:
    frame = [
        box((-0.6, -0.5), (0.0, 0.1), (0.0, 2.1)),
        box((0.5, 0.6), (0.0, 0.1), (0.0, 2.1)),
        box((-0.5, 0.5), (0.0, 0.1), (2.0, 2.1)),
    ]
    leaves = [panel((-0.54, -0.002), -0.02, (0.01, 2.05)), panel((0.002, 0.54), -0.02, (0.01, 2.05))]
    knobs = [bar(-0.05, 1.0, -0.02), bar(0.05, 1.0, -0.02)]
    result = found([*frame, *leaves, *knobs])
    assert result.kinds == {"left_door": "revolute", "right_door": "revolute"}


def test_an_open_drawer_comes_forward_though_most_of_it_is_seen_from_above() -> None:
    out = 0.3
    box_ = tub((-0.21, 0.21), (-0.181 - out, 0.15 - out), (0.5, 0.62))
    front = [panel(INSET, -0.2 - out, (0.49, HIGH[1])), bar(0.0, 0.58, -0.2 - out, upright=False)]
    result = found(joined(boxes_mesh([*CABINET, *front]), box_))
    assert result.kinds == {"drawer": "prismatic"}
    np.testing.assert_allclose(result.joint("drawer").axis, (0, -1, 0), atol=1e-9)


class TestRows:
    def doors(self, count: int, wall_after: tuple[int, ...], high: float = 1.8) -> list[Box]:
        """A case with so many leaves in a row, and walls between some."""
        wide = 0.4
        half = count * wide / 2
        edges = [-half + wide * k for k in range(count + 1)]
        walls = [
            box((edges[k] - 0.009, edges[k] + 0.009), (-0.2, 0.19), (0.02, high - 0.02)) for k in wall_after
        ]
        leaves = [panel((a + 0.002, b - 0.002), -0.22, (0.03, high - 0.03)) for a, b in pairwise(edges)]
        return [*carcass((-half, half), (-0.2, 0.2), (0.0, high)), *walls, *leaves]

    def test_leaves_hang_where_there_is_a_wall_and_not_where_two_meet(self) -> None:
        result = found(self.doors(4, (2,)))
        assert sorted(result.kinds.values()) == ["revolute"] * 4
        places = sorted(result.joints, key=lambda joint: joint.origin[0])
        assert all(abs(joint.axis[2]) == pytest.approx(1) for joint in places)
        np.testing.assert_allclose([j.origin[0] for j in places], (-0.8, 0.0, 0.0, 0.8), atol=0.02)

    def test_small_leaves_count_in_rows(self) -> None:
        tall = carcass((-0.8, 0.8), (-0.2, 0.2), (0.4, 2.6))
        result = found([*self.doors(4, (1, 2, 3), high=0.4), *tall])
        assert sorted(result.kinds.values()) == ["revolute"] * 4
