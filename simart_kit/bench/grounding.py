"""Part grounding: the faces that a description means, against those that a model chose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray
from ..errors import BadInputError
from ..mesh import Mesh
from .articulation import Articulation, Link
from .frame import unit_from_object
from .metrics.parts import iou_matrix
from .metrics.shape import chamfer
from .overlay import overlay

_LINKS = (Link("rest"), Link("part", parent=0))
_PART = 1


@dataclass(frozen=True)
class Grounding:
    """How well a described part was found (the two numbers of SIMART's 3D part understanding).

    Attributes:
        iou: intersection over union of true and chosen faces, by area; 0..1.
        cd: chamfer distance between both, not squared, half the sum of the two directed means [object's
            longest side]; half the object's diagonal when nothing was chosen.
    """

    iou: float
    cd: float


def score_grounding(mesh: Mesh, true_faces: BoolArray, predicted_faces: BoolArray) -> Grounding:
    """Score the faces that were chosen for a description.

    Args:
        mesh: the object, in any frame and unit.
        true_faces: (F,) whether a face belongs to the part.
        predicted_faces: (F,) whether it was chosen.

    Raises:
        BadInputError: masks that are not one bool a face, a part without area, or an object without size.
    """
    unit = unit_from_object(mesh.bounds)
    truth, prediction = (
        _labelled(mesh, name, mask).transformed(unit)
        for name, mask in (("true_faces", true_faces), ("predicted_faces", predicted_faces))
    )
    if not truth.weights[true_faces].sum() > 0:
        raise BadInputError("true_faces chooses no surface: a part to find is needed")
    if not truth.weights[predicted_faces].sum() > 0:
        return Grounding(iou=0.0, cd=truth.diagonal / 2)
    laid = overlay(truth, prediction)
    iou = iou_matrix(laid.true_labels, laid.predicted_labels, laid.weights, (len(_LINKS), len(_LINKS)))
    return Grounding(float(iou[_PART, _PART]), chamfer(laid.truth.of(_PART), laid.prediction.of(_PART)))


def _labelled(mesh: Mesh, name: str, mask: BoolArray) -> Articulation:
    """The mesh as a part and the rest."""
    if mask.dtype != np.bool_ or mask.shape != (len(mesh.faces),):
        raise BadInputError(
            f"{name} has shape {mask.shape} and type {mask.dtype}: one bool for each of "
            f"{len(mesh.faces)} faces is needed"
        )
    return Articulation(name, mesh.vertices, mesh.faces, mask.astype(np.int32), _LINKS)
