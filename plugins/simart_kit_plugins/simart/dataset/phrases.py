"""Phrases that may describe a part, each with all the parts that it could mean."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .kinds import FUNCTIONS
from .part_facts import PartFacts
from .places import place_words

Kind = Literal["label", "name", "place", "motion", "function", "material", "color", "carrier", "stated"]

# Axes along which a motion is named: what it is called along x, y and z.
_SLIDES = ("slides from side to side", "slides back and forth", "slides up and down")
_TURNS = (
    "tilts about a level axis from left to right",
    "tilts about a level axis from front to back",
    "swings about an upright axis",
)
_MOTIONS: dict[str, tuple[str, ...]] = {
    "prismatic": ("slides", "slides out", "moves in a straight line"),
    "revolute": ("swings on a hinge", "turns within limits"),
    "continuous": ("spins all the way round", "turns without end"),
    "ball": ("swivels in every direction",),
    "free": ("can be taken off", "lies loose"),
    "fixed": ("stays still", "does not move"),
}
# Cosines of the angle to an axis: those above the first run along it, those below the last clearly do not.
_ALONG, _MAYBE = 0.95, 0.6
_MATERIALS = {"mdf": "fibreboard"}


@dataclass(frozen=True, slots=True)
class Phrase:
    """A description.

    Attributes:
        text: such as "the upper left drawer".
        kind: what it goes by.
        fits: numbers of all parts that a reader might take it for.
    """

    text: str
    kind: Kind
    fits: frozenset[int]


def phrases(parts: Sequence[PartFacts], colors: bool) -> Iterator[Phrase]:
    """Everything that might be said of the parts; most of it means one of them, some of it several.

    Args:
        parts: of one object.
        colors: whether a reader sees colours.
    """
    yield from _words(parts)
    yield from _places(parts)
    yield from _motions(parts)
    yield from _functions(parts)
    yield from _materials(parts)
    yield from _carriers(parts)
    yield from (Phrase(t, "stated", frozenset([n])) for n, part in enumerate(parts) for t in part.words.texts)
    if colors:
        yield from _colors(parts)


def _called(parts: Sequence[PartFacts], words: str) -> frozenset[int]:
    """The parts that words may name: all that have each of them in label or name."""
    wanted = set(words.split())
    return frozenset(n for n, part in enumerate(parts) if wanted <= part.said)


def _words(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    for part in parts:
        if part.label:
            yield Phrase(f"the {part.label}", "label", _called(parts, part.label))
        if part.name:
            yield Phrase(f"the {part.name}", "name", _called(parts, part.name))


def _places(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    for label in sorted({part.label for part in parts if part.label}):
        alike = sorted(_called(parts, label))
        # Where a name only mentions the word, such as "tray sprinkler", nobody knows whether it is counted.
        if len(alike) < 2 or any(not set(label.split()) <= set(parts[n].label.split()) for n in alike):
            continue
        for place, words in place_words([parts[n].center for n in alike]):
            text = words.replace("*", label) if "*" in words else f"{words} {label}"
            yield Phrase(f"the {text}", "place", frozenset([alike[place]]))


def _motions(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    for kind, verbs in _MOTIONS.items():
        fits = frozenset(n for n, part in enumerate(parts) if part.kind == kind)
        yield from _moving(parts, verbs, fits)
    for kinds, verbs in ((("prismatic",), _SLIDES), (("revolute", "continuous"), _TURNS)):
        for axis, verb in enumerate(verbs):
            along = [_along(part, axis) if part.kind in kinds else 0.0 for part in parts]
            sure = {n for n, cosine in enumerate(along) if cosine > _ALONG}
            maybe = {n for n, cosine in enumerate(along) if cosine > _MAYBE}
            # A joint at a slant may be meant by either of two words, so that neither is clear.
            yield from _moving(parts, (verb,), frozenset(maybe), sure)


def _moving(
    parts: Sequence[PartFacts], verbs: Sequence[str], fits: frozenset[int], sure: set[int] | None = None
) -> Iterator[Phrase]:
    if not (fits if sure is None else sure):
        return
    for verb in verbs:
        yield Phrase(f"the part that {verb}", "motion", fits)
        for label in sorted({parts[n].label for n in fits if parts[n].label}):
            yield Phrase(f"the {label} that {verb}", "motion", fits & _called(parts, label))


def _along(part: PartFacts, axis: int) -> float:
    return 0.0 if part.joint is None else float(np.abs(part.joint.axis[axis]))


def _functions(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    for word, texts in FUNCTIONS.items():
        fits = frozenset(n for n, part in enumerate(parts) if part.said & {word, f"{word}s"})
        # Words such as "door handle" name the last thing, so that a reader may take either.
        meant = [n for n in fits if parts[n].label.split()[-1:] == [word]]
        for text in texts if meant else ():
            yield Phrase(text, "function", fits)


def _materials(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    if not all(part.words.materials for part in parts):
        return
    for material in sorted({part.material for part in parts if part.material}):
        fits = frozenset(n for n, part in enumerate(parts) if material in part.words.materials)
        word = _MATERIALS.get(material, material)
        yield Phrase(f"the part made of {word}", "material", fits)
        for label in sorted({parts[n].label for n in fits if parts[n].label}):
            yield Phrase(f"the {word} {label}", "material", fits & _called(parts, label))


def _colors(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    if not all(part.words.colors for part in parts):
        return
    for color in sorted({part.words.colors[0] for part in parts}):
        fits = frozenset(n for n, part in enumerate(parts) if color in part.words.colors)
        yield Phrase(f"the {color} part", "color", fits)
        for label in sorted({parts[n].label for n in fits if parts[n].label}):
            yield Phrase(f"the {color} {label}", "color", fits & _called(parts, label))


def _carriers(parts: Sequence[PartFacts]) -> Iterator[Phrase]:
    for part in parts:
        if part.parent is None or parts[part.parent].parent is None:
            continue
        carrier = parts[part.parent].label
        if part.label and carrier and part.label != carrier:
            on = {n for n, other in enumerate(parts) if other.parent in _called(parts, carrier)}
            yield Phrase(
                f"the {part.label} on the {carrier}", "carrier", frozenset(on) & _called(parts, part.label)
            )
