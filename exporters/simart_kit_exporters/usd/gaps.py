"""What UsdPhysics and UsdPreviewSurface cannot express of an asset."""

from __future__ import annotations

import numpy as np

from simart_kit.asset import Asset


def gaps(asset: Asset) -> tuple[str, ...]:
    """A sentence for each thing that is lost, naming its joints or parts and what is written instead."""
    moving = [j for j in asset.joints if j.moves]
    lost = {
        "UsdPhysics has no dry friction in joints: none for": [j.name for j in moving if j.friction],
        "UsdPhysics has no speed limit of joints: none for": [j.name for j in moving if j.kind != "free"],
        "UsdPhysics has no drive of ball joints: no damping for": [
            j.name for j in moving if j.kind == "ball" and j.damping
        ],
        "UsdPhysics has no free joint: the child is a body of its own for": [
            j.name for j in moving if j.kind == "free"
        ],
        "UsdPreviewSurface cannot tint a texture by vertex: the texture alone is written for": _tinted(asset),
    }
    return tuple(f"{text} {', '.join(names)}" for text, names in lost.items() if names)


def _tinted(asset: Asset) -> list[str]:
    """Parts with faces whose texture is multiplied by vertex colours that are not plain white."""
    mesh = asset.mesh
    if mesh.colors is None or mesh.uv is None:
        return []
    pictured = np.array([m.base_color_image is not None for m in mesh.materials])[mesh.face_material]
    colored = (mesh.colors != 255).any(axis=1)[mesh.faces].any(axis=1)
    return [asset.parts[i].name for i in np.unique(asset.face_part[pictured & colored])]
