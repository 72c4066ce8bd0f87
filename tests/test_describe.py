"""Tables of what a model holds, as `plugins show` and the documentation print them."""

from typing import Literal

import pytest
from pydantic import BaseModel, Field

from simart_kit.describe import field_rows, markdown_table, nested_models, own_rows, schema_text, type_text


class Leaf(BaseModel):
    size: float = Field(gt=0, le=2, description="Size [m].")


class TreeTable(BaseModel):
    version: Literal[1] = Field(default=1, alias="schema", description="Version.")
    leaf: Leaf = Field(description="One.")
    leaves: tuple[Leaf, ...] = Field(default=(), description="a*b | c")


@pytest.mark.parametrize(
    ("annotation", "text"),
    [
        (float, "number"),
        (bool, "true or false"),
        (str | None, "text or none"),
        (Literal["a", 2], '"a" or 2'),
        (tuple[float, float, float], "3 numbers"),
        (tuple[tuple[int, int], tuple[int, int], tuple[int, int]], "3 x 2 integers"),
        (tuple[str, float], "[text, number]"),
        (tuple[Leaf, ...], "list of Leaf"),
        (dict[str, int], "table"),
        (TreeTable, "Tree"),
    ],
)
def test_types_are_words_for_people(annotation, text):
    assert type_text(annotation) == text


def test_options_are_spelled_out_and_fields_of_a_file_name_their_tables():
    assert [(r.name, r.type, r.default) for r in field_rows(TreeTable)] == [
        ("schema", "1", "1"),
        ("leaf.size", "number > 0 and <= 2", "required"),
        ("leaves", "list of Leaf", "[]"),
    ]
    assert [r.type for r in own_rows(TreeTable)] == ["1", "Leaf", "list of Leaf"]
    assert nested_models(TreeTable) == (TreeTable, Leaf)


def test_markdown_survives_bars_and_stars():
    last = markdown_table(own_rows(TreeTable)).splitlines()[-1]

    assert last == r"| `leaves` | list of Leaf | [] | a\*b \| c |"


def test_the_schema_uses_the_keys_of_the_file():
    assert '"schema"' in schema_text(TreeTable)
    assert '"version"' not in schema_text(TreeTable)
