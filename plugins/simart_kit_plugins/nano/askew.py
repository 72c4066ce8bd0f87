"""An object that stands askew is seen as if it stood along the axes, as all that was learnt from does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Note
from simart_kit.alignment import straight_from_asset
from simart_kit.evidence import PointEvidence

if TYPE_CHECKING:
    from simart_kit import Mesh, Segmentation
    from simart_kit.arrays import FloatArray
    from simart_kit.evidence import Evidence


def seen_straight(mesh: Mesh, segment: Callable[[Mesh], Segmentation]) -> Segmentation:
    """What a segmenter finds in a mesh turned so that its faces follow the axes, turned back."""
    straight_from_mesh = np.eye(4)
    straight_from_mesh[:3, :3] = straight_from_asset(mesh)
    askew = np.arccos(np.clip((np.trace(straight_from_mesh) - 2) / 2, -1, 1))
    if askew == 0:
        return segment(mesh)
    found = _turned(segment(mesh.transformed(straight_from_mesh)), straight_from_mesh.T)
    told = f"it stands askew by {np.degrees(askew):.1f} degrees, and was read straight"
    return replace(found, notes=(*found.notes, Note("segment", "info", told)))


def _turned(found: Segmentation, matrix: FloatArray) -> Segmentation:
    """A segmentation in another frame, by a (4, 4) rotation."""
    joints = None if found.joints is None else tuple(joint.transformed(matrix) for joint in found.joints)
    mesh = None if found.mesh is None else found.mesh.transformed(matrix)
    evidence = tuple(_evidence_turned(one, matrix) for one in found.evidence)
    return replace(found, joints=joints, mesh=mesh, evidence=evidence)


def _evidence_turned(one: Evidence, matrix: FloatArray) -> Evidence:
    return replace(one, points=one.points @ matrix[:3, :3].T) if isinstance(one, PointEvidence) else one
