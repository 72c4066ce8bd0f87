"""Who made an asset of what, and a small picture of it, where SimReady tools look for them."""

from __future__ import annotations

from pathlib import Path

from simart_kit.asset import Asset
from simart_kit.asset_io import ASSET_FILE
from simart_kit.mesh import Image
from simart_kit.render import isometric_view, rest_caster

from .semantics import category

UNDATED = "not recorded, so that two exports are the same bytes"
"""SimReady demands a date of every asset, but not that it is one."""

_THUMBNAIL = 256  # [pixels]


def layer_data(asset: Asset, author: str, license_: str) -> dict[str, object]:
    """A layer's custom data as SimReady's requirement SR.003 wants it, and SR.001 before it."""
    fields = _fields(asset, author, license_)
    older = ("asset_name", "asset_type", "source_file", "usd_date_generated")
    return {"SimReady_Metadata": fields, **{name: fields[name] for name in older}}


def write_thumbnail(asset: Asset, file: Path) -> None:
    """Write the picture of a USD file into the hidden folder beside it that browsers of assets read."""
    path = file.parent / ".thumbs" / f"{_THUMBNAIL}x{_THUMBNAIL}" / f"{file.name}.png"
    path.parent.mkdir(parents=True)
    pixels = isometric_view(asset.mesh, _THUMBNAIL, caster=rest_caster(asset))
    path.write_bytes(Image.from_pixels(pixels).png)


def _fields(asset: Asset, author: str, license_: str) -> dict[str, object]:
    """Without a mass for parts that have none yet."""
    from pxr import Gf

    lower, upper = asset.mesh.bounds
    kind = category(asset)
    fields: dict[str, object] = {
        "author": author,
        "asset_name": asset.name,
        "asset_type": "prop",
        "asset_license": license_,
        "category": kind.name,
        "source_file": ASSET_FILE,
        "usd_date_generated": UNDATED,
        "qcode": kind.qcode,
        "rigid_body_count": len(asset.parts),
        "asset_extents": Gf.Vec3f(*(upper - lower).tolist()),
    }
    masses = [part.mass.mass for part in asset.parts if part.mass]
    return fields | ({"mass": sum(masses)} if len(masses) == len(asset.parts) else {})
