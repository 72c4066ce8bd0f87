"""Objects as SIMART-Bench folders: upright, on the ground, one closed-up mesh with colours at its corners."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit.arrays import ByteArray, FloatArray, IntArray
from simart_kit.bench.articulation import Articulation
from simart_kit.bench.formats import DEFAULT_VARIANT
from simart_kit.bench.formats.simart_bench import FACE_PART, LABELS, TABLE, without_hidden
from simart_kit.bench.formats.truth_tables import check_truth, part_rows
from simart_kit.errors import BadInputError
from simart_kit.mesh import UpAxis, z_up_from
from simart_kit.topology import unique_rows

from .rigged import Rigged

TERMS = "evaluation only"
# Corners closer than this share of the object are one.
_SAME = 1e-6


@dataclass(frozen=True)
class Origin:
    """Where an object is from: its package with version, the file in it, and under which licence."""

    source: str
    version: str
    file: str
    licence: str


def write_object(rigged: Rigged, name: str, category: str, origin: Origin, folder: Path) -> None:
    """Write input.glb, gt.npz and gt.json into a folder, which is made.

    What is fixed to each other is one part. Parts that move and have no face are left out. Corners at one
    place are one, with the colour of the first, also between parts; faces that this leaves without an area
    are left out.

    Raises:
        BadInputError: nothing moves, or the base has no face.
    """
    whole, hidden = without_hidden(rigged.articulation(name).rigid())
    if whole.is_static or not (whole.labels == 0).any():
        raise BadInputError(f"'{name}': nothing moves, or what all hangs on has no face")
    check_truth(whole.links)
    placed, first = _welded(_grounded(whole, rigged))
    colors = np.clip(rigged.colors()[first], 0, 255).astype(np.uint8)
    notes = [*rigged.notes, *(f"moving part '{part}' has no face: left out" for part in hidden)]
    table = _table(placed, category or rigged.category, origin, notes)
    folder.mkdir(parents=True)
    (folder / f"{DEFAULT_VARIANT}.glb").write_bytes(_glb(placed, colors))
    np.savez_compressed(folder / LABELS, allow_pickle=False, **{FACE_PART: placed.labels})
    text = json.dumps(table, indent=1, allow_nan=False, ensure_ascii=False)
    (folder / TABLE).write_text(text + "\n", encoding="utf-8")


def _grounded(whole: Articulation, rigged: Rigged) -> Articulation:
    """In metres, +Y up, standing on the origin."""
    turn, shift = np.eye(4), np.eye(4)
    turn[:3, :3] = _y_up_from(rigged.up) * rigged.scale
    upright = whole.transformed(turn)
    low, high = upright.vertices.min(axis=0), upright.vertices.max(axis=0)
    middle = (low + high) / 2
    shift[:3, 3] = -middle[0], -low[1], -middle[2]
    return upright.transformed(shift)


def _welded(placed: Articulation) -> tuple[Articulation, IntArray]:
    """The object with one vertex a place, and which of its vertices (V,) those are."""
    size = float(np.ptp(placed.vertices, axis=0).max())
    first, same = unique_rows(np.round(placed.vertices / (size * _SAME)).astype(np.int64))
    kept = first[same][placed.faces]  # each place by the first vertex there
    a, b, c = kept.T
    whole = (a != b) & (b != c) & (a != c)
    used, faces = np.unique(kept[whole], return_inverse=True)
    welded = replace(
        placed,
        vertices=placed.vertices[used],
        faces=faces.reshape(-1, 3),
        labels=placed.labels[whole],
    )
    return welded, used


def _glb(placed: Articulation, colors: ByteArray) -> bytes:
    import trimesh

    mesh = trimesh.Trimesh(placed.vertices, placed.faces, process=False, vertex_colors=colors)
    data: bytes = mesh.export(file_type="glb")
    return data


def _table(placed: Articulation, category: str, origin: Origin, notes: list[str]) -> dict[str, Any]:
    return {
        "case": placed.name,
        "category": category,
        "source": origin.source,
        "version": origin.version,
        "file": origin.file,
        "licence": origin.licence,
        "terms": TERMS,
        "frame": {"up": "+Y", "metres_per_unit": 1.0},
        "parts": part_rows(placed.links),
        "notes": notes,
    }


def _y_up_from(up: UpAxis) -> FloatArray:
    return np.asarray(z_up_from("+y").T @ z_up_from(up))
