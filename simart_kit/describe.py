"""What pydantic models hold, as rows and Markdown: for `plugins show` and the tables of the documentation."""

from __future__ import annotations

import inspect
import json
import types
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import to_jsonable_python

if TYPE_CHECKING:
    from .plugins import Plugins

_WORDS = {float: "number", int: "integer", str: "text", bool: "true or false", type(None): "none"}
_BOUNDS = {"ge": ">=", "gt": ">", "le": "<=", "lt": "<"}


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
    lines = ["| Key | Type | Default | Meaning |", "|---|---|---|---|"]
    for row in rows:
        cells = (f"`{row.name}`", row.type, row.default, row.description)
        lines.append("| " + " | ".join(cell.replace("|", "\\|").replace("*", "\\*") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


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
    bounds = [
        f"{sign} {getattr(bound, key):g}"
        for bound in (info.metadata if info else ())
        for key, sign in _BOUNDS.items()
        if hasattr(bound, key)
    ]
    return " ".join(filter(None, (_type_text(annotation), " and ".join(bounds))))


def _type_text(annotation: Any) -> str:
    origin, arguments = get_origin(annotation), get_args(annotation)
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
        return annotation.__name__.removesuffix("Table")
    return _WORDS.get(annotation, getattr(annotation, "__name__", str(annotation)))


def _tuple_text(items: list[str]) -> str:
    """Such as `3 numbers`, `4 x 4 numbers` or `[text, number]`."""
    if len(set(items)) > 1:
        return f"[{', '.join(items)}]"
    return f"{len(items)} x {items[0]}" if items[0][0].isdigit() else f"{len(items)} {items[0]}s"


def _default_text(info: FieldInfo) -> str:
    if info.is_required():
        return "required"
    value = to_jsonable_python(info.get_default(call_default_factory=True))
    return "none" if value is None else json.dumps(value, ensure_ascii=False)


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]
