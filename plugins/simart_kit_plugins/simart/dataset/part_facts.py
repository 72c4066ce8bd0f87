"""What can be said of each part of an object: words, place and motion."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import Vec3, vec3
from simart_kit.asset import Joint

from .kinds import kind_named
from .source_object import PartWords, SourceObject

# Words that data sets number their parts with; they describe nothing.
_NUMBERED = "root link part joint mesh object node group helper geom unknown"
# A part whose middle is nearer to the object's is on neither side [longest sides].
_BESIDE = 0.03


@dataclass(frozen=True, slots=True)
class PartFacts:
    """One part.

    Attributes:
        label: what it is, such as "drawer", or "".
        name: what it is called beside that, such as "upper left drawer", or "".
        center: (3,) middle of its box in the object's cube, 0..1.
        joint: how it moves; None for the root.
        parent: number of the part that carries it; None for the root.
        material: key of the material table, or "".
        words: materials and colours.
    """

    label: str
    name: str
    center: Vec3
    joint: Joint | None
    parent: int | None
    material: str
    words: PartWords

    @property
    def said(self) -> frozenset[str]:
        """All words of label and name."""
        return frozenset([*self.label.split(), *self.name.split()])

    @property
    def kind(self) -> str:
        """Of its joint; "fixed" for the root."""
        return "fixed" if self.joint is None else self.joint.kind


def part_facts(made: SourceObject) -> tuple[PartFacts, ...]:
    """The facts of each of the asset's parts, in the pose that the object is in."""
    asset = made.asset
    low, side = asset.mesh.bounds.mean(axis=0) - made.longest_side / 2, made.longest_side
    boxes = [triangles.reshape(-1, 3) for triangles in made.part_triangles]
    result = []
    names = _own_words([plain_words(guess.name) for guess in made.guesses])
    for part, guess, name, words, box in zip(
        asset.parts, made.guesses, names, made.words, boxes, strict=True
    ):
        joint = asset.joint_to(part.name)
        center = ((box.min(axis=0) + box.max(axis=0)) / 2 - low) / side
        label = plain_words(guess.label) or kind_named(name)
        result.append(
            PartFacts(
                label,
                "" if name == label or _contradicts(name, center[0]) else name,
                vec3(np.clip(center, 0.0, 1.0)),
                joint,
                None if joint is None else asset.part_index(joint.parent),
                guess.material,
                words,
            )
        )
    return tuple(result)


def _own_words(names: list[str]) -> list[str]:
    """The names without words that all of them have, such as the object's own."""
    common = set.intersection(*(set(name.split()) for name in names)) if len(names) > 1 else set()
    return [" ".join(word for word in name.split() if word not in common) for name in names]


def _contradicts(name: str, place: float) -> bool:
    """Whether a name says left of what the viewer sees at the right: some sides are the object's own."""
    sides = {"left", "right"} & set(name.split())
    return (sides == {"left"} and place > 0.5 + _BESIDE) or (sides == {"right"} and place < 0.5 - _BESIDE)


def plain_words(name: str) -> str:
    """A name as people say it, without numbers; "" where nothing is left: "link_3" says nothing."""
    words = [word for word in re.split(r"[^a-z]+", name.lower()) if word]
    return " ".join(word for word in words if word not in _NUMBERED.split() and len(word) > 1)
