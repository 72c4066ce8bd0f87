"""Voxel reconstruction: a decoded occupancy grid against the one that was encoded."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import BadInputError
from .metrics.voxel_shape import voxel_iou

_EMPTY = math.sqrt(3) / 2  # half the diagonal of a cube of side 1


@dataclass(frozen=True)
class Reconstruction:
    """How well a grid was decoded. SIMART's appendix tables MSE and CD at 64^3, both times 1e5.

    Attributes:
        mse: mean over all cells of (probability - occupancy)^2; 0..1.
        cd: chamfer distance between the middles of occupied cells (probability > 0.5), not squared, half the
            sum of the two directed means [side of the cube]; half its diagonal when nothing was decoded.
        cd_squared: the sum of the two directed means of squared distances [square of that side]. The paper
            does not say which of the two its table has; values of its size, 4.19e-5, are read as this one.
        iou: intersection over union of occupied cells; 0..1.
    """

    mse: float
    cd: float
    cd_squared: float
    iou: float


def score_reconstruction(true: BoolArray, predicted: FloatArray | BoolArray) -> Reconstruction:
    """Score a decoded grid.

    Args:
        true: (R, R, R) whether a cell is occupied.
        predicted: (R, R, R) probability that it is, 0..1, or bool.

    Raises:
        BadInputError: grids that are not cubes of one size, a true one that is not bool or is empty, or
            values that are no probabilities.
    """
    _check(true, predicted)
    decoded = np.asarray(predicted > 0.5)
    mse = float(np.mean((predicted.astype(np.float64) - true) ** 2))
    there, back = _missed(true, decoded), _missed(decoded, true)
    cd = (there.mean() + back.mean()) / 2
    squared = (there**2).mean() + (back**2).mean()
    return Reconstruction(mse, float(cd), float(squared), voxel_iou(true, decoded))


def _missed(cells: BoolArray, others: BoolArray) -> FloatArray:
    """(K,) distance of each occupied cell to the nearest of others [side of the cube]."""
    from scipy.ndimage import distance_transform_edt

    if not cells.any() or not others.any():
        return np.array([_EMPTY])
    return np.asarray(distance_transform_edt(~others)[cells]) / len(cells)


def _check(true: BoolArray, predicted: FloatArray | BoolArray) -> None:
    if true.dtype != np.bool_ or true.ndim != 3 or len(set(true.shape)) != 1:
        raise BadInputError(
            f"the true grid has shape {true.shape} and type {true.dtype}: a cube of bools is needed"
        )
    if predicted.shape != true.shape:
        raise BadInputError(f"the decoded grid has shape {predicted.shape}, the true one {true.shape}")
    if not true.any():
        raise BadInputError("the true grid is empty: an object is needed")
    if predicted.dtype != np.bool_ and not np.issubdtype(predicted.dtype, np.floating):
        raise BadInputError(f"the decoded grid is of {predicted.dtype}: probabilities or bools are needed")
    if not ((predicted >= 0) & (predicted <= 1)).all():
        raise BadInputError(
            "the decoded grid holds values outside 0..1: probabilities are needed, not logits"
        )
