"""What is asked of a frozen value again and again, computed once."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar

V = TypeVar("V")
P = ParamSpec("P")
R = TypeVar("R")


def kept(function: Callable[Concatenate[V, P], R]) -> Callable[Concatenate[V, P], R]:
    """Let a function keep its result with the value it is of, as `functools.cached_property` does in classes.

    For what every exporter asks of an asset. All share the result, so nobody may change it.

    Args:
        function: of a frozen dataclass without slots, and of numbers and words that say what is asked of it.
    """
    name = f"{function.__module__}.{function.__qualname__}"

    @wraps(function)
    def once(value: V, /, *args: P.args, **kwargs: P.kwargs) -> R:
        answers: dict[Hashable, R] = vars(value).setdefault(name, {})
        asked = (args, tuple(sorted(kwargs.items())))
        if asked not in answers:
            answers[asked] = function(value, *args, **kwargs)
        return answers[asked]

    return once
