"""Links that are there for the format's sake: those between two joints, and the world below a base."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..articulation import Articulation, Link, LinkJoint


def folded(articulation: Articulation) -> Articulation:
    """The object without links that only stand between two joints.

    A lid that slides and turns is a prismatic joint to an empty link, and a continuous one from it to the
    lid. Such a link has no face, moves, and carries one link alone, which moves against it. The link that it
    carries gets its joint, and its own as one of `also`.
    """
    links, labels = list(articulation.links), np.array(articulation.labels)
    while (helper := _helper(links, set(labels.tolist()))) is not None:
        (child,) = (i for i, link in enumerate(links) if link.parent == helper)
        first, own = links[helper], links[child]
        also = (*first.also, own.joint, *own.also)
        links[child] = replace(own, parent=first.parent, joint=first.joint, also=also)
        del links[helper]
        links = [replace(k, parent=k.parent - (k.parent > helper)) for k in links]
        labels = labels - (labels > helper)
    return replace(articulation, links=tuple(links), labels=labels)


def grounded(articulation: Articulation) -> Articulation:
    """The object with its base standing still, where all that there is floats.

    Formats say of an object that is not fixed to the ground that it has a free joint, against nothing or
    against an empty link such as "world". That is no movement of a part. The first link that floats so is
    the base, unless something else stands on the ground or is hinged to it.
    """
    links, seen = list(articulation.links), set(articulation.labels.tolist())
    empty = {i for i, link in enumerate(links) if link.parent < 0 and i not in seen}
    lowest = [i for i, k in enumerate(links) if k.parent in empty or (k.parent < 0 and i in seen)]
    if not lowest or any(links[i].joint.kind != "free" for i in lowest):
        return articulation
    links[lowest[0]] = replace(links[lowest[0]], joint=LinkJoint())
    return replace(articulation, links=tuple(links))


def _helper(links: list[Link], with_faces: set[int]) -> int | None:
    """Index of the first link that only stands between two joints."""
    for index, link in enumerate(links):
        carried = [other for other in links if other.parent == index]
        if index in with_faces or not link.joint.moves or len(carried) != 1:
            continue
        if carried[0].joint.moves:
            return index
    return None
