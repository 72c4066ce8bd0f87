"""Part seeds -> labels of a mesh's own faces: "Simulator-ready Assets Process" of the SIMART paper.

Each vertex gets the probability P(v, p) ~ exp(-d(v, S_p)^2 / 2 sigma^2) of each part, these are smoothed over
the mesh, and each face takes the part that its corners vote for. Nothing of the mesh is changed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Float32Array, FloatArray, IntArray, frozen_ints
from ..errors import BadInputError
from ..mesh import Mesh
from ..segments import WELD_TOLERANCE, Segments, find_segments
from ..topology import weld
from .edge_links import edge_links
from .mesh_graph import hearing, smoothed
from .mesh_region import Region, region_around
from .part_seeds import PartSeeds
from .part_votes import Ballot, InsidePoints, agree_in_segments, inside_points, unanimous, vote
from .tie_breaks import ways_to_parts

TransferMode = Literal["seeds", "segments"]
# A voxel of a 64^3 grid is 0.9 to 1.6 % of the diagonal.
SIGMA = 0.01
ITERATIONS = 3
AGREEMENT = 0.95
# A face whose first two parts are closer than this share of its votes is decided by its own place.
_TIE = 0.02


@dataclass(frozen=True, eq=False)
class Transfer:
    """Labels of the input's faces, in the input's order.

    Attributes:
        face_part: (F,) int32 part of every face, 0..P-1.
        probabilities: (V, P) float32 smoothed chance of each part at every vertex; rows sum to 1.
        notes: one sentence for each part that the vote left without a face.
    """

    face_part: IntArray
    probabilities: Float32Array
    notes: tuple[str, ...]


def transfer(
    mesh: Mesh,
    seeds: Sequence[ArrayLike],
    *,
    mode: TransferMode = "segments",
    sigma: float = SIGMA,
    iterations: int = ITERATIONS,
    agreement: float = AGREEMENT,
    segments: Segments | None = None,
) -> Transfer:
    """Label every face of a mesh with one of P parts.

    Args:
        mesh: any; vertices at the same place count as one.
        seeds: for each part (N_p, 3) points near its surface, such as the middles of its voxels, in the
            mesh's frame and unit.
        mode: "seeds" labels each face by itself; "segments" then gives one label to a segment whose faces
            agree overwhelmingly.
        sigma: standard deviation of the Gaussian kernel, as a share of the bounding box's diagonal.
        iterations: smoothing steps, each by one ring of vertices.
        agreement: share of a segment's area that has to agree, each face weighted by how sure it is.
        segments: those of the mesh, where they are known; else they are found. Used by mode "segments" only.

    Raises:
        BadInputError: no part, a part without seeds, values that are not finite, a wrong shape or option.
    """
    _check_options(mode, sigma, iterations, agreement)
    if segments is not None and len(segments.face_segment) != len(mesh.faces):
        raise BadInputError(
            f"segments of {len(segments.face_segment)} faces do not fit a mesh of {len(mesh.faces)} faces: "
            "find them on the same mesh"
        )
    known = _part_seeds(seeds, mesh, sigma)
    with ThreadPoolExecutor(1) as beside:
        if mode == "segments":
            beside.submit(lambda: mesh.face_areas)  # the mesh keeps them
        place = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE) if segments is None else segments.vertex
        vertex, points, faces = _welded(mesh, place)
        inner = beside.submit(inside_points, points, faces, known.sigma)
        likely = known.probabilities(points)  # of itself on all cores
        inside = inner.result()
        # Neither needs the other: the seeds vote on one core while segments are found on another.
        voting = beside.submit(_voted, known, likely, points, faces, inside, iterations)
        if mode == "segments" and segments is None:
            segments = find_segments(mesh, vertex=vertex)
        likely, label, margin = voting.result()
    if mode == "segments" and segments is not None:
        weight = mesh.face_areas * margin
        label = agree_in_segments(label, weight, segments.face_segment, known.count, agreement)
    label, notes = _none_lost(label, known, points, faces, inside)
    return Transfer(frozen_ints(label), _frozen(likely.take(vertex, axis=0)), notes)


def _welded(mesh: Mesh, vertex: IntArray) -> tuple[IntArray, FloatArray, IntArray]:
    """(V,) welded ids in the order of the mesh, (W, 3) points by them, and (F, 3) faces on them.

    In that order what is near on the surface is near in memory, as far as it is in the mesh.
    """
    first = np.zeros(int(vertex.max()) + 1, dtype=np.int64)
    first[vertex[::-1]] = np.arange(len(vertex))[::-1]
    leads = np.zeros(len(vertex), dtype=np.bool_)
    leads[first] = True
    number = np.cumsum(leads) - 1
    vertex = number.take(first).take(vertex)
    return vertex, mesh.vertices.compress(leads, axis=0), vertex.take(mesh.faces)


def _voted(
    known: PartSeeds,
    likely: Float32Array,
    points: FloatArray,
    faces: IntArray,
    inside: InsidePoints,
    iterations: int,
) -> tuple[Float32Array, IntArray, FloatArray]:
    """Smoothed (W, P) probabilities at the points, and (F,) labels with how sure each is, 0..1."""
    likely = likely.copy()
    label, agreed = unanimous(likely, faces)
    agreed[inside.faces] = False
    margin = np.ones(len(faces))
    if not agreed.all():
        region = region_around(points, faces, ~agreed)
        smooth, ballot = _decided(known, likely.take(region.vertex_ids, axis=0), region, inside, iterations)
        likely[region.vertex_ids] = smooth
        label[region.face_ids[region.wanted]] = ballot.label
        margin[region.face_ids[region.wanted]] = ballot.margin
    return likely, label, margin


def _decided(
    known: PartSeeds, likely: Float32Array, region: Region, inside: InsidePoints, iterations: int
) -> tuple[Float32Array, Ballot]:
    """Smoothed (V, P) probabilities at the region's vertices, and the votes of the faces it is about."""
    links = edge_links(region.points, region.faces)
    large, sums = region.faces_here(inside.faces), inside.sums(known.probabilities(inside.points))
    weights = hearing(links.ends, region.inner, links.creased, region.faces[large])
    means = (sums / inside.counts[:, None]).astype(np.float32)
    likely = smoothed(likely, means, weights, iterations)
    wanted = np.flatnonzero(region.wanted)
    ballot = vote(likely, region.faces.take(wanted, axis=0), _TIE, np.searchsorted(wanted, large), sums)
    tied = wanted[ballot.tied]
    label = np.zeros(len(region.faces), dtype=np.int64)
    label[wanted] = ballot.label
    beside = np.flatnonzero(~region.wanted)
    label[beside] = likely.take(region.faces[beside, 0], axis=0).argmax(axis=1)
    middles = _middles(region.points, region.faces)
    ways = ways_to_parts(middles, links, tied, label, ballot.contenders)
    shortest = ways.min(axis=1, initial=np.inf, keepdims=True)
    # What no way leads to is decided by its own place.
    left = np.where(np.isfinite(shortest), ways <= shortest * (1 + 1e-9), ballot.contenders)
    label[tied] = known.nearest_part(middles[tied], left)
    return likely, replace(ballot, label=label[wanted])


