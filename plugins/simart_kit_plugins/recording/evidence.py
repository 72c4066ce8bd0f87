"""Evidence of a stage in the recording: each piece an entity `evidence/NAME`, and its view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from simart_kit.arrays import ByteArray, Float32Array, FloatArray, IntArray
from simart_kit.asset import clean_name, unique_names
from simart_kit.colors import part_color
from simart_kit.evidence import (
    Evidence,
    PictureEvidence,
    PointEvidence,
    TextEvidence,
    VertexEvidence,
    VoxelEvidence,
)
from simart_kit.mesh import Mesh

from .colors import segment_colors
from .meshes import mesh3d
from .tape import Tape
from .text import readable

# Of two kinds, such as missing and added; more have the colours of segments.
_FEW = ((226, 61, 98), (37, 116, 232), (242, 138, 18), (22, 163, 98))
# Shares below this are not drawn: else every part would draw the whole mesh.
_LEAST = 0.01
# From no share to a whole one, for eyes of every kind: dark blue, green, yellow (after Viridis).
_SCALE = np.array(
    [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], dtype=np.float64
)


@dataclass(frozen=True)
class EvidenceView:
    """A view that a piece of evidence needs.

    Attributes:
        name: for people.
        origin: entity that it shows; each of `tabs` lies below it.
        tabs: of a piece that holds several pictures, (entity, name) of each; none for one picture.
        kind: what it shows: things in space, a picture, or words.
    """

    name: str
    origin: str
    tabs: tuple[tuple[str, str], ...] = ()
    kind: Literal["space", "picture", "words"] = "space"


def evidence_views(evidence: Sequence[Evidence]) -> tuple[EvidenceView, ...]:
    """The views of all pieces, in their order."""
    origins = _below("evidence", [piece.name for piece in evidence])
    views = []
    for origin, piece in zip(origins, evidence, strict=True):
        title = readable(_title(piece))
        if isinstance(piece, VertexEvidence) and len(piece.names) > 1:
            tabs = zip(_below(origin, piece.names), map(readable, piece.names), strict=True)
            views.append(EvidenceView(title, origin, tuple(tabs)))
        elif isinstance(piece, PictureEvidence):
            views.append(EvidenceView(title, origin, kind="picture"))
        elif isinstance(piece, TextEvidence):
            views.append(EvidenceView(title, origin, kind="words"))
        else:
            views.append(EvidenceView(title, origin))
    return tuple(views)


def log_evidence(tape: Tape, mesh: Mesh, shaded: Mesh, evidence: Sequence[Evidence]) -> None:
    """Log every piece.

    Args:
        tape: where to.
        mesh: whose vertices the evidence is of.
        shaded: the same faces with normals, vertices at creases split.
        evidence: of one stage.
    """
    import rerun as rr

    for view, piece in zip(evidence_views(evidence), evidence, strict=True):
        if isinstance(piece, VoxelEvidence):
            _log_voxels(tape, view.origin, piece)
        elif isinstance(piece, PointEvidence):
            _log_points(tape, view.origin, piece)
        elif isinstance(piece, TextEvidence):
            tape.static(view.origin, rr.TextDocument(readable(piece.markdown), media_type="text/markdown"))
        elif isinstance(piece, PictureEvidence):
            tape.static(view.origin, rr.Image(piece.pixels, color_model="RGB"))
        else:
            entities = [entity for entity, _ in view.tabs] or [view.origin]
            values = np.zeros((len(shaded.vertices), len(piece.names)), dtype=np.float32)
            values[shaded.faces.ravel()] = piece.values[mesh.faces.ravel()]
            for entity, shares in zip(entities, values.T, strict=True):
                _log_shares(tape, entity, shaded, shares)


def _log_voxels(tape: Tape, path: str, piece: VoxelEvidence) -> None:
    """A grid of cells; one without cells stays an empty view."""
    import rerun as rr

    if not len(piece.indices):
        return
    colors = _kind_colors(piece) if piece.categorical else _scaled(piece.values)
    tape.static(
        path,
        rr.VoxelGridMap(
            piece.indices, [piece.frame.voxel_size] * 3, colors=colors, translation=piece.frame.origin
        ),
    )


def _log_points(tape: Tape, path: str, piece: PointEvidence) -> None:
    """An entity a group, so that one can be hidden; a name stands in the middle of its points."""
    import rerun as rr

    for index, (entity, name) in enumerate(zip(_below(path, piece.names), piece.names, strict=True)):
        points = piece.points[piece.group == index]
        if not len(points):
            continue
        color = part_color(index)
        tape.static(entity, rr.Points3D(points, radii=rr.Radius.ui_points(2.0), colors=color))
        label = rr.Points3D(
            [points.mean(axis=0)],
            radii=rr.Radius.ui_points(3.0),
            colors=color,
            labels=readable(name),
            show_labels=True,
        )
        tape.static(f"{entity}/label", label)


def _log_shares(tape: Tape, path: str, mesh: Mesh, shares: Float32Array) -> None:
    """The faces with a share at any corner, coloured by it."""
    faces = mesh.faces[(shares[mesh.faces] > _LEAST).any(axis=1)]
    if not len(faces):
        return
    used, corners = np.unique(faces, return_inverse=True)
    assert mesh.normals is not None
    colors = _on_scale(shares[used].astype(np.float64))
    tape.static(path, mesh3d(mesh.vertices[used], corners, mesh.normals[used], colors=colors))


def _title(piece: Evidence) -> str:
    """The name, with a legend where kinds have names."""
    if not isinstance(piece, VoxelEvidence) or not piece.names:
        return piece.name
    counts = np.bincount(np.asarray(piece.values, dtype=np.int64), minlength=len(piece.names))
    told = ", ".join(f"{count} {name}" for count, name in zip(counts, piece.names, strict=True))
    return f"{piece.name}: {told}"


def _kind_colors(piece: VoxelEvidence) -> ByteArray:
    """(K, 3) colours: the same kind has the same one in every recording."""
    if 0 < len(piece.names) <= len(_FEW):
        return np.array(_FEW, dtype=np.uint8)[piece.values]
    return segment_colors(int(piece.values.max()) + 1)[piece.values]


def _scaled(values: FloatArray | IntArray) -> ByteArray:
    """(K, 3) colours from the least to the greatest value."""
    low, high = float(values.min()), float(values.max())
    shares = (values - low) / (high - low if high > low else 1.0)
    return _on_scale(np.asarray(shares, dtype=np.float64))


def _on_scale(shares: FloatArray) -> ByteArray:
    """(K, 3) colours of shares 0..1."""
    places = np.clip(shares, 0, 1) * (len(_SCALE) - 1)
    channels = [np.interp(places, np.arange(len(_SCALE)), channel) for channel in _SCALE.T]
    return np.stack(channels, axis=1).round().astype(np.uint8)


def _below(path: str, names: Sequence[str]) -> list[str]:
    """Entities of names, which may hold any character."""
    return [f"{path}/{name}" for name in unique_names([clean_name(name, "evidence") for name in names])]
