"""Doors, lids and screens that stand open: panels that, turned about an edge, fit what they would close."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, unit
from simart_kit.kinematics import rotation, turned_about
from simart_kit.sweeping import Sweep

from .candidates import AS_FREE, Candidate, Choice
from .casting import first_met
from .contact import TOUCH, Contacts, hanging_on
from .extents import extent_without
from .movers import SHALLOWEST, Mover
from .scene import Scene
from .views import View

# All lengths are shares of the object's diagonal.
_SMALLEST = 0.1  # what is less wide or long fits too many places
_FLAT = 0.6  # share of the surface along one plane, of a panel
_THIN = 0.3  # thickness of a panel, as a share of its width and length
_OUTLIERS = 0.005  # share of the surface at either end that an extent leaves out: handles, screws
_ALONG = 0.05  # cosine up to which a plane runs along an axis: 3 degrees
_LEAST_OPEN, _MOST_OPEN = np.deg2rad(30.0), np.deg2rad(150.0)  # panels of a row lie at 180 degrees
_SAME = 0.15  # share of its extent by which a panel may differ from what it closes: a wall, or a gap
_TWO_FACED = 0.25  # share of its surface that each face of a board has
_FLUSH = 0.1  # share of its extent by which one goes on farther that is flush with a wall
_PLATE = 0.08  # the same of two plates of one size
_OPEN = 0.8  # share of rays that pass through an opening
_FREE = 0.03  # so near its far half nothing stands: else it is a wall
_ALMOST_CLOSED = 0.9  # of the way to closed: what is nearer touches what it closes, as seals do
_CUTS = 2.0  # a leaf that cuts so many times as much into what it closes from its middle hangs at its face
_SLAB = 0.25  # thickness of the other half of a clamshell, as a share of its width and length


@dataclass(frozen=True, eq=False)
class Leaf:
    """A panel and the edge about which it stands open, in the aligned frame.

    Attributes:
        axis: (3,) unit along the edge; positive opens further.
        hinge: (3,) middle of the edge.
        far: (3,) unit from the edge to the panel's other end.
        closed: (3,) unit from the edge to where that end would lie when closed.
        outward: (3,) unit to which it opens.
        sizes: (2,) along the edge and from it.
        thickness: of the panel.
        angle: by which it stands open [rad].
        plate: whether what it closes is a plate, not an opening.
    """

    axis: FloatArray
    hinge: FloatArray
    far: FloatArray
    closed: FloatArray
    outward: FloatArray
    sizes: FloatArray
    thickness: float
    angle: float
    plate: bool = False


def open_leaves(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Panels that stand open, each with what sits on it."""
    found: list[tuple[Leaf, Mover]] = []
    for piece, box in enumerate(scene.boxes):
        if piece in taken or np.sort(box.size)[1] < _SMALLEST:
            continue
        faces = scene.faces_of((piece,))
        if next(_possible(scene, faces), None) is None:
            continue  # no panel: what touches it need not be known
        pieces = (piece, *_mates(scene, contacts, piece, taken))
        leaf = standing_open(scene, faces, np.array(pieces))
        if leaf is not None:
            told = f"stands open by {np.degrees(leaf.angle):.0f} degrees, and fits what it would close"
            label = "door" if abs(leaf.axis[2]) > 0.5 else "lid"
            found.append((leaf, Mover(pieces, label, 0.7, (told,))))
    # Of two plates that close each other, as those of a laptop, the one that stands up moves.
    found.sort(key=lambda item: -(item[0].hinge + item[0].far * item[0].sizes[1])[2])
    plates = [item for item in found if item[0].plate]
    return [mover for leaf, mover in found if not leaf.plate or leaf is plates[0][0]]


def opened(scene: Scene, view: View) -> Choice | None:
    """The edge about which a part stands open, or None where it does not."""
    leaf = standing_open(scene, scene.faces_of((view.part,)), np.array([view.part]))
    if leaf is None:
        return None
    axes, line = view.axes, _free_to_close(scene, view.part, leaf)
    hinge = Candidate("revolute", axes @ leaf.axis, axes @ line, np.pi / 2, closed=-leaf.angle)
    return hinge, 0.8, (f"stands open by {np.degrees(leaf.angle):.0f} degrees about this edge",)


