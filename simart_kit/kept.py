"""What is asked of a frozen value again and again, computed once."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

V = TypeVar("V")
R = TypeVar("R")


def kept(function: Callable[[V], R]) -> Callable[[V], R]:
    """Let a function keep its result with the value it is of, as `functools.cached_property` does in classes.

    For what every exporter asks of an asset. All share the result, so nobody may change it.

    Args:
        function: of a frozen dataclass without slots.
    """
    name = f"{function.__module__}.{function.__qualname__}"

    @wraps(function)
    def once(value: V) -> R:
        known = vars(value)
        if name not in known:
            known[name] = function(value)
        result: R = known[name]
        return result

    return once
