"""Which of the parts that may move do, so that there are as many of each kind as a spec states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..part_words import name_words, synonyms
from .values import Spec
from .wishes import kind_of

# What closes a front: one of them may be taken for another, where a spec says so.
_FRONTS = ("door", "drawer", "lid", "flap", "window")


@dataclass(frozen=True)
class Option:
    """A part that may move.

    Attributes:
        label: what it is taken for, or "".
        score: 0..1, how sure it is.
        area: of its surface, any unit.
        sure: whether it would move without a spec.
        pinned: whether the spec lists it by itself, so that it stays what it is.
    """

    label: str
    score: float
    area: float
    sure: bool = True
    pinned: bool = False


def choose(spec: Spec, options: Sequence[Option]) -> tuple[str | None, ...]:
    """The label of each option, a new one where it is taken for something else; None where it stays still.

    Of a kind with a count the surest are kept. Where there are too few, others that close a front and are
    one too many of their own kind, or are nothing known, take their place: the largest first.
    """
    kind = [kind_of(spec, option.label) for option in options]
    result = [option.label if option.sure or option.pinned else None for option in options]
    counts = {word: stated.count for word, stated in spec.kinds.items() if stated.count is not None}
    missing: dict[str, int] = {}
    spare = {i for i, option in enumerate(options) if not name_words(option.label)[0] and not option.pinned}
    for word, count in counts.items():
        own = [i for i in range(len(options)) if kind[i] == word]
        own.sort(key=lambda i: (not options[i].pinned, not options[i].sure, -options[i].score, i))
        for rank, i in enumerate(own):
            result[i] = options[i].label if rank < count or options[i].pinned else None
        spare.update(i for i in own[count:] if not options[i].pinned)
        missing[word] = max(count - len(own), 0)
    for word, count in missing.items():
        pool = [i for i in spare if _exchangeable(word, options[i].label)]
        pool.sort(key=lambda i: (not options[i].sure, -options[i].area, i))
        for i in pool[:count]:
            result[i] = word
            spare.discard(i)
    return tuple(result)


def _exchangeable(word: str, label: str) -> bool:
    return not name_words(label)[0] or (_is_front(word) and _is_front(label))


def _is_front(label: str) -> bool:
    things = name_words(label)[0]
    return bool(things) and any(front == things[-1] or synonyms(front, things[-1]) for front in _FRONTS)
