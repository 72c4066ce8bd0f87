"""Made-up objects as what the network is given and should say."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.triangles import areas, unit_normals

from .cloud import Cloud, sample_evenly, sample_pieces
from .generate.objects import GeneratedObject
from .part_lines import part_lines
from .plainer import plain
from .scene import Pieces, pieces_of
from .superfaces import superfaces
from .truth import KINDS, PartTruth, majority, right_candidates
from .varying import fused, joined, placed
from .visibility import visible

# Points of a cloud, about; pieces of a cloud at most, of solids and of skins.
POINTS, MOST_PIECES, SUPERFACES = 1536, 160, 192
# How often an object is made plain, and a solid one has lost its inside, has bodies of one piece each, or
# pieces fused and split.
_PLAIN, _HOLLOW, _JOINED, _MIXED = 0.4, 0.25, 0.25, 0.4
_NOISE = 0.002


@dataclass(frozen=True, eq=False)
class MovingPart:
    """A part with its candidates.

    Attributes:
        truth: what is right.
        numbers: (C, K) evidence of its candidates.
    """

    truth: PartTruth
    numbers: FloatArray


@dataclass(frozen=True, eq=False)
class Example:
    """An object to learn from.

    Attributes:
        cloud: what is seen of it.
        pieces: numbers of its pieces.
        part: (S,) part of every piece; 0 is the body.
        shown: (P,) whether the part has pieces of its own; only those are asked for.
        parts: all parts but the body, P - 1 of them; None for those not shown.
        category: its name.
        size: longest side [m].
    """

    cloud: Cloud
    pieces: Pieces
    part: IntArray
    shown: BoolArray
    parts: tuple[MovingPart | None, ...]
    category: str
    size: float


def example(made: GeneratedObject, generator: np.random.Generator, skin_share: float) -> Example:
    """An example of an object, in a pose and look that the generator chooses.

    Args:
        made: the object.
        generator: of the choices.
        skin_share: how often the object is one skin.
    """
    seen, size = seen_somehow(made, generator)
    cloud, label = _cloud(seen, generator, skin_share)
    part = majority(label, cloud.piece, cloud.area, len(made.bodies), cloud.count)
    return example_of(seen, cloud, part, size)


def seen_somehow(made: GeneratedObject, generator: np.random.Generator) -> tuple[GeneratedObject, float]:
    """The object in some pose and at a size of 1, some made plain; and how long it is [m]."""
    corners = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3)
    size = float(np.ptp(corners, axis=0).max())
    return placed(plain(made, generator) if generator.random() < _PLAIN else made, generator), size


def example_of(seen: GeneratedObject, cloud: Cloud, part: IntArray, size: float) -> Example:
    """The example that a cloud of a placed object is.

    Args:
        seen: the object.
        cloud: of it, in its frame.
        part: (S,) body of each piece.
        size: longest side [m].
    """
    shown = np.bincount(part, minlength=len(seen.bodies)) > 0
    parts = [_part(seen, number, cloud, part) if shown[number] else None for number in range(1, len(shown))]
    return Example(cloud, pieces_of(cloud), part, shown, tuple(parts), seen.category, size)


def _cloud(
    made: GeneratedObject, generator: np.random.Generator, skin_share: float
) -> tuple[Cloud, IntArray]:
    """The cloud of a placed object, and (N,) the body of each point."""
    triangles = np.concatenate([body.triangles for body in made.bodies])
    looks = [(surface, n) for n, body in enumerate(made.bodies) for surface in body.surfaces]
    counts = [len(surface.triangles) for surface, _ in looks]
    body = np.repeat([n for _, n in looks], counts)
    color = np.repeat([surface.look.color for surface, _ in looks], counts, axis=0) / 255
    skin = generator.random() < skin_share
    if skin:
        samples = sample_evenly(areas(triangles), 3 * POINTS, generator)
    else:
        mesh = Mesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
        piece = np.minimum(find_segments(mesh).face_segment, MOST_PIECES - 1)
        samples = sample_pieces(areas(triangles), piece, POINTS, generator)
    points = np.einsum("nk,nkx->nx", samples.weights, triangles[samples.face])
    kept = np.ones(len(points), dtype=np.bool_)
    if skin or generator.random() < _HOLLOW:
        found = visible(points, triangles)
        kept = found if found.sum() > 64 else kept
    face, points, area = samples.face[kept], points[kept], samples.area[kept]
    normals = unit_normals(triangles[face]) * np.where(generator.random() < 0.2, -1.0, 1.0)
    colors = color[face] if generator.random() < 0.8 else np.full((len(face), 3), 0.5)
    if skin:
        normals = normals + generator.normal(0, 0.08, normals.shape)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        count = int(generator.integers(SUPERFACES // 2, SUPERFACES + 1))
        owner, _ = superfaces(points, normals, colors, count, generator)
    else:
        owner = np.unique(piece[face], return_inverse=True)[1].reshape(-1)
        owner = joined(owner, body[face], generator) if generator.random() < _JOINED else owner
        owner = fused(owner, points, generator) if generator.random() < _MIXED else owner
    if len(points) > 2 * POINTS:
        owner, chosen = _thinned(owner, generator)
        face, points, area, normals, colors = (
            face[chosen],
            points[chosen],
            area[chosen],
            normals[chosen],
            colors[chosen],
        )
    points = points + generator.normal(0, _NOISE * generator.random(), points.shape)
    cloud = Cloud(points, normals, colors, owner, area / area.sum(), int(owner.max()) + 1)
    return cloud, body[face]


def _thinned(owner: IntArray, generator: np.random.Generator) -> tuple[IntArray, IntArray]:
    """Half of the points, at least one of each piece: (M,) their pieces and (M,) their places."""
    chosen = np.sort(generator.permutation(len(owner))[: len(owner) // 2])
    first = np.unique(owner, return_index=True)[1]
    chosen = np.union1d(chosen, first)
    return owner[chosen], chosen


def _part(made: GeneratedObject, number: int, cloud: Cloud, part: IntArray) -> MovingPart | None:
    """The part of this number as its pieces show it; None where too little is seen of it."""
    motion = made.bodies[number].motion
    inside = part[cloud.piece] == number
    if motion is None or inside.sum() < 4 or inside.all():
        return None
    lines = part_lines(cloud, inside)
    right = right_candidates(lines.found, motion)
    body = made.bodies[number]
    limits = np.array([motion.lower, motion.upper])
    truth = PartTruth(KINDS.index(motion.kind), right, limits, body.parent, body.label)
    return MovingPart(truth, lines.evidence())
