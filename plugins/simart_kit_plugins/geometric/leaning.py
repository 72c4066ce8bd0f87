"""Leaves that lean, as those of display cases do: whether they slide is seen as if they stood upright."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray, vec3
from simart_kit.asset import Joint, Limits

from .facing import turned
from .fronts import PANEL, SMALLEST, thin
from .sashes import crosses, room_beside, with_room
from .scene import Scene, make_scene
from .views import View, view_part

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import BoolArray

_LYING = 0.9  # cosine between a leaf's normal and the vertical, above which it is a lid
_AJAR = 0.05  # sine of the angle that it is turned about the vertical: what is hinged may stand open so
_FACING = 0.9  # cosine between the normals of faces that face alike
_LEAF = 1  # its number among the pieces


def sliding_across(mesh: Mesh, faces: BoolArray) -> Joint | None:
    """The joint of a leaf that slides along its own face over the body, to the one side with room for it.

    Its handle may be in one piece with it. What is not a leaf, has no handle across its way, or has room on
    both sides or on none, is not said to slide.

    Args:
        mesh: the whole.
        faces: (F,) bool of the leaf; neither none nor all.
    """
    scene = make_scene(mesh, faces.astype(np.int64))
    normal = _normal(scene)
    if normal is None or abs(normal[2]) > _LYING or np.abs(normal[:2]).min() > _AJAR:
        return None
    axes = _axes(normal)
    if (np.ptp(scene.points_of(_LEAF) @ axes[:2].T, axis=0) < SMALLEST).any():
        return None
    upright = turned(scene, axes)
    slides = (_slide(upright, view_part(upright, _LEAF, (side,))) for side in ("front", "back"))
    return next((joint for joint in slides if joint is not None), None)


def _slide(scene: Scene, view: View) -> Joint | None:
    """The joint of the leaf, in the asset's frame, if it is taken hold of from this side."""
    if view.handle is None or not thin(view.box):
        return None
    side = room_beside(scene, view.axes, view.box, (_LEAF,))
    if not side or not crosses(view.handle.size, view.handle_place[0] * side):
        return None
    way = with_room(scene, view)
    if way is None or way[0].axis[0] != side:
        return None
    candidate, confidence, reasons = way
    return Joint(
        "joint",
        "prismatic",
        "body",
        "part",
        vec3(scene.points_to_asset((candidate.origin @ view.axes)[None])[0]),
        vec3(scene.vector_to_asset(candidate.axis @ view.axes)),
        Limits(0.0, candidate.upper * scene.size),
        confidence=confidence,
        evidence=reasons,
    )


def _normal(scene: Scene) -> FloatArray | None:
    """(3,) along or against which most of the leaf faces; None where it faces all over."""
    faces = scene.faces_of((_LEAF,))
    normals, areas = scene.normals[faces], scene.face_areas[faces]
    normal = np.linalg.eigh((areas[:, None] * normals).T @ normals)[1][:, -1]
    flat = areas[np.abs(normals @ normal) > _FACING].sum()
    return np.asarray(normal) if flat > PANEL * areas.sum() else None


def _axes(normal: FloatArray) -> FloatArray:
    """(3, 3) rows across, up and out of what faces along a direction that is not vertical."""
    across = np.cross([0.0, 0.0, 1.0], normal)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(normal, across), normal])
