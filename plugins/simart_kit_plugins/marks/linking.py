"""The model's answer as links: which pieces are one rigid part, and what carries it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit import PartGuess
from simart_kit.arrays import IntArray, frozen_ints
from simart_kit.asset import JointKind, clean_name, unique_names

from .answers import ObjectAnswer


@dataclass(frozen=True)
class Link:
    """A rigid part.

    Attributes:
        name: clean and unique.
        label: what kind of thing it is.
        kind: of its joint; "fixed" of the body.
        parent: name of the link that carries it, "" of the body.
        pieces: numbers of its pieces, ascending.
        material: key of the material table.
        score: 0..1.
    """

    name: str
    label: str
    kind: JointKind
    parent: str
    pieces: tuple[int, ...]
    material: str
    score: float


def links_of(answer: ObjectAnswer, count: int) -> tuple[Link, ...]:
    """The links of a checked answer about pieces 0..count-1, body first; unnamed pieces are the body's."""
    told = sorted(answer.links, key=lambda link: bool(link.parent))
    names = dict(
        zip([link.name for link in told], unique_names([clean_name(link.name) for link in told]), strict=True)
    )
    cleaned = {clean_name(name): clean for name, clean in names.items()}
    rest = set(range(count)) - {piece for link in told for piece in link.pieces}
    return tuple(
        Link(
            names[link.name],
            " ".join(link.label.lower().split()) or names[link.name],
            link.kind,
            cleaned[clean_name(link.parent)] if link.parent else "",
            tuple(sorted({*link.pieces, *(() if link.parent else rest)})),
            link.material,
            link.confidence / 100.0,
        )
        for link in told
    )


def unnamed(answer: ObjectAnswer, count: int) -> tuple[int, ...]:
    """Pieces 0..count-1 that an answer gives to no link."""
    return tuple(sorted(set(range(count)) - {piece for link in answer.links for piece in link.pieces}))


def moved(links: Sequence[Link], name: str, pieces: Sequence[int]) -> tuple[Link, ...]:
    """Links when one of them takes some pieces over; none loses all that it has."""
    taken = set(pieces)
    for link in links:
        if link.name != name and set(link.pieces) <= taken:
            taken -= set(link.pieces)
    return tuple(
        replace(link, pieces=tuple(sorted({*link.pieces, *taken})))
        if link.name == name
        else replace(link, pieces=tuple(piece for piece in link.pieces if piece not in taken))
        for link in links
    )


def face_links(piece: IntArray, links: Sequence[Link]) -> IntArray:
    """(F,) int32 index of each face's link.

    Args:
        piece: (F,) of each face.
        links: that share all pieces.
    """
    of = np.zeros(int(piece.max()) + 1, dtype=np.int32)
    for index, link in enumerate(links):
        of[list(link.pieces)] = index
    return frozen_ints(of[piece])


def guesses(links: Sequence[Link]) -> tuple[PartGuess, ...]:
    """What a segmentation says of its parts."""
    return tuple(
        PartGuess(
            link.name,
            label=link.label,
            material=link.material,
            score=link.score,
            description=f"pieces {', '.join(map(str, link.pieces))}",
            material_stated=True,
        )
        for link in links
    )
