"""The order of an answer's parts: the root first, and parents before what they carry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from simart_kit import Joint, PartGuess
from simart_kit.errors import BadInputError


@dataclass(frozen=True, slots=True)
class Place:
    """A part in the order of an answer.

    Attributes:
        part: its index in the parts that were given.
        parent: place of its parent in the answer; None for the root.
        joint: what moves it; None for the root and for a part without joint, which is fixed to the root.
    """

    part: int
    parent: int | None
    joint: Joint | None


def ordered(parts: Sequence[PartGuess], joints: Sequence[Joint], sizes: Sequence[int]) -> tuple[Place, ...]:
    """The parts level by level from the root, on each level in the order that they were given.

    The root is the largest part that no joint moves, the first of equal ones.

    Args:
        parts: (P,) with unique names.
        joints: at most one to each part.
        sizes: (P,) such as numbers of cells.

    Raises:
        BadInputError: there is no part, names are not unique, or the joints are no tree of these parts.
    """
    index = {part.name: number for number, part in enumerate(parts)}
    if not parts or len(index) != len(parts):
        raise BadInputError("an answer needs parts, and their names must differ")
    mover = _movers(index, joints)
    still = [number for number in range(len(parts)) if number not in mover]
    if not still:
        raise BadInputError("an answer needs a root: the joints form a loop")
    root = max(still, key=lambda number: (sizes[number], -number))
    parent = [index[mover[n].parent] if n in mover else root for n in range(len(parts))]
    depth = _depths(parts, parent, root)
    order = sorted(range(len(parts)), key=lambda number: (depth[number], number))
    place = {number: position for position, number in enumerate(order)}
    return tuple(Place(n, None if n == root else place[parent[n]], mover.get(n)) for n in order)


def _movers(index: dict[str, int], joints: Sequence[Joint]) -> dict[int, Joint]:
    """The joint that moves each part."""
    mover: dict[int, Joint] = {}
    for joint in joints:
        for end in (joint.parent, joint.child):
            if end not in index:
                raise BadInputError(f"joint '{joint.name}' names part '{end}': parts are {', '.join(index)}")
        if index[joint.child] in mover:
            raise BadInputError(f"part '{joint.child}' is moved by two joints")
        mover[index[joint.child]] = joint
    return mover


def _depths(parts: Sequence[PartGuess], parent: Sequence[int], root: int) -> list[int]:
    """(P,) joints between each part and the root."""
    depth = []
    for number in range(len(parts)):
        steps, at = 0, number
        while at != root:
            steps, at = steps + 1, parent[at]
            if steps > len(parts):
                raise BadInputError(f"the joints form a loop through part '{parts[number].name}'")
        depth.append(steps)
    return depth
