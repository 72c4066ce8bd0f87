"""Penetration over the sweep, against shares worked out from areas."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.metrics.penetration import penetration
from simart_kit.testing.meshes import box, boxes_mesh, cabinet_asset

SLIDE = LinkJoint("prismatic", (1.0, 0.0, 0.0), lower=0.0, upper=3.0)
CUBE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
WALL = ((2.0, -50.0, -50.0), (2.01, 50.0, 50.0))  # so large that hardly a sampled point of it meets the cube
SAMPLING = 0.02  # of 600 points, evenly spread: well above what shares are off by


def made(bounds: list[tuple[tuple[float, ...], tuple[float, ...]]], *links: Link) -> Articulation:
    """Boxes, one a link."""
    mesh = boxes_mesh(bounds)
    return Articulation("boxes", mesh.vertices, mesh.faces, np.repeat(np.arange(len(bounds)), 12), links)


def pushed(joint: LinkJoint) -> Articulation:
    """A wall, and a unit cube 1 in front of it."""
    return made([WALL, CUBE], Link("wall"), Link("cube", 0, joint))


def cabinet(drawer_axis: float, door_limits: tuple[float, float] = (0.0, 0.0)) -> Articulation:
    """The cabinet whose drawer comes out along -y; its door has no travel unless told."""
    asset = cabinet_asset()
    door, drawer = asset.joints
    links = (
        Link("body"),
        Link("door", 0, LinkJoint("revolute", door.axis, door.origin, *door_limits)),
        Link("drawer", 0, LinkJoint("prismatic", (0.0, drawer_axis, 0.0), drawer.origin, 0.0, 0.3)),
    )
    return Articulation("cabinet", asset.mesh.vertices, asset.mesh.faces, asset.face_part, links)


def test_what_passes_wholly_through_a_wall_gets_one() -> None:
    assert penetration(pushed(SLIDE)) == 1.0


def test_the_share_is_that_of_the_surface_that_passed() -> None:
    # Moved by 1.5, what had x > 0.5 is beyond the wall: the front face and half of four sides, of six faces.
    half = replace(SLIDE, upper=1.5)
    assert penetration(pushed(half)) == pytest.approx(3 / 6, abs=SAMPLING)


def test_what_stops_before_the_wall_gets_nothing() -> None:
    assert penetration(pushed(replace(SLIDE, upper=0.99))) == 0.0


def test_the_worse_of_two_ends_counts() -> None:
    assert penetration(pushed(replace(SLIDE, lower=-0.5, upper=1.5))) == pytest.approx(0.5, abs=SAMPLING)
    away = replace(SLIDE, axis=(-1.0, 0.0, 0.0), lower=-1.5, upper=4.0)
    assert penetration(pushed(away)) == pytest.approx(0.5, abs=SAMPLING)


def test_the_way_from_rest_to_where_travel_begins_counts() -> None:
    assert penetration(pushed(replace(SLIDE, lower=2.8, upper=3.0))) == 1.0


def test_a_drawer_that_opens_outward_is_free() -> None:
    assert penetration(cabinet(-1.0)) == 0.0


def test_a_drawer_pushed_through_the_back_penetrates() -> None:
    # Its box is 0.54 x 0.35 x 0.23 with a handle of 0.0112 area, y from -0.20 to 0.15. Pushed by 0.3, what
    # has y > -0.12 is behind the front of the back board at y = 0.18: the back and 0.27 / 0.35 of four sides.
    sides, end, handle = 2 * 0.35 * (0.54 + 0.23), 0.54 * 0.23, 0.0112
    expected = (end + sides * 0.27 / 0.35) / (2 * end + sides + handle)
    assert penetration(cabinet(1.0)) == pytest.approx(expected, abs=SAMPLING)


def test_the_mean_is_over_links_that_travel() -> None:
    # The door, opened outward by 0.3 rad, stays clear: its corner at the hinge moves by 0.01 sin(0.3) = 3 mm
    # of the 5 mm that it has.
    whole, shared = penetration(cabinet(1.0)), penetration(cabinet(1.0, (-0.3, 0.0)))
    assert whole is not None
    assert shared == pytest.approx(whole / 2, abs=1e-9)


@pytest.mark.parametrize(("upper", "hits"), [(1.2, False), (2.6, True)])
def test_a_door_that_swings_through_a_wall_penetrates(upper: float, hits: bool) -> None:
    # A door of length 1 along x, hinged at the origin about z; a wall stands along y at x = -0.5: the tip,
    # at cos(t), comes to it at t = 2.09, and at 1.2 is still on the other side.
    wall = ((-0.55, 0.0, 0.0), (-0.5, 1.0, 1.0))
    door = ((0.01, -0.01, 0.0), (1.0, 0.01, 1.0))
    hinge = LinkJoint("revolute", (0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 0.0, upper)
    share = penetration(made([wall, door], Link("wall"), Link("door", 0, hinge)))
    assert share is not None
    assert share > 0.2 if hits else share == 0.0


def test_a_continuous_joint_makes_a_full_turn() -> None:
    wall = ((-0.55, 0.0, 0.0), (-0.5, 1.0, 1.0))
    hand = ((0.01, -0.01, 0.0), (1.0, 0.01, 1.0))
    spin = LinkJoint("continuous", (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    assert (penetration(made([wall, hand], Link("wall"), Link("hand", 0, spin))) or 0.0) > 0.2


def test_what_is_carried_moves_along() -> None:
    # The knob inside of the cube's front goes with it; the pole that it carries runs through the wall.
    knob, pole = ((0.9, 0.4, 0.4), (1.1, 0.6, 0.6)), ((1.0, 0.2, 0.2), (1.9, 0.3, 0.3))
    short = replace(SLIDE, upper=0.8)
    links = (Link("wall"), Link("cube", 0, short), Link("knob", 1))
    assert penetration(made([WALL, CUBE, knob], *links)) == 0.0
    assert (penetration(made([WALL, CUBE, pole], *links)) or 0.0) > 0.0


def test_what_carries_stays() -> None:
    # A block slides out of the lid that carries it, into nothing; the lid has no travel of its own.
    links = (Link("wall"), Link("lid", 0, LinkJoint("unknown")), Link("block", 1, replace(SLIDE, upper=0.5)))
    block = ((1.0, 0.0, 0.0), (1.2, 1.0, 1.0))
    assert penetration(made([WALL, CUBE, block], *links)) == 0.0


@pytest.mark.parametrize("joint", [LinkJoint(), LinkJoint("ball"), replace(SLIDE, lower=1.0, upper=0.0)])
def test_without_travel_there_is_no_number(joint: LinkJoint) -> None:
    assert penetration(pushed(joint)) is None


def test_a_link_without_faces_is_left_out() -> None:
    free = replace(SLIDE, upper=0.5)
    vertices, faces = box(*CUBE)
    links = (Link("body"), Link("nothing", 0, free))
    assert penetration(Articulation("one", vertices, faces, np.zeros(12), links)) is None


def test_an_object_that_moves_as_a_whole_has_nothing_to_run_into() -> None:
    vertices, faces = box(*CUBE)
    assert penetration(Articulation("one", vertices, faces, np.zeros(12), (Link("all", -1, SLIDE),))) == 0.0


def test_faces_of_no_link_are_in_the_way() -> None:
    scene = pushed(SLIDE)
    assert penetration(replace(scene, labels=np.where(scene.labels == 0, -1, 1))) == 1.0


def test_a_cloud_has_no_number() -> None:
    points = np.random.default_rng(0).random((20, 3))
    cloud = Articulation("cloud", points, np.zeros((0, 3)), np.arange(20) % 2, pushed(SLIDE).links)
    assert penetration(cloud) is None


def test_frame_and_unit_do_not_matter() -> None:
    matrix = np.eye(4)
    matrix[:3, :3] = 40.0 * np.array([[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])
    matrix[:3, 3] = (5.0, -3.0, 2.0)
    here, there = penetration(cabinet(1.0)), penetration(cabinet(1.0).transformed(matrix))
    assert here == pytest.approx(there, abs=0.005)


def test_the_same_seed_gives_the_same_number() -> None:
    assert penetration(cabinet(1.0), seed=4) == penetration(cabinet(1.0), seed=4)
