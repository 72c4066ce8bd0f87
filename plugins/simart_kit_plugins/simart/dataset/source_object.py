"""What sources give and records are made of: an object with parts and joints, in one pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.errors import BadInputError
from simart_kit.kinematics import ordered_joints
from simart_kit.stages import PartGuess

# Longest sides beyond these are damage or a joke [m].
_SMALLEST, _LARGEST = 1e-4, 1e4


class UnusableError(BadInputError):
    """An object cannot become data.

    Attributes:
        reason: a phrase that is the same for all objects with this fault; what statistics count.
    """

    def __init__(self, reason: str, detail: str = "") -> None:
        super().__init__(f"{reason}: {detail}" if detail else reason)
        self.reason = reason


@dataclass(frozen=True, slots=True)
class PartWords:
    """What is known of a part beside its shape, for descriptions.

    Attributes:
        materials: keys of the material table that a fair share of it is made of; empty where nobody knows.
        colors: words for colours that a fair share of it has; the first is that of the most.
        texts: descriptions that come with the data.
    """

    materials: frozenset[str] = frozenset()
    colors: tuple[str, ...] = ()
    texts: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class SourceObject:
    """An object as a source knows it.

    Attributes:
        key: unique in a data set; letters, digits, - and _.
        source: such as "generated" or "partnet-mobility".
        category: such as "cabinet", or "".
        name: what the object is called, "" where it is only a number.
        asset: the surface with its looks, the parts and joints; position 0 is this pose.
        guesses: one for each of the asset's parts, material "" where nobody knows it.
        words: one for each of the asset's parts.
    """

    key: str
    source: str
    category: str
    name: str
    asset: Asset
    guesses: tuple[PartGuess, ...]
    words: tuple[PartWords, ...]

    @property
    def longest_side(self) -> float:
        """Of the bounding box in this pose [m]."""
        return float(np.ptp(self.asset.mesh.bounds, axis=0).max())

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """The joints, each after the one that moves its parent."""
        return ordered_joints(self.asset)

    @property
    def part_triangles(self) -> tuple[FloatArray, ...]:
        """For each part, its (F, 3, 3) triangles [m]."""
        triangles, label = self.asset.mesh.triangles, self.asset.face_part
        return tuple(triangles[label == part] for part in range(len(self.asset.parts)))


def check_usable(made: SourceObject, max_parts: int) -> SourceObject:
    """The object itself.

    Raises:
        UnusableError: it has too many parts, or a size that makes no sense.
    """
    count = len(made.asset.parts)
    if count > max_parts:
        raise UnusableError("too many parts", f"{made.key} has {count}, allowed are {max_parts}")
    if not _SMALLEST < made.longest_side < _LARGEST:
        raise UnusableError("absurd size", f"{made.key} is {made.longest_side:.3g} m across")
    return made
