"""Which of an object's named parts a description means: by words, then by place, size and material."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

import numpy as np

from .arrays import FloatArray, frozen_floats
from .asset import clean_name
from .part_places import NamedPart, levels, side_fit, size_fit
from .part_words import Wanted, name_words, one_form, synonyms, wanted

_SYNONYM, _ALIKE, _NO_NAME = 0.8, 0.6, 0.6
_TOLD = 0.4  # a description may only mention the thing: the least that counts
_NOT_LAST = 0.4  # "door" is the last word of "left_door", and not of "door_handle"
_HEAD = 0.75  # what the last noun counts for; those before it share the rest
_EXTRA = 0.95  # for each word of a part's name that nobody asked for
_LEAST_NAME, _LEAST_PLACE = 0.4, 0.3
_SAME_KIND = 0.16  # parts whose names fit so much worse than the best are of its kind
_TIE = 1e-6
_OTHER = 0.3  # for place, order, number or material that a part does not have


@dataclass(frozen=True, eq=False)
class Match:
    """What was found.

    Attributes:
        chosen: indices of the parts that are meant; none where nothing fits.
        scores: (P,) how well each part fits, 0..1.
        reasons: a phrase a part.
        score: 0..1 of the choice; less where several parts fit alike and one was meant.
        reason: one sentence.
    """

    chosen: tuple[int, ...]
    scores: FloatArray
    reasons: tuple[str, ...]
    score: float
    reason: str


def match(description: str, parts: Sequence[NamedPart]) -> Match:
    """Find the parts that a description means."""
    asked = wanted(description)
    exact = clean_name(description.lower().removeprefix("the "), "")
    names = np.array([1.0 if p.name == exact else _name_fit(asked, p) for p in parts])
    least = max(float(names.max()) - _SAME_KIND, _LEAST_NAME)
    kind = [i for i, fit in enumerate(names) if fit >= least]
    places = np.full(len(parts), _OTHER)
    if kind:
        places[kind] = _place_fit(asked, [parts[i] for i in kind])
    named = [i for i in kind if parts[i].name == exact]
    if named:  # whoever gives a part's own name means that part
        places[:], places[named] = _OTHER, 1.0
    scores = names * places
    reasons = tuple(f"name {n:.2f}, place {p:.2f}" for n, p in zip(names, places, strict=True))
    if not kind or places[kind].max() < _LEAST_PLACE + _TIE:
        return Match((), frozen_floats(scores), reasons, 0.0, "nothing fits")
    chosen, score, reason = _choice(asked, parts, kind, scores, names, bool(named))
    return Match(chosen, frozen_floats(scores), reasons, score, reason)


def nearest_name(description: str, parts: Sequence[NamedPart]) -> int:
    """The part whose name is most alike in letters, and nothing else: what grounding is compared with."""
    text = clean_name(description.lower().removeprefix("the "), "")
    alike = [SequenceMatcher(None, text, part.name).ratio() for part in parts]
    return int(np.argmax(alike))


def _choice(
    asked: Wanted,
    parts: Sequence[NamedPart],
    kind: list[int],
    scores: FloatArray,
    names: FloatArray,
    named: bool,
) -> tuple[tuple[int, ...], float, str]:
    best = max(kind, key=lambda i: scores[i])
    if named:
        numbered = [p.name for p in parts if re.fullmatch(rf"{parts[best].name}_\d+", p.name)]
        told = f"'{parts[best].name}' is the part's name"
        told += f"; {', '.join(numbered)} are of this kind, too" if numbered else ""
        return (best,), float(scores[best]) / (1 + len(numbered)), told
    if asked.many:
        meant = _several(asked, kind, scores, names)
        told = f"{len(meant)} of {len(kind)} parts of this kind"
        share = min(1.0, len(meant) / asked.count) if asked.count else 1.0
        return meant, share * float(scores[list(meant)].mean()), told
    alike = [i for i in kind if scores[i] > scores[best] - _TIE]
    near = _nearest(asked.context, parts, alike) if len(alike) > 1 else None
    if near is not None:
        return (near,), float(scores[near]), f"'{parts[near].name}' is nearest to '{asked.context}'"
    if len(alike) > 1:
        largest = max(alike, key=lambda i: parts[i].area)
        told = f"{len(alike)} parts fit alike: '{parts[largest].name}' is the largest"
        return (largest,), float(scores[largest]) / len(alike), told
    return (best,), float(scores[best]), f"'{parts[best].name}' fits best"


def _several(asked: Wanted, kind: list[int], scores: FloatArray, names: FloatArray) -> tuple[int, ...]:
    """The parts of a kind that a plural means: as many as are counted, or all that lie where it says.

    Where several are called just so, those with further words in their names are others: a steering wheel.
    """
    just_so = [i for i in kind if names[i] > names[kind].max() - _TIE]
    kind = just_so if len(just_so) > 1 else kind
    ranked = sorted(kind, key=lambda i: -scores[i])
    if asked.count:
        return tuple(sorted(ranked[: asked.count]))
    if not (asked.sides or asked.size or asked.order or asked.materials):
        return tuple(kind)
    return tuple(i for i in kind if scores[i] >= 0.6 * scores[ranked[0]])


def _nearest(context: str, parts: Sequence[NamedPart], alike: list[int]) -> int | None:
    """Of parts that fit alike, the one nearest to what `context` names; None where that names no other."""
    others = match(context, parts).chosen if context else ()
    if not others or set(others) & set(alike):
        return None
    beside = parts[others[0]]
    return min(
        alike, key=lambda i: (parts[i].gap(beside), float(np.linalg.norm(parts[i].center - beside.center)))
    )


def _name_fit(asked: Wanted, part: NamedPart) -> float:
    """0..1: how well the words of a part say what is asked for."""
    if not asked.things:
        return _NO_NAME if asked.sides or asked.size or asked.order else 0.0
    fits = max(_words_fit(asked.things, name_words(text)[0]) for text in (part.name, part.label))
    told = {one_form(word) for word in clean_name(part.description, "").split("_")}
    fits = max(fits, _TOLD if asked.things[-1] in told else 0.0)
    if asked.materials and set(asked.things) <= asked.materials and part.material in asked.materials:
        return max(fits, _NO_NAME)
    return fits


def _words_fit(things: tuple[str, ...], words: tuple[str, ...]) -> float:
    if not words:
        return 0.0
    likeness = np.array([[_alike(thing, word) for word in words] for thing in things])
    head = max(float(likeness[-1, -1]), _NOT_LAST * float(likeness[-1].max()))
    others = likeness[:-1].max(axis=1)
    fit = _HEAD * head + (1 - _HEAD) * float(others.mean()) if len(others) else head
    extra = sum(likeness.max(axis=0) == 0)
    return float(fit * _EXTRA**extra)


def _alike(one: str, other: str) -> float:
    if one == other:
        return 1.0
    if synonyms(one, other):
        return _SYNONYM
    joined = min(len(one), len(other)) >= 4 and (one.endswith(other) or other.endswith(one))
    return _ALIKE if joined or SequenceMatcher(None, one, other).ratio() > 0.84 else 0.0


def _place_fit(asked: Wanted, kind: list[NamedPart]) -> FloatArray:
    """(K,) 0..1: how well parts of one kind fit what is said of place, order, size and material."""
    fit = np.ones(len(kind))
    for side in asked.sides:
        fit = fit * side_fit(kind, side)
    if asked.size:
        fit = fit * size_fit(kind, asked.size)
    if asked.order:
        fit = fit * _order_fit(asked, kind)
    if asked.number:
        fit = fit * _numbered(kind, asked.number)
    if asked.materials:
        fits = np.array([part.material in asked.materials for part in kind])
        fit = fit * (np.where(fits, 1.0, _OTHER) if fits.any() else 0.7)
    return np.asarray(fit)


def _order_fit(asked: Wanted, kind: list[NamedPart]) -> FloatArray:
    if asked.many and asked.order == 1 and asked.order_from:  # "the first two from the top": the upper two
        return side_fit(kind, asked.order_from)
    return _at(levels(kind, asked.order_from), asked.order, len(kind))


def _at(order: list[list[int]], number: int, count: int) -> FloatArray:
    """(count,) 1 for what stands at a place of an order that counts from 1, or from -1 backwards."""
    fit = np.full(count, _OTHER)
    if number <= len(order):
        fit[order[number - 1 if number > 0 else -1]] = 1.0
    return fit


def _numbered(kind: list[NamedPart], number: int) -> FloatArray:
    """1 for the part whose name ends so: "drawer_2"; else for the one at that place in reading order."""
    ends = np.array([part.name.endswith(f"_{number}") for part in kind])
    return np.where(ends, 1.0, _OTHER) if ends.any() else _at(levels(kind, ""), number, len(kind))
