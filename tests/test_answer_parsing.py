"""Answers in the paper's JSON are read strictly: every mistake is told in one line, where it is."""

import json

import numpy as np
import pytest
from simart_kit_plugins.simart.answer.json_text import MOST_CHARACTERS
from simart_kit_plugins.simart.answer.parsing import parse_answer, parse_grounding
from simart_kit_plugins.simart.answer.values import Motion
from simart_kit_plugins.simart.tokens import TokenGrid

from simart_kit.errors import BadInputError

from .answer_cases import PAPER

TALL = TokenGrid((16, 8, 8), 8192)
MODULUS = "Young's Modulus (GPa)"


def changed(*path_and_value):
    """The paper's example with one value replaced, or taken out by `...`."""
    *path, last, value = path_and_value
    table = json.loads(PAPER)
    place = table
    for key in path:
        place = place[key]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return json.dumps(table)


def part(**changes):
    """The example with the second part's caption changed; `modulus` stands for its long key."""
    table = json.loads(PAPER)
    caption = table["parts_captions"]["1"]
    for key, value in changes.items():
        if value is ...:
            del caption[key]
        else:
            caption[MODULUS if key == "modulus" else key] = value
    return json.dumps(table)


def failure(text, **options):
    with pytest.raises(BadInputError) as caught:
        parse_answer(text, TALL, **options)
    message = str(caught.value)
    assert len(message.splitlines()) == 1
    assert len(message) < 500
    return message


def test_the_papers_example_is_read():
    answer = parse_answer(PAPER, TALL)
    body, lid = answer.parts
    assert (answer.name, answer.scale) == ("Storage Box with Frame", 40.0)
    assert (body.type, body.parent, body.motion) == ("fixed", None, None)
    assert (body.material, body.density, body.youngs_modulus) == ("Plastic", 1.2, 2.5)
    assert (lid.type, lid.parent) == ("revolute", 0)
    assert lid.motion == Motion((100, 138, 101), (100, 0, 0), (-54, 45))
    assert lid.voxels.index.tolist() == [43, 44]
    assert lid.voxels.code.tolist() == [1930, 13]
    assert (lid.name, lid.material, lid.density, lid.youngs_modulus) == ("", "", None, None)


def test_voxels_may_be_named_by_atomic_tokens():
    text = changed("parts_voxels", "1", "<voxel><xyz_43><mesh_1930><voxel><xyz_44><mesh_13>")
    assert parse_answer(text, TALL).parts[1].voxels.text() == "<voxel> 43 1930 <voxel> 44 13"


def test_keys_may_come_in_any_order_and_blanks_may_surround_the_json():
    table = json.loads(PAPER)
    table["parts_captions"] = dict(reversed(table["parts_captions"].items()))
    text = "\n\t " + json.dumps(dict(reversed(table.items()))) + " \r\n"
    assert [p.type for p in parse_answer(text, TALL).parts] == ["fixed", "revolute"]


def test_rigid_is_fixed():
    text = part(type="rigid", center=..., axis=..., limits=...)
    assert parse_answer(text, TALL).parts[1].type == "fixed"


def test_a_parent_may_be_a_number_or_a_text():
    assert parse_answer(part(parent=0), TALL).parts[1].parent == 0


def test_a_hinge_is_a_turn_or_with_neither_axis_nor_limits_a_ball_joint():
    assert parse_answer(part(type="hinge"), TALL).parts[1].motion.axis == (100, 0, 0)
    ball = parse_answer(part(type="hinge", axis=..., limits=...), TALL).parts[1]
    assert ball.motion == Motion((100, 138, 101), None, None)
    message = failure(part(type="hinge", axis=...))
    assert message.startswith("the answer: parts_captions 1: a hinge has both axis and limits")


@pytest.mark.parametrize("written", ["1.2 g/cm^3", "1.2 g/cm³", "1.2g/cm3", "1.2", 1.2, "12e-1 g/cm^3"])
def test_forms_of_density(written):
    assert parse_answer(part(density=written), TALL).parts[1].density == 1.2


@pytest.mark.parametrize("written", [210, 210.0, "210", "210 GPa"])
def test_forms_of_youngs_modulus(written):
    assert parse_answer(part(modulus=written), TALL).parts[1].youngs_modulus == 210.0


