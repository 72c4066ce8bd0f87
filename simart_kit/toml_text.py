"""A resolved recipe as TOML text, which reads back as the same recipe."""

from __future__ import annotations

import json
from typing import Any

from .recipe import Recipe, Use


def recipe_text(recipe: Recipe) -> str:
    """The recipe as a TOML file: every option spelled out, those that are none left out."""
    table = recipe.table()
    blocks = ["\n".join(f"{key} = {_value(value)}" for key, value in table.items() if _is_plain(value))]
    blocks += [_use_text("[segmenter]", recipe.segmenter), _use_text("[joints]", recipe.joints)]
    for key, uses in (("modify", recipe.modify), ("export", recipe.export)):
        blocks += [_use_text(f"[[{key}]]", use) for use in uses]
        if not uses:
            # An empty list must stand before the first table header.
            blocks[0] += f"\n{key} = []"
    return "\n\n".join(blocks) + "\n"


def _use_text(header: str, use: Use) -> str:
    lines = [header, f"use = {_value(use.use)}"]
    if any(value is not None for value in use.options.values()):
        lines.append(f"options = {_value(use.options)}")
    return "\n".join(lines)


def _value(value: Any) -> str:
    if isinstance(value, dict):
        pairs = [f"{_key(key)} = {_value(item)}" for key, item in value.items() if item is not None]
        return "{ " + ", ".join(pairs) + " }" if pairs else "{}"
    if isinstance(value, list):
        return f"[{', '.join(_value(item) for item in value)}]"
    # JSON's numbers, booleans and strings are TOML's, but for DEL.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(key: str) -> str:
    bare = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if bare else _value(key)


def _is_plain(value: Any) -> bool:
    return not isinstance(value, (dict, list))
