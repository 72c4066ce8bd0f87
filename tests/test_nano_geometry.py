"""What the small model is given: points of pieces, what is seen, patches, joint candidates and evidence."""

import numpy as np
import pytest
from simart_kit_plugins.nano.candidates import CIRCLE, CONTACT, EDGE, MIDDLE, SLIDE, candidates, fitted_circle
from simart_kit_plugins.nano.cloud import Cloud, sample_evenly, sample_pieces
from simart_kit_plugins.nano.evidence import COUNT, evidence, sweep
from simart_kit_plugins.nano.generate.objects import hinge, slide, spin
from simart_kit_plugins.nano.line_places import Details, line_places
from simart_kit_plugins.nano.part_lines import part_lines
from simart_kit_plugins.nano.scene import pieces_of
from simart_kit_plugins.nano.superfaces import nearest_superface, superfaces
from simart_kit_plugins.nano.truth import majority, right_candidates
from simart_kit_plugins.nano.visibility import visible
from simart_kit_plugins.shapes.placing import X, pointed, rotation, turned
from simart_kit_plugins.shapes.primitives import between, cylinder

from simart_kit.triangles import areas, unit_normals


def sampled(triangles, count=600, seed=0):
    """Points and normals, evenly over triangles."""
    found = sample_evenly(areas(triangles), count, np.random.default_rng(seed))
    points = np.einsum("nk,nkx->nx", found.weights, triangles[found.face])
    return points, unit_normals(triangles[found.face])


DOOR = between((0.0, -0.02, -0.4), (0.4, 0.0, 0.4))
BODY = between((-0.4, 0.0, -0.5), (0.4, 0.3, 0.5))


def test_a_small_piece_gets_more_points_than_its_share_and_each_point_knows_its_area():
    sizes = np.array([1.0, 1.0, 0.02])
    found = sample_pieces(sizes, np.array([0, 0, 1]), 200, np.random.default_rng(0))
    small = found.face == 2
    # Square roots of 2 and 0.02 are as 10 to 1.
    assert small.sum() == pytest.approx(200 / 11, abs=1)
    assert found.area[small].sum() == pytest.approx(0.02)
    assert found.area[~small].sum() == pytest.approx(2.0)
    assert np.allclose(found.weights.sum(axis=1), 1)
    assert (found.weights >= 0).all()


def test_points_inside_a_closed_box_are_not_visible():
    inner = between((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1))
    triangles = np.concatenate([between((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), inner])
    outside, inside = sampled(triangles[:12])[0], sampled(inner)[0]
    assert visible(outside, triangles).all()
    assert not visible(inside, triangles).any()


def test_patches_of_a_box_keep_to_one_side_and_further_points_find_theirs():
    points, normals = sampled(BODY, 2000)
    gray = np.full_like(points, 0.5)
    patch, middles = superfaces(points, normals, gray, 250, np.random.default_rng(1))
    facing = np.abs(normals).argmax(axis=1) * 2 + (normals.sum(axis=1) > 0)
    mixed = sum(len(np.unique(facing[patch == k])) > 1 for k in range(patch.max() + 1))
    assert patch.max() + 1 > 200
    assert mixed < 0.1 * patch.max()
    assert np.array_equal(nearest_superface(middles, points, normals, gray), patch)


def test_numbers_of_pieces_and_their_gaps():
    points = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.13, 0, 0], [0.5, 0, 0]])
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    cloud = Cloud(points, normals, np.full((4, 3), 0.5), np.array([0, 0, 1, 2]), np.full(4, 0.25), 3)
    pieces = pieces_of(cloud)
    assert np.allclose(pieces.own[:, :3], [[0.05, 0, 0], [0.13, 0, 0], [0.5, 0, 0]])
    assert np.allclose(pieces.own[:, 3:6], [[0.05, 0, 0], [0, 0, 0], [0, 0, 0]])
    assert pieces.gap[0, 1] == pytest.approx(0.03)
    assert pieces.gap[0, 2] == pytest.approx(0.06)  # farther than it is measured
    assert np.array_equal(pieces.gap, pieces.gap.T)


def test_a_doors_hinge_line_is_among_its_candidates():
    points, normals = sampled(DOOR)
    found = candidates(points, normals, points[points[:, 1] > -0.001])
    motion = hinge((0.4, -0.01, 0.0), (0, 0, 1), 1.5)
    right = right_candidates(found, motion)
    assert right.any()
    assert (found.source[right != 0] != SLIDE).all()
    assert (np.abs(found.axis[right != 0] @ motion.axis) > np.cos(np.deg2rad(8))).all()
    assert (right[right != 0] == np.sign(found.axis[right != 0] @ motion.axis)).all()
    off = np.abs(found.origin[right != 0, 0] - 0.4)
    assert off.max() < 0.03
    # The hinge lies in the middle of the door's thickness.
    assert set(found.source[right != 0].tolist()) <= {EDGE, MIDDLE, CONTACT}


