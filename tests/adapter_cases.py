"""Small URDF files, and the assets that are made of them."""

from __future__ import annotations

from pathlib import Path

from simart_kit.assemble import assemble
from simart_kit.asset import Asset
from simart_kit.loading import read_source
from simart_kit.plugins import Plugins

BOX = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
BASE = f'<link name="base">{BOX}</link>'


def load(path: Path) -> Asset:
    """The asset as a run has it before modifiers."""
    source = read_source(path, Plugins(installed=False))
    assert source.stated is not None
    assert source.stated.joints is not None
    return assemble("thing", source.mesh, source.stated, source.stated.joints, source.asset_from_source)


def write(folder: Path, *elements: str) -> Path:
    path = folder / "thing.urdf"
    path.write_text(f'<robot name="thing">{"".join(elements)}</robot>')
    return path


def joint(name: str, kind: str, parent: str, child: str, inner: str = "") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{inner}</joint>'


def limit(lower: float, upper: float) -> str:
    return f'<limit lower="{lower}" upper="{upper}" effort="9" velocity="3"/>'
