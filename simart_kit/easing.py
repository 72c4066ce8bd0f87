"""Collision shapes that let parts begin to move: what interlocks with a neighbour's gives way.

Shapes of neighbours that are apart at rest may still be in each other's way, where the surface between them
winds or the shapes are coarser. Solvers do not slide over that: a drawer stays shut.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from .arrays import FloatArray
from .asset import Asset, Joint
from .bounds import box_corners, sharing
from .clipping import extent, pulled_in
from .convex_overlap import Convex, convex, gap, gap_across, meets
from .kinematics import carried, moved_by, reach_box, span
from .separation import CLEARANCE, TOLERANCE, overlaps, overlaps_on_the_way, replaced, rigid_bodies

_STEPS = 0.0005 * 2.0 ** np.arange(8)  # [m] that a part has moved at its farthest
_MOST_OF_SHAPE = 0.35  # of its extent that a shape may lose at once
_MOST = 0.015  # of the object's diagonal that it may: a skin's borders wind by as much

WORK = 4000
"""Pairs of shapes whose boxes meet that may be looked at in all: what bounds the time."""

Shapes = dict[str, list[Convex]]  # by name of the part


def eased(asset: Asset, work: int = WORK) -> Asset:
    """The asset with shapes that begin their joint's way without those of neighbours, which give way as much.

    Pairs that exporters exclude stay as they are: what overlaps at rest, or meets on the way however that
    begins. Parted at rest alone, they would stop each other a little later.

    Args:
        asset: with collision shapes.
        work: see `WORK`; joints that come later stay as they are.
    """
    shapes: Shapes = {part.name: [convex(shape) for shape in part.collision] for part in asset.parts}
    met = (*overlaps(asset), *overlaps_on_the_way(asset))
    excluded = {frozenset((pair.one, pair.other)) for pair in met}
    for joint in asset.joints:
        if joint.kind in ("revolute", "continuous", "prismatic") and span(joint) != (0.0, 0.0):
            work -= _ease(shapes, joint, _others(asset, joint, excluded), _MOST * asset.mesh.diagonal, work)
    changed = {
        part.name: tuple(one.shape for one in shapes[part.name])
        for part in asset.parts
        if any(one.shape is not shape for one, shape in zip(shapes[part.name], part.collision, strict=True))
    }
    return replaced(asset, changed) if changed else asset


def _ease(shapes: Shapes, joint: Joint, others: Mapping[str, Sequence[str]], most: float, work: int) -> int:
    """Change shapes that a joint moves, and of other parts those that these begin their way in.

    Returns the work done, at least one.
    """
    spent, boxes = 1, _within_reach(shapes, joint, others)
    for position in _positions(joint, [one for name in others for one in shapes[name]]):
        posed_T_rest = moved_by(joint, position)
        for name, i in [(part, i) for part in others for i in range(len(shapes[part]))]:
            if spent >= work:
                return spent
            moved = shapes[name][i].moved(posed_T_rest)
            reached = (part for part in others[name] if part in boxes)
            near = [(part, k) for part in reached for k in meets(moved, boxes[part]).tolist()]
            spent += len(near)
            for other, k in [o for o in near if -gap(moved, shapes[o[0]][o[1]], TOLERANCE)[0] > TOLERANCE]:
                pulls = _pulls(joint, position, moved, shapes[other][k], most)
                if pulls is not None:
                    axis, mine, its = pulls
                    own = pulled_in(shapes[name][i].shape, axis @ posed_T_rest[:3, :3], mine)
                    shapes[name][i], moved = convex(own), convex(own).moved(posed_T_rest)
                    shapes[other][k] = convex(pulled_in(shapes[other][k].shape, -axis, its))
                    boxes[other][k] = shapes[other][k].bounds
    return spent


def _within_reach(shapes: Shapes, joint: Joint, others: Mapping[str, Sequence[str]]) -> dict[str, FloatArray]:
    """(N, 2, 3) boxes around the shapes of each of the others that a joint may take its own to."""
    mine = [box_corners(one.bounds) for name in others for one in shapes[name]]
    reach = reach_box(joint, np.concatenate(mine)) if mine else np.zeros((2, 3))
    names = {other for row in others.values() for other in row}
    boxes = {name: np.array([one.bounds for one in shapes[name]]).reshape(-1, 2, 3) for name in names}
    return {name: box for name, box in boxes.items() if len(sharing(reach, box))}


def _others(asset: Asset, joint: Joint, excluded: Collection[frozenset[str]]) -> dict[str, list[str]]:
    """For each part that a joint moves, those that it does not move and that its way is not excluded with."""
    bodies = rigid_bodies(asset)
    names = carried(asset, joint.child)
    mine = [part.name for part in asset.parts if part.name in names]
    moved = {int(bodies[asset.part_index(name)]) for name in mine}
    still = [part.name for part, body in zip(asset.parts, bodies, strict=True) if int(body) not in moved]
    return {name: [other for other in still if frozenset((name, other)) not in excluded] for name in mine}


def _positions(joint: Joint, own: Sequence[Convex]) -> list[float]:
    """Of a joint that moves shapes [rad | m]: the first steps to both sides, within its limits."""
    points = np.concatenate([one.shape.vertices for one in own]) - np.array(joint.origin)
    reach = (
        float(np.linalg.norm(np.cross(points, np.array(joint.axis)), axis=1).max()) if joint.turns else 1.0
    )
    lower, upper = span(joint)
    steps = [float(step) for step in _STEPS / max(reach, 1e-6)]
    return [step for step in steps if step <= upper] + [-step for step in steps if -step >= lower]


def _pulls(
    joint: Joint, position: float, moved: Convex, other: Convex, most: float
) -> tuple[FloatArray, float, float] | None:
    """The axis across the way along which two shapes give way, and how far each; None where it is too far."""
    way = _way(joint, position, moved, other)
    apart, axis = gap_across(moved, other, way)
    lacking = CLEARANCE - apart
    limits = [min(most, _MOST_OF_SHAPE * extent(one.shape, axis)) for one in (moved, other)]
    if lacking <= 0 or lacking > sum(limits):
        return None
    mine = min(max(lacking / 2, lacking - limits[1]), limits[0])
    return axis, mine, lacking - mine


def _way(joint: Joint, position: float, moved: Convex, other: Convex) -> FloatArray:
    """(3,) unit way that a joint moves the middle of what two shapes share."""
    axis = np.array(joint.axis)
    if joint.turns:
        lower = np.maximum(moved.bounds[0], other.bounds[0])
        upper = np.minimum(moved.bounds[1], other.bounds[1])
        axis = np.cross(axis, (lower + upper) / 2 - np.array(joint.origin))
    return np.asarray(np.sign(position) * axis / max(float(np.linalg.norm(axis)), 1e-12))
