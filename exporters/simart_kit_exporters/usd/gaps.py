"""What UsdPhysics and UsdPreviewSurface cannot express of an asset."""

from __future__ import annotations

from simart_kit.asset import Asset
from simart_kit.surfaces import asset_surfaces

from ..gaps import hiding_colors, joined
from ..overlaps import overlapping_strangers, told


def gaps(asset: Asset) -> tuple[str, ...]:
    """A sentence for each thing that is lost, naming its joints or parts and what is written instead."""
    moving = [j for j in asset.joints if j.moves]
    return joined(
        (
            (
                "UsdPhysics has no friction, armature or speed limit of joints, so that only Newton and "
                "MuJoCo read them, from attributes of their own, and MuJoCo has no speed limits either",
                [j.name for j in moving if j.kind != "free" and (j.friction or j.armature or j.velocity)],
            ),
            (
                "UsdPhysics has no drive of ball joints, so that only Newton and MuJoCo read their damping",
                [j.name for j in moving if j.kind == "ball" and j.damping],
            ),
            (
                "UsdPhysics has no free joint: the child is a body of its own for",
                [j.name for j in moving if j.kind == "free"],
            ),
            (
                "UsdPreviewSurface cannot tint a texture by vertex: the texture alone is written for",
                hiding_colors(asset_surfaces(asset)),
            ),
            told(overlapping_strangers(asset)),
        )
    )
