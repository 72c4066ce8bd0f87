"""NAME.joints.json: what RealityKit code needs to move the parts of a USDZ, which has no joints."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from simart_kit.asset import Asset

from ..joint_data import body_table, heading, joint_table
from ..y_up import y_up
from .clip import FRAMES_A_SECOND, frames


def write_joints(asset: Asset, directory: Path) -> None:
    """Write `NAME.joints.json` beside `NAME.usdz`."""
    table = joints_json(y_up(asset))
    text = json.dumps(table, indent=2, ensure_ascii=False, allow_nan=False)
    (directory / f"{asset.name}.joints.json").write_text(text + "\n", encoding="utf-8")


def joints_json(asset: Asset) -> dict[str, Any]:
    """Bodies and joints of an asset in the frame of the file; prims are called as in `part_path`."""
    shown = {joint.name: start_end for joint, start_end in frames(asset)}
    joints = []
    for joint in asset.joints:
        paths = {"parent_path": part_path(asset, joint.parent), "child_path": part_path(asset, joint.child)}
        clip = [frame / FRAMES_A_SECOND for frame in shown[joint.name]] if joint.name in shown else None
        joints.append({**joint_table(joint), **paths, "shown": clip})
    bodies = [{**body_table(part), "path": part_path(asset, part.name)} for part in asset.parts]
    return {**heading(asset), "model": f"{asset.name}.usdz", "bodies": bodies, "joints": joints}


def part_path(asset: Asset, part: str) -> str:
    """Path of a part's prim: below the part that carries it, and the root part below the asset."""
    joint = asset.joint_to(part)
    return f"{part_path(asset, joint.parent) if joint else f'/{asset.name}'}/{part}"
