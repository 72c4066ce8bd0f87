"""What a GLB file cannot express of an asset."""

from __future__ import annotations

from simart_kit.asset import Asset

from ..gaps import joined
from ..sweeps import shown_joints


def gaps(asset: Asset, physics: bool) -> tuple[str, ...]:
    """A sentence for each thing that is lost, naming its joints, and what is written instead."""
    shown = {joint.name for joint in shown_joints(asset)}
    moving = [joint for joint in asset.joints if joint.moves]
    return (_physics_gaps(asset) if physics else _core_gaps(asset)) + joined(
        (
            (
                "a clip moves along or about one axis: none for",
                [j.name for j in moving if j.kind in ("ball", "free")],
            ),
            (
                "a joint without travel has no clip",
                [j.name for j in moving if j.kind not in ("ball", "free") and j.name not in shown],
            ),
        )
    )


def _core_gaps(asset: Asset) -> tuple[str, ...]:
    lost = ["glTF has no bodies: masses are told in `extras` alone, and collision shapes are left out"]
    if asset.joints:
        lost.append("glTF has no joints: they are told in `extras`, and shown by a clip each")
    return tuple(lost)


def _physics_gaps(asset: Asset) -> tuple[str, ...]:
    moving = [joint for joint in asset.joints if joint.moves]
    draft = ("KHR_physics_rigid_bodies is a draft: readers may know another layout of it, or ignore it",)
    return draft + joined(
        (
            ("the draft has no dry friction in joints: none for", [j.name for j in moving if j.friction]),
            (
                "the draft has no speed limit of joints: none for",
                [j.name for j in moving if j.kind != "free"],
            ),
        )
    )