def test_a_slide_is_right_by_its_direction_alone():
    points, normals = sampled(DOOR)
    found = candidates(points, normals, points[:5])
    right = right_candidates(found, slide((0, -1, 0), 0.3))
    assert {int(source) for source in found.source[right != 0]} == {SLIDE}
    assert np.allclose(np.abs(found.axis[right != 0][:, 1]), 1, atol=0.02)


def test_a_wheels_axle_is_the_axis_of_its_circle():
    points, normals = sampled(cylinder(0.3, 0.05, 32) + [0.1, 0.2, 0.0])
    found = candidates(points, normals, points[:0])
    right = right_candidates(found, spin((0.1, 0.2, 0.0), (0, 0, 1)))
    circles = np.flatnonzero((right != 0) & (found.source == CIRCLE))
    assert len(circles)
    assert np.allclose(found.origin[circles[0], :2], [0.1, 0.2], atol=0.01)


def of_solids(solids):
    """A cloud of solids, each a piece."""
    parts = [sampled(solid, 400) for solid in solids]
    points, normals = (np.concatenate(rows) for rows in zip(*parts, strict=True))
    piece = np.repeat(np.arange(len(solids)), 400)
    area = np.repeat([areas(solid).sum() / 400 for solid in solids], 400)
    return Cloud(points, normals, np.full_like(points, 0.5), piece, area, len(solids))


# A lever across the object's axes, and a pin through it that is neither at its edge nor in its middle.
LEVER = turned([between((-0.3, -0.1, -0.02), (0.3, 0.1, 0.02))], rotation((0, 0, 1), 0.5))[0]
PIN = pointed(cylinder(0.02, 0.4, 16), X)
ASKEW = rotation((0, 1, 0), 0.35) @ rotation((0, 0, 1), 0.8)


def exactly(found, motion):
    """Which candidates are this motion but for what points sampled at random leave open."""
    same = np.abs(found.axis @ motion.axis) > np.cos(np.deg2rad(2))
    off = np.linalg.norm(np.cross(motion.origin - found.origin, motion.axis), axis=1)
    slides = motion.kind == "prismatic"
    return same & ((found.source == SLIDE) == slides) & (slides | (off < 0.01))


def test_a_pin_beside_a_part_is_a_line_and_a_way_whatever_its_direction():
    pin = turned([PIN], ASKEW)[0] + [0.17, 0.05, 0.0]
    cloud = of_solids([LEVER, pin, BODY + [0, 0.3, 0]])
    found = part_lines(cloud, cloud.piece == 0).found
    alone = part_lines(of_solids([LEVER, BODY + [0, 0.3, 0]]), np.repeat([True, False], 400)).found
    along = ASKEW @ [1, 0, 0]
    for motion, source in ((hinge((0.17, 0.05, 0.0), along, 1.0), CONTACT), (slide(along, 0.2), SLIDE)):
        assert found.source[exactly(found, motion)].tolist() == [source]
        assert not exactly(alone, motion).any()


def test_a_round_plate_is_a_line_across_it_and_a_block_is_none():
    points, normals = sampled(LEVER)
    plate = turned([cylinder(0.08, 0.01, 24)], ASKEW)[0] + [0.17, 0.05, 0.0]
    motion = hinge((0.17, 0.05, 0.0), ASKEW @ [0, 0, 1], 1.0)
    plain = candidates(points, normals, points[:0])
    with_plate = candidates(points, normals, points[:0], [sampled(plate)[0]])
    assert not exactly(plain, motion).any()
    assert exactly(with_plate, motion)[len(plain) :].tolist() == [True]
    block = turned([between((-0.03,) * 3, (0.03,) * 3)], ASKEW)[0]
    assert len(candidates(points, normals, points[:0], [sampled(block)[0]])) == len(plain)


def test_a_splayed_round_leg_folds_about_the_level_line_across_it():
    yaw = rotation((0, 0, 1), 2 * np.pi / 3)
    leg = turned([cylinder(0.02, 0.8, 16) - [0, 0, 0.4]], yaw @ rotation((0, 1, 0), 0.4))[0]
    points, normals = sampled(leg)
    motion = hinge((0, 0, 0), yaw @ [0, 1, 0], 0.8)
    found = candidates(points, normals, points[:0])
    level = np.abs(found.axis @ motion.axis) > np.cos(np.deg2rad(2))
    off = np.linalg.norm(np.cross(found.origin, motion.axis), axis=1)
    assert off[level & (found.source != SLIDE)].min() < 0.03


def test_a_circle_is_found_from_its_rim_and_a_line_is_none():
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    rim = 2 * np.column_stack([np.cos(angle), np.sin(angle)]) + [5, 7]
    center, misfit = fitted_circle(rim)
    assert np.allclose(center, [5, 7])
    assert misfit < 1e-9
    assert fitted_circle(np.column_stack([np.linspace(0, 1, 50), np.zeros(50)]))[1] > 0.15