WRONG = {
    # What stands around or instead of the JSON.
    "the answer: expected a JSON object and no text before it, found nothing": "",
    "the answer: expected a JSON object and no text before it, found 'Sure: {": "Sure: " + PAPER,
    "the answer: expected a JSON object and no text before it, found '```json": f"```json\n{PAPER}\n```",
    "the answer: expected a JSON object and no text before it, found '[]'": "[]",
    "the answer: text after the JSON, at character": PAPER + " Enjoy!",
    "the answer: no JSON: Expecting ':' delimiter at character 35": PAPER[:35],
    "the answer: no JSON: Unterminated string starting at character 29": PAPER[:33],
    "the answer: no JSON: Invalid control character at character 49": PAPER.replace("Box with", "Box\nwith"),
    # Keys.
    "the answer: key 'parts_voxels' is missing": changed("parts_voxels", ...),
    "the answer: unknown key 'notes': keys here are 'object_captions', 'parts_captions'": changed("notes", 1),
    "the answer: object_captions: key 'scale' is missing": changed("object_captions", "scale", ...),
    "the answer: object_captions: key 'scale' comes twice": PAPER.replace("40.0", '40.0, "scale": 41.0'),
    "the answer: parts_captions 0: key 'type' comes twice": PAPER.replace(
        '"fixed"', '"fixed", "type": "free"'
    ),
    "the answer: parts_captions: key '1' comes twice": PAPER.replace('"0": {', '"1": {'),
    "the answer: parts_voxels: key '0' comes twice": PAPER.replace('"1": "<', '"0": "<'),
    "the answer: parts_captions 0: key 'type' is missing": changed("parts_captions", "0", "type", ...),
    "the answer: parts_captions 1: key 'parent' is missing": part(parent=...),
    "the answer: parts_captions 1: key 'center' is missing": part(center=...),
    "the answer: parts_captions 1: key 'limits' is missing": part(limits=...),
    "the answer: parts_captions 1: unknown key 'axes'": part(axes=[1, 0, 0]),
    "the answer: parts_captions 1: unknown key 'center'": part(type="free"),
    "the answer: parts_captions 0: unknown key 'parent'": changed("parts_captions", "0", "parent", "0"),
    # Numbers of parts.
    "the answer: parts_captions: there is no part": changed("parts_captions", {}),
    "the answer: parts_captions: key '1' is missing, and there is a key '2'": PAPER.replace(
        '"1": {', '"2": {'
    ),
    "the answer: parts_voxels: key '1' is missing, and there is a key '01'": PAPER.replace(
        '"1": "<', '"01": "<'
    ),
    "the answer: 2 parts in parts_captions, 1 in parts_voxels": changed("parts_voxels", "1", ...),
    # Values.
    "the answer: object_captions: 7 is no object with keys": changed("object_captions", 7),
    "the answer: object_captions: name: null is no text": changed("object_captions", "name", None),
    "the answer: object_captions: name 'a,b' must be": changed("object_captions", "name", "a,b"),
    "the answer: object_captions: name: 49 characters": changed("object_captions", "name", "a" * 49),
    "the answer: object_captions: scale: '40' is no number": changed("object_captions", "scale", "40"),
    "the answer: object_captions: scale: true is no number": changed("object_captions", "scale", True),
    "the answer: object_captions: scale: 0 must be": changed("object_captions", "scale", 0),
    "the answer: object_captions: scale: nan must be": PAPER.replace("40.0", "NaN"),
    "the answer: object_captions: scale: inf must be": PAPER.replace("40.0", "4e999"),
    "the answer: parts_captions 0: a list is no object with keys": changed("parts_captions", "0", []),
    "the answer: parts_captions 1: type 'Revolute' is not one of fixed, revolute": part(type="Revolute"),
    "the answer: parts_captions 1: type a list is not one of": part(type=["fixed"]),
    "the answer: parts_captions 0: the first part is the root": changed(
        "parts_captions", "0", "type", "free"
    ),
    "the answer: parts_captions 1: parent: '00' is no number of a part": part(parent="00"),
    "the answer: parts_captions 1: parent: true is no number of a part": part(parent=True),
    "the answer: parts_captions 1: parent 1 is not an earlier part": part(parent="1"),
    "the answer: parts_captions 1: parent -1 is not an earlier part": part(parent=-1),
    "the answer: parts_captions 1: center: 1.0 is no whole number": part(center=[100, 1.0, 0]),
    "the answer: parts_captions 1: center: false is no whole number": part(center=[100, False, 0]),
    "the answer: parts_captions 1: center: expected a list of 3 whole numbers, found a list of 2": part(
        center=[1, 2]
    ),
    "the answer: parts_captions 1: center: expected a list of 3 whole numbers, found '1, 2, 3'": part(
        center="1, 2, 3"
    ),
    "the answer: parts_captions 1: center (100, 201, 0) must be three of 0..200": part(center=[100, 201, 0]),
    "the answer: parts_captions 1: center: 1e+20 is no whole number": part(center=[100, 10**20, 0]),
    "the answer: parts_captions 1: axis (0, 0, 0) must be": part(axis=[0, 0, 0]),
    "the answer: parts_captions 1: axis (0, 0, -101) must be": part(axis=[0, 0, -101]),
    "the answer: parts_captions 1: axis: expected a list of 3": part(axis=None),
    "the answer: parts_captions 1: limits (45, -54) must rise": part(limits=[45, -54]),
    "the answer: parts_captions 1: limits (-201, 0) must rise": part(limits=[-201, 0]),
    "the answer: parts_captions 1: limits (0, 101) must rise": part(type="prismatic", limits=[0, 101]),
    "the answer: parts_captions 1: material: null is no text": part(material=None),
    "the answer: parts_captions 1: material 'wood & glass' must be": part(material="wood & glass"),
    "the answer: parts_captions 1: density: '1.2 kg/m^3' is not such as '1.2 g/cm^3'": part(
        density="1.2 kg/m^3"
    ),
    "the answer: parts_captions 1: density: '-1 g/cm^3' is not such as": part(density="-1 g/cm^3"),
    "the answer: parts_captions 1: density: 0.0 must be": part(density="0 g/cm^3"),
    "the answer: parts_captions 1: density: '٣' is not such as": part(density="٣"),
    "the answer: parts_captions 1: Young's Modulus (GPa): a list is no number": part(modulus=[2.5]),
    # Voxels.
    "the answer: parts_voxels 1: a list is no text in quotes": changed("parts_voxels", "1", [43, 1930]),
    "the answer: parts_voxels 1: cells out of order at token 4": changed(
        "parts_voxels", "1", "<voxel> 43 1 <voxel> 42 1"
    ),
    "the answer: parts_voxels 0: cell index out of range at token 1": changed(
        "parts_voxels", "0", "<voxel> 1024 1"
    ),
    "the answer: parts_voxels 0: 65537 characters are too many": changed("parts_voxels", "0", " " * 65537),
}


