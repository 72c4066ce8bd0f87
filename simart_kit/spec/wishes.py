"""What a spec states of each part of a run: of the part itself, else of its kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, Vec3, vec3
from ..asset import Joint, JointKind
from ..part_words import name_words, one_form, synonyms
from ..stages import PartGuess
from .places import Place, fits
from .values import AxisWord, Motion, PartSpec, Point, Spec, position_limits


@dataclass(frozen=True)
class Wish:
    """How one part should move; None where nothing is stated.

    Attributes:
        joint: kind.
        axis: where it lies or points.
        limits: lowest and highest position [rad | m].
        through: (3,) a point on the axis, in the asset frame [m].
        parent: name of the part that carries it.
    """

    joint: JointKind | None = None
    axis: AxisWord | None = None
    limits: tuple[float, float] | None = None
    through: Vec3 | None = None
    parent: str | None = None

    def granted(self, joint: Joint | None, place: Place) -> bool:
        """Whether kind and axis of a joint, or no joint, are as stated."""
        kind = joint.kind if joint else "fixed"
        if self.joint is not None and kind != self.joint:
            return False
        return self.axis is None or (joint is not None and fits(joint, self.axis, place))


def wishes_of(spec: Spec, parts: Sequence[PartGuess], bounds: FloatArray) -> tuple[Wish, ...]:
    """A wish a part.

    Args:
        spec: what is stated.
        parts: as they are called after `shaping.with_parts`.
        bounds: (2, 3) of the object, for points that are shares of it.
    """
    listed = {part.name: part for part in spec.parts}
    return tuple(_wish(spec, listed.get(guess.name), guess, bounds) for guess in parts)


def kind_of(spec: Spec, label: str) -> str | None:
    """The word of `spec.kinds` that a label means: the same word first, then one for the same thing."""
    things = name_words(label)[0]
    if not things:
        return None
    same = [word for word in spec.kinds if _head(word) == things[-1]]
    alike = [word for word in spec.kinds if synonyms(_head(word), things[-1])]
    return next(iter([*same, *alike]), None)


def place_of(spec: Spec, point: Point, bounds: FloatArray) -> FloatArray:
    """(3,) a stated point in the asset frame [m]."""
    if spec.coordinates == "fraction":
        return np.asarray(bounds[0] + np.array(point) * (bounds[1] - bounds[0]))
    return np.array(point)


def _head(word: str) -> str:
    things = name_words(word)[0]
    return things[-1] if things else one_form(word)


def _wish(spec: Spec, part: PartSpec | None, guess: PartGuess, bounds: FloatArray) -> Wish:
    word = kind_of(spec, guess.label or guess.name)
    kind: Motion = spec.kinds[word] if word is not None else Motion()
    if part is None:
        return Wish(kind.joint, kind.axis, position_limits(kind))
    if part.root:
        return Wish()
    # A part's own kind of joint leaves nothing of what another kind would have for an axis and limits.
    same = part.joint in (None, kind.joint)
    own = part.limits is not None
    return Wish(
        joint=part.joint or kind.joint,
        axis=part.axis or (kind.axis if same else None),
        limits=position_limits(part if own else kind) if own or same else None,
        through=vec3(place_of(spec, part.through, bounds)) if part.through else None,
        parent=part.parent,
    )
