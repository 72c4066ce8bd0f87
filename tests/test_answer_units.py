"""Parts and joints become an answer's whole numbers, and come back within what rounding may change."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.answer.units import answer_of, guesses_of, joints_of, material_notes
from simart_kit_plugins.simart.answer.values import Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit import Joint, Limits, PartGuess
from simart_kit.errors import BadInputError
from simart_kit.voxels import GridFrame

TALL = TokenGrid((16, 8, 8), 8192)
# A cube of 2 m from (-1, -1, 0) to (1, 1, 2).
FRAME = GridFrame((-1.0, -1.0, 0.0), 2 / 64, 64)
BODY, DOOR = PartGuess("body"), PartGuess("door")


def cells(*index):
    return VoxelTokens(TALL, np.array(index, dtype=np.int32), np.ones(len(index), dtype=np.int32))


def door(kind="revolute", origin=(0, 0, 1), axis=(0, 0, 1), limits=(0, 1)):
    """The joint of a door, whatever its kind."""
    limited = kind in ("revolute", "prismatic")
    return Joint("j", kind, "body", "door", origin, axis, Limits(*limits) if limited else None)


def answered(joint, frame=FRAME):
    return answer_of("box", 1.0, [BODY, DOOR], [joint], [cells(0, 1), cells(2)], frame)


def motion(**joint):
    return answered(door(**joint)).parts[1].motion


def said(kind, moved=None, **more):
    """An answer of two parts, the second of which moves so."""
    return ObjectAnswer(
        "box", 1.0, (PartAnswer("fixed", cells(0)), PartAnswer(kind, cells(1), "door", 0, moved, **more))
    )


def read(answer):
    joints, notes = joints_of(answer, ["body", "door"], FRAME)
    (joint,) = joints
    return joint, [note.text for note in notes]


# ---- numbers, worked out by hand


def test_centers_are_two_hundredths_of_the_cube():
    assert motion(origin=(-1, -1, 0)).center == (0, 0, 0)
    assert motion(origin=(1, 1, 2)).center == (200, 200, 200)
    # 0.38 m from the corner is 38 steps of 1 cm.
    assert motion(origin=(-0.62, 0, 0.5)).center == (38, 100, 50)


def test_turns_are_counted_in_hundredths_of_half_a_turn():
    assert motion(limits=(-math.pi / 2, math.pi / 4)).limits == (-50, 25)
    assert motion(kind="continuous").limits == (-100, 100)
    assert motion(limits=(-20, 20)).limits == (-200, 200)


def test_slides_are_counted_in_hundredths_of_the_cubes_edge():
    assert motion(kind="prismatic", limits=(-0.1, 0.5)).limits == (-5, 25)
    assert motion(kind="prismatic", limits=(0, 3)).limits == (0, 100)


R = math.sqrt(0.5)


@pytest.mark.parametrize(
    ("axis", "whole", "limits"),
    [
        ((0, 0, 1), (0, 0, 100), (0, 50)),
        ((0, 0, -1), (0, 0, 100), (-50, 0)),
        ((-R, -R, 0), (100, 100, 0), (-50, 0)),
        ((R, -R, 0), (100, -100, 0), (0, 50)),
        ((-R, R, 0), (100, -100, 0), (-50, 0)),
        ((0.6, 0, 0.8), (75, 0, 100), (0, 50)),
        ((1e-9, 0, -1), (0, 0, 100), (-50, 0)),
    ],
)
def test_the_sign_of_an_axis_is_folded_into_the_limits(axis, whole, limits):
    length = math.sqrt(sum(value * value for value in axis))
    unit = tuple(value / length for value in axis)
    found = motion(axis=unit, limits=(0, math.pi / 2))
    assert (found.axis, found.limits) == (whole, limits)


def test_what_moves_little_moves_all_the_same():
    assert motion(kind="prismatic", limits=(0, 0.004)).limits == (0, 1)
    assert motion(kind="prismatic", limits=(-0.004, 0.002)).limits == (-1, 0)
    assert motion(kind="prismatic", axis=(0, 0, -1), limits=(0, 0.004)).limits == (-1, 0)
    assert motion(limits=(0, 0)).limits == (0, 0)


def test_a_center_outside_the_cube_moves_along_its_axis_into_it():
    assert motion(origin=(0.5, 0.5, -7), axis=(0, 0, 1)).center == (150, 150, 0)
    # From (-3, 0, 1) along (1, 1, 0) the line meets x = -1 where y = 2: it passes the cube by. Its point
    # (-1.5, 1.5, 1) is nearest to the cube's middle.
    assert motion(origin=(-3, 0, 1), axis=(R, R, 0)).center == (0, 200, 100)
    # From (-2, -1, 1) it meets the cube at x = -1, y = 0.
    assert motion(origin=(-2, -1, 1), axis=(R, R, 0)).center == (0, 100, 100)
    # A line beside the cube, and a point: what is nearest on the cube.
    assert motion(origin=(1.2, 0, -5), axis=(0, 0, 1)).center == (200, 100, 100)
    assert motion(kind="ball", origin=(5, 0, 1)).center == (200, 100, 100)


def test_scale_is_the_longest_side_in_centimetres_of_three_digits():
    sizes = {0.4: 40.0, 1.8349: 183.0, 0.034567: 3.46}
    for metres, centimetres in sizes.items():
        assert answer_of("x", metres, [BODY], [], [cells(0)], FRAME).scale == centimetres


# ---- parts


def test_kinds_become_types():
    kinds = {"fixed": "fixed", "revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic"}
    for kind, type_ in (kinds | {"ball": "hinge", "free": "free"}).items():
        part = answered(door(kind)).parts[1]
        assert (part.type, part.motion is None) == (type_, kind in ("fixed", "free"))
    assert motion(kind="ball") == Motion((100, 100, 100))


def test_the_root_comes_first_and_parents_before_children():
    parts = [PartGuess(name) for name in ("knob", "door", "shelf", "case", "foot")]
    joints = [
        Joint("a", "continuous", "door", "knob"),
        Joint("b", "revolute", "case", "door", limits=Limits(0, 1)),
        Joint("c", "fixed", "case", "foot"),
    ]
    sizes = [cells(0), cells(1, 2, 3), cells(4), cells(5, 6), cells(7)]
    answer = answer_of("x", 1, parts, joints, sizes, FRAME)
    # No joint moves case and shelf; case has more cells, and shelf is fixed to it.
    assert [p.name for p in answer.parts] == ["case", "door", "shelf", "foot", "knob"]
    assert [p.parent for p in answer.parts] == [None, 0, 0, 0, 1]
    assert [p.type for p in answer.parts] == ["fixed", "revolute", "fixed", "fixed", "revolute"]
    assert answer.parts[1].voxels.index.tolist() == [1, 2, 3]


def test_materials_are_told_by_name_density_and_stiffness():
    part = answer_of("x", 1, [PartGuess("a", material="steel")], [], [cells(0)], FRAME).parts[0]
    # 7850 kg/m^3 and 210 GPa: EN 1991-1-1 and EN 1993-1-1.
    assert (part.material, part.density, part.youngs_modulus) == ("Steel", 7.85, 210.0)
    unknown = answer_of("x", 1, [PartGuess("a", material="unobtainium!")], [], [cells(0)], FRAME).parts[0]
    assert (unknown.material, unknown.density, unknown.youngs_modulus) == ("Unobtainium", None, None)


def test_names_keep_the_letters_that_an_answer_may_have():
    parts = [PartGuess("Tür/links (2)"), PartGuess("扉"), PartGuess("x" * 60)]
    answer = answer_of("  Schöner Schrank! ", 1, parts, [], [cells(0)] * 3, FRAME)
    assert answer.name == "Schoner Schrank"
    assert [p.name for p in answer.parts] == ["Tur links 2", "part", "x" * 48]
    assert answer_of("?", 1, parts, [], [cells(0)] * 3, FRAME).name == "object"


@pytest.mark.parametrize(
    ("parts", "joints", "message"),
    [
        ([], [], "needs parts"),
        ([BODY, BODY], [], "names must differ"),
        ([BODY, DOOR], [replace(door(), parent="wall")], "names part 'wall'"),
        ([BODY, DOOR], [door(), door()], "moved by two joints"),
        ([BODY, DOOR], [door(), Joint("k", "free", "door", "body")], "form a loop"),
        ([BODY, DOOR], [Joint("k", "free", "door", "door")], "loop through part 'door'"),
    ],
)
def test_joints_that_are_no_tree_are_refused(parts, joints, message):
    with pytest.raises(BadInputError, match=message):
        answer_of("x", 1, parts, joints, [cells(0)] * len(parts), FRAME)


def test_wrong_lengths_are_refused():
    with pytest.raises(BadInputError, match="1 token sequences for 2 parts"):
        answer_of("x", 1, [BODY, DOOR], [], [cells(0)], FRAME)
    for side in (0, -1, math.nan, math.inf):
        with pytest.raises(BadInputError, match="is no length"):
            answer_of("x", side, [BODY], [], [cells(0)], FRAME)
    with pytest.raises(BadInputError, match="1 names for 2 parts"):
        joints_of(said("free"), ["body"], FRAME)


# ---- reading


def test_a_turn_is_read_in_metres_and_radians():
    joint, notes = read(said("revolute", Motion((38, 100, 50), (0, 0, -50), (-50, 25))))
    assert (joint.kind, joint.parent, joint.child, joint.name) == ("revolute", "body", "door", "door_hinge")
    np.testing.assert_allclose(joint.origin, (-0.62, 0, 0.5), atol=1e-12)
    assert joint.axis == (0, 0, -1)
    assert joint.limits == Limits(-math.pi / 2, math.pi / 4)
    assert (joint.confidence, notes) == (1.0, [])


def test_a_slide_is_read_in_edges_of_the_cube():
    joint, notes = read(said("prismatic", Motion((0, 0, 0), (0, 100, 0), (-5, 25))))
    assert joint.kind == "prismatic"
    np.testing.assert_allclose((joint.limits.lower, joint.limits.upper), (-0.1, 0.5))
    assert notes == []


@pytest.mark.parametrize("kind", ["revolute", "hinge"])
@pytest.mark.parametrize(
    ("limits", "found"), [((-100, 100), "continuous"), ((0, 200), "continuous"), ((-99, 100), "revolute")]
)
def test_a_turn_of_360_degrees_has_no_ends(kind, limits, found):
    joint, notes = read(said(kind, Motion((0, 0, 0), (100, 0, 0), limits)))
    assert (joint.kind, joint.limits is None, notes) == (found, found == "continuous", [])


def test_limits_are_extended_to_the_pose_of_the_mesh_with_a_note():
    joint, notes = read(said("revolute", Motion((0, 0, 0), (100, 0, 0), (25, 50))))
    assert joint.limits == Limits(0, math.pi / 2)
    assert notes == [
        "joint 'door_hinge': limits [25, 50] do not include 0, the pose of the mesh: they are extended to it"
    ]
    joint, notes = read(said("prismatic", Motion((0, 0, 0), (100, 0, 0), (-50, -25))))
    assert joint.limits == Limits(-1, 0)
    assert len(notes) == 1


def test_a_joint_that_cannot_move_is_kept_with_a_note():
    joint, notes = read(said("prismatic", Motion((0, 0, 0), (100, 0, 0), (0, 0))))
    assert joint.limits == Limits(0, 0)
    assert notes == ["joint 'door_slide': limits [0, 0] leave no way to move"]


def test_a_hinge_without_axis_is_a_ball_joint_with_a_note():
    joint, notes = read(said("hinge", Motion((100, 100, 50))))
    assert (joint.kind, joint.limits) == ("ball", None)
    np.testing.assert_allclose(joint.origin, (0, 0, 0.5), atol=1e-12)
    assert ["ball joint" in note for note in notes] == [True]


def test_a_free_part_is_held_in_its_middle():
    joint, notes = read(said("free"))
    # Cell 1 is x 0, y 0, z 1 of 16 x 8 x 8 cells: 1/8 m wide, 1/4 m deep and high.
    np.testing.assert_allclose(joint.origin, (-1 + 1 / 16, -1 + 1 / 8, 3 / 8), atol=1e-12)
    assert (joint.kind, joint.limits, notes) == ("free", None, [])


def test_confidence_is_that_of_each_part():
    joints, _ = joints_of(said("free"), ["body", "door"], FRAME, confidence=[0.1, 0.7])
    assert [j.confidence for j in joints] == [0.7]


def test_guesses_have_clean_unique_names_labels_and_materials_of_the_table():
    told = (
        PartAnswer("fixed", cells(0)),
        PartAnswer("free", cells(1), "Left Door", 0, material="Oak"),
        PartAnswer("free", cells(2), "left_door", 1, density=7.9),
        PartAnswer("free", cells(3), "drawer 2", 0, material="MDF"),
        PartAnswer("free", cells(4), "", 0),
    )
    answer = ObjectAnswer("x", 1.0, told)
    guesses = guesses_of(answer)
    assert [g.name for g in guesses] == ["base", "left_door", "left_door_2", "drawer_2", "part_4"]
    assert [g.label for g in guesses] == ["", "Left Door", "left_door", "drawer", ""]
    assert [g.material for g in guesses] == ["wood", "wood", "steel", "mdf", "wood"]
    notes = [(note.level, note.text.partition(":")[0]) for note in material_notes(answer)]
    assert notes == [("warning", "part 0"), ("info", "part 2"), ("warning", "part 4")]


# ---- there and back, within what rounding may change

FINITE = {"allow_nan": False, "allow_infinity": False}
directions = (
    st.tuples(*[st.floats(-1, 1, **FINITE)] * 3)
    .filter(lambda v: math.hypot(*v) > 0.1)
    .map(lambda v: tuple(x / math.hypot(*v) for x in v))
)
frames = st.builds(GridFrame, st.tuples(*[st.floats(-5, 5, **FINITE)] * 3), st.floats(1e-3, 0.1), st.just(64))


@st.composite
def joints(draw, frame):
    edge = frame.voxel_size * 64
    shares = draw(st.tuples(*[st.floats(0, 1)] * 3))
    origin = tuple(low + share * edge for low, share in zip(frame.origin, shares, strict=True))
    kind = draw(st.sampled_from(["revolute", "prismatic", "continuous", "ball"]))
    most = edge if kind == "prismatic" else 3.0
    limits = draw(st.floats(-most, 0)), draw(st.floats(0, most))
    return door(kind, origin, draw(directions), limits)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.data())
def test_joints_come_back_within_rounding(data):
    frame = data.draw(frames)
    joint = data.draw(joints(frame))
    edge = frame.voxel_size * 64
    (back,), notes = joints_of(answered(joint, frame), ["body", "door"], frame)
    assert back.kind == joint.kind
    assert np.abs(np.subtract(back.origin, joint.origin)).max() <= 0.0025 * edge * (1 + 1e-6)
    if joint.kind == "ball":
        return
    cosine = float(np.dot(back.axis, joint.axis))
    assert math.degrees(math.acos(min(1.0, abs(cosine)))) <= 0.41
    if joint.limits is None:
        return
    way = math.copysign(1, cosine)
    found = sorted((way * back.limits.lower, way * back.limits.upper))
    unit = 0.01 * (edge if joint.kind == "prismatic" else math.pi)
    errors = np.abs(np.subtract(found, (joint.limits.lower, joint.limits.upper)))
    # Half a unit; the whole one that is kept of a motion too small to be said.
    small = joint.limits.upper - joint.limits.lower < 1.01 * unit
    assert errors.max() <= (1.0 if small else 0.5) * unit * (1 + 1e-6)
    assert not notes or joint.limits.lower == joint.limits.upper


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.data())
def test_what_came_back_is_said_as_before(data):
    joint = data.draw(joints(FRAME))
    first = answered(joint)
    (back,), _ = joints_of(first, ["body", "door"], FRAME)
    assert answered(back).parts[1].motion == first.parts[1].motion
