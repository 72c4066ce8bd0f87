"""A spec as the text of a TOML file that a person edits."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from .values import Spec

_HEAD = """\
# What moves in {source}, as recipe {recipe} found it. {picture} shows the numbers.
# Change it and convert: simart-kit convert {source} --recipe {recipe} --spec FILE
# All keys: docs/spec.md. What is left out is for the recipe to say.
"""
# Limits come last: a remark with their unit follows.
_ORDER = ("name", "label", "root", "pieces", "parent", "joint", "axis", "limits")
_TAIL = """\
# What else may be stated:
# kinds.door = { count = 2, joint = "revolute", axis = "outer edge" }
# kinds.drawer = { count = 0 }
"""


def spec_text(
    spec: Spec, shortened: Mapping[str, tuple[float, float]], picture: str, source: str, recipe: str
) -> str:
    """The spec as TOML with remarks; it reads back as the same spec.

    Args:
        spec: with `parts` only.
        shortened: limits by part that other parts shorten, told as remarks [degrees | m].
        picture: name of the file beside it that shows the numbers.
        source: name of the mesh file.
        recipe: that found it.
    """
    table = spec.table()
    plain = {key: value for key, value in table.items() if key != "parts"}
    blocks = [_HEAD.format(source=source, recipe=recipe, picture=picture) + _lines(plain), _TAIL]
    for number, part in enumerate(table.get("parts", ())):
        ordered = {key: part[key] for key in _ORDER if key in part}
        text = f"[[parts]]  # {number}\n{_lines(ordered)}"
        unit = "m" if part.get("joint") == "prismatic" else "degrees"
        if "limits" in part:
            text = text.rstrip("\n") + f"  # {unit}\n"
        if part["name"] in shortened:
            wished = json.dumps(list(shortened[part["name"]]))
            text += f"# limits = {wished}  # {unit}; others are in the way before that\n"
        blocks.append(text)
    return "\n".join(blocks)


def _lines(table: Mapping[str, Any]) -> str:
    # JSON's numbers, lists, booleans and strings are TOML's, but for DEL.
    texts = {key: json.dumps(value, ensure_ascii=False) for key, value in table.items()}
    return "".join(f"{key} = {text}\n" for key, text in texts.items()).replace("\x7f", "\\u007f")
