"""Tables of what a model holds, as `plugins show` and the documentation print them."""

from typing import Annotated, Literal

import pytest
from pydantic import BaseModel, Field

from simart_kit.describe import (
    cell,
    field_rows,
    markdown_table,
    nested_models,
    own_rows,
    schema_text,
    type_text,
)


class Leaf(BaseModel):
    size: float = Field(gt=0, le=2, description="Size [m].")


class BranchRow(BaseModel):
    tip: Annotated[int, Field(ge=0, lt=2**31)] = Field(description="Number.")


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
        (BranchRow, "Branch"),
        (Annotated[float, Field(gt=0, lt=1e30)], "number > 0"),
        (Annotated[float, Field(gt=-1e30, lt=1e30)] | None, "number or none"),
        (tuple[Annotated[int, Field(le=5)], Annotated[int, Field(le=5)]], "2 integers <= 5"),
        (tuple[Annotated[float, Field(gt=-1e30)], ...], "list of number"),
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


def test_bounds_that_only_guard_a_computer_are_not_told():
    assert [row.type for row in own_rows(BranchRow)] == ["integer >= 0"]


@pytest.mark.parametrize(
    ("text", "escaped"),
    [
        ("arccos|dot| of found joints", r"arccos\|dot\| of found joints"),
        ("the root is <mujoco> or </a>", r"the root is \<mujoco> or \</a>"),
        ("NAME/*.urdf, objs/*.obj", r"NAME/\*.urdf, objs/\*.obj"),
        ("_slanted_ and snake_case", r"\_slanted_ and snake_case"),
        ("code as `a*b <c>` but `a|b`", r"code as `a*b <c>` but `a\|b`"),
        ("number >= 0 and < 2", "number >= 0 and < 2"),
        ("two\n  lines", "two lines"),
    ],
)
def test_a_cell_shows_its_text_as_it_is(text, escaped):
    assert cell(text) == escaped


def test_the_schema_uses_the_keys_of_the_file():
    assert '"schema"' in schema_text(TreeTable)
    assert '"version"' not in schema_text(TreeTable)
