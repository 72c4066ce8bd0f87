"""What MJCF cannot express of an asset, and what is written instead."""

from __future__ import annotations

from simart_kit.asset import Asset
from simart_kit.surfaces import asset_surfaces

from .gaps import joined, look_gaps
from .mjcf_flavors import Flavor
from .mjcf_robosuite import body_names
from .overlaps import overlapping_parts, told


def gaps(asset: Asset, flavor: Flavor) -> tuple[str, ...]:
    """A sentence for each thing that is lost."""
    moving = [j for j in asset.joints if not j.rigid]
    groups = asset_surfaces(asset)
    found = (
        ("MJCF has no speed limit of joints: none for", [j.name for j in moving if j.kind != "free"]),
        (
            "a joint without travel is written as fixed",
            [j.name for j in asset.joints if j.rigid and j.moves],
        ),
        (
            "no mass is known: MuJoCo takes it from the shapes at 1000 kg/m^3",
            [p.name for p in asset.parts if p.mass is None],
        ),
        (
            "MuJoCo ignores the transparency of textures",
            [part for part, group in groups.items() if any(s.translucent for s in group)],
        ),
        told(overlapping_parts(asset)),
    )
    restitution = ("MJCF has no restitution: contacts have MuJoCo's default softness",)
    return restitution + joined(found) + _free_gaps(asset, flavor) + look_gaps(groups)


def _free_gaps(asset: Asset, flavor: Flavor) -> tuple[str, ...]:
    """What becomes of free joints, of a free base and of names that are taken."""
    free = [j.name for j in asset.joints if j.kind == "free"]
    if not flavor.wrapped:
        return joined((("a free joint's pose is written against the world", free),))
    renamed = [f"{part} as {name}" for part, name in body_names(asset).items() if part != name]
    base = ("robosuite gives an object its free joint itself: the base is written as fixed",)
    return (base if asset.floating else ()) + joined(
        (
            ("an object of robosuite has one free joint at most: written as fixed", free),
            ("robosuite keeps a name for itself, so that bodies have another", renamed),
        )
    )
