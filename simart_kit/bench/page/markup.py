"""HTML from values. Foreign text becomes markup in one way only: `text`, which escapes it."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import Any, NewType

from ..numbers import number

Markup = NewType("Markup", str)
"""A piece of HTML that is safe to put in the page."""
Attributes = Mapping[str, str | bool]
"""Values are escaped; True is an attribute without a value, False is left out."""

NOTHING = Markup("")
_VOID = ("img", "input", "meta", "br")
_NONE: Attributes = {}


def text(value: object) -> Markup:
    """Any text, escaped."""
    return Markup(html.escape(str(value)))


def breakable(name: str) -> Markup:
    """A name, escaped; its lines may break after underscores."""
    return Markup(text(name).replace("_", "_<wbr>"))


def prose(words: str) -> Markup:
    """A sentence, escaped; what stands in backticks is code."""
    pieces = words.split("`")
    return joined(tag("code", text(piece)) if i % 2 else text(piece) for i, piece in enumerate(pieces))


def tag(name: str, *content: Markup, attributes: Attributes = _NONE) -> Markup:
    """An element."""
    start = "".join([f"<{name}", *(_attribute(key, value) for key, value in attributes.items()), ">"])
    return Markup(start if name in _VOID else f"{start}{''.join(content)}</{name}>")


def joined(pieces: Iterable[Markup]) -> Markup:
    """Pieces one after the other."""
    return Markup("".join(pieces))


def lines(pieces: Iterable[Markup]) -> Markup:
    """Pieces on a line each, so that the file can be read and compared."""
    return Markup("\n".join(pieces))


def undefined(of: str) -> Markup:
    """What stands for a number that there is not."""
    return tag("span", text("\N{EN DASH}"), attributes={"class": "none", "title": f"not defined for {of}"})


def value_text(value: Any) -> Markup:
    """Anything that a row of a part may hold."""
    if value is None:
        return undefined("this part")
    if isinstance(value, bool):
        return text("yes" if value else "no")
    if isinstance(value, float):
        return text(number(value))
    if isinstance(value, list | tuple):
        return text(", ".join(number(v) if isinstance(v, float) else str(v) for v in value))
    return breakable(str(value))


def _attribute(key: str, value: str | bool) -> str:
    if value is False:
        return ""
    return f" {key}" if value is True else f' {key}="{html.escape(str(value))}"'
