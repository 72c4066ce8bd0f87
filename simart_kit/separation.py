"""Collision shapes of parts that move against each other: which overlap at rest, and how to part them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from .arrays import FloatArray, IntArray
from .asset import Asset, ConvexMesh, Joint, Limits, Part
from .bounds import box_corners, reaching, sharing
from .clipping import extent, pulled_in
from .convex_overlap import Convex, convex, gap, meets
from .kept import kept
from .kinematics import Positions, carried, moved_by, reach_box, rest_to_posed, span
from .mesh import Mesh
from .sweeping import Sweep, free_range
from .topology import connected

TOLERANCE = 1e-5
"""How deep shapes may overlap and still count as touching [m]."""

CLEARANCE = 0.0005
"""How far shapes of neighbours are kept apart at rest [m]: what touches at rest rubs and sticks."""

STUCK = 0.0005
"""How deep shapes may be in each other and still slide past [m]: deeper ones stop what a motor drives."""

Pair = tuple[int, int]
"""Indices of two parts, ascending."""

_STOPS = 9  # positions tried between the limits of each joint, both included, besides some near rest
_CLOSER = 33  # where two hardly clear each other at one of these
_NEAR_REST = (0.02, 0.05, 0.09)  # of the way to each limit
_SOON = (*_NEAR_REST, 0.125, 0.25)  # a joint that stops there hardly moves
# A corner that turns out of its frame grazes that on a hundredth of its way.
_LEAVING = tuple(0.005 * step for step in range(1, 21))
_MOST_OF_SHAPE = 0.25  # of its extent that a shape may lose on one side


@dataclass(frozen=True)
class Overlap:
    """Two parts, in the asset's order, whose shapes stand in each other.

    Attributes:
        one: name of the part that comes first.
        other: name of the other part.
        depth: the shortest way that parts the two shapes that overlap most [m]; 0 where they only touch.
    """

    one: str
    other: str
    depth: float


def rigid_bodies(asset: Asset) -> IntArray:
    """(P,) label of each part; parts have the same one when no joint lets them move against each other."""
    ends = [(asset.part_index(j.parent), asset.part_index(j.child)) for j in asset.joints if j.rigid]
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
    if not positions:
        return _overlaps_at_rest(asset)
    return _named(asset, _deepest(_posed(_shapes(asset.parts), asset, positions), rigid_bodies(asset)))


@kept
def _overlaps_at_rest(asset: Asset) -> tuple[Overlap, ...]:
    return _named(asset, _deepest(_shapes(asset.parts), rigid_bodies(asset)))


@kept
def overlaps_on_the_way(asset: Asset) -> tuple[Overlap, ...]:
    """Pairs of a part and one that it moves on, whose shapes meet somewhere on the joint's own way.

    Shapes are coarser than surfaces, and such a pair would stop a door short of its limit. So does one whose
    shapes only touch there: solvers take a flat face that slides along another for a brake. What is fixed to
    either part of a joint counts as that part.

    Args:
        asset: with collision shapes.
    """
    found, shapes, bodies = dict[Pair, float](), _shapes(asset.parts), rigid_bodies(asset)
    for joint in (joint for joint in asset.joints if span(joint) != (0.0, 0.0)):
        carrier, mine = (
            np.flatnonzero(bodies == bodies[asset.part_index(name)]) for name in (joint.parent, joint.child)
        )
        meet = partial(_met, shapes, joint, mine.tolist(), carrier.tolist())
        met = meet(_stops(span(joint), _LEAVING if joint.limits else _NEAR_REST), -CLEARANCE / 2)
        passed = any(depth < -TOLERANCE for depth in met.values())  # closely: they may touch in between
        closer = meet(np.linspace(*span(joint), _CLOSER).tolist(), -TOLERANCE) if passed else {}
        for pair, depth in (*met.items(), *closer.items()):
            if depth >= -TOLERANCE:
                found[pair] = max(depth, found.get(pair, 0.0))
    return _named(asset, found)


@kept
def stopped_by_shapes(asset: Asset) -> tuple[Overlap, ...]:
    """Pairs, but those of `overlaps_on_the_way`, that a joint drives into each other by their shapes alone.

    Such as a door and the drawer above it, whose surfaces pass each other all the way. A pair whose surfaces
    stop one of its joints is none, as a rack and the closed door before it; but if shapes alone stop another
    of its joints soon, as a door whose inside the rack's shapes touch, it is one: else one could not move. So
    is one whose surfaces pass once the other part is out of the way, where shapes alone stop it even then.

    Args:
        asset: with collision shapes.
    """
    found, shapes, bodies = dict[Pair, float](), _shapes(asset.parts), rigid_bodies(asset)
    known, at_rest = (
        {(asset.part_index(o.one), asset.part_index(o.other)) for o in met}
        for met in (overlaps_on_the_way(asset), overlaps(asset))
    )
    stopped, stuck = set[frozenset[int]](), set[frozenset[int]]()  # pairs of rigid bodies
    for joint in (joint for joint in asset.joints if span(joint) != (0.0, 0.0)):
        moved = frozenset(asset.part_index(name) for name in carried(asset, joint.child))
        met = partial(_driven, asset.mesh, asset.parts, joint, moved)
        all_the_way = met(tuple(_stops(span(joint), _NEAR_REST)))
        deep = {p: d for p, d in all_the_way.items() if d > STUCK and p not in known}
        soon = met(tuple(share * end for end in span(joint) for share in _SOON)) if deep else {}
        for pair, depth in deep.items():
            found[pair] = max(depth, found.get(pair, 0.0))
            if not _free(asset, joint, pair, moved) and not _stopped_when_open(
                asset, shapes, joint, pair, moved
            ):
                stopped.add(_rigid(bodies, pair))
            elif soon.get(pair, 0.0) > STUCK and pair not in at_rest:
                stuck.add(_rigid(bodies, pair))
    return _named(asset, {p: depth for p, depth in found.items() if _rigid(bodies, p) not in stopped - stuck})


@kept
def _driven(
    mesh: Mesh, parts: tuple[Part, ...], joint: Joint, moved: frozenset[int], stops: tuple[float, ...]
) -> Mapping[Pair, float]:
    """How deep a joint drives parts into others at some of these positions [m].

    Kept with the mesh, as it is asked for again whenever another of the joints has given way.
    """
    still = [part for part in range(len(parts)) if part not in moved]
    return _met(_shapes(parts), joint, sorted(moved), still, stops)


def _rigid(bodies: IntArray, pair: Pair) -> frozenset[int]:
    """The rigid bodies of a pair of parts."""
    return frozenset(int(bodies[part]) for part in pair)


def _free(
    asset: Asset, joint: Joint, pair: Pair, moved: Collection[int], positions: Positions | None = None
) -> bool:
    """Whether the surface of one of a pair, which the joint moves, passes that of the other all the way.

    As the modifier `sweep` looks at it: what stands in the other at rest may slide on in it.
    """
    mine, other = sorted(pair, key=lambda part: part not in moved)
    triangles = [asset.mesh.triangles[asset.face_part == part].reshape(-1, 3) for part in (mine, other)]
    posed_T_rest = rest_to_posed(asset, positions or {})[asset.parts[other].name]
    triangles[1] = triangles[1] @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3]
    faces = [np.arange(len(corners)).reshape(-1, 3) for corners in triangles]
    limited = replace(joint, kind="revolute" if joint.turns else joint.kind, limits=Limits(*span(joint)))
    sweep = Sweep(np.concatenate(triangles), faces[0], faces[1] + len(triangles[0]), holes=True)
    return free_range(limited, sweep, _STOPS) == span(joint)


def _stopped_when_open(
    asset: Asset, shapes: Sequence[Sequence[Convex]], joint: Joint, pair: Pair, moved: Collection[int]
) -> bool:
    """Whether shapes alone stop a joint at the other of a pair that is as open as it goes."""
    mine, other = sorted(pair, key=lambda part: part not in moved)
    own = asset.joint_to(asset.parts[other].name)
    if own is None or span(own) == (0.0, 0.0):
        return False
    positions = {own.name: max(span(own), key=abs)}
    posed = _posed(shapes, asset, positions)
    met = _met(posed, joint, [mine], [other], _stops(span(joint), _NEAR_REST))
    deep = met.get((min(pair), max(pair)), 0.0) > STUCK
    return deep and _free(asset, joint, pair, moved, positions)


def _met(
    shapes: Sequence[Sequence[Convex]],
    joint: Joint,
    moving: Collection[int],
    still: Collection[int],
    stops: Sequence[float],
    least: float = TOLERANCE,
) -> dict[Pair, float]:
    """How deep parts that a joint moves stand in others at some of these positions, where by `least` [m]."""
    found: dict[Pair, float] = {}
    mine = [(part, one) for part in moving for one in shapes[part]]
    others = [(part, one) for part in still for one in shapes[part]]
    if not mine or not others:
        return found
    touching = max(-least, 0.0) * np.array([[-1.0], [1.0]])
    boxes = np.array([one.bounds + touching for _, one in others])
    corners = np.array([box_corners(one.bounds) for _, one in mine])
    near = sharing(reach_box(joint, corners.reshape(-1, 3)), boxes)
    boxes = boxes[near]
    for posed_T_rest in (moved_by(joint, position) for position in stops if len(near)):
        turned = corners @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3]
        for part, one in (mine[k] for k in reaching(turned, boxes)):
            moved = one.moved(posed_T_rest)
            for other, shape in (others[near[k]] for k in meets(moved, boxes)):
                pair = (min(part, other), max(part, other))
                first, second = (moved, shape) if part < other else (shape, moved)
                known = found.get(pair, least)
                depth = -gap(first, second, known)[0]
                if depth > known:
                    found[pair] = depth
    return found


def _stops(ends: tuple[float, float], shares: Sequence[float]) -> list[float]:
    """Positions from end to end, and at these shares of the way to each."""
    near = [share * end for end in ends for share in shares]
    return sorted({0.0, *near, *np.linspace(*ends, _STOPS).tolist()})


def separated(asset: Asset, margin: float) -> Asset:
    """The asset with shapes pulled in on the sides where they meet another rigid body's at rest.

    Both of a pair give way alike, each by `margin` and a quarter of its extent at most. A pair that this does
    not part stays as it is: simulators have to exclude it.

    Args:
        asset: with collision shapes.
        margin: most that a shape loses on a side for one neighbour [m].
    """
    shapes = _shapes(asset.parts)
    for (one, i), (other, j) in _near(shapes, rigid_bodies(asset), CLEARANCE):
        first, second = shapes[one][i], shapes[other][j]
        apart, axis = gap(first, second)
        pulls = _pulls(first.shape, second.shape, axis, CLEARANCE - apart, margin)
        if pulls is not None:
            shapes[one][i] = convex(pulled_in(first.shape, axis, pulls[0]))
            shapes[other][j] = convex(pulled_in(second.shape, -axis, pulls[1]))
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


def _shapes(parts: Sequence[Part]) -> list[list[Convex]]:
    """The shapes of each part at rest."""
    return [[convex(shape) for shape in part.collision] for part in parts]


def _posed(shapes: Sequence[Sequence[Convex]], asset: Asset, positions: Positions) -> list[list[Convex]]:
    """Shapes of each part, moved to where the joints put them; those that stay are the same."""
    posed_T_rest = rest_to_posed(asset, positions)
    moves = [posed_T_rest[part.name] for part in asset.parts]
    return [
        list(row) if np.array_equal(move, np.eye(4)) else [c.moved(move) for c in row]
        for row, move in zip(shapes, moves, strict=True)
    ]


def _deepest(shapes: Sequence[Sequence[Convex]], bodies: IntArray) -> dict[Pair, float]:
    """How deep parts with different labels of (P,) `bodies` stand in each other [m], where they do."""
    found: dict[Pair, float] = {}
    for (one, i), (other, j) in _near(shapes, bodies, -TOLERANCE):
        known = found.get((one, other), TOLERANCE)
        depth = -gap(shapes[one][i], shapes[other][j], known)[0]
        if depth > known:
            found[one, other] = depth
    return found


def _named(asset: Asset, depths: Mapping[Pair, float]) -> tuple[Overlap, ...]:
    names = [part.name for part in asset.parts]
    return tuple(
        Overlap(names[one], names[other], max(0.0, depths[one, other])) for one, other in sorted(depths)
    )


def _near(
    shapes: Sequence[Sequence[Convex]], bodies: IntArray, reach: float
) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Pairs (part, shape) of different rigid bodies whose boxes are at most `reach` [m] apart."""
    owner = [(part, i) for part, row in enumerate(shapes) for i in range(len(row))]
    if not owner:
        return
    lower, upper = np.array([shapes[part][i].bounds for part, i in owner]).transpose(1, 2, 0)
    body = bodies[[part for part, _ in owner]]
    close = np.triu(body[:, None] != body)
    for axis in range(3):
        close &= lower[axis] <= (upper[axis] + reach)[:, None]
        close &= upper[axis] >= (lower[axis] - reach)[:, None]
    for first, second in np.argwhere(close).tolist():
        yield owner[first], owner[second]
