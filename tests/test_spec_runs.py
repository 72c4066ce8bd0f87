"""Conversions with a spec: what it states is obeyed by `geometric` and `nano`, and what is not is told."""

import json
import re

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.errors import BadInputError
from simart_kit.segments import find_segments
from simart_kit.testing import fakes
from simart_kit.testing.meshes import boxes_mesh

from .furniture import box, cabinet_with_two_doors, legs
from .real_objects import needs_data, source
from .spec_cases import TWO_DOORS_SPEC, converted, cupboard, told

PIECES = find_segments(boxes_mesh(cupboard())).count
HONOURED = {
    "kinds.door.count = 2": "honoured",
    "kinds.door.joint = revolute": "honoured",
    "kinds.door.axis = outer edge": "honoured",
    "kinds.drawer.count = 0": "honoured",
}


@pytest.fixture(autouse=True)
def without_picture(monkeypatch):
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)


def hinges(asset):
    """Of each joint the kind, and where its axis stands in x."""
    return sorted((joint.kind, round(joint.origin[0], 2)) for joint in asset.joints if joint.moves)


@pytest.mark.parametrize("recipe", ["geometric", "nano"])
def test_two_doors_on_the_outer_edges_and_no_drawers(tmp_path, recipe):
    result = converted(tmp_path, TWO_DOORS_SPEC, cupboard(), recipe)

    assert [kind for kind, _ in hinges(result.asset)] == ["revolute", "revolute"]
    assert [x for _, x in hinges(result.asset)] == pytest.approx([-0.45, 0.45], abs=0.03)
    assert all(abs(joint.axis[2]) == pytest.approx(1.0) for joint in result.asset.joints)
    assert told(result) == HONOURED


@pytest.mark.parametrize("recipe", ["geometric", "nano"])
def test_hinges_go_to_the_inner_edges_where_that_is_stated(tmp_path, recipe):
    spec = {"schema": 1, "kinds": {"door": {"axis": "inner edge"}}}

    result = converted(tmp_path, spec, cabinet_with_two_doors(handles=True), recipe)

    assert [x for _, x in hinges(result.asset)] == pytest.approx([0.0, 0.0], abs=0.03)
    assert told(result) == {"kinds.door.axis = inner edge": "honoured"}


@needs_data
@pytest.mark.parametrize("recipe", ["geometric", "nano"])
def test_a_real_cabinet_loses_its_drawers(tmp_path, recipe):
    sets = ("export=[]", "modify=[]")
    options = {"out": tmp_path, "sets": sets, "record": False}

    result = sk.convert(source("painted_wooden_cabinet"), recipe, spec=TWO_DOORS_SPEC, **options)

    asset = result.asset
    assert sorted(part.name for part in asset.parts) == ["body", "left_door", "right_door"]
    x, half = np.array([joint.origin[0] for joint in asset.joints]), np.ptp(asset.mesh.bounds[:, 0]) / 2
    assert sorted(np.sign(x)) == [-1, 1]
    assert (np.abs(x) > 0.8 * half).all()
    assert told(result) == HONOURED


@pytest.mark.parametrize("recipe", ["geometric", "nano"])
def test_plain_fronts_are_found_where_the_spec_says_that_they_open(tmp_path, recipe):
    # A table with two plates before its legs: they close nothing and have no handles.
    table = [box((-0.45, 0.45), (-0.2, 0.2), (0.7, 0.73)), *legs(0.9, 0.4, 0.7)]
    plates = [box(x, (-0.22, -0.202), (0.01, 0.69)) for x in ((-0.44, -0.002), (0.002, 0.44))]
    assert not hinges(converted(tmp_path, None, table + plates, "geometric").asset)

    result = converted(tmp_path, TWO_DOORS_SPEC, table + plates, recipe)

    assert hinges(result.asset) == [("revolute", -0.44), ("revolute", 0.44)]
    assert told(result) == HONOURED


def test_what_cannot_be_is_told_with_the_reason(tmp_path):
    spec = {
        "schema": 1,
        "kinds": {"door": {"count": 5}, "lid": {"joint": "revolute"}, "drawer": {"axis": "front"}},
        "parts": [
            {"name": "left_door", "joint": "revolute", "axis": "back edge"},
            {"name": "right_door", "joint": "revolute", "limits": [-170, 90]},
        ],
    }

    said = told(converted(tmp_path, spec, cupboard()))

    assert said["kinds.door.count = 5"].startswith("not honoured: 2 found (")
    assert said["kinds.lid"] == "not honoured: there is none"
    assert said["kinds.drawer.axis = front"] == "honoured"
    assert (
        said["parts.left_door.axis = back edge"] == "not honoured: what opens to the front has no back edge"
    )
    blocked = said["parts.right_door.limits = -170 .. 90"]
    assert re.fullmatch(r"not honoured: only -[\d.]+ \.\. 90 degrees are free of other parts", blocked)


