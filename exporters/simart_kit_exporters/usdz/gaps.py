"""What a USDZ package for AR cannot express of an asset."""

from __future__ import annotations

from simart_kit.asset import Asset
from simart_kit.surfaces import asset_surfaces

from ..gaps import hiding_colors, joined
from ..sweeps import shown_joints


def gaps(asset: Asset) -> tuple[str, ...]:
    """A sentence for each thing that is lost, naming its joints or parts, and what is written instead."""
    shown = {joint.name for joint in shown_joints(asset)}
    moving = [joint for joint in asset.joints if joint.moves]
    physics = (
        "AR Quick Look takes no physics: joints and masses are told in NAME.joints.json alone, and collision "
        "shapes are left out",
    )
    return physics + joined(
        (
            (
                "the animation moves parts along or about one axis alone: at rest are those of",
                [j.name for j in moving if j.kind in ("ball", "free")],
            ),
            (
                "a joint without travel does not show in the animation",
                [j.name for j in moving if j.kind not in ("ball", "free") and j.name not in shown],
            ),
            (
                "UsdPreviewSurface cannot tint a texture by vertex: the texture alone is written for",
                hiding_colors(asset_surfaces(asset)),
            ),
        )
    )
