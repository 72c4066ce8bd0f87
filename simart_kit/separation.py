"""Collision shapes of parts that move against each other: which overlap at rest, and how to part them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .arrays import FloatArray, IntArray
from .asset import Asset, ConvexMesh, Joint
from .clipping import extent, pulled_in
from .convex_overlap import Convex, gap
from .kinematics import Positions, rest_to_posed, span
from .primitive_meshes import pose
from .topology import connected

TOLERANCE = 1e-5
"""How deep shapes may overlap and still count as touching [m]."""

CLEARANCE = 0.0005
"""How far shapes of neighbours are kept apart at rest [m]: what touches at rest rubs and sticks."""

_NEAR_REST = (0.02, 0.05, 0.09)  # of the way to each limit
_MOST_OF_SHAPE = 0.25  # of its extent that a shape may lose on one side


@dataclass(frozen=True)
class Overlap:
    """Two parts, in the asset's order, whose shapes stand in each other.

    Attributes:
        one: name of the part that comes first.
        other: name of the other part.
        depth: the shortest way that parts the two shapes that overlap most [m].
    """

    one: str
    other: str
    depth: float


def still(joint: Joint) -> bool:
    """Whether a joint cannot move: fixed, or without travel."""
    return joint.kind == "fixed" or (joint.limits is not None and span(joint) == (0.0, 0.0))


def rigid_bodies(asset: Asset) -> IntArray:
    """(P,) label of each part; parts have the same one when no joint lets them move against each other."""
    ends = [(asset.part_index(j.parent), asset.part_index(j.child)) for j in asset.joints if still(j)]
    one, two = np.array(ends, dtype=np.int64).reshape(-1, 2).T
    return connected(len(asset.parts), one, two)


def overlaps(asset: Asset, positions: Positions | None = None) -> tuple[Overlap, ...]:
    """Pairs of parts of different rigid bodies whose collision shapes overlap, in the asset's order.

    Args:
        asset: with collision shapes.
        positions: of its joints [rad | m]; the default is the rest pose.

    Raises:
        BadInputError: a position for a joint that does not exist, or of a wrong size.
    """
    shapes = _posed(asset, positions)
    deepest: dict[tuple[int, int], float] = {}
    for (one, i), (other, j) in _near(asset, shapes, -TOLERANCE):
        depth = -gap(shapes[one][i], shapes[other][j])[0]
        if depth > TOLERANCE:
            deepest[one, other] = max(depth, deepest.get((one, other), 0.0))
    names = [part.name for part in asset.parts]
    return tuple(Overlap(names[one], names[other], deepest[one, other]) for one, other in sorted(deepest))


def overlaps_on_the_way(asset: Asset, stops: int = 9) -> tuple[Overlap, ...]:
    """Pairs of a part and one that it moves on, whose shapes overlap somewhere on the joint's own way.

    Shapes are coarser than surfaces, and such a pair would stop a door short of its limit. What is fixed to
    either part of a joint counts as that part.

    Args:
        asset: with collision shapes.
        stops: positions tried between the limits of each joint, both included, besides some near rest.
    """
    found, bodies = dict[tuple[str, str], float](), rigid_bodies(asset)
    for joint in asset.joints:
        if span(joint) == (0.0, 0.0):
            continue
        both = [bodies[asset.part_index(name)] for name in (joint.parent, joint.child)]
        pair = {part.name for part, body in zip(asset.parts, bodies, strict=True) if body in both}
        for position in _stops(span(joint), stops):
            for item in overlaps(_only(asset, pair), {joint.name: position}):
                key = (item.one, item.other)
                found[key] = max(item.depth, found.get(key, 0.0))
    order = {part.name: index for index, part in enumerate(asset.parts)}
    keys = sorted(found, key=lambda key: (order[key[0]], order[key[1]]))
    return tuple(Overlap(*key, found[key]) for key in keys)


def _stops(ends: tuple[float, float], count: int) -> list[float]:
    """Positions from end to end, closer to each other near rest, where edges of a panel pass its frame."""
    near = [share * end for end in ends for share in _NEAR_REST]
    return sorted({0.0, *near, *np.linspace(*ends, count).tolist()})


def separated(asset: Asset, margin: float, clearance: float = CLEARANCE) -> Asset:
    """The asset with shapes pulled in on the sides where they meet another rigid body's at rest.

    Both of a pair give way alike, each by `margin` and a quarter of its extent at most. A pair that this does
    not part stays as it is: simulators have to exclude it.

    Args:
        asset: with collision shapes.
        margin: most that a shape loses on a side for one neighbour [m].
        clearance: how far apart they are to be [m].
    """
    shapes = _posed(asset, None)
    for (one, i), (other, j) in _near(asset, shapes, clearance):
        first, second = shapes[one][i], shapes[other][j]
        apart, axis = gap(first, second)
        pulls = _pulls(first.shape, second.shape, axis, clearance - apart, margin)
        if pulls is not None:
            shapes[one][i] = Convex(pulled_in(first.shape, axis, pulls[0]))
            shapes[other][j] = Convex(pulled_in(second.shape, -axis, pulls[1]))
    parts = zip(asset.parts, shapes, strict=True)
    return replaced(asset, {part.name: tuple(c.shape for c in row) for part, row in parts})


def replaced(asset: Asset, shapes: Mapping[str, tuple[ConvexMesh, ...]]) -> Asset:
    """The asset with other collision shapes of some parts, by name."""
    return asset.with_parts({n: replace(asset.part(n), collision=row) for n, row in shapes.items()})


def _pulls(
    one: ConvexMesh, other: ConvexMesh, axis: FloatArray, lacking: float, margin: float
) -> tuple[float, float] | None:
    """How far each of two shapes gives way along an axis [m]; None where none has to, or it is too far.

    Args:
        one: a shape.
        other: the shape in the direction of `axis` from it.
        axis: (3,) unit.
        lacking: what both have to give way together [m].
        margin: most for each [m].
    """
    most = [min(margin, _MOST_OF_SHAPE * extent(shape, axis)) for shape in (one, other)]
    if lacking <= TOLERANCE / 2 or lacking > sum(most):
        return None
    mine = min(max(lacking / 2, lacking - most[1]), most[0])
    return mine, lacking - mine


def _posed(asset: Asset, positions: Positions | None) -> list[list[Convex]]:
    """The shapes of each part, moved to where the joints put them."""
    if not positions:
        return [[Convex(shape) for shape in part.collision] for part in asset.parts]
    posed_T_rest = rest_to_posed(asset, positions)
    return [[Convex(_moved(s, posed_T_rest[p.name])) for s in p.collision] for p in asset.parts]


def _moved(shape: ConvexMesh, matrix: FloatArray) -> ConvexMesh:
    if np.array_equal(matrix, np.eye(4)):
        return shape
    rotation, shift = matrix[:3, :3], matrix[:3, 3]
    primitive = shape.primitive
    if primitive is not None:
        start = primitive.asset_T_shape
        moved = pose(rotation @ start[:3, :3], rotation @ start[:3, 3] + shift)
        primitive = replace(primitive, asset_T_shape=moved)
    return ConvexMesh(shape.vertices @ rotation.T + shift, shape.faces, primitive)


def _only(asset: Asset, names: set[str]) -> Asset:
    """The asset with the shapes of some parts alone."""
    bare = {p.name: replace(p, collision=()) for p in asset.parts if p.name not in names}
    return asset.with_parts(bare)


def _near(
    asset: Asset, shapes: Sequence[Sequence[Convex]], reach: float
) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Pairs (part, shape) of different rigid bodies whose boxes are at most `reach` [m] apart."""
    body = rigid_bodies(asset)
    owner = np.array([(p, i) for p, row in enumerate(shapes) for i in range(len(row))], dtype=np.int64)
    if not len(owner):
        return
    bounds = np.array([shapes[p][i].bounds for p, i in owner])
    for first in range(len(owner)):
        later = slice(first + 1, None)
        close = (bounds[later, 0] <= bounds[first, 1] + reach).all(axis=1)
        close &= (bounds[later, 1] >= bounds[first, 0] - reach).all(axis=1)
        close &= body[owner[later, 0]] != body[owner[first, 0]]
        for second in first + 1 + np.flatnonzero(close):
            one, other = owner[first].tolist(), owner[second].tolist()
            yield (one[0], one[1]), (other[0], other[1])
