"""Real objects with ground truth: the shipped example, and what is kept beside the checkout, if anything."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from simart_kit.asset import Asset, Joint

Floats = NDArray[np.float64]
Labels = NDArray[np.int32]

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples" / "cabinet.glb"
DATA = ROOT.parent / "shared" / "data"
# How fast a machine simulates decides nothing about an object, so it must not fail a busy machine's tests.
ANY_SPEED = ("checks.realtime.factor=1",)
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="no real objects at ../shared/data")


def source(name: str) -> Path:
    """The file of the example, of a real object, or of one in its original form of several nodes."""
    if name == "example":
        return EXAMPLE
    original = DATA / "polyhaven" / f"{name}.gltf"
    return original if original.exists() else DATA / name / "input.glb"


@dataclass(frozen=True, eq=False)
class Truth:
    """What an object really is, in the frame of its file.

    Attributes:
        parts: of the file with the truth: id, name and joint (type, axis, origin), body first.
        centers: (F, 3) of the triangles that were labelled [m].
        face_part: (F,) id of each triangle's part.
    """

    parts: tuple[dict[str, Any], ...]
    centers: Floats
    face_part: Labels

    def moving(self) -> list[dict[str, Any]]:
        """The parts that are not fixed."""
        return [part for part in self.parts if part["joint"]["type"] != "fixed"]

    def labels(self, asset: Asset) -> Labels:
        """(F,) true part id of each of the asset's faces, found by place: loaders may order faces anew."""
        placed = self.centers @ asset.asset_from_source[:3, :3].T + asset.asset_from_source[:3, 3]
        distance, nearest = cKDTree(placed).query(asset.mesh.triangles.mean(axis=1))
        assert np.max(distance) < 1e-5
        return np.asarray(self.face_part[nearest])


def truth(name: str) -> Truth:
    """The truth about an object; that of one in its original form is the same."""
    if name == "example":
        labelled, table, arrays = (EXAMPLE.with_suffix(end) for end in (".glb", ".gt.json", ".gt.npz"))
    else:
        folder = DATA / name.removesuffix("_1k")
        labelled, table, arrays = folder / "input.glb", folder / "gt.json", folder / "gt.npz"
    mesh = trimesh.load(labelled, process=False, force="mesh")
    with np.load(arrays) as stored:
        face_part = stored["face_part"]
    parts = json.loads(table.read_text(encoding="utf-8"))["parts"]
    return Truth(tuple(parts), mesh.triangles.mean(axis=1), face_part)


def overlap(areas: Floats, one: NDArray[np.bool_], two: NDArray[np.bool_]) -> float:
    """Intersection over union of two sets of faces, by area."""
    return float(areas[one & two].sum() / areas[one | two].sum())


def true_part(asset: Asset, joint: Joint, known: Truth) -> tuple[dict[str, Any], float]:
    """The true part that a joint's child is most like, and how much (IoU by area)."""
    labels, areas = known.labels(asset), asset.mesh.face_areas
    mine = asset.face_part == asset.part_index(joint.child)
    shares = [overlap(areas, mine, labels == part["id"]) for part in known.parts]
    best = int(np.argmax(shares))
    return known.parts[best], shares[best]


def true_axis(part: dict[str, Any], asset_from_source: Floats) -> tuple[Floats, Floats]:
    """(3,) unit direction and (3,) point [m] of a true joint in the asset frame."""
    direction = asset_from_source[:3, :3] @ part["joint"]["axis"]
    point = asset_from_source[:3, :3] @ part["joint"]["origin"] + asset_from_source[:3, 3]
    return direction / np.linalg.norm(direction), point


def line_distance(point: Floats, direction: Floats, other: Floats) -> float:
    """Distance of (3,) `other` from the line through `point` along unit `direction` [m]."""
    way = other - point
    return float(np.linalg.norm(way - direction * (way @ direction)))