def test_statements_that_are_not_honoured_are_warnings_of_the_report(tmp_path):
    spec = {"schema": 1, "kinds": {"door": {"count": 3}, "drawer": {"count": 2}}}

    report = converted(tmp_path, spec, cupboard()).report

    (warning,) = [text for text in report.warnings if text.startswith("spec: ")]
    assert warning.startswith("spec: kinds.door.count = 3: not honoured")
    assert "spec: kinds.drawer.count = 2: honoured" in report.table()["notes"]


def test_a_spec_that_says_nothing_changes_nothing(tmp_path):
    plain = converted(tmp_path, None, cupboard()).asset
    assert sorted(joint.kind for joint in plain.joints) == ["prismatic"] * 2 + ["revolute"] * 2
    same = converted(tmp_path, {"schema": 1}, cupboard()).asset
    assert plain.joints == same.joints
    assert [part.name for part in plain.parts] == [part.name for part in same.parts]
    assert np.array_equal(plain.face_part, same.face_part)


def test_what_the_run_has_not_is_told_by_name_at_once_and_nothing_is_written(tmp_path):
    spec = {
        "schema": 1,
        "parts": [
            {"name": "hatch", "joint": "revolute"},
            {"name": "left_door", "parent": "gone"},
            {"name": "body", "joint": "revolute"},
            {"name": "knob", "pieces": [99]},
        ],
        "merge": [{"into": "left_door", "parts": ["nowhere"]}],
        "split": [{"part": "wall", "name": "shelf", "pieces": [1]}],
    }
    with pytest.raises(BadInputError) as refused:
        converted(tmp_path, spec, cupboard())

    text = str(refused.value)
    assert text.startswith("spec has 6 mistake(s): ")
    for mistake in (
        "unknown part 'hatch': the run found body, ",
        "part 'left_door': unknown parent 'gone', parts are hatch, left_door, ",
        "joint on the root: 'body' is the body",
        f"'knob' has piece 99, the object has pieces 0..{PIECES - 1}",
        "merge.0: unknown part 'nowhere'",
        "split.0: unknown part 'wall'",
    ):
        assert mistake in text, mistake
    assert not (tmp_path / "out").exists()


def test_numbers_of_another_mesh_are_refused(tmp_path):
    spec = {"schema": 1, "numbered": PIECES - 1, "parts": [{"name": "left_door", "pieces": [3]}]}
    with pytest.raises(BadInputError, match=f"numbered among {PIECES - 1}, this run has {PIECES}"):
        converted(tmp_path, spec, cupboard())


def test_any_segmenter_and_predictor_is_made_to_keep_to_it(tmp_path):
    """The stages know nothing of specs: the core does what it can by the boxes of the parts."""
    # Twelve faces a box: the left door and its handle, and the right one and its handle.
    labels = np.zeros(12 * 9, np.int32)
    labels[12 * 5 : 12 * 6] = labels[12 * 7 : 12 * 8] = 1
    labels[12 * 6 : 12 * 7] = labels[12 * 8 :] = 2
    guesses = (sk.PartGuess("body"), sk.PartGuess("one", label="door"), sk.PartGuess("two", label="door"))
    wrong = [
        sk.Joint("a", "prismatic", "body", "one", limits=sk.Limits(0, 1)),
        sk.Joint("b", "revolute", "one", "two", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), sk.Limits(0, 1)),
    ]
    plugin = fakes.plugin(
        segmenter=fakes.segmenter(labels, guesses), joint_predictor=fakes.joint_predictor(wrong)
    )
    spec = {
        **TWO_DOORS_SPEC,
        "parts": [{"name": "two", "parent": "body", "joint": "revolute", "limits": [0, 45]}],
    }
    recipe = tmp_path / "fake.toml"
    recipe.write_text('schema = 1\n[segmenter]\nuse = "fake"\n[joints]\nuse = "fake"\n')

    result = converted(tmp_path, spec, cabinet_with_two_doors(handles=True), recipe, [plugin])

    assert hinges(result.asset) == [("revolute", -0.45), ("revolute", 0.45)]
    two = result.asset.joint_to("two")
    assert (two.parent, two.limits.upper) == ("body", pytest.approx(np.pi / 4))
    assert set(told(result).values()) == {"honoured"}


def test_provenance_holds_the_spec(tmp_path):
    result = converted(tmp_path, TWO_DOORS_SPEC, cupboard())
    assert json.loads(result.paths["provenance"].read_text())["arguments"]["spec"] == TWO_DOORS_SPEC
