"""Descriptions of parts for grounding questions: varied, and never such that they fit two parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..prompt.texts import TEXT_LENGTH
from .part_facts import PartFacts
from .phrases import Phrase, phrases


def clear_phrases(parts: Sequence[PartFacts], colors: bool) -> tuple[tuple[Phrase, ...], ...]:
    """For each part, the phrases that mean it and nothing else, each text once.

    Texts with the same words count as one: "the front left wheel" and "the left front wheel" may come from a
    name and from a place, and are dropped where these mean different parts.

    Args:
        parts: of one object.
        colors: whether a reader sees colours.
    """
    found: dict[frozenset[str], list[Phrase]] = {}
    for phrase in phrases(parts, colors):
        if len(phrase.text) > TEXT_LENGTH:
            continue
        found.setdefault(frozenset(phrase.text.split()), []).append(phrase)
    result: list[list[Phrase]] = [[] for _ in parts]
    for same in found.values():
        fits = frozenset().union(*(phrase.fits for phrase in same))
        if len(fits) == 1:
            result[next(iter(fits))].append(same[0])
    return tuple(map(tuple, result))


def chosen(clear: Sequence[Phrase], count: int, generator: np.random.Generator) -> tuple[str, ...]:
    """Texts for one part, of as many kinds as possible.

    Args:
        clear: phrases that mean the part alone.
        count: how many texts, fewer where there are fewer phrases.
        generator: decides which, and whether the article is said.
    """
    order = [clear[n] for n in generator.permutation(len(clear))]
    first = list({phrase.kind: phrase for phrase in reversed(order)}.values())
    later = [phrase for phrase in order if phrase not in first]
    picked = [*(first[n] for n in generator.permutation(len(first))), *later][:count]
    return tuple(_with_article(phrase.text, bool(generator.random() < 0.7)) for phrase in picked)


def _with_article(text: str, said: bool) -> str:
    return text if said or text.startswith("the part that") else text.removeprefix("the ")
