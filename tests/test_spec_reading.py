"""Reading a kinematic spec: formats, and every mistake told at once by the name of its part."""

import json

import pytest

from simart_kit.errors import BadInputError
from simart_kit.spec.reading import read_spec
from simart_kit.spec.values import Motion, position_limits


def refusal(**keys):
    """What is said of a spec with these keys."""
    with pytest.raises(BadInputError) as told:
        read_spec({"schema": 1, **keys})
    return str(told.value)


def test_toml_and_json_say_the_same(write):
    toml = write(
        "a.toml", 'schema = 1\n[kinds.door]\ncount = 2\naxis = "outer edge"\n[kinds.drawer]\ncount = 0\n'
    )
    values = {"schema": 1, "kinds": {"door": {"count": 2, "axis": "outer edge"}, "drawer": {"count": 0}}}

    spec = read_spec(toml)

    assert spec == read_spec(write("a.json", json.dumps(values))) == read_spec(values)
    assert [kind.count for kind in spec.kinds.values()] == [2, 0]
    assert spec.table() == values


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("broken.toml", "schema = ", "cannot read spec"),
        ("broken.json", "{", "cannot read spec"),
        ("list.json", "[]", "must be a table"),
    ],
)
def test_files_that_are_no_spec_are_told_by_their_path(write, name, text, said):
    path = write(name, text)
    with pytest.raises(BadInputError, match=said) as told:
        read_spec(path)
    assert name in str(told.value)


def test_text_that_is_not_utf8_is_told(tmp_path):
    path = tmp_path / "latin.toml"
    path.write_bytes(b"schema = 1 # \xff")
    with pytest.raises(BadInputError, match=r"latin\.toml: it is not UTF-8 text"):
        read_spec(path)


def test_missing_file_is_told_by_its_path(tmp_path):
    with pytest.raises(BadInputError, match=r"absent\.toml: No such file"):
        read_spec(tmp_path / "absent.toml")


def test_wrong_fields_are_told_by_their_place_all_at_once():
    text = refusal(
        colour="red",
        coordinates="inch",
        kinds={"door": {"count": -1}},
        parts=[{"name": "Left Door", "axis": "somewhere"}, {"joint": "hinge", "shape": 3, "name": "lid"}],
    )
    assert text.startswith("spec has 7 mistake(s): ")
    for place in (
        "colour: no such key, known are schema, numbered,",
        "coordinates: Input should be 'm' or 'fraction' (got 'inch')",
        "kinds.door.count:",
        "parts.0.name:",
        "parts.0.axis: Input should be 'vertical',",
        "parts.1.joint:",
        "parts.1.shape: no such key, known are joint, axis, limits, name,",
    ):
        assert place in text


def test_schema_is_needed_and_only_1_is_known():
    with pytest.raises(BadInputError, match="schema: missing"):
        read_spec({})
    with pytest.raises(BadInputError, match="schema: Input should be 1"):
        read_spec({"schema": 2})


def test_contradictions_are_told_by_name_all_at_once():
    text = refusal(
        numbered=9,
        parts=[
            {"name": "frame", "root": True, "joint": "revolute"},
            {"name": "a", "parent": "b"},
            {"name": "b", "parent": "c"},
            {"name": "c", "parent": "a"},
            {"name": "lid", "parent": "a", "pieces": [1]},
            {"name": "lid", "parent": "frame"},
            {"name": "knob", "joint": "ball", "axis": "vertical", "pieces": [1, 9]},
            {"name": "flap", "joint": "revolute", "limits": [10, 90]},
            {"name": "door", "limits": [0, 90]},
            {"name": "tray", "joint": "prismatic", "axis": "left edge", "parent": "tray"},
        ],
        merge=[{"into": "x", "parts": ["x"]}, {"into": "y", "parts": []}],
        split=[{"part": "a", "name": "handle"}],
    )
    for mistake in (
        "'frame': joint on the root: it is the root, and joint given",
        "cycle of parents: a -> b -> c -> a",
        "part 'lid' is listed 2 times, with two parents: a and frame",
        "'knob': joint 'ball' has no axis, but axis is 'vertical'",
        "piece 1 is listed 2 times: of lid, knob",
        "'knob' has piece 9, but pieces were numbered 0..8",
        "'flap': limits 10 .. 90 leave out 0",
        "'door': limits need joint 'revolute' or 'prismatic', joint is not given",
        "'tray': a slide goes along a direction, such as 'front', but axis is 'left edge'",
        "'tray': is its own parent",
        "merge.0: 'x' is merged with itself",
        "merge.1: nothing is merged into 'y'",
        "split.0: a split of nothing: name the pieces or points of 'handle'",
    ):
        assert mistake in text, mistake
    assert text.startswith("spec has 13 mistake(s): ")


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"parts": [{"name": "a", "root": True}, {"name": "b", "root": True}]}, "two roots: a and b"),
        (
            {"parts": [{"name": "a", "pieces": [1], "points": [[0, 0, 0]]}]},
            "'a': pieces and points are given: one of them says",
        ),
        ({"parts": [{"name": "a", "pieces": []}]}, "'a': has no pieces or points"),
        (
            {"parts": [{"name": n, "found_as": "x"} for n in "ab"]},
            "found_as 'x' is given 2 times",
        ),
        (
            {"merge": [{"into": "a", "parts": ["c"]}, {"into": "b", "parts": ["c"]}]},
            "merge.1: 'c' is merged into 'a' and into 'b'",
        ),
        (
            {"merge": [{"into": "a", "parts": ["b"]}, {"into": "c", "parts": ["a"]}]},
            "'a' is merged away into 'c', and takes parts itself",
        ),
        (
            {"merge": [{"into": "a", "parts": ["b"]}], "parts": [{"name": "b"}]},
            "part 'b' is listed, and merged into 'a'",
        ),
        (
            {"kinds": {"door": {"count": 1}}, "parts": [{"name": n, "label": "door"} for n in "ab"]},
            "kinds.door.count is 1, but parts lists 2: a, b",
        ),
        ({"kinds": {"fan": {"joint": "continuous", "limits": [0, 1]}}}, "kinds.fan: limits need joint"),
    ],
)
def test_each_contradiction_has_its_words(keys, said):
    assert said in refusal(**keys)


def test_limits_of_turns_are_degrees_and_of_slides_metres():
    turn = Motion(joint="revolute", limits=(-90.0, 180.0))
    assert position_limits(turn) == pytest.approx((-1.5707963268, 3.1415926536))
    assert position_limits(Motion(joint="prismatic", limits=(0.0, 0.25))) == (0.0, 0.25)
    assert position_limits(Motion()) is None
