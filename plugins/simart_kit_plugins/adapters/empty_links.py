"""Links without a surface: an asset's parts all have one, so these are taken out of the tree."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from simart_kit import BadInputError
from simart_kit.bench.articulation import Link, LinkJoint, ordered


@dataclass(frozen=True)
class ShapedLinks:
    """The links that have a surface.

    Attributes:
        places: of each, its index among the links that were given.
        links: the links, parents by index among themselves.
        notes: what was lost with the others, a sentence each.
    """

    places: tuple[int, ...]
    links: tuple[Link, ...]
    notes: tuple[str, ...]


def shaped_links(links: tuple[Link, ...], shaped: Collection[int]) -> ShapedLinks:
    """The tree without its empty links.

    Nothing is lost where an empty link is fixed to its parent, or where something is fixed to it: that takes
    its place. A link that hangs on another by two joints in a row keeps the first.

    Args:
        links: as a file states them.
        shaped: indices of those that have a surface; at least one.

    Raises:
        BadInputError: several links move against an empty root, so that nothing stands still.
    """
    tree, notes = dict(enumerate(links)), list[str]()
    for index in reversed(ordered(links)):  # leaves first: most empty ones are ends of frames
        if index not in shaped:
            notes += _taken_out(tree, index)
    places = tuple(tree)
    index_of = {-1: -1} | {place: index for index, place in enumerate(places)}
    kept = tuple(replace(link, parent=index_of[link.parent]) for link in tree.values())
    return ShapedLinks(places, kept, tuple(notes))


def _taken_out(tree: dict[int, Link], index: int) -> list[str]:
    """Take an empty link out of the tree; returns what is lost."""
    link = tree.pop(index)
    carried = [i for i, other in tree.items() if other.parent == index]
    fixed = [i for i in carried if not tree[i].joint.moves]
    if not carried:
        return [f"link '{link.name}' moves and has no shape: it is left out"] if link.joint.moves else []
    if link.parent >= 0 and not link.joint.moves:
        _hang(tree, carried, link.parent)
        return []
    if fixed:
        heir = fixed[0]
        tree[heir] = replace(tree[heir], parent=link.parent, joint=link.joint)
        _hang(tree, carried, heir)
        return []
    if len(carried) == 1:
        (child,) = carried
        own = tree[child]
        joint = LinkJoint() if link.parent < 0 else link.joint
        tree[child] = replace(own, parent=link.parent, joint=joint)
        return [_lost(own, link)]
    names = ", ".join(f"'{tree[i].name}'" for i in carried)
    if link.parent < 0:
        raise BadInputError(
            f"link '{link.name}' has no shape and all that hangs on it moves ({names}): "
            "nothing stands still; give it a <visual>, or fix one of them to it"
        )
    _hang(tree, carried, link.parent)
    return [f"link '{link.name}' has no shape: its joint, which moves {names} together, is left out"]


def _hang(tree: dict[int, Link], carried: list[int], parent: int) -> None:
    for index in carried:
        if index != parent:
            tree[index] = replace(tree[index], parent=parent)


def _lost(own: Link, link: Link) -> str:
    kind = own.joint.kind
    if link.parent >= 0:
        return (
            f"'{own.name}' hangs on '{link.name}', which has no shape, by a second joint: "
            f"only the first, {link.joint.kind}, is kept, not the {kind} one"
        )
    if kind == "free":
        return f"'{own.name}' floats: it is the base here; use --floating to leave it free"
    return f"'{own.name}' moves against '{link.name}', which has no shape: it is the base, and stands still"
