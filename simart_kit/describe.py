"""What pydantic models hold, as rows and Markdown: for `plugins show` and the tables of the documentation."""

from __future__ import annotations

import inspect
import json
import re
import types
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import to_jsonable_python

if TYPE_CHECKING:
    from .plugins import Plugins

_WORDS = {float: "number", int: "integer", str: "text", bool: "true or false", type(None): "none"}
_BOUNDS = {"ge": ">=", "gt": ">", "le": "<=", "lt": "<"}
_HUGE = 1e9  # bounds as large only keep computers from overflowing
# A span of code; else what would be emphasis or start an HTML tag.
_MARKUP = re.compile(r"(?P<code>`[^`]*`)|[*]|(?<!\w)_(?=\w)|<(?=[A-Za-z/!?])")


@dataclass(frozen=True)
class FieldRow:
    """One field of a model.

    Attributes:
        name: key in the file; a nested model's keys follow their parent's with a dot.
        type: for people, with bounds.
        default: as JSON, "none" or "required".
        description: with the unit.
    """

    name: str
    type: str
    default: str
    description: str


def field_rows(model: type[BaseModel], prefix: str = "") -> tuple[FieldRow, ...]:
    """The fields of a model in order; nested models are spelled out."""
    rows: list[FieldRow] = []
    for name, info in model.model_fields.items():
        key = prefix + (info.alias or name)
        inner = info.annotation
        if isinstance(inner, type) and issubclass(inner, BaseModel):
            rows += field_rows(inner, f"{key}.")
        else:
            rows.append(FieldRow(key, type_text(inner, info), _default_text(info), info.description or ""))
    return tuple(rows)


def own_rows(model: type[BaseModel]) -> tuple[FieldRow, ...]:
    """The fields of a model in order; nested models are named."""
    return tuple(
        FieldRow(
            info.alias or name, type_text(info.annotation, info), _default_text(info), info.description or ""
        )
        for name, info in model.model_fields.items()
    )


def nested_models(model: type[BaseModel]) -> tuple[type[BaseModel], ...]:
    """The model and all that its fields hold, each once, in order of appearance."""
    found = [model]
    for candidate in found:
        for info in candidate.model_fields.values():
            found += [inner for inner in _models_in(info.annotation) if inner not in found]
    return tuple(found)


def markdown_table(rows: Iterable[FieldRow]) -> str:
    """A Markdown table, one row a field."""
    cells = ((f"`{row.name}`", row.type, row.default, row.description) for row in rows)
    return table(("Key", "Type", "Default", "Meaning"), cells)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table of any texts; what stands in backticks is code."""
    ruler = "|" + "---|" * len(head)
    return "\n".join([_line(head), ruler, *map(_line, rows)]) + "\n"


def cell(text: str) -> str:
    """A text as a cell of a Markdown table shows it: bars, stars and tags are characters like others."""
    escaped = _MARKUP.sub(lambda found: found["code"] or f"\\{found[0]}", " ".join(text.split()))
    return escaped.replace("|", "\\|")  # ends the cell in code, too


def stage_options(plugins: Plugins, kind: str) -> str:
    """Markdown of every stage of a kind: what it does, and a table of its options."""
    blocks = []
    for registration in plugins.registrations(kind):
        summary = (inspect.getdoc(registration.value) or "").split("\n\n")[0]
        rows = field_rows(registration.value.Options)
        table = markdown_table(rows) if rows else "No options.\n"
        blocks.append(f"#### {kind} `{registration.name}`\n\n{summary}\n\n{table}")
    return "\n".join(blocks)


def schema_text(model: type[BaseModel]) -> str:
    """The model's JSON schema, as the text of a file."""
    return json.dumps(model.model_json_schema(by_alias=True), indent=1, ensure_ascii=False) + "\n"


def type_text(annotation: Any, info: FieldInfo | None = None) -> str:
    """A type for people, such as `number >= 0`, `"auto" or "hull"` or `list of Joint`."""
    arguments = get_args(annotation)
    if get_origin(annotation) in (Union, types.UnionType) and type(None) in arguments:
        others = [type_text(argument, info) for argument in arguments if argument is not type(None)]
        return " or ".join([*others, "none"])
    bounds = _bounds(info.metadata if info else ())
    return " ".join(filter(None, (_type_text(annotation), " and ".join(bounds))))


def _type_text(annotation: Any) -> str:
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        bounds = _bounds(annotation.__metadata__)
        return " ".join(filter(None, (_type_text(arguments[0]), " and ".join(bounds))))
    if origin is Literal:
        return " or ".join(json.dumps(value) for value in arguments)
    if origin in (Union, types.UnionType):
        return " or ".join(_type_text(argument) for argument in arguments)
    if origin is tuple and arguments[-1] is Ellipsis:
        return f"list of {_type_text(arguments[0])}"
    if origin is tuple:
        return _tuple_text([_type_text(argument) for argument in arguments])
    if origin is dict:
        return "table"
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation.__name__.removesuffix("Table").removesuffix("Row")
    return _WORDS.get(annotation, getattr(annotation, "__name__", str(annotation)))


def _bounds(metadata: Iterable[Any]) -> list[str]:
    """Such as `>= 0`, without bounds that are there only for the computer's sake."""
    told = []
    for bound in metadata:
        if isinstance(bound, FieldInfo):
            told += _bounds(bound.metadata)
        values = {sign: getattr(bound, key) for key, sign in _BOUNDS.items() if hasattr(bound, key)}
        told += [f"{sign} {value:g}" for sign, value in values.items() if abs(value) < _HUGE]
    return told


def _tuple_text(items: list[str]) -> str:
    """Such as `3 numbers`, `3 numbers > 0`, `4 x 4 numbers` or `[text, number]`."""
    first = items[0]
    if len(set(items)) > 1:
        return f"[{', '.join(items)}]"
    if first[0].isdigit():
        return f"{len(items)} x {first}"
    word, _, bounds = first.partition(" ")
    return f"{len(items)} {word}s {bounds}".rstrip()


def _line(texts: Sequence[str]) -> str:
    return f"| {' | '.join(map(cell, texts))} |"


def _default_text(info: FieldInfo) -> str:
    if info.is_required():
        return "required"
    value = to_jsonable_python(info.get_default(call_default_factory=True))
    return "none" if value is None else json.dumps(value, ensure_ascii=False)


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]