@pytest.mark.parametrize(("message", "text"), WRONG.items(), ids=list(WRONG))
def test_a_mistake_is_told_in_one_line_where_it_is(message, text):
    assert failure(text).startswith(message)


def test_messages_name_what_was_read():
    assert failure("", source="part.json").startswith("part.json: expected a JSON object")


def test_only_cells_of_the_input_may_be_named():
    parse_answer(PAPER, TALL, allowed=np.array([0, 1, 43, 44]))
    message = failure(PAPER, allowed=np.array([0, 1, 43]))
    assert message.startswith("the answer: parts_voxels 1: cell that the input does not occupy at token 4")


@pytest.mark.parametrize(
    "text",
    [
        '{"a":' * 200_000,
        "{" * 100_000,
        '{"object_captions": ' + "[" * 300_000,
        changed("object_captions", "name", [[]]).replace("[[]]", "[" * 400 + "]" * 400),
        PAPER.replace("40.0", "9" * 50_000),
        PAPER.replace("[100, 138, 101]", "[" + "7" * 9000 + ", 0, 0]"),
        PAPER.replace("Storage", "S" * 100_000),
        PAPER.replace('"scale"', '"' + "s" * 100_000 + '"'),
        PAPER.replace("Storage", "\\ud800"),
        "\ufeff" + PAPER,
        '{"' + '\\"' * 100_000,
        "{" + " " * MOST_CHARACTERS,
        '{"parts_captions": {' + ", ".join(f'"{n}": 1' for n in range(50_000)) + "}}",
    ],
    ids=lambda text: text[:24],
)
def test_hostile_texts_are_refused_in_one_short_line(text):
    assert failure(text).startswith("the answer: ")


def test_grounding_is_voxels_and_nothing_else():
    tokens = parse_grounding("<voxel><xyz_43><mesh_1930>", TALL, np.array([43]))
    assert tokens.text() == "<voxel> 43 1930"
    assert parse_grounding("<voxel> 43 1930", TALL).text() == tokens.text()
    assert not len(parse_grounding("", TALL).index)
    with pytest.raises(BadInputError, match="the answer: cell that the input does not occupy"):
        parse_grounding("<voxel> 43 1930", TALL, np.array([44]))
    with pytest.raises(BadInputError, match="the lid: missing <voxel> at token 0"):
        parse_grounding("The lid is at <voxel> 43 1930", TALL, source="the lid")
    with pytest.raises(BadInputError, match="70000 characters are too many"):
        parse_grounding("x" * 70_000, TALL)