def test_a_sweep_says_which_way_a_door_is_free():
    door, normals = sampled(DOOR)
    body = sampled(BODY, 4000)[0]
    found = candidates(door, normals, door[door[:, 1] > -0.001])
    shares = sweep(found, door, body)
    into = np.flatnonzero((found.source == SLIDE) & (np.abs(found.axis[:, 1]) > 0.99))[0]
    sense = np.sign(found.axis[into, 1])
    out, inward = (shares[into, :2], shares[into, 2:]) if sense > 0 else (shares[into, 2:], shares[into, :2])
    assert out.max() == 0
    # The door is 0.02 thick: 0.8 of that leaves it in the cells beside where it was.
    assert inward.max() < 0.2
    up = np.flatnonzero((found.source == SLIDE) & (np.abs(found.axis[:, 2]) > 0.99))[0]
    assert shares[up].max() < 0.2
    hinges = np.flatnonzero((found.source == EDGE) & (np.abs(found.axis[:, 2]) > 0.99))
    turned = shares[hinges]
    # About an upright edge one sense turns it through the body's back, and the other away from it.
    assert (turned.max(axis=1) > 0.03).all()
    assert (turned.min(axis=1) == 0).all()


def upright_edges(found):
    """Of a door in the plane of x and z: its candidates at the left and at the right edge."""
    upright = (found.source == EDGE) & (found.frame == 0) & (np.abs(found.axis[:, 2]) > 0.99)
    return [
        np.flatnonzero(upright & (found.origin[:, 0] < 0.1)),
        np.flatnonzero(upright & (found.origin[:, 0] > 0.3)),
    ]


def test_the_edge_with_hinges_and_that_across_from_the_handle_tell_themselves_apart():
    hinges = np.concatenate([between((0.38, -0.03, z), (0.42, 0.01, z + 0.05)) for z in (-0.35, 0.3)])
    handle = between((0.03, -0.06, -0.05), (0.05, -0.02, 0.05))
    solids = [DOOR, handle, BODY, hinges[:12], hinges[12:]]
    cloud = of_solids(solids)
    lines = part_lines(cloud, cloud.piece < 2)
    left, right = upright_edges(lines.found)
    assert len(left)
    assert len(right)
    told = line_places(lines.found, lines.own, lines.rest, lines.details)
    # Lengths are shares of 0.8, the door's height, and boxes leave out 2 % at either end.
    # The middle is 0.2 to the right of the left edge.
    assert np.allclose(told[left, 0], 0.2 / 0.8, atol=0.04)
    assert np.allclose(told[right, 0], -0.2 / 0.8, atol=0.04)
    # The handle is 0.16 beyond the middle, seen from the right edge.
    assert np.allclose(told[right, 3], 0.16 / 0.8, atol=0.04)
    assert np.allclose(told[left, 3], -0.16 / 0.8, atol=0.04)
    # The body ends 0.4 to the left of the left edge, and with the door on its right.
    assert np.allclose(told[left, 6], 0.4 / 0.8, atol=0.1)
    assert told[right, 6].max() < 0.1
    assert told[right, 8].min() > 0.5
    assert told[left, 8].max() < 0.1
    assert told[right, 9].min() > 0.7
    assert told[left, 9].max() == 0


def test_a_slide_runs_nowhere_in_particular_and_tells_how_far_off_its_grip_is():
    door, normals = sampled(DOOR)
    found = candidates(door, normals, door[:0])
    grip = np.array([0.36, -0.04, 0.0])
    told = line_places(found, door, np.zeros((0, 3)), Details(grip, np.zeros((0, 3))))
    slides = np.flatnonzero(found.source == SLIDE)
    assert (told[slides][:, [0, 1, 2, 5, 6, 7, 8, 9]] == 0).all()
    outward = slides[np.abs(found.axis[slides, 1]) > 0.99]
    assert np.allclose(told[outward, 3], 0.16 / 0.8, atol=0.02)


def test_evidence_is_finite_and_moderate_for_any_part():
    generator = np.random.default_rng(0)
    for count in (4, 40):
        part = generator.normal(0, 0.1, (count, 3))
        normals = generator.normal(size=(count, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        found = candidates(part, normals, part[:3])
        rest = generator.normal(0, 0.3, (50, 3))
        details = Details(part.mean(axis=0), rest[:9])
        numbers = evidence(found, part, rest, np.full(count, 0.01), details)
        assert numbers.shape == (len(found), COUNT)
        assert np.isfinite(numbers).all()
        assert np.abs(numbers).max() < 10


def test_a_piece_has_the_label_of_most_of_its_area():
    label, piece = np.array([0, 1, 1, 2]), np.array([0, 0, 0, 1])
    area = np.array([5.0, 1.0, 1.0, 1.0])
    assert majority(label, piece, area, 3, 2).tolist() == [0, 2]
