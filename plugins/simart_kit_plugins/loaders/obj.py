"""OBJ text as trimesh reads it rightly."""

from __future__ import annotations

import re

from simart_kit import BadInputError

COMMENT = re.compile(rb"(?m)^([ \t]*(?:v|vt|vn|f)[ \t][^#\n]*)#[^\n]*")
SHORT = re.compile(rb"(?m)^[ \t]*f(?:[ \t]+[^\s#]+){0,2}[ \t\r]*$")
ZERO = re.compile(rb"(?m)^[ \t]*f[ \t](?:[^\n]*[ \t/])?0(?:[ \t\r/]|$)")
RELATIVE = re.compile(rb"(?m)^[ \t]*f[ \t][^\n]*[ \t/]-\d")


def obj_warnings(text: bytes) -> list[str]:
    """What trimesh leaves out of an OBJ without a word, a sentence each."""
    count = len(SHORT.findall(text))
    return [f"{count} faces of fewer than three corners are left out: is the file complete?"] if count else []


def clean_obj(text: bytes) -> bytes:
    """Drop comments behind numbers, and count relative indices (-1 is the last vertex so far) from the start.

    trimesh takes -1 for the last vertex of the whole file, and 0 for the first.

    Raises:
        BadInputError: index 0, or a relative one before the start.
    """
    if b"#" in text:
        text = COMMENT.sub(rb"\1", text)
    if ZERO.search(text):
        raise BadInputError("face index 0 is out of range: OBJ counts vertices from 1")
    return _absolute(text) if RELATIVE.search(text) else text


def _absolute(text: bytes) -> bytes:
    counts = {b"v": 0, b"vt": 0, b"vn": 0}
    lines = []
    for line in text.splitlines():
        words = line.split()
        if words and words[0] in counts:
            counts[words[0]] += 1
        elif words and words[0] == b"f":
            line = b"f " + b" ".join(_corner(word, list(counts.values())) for word in words[1:])
        lines.append(line)
    return b"\n".join(lines)


def _corner(word: bytes, counts: list[int]) -> bytes:
    """One corner such as b"-3/-2/-1"."""
    pairs = zip(word.split(b"/"), counts, strict=False)
    return b"/".join(_from_start(int(i), n) if i.startswith(b"-") else i for i, n in pairs)


def _from_start(index: int, count: int) -> bytes:
    if -index > count:
        raise BadInputError(f"face index {index} is out of range: {count} vertices stand before it")
    return b"%d" % (count + index + 1)
