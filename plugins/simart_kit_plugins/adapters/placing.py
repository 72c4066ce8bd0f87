"""Bringing what another system wrote to the place of the mesh: it turned and scaled its input as it liked."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import permutations, product
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import BadInputError
from simart_kit.arrays import FloatArray, frozen_ints
from simart_kit.bench.articulation import Articulation, Link
from simart_kit.bench.frame import same_faces
from simart_kit.mesh import UpAxis, z_up_from

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.bench.sampling import Samples

UP_AXES: tuple[UpAxis, ...] = ("+y", "+z", "-y", "-z", "+x", "-x")
"""In the order of how common they are."""
_SAME_BOX = 0.02  # of the longest side: how much boxes may differ
_OFF = 0.01  # of the longest side: how far apart surfaces of one object may lie, in the mean
_AS_GOOD = 1.1, 1e-4  # a way as good as the best but for this factor and share of the size is taken first
_POINTS, _SAMPLES, _NEAREST = 1500, 20_000, 8


@dataclass(frozen=True, eq=False)
class Placed:
    """An object where the mesh is.

    Attributes:
        object: in the mesh's frame.
        way: how it came there, a phrase.
    """

    object: Articulation
    way: str


def bare(mesh: Mesh) -> Articulation:
    """A mesh as an object of one part."""
    labels = frozen_ints(np.zeros(len(mesh.faces)))
    return Articulation("mesh", mesh.vertices, mesh.faces, labels, (Link("body"),))


def placed(found: Articulation, mesh: Mesh, up: UpAxis | None = None, likely: UpAxis = "+y") -> Placed:
    """An object in the frame of the mesh, which shows the same shape in another size and place.

    Args:
        found: in a frame of its own.
        mesh: in the canonical frame.
        up: axis that points up in that frame; None finds out: one of the usual ways to turn up axes, else any
            turn by right angles, whichever lays the surfaces nearest to each other.
        likely: of ways that are as good, this axis is taken.

    Raises:
        BadInputError: no way lays them onto each other.
    """
    axes = dict.fromkeys((likely, *UP_AXES)) if up is None else (up,)
    turns = [(axis, z_up_from(axis)) for axis in axes]
    ways = [Placed(_fitted(found, turn, mesh), f"its up axis is {axis}") for axis, turn in turns]
    try:
        return best_of(ways, mesh)
    except BadInputError:
        if up is not None:
            raise
    others = (_fitted(found, turn, mesh) for turn in _right_angles())
    return best_of([Placed(other, "turned by right angles") for other in others], mesh)


def placed_by_up(read: Callable[[UpAxis], Articulation], mesh: Mesh, up: UpAxis | None) -> Placed:
    """As `placed`, for files that are read in a way that depends on the up axis of their source.

    Args:
        read: gives the object in the frame of the mesh, were this the axis.
        mesh: in the canonical frame.
        up: the axis; None finds out.

    Raises:
        BadInputError: no way lays them onto each other.
    """
    axes = UP_AXES if up is None else (up,)
    return best_of([Placed(read(axis), f"the up axis of its source is {axis}") for axis in axes], mesh)


def best_of(ways: list[Placed], mesh: Mesh) -> Placed:
    """The first of several ways that lays an object onto the mesh, or nearly as near as the best does.

    Raises:
        BadInputError: none does.
    """
    here, size = bare(mesh), _longest(mesh.bounds)
    boxes = [float(np.abs(way.object.bounds - mesh.bounds).max()) / size for way in ways]
    near = [way for way, box in zip(ways, boxes, strict=True) if box <= _SAME_BOX]
    for way in near:
        if same_faces(here, way.object) is not None:
            return way
    if not near:
        raise BadInputError(f"it is not of this mesh: its box differs by {min(boxes):.2g} of the size")
    apart = [_apart(way.object, mesh) / size for way in near]
    if min(apart) > _OFF:
        raise BadInputError(f"it is not of this mesh: their surfaces lie {min(apart):.2g} of the size apart")
    factor, share = _AS_GOOD
    return next(way for way, a in zip(near, apart, strict=True) if a <= factor * min(apart) + share)


def _fitted(found: Articulation, turn: FloatArray, mesh: Mesh) -> Articulation:
    """The object turned by a (3, 3) rotation, with the centre and the longest side of the mesh."""
    matrix = np.eye(4)
    corners = found.bounds @ turn.T
    bounds = np.array([corners.min(axis=0), corners.max(axis=0)])
    scale = _longest(mesh.bounds) / _longest(bounds)
    matrix[:3, :3] = scale * turn
    matrix[:3, 3] = mesh.bounds.mean(axis=0) - scale * bounds.mean(axis=0)
    return found.transformed(matrix)


def _longest(bounds: FloatArray) -> float:
    return float((bounds[1] - bounds[0]).max())


def _apart(found: Articulation, mesh: Mesh) -> float:
    """Mean distance of the farther half of points of either surface to the other; the larger of both."""
    from simart_kit.bench.sampling import sampled

    clouds = [
        (sampled(one, one.labels * 0, _POINTS, 0, 0), sampled(one, one.labels * 0, _SAMPLES, 0, 1))
        for one in (found, bare(mesh))
    ]
    (few_found, many_found), (few_mesh, many_mesh) = clouds
    return max(_half_mean(few_mesh, many_found), _half_mean(few_found, many_mesh))


def _half_mean(few: Samples, many: Samples) -> float:
    """Mean distance of the half of points that are farthest from another surface."""
    from scipy.spatial import cKDTree

    from simart_kit.bench.overlay import gaps

    ranks = np.arange(1, min(_NEAREST, len(many.cloud.points)) + 1)
    distance, near = map(np.asarray, cKDTree(many.cloud.points).query(few.cloud.points, ranks))
    ways = distance if many.triangles is None else gaps(few.cloud.points, many.triangles[near])
    nearest = np.sort(ways.min(axis=1))
    return float(nearest[len(nearest) // 2 :].mean())


def _right_angles() -> Iterator[FloatArray]:
    """The 24 rotations that take axes to axes."""
    for order, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
        matrix = np.diag(signs)[list(order)]
        if np.linalg.det(matrix) > 0:
            yield matrix
