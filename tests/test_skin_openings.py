"""Skins that are cut into pieces: leaves of windows by panes, frames and tracks, and fronts by handles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from simart_kit_plugins.geometric.contact import Contacts
from simart_kit_plugins.geometric.fronts import find_fronts
from simart_kit_plugins.geometric.movers import Mover, front_movers
from simart_kit_plugins.geometric.open_leaves import standing_open
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.scene import Scene, make_scene
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.geometric.skin_fronts import gripped, portholes
from simart_kit_plugins.geometric.skin_windows import window_leaves

from simart_kit.arrays import FloatArray
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins

from .real_objects import DATA, needs_data

Corners = tuple[tuple[float, float, float], tuple[float, float, float]]
TURN = Rotation.from_euler("z", 8, degrees=True).as_matrix()


class Skin:
    """Faces with the pieces that a skin would be cut into."""

    def __init__(self) -> None:
        self.triangles: list[FloatArray] = []
        self.pieces: list[int] = []

    def add(
        self, corners: Corners, front: int, back: int, sides: int, turn: FloatArray | None = None
    ) -> None:
        """A box: the pieces of its front (-Y), back and other sides; -1 leaves them out."""
        low, high = np.array(corners)
        box = trimesh.creation.box(bounds=[low, high]).subdivide().subdivide()
        for triangle, normal in zip(box.triangles, box.face_normals, strict=True):
            piece = front if normal[1] < -0.9 else back if normal[1] > 0.9 else sides
            if piece >= 0:
                self.triangles.append(triangle if turn is None else (triangle - low) @ turn.T + low)
                self.pieces.append(piece)

    def scene(self) -> Scene:
        """All that was added."""
        places = np.array(self.triangles).reshape(-1, 3)
        mesh = Mesh(places, np.arange(len(places)).reshape(-1, 3))
        return make_scene(mesh, np.array(self.pieces))

    def leaves(self, known: Sequence[int] = ()) -> list[Mover]:
        """What moves of a window."""
        return window_leaves(self.scene(), set(known))


def bars(
    low: tuple[float, float], high: tuple[float, float], y: tuple[float, float], bar: float
) -> list[Corners]:
    """The four bars of a frame around a rectangle (x, z) [m]."""
    (x, z), (far_x, far_z) = low, high
    return [
        ((x, y[0], z), (x + bar, y[1], far_z)),
        ((far_x - bar, y[0], z), (far_x, y[1], far_z)),
        ((x + bar, y[0], z), (far_x - bar, y[1], z + bar)),
        ((x + bar, y[0], far_z - bar), (far_x - bar, y[1], far_z)),
    ]


def jambs(thick: float = 0.12) -> Skin:
    """The frame in the wall, 0.8 x 1.0 m, of piece 0."""
    skin = Skin()
    for bar in bars((0, 0), (0.8, 1.0), (0, thick), 0.04):
        skin.add(bar, 0, 0, 0)
    return skin


def pane(skin: Skin, x: tuple[float, float], z: tuple[float, float], y: float, first: int) -> None:
    """A pane of piece `first`, in a frame before it and one behind it of the next two."""
    for bar in bars((x[0], z[0]), (x[1], z[1]), (y - 0.01, y + 0.02), 0.06):
        skin.add(bar, first + 1, first + 2, -1)
    skin.add(((x[0] + 0.06, y, z[0] + 0.06), (x[1] - 0.06, y + 0.01, z[1] - 0.06)), first, first, first)


def handle(skin: Skin, x: float, piece: int) -> None:
    """A handle that is of one piece with a frame."""
    skin.add(((x, -0.06, 0.46), (x + 0.02, -0.02, 0.54)), piece, piece, piece)


def test_two_panes_in_frames_with_a_handle_turn_with_their_frames() -> None:
    skin = jambs()
    pane(skin, (0.04, 0.40), (0.04, 0.96), 0.0, 1)
    pane(skin, (0.40, 0.76), (0.04, 0.96), 0.0, 4)
    assert skin.leaves() == []
    handle(skin, 0.37, 2)
    found = skin.leaves()
    assert [mover.label for mover in found] == ["door", "door"]
    assert [set(mover.pieces) for mover in found] == [{1, 2, 3}, {4, 5, 6}]


@pytest.mark.parametrize("bar", [0.03, 0.15])
def test_panes_above_one_another_with_but_a_bar_between_are_of_one_leaf(bar: float) -> None:
    """With a beam between they are two windows of four panes, of which nothing is told."""
    skin = jambs()
    middle = (0.5 - bar / 2, 0.5 + bar / 2)
    for x, first in (((0.04, 0.40), 1), ((0.40, 0.76), 5)):
        inside = (x[0] + 0.06, x[1] - 0.06)
        beam = ((inside[0], -0.01, middle[0]), (inside[1], 0.02, middle[1]))
        for box in [*bars((x[0], 0.04), (x[1], 0.96), (-0.01, 0.02), 0.06), beam]:
            skin.add(box, first, first + 1, -1)
        for piece, z in ((first + 2, (0.10, middle[0])), (first + 3, (middle[1], 0.90))):
            skin.add(((inside[0], 0.0, z[0]), (inside[1], 0.01, z[1])), piece, piece, piece)
    handle(skin, 0.37, 1)
    found = [set(mover.pieces) for mover in skin.leaves()]
    assert found == ([{1, 2, 3, 4}, {5, 6, 7, 8}] if bar < 0.1 else [])


def test_a_single_pane_in_a_frame_with_a_handle_turns_unless_it_is_known() -> None:
    skin = jambs()
    pane(skin, (0.04, 0.76), (0.04, 0.96), 0.0, 1)
    assert skin.leaves() == []
    handle(skin, 0.71, 2)
    assert [set(mover.pieces) for mover in skin.leaves()] == [{1, 2, 3}]
    assert skin.leaves(known=(1,)) == []


def test_panes_side_by_side_in_two_tracks_slide_and_of_two_above_one_another_the_lower() -> None:
    skin = jambs()
    pane(skin, (0.04, 0.42), (0.04, 0.96), 0.02, 1)
    pane(skin, (0.38, 0.76), (0.04, 0.96), 0.06, 4)
    assert [mover.label for mover in skin.leaves()] == ["sliding_door", "sliding_door"]
    sashes = jambs()
    pane(sashes, (0.04, 0.76), (0.04, 0.52), 0.02, 1)
    pane(sashes, (0.04, 0.76), (0.48, 0.96), 0.06, 4)
    (lower,) = sashes.leaves()
    assert (lower.label, set(lower.pieces)) == ("sash", {1, 2, 3})


def test_stiles_where_sliding_leaves_meet_go_with_the_leaf_in_whose_track_they_are() -> None:
    skin = jambs()
    pane(skin, (0.04, 0.42), (0.04, 0.96), 0.02, 1)
    pane(skin, (0.38, 0.76), (0.04, 0.96), 0.06, 4)
    for piece, y, z in ((7, 0.01, (0.04, 0.96)), (8, 0.05, (0.04, 0.5)), (9, 0.05, (0.5, 0.96))):
        skin.add(((0.36, y, z[0]), (0.44, y + 0.03, z[1])), piece, piece, piece)
    assert [set(mover.pieces) for mover in skin.leaves()] == [{1, 2, 3, 7}, {4, 5, 6, 8, 9}]
    sashes = jambs()
    pane(sashes, (0.04, 0.76), (0.04, 0.52), 0.02, 1)
    pane(sashes, (0.04, 0.76), (0.48, 0.96), 0.06, 4)
    for piece, y in ((7, 0.01), (8, 0.05)):
        sashes.add(((0.03, y, 0.46), (0.77, y + 0.03, 0.54)), piece, piece, piece)
    assert [set(mover.pieces) for mover in sashes.leaves()] == [{1, 2, 3, 7}]


def levered(skin: Skin, x: float, piece: int, behind: int) -> None:
    """A lever before a leaf, and one behind it."""
    for y, number in (((-0.06, 0.0), piece), ((0.04, 0.1), behind)):
        skin.add(((x, y[0], 0.46), (x + 0.1, y[1], 0.54)), number, number, number)


def fronts_of(skin: Skin) -> list[Mover]:
    scene = skin.scene()
    return front_movers(scene, Contacts(scene), fused=True)


def test_a_leaf_that_fills_its_frame_opens_and_not_both() -> None:
    skin = Skin()
    for bar in bars((0, 0), (0.8, 1.6), (0.0, 0.04), 0.1):
        skin.add(bar, 1, 1, 1)
    skin.add(((0.1, 0.0, 0.1), (0.7, 0.04, 1.5)), 0, 0, -1)
    levered(skin, 0.58, 2, 3)
    (door,) = fronts_of(skin)
    assert (door.label, set(door.pieces)) == ("door", {0, 2, 3})


def test_a_lever_behind_a_leaf_goes_with_it_though_it_touches_the_next_one() -> None:
    skin = Skin()
    skin.add(((0, 0, 0), (0.8, 0.04, 1.6)), 0, 0, 0)
    skin.add(((0.8, 0, 0), (1.6, 0.04, 1.6)), 1, 1, 1)
    levered(skin, 0.8, 2, 3)
    leaves = {mover.pieces[0]: set(mover.pieces) for mover in fronts_of(skin)}
    assert leaves[1] == {1, 2, 3}


def test_what_lies_in_two_leaves_goes_with_one() -> None:
    skin = jambs()
    pane(skin, (0.04, 0.42), (0.04, 0.96), 0.02, 1)
    pane(skin, (0.38, 0.76), (0.04, 0.96), 0.06, 4)
    skin.add(((0.395, 0.02, 0.45), (0.405, 0.05, 0.5)), 7, 7, 7)
    one, other = (set(mover.pieces) for mover in skin.leaves())
    assert one | other == {1, 2, 3, 4, 5, 6, 7}
    assert not one & other


def test_a_pane_that_stands_ajar_turns_and_so_does_its_like() -> None:
    skin = jambs()
    skin.add(((0.05, 0.0, 0.06), (0.39, 0.02, 0.94)), 1, 1, 1)
    skin.add(((0.41, -0.02, 0.06), (0.75, 0.0, 0.94)), 2, 2, 2, TURN)
    assert [mover.label for mover in skin.leaves()] == ["door", "door"]


def test_panes_of_unlike_size_and_of_what_is_thick_stay() -> None:
    unlike = jambs()
    pane(unlike, (0.04, 0.30), (0.04, 0.96), 0.02, 1)
    pane(unlike, (0.30, 0.76), (0.04, 0.96), 0.06, 4)
    assert unlike.leaves() == []
    thick = jambs(0.5)
    pane(thick, (0.04, 0.42), (0.04, 0.96), 0.02, 1)
    pane(thick, (0.38, 0.76), (0.04, 0.96), 0.06, 4)
    assert thick.leaves() == []


def desk(handles: Sequence[tuple[float, float]]) -> Skin:
    """A block with three panels before it, each with a handle at (x, z) or none, and a leg beside it."""
    skin = Skin()
    skin.add(((0, 0, 0), (0.4, 0.4, 0.9)), 0, 1, 2)
    skin.add(((0.4, 0, 0.85), (1.2, 0.4, 0.9)), 3, 3, 3)
    skin.add(((1.15, 0, 0), (1.2, 0.4, 0.85)), 4, 4, 4)
    for number, (x, z) in enumerate(handles):
        low = 0.03 + 0.29 * number
        skin.add(((0.02, -0.02, low), (0.38, 0, low + 0.26)), 5 + number, 5 + number, 5 + number)
        if z:
            half = min(0.06, 0.38 - x)
            at = ((x - half, -0.05, low + z - 0.01), (x + half, -0.02, low + z + 0.01))
            skin.add(at, 5 + number, 5 + number, 5 + number)
    return skin


@pytest.mark.parametrize(
    ("handles", "pieces"),
    [
        ([(0.2, 0.13)] * 3, {5, 6, 7}),
        ([(0.2, 0.0)] * 3, set()),
        ([(0.2, 0.13), (0.2, 0.0), (0.2, 0.0)], set()),
        ([(0.36, 0.25)] * 3, set()),
    ],
    ids=["each has a handle", "none has", "one alone", "at their corners"],
)
def test_panels_alike_of_one_piece_with_their_handles_are_fronts(
    handles: list[tuple[float, float]], pieces: set[int]
) -> None:
    scene = desk(handles).scene()
    fronts = find_fronts(scene, Contacts(scene), "front", fused=True)
    assert {front.piece for front in gripped(scene, fronts)} == pieces


@pytest.mark.parametrize(("x", "pieces"), [(0.7, [(0, 3)]), (0.41, [])], ids=["at its edge", "in the middle"])
def test_a_whole_side_is_a_door_where_its_handle_is_at_the_edge(
    x: float, pieces: list[tuple[int, ...]]
) -> None:
    skin = Skin()
    skin.add(((0.01, 0, 0.01), (0.79, 0.6, 0.99)), -1, 1, 2)
    skin.add(((0, -0.03, 0), (0.8, 0, 1.0)), 0, -1, 0)
    skin.add(((x - 0.02, -0.08, 0.4), (x + 0.02, -0.03, 0.6)), 3, 3, 3)
    scene = skin.scene()
    assert [mover.pieces for mover in front_movers(scene, Contacts(scene), fused=True)] == pieces


def test_a_lid_that_lies_flush_with_the_floor_of_what_it_closes_hangs_where_its_inner_face_ends() -> None:
    skin = Skin()
    for low, high in (((0, 0, 0), (0.8, 0.4, 0.01)), ((0, 0, 0.49), (0.8, 0.4, 0.5))):
        skin.add((low, high), 0, 0, 0)
    for x in (0, 0.79):
        skin.add(((x, 0, 0.01), (x + 0.01, 0.4, 0.49)), 0, 0, 0)
    skin.add(((0, 0.39, 0.01), (0.8, 0.4, 0.49)), 0, 0, 0)
    skin.add(((0, -0.5, 0), (0.8, 0, 0.02)), 1, -1, 1)
    on_the_ground = [bool((triangle[:, 2] < 1e-9).all()) for triangle in skin.triangles]
    skin.pieces = [1 if below else piece for below, piece in zip(on_the_ground, skin.pieces, strict=True)]
    scene = skin.scene()
    leaf = standing_open(scene, scene.faces_of((1,)), np.array([1]))
    assert leaf is not None
    assert leaf.angle == pytest.approx(np.pi / 2)
    assert leaf.sizes * scene.size == pytest.approx([0.8, 0.5], abs=0.02)
    assert scene.points_to_asset(leaf.hinge[None])[0][1] == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize(("deep", "found"), [(0.6, {1}), (0.2, set())], ids=["a washing machine", "a clock"])
def test_a_round_rim_with_a_round_pane_on_the_front_of_something_deep_is_a_door(
    deep: float, found: set[int]
) -> None:
    skin = Skin()
    skin.add(((0, 0, 0), (0.6, deep, 0.9)), 0, 3, 4)
    for piece, radius, out in ((1, 0.2, 0.04), (2, 0.13, 0.05)):
        disc = trimesh.creation.cylinder(radius, out, sections=48)
        disc.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0)))
        disc.apply_translation((0.3, -out / 2, 0.45))
        skin.triangles += list(disc.triangles)
        skin.pieces += [piece] * len(disc.triangles)
    scene = skin.scene()
    fronts = find_fronts(scene, Contacts(scene), "front", fused=True)
    assert {front.piece for front in portholes(scene, fronts)} == found


@needs_data
def test_handles_of_one_piece_with_their_drawers_make_no_drawer_of_a_plinth() -> None:
    mesh = read_source(DATA / "bigym_base_small_drawers" / "fused.glb", Plugins()).mesh
    found = Geometric().segment(mesh)
    assert [guess.label for guess in found.parts] == ["body", *["drawer"] * 4]
    joints = GeometricJoints().predict(mesh, found)
    assert [joint.kind for joint in joints] == ["prismatic"] * 4
    assert np.abs([joint.axis[1] for joint in joints]) == pytest.approx(1, abs=0.01)