def _free_to_close(scene: Scene, part: int, leaf: Leaf) -> FloatArray:
    """(3,) middle of the edge; at the inner face where a leaf hung in its middle cuts into what it closes."""
    inner = -leaf.outward @ rotation(leaf.axis * leaf.angle).T
    mine = scene.labels == part
    sweep = Sweep(scene.vertices, scene.faces[mine], scene.faces[~mine])
    stops = -_ALMOST_CLOSED * leaf.angle * np.linspace(0.05, 1.0, 20)
    lines = (leaf.hinge, leaf.hinge + 0.5 * leaf.thickness * inner)
    in_middle, at_face = (
        float(sweep.blocked(partial(turned_about, leaf.axis, line), stops)[-1]) for line in lines
    )
    return lines[1] if in_middle > _CUTS * at_face + AS_FREE else lines[0]


def standing_open(scene: Scene, panel: IntArray, own: IntArray) -> Leaf | None:
    """How a panel stands open, or None.

    Args:
        scene: the pieces.
        panel: (N,) faces of the panel.
        own: pieces that move with it.
    """
    for leaf in _possible(scene, panel):
        plate = _closes_plate(scene, leaf, own)
        if (plate or _closes_opening(scene, leaf, own)) and _stands_free(scene, leaf, own):
            return replace(leaf, plate=plate)
    return None


def _possible(scene: Scene, panel: IntArray) -> Iterator[Leaf]:
    """Every edge of a panel that runs along an axis, with the planes in which it could be closed."""
    areas, normals = scene.face_areas[panel], scene.normals[panel]
    spread, directions = np.linalg.eigh(normals.T @ (areas[:, None] * normals))
    normal = directions[:, 2]
    if spread[2] < _FLAT * spread.sum():
        return
    flat = np.abs(normals @ normal) > 0.9
    if not flat.any():
        return
    points = scene.triangles[panel[flat]].reshape(-1, 3)
    weights = np.repeat(areas[flat], 3)
    side = np.repeat(normals[flat] @ normal > 0, 3)
    thickness = extent_without(_OUTLIERS, points @ normal, weights)
    for axis in np.eye(3)[np.abs(normal) < _ALONG]:
        across = np.cross(axis, normal)
        for along, length in _outlines(points @ np.column_stack([axis, across]), weights, side):
            sizes = np.array([np.ptp(along), np.ptp(length)])
            if sizes.min() < _SMALLEST or np.ptp(thickness) > _THIN * sizes.min():
                continue
            middle = along.mean() * axis + thickness.mean() * normal
            for end, far in ((length[0], across), (length[1], -across)):
                yield from _hung(axis, middle + end * across, far, sizes, float(np.ptp(thickness)))


def _hung(
    axis: FloatArray, hinge: FloatArray, far: FloatArray, sizes: FloatArray, thick: float
) -> Iterator[Leaf]:
    """A panel that hangs on an edge, with each plane in which it could be closed."""
    for closed in np.concatenate([np.eye(3), -np.eye(3)]):
        angle = float(np.arccos(np.clip(far @ closed, -1, 1)))
        if abs(closed @ axis) > 0.5 or not _LEAST_OPEN <= angle <= _MOST_OPEN:
            continue
        outward = unit(far - (far @ closed) * closed)
        yield Leaf(np.cross(closed, outward), hinge, far, closed, outward, sizes, thick, angle)


def _closes_plate(scene: Scene, leaf: Leaf, own: IntArray) -> bool:
    """Whether all the rest is a plate of the panel's size that begins at its edge, as of a laptop."""
    slack, half = _PLATE * leaf.sizes, leaf.sizes[0] / 2
    others = ~np.isin(np.arange(scene.count), own)
    if not others.any():
        return False
    # `closed` is an axis of the frame: along it boxes end as what is in them does, which rules most out.
    along = (scene.bounds[others] - leaf.hinge) @ leaf.closed
    near = slack[1] + leaf.thickness
    if not (abs(along.min()) < near and abs(along.max() - leaf.sizes[1]) < near):
        return False
    used = np.zeros(len(scene.vertices), dtype=np.bool_)
    used[scene.faces[others[scene.labels]]] = True
    rest = scene.vertices[used] - leaf.hinge
    across, out = rest @ leaf.axis, rest @ leaf.outward
    return bool(
        abs(across.min() + half) < slack[0]
        and abs(across.max() - half) < slack[0]
        and np.ptp(out) < _SLAB * leaf.sizes.min()
        and out.max() < 0.5 * _SLAB * leaf.sizes.min()
    )


