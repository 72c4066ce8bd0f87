"""Predictions of this program: folders that `simart-kit convert` wrote."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from ...arrays import FloatArray
from ...asset import Asset, clean_name
from ...asset_io import ASSET_FILE, load_asset
from ...errors import BadInputError
from ..articulation import Articulation, Link, LinkJoint
from ..cases import Prediction, Truth
from ..rows import OBJECTS
from . import PredictionFormat


class OutputFolder(PredictionFormat):
    """Reads output folders; surface and joints are brought back to the frame and unit of the source file."""

    name = "simart-kit"
    layout = f"NAME/{ASSET_FILE}, NAME/output/{ASSET_FILE} or {OBJECTS}/NAME/output/{ASSET_FILE}"
    knows_frame = True

    def find(self, root: Path, name: str) -> Path | None:
        for folder in (root / name, root / name / "output", root / OBJECTS / name / "output"):
            if (folder / ASSET_FILE).is_file():
                return folder
        return root if _asset_name(root) in (name, clean_name(name)) else None

    def read(self, path: Path, truth: Truth) -> Prediction:
        asset = load_asset(path)
        source_from_asset = _inverse(path, asset.asset_from_source)
        try:
            placed = in_asset_frame(asset).transformed(source_from_asset)
        except BadInputError as error:
            raise BadInputError(f"{path / ASSET_FILE}: {error}") from error
        return Prediction(placed, _simulator_file(path))


def in_asset_frame(asset: Asset) -> Articulation:
    """An asset as an articulation, in the asset frame [m]: links are its parts, in their order."""
    links = []
    for part in asset.parts:
        joint = asset.joint_to(part.name)
        if joint is None:
            links.append(Link(part.name, label=part.label))
            continue
        lower, upper = (joint.limits.lower, joint.limits.upper) if joint.limits else (None, None)
        moved = LinkJoint(joint.kind, joint.axis, joint.origin, lower, upper, joint.name)
        parent = asset.part_index(joint.parent)
        links.append(Link(part.name, parent, moved, label=part.label, confidence=joint.confidence))
    return Articulation(asset.name, asset.mesh.vertices, asset.mesh.faces, asset.face_part, tuple(links))


def _asset_name(folder: Path) -> str | None:
    """Name of the asset in a folder; None where there is none that can be read."""
    try:
        table = json.loads((folder / ASSET_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    name = table.get("name") if isinstance(table, dict) else None
    return name if isinstance(name, str) else None


def _inverse(path: Path, asset_from_source: FloatArray) -> FloatArray:
    """(4, 4) inverse of what has to be a rotation, a uniform scale and a shift."""
    linear = asset_from_source[:3, :3]
    scale = float(np.cbrt(np.linalg.det(linear)))
    turned = np.allclose(linear @ linear.T, scale**2 * np.eye(3), atol=1e-6 * scale**2)
    if not (scale > 1e-12 and turned and np.array_equal(asset_from_source[3], (0, 0, 0, 1))):
        raise BadInputError(
            f"{path / ASSET_FILE}: asset_from_source is more than a rotation, a scale and a shift: "
            "convert the object again"
        )
    return np.asarray(np.linalg.inv(asset_from_source))


def _simulator_file(folder: Path) -> Path | None:
    """The MJCF file of an output folder, else its URDF file."""
    found = [*sorted(folder.glob("mjcf/*.xml")), *sorted(folder.glob("urdf/*.urdf"))]
    return found[0] if found else None
