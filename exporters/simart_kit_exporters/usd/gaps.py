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
            ("UsdPhysics has no dry friction in joints: none for", [j.name for j in moving if j.friction]),
            (
                "UsdPhysics has no speed limit of joints: none for",
                [j.name for j in moving if j.kind != "free"],
            ),
            (
                "UsdPhysics has no drive of ball joints: no damping for",
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