def _closes_opening(scene: Scene, leaf: Leaf, own: IntArray) -> bool:
    """Whether the panel, closed, would lie before an opening of its size."""
    middle = leaf.hinge + 0.5 * leaf.sizes[1] * leaf.closed
    steps = np.stack(np.meshgrid(np.linspace(-0.4, 0.4, 6), np.linspace(-0.4, 0.4, 6)), axis=-1).reshape(
        -1, 2
    )
    grid = middle + (steps * leaf.sizes) @ np.stack([leaf.axis, leaf.closed])
    before = grid + (leaf.thickness + 0.01) * leaf.outward
    inward, outward = (first_met(scene, before, sign * leaf.outward, own)[1] for sign in (-1.0, 1.0))
    # Nothing stands before an opening that faces out: so it is told from compartments within.
    if np.isinf(outward).mean() < _OPEN:
        return False
    if (inward > leaf.thickness + 0.01 + SHALLOWEST).mean() < _OPEN:
        return False
    return any(
        _walled(scene, leaf, middle - depth * leaf.outward, own)
        for depth in (0.5 * leaf.thickness + 0.003, leaf.thickness + 0.02)
    )


def _walled(scene: Scene, leaf: Leaf, middle: FloatArray, own: IntArray) -> bool:
    """Whether walls stand about a point where the panel ends, or where a second one beside it would.

    On the ground there may be none below.
    """
    for direction, half, across in (
        (leaf.axis, leaf.sizes[0] / 2, leaf.closed * leaf.sizes[1]),
        (-leaf.axis, leaf.sizes[0] / 2, leaf.closed * leaf.sizes[1]),
        (leaf.closed, leaf.sizes[1] / 2, leaf.axis * leaf.sizes[0]),
        (-leaf.closed, leaf.sizes[1] / 2, leaf.axis * leaf.sizes[0]),
    ):
        starts = middle + np.linspace(-0.3, 0.3, 5)[:, None] * across
        way = float(np.median(first_met(scene, starts, direction, own)[1]))
        if abs(way - half) < _SAME * half:
            continue
        if direction is leaf.closed and abs(way - 3 * half) < 2 * _SAME * half:
            continue
        bottom = middle[2] + half * direction[2]
        if direction[2] > -0.5 or bottom > scene.box.lower[2] + 0.02:
            return False
    return True


def _stands_free(scene: Scene, leaf: Leaf, own: IntArray) -> bool:
    """Whether nothing stands close beside the panel's far half, nor at its end."""
    end = leaf.hinge + leaf.sizes[1] * leaf.far
    spread = np.linspace(-0.4, 0.4, 5)[:, None] * leaf.axis * leaf.sizes[0]
    starts = [(end + spread - TOUCH * leaf.far, leaf.far)]
    beside = leaf.hinge + np.linspace(0.5, 0.9, 5)[:, None] * leaf.far * leaf.sizes[1]
    for sign in (1.0, -1.0):
        edge = sign * (leaf.sizes[0] / 2 - TOUCH) * leaf.axis
        starts.append((beside + edge, sign * leaf.axis))
    return all((first_met(scene, start, way, own)[1] > _FREE).mean() > 0.5 for start, way in starts)


def _mates(scene: Scene, contacts: Contacts, piece: int, taken: Set[int]) -> list[int]:
    """Small pieces that touch a panel, or what touches it, and have nothing to do with the rest."""
    panel = scene.boxes[piece]
    near = [
        i
        for i, box in enumerate(scene.boxes)
        if i != piece
        and i not in taken
        and scene.areas[i] < 0.25 * scene.areas[piece]
        and (box.lower >= panel.lower - 0.05).all()
        and (box.upper <= panel.upper + 0.05).all()
    ]
    on = hanging_on({piece}, near, lambda i, j: contacts.within(i, j, TOUCH))
    return [i for i in near if i in on]


def _outlines(places: FloatArray, weights: FloatArray, side: BoolArray) -> Iterator[tuple[FloatArray, ...]]:
    """Extents of a panel along two directions, (2,) each; and of what both its faces cover, if that is less.

    A face that goes on farther than the other is flush with a wall, and of it as well.

    Args:
        places: (N, 2) of points along the directions.
        weights: (N,) of them.
        side: (N,) which face each is on.
    """
    whole = _box(places, weights)
    yield tuple(whole)
    if _TWO_FACED < weights[side].sum() / weights.sum() < 1 - _TWO_FACED:
        ends = np.stack([_box(places[on], weights[on]) for on in (side, ~side)])
        both = np.column_stack([ends[..., 0].max(axis=0), ends[..., 1].min(axis=0)])
        if (np.ptp(whole, axis=1) - np.ptp(both, axis=1) > _FLUSH * np.ptp(whole, axis=1)).any():
            yield tuple(both)


def _box(places: FloatArray, weights: FloatArray) -> FloatArray:
    """(2, 2) lower and upper end of (N, 2) points along each direction."""
    return np.array([extent_without(_OUTLIERS, column, weights) for column in places.T])
