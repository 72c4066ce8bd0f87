"""Text that any viewer can show."""

from __future__ import annotations

# Beyond Latin-1: what rerun's own font has and our texts use.
_ALSO = frozenset("…→≤≥✓\u2013\u2014\u2018\u2019\u201c\u201d\u2022\u2212")


def readable(text: str) -> str:
    """The text with every other character written as its code.

    The viewer's font covers few scripts, and the viewer (0.41) ends with a panic at the first character that
    it lacks, in a part's label as in an error message.
    """
    return "".join(c if c in _ALSO or ord(c) < 256 else f"\\u{ord(c):04x}" for c in text)
