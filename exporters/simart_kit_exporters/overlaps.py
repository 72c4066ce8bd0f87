"""Pairs of parts whose collision shapes overlap, so that contact between them has to be off."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from simart_kit.asset import Asset
from simart_kit.kept import kept
from simart_kit.separation import Overlap as Met
from simart_kit.separation import overlaps, overlaps_on_the_way, rigid_bodies, stopped_by_shapes


@dataclass(frozen=True)
class Overlap:
    """Why two parts must not touch.

    Attributes:
        depth: how deep their shapes overlap at most [m].
        at_rest: whether they do at rest; otherwise on the way of a joint alone.
    """

    depth: float
    at_rest: bool

    def words(self, first: str, second: str) -> str:
        """The pair, how deep and where."""
        where = "at rest" if self.at_rest else "on the way"
        return f"{first} and {second} ({1000 * self.depth:.2g} mm) {where}"


def overlapping_parts(asset: Asset) -> dict[tuple[str, str], Overlap]:
    """Pairs of parts that would collide where they should not, in the asset's order.

    These are pairs that overlap at rest, and a part and the one that it moves on where the joint's own travel
    makes them overlap: shapes are coarser than surfaces, and would stop a door short of its limit. So are
    other pairs that a joint drives into each other by their shapes alone. Pairs that MuJoCo never collides,
    such as a part and the one that it moves on where the base is free, are left out.
    """
    return _with_rest(asset, (*overlaps_on_the_way(asset), *stopped_by_shapes(asset)))


def _with_rest(asset: Asset, on_the_way: tuple[Met, ...]) -> dict[tuple[str, str], Overlap]:
    """Those that overlap at rest or on the way, as `overlapping_parts` says."""
    at_rest = {(o.one, o.other): o.depth for o in overlaps(asset)}
    deepest = dict(at_rest)
    for found in on_the_way:
        pair = (found.one, found.other)
        deepest[pair] = max(found.depth, deepest.get(pair, 0.0))
    body = dict(zip((part.name for part in asset.parts), rigid_bodies(asset).tolist(), strict=True))
    passing = _passing(asset, body)
    order = {part.name: index for index, part in enumerate(asset.parts)}
    return {
        pair: Overlap(deepest[pair], pair in at_rest)
        for pair in sorted(deepest, key=lambda pair: (order[pair[0]], order[pair[1]]))
        if frozenset(body[name] for name in pair) not in passing
    }


def _passing(asset: Asset, body: Mapping[str, int]) -> set[frozenset[int]]:
    """Rigid bodies that MuJoCo lets pass: one and what it moves on, unless that is fixed to the world."""
    fixed = None if asset.floating else body[asset.root.name]
    joints = [j for j in asset.joints if j.kind != "free" and not j.rigid]
    return {frozenset((body[j.parent], body[j.child])) for j in joints if body[j.parent] != fixed}


@kept
def overlapping_strangers(asset: Asset) -> Mapping[tuple[str, str], Overlap]:
    """Those of `overlapping_parts` that no joint connects, for formats whose joints rule out contact."""
    jointed = [{j.parent, j.child} for j in asset.joints if j.kind != "free"]
    # On its way a joint's own two rigid bodies meet, which is news only where bodies have several parts.
    several = len(set(rigid_bodies(asset).tolist())) < len(asset.parts)
    own = overlaps_on_the_way(asset) if several else ()
    found = _with_rest(asset, (*own, *stopped_by_shapes(asset)))
    return {pair: overlap for pair, overlap in found.items() if set(pair) not in jointed}


def told(found: Mapping[tuple[str, str], Overlap]) -> tuple[str, list[str]]:
    """What it means, and each of `overlapping_parts` in words."""
    words = [overlap.words(*pair) for pair, overlap in found.items()]
    return "collision shapes overlap, so contact between the parts is off", words
