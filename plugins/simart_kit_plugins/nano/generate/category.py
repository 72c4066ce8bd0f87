"""A kind of generated objects."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from simart_kit.errors import BadInputError

from ...shapes.dice import Dice
from .objects import Body, GeneratedObject


@dataclass(frozen=True)
class Category:
    """A kind of objects.

    Attributes:
        name: in snake case.
        bodies: makes those of one object, the root first; see `objects` for the frame.
        moves: whether its objects have joints; False for static ones, which are a single body.
    """

    name: str
    bodies: Callable[[Dice], Sequence[Body]]
    moves: bool = True

    def make(self, dice: Dice) -> GeneratedObject:
        """An object, closed: every joint at 0."""
        return GeneratedObject(self.name, tuple(self.bodies(dice)))


def named(name: str, categories: Sequence[Category]) -> Category:
    """The category of this name; raises BadInputError, with the names that there are."""
    for category in categories:
        if category.name == name:
            return category
    known = sorted(category.name for category in categories)
    near = difflib.get_close_matches(name, known, 1)
    guess = f"did you mean {near[0]}? Known are" if near else "use all, or one of"
    raise BadInputError(f"unknown category '{name}': {guess} {', '.join(known)}")
