"""Round things: wheels that stand on the ground, knobs close together, and buttons in collars."""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np

from simart_kit.arrays import FloatArray

from .caps import measure_cap, stacked_on
from .contact import Contacts, hanging_on, smallest_distance
from .movers import Mover
from .scene import FACINGS, Box, Scene

_ROUND = 0.03  # how far within the radius a corner still lies on the rim, as a share of it
_LARGEST_GAP = np.deg2rad(50.0)  # between corners of the rim: an octagon is a coarse wheel, a hexagon a nut
_TOGETHER = 4.2  # diameters from one knob to the next at most: those of drawers are farther apart
_LEVEL = 0.008  # of the object's diagonal, how far out of their plane the middles of knobs are at most
_EQUAL, _TURNED = 0.015, 0.08  # by how much extents of equal discs vary, and of coarse ones as they turn
_AXLE = 0.3  # of a wheel's radius: a fork is so near to both ends of its axle
_BESIDE = 0.05  # of its radius: what is nearer touches a wheel; nothing is to its rim
_CONCENTRIC = 0.05  # of its width, how far a cap's middle is from its collar's at most
_BUTTON = (0.008, 0.08)  # [m] width of a round button
_MUSHROOM = 0.12  # [m] the same of one over a hole in the body: for a whole hand
_SMALL = 0.1  # of the object's diagonal, such a one: the lid of a jar or a pot is wider
_HOLE = (0.85, 1.3)  # radius of that hole, in radii of the cap over it
_DEPTH = (0.1, 1.0)  # its depth, in widths of the cap: bottles are deeper
_OUTWARD = (FACINGS["front"][2], FACINGS["top"][2])  # where buttons over holes face
_NEAR = 1e-5  # a ray starts so far off a cap
_WAYS = 16  # in which the walls of a hole are felt


def round_axis(points: FloatArray) -> int | None:
    """Axis (0, 1, 2) about which (N, 3) points are a disc: a rim all around, and not a rod."""
    size = np.ptp(points, axis=0)
    center = (points.max(axis=0) + points.min(axis=0)) / 2
    for axis in np.argsort(size):
        across = np.delete(np.arange(3), axis)
        offset = (points - center)[:, across]
        radius = np.hypot(*offset.T)
        rim = offset[radius >= (1 - _ROUND) * radius.max()]
        angles = np.sort(np.arctan2(rim[:, 1], rim[:, 0]))
        gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
        if gaps.max() < _LARGEST_GAP and size[axis] < 1.2 * size[across].max():
            return int(axis)
    return None


def is_rod(points: FloatArray, axis: int) -> bool:
    """Whether (N, 3) points are of something round along an axis, however long: a disc when pressed flat."""
    size = np.ptp(points, axis=0)
    scale = np.ones(3)
    scale[axis] = 0.5 * np.delete(size, axis).min() / max(size[axis], 1e-30)
    return round_axis(points * scale) == axis


