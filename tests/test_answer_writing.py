"""Answers are written as the paper's JSON, and come back the same."""

import json
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.answer.parsing import parse_answer, parse_grounding
from simart_kit_plugins.simart.answer.values import Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.answer.writing import answer_text, grounding_text
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.errors import BadInputError

from .answer_cases import PAPER

TALL = TokenGrid((16, 8, 8), 8192)
# Few examples: the suite's time is short, and one answer has up to five parts.
FEW = settings(max_examples=60, deadline=None, derandomize=True)


def tokens(*pairs):
    index, code = np.array(pairs, dtype=np.int32).reshape(-1, 2).T
    return VoxelTokens(TALL, index, code)


STORAGE_BOX = ObjectAnswer(
    "Storage Box with Frame",
    40.0,
    (
        PartAnswer("fixed", tokens((0, 1785), (1, 649)), "", None, None, "Plastic", 1.2, 2.5),
        PartAnswer(
            "revolute", tokens((43, 1930), (44, 13)), "", 0, Motion((100, 138, 101), (100, 0, 0), (-54, 45))
        ),
    ),
)

names = st.from_regex(r"[A-Za-z0-9]([A-Za-z0-9 _\-]{0,46}[A-Za-z0-9])?", fullmatch=True)
measures = st.floats(min_value=1e-9, max_value=1e12)


@st.composite
def voxels(draw):
    cells = draw(st.sets(st.integers(0, TALL.cells - 1), max_size=6))
    return tokens(*((cell, draw(st.integers(1, TALL.codebook - 1))) for cell in sorted(cells)))


@st.composite
def motions(draw, kind):
    center = draw(st.tuples(*[st.integers(0, 200)] * 3))
    if kind == "hinge" and draw(st.booleans()):
        return Motion(center)
    axis = draw(st.tuples(*[st.integers(-100, 100)] * 3).filter(any))
    most = 100 if kind == "prismatic" else 200
    limits = sorted(draw(st.tuples(*[st.integers(-most, most)] * 2)))
    return Motion(center, axis, tuple(limits))


@st.composite
def parts(draw, number):
    kind = draw(st.sampled_from(["fixed", "revolute", "prismatic", "free", "hinge"])) if number else "fixed"
    moves = kind in ("revolute", "prismatic", "hinge")
    return PartAnswer(
        kind,
        draw(voxels()),
        draw(st.just("") | names),
        draw(st.integers(0, number - 1)) if number else None,
        draw(motions(kind)) if moves else None,
        draw(st.just("") | names),
        draw(st.none() | measures),
        draw(st.none() | measures),
    )


@st.composite
def answers(draw):
    count = draw(st.integers(1, 5))
    told = tuple(draw(parts(number)) for number in range(count))
    return ObjectAnswer(draw(st.just("") | names), draw(measures), told)


def without_voxels(answer):
    """Everything that compares by value."""
    rows = [
        (p.type, p.name, p.parent, p.motion, p.material, p.density, p.youngs_modulus) for p in answer.parts
    ]
    return answer.name, answer.scale, rows


def test_the_papers_example_is_written_as_it_prints_it():
    assert answer_text(STORAGE_BOX, indent=2) == PAPER


def test_without_indent_there_are_no_blanks_but_in_texts():
    text = answer_text(STORAGE_BOX, atoms=True)
    assert json.loads(text)["parts_voxels"]["1"] == ("<voxel><xyz_43><mesh_1930><voxel><xyz_44><mesh_13>")
    outside = re.sub(r'"[^"]*"', "", text)
    assert not re.search(r"\s", outside)
    assert text.startswith(
        '{"object_captions":{"name":"Storage Box with Frame","scale":40.0},"parts_captions"'
    )


