"""Made-up objects made plain, as models for simulators often are: few pieces, most of them boxes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, frozen_floats
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.triangles import areas

from ..shapes.primitives import between
from .generate.apart import apart
from .generate.objects import Body, GeneratedObject, Surface

# Solids shorter than a share of the object between these may be left out: all of the body's, and of what
# moves at most this share.
_SHORT, _OF_MOVING = (0.04, 0.5), 0.6
# A solid with so much of its box's surface may be the box: panels, boards and bars, and no shells.
_BOXY = (0.7, 1.4)
# How often there are such boxes, and how often the body is one.
_BOXES, _BLOCK = 0.75, 0.4


@dataclass(frozen=True, eq=False)
class _Solids:
    """The connected solids of an object.

    Attributes:
        owner: (F,) the solid of each face, body after body and surface after surface.
        body: (K,) of each.
        low, high: (K, 3) corners of their boxes.
        area: (K,).
        main: (K,) whether it is the largest of its body, without which nothing would be left of it.
    """

    owner: IntArray
    body: IntArray
    low: FloatArray
    high: FloatArray
    area: FloatArray
    main: BoolArray


def plain(made: GeneratedObject, generator: np.random.Generator) -> GeneratedObject:
    """The object without some of its little solids, others plain boxes, its body perhaps one block.

    Parts, their joints and the largest solid of each stay.
    """
    solids = _solids(made.bodies)
    gone = _left_out(solids, generator)
    boxed = _as_boxes(solids, generator)
    if generator.random() < _BLOCK:
        block = _block(solids)
        inside = np.all((solids.low >= solids.low[block]) & (solids.high <= solids.high[block]), axis=1)
        if not inside[solids.main & (solids.body > 0)].any() and not _pierced(solids, block):
            gone |= inside & (solids.body == 0)
            gone[block], boxed[block] = False, True
    return GeneratedObject(made.category, tuple(apart(_rebuilt(made.bodies, solids, gone, boxed & ~gone))))


def _solids(bodies: Sequence[Body]) -> _Solids:
    triangles = np.concatenate([body.triangles for body in bodies])
    mesh = Mesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    whose = np.repeat(np.arange(len(bodies)), [len(one.triangles) for one in bodies])
    # What two bodies share in the eyes of whoever finds segments is two solids.
    pairs = np.asarray(find_segments(mesh).face_segment, dtype=np.int64) * len(bodies) + whose
    solid, owner = np.unique(pairs, return_inverse=True)
    count, body = len(solid), solid % len(bodies)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, owner, triangles.min(axis=1))
    np.maximum.at(high, owner, triangles.max(axis=1))
    area = np.asarray(np.bincount(owner, areas(triangles), count), dtype=np.float64)
    main = np.zeros(count, dtype=np.bool_)
    for number in range(len(bodies)):
        own = np.flatnonzero(body == number)
        main[own[area[own].argmax()]] = True
    return _Solids(owner, body, low, high, area, main)


def _left_out(solids: _Solids, generator: np.random.Generator) -> BoolArray:
    """(K,) little solids that are no longer there."""
    long = (solids.high - solids.low).max(axis=1)
    whole = float((solids.high.max(axis=0) - solids.low.min(axis=0)).max())
    least = np.exp(generator.uniform(*np.log(_SHORT))) * whole
    shares = np.where(solids.body == 0, generator.random(2).max(), _OF_MOVING * generator.random())
    return np.asarray((long < least) & ~solids.main & (generator.random(len(long)) < shares))


def _as_boxes(solids: _Solids, generator: np.random.Generator) -> BoolArray:
    """(K,) solids of which only the box is left."""
    x, y, z = (solids.high - solids.low).T
    filled = solids.area / np.maximum(2 * (x * y + y * z + z * x), 1e-12)
    share = generator.random() if generator.random() < _BOXES else 0.0
    return np.asarray((filled > _BOXY[0]) & (filled < _BOXY[1]) & (generator.random(len(x)) < share))


def _block(solids: _Solids) -> int:
    """The largest solid of what stands still."""
    return int(np.flatnonzero(solids.main & (solids.body == 0))[0])


def _pierced(solids: _Solids, block: int) -> bool:
    """Whether the middle of anything that moves lies in the box of a solid."""
    middle = (solids.low + solids.high)[solids.body > 0] / 2
    return bool(np.all((middle > solids.low[block]) & (middle < solids.high[block]), axis=1).any())


def _rebuilt(bodies: Sequence[Body], solids: _Solids, gone: BoolArray, boxed: BoolArray) -> list[Body]:
    """The bodies without solids that are gone, and with the boxes of those that are boxed."""
    first, made = 0, []
    there = gone.copy()
    for body in bodies:
        surfaces = []
        for one in body.surfaces:
            own = solids.owner[first : first + len(one.triangles)]
            first += len(own)
            new = [k for k in np.unique(own).tolist() if boxed[k] and not there[k]]
            there[new] = True
            boxes = [between(solids.low[k], solids.high[k]) for k in new]
            triangles = np.concatenate([one.triangles[~(gone | boxed)[own]], *boxes])
            surfaces += [Surface(frozen_floats(triangles), one.look)] if len(triangles) else []
        made.append(replace(body, surfaces=tuple(surfaces)))
    return made
