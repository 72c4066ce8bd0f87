"""Leaves that the network is sure move, but not how: they slide where geometry sees room for that alone."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..geometric.leaning import sliding_across

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh

    from .meshes import MeshCloud
    from .predicting import PredictedPart, Prediction

_LABEL = "sliding door"


def with_slides(
    mesh: Mesh, said: Prediction, seen: MeshCloud, least: float, *, doubtful: float
) -> Prediction:
    """The prediction, in which such leaves slide, as sure as it is that they move.

    Args:
        mesh: that was read.
        said: of it, with all parts.
        seen: what was read.
        least: how sure it has to be that a leaf moves.
        doubtful: parts less sure than this would stay with the body.
    """
    parts = []
    for part in said.parts:
        joint = None
        if part.score >= least and part.certainty < doubtful:
            faces = np.isin(seen.face_piece, part.pieces)
            joint = sliding_across(mesh, faces) if faces.any() and not faces.all() else None
        parts.append(part if joint is None else _sliding(part, joint, seen))
    return replace(said, parts=tuple(parts))


def _sliding(part: PredictedPart, joint: Joint, seen: MeshCloud) -> PredictedPart:
    """The part with a joint of the mesh, in the frame of the cloud."""
    assert joint.limits is not None
    return replace(
        part,
        label=_LABEL,
        kind="prismatic",
        axis=np.array(joint.axis),
        origin=(np.array(joint.origin) - seen.center) / seen.size,
        lower=joint.limits.lower / seen.size,
        upper=joint.limits.upper / seen.size,
        confidence=joint.confidence,
        certainty=part.score,
        reasons=joint.evidence,
    )