def test_keys_of_a_part_stand_in_a_fixed_order():
    motion = Motion((1, 2, 3), (0, -100, 7), (0, 9))
    full = PartAnswer("prismatic", tokens((1, 1)), "drawer", 0, motion, "Wood", 0.6, 11)
    answer = ObjectAnswer("x", 1, (PartAnswer("fixed", tokens((1, 1))), full))
    table = json.loads(answer_text(answer))["parts_captions"]
    assert list(table["0"]) == ["type"]
    assert list(table["1"]) == [
        "name", "type", "parent", "center", "axis", "limits", "material", "density", "Young's Modulus (GPa)",
    ]  # fmt: skip
    assert table["1"]["density"] == "0.6 g/cm^3"
    assert table["1"]["Young's Modulus (GPa)"] == 11.0


@FEW
@given(answers(), st.booleans(), st.sampled_from([None, 0, 1, 4]))
def test_what_is_written_is_read_as_it_was(answer, atoms, indent):
    text = answer_text(answer, atoms=atoms, indent=indent)
    read = parse_answer(text, TALL)
    assert without_voxels(read) == without_voxels(answer)
    for was, now in zip(answer.parts, read.parts, strict=True):
        np.testing.assert_array_equal(now.voxels.index, was.voxels.index)
        np.testing.assert_array_equal(now.voxels.code, was.voxels.code)
    assert answer_text(read, atoms=atoms, indent=indent) == text


@FEW
@given(voxels(), st.booleans())
def test_grounding_is_read_as_it_was_written(sequence, atoms):
    read = parse_grounding(grounding_text(sequence, atoms), TALL)
    assert read.text() == sequence.text()


JUNK = [*'"{}[],:\\-0\n', "\u00e9", ".5", "e9", "NaN", "null", "true", "<voxel>"]


def outcome(text):
    """What is read of a text, or None and the one short line that says why not."""
    try:
        return parse_answer(text, TALL), ""
    except BadInputError as error:
        message = str(error)
    assert len(message.splitlines()) == 1
    assert len(message) < 500
    return None, message


def damaged(text, cut, put, junk, length):
    """The text with `length` characters at one share of it replaced, or moved to another."""
    start = int(cut * len(text))
    piece, rest = text[start : start + length], text[:start] + text[start + length :]
    place = int(put * len(rest))
    return rest[:place] + (junk or piece) + rest[place:]


@settings(max_examples=300, deadline=None, derandomize=True)
@given(
    st.booleans(),
    st.floats(0, 1),
    st.floats(0, 1),
    st.sampled_from(["", *JUNK]),
    st.integers(0, 40),
)
def test_damaged_answers_are_read_or_refused_in_one_line(atoms, cut, put, junk, length):
    text = damaged(answer_text(STORAGE_BOX, atoms=atoms), cut, put, junk, length)
    answer, message = outcome(text)
    if answer is None:
        assert message.startswith("the answer: ")
    else:
        assert answer_text(parse_answer(answer_text(answer), TALL)) == answer_text(answer)


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.just("0"),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(["0", "1", "type", "x"]), inner)
    ),
    max_leaves=8,
)
PLACES = [
    ("object_captions",), ("parts_captions",), ("parts_voxels",), ("object_captions", "name"),
    ("object_captions", "scale"), ("parts_captions", "0"), ("parts_captions", "1"), ("parts_voxels", "1"),
    *(("parts_captions", "1", key) for key in
      ("name", "type", "parent", "center", "axis", "limits", "material", "density", "Young's Modulus (GPa)")),
]  # fmt: skip


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.sampled_from(PLACES), json_values)
def test_any_json_value_anywhere_is_read_or_refused_with_its_place(path, value):
    table = json.loads(PAPER)
    place = table
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    answer, message = outcome(json.dumps(table))
    where = "parts_captions 1" if len(path) == 3 else path[0]
    assert answer is not None or where in message


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.text(max_size=40) | st.lists(st.sampled_from([*JUNK, '"parts_captions"'])).map("".join))
def test_random_texts_are_refused(text):
    with pytest.raises(BadInputError, match="the answer: "):
        parse_answer(text, TALL)
