"""Collision shapes that give way at their own hinge, where they would turn into what is beside it.

A leaf that is hung at its back edge turns its front edge outward, by its own thickness. Models are often made
so where a real hinge would lead the leaf clear of its neighbour; solid shapes would hold each other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from .arrays import FloatArray, unit
from .asset import Asset, ConvexMesh, Joint
from .clipping import extent, pulled_in
from .convex_overlap import Convex, convex, gap, meets
from .kinematics import carried, moved_by, span
from .separation import replaced, rigid_bodies

_NEAR = 0.1  # of how far a leaf reaches from its axis: what is nearer is at the hinge
_TRIES = 8  # of how much gives way
_STOPS = 15  # on the way, where shapes are looked at
_ALONG = 0.9  # cosine from which a box gives way along its own side
_LEAST = 0.25  # of its extent that has to be left of a shape

Shapes = dict[str, list[ConvexMesh]]  # by name of the part


def relieved(asset: Asset) -> tuple[Asset, tuple[str, ...]]:
    """The asset with shapes that begin farther from their hinge, and the names of the parts that gave way.

    A leaf gives way only if that frees it from all neighbours at its hinge, and then as little as that takes,
    a tenth of its reach at most. Contact with the part that carries it is up to the exporters.

    Args:
        asset: with collision shapes that are apart at rest.
    """
    shapes: Shapes = {part.name: list(part.collision) for part in asset.parts}
    freed = [
        j.child for j in asset.joints if j.turns and span(j) != (0.0, 0.0) and _relieve(asset, shapes, j)
    ]
    moved = set[str]().union(*(carried(asset, name) for name in freed))
    changed = {name: tuple(shapes[name]) for name in moved}
    return replaced(asset, changed) if changed else asset, tuple(freed)


def _relieve(asset: Asset, shapes: Shapes, joint: Joint) -> bool:
    """Change the shapes that a hinge moves; returns whether they had to give way, and could."""
    mine = [part.name for part in asset.parts if part.name in carried(asset, joint.child)]
    reach = max((float(_distances(joint, s).max()) for name in mine for s in shapes[name]), default=0.0)
    near, ways = _NEAR * reach, _ways(np.array(joint.axis))
    others = [convex(s) for s in _beside(asset, shapes, joint, mine) if _nearest(joint, s, ways) < near]
    own = {name: [i for i, s in enumerate(shapes[name]) if _nearest(joint, s, ways) < near] for name in mine}
    if not others or _free(joint, [shapes[n][i] for n in mine for i in own[n]], others):
        return False
    for distance in near * np.arange(1, _TRIES + 1) / _TRIES:
        tried = {n: {i: _begun(joint, shapes[n][i], float(distance)) for i in own[n]} for n in mine}
        left = [s for row in tried.values() for s in row.values() if s is not None]
        if all(_remains(shapes[n], tried[n]) for n in mine) and _free(joint, left, others):
            for name in mine:
                row = [tried[name].get(i, shape) for i, shape in enumerate(shapes[name])]
                shapes[name] = [shape for shape in row if shape is not None]
            return True
    return False


def _beside(asset: Asset, shapes: Shapes, joint: Joint, mine: Sequence[str]) -> list[ConvexMesh]:
    """Shapes of what neither moves with a joint nor carries it."""
    bodies = rigid_bodies(asset)
    same = {int(bodies[asset.part_index(name)]) for name in (*mine, joint.parent)}
    names = [part.name for i, part in enumerate(asset.parts) if int(bodies[i]) not in same]
    return [shape for name in names for shape in shapes[name]]


def _remains(before: Sequence[ConvexMesh], after: Mapping[int, ConvexMesh | None]) -> bool:
    """Whether anything is left of a part that had shapes."""
    return not before or any(after.get(i, shape) is not None for i, shape in enumerate(before))


def _begun(joint: Joint, shape: ConvexMesh, distance: float) -> ConvexMesh | None:
    """What of a shape is at least as far from an axis, along the way it lies; None where that is little."""
    away = shape.vertices.mean(axis=0) - np.array(joint.origin)
    away -= np.array(joint.axis) * (away @ np.array(joint.axis))
    way = away / max(float(np.linalg.norm(away)), 1e-12)
    if shape.primitive is not None:
        own = shape.primitive.asset_T_shape[:3, :3].T
        along = own @ way
        best = int(np.argmax(np.abs(along)))
        way = own[best] * np.sign(along[best]) if abs(along[best]) > _ALONG else way
    lacking = distance - float(((shape.vertices - np.array(joint.origin)) @ way).min())
    if lacking > (1 - _LEAST) * extent(shape, way):
        return None
    return pulled_in(shape, -way, lacking)


def _free(joint: Joint, own: Sequence[ConvexMesh], others: Sequence[Convex]) -> bool:
    """Whether shapes pass others all the way."""
    boxes = np.array([other.bounds for other in others])
    cornered = [Convex(replace(shape, primitive=None)) for shape in own]
    for position in np.linspace(*span(joint), _STOPS):
        posed_T_rest = moved_by(joint, float(position))
        for turned in (shape.moved(posed_T_rest) for shape in cornered):
            if any(gap(turned, others[k])[0] < 0 for k in meets(turned, boxes).tolist()):
                return False
    return True


def _distances(joint: Joint, shape: ConvexMesh) -> FloatArray:
    """(V,) of a shape's corners from an axis [m]."""
    away = shape.vertices - np.array(joint.origin)
    return np.asarray(np.linalg.norm(np.cross(away, np.array(joint.axis)), axis=1))


def _ways(axis: FloatArray) -> FloatArray:
    """(36, 3) unit ways from a (3,) axis, all around it."""
    first = unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    angles = np.linspace(0, 2 * np.pi, 36, endpoint=False)[:, None]
    return np.asarray(np.cos(angles) * first + np.sin(angles) * np.cross(axis, first))


def _nearest(joint: Joint, shape: ConvexMesh, ways: FloatArray) -> float:
    """How near a shape comes to an axis [m], from below: seen along the axis, in (N, 3) unit `ways`."""
    return float(((shape.vertices - np.array(joint.origin)) @ ways.T).min(axis=0).max())
