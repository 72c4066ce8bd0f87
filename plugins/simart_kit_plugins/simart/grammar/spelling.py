"""How numbers are spelt, character by character: what may follow what has been written so far."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

Spelling = Callable[[str], tuple[str, bool]]
"""What was written so far -> (characters that may follow, whether the number may end here)."""


@lru_cache(maxsize=4096)
def whole(low: int, high: int, *, zero: bool = True) -> Spelling:
    """Whole numbers low..high, without leading zeros and without "-0".

    Args:
        low: the smallest.
        high: the largest.
        zero: whether 0 is one of them.
    """
    follow: dict[str, set[str]] = {}
    numbers = {str(value) for value in range(low, high + 1) if value or zero}
    for number in numbers:
        for length, character in enumerate(number):
            follow.setdefault(number[:length], set()).add(character)
    table = {text: ("".join(sorted(next_)), text in numbers) for text, next_ in follow.items()}
    table |= {text: ("", True) for text in numbers if text not in follow}
    return table.__getitem__


@lru_cache(maxsize=64)
def decimal(before: int, after: int) -> Spelling:
    """Decimal numbers above 0 in their shortest form: "40.0" and "0.05", never "05.0" or "1.20".

    Args:
        before: digits before the point at most.
        after: digits behind it at most; there is always one.
    """

    def follows(text: str) -> tuple[str, bool]:
        if not text:
            return "0123456789", False
        head, point, tail = text.partition(".")
        if not point:
            grows = head != "0" and len(head) < before
            return ("0123456789." if grows else "."), False
        return _fraction(head, tail, after)

    return follows


def _fraction(head: str, tail: str, after: int) -> tuple[str, bool]:
    """What may follow digits behind the point; the last may not be a 0 that says nothing."""
    if len(tail) == after:
        return "", True
    last = len(tail) + 1 == after
    plain = not tail and head != "0"
    digits = "123456789" if last and not plain else "0123456789"
    whole_tenths = len(tail) == 1 and (head != "0" or tail != "0")
    return digits, bool(tail) and (whole_tenths or not tail.endswith("0"))
