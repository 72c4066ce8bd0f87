"""Frames: the unit frame of an object, predictions brought to the truth's frame, and faces found again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import permutations
from typing import Literal

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import BadInputError
from ..mesh import UpAxis, z_up_from
from ..triangles import crosses
from .articulation import Articulation
from .cases import Prediction, Truth

_APART = 0.1  # of the truth's longest side: boxes whose faces differ by more are of different frames
_SAME = 1e-4  # of the diagonal: corners nearer than this are the same
_ROUNDING = 1e-6  # of the diagonal: centroids nearer than this are of one face, or of copies of it
_TRIED = 8  # partners tried for a face whose nearest is not its own
MISFIT = "the prediction's box differs from the truth's"
"""How the note of a prediction begins that does not lie where the truth does."""
_FACING = np.array([0.267, 0.535, 0.802])  # any direction that few faces run along


@dataclass(frozen=True)
class Placement:
    """How predictions are brought to the frame of the truth.

    Attributes:
        up: axis that points up in the predictions' frame; None where it is that of the truth.
        fit: "box" scales and moves a prediction into the truth's box; "none" leaves it where it is.
    """

    up: UpAxis | None = None
    fit: Literal["none", "box"] = "none"

    @property
    def text(self) -> str:
        """A short phrase, such as "as is" or "up +z, fitted to the truth's box"."""
        up = f"up {self.up}" if self.up else ""
        fit = "fitted to the truth's box" if self.fit == "box" else ""
        return ", ".join(phrase for phrase in (up, fit) if phrase) or "as is"


def unit_from_object(bounds: FloatArray) -> FloatArray:
    """The (4, 4) similarity that centres a (2, 3) box at 0 and makes its longest side 1.

    Use that of the truth for the prediction, too: each in its own unit frame would hide errors of size.

    Raises:
        BadInputError: the box is a point, or not finite.
    """
    scale = 1.0 / _longest_side(bounds, "the object")
    matrix = np.diag([scale, scale, scale, 1.0])
    matrix[:3, 3] = -scale * _center(bounds)
    return matrix


def place(prediction: Prediction, truth: Truth, placement: Placement | None) -> Prediction:
    """The prediction turned, scaled and moved to the truth's frame; its notes tell of a fit or a misfit.

    Args:
        prediction: in a frame of its own.
        truth: whose frame is meant.
        placement: how the way is found; None where the prediction is there already: then it is checked only.

    Raises:
        BadInputError: the box of either is a point, or not finite.
    """
    articulation, notes = prediction.articulation, prediction.notes
    target = truth.articulation.bounds
    if placement and placement.up is not None:
        turn = np.eye(4)
        turn[:3, :3] = z_up_from(truth.up).T @ z_up_from(placement.up)
        articulation = articulation.transformed(turn)
    if placement and placement.fit == "box":
        fit = _box_fit(articulation.bounds, target)
        articulation = articulation.transformed(fit)
        x, y, z = fit[:3, 3]
        notes += (
            f"fitted to the truth's box: scaled by {fit[0, 0]:.4g}, moved by ({x:.4g}, {y:.4g}, {z:.4g})",
        )
    apart = float(np.abs(articulation.bounds - target).max()) / _longest_side(target, "the truth")
    if apart > _APART:
        hint = "; see --up and --fit" if placement else ""
        notes += (f"{MISFIT} by {apart:.2g} of its size: scores may mean little{hint}",)
    return replace(prediction, articulation=articulation, notes=notes)


def same_faces(truth: Articulation, prediction: Articulation) -> IntArray | None:
    """For each face of the truth, the face of the prediction that is the same triangle.

    Corners may be in another order, and so may faces. Copies of a face at one place get a partner each: those
    wound alike first, then in order.

    Returns:
        (F,) face indices, each once; or None when the meshes differ: points, another number of faces, or a
        face with no partner whose corners lie within 1e-4 of the truth's diagonal of its own.
    """
    if truth.is_cloud or prediction.is_cloud or len(truth.faces) != len(prediction.faces):
        return None
    if np.abs(truth.bounds - prediction.bounds).max() > _SAME * truth.diagonal:
        return None
    return _Pairing(truth, prediction).found()


class _Pairing:
    """Faces of two meshes of the same size and number of faces, to be paired."""

    def __init__(self, truth: Articulation, prediction: Articulation) -> None:
        self._true, self._predicted = truth.triangles, prediction.triangles
        self._true_centers = self._true.mean(axis=1)
        self._predicted_centers = self._predicted.mean(axis=1)
        self._near, self._fine = _SAME * truth.diagonal, _ROUNDING * truth.diagonal

    def found(self) -> IntArray | None:
        """(F,) partner of each true face, or None when there is one without."""
        everything = np.arange(len(self._true))
        apart = np.abs(self._true_centers - self._predicted_centers).max()
        if apart <= self._near and self._same(everything, everything).all():
            return everything
        places = self._places()
        if places is None:
            return None
        partner = _paired(
            _ranked(places[0], crosses(self._true) @ _FACING > 0),
            _ranked(places[1], crosses(self._predicted) @ _FACING > 0),
        )
        partner[partner >= 0] = np.where(
            self._same(np.flatnonzero(partner >= 0), partner[partner >= 0]), partner[partner >= 0], -1
        )
        return self._completed(partner)

    def _places(self) -> tuple[IntArray, IntArray] | None:
        """(F,) ids of where true and predicted faces are: equal for faces at one place.

        None when a true face has no predicted one near.
        """
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components
        from scipy.spatial import cKDTree

        # Copies may round to neighbouring cells, so cells in reach of each other are one place.
        cell = np.round((self._predicted_centers - self._predicted_centers.min(axis=0)) / self._fine)
        keys = cell.astype(np.int64) @ np.array([1 << 42, 1 << 21, 1], dtype=np.int64)
        _, first, own = np.unique(keys, return_index=True, return_inverse=True)
        tree = cKDTree(self._predicted_centers[first])
        distance, nearest = tree.query(self._true_centers, distance_upper_bound=self._near)
        if not np.isfinite(distance).all():
            return None
        pairs = tree.query_pairs(self._fine, output_type="ndarray")
        links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(first), len(first)))
        _, place = connected_components(links, directed=False)
        return place[nearest], place[own]

    def _completed(self, partner: IntArray) -> IntArray | None:
        """Partners for the faces that have none yet (-1), one to one; None when that cannot be."""
        from scipy.sparse import csr_array
        from scipy.sparse.csgraph import maximum_bipartite_matching
        from scipy.spatial import cKDTree

        alone = np.flatnonzero(partner < 0)
        if not len(alone):
            return partner
        free = np.setdiff1d(np.arange(len(partner)), partner)
        tree = cKDTree(self._predicted_centers[free])
        ranks = np.arange(1, min(_TRIED, len(free)) + 1)
        distance, nearest = tree.query(self._true_centers[alone], ranks, distance_upper_bound=self._near)
        row, rank = np.nonzero(np.isfinite(distance))
        column = np.asarray(nearest)[row, rank]
        same = self._same(alone[row], free[column])
        edges = (np.ones(int(same.sum())), (row[same], column[same]))
        graph = csr_array(edges, shape=(len(alone), len(free)))
        matched = np.asarray(maximum_bipartite_matching(graph, "column"))
        if (matched < 0).any():
            return None
        partner[alone] = free[matched]
        return partner

    def _same(self, true: IntArray, predicted: IntArray) -> BoolArray:
        """(N,) whether the corners of true and predicted faces, (N,) indices each, are at the same places."""
        same = np.zeros(len(true), dtype=np.bool_)
        for order in permutations(range(3)):
            left = np.flatnonzero(~same)
            ways = self._true[true[left]] - self._predicted[predicted[left]][:, order]
            same[left] = (np.einsum("fcx,fcx->fc", ways, ways) <= self._near**2).all(axis=1)
        return same


def _ranked(place: IntArray, facing: BoolArray) -> tuple[IntArray, IntArray]:
    """(F,) faces in the order of their places, and a key (F,) that is unique: place and rank there."""
    order = np.lexsort((facing, place))
    ordered = place[order]
    start = np.searchsorted(ordered, ordered)
    return order, ordered.astype(np.int64) * len(place) + (np.arange(len(place)) - start)


def _paired(true: tuple[IntArray, IntArray], predicted: tuple[IntArray, IntArray]) -> IntArray:
    """(F,) for each true face the predicted one of the same key, or -1."""
    _, mine, others = np.intersect1d(true[1], predicted[1], assume_unique=True, return_indices=True)
    partner = np.full(len(true[0]), -1)
    partner[true[0][mine]] = predicted[0][others]
    return partner


def _box_fit(bounds: FloatArray, target: FloatArray) -> FloatArray:
    """The (4, 4) similarity that gives one (2, 3) box the centre and the longest side of another."""
    scale = _longest_side(target, "the truth") / _longest_side(bounds, "the prediction")
    matrix = np.diag([scale, scale, scale, 1.0])
    matrix[:3, 3] = _center(target) - scale * _center(bounds)
    return matrix


def _longest_side(bounds: FloatArray, whose: str) -> float:
    with np.errstate(over="ignore"):
        side = float((bounds[1] - bounds[0]).max())
    if not (np.isfinite(side) and side > 0):
        raise BadInputError(f"{whose} has a box of size {side:g}: it needs one that is finite and above 0")
    return side


def _center(bounds: FloatArray) -> FloatArray:
    return np.asarray(bounds[0] / 2 + bounds[1] / 2)
