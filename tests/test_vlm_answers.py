"""The one JSON object in what a model says, and what is told of answers that have none that fits."""

import json
import time
from typing import Literal

import pytest
from pydantic import BaseModel, ConfigDict
from simart_kit_plugins.vlm.json_reply import json_object, read_answer

from simart_kit.errors import BadInputError

DOOR = '{"name": "left door", "kind": "revolute", "marks": [3, 5]}'


class Link(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)

    name: str
    kind: Literal["revolute", "prismatic"]
    marks: tuple[int, ...]


def mistake(text):
    """Why a text is no answer."""
    with pytest.raises(BadInputError) as caught:
        read_answer(text, Link)
    told = str(caught.value)
    assert "\n" not in told
    assert len(told) < 1200
    return told


@pytest.mark.parametrize(
    "text",
    [
        DOOR,
        f"\n  {DOOR}\n",
        f"```json\n{DOOR}\n```",
        f"Sure! The two marks {{3, 5}} move together.\n{DOOR}\nLet me know if {{more}} is needed.",
        f'<think>Perhaps {{"name": "drawer"}}? No.</think>\n{DOOR}',
        f"{DOOR}\n{DOOR}",
        json.dumps(json.loads(DOOR), indent=4),
    ],
)
def test_the_object_is_found_whatever_is_around_it(text):
    assert read_answer(text, Link) == Link(name="left door", kind="revolute", marks=(3, 5))


def test_lists_are_taken_for_tuples_but_texts_not_for_numbers():
    assert read_answer(DOOR, Link).marks == (3, 5)
    assert mistake(DOOR.replace("3", '"3"')) == "marks.0: Input should be a valid integer"


def test_an_object_within_another_is_not_taken_for_the_answer():
    # The inner object alone would fit.
    cut = '{"links": [' + DOOR + ", "
    assert mistake(cut).startswith("the JSON is broken at character")
    assert mistake('{"links": [' + DOOR + "]}").startswith(
        "name: Field required; kind: Field required; marks"
    )


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "there is no JSON object in the answer"),
        ("I see no door.", "there is no JSON object in the answer"),
        ("[1, 2]", "there is no JSON object in the answer"),
        ("{'name': 'door'}", "there is no JSON object in the answer"),
        (DOOR[:-5], "the JSON is broken at character 53"),
        (DOOR.replace(",", ";"), "the JSON is broken at character 20: Expecting ',' delimiter, near "),
        (f"{DOOR} or {DOOR.replace('left', 'right')}", "there are 2 JSON objects in the answer, and one is"),
        (DOOR.replace("name", "kind"), "the JSON cannot be used: key 'kind' comes twice"),
        (DOOR.replace("3", "NaN"), "the JSON cannot be used: NaN is no number of JSON"),
        (DOOR.replace("3", "1e999"), "the JSON cannot be used: Out of range float"),
        (DOOR.replace("3", "9" * 5000), "the JSON cannot be used: Exceeds the limit"),
        (DOOR.replace("left", "\\ud800"), "the JSON holds half of a surrogate pair"),
        ('{"a":' * 100_000, "the JSON is nested beyond any depth that an answer has"),
        (DOOR.ljust(1048577), "the answer has 1048577 characters, and 1048576 are the most"),
        (DOOR.replace("revolute", "hinge"), "kind: Input should be 'revolute' or 'prismatic'"),
        (DOOR.replace("}", ', "axis": [0, 0, 1]}'), "axis: Extra inputs are not permitted"),
        (
            '{"a": 1, "b": 1, "c": 1, "d": 1}',
            "name: Field required; kind: Field required; marks: Field required; "
            "a: Extra inputs are not permitted; and 3 more",
        ),
    ],
)
def test_what_is_no_answer_is_told_in_one_line(text, told):
    assert mistake(text).startswith(told), mistake(text)


def test_hostile_answers_are_read_in_no_time():
    start = time.monotonic()
    for text in ("{" * 1_000_000, '{"' * 500_000, '{"a":[' * 160_000, "</think>" * 120_000 + "{}"):
        try:
            json_object(text)
        except BadInputError:
            continue
        assert text.endswith("{}")
    assert time.monotonic() - start < 2