def wheels(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Discs with a level axis that stand on the ground, two of a size or one in a fork; with all within."""
    ground = scene.box.lower[2]
    found: list[tuple[int, float]] = []
    for piece, box in enumerate(scene.boxes):
        diameter = box.size[2]
        if piece in taken or not 0.02 < diameter < 0.6 or box.lower[2] > ground + 0.02:
            continue
        axis = round_axis(scene.points_of(piece))
        if axis in (0, 1) and box.size[axis] < 0.8 * diameter:
            found.append((piece, float(diameter)))
    movers: list[Mover] = []
    used: set[int] = set()
    for piece, diameter in found:
        alike = [p for p, d in found if abs(d - diameter) < 0.1 * diameter]
        if len(alike) >= 2 and piece not in used:
            pieces = (piece, *_inside(scene, contacts, piece))
            used.update(pieces)
            movers.append(Mover(pieces, "wheel", 0.7, (f"one of {len(alike)} discs alike on the ground",)))
        elif len(alike) == 1 and piece not in used:
            pieces = (piece, *_inside(scene, contacts, piece))
            used.update(pieces)
            if _forked(scene, contacts, pieces):
                reason = "a disc on the ground, held by its middle from both sides and free around it"
                movers.append(Mover(pieces, "wheel", 0.6, (reason,)))
    return movers


def _forked(scene: Scene, contacts: Contacts, wheel: Sequence[int]) -> bool:
    """Whether what reaches past its rim comes to both ends of a wheel's axle, and to no place on the rim."""
    box = scene.boxes[wheel[0]]
    axis, radius = int(box.size[:2].argmin()), float(box.size[2]) / 2
    beside = {p for own in wheel for p in contacts.touching(own, _BESIDE * radius)} - set(wheel)
    triangles = scene.triangles[np.isin(scene.labels, list(beside))]
    across = np.delete(triangles - box.center, axis, axis=2)
    if np.abs(across).max(initial=0.0) < radius:
        return False  # nothing, or a shaft on which it sits
    half = np.eye(3)[axis] * box.size[axis] / 2
    held = [smallest_distance((box.center + end)[None], triangles, radius) for end in (half, -half)]
    angles = 2 * np.pi * np.arange(_WAYS) / _WAYS
    around = np.column_stack([np.cos(angles), np.sin(angles)]) @ np.delete(np.eye(3), axis, axis=0)
    # Halfway through, since a fork's arms pass the rim on their way.
    free = smallest_distance(box.center + radius * around, triangles, radius)
    return max(held) < _AXLE * radius and free > _BESIDE * radius


def knobs(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Three or more small discs alike, close together on one front, that are nobody's handle."""
    found = [
        piece
        for piece, box in enumerate(scene.boxes)
        if piece not in taken and 0.008 < box.size.max() < 0.08 and round_axis(scene.points_of(piece)) == 1
    ]
    movers: list[Mover] = []
    used = set(taken).union(found)
    # Of polygons the extent depends on how they are turned: what is no row of equal ones may be one yet.
    rows = [group for group in _of_a_size(scene, found, _EQUAL) if _row(scene, group)]
    for piece in [piece for piece in found if not any(piece in group for group in rows)]:
        for group in rows:
            if _alike(scene, piece, group[0], _TURNED) and _row(scene, [*group, piece]):
                group.append(piece)
                break
    left = [piece for piece in found if not any(piece in group for group in rows)]
    rows += [group for group in _of_a_size(scene, left, _TURNED) if _row(scene, group)]
    for group in [group for group in rows if not any(_opposite(scene, group, other) for other in rows)]:
        reason = (f"one of {len(group)} discs alike, close together",)
        for piece in group:
            cap = measure_cap(scene, (piece,))
            on = stacked_on(scene, piece, cap, used) if cap is not None else ()
            used.update(on)
            movers.append(Mover((piece, *on), "knob", 0.5, reason))
    return movers


def _of_a_size(scene: Scene, discs: Sequence[int], slack: float) -> list[list[int]]:
    """Discs in one plane of one diameter, but for a share of it, the largest first."""
    groups: list[list[int]] = []
    for piece in sorted(discs, key=lambda piece: -scene.boxes[piece].size[2]):
        for group in groups:
            if _alike(scene, piece, group[0], slack):
                group.append(piece)
                break
        else:
            groups.append([piece])
    return groups


def _alike(scene: Scene, one: int, other: int, slack: float) -> bool:
    """Whether two discs lie in one plane and are of one diameter, but for a share of it."""
    box, its = scene.boxes[one], scene.boxes[other]
    small, large = sorted((box.size[2], its.size[2]))
    return bool(abs(its.center[1] - box.center[1]) < _LEVEL and small > (1 - slack) * large)


def _row(scene: Scene, group: Sequence[int]) -> bool:
    """Whether discs alike are three at least, next to each other, and not far apart."""
    places = np.array([scene.boxes[piece].center[[0, 2]] for piece in group])
    apart = np.linalg.norm(places[:, None] - places, axis=2) + np.diag([np.inf] * len(group))
    near, diameter = apart.min(axis=1), scene.boxes[group[0]].size[2]
    return len(group) >= 3 and not (near < diameter).any() and not (near > _TOGETHER * diameter).any()


def _opposite(scene: Scene, group: Sequence[int], other: Sequence[int]) -> bool:
    """Whether another row mirrors this one: what is turned is on one side, buttons of cuffs on two."""
    if len(group) != len(other) or group is other:
        return False
    mine, others = (np.array([scene.boxes[i].center for i in row]) for row in (group, other))
    middle, apart = scene.box.center[1], np.linalg.norm(np.ptp(mine, axis=0))
    across = (mine[:, 1].mean() - middle) * (others[:, 1].mean() - middle) < 0
    return bool(across and np.linalg.norm((mine.mean(axis=0) - others.mean(axis=0))[[0, 2]]) < apart)


def collared(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Plain round caps that stand in a collar of their own, on a front or on top: buttons."""
    body = int(scene.areas.argmax())
    sizes = np.array([box.size.max() * scene.size for box in scene.boxes])
    able = np.flatnonzero((sizes > _BUTTON[0]) & (sizes < 1.6 * _BUTTON[1]))
    able = able[[piece not in taken and piece != body for piece in able]]
    centers = np.array([box.center for box in scene.boxes])
    reason = ("a plain round cap in a collar of its own",)
    movers = []
    for piece in able[sizes[able] < _BUTTON[1]]:
        wide = float(scene.boxes[piece].size.max())
        beside = np.sort(np.abs(centers[able] - centers[piece]), axis=1)
        near = able[(beside[:, 1] < _CONCENTRIC * wide) & (beside[:, 2] < wide) & (able != piece)]
        if any(_is_collar(scene, int(other), int(piece)) for other in near):
            movers.append(Mover((int(piece),), "button", 0.6, reason))
    return movers


def over_holes(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Plain round caps over a hole in the body, to the front or upward: buttons, which go down in it."""
    body = int(scene.areas.argmax())
    reason = ("a small round cap over a hole in the body",)
    movers = []
    for piece, box in enumerate(scene.boxes):
        wide = float(box.size.max())
        able = wide < _SMALL and _BUTTON[0] < wide * scene.size < _MUSHROOM
        if piece in taken or piece == body or not able:
            continue
        axis = round_axis(scene.points_of(piece))
        if any(_covers_hole(scene, box, way, body) for way in _OUTWARD if axis in np.flatnonzero(way)):
            movers.append(Mover((piece,), "button", 0.6, reason))
    return movers


def _covers_hole(scene: Scene, cap: Box, outward: FloatArray, body: int) -> bool:
    """Whether the body leaves room behind a round cap, between walls about as far apart as it is wide."""
    across = np.eye(3)[np.abs(outward) < 0.5]
    radius, thick = float((across @ cap.size).max()) / 2, float(np.abs(outward) @ cap.size)
    foot = cap.center - (thick / 2 + _NEAR) * outward
    floor, deep = scene.rays.first(foot[None], -outward)
    if floor[0] < 0 or scene.labels[floor[0]] != body or not _DEPTH[0] < deep[0] / (2 * radius) < _DEPTH[1]:
        return False
    angles = 2 * np.pi * np.arange(_WAYS) / _WAYS
    start = foot - deep[0] / 2 * outward
    for way in np.column_stack([np.cos(angles), np.sin(angles)]) @ across:
        wall, off = scene.rays.first(start[None], way)
        if not _HOLE[0] * radius < off[0] < _HOLE[1] * radius or scene.labels[wall[0]] != body:
            return False
    return True


def _is_collar(scene: Scene, other: int, piece: int) -> bool:
    """Whether a thinner disc lies around a round cap that stands out of it, to the front or upward."""
    axis = round_axis(scene.points_of(piece))
    if axis not in (1, 2) or axis != round_axis(scene.points_of(other)):
        return False
    collar, cap = scene.boxes[other], scene.boxes[piece]
    ratio = np.delete(collar.size, axis).max() / np.delete(cap.size, axis).max()
    passes = collar.lower[axis] > cap.lower[axis] and collar.upper[axis] < cap.upper[axis]
    return bool(1.02 < ratio < 1.5 and passes and collar.size[axis] < 0.5 * cap.size[axis])


def _inside(scene: Scene, contacts: Contacts, wheel: int) -> list[int]:
    """Pieces within a wheel's own box that hang together with it: hub, spokes, bolts."""
    outer = scene.boxes[wheel]
    able = [
        i
        for i, box in enumerate(scene.boxes)
        if (box.lower >= outer.lower - 0.01).all() and (box.upper <= outer.upper + 0.01).all()
    ]
    held = hanging_on({wheel}, able, lambda one, other: contacts.within(one, other, 0.01))
    return sorted(held - {wheel})