def _none_lost(
    label: IntArray, known: PartSeeds, points: FloatArray, faces: IntArray, inside: InsidePoints
) -> tuple[IntArray, tuple[str, ...]]:
    """Give each part without a face those nearest to its seeds, at most half of what another part has."""
    lost = np.flatnonzero(np.bincount(label, minlength=known.count) == 0)
    if not len(lost):
        return label, ()
    from scipy.spatial import cKDTree

    middles = _middles(points, faces)
    places = cKDTree(np.concatenate([middles, inside.points]))
    face = np.r_[np.arange(len(faces)), np.repeat(inside.faces, inside.counts)]
    label, notes = label.copy(), []
    for part in lost.tolist():
        distance, found = (np.asarray(value) for value in places.query(known.points[known.part == part]))
        nearest = face[found[np.argsort(distance, kind="stable")]]
        nearest = nearest[np.sort(np.unique(nearest, return_index=True)[1])]
        owned = np.bincount(label, minlength=known.count)
        for donor in np.unique(label[nearest]):
            label[nearest[label[nearest] == donor][: owned[donor] // 2]] = part
        free = np.flatnonzero(owned[label] > 1)
        if len(free) and not (label == part).any():
            label[free[np.asarray(known.each_part[part].query(middles[free])[0]).argmin()]] = part
        notes.append(_note(part, int((label == part).sum())))
    return label, tuple(notes)


def _middles(points: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3) middles of the faces [m]."""
    middles: FloatArray
    middles, b, c = (points.take(corner, axis=0) for corner in faces.T)
    middles += b
    middles += c
    middles /= 3
    return middles


def _note(part: int, taken: int) -> str:
    if not taken:
        return f"part {part} has no face: every face is the last of another part"
    return f"part {part} won no face by vote: it took the {taken} nearest to its seeds"


def _part_seeds(seeds: Sequence[ArrayLike], mesh: Mesh, sigma: float) -> PartSeeds:
    if not len(seeds):
        raise BadInputError("no part has seeds: give the points of at least one part")
    if not mesh.diagonal > 0:
        raise BadInputError("the mesh is a single point: its faces cannot be told apart")
    parts = [_checked(points, part) for part, points in enumerate(seeds)]
    owner = np.repeat(np.arange(len(parts)), [len(points) for points in parts])
    return PartSeeds(np.concatenate(parts), owner, len(parts), sigma * mesh.diagonal)


def _checked(points: ArrayLike, part: int) -> FloatArray:
    try:
        array = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise BadInputError(f"the seeds of part {part} are not numbers in rows of three") from error
    if array.ndim != 2 or array.shape[1] != 3:
        raise BadInputError(f"the seeds of part {part} have shape {array.shape}, expected (N, 3)")
    if not len(array):
        raise BadInputError(f"part {part} has no seeds: leave it out, or decode its voxels again")
    if not np.isfinite(array).all():
        raise BadInputError(f"the seeds of part {part} hold values that are NaN or infinite")
    return array


def _check_options(mode: str, sigma: float, iterations: int, agreement: float) -> None:
    if mode not in get_args(TransferMode):
        raise BadInputError(f"transfer mode '{mode}': use {' or '.join(get_args(TransferMode))}")
    if not (math.isfinite(sigma) and sigma > 0):
        raise BadInputError(f"sigma is {sigma}: use a share of the diagonal > 0, such as {SIGMA}")
    if iterations < 0:
        raise BadInputError(f"{iterations} smoothing iterations: use 0 or more")
    if not 0.5 < agreement <= 1:
        raise BadInputError(f"agreement is {agreement}: use a share above 0.5, up to 1")


def _frozen(values: Float32Array) -> Float32Array:
    values.setflags(write=False)
    return values
