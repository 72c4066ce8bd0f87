"""What `ground` writes: the part as GLB, a picture, its faces, and why it was chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from .arrays import FloatArray
from .asset import Asset, Part, clean_name
from .drawing.highlight import highlight_png
from .exports import export_one
from .face_sources import face_sources
from .grounding import Grounding
from .loading import Source
from .mesh import Note
from .output import PROVENANCE, commit, hashes, left_over, staging
from .plugins import Plugins, Registration
from .provenance import provenance, write_json
from .recipe import Recipe, Use, build
from .stages import Exporter
from .submesh import submesh

PART, PICTURE, LABELS, TABLE = "part.glb", "picture.png", "labels.npz", "grounding.json"
_FORMAT = "glb"


@dataclass(frozen=True)
class Origin:
    """What a grounding was made of, for its provenance.

    Attributes:
        path: the source file.
        source: the file as read.
        recipe: resolved.
        segmenter: which one found the part.
        arguments: further ones of the call.
    """

    path: Path
    source: Source
    recipe: Recipe
    segmenter: Registration
    arguments: Mapping[str, Any]


def write_grounding(found: Grounding, origin: Origin, plugins: Plugins, out: Path) -> Grounding:
    """Write a grounding's folder; the files appear together, or none.

    Returns:
        The grounding, with its paths and notes on what was in the way.

    Raises:
        OutputError: the folder cannot be written.
        PluginError: no exporter writes GLB.
        StageError: it failed.
    """
    with staging(out) as work:
        exporter = _write_part(found, plugins, work)
        (work / PICTURE).write_bytes(highlight_png(found.mesh, found.grounded.faces))
        _write_labels(found, origin.source, work)
        write_json(work / TABLE, table(found))
        earlier = left_over(work, out)
        record = provenance(
            source=origin.path,
            source_hash=origin.source.sha256,
            recipe=origin.recipe,
            used=(origin.segmenter, exporter),
            failures=plugins.failures,
            outputs=hashes(work),
            earlier_outputs=earlier,
            seconds=(),
            usage=[("segment", origin.segmenter.name, used) for used in found.grounded.usage],
            arguments=origin.arguments,
        )
        write_json(work / PROVENANCE, record)
        kept = commit(work, out)
    names = {"part": PART, "picture": PICTURE, "labels": LABELS, "grounding": TABLE, "provenance": PROVENANCE}
    notes = found.notes + tuple(Note("output", "warning", text) for text in kept)
    return replace(found, paths={key: out / name for key, name in names.items()}, folder=out, notes=notes)


def table(found: Grounding) -> dict[str, Any]:
    """The grounding as plain values, for grounding.json and `--json`."""
    grounded, mesh = found.grounded, found.mesh
    corners = mesh.triangles[grounded.faces].reshape(-1, 3)
    return {
        "schema": 1,
        "description": found.description,
        "score": grounded.score,
        "reason": grounded.reason,
        "parts": [candidate.name for candidate in grounded.candidates if candidate.chosen],
        "faces": int(grounded.faces.sum()),
        "faces_of_object": len(mesh.faces),
        "area": round(float(mesh.face_areas[grounded.faces].sum()), 9),
        "area_share": round(found.area_share, 6),
        "bounds": [_rounded(corners.min(axis=0)), _rounded(corners.max(axis=0))],
        "asset_from_source": found.asset_from_source.tolist(),
        "candidates": [
            {"name": c.name, "score": c.score, "chosen": c.chosen, "reason": c.reason}
            for c in grounded.candidates
        ],
        "notes": [f"{note.stage}: {note.text}" for note in found.notes],
    }


def _write_part(found: Grounding, plugins: Plugins, work: Path) -> Registration:
    """Write the faces found as an asset of one part, in the frame of the object; returns who wrote it."""
    mesh = replace(submesh(found.mesh, found.grounded.faces), notes=())
    part = Part(clean_name(found.description), description=found.description)
    face_part = np.zeros(len(mesh.faces), dtype=np.int32)
    asset = Asset("part", mesh, face_part, (part,), asset_from_source=found.asset_from_source)
    stage, registration = build(Use(use=_FORMAT), Exporter, plugins, 0)
    try:
        exported = export_one(asset, stage, work / _FORMAT)
    except (Exception, SystemExit) as cause:
        raise registration.failure(cause) from cause
    exported.main.replace(work / PART)
    exported.main.parent.rmdir()
    return registration


def _write_labels(found: Grounding, source: Source, work: Path) -> None:
    """The arrays; part ids are -1 where no parts were made, as those of faces that no part has."""
    grounded = found.grounded
    none = np.full(len(grounded.faces), -1, dtype=np.int32)
    np.savez_compressed(
        work / LABELS,
        allow_pickle=False,
        faces=grounded.faces,
        face_part=none if grounded.face_candidate is None else grounded.face_candidate,
        source_face=face_sources(found.mesh, source.mesh),
    )


def _rounded(point: FloatArray) -> list[float]:
    return [round(float(value), 9) + 0.0 for value in point]
