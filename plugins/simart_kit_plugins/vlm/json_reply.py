"""The one JSON object in what a model said, and whether it is the answer that was asked for."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from pydantic import BaseModel, ValidationError

from simart_kit.errors import BadInputError

# Far more than any answer needs, and little enough to be read in a moment.
_MOST_CHARACTERS = 1 << 20
_MOST_MISTAKES = 4
_SHOWN = 60
# Braces that prose has are not followed by a key.
_START = re.compile(r'\{\s*["}]')
_THOUGHTS = re.compile(r"\A.*</think>", re.DOTALL)


def read_answer(text: str, answer: type[BaseModel]) -> BaseModel:
    """The answer in a text; prose and code fences around it are left out.

    Args:
        text: what the model said.
        answer: what its one JSON object must be.

    Raises:
        BadInputError: there is none, there are several, it is damaged or does not fit; one line.
    """
    found = json_object(text)
    try:
        # As JSON, so that strict models take lists for tuples.
        return answer.model_validate_json(json.dumps(found))
    except ValidationError as error:
        raise BadInputError(_mistakes(error)) from None


def json_object(text: str) -> dict[str, Any]:
    """The one JSON object in a text; raises BadInputError as `read_answer` does."""
    if len(text) > _MOST_CHARACTERS:
        raise BadInputError(f"the answer has {len(text)} characters, and {_MOST_CHARACTERS} are the most")
    spoken = _THOUGHTS.sub("", text, count=1)
    found: list[dict[str, Any]] = []
    end = 0
    while start := _START.search(spoken, end):
        value, end = _decoded(spoken, start.start())
        found.append(value)
    if not found:
        raise BadInputError("there is no JSON object in the answer")
    if any(other != found[0] for other in found):
        raise BadInputError(f"there are {len(found)} JSON objects in the answer, and one is asked for")
    return found[0]


def _decoded(text: str, start: int) -> tuple[dict[str, Any], int]:
    """The object that begins at a place, and where it ends."""
    decoder = json.JSONDecoder(object_pairs_hook=_members, parse_constant=_no_constant)
    try:
        value, end = decoder.raw_decode(text, start)
        json.dumps(
            value, ensure_ascii=False, allow_nan=False
        ).encode()  # halves of surrogate pairs cannot be written
    except json.JSONDecodeError as error:
        near = repr(text[max(start, error.pos - _SHOWN // 2) : error.pos + _SHOWN // 2])
        raise BadInputError(
            f"the JSON is broken at character {error.pos - start}: {error.msg}, near {near}"
        ) from None
    except UnicodeEncodeError:
        raise BadInputError("the JSON holds half of a surrogate pair") from None
    except RecursionError:
        raise BadInputError("the JSON is nested beyond any depth that an answer has") from None
    except ValueError as error:
        raise BadInputError(f"the JSON cannot be used: {str(error).split(':')[0]}") from None
    return value, end


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members: dict[str, Any] = {}
    for key, value in pairs:
        if key in members:
            raise ValueError(f"key {key[:_SHOWN]!r} comes twice")
        members[key] = value
    return members


def _no_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number of JSON")


def _mistakes(error: ValidationError) -> str:
    """The first mistakes that pydantic found, each with its place, in one line."""
    found = error.errors(include_url=False, include_context=False)
    lines = [f"{'.'.join(map(str, one['loc'])) or 'the answer'}: {one['msg']}" for one in found]
    told = "; ".join(line.replace("\n", " ")[: 4 * _SHOWN] for line in lines[:_MOST_MISTAKES])
    more = len(lines) - _MOST_MISTAKES
    return told + (f"; and {more} more" if more > 0 else "")
