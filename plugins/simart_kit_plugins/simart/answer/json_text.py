"""Strict reading of JSON that a model wrote: one value, no chatter, and a place in every message."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from simart_kit.errors import BadInputError

# Far more than any object needs, and little enough to be read in a moment.
MOST_CHARACTERS = 1 << 22
# Whole numbers of an answer have three digits; longer ones are not worth converting.
_MOST_DIGITS = 12
_SHOWN = 40
_BLANK = " \t\r\n"


@dataclass(frozen=True, slots=True)
class JsonObject:
    """A JSON object as it was met, keys that come twice included."""

    pairs: tuple[tuple[str, object], ...]


def load(text: str, source: str) -> object:
    """The value of a JSON text; objects become `JsonObject`s.

    Args:
        text: one JSON object, with nothing but blanks around it.
        source: what the text is, for messages.

    Raises:
        BadInputError: no JSON object, text around it, or more of it than an answer can need.
    """
    if len(text) > MOST_CHARACTERS:
        raise BadInputError(
            f"{source}: {len(text)} characters are too many: an answer has {MOST_CHARACTERS} at most"
        )
    start = len(text) - len(text.lstrip(_BLANK))
    if text[start : start + 1] != "{":
        found = shown(text[start:]) if start < len(text) else "nothing"
        raise BadInputError(f"{source}: expected a JSON object and no text before it, found {found}")
    decoder = json.JSONDecoder(object_pairs_hook=_object, parse_int=_whole)
    try:
        value, end = decoder.raw_decode(text, start)
    except json.JSONDecodeError as error:
        near = shown(text[max(0, error.pos - _SHOWN // 2) : error.pos + _SHOWN // 2])
        mistake = f"{error.msg.removesuffix(' at')} at character {error.pos}"
        raise BadInputError(f"{source}: no JSON: {mistake}, near {near}") from error
    except RecursionError as error:
        raise BadInputError(f"{source}: lists within lists beyond any depth that an answer has") from error
    rest = text[end:].strip(_BLANK)
    if rest:
        raise BadInputError(f"{source}: text after the JSON, at character {end}: {shown(rest)}")
    return value


def fields(
    where: str, value: object, required: Sequence[str], optional: Collection[str] = ()
) -> dict[str, object]:
    """The members of an object that may have these keys only; raises BadInputError naming the wrong key."""
    members = members_of(where, value)
    for key in members:
        if key not in required and key not in optional:
            known = ", ".join(repr(name) for name in (*required, *optional))
            raise BadInputError(f"{where}: unknown key {shown(key)}: keys here are {known}")
    for key in required:
        if key not in members:
            raise BadInputError(f"{where}: key '{key}' is missing")
    return members


def members_of(where: str, value: object) -> dict[str, object]:
    """The members of an object; raises BadInputError for another value, or for a key that comes twice."""
    if not isinstance(value, JsonObject):
        raise BadInputError(f"{where}: {shown(value)} is no object with keys")
    members: dict[str, object] = {}
    for key, member in value.pairs:
        if key in members:
            raise BadInputError(f"{where}: key {shown(key)} comes twice")
        members[key] = member
    return members


def string(where: str, value: object, longest: int) -> str:
    """A text of at most `longest` characters."""
    if not isinstance(value, str):
        raise BadInputError(f"{where}: {shown(value)} is no text in quotes")
    if len(value) > longest:
        raise BadInputError(f"{where}: {len(value)} characters are too many: {longest} at most")
    return value


def positive(where: str, value: object) -> float:
    """A finite number above 0."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise BadInputError(f"{where}: {shown(value)} is no number")
    if not (math.isfinite(value) and value > 0):
        raise BadInputError(f"{where}: {value} must be a finite number above 0")
    return float(value)


def whole_numbers(where: str, value: object, count: int) -> tuple[int, ...]:
    """A list of so many whole numbers."""
    if not isinstance(value, list) or len(value) != count:
        found = f"a list of {len(value)}" if isinstance(value, list) else shown(value)
        raise BadInputError(f"{where}: expected a list of {count} whole numbers, found {found}")
    for item in value:
        if isinstance(item, bool) or not isinstance(item, int):
            raise BadInputError(f"{where}: {shown(item)} is no whole number of up to {_MOST_DIGITS} digits")
    return tuple(value)


def number_text(where: str, value: object, units: Sequence[str]) -> float:
    """A number above 0, or a text of one with a unit or without, such as "1.2 g/cm^3"."""
    if not isinstance(value, str):
        return positive(where, value)
    unit = "|".join(map(re.escape, units))
    match = re.fullmatch(rf"([0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)(?: ?(?:{unit}))?", value)
    if not match:
        raise BadInputError(f"{where}: {shown(value)} is not such as '1.2 {units[0]}'")
    return positive(where, float(match[1]))


def shown(value: object) -> str:
    """A value for a message: on one line, clipped, and without looking into lists."""
    if isinstance(value, str):
        return repr(value if len(value) <= _SHOWN else value[: _SHOWN - 3] + "...")
    if isinstance(value, list):
        return "a list"
    if isinstance(value, JsonObject):
        return "an object"
    return json.dumps(value)


def _object(pairs: list[tuple[str, object]]) -> JsonObject:
    return JsonObject(tuple(pairs))


def _whole(digits: str) -> int | float:
    """A whole number; a float, which no list of whole numbers takes, where it has too many digits."""
    return int(digits) if len(digits) <= _MOST_DIGITS else float(digits)
