"""What a file says that its surfaces are of, by what its materials are called and what one sees through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .material_words import rows_meant, words_of
from .mesh import Note

if TYPE_CHECKING:
    from .arrays import IntArray
    from .mesh import Mesh, VisualMaterial
    from .stages import PartGuess, Segmentation

# Share of a part's surface that has to be of a material that the file tells.
_MOSTLY = 0.5
# What is less opaque is glass, if it is not called otherwise.
_CLEAR = 0.6
# A material of this share of the surface may be called as the object is, "Glass Cabinet".
_WHOLE = 0.95
# What materials are called besides what they are of.
_IDLE = frozenset(["m", "mi", "mt", "mtl", "mat", "material", "materials", "shader", "tex", "texture"])


def as_told(found: Segmentation, given: Mesh) -> Segmentation:
    """A segmentation with the materials that the file of the `given` mesh tells; those stated stay."""
    telling = told_materials(found.mesh_of(given), found.face_part)
    open_to_it = [k for k, guess in enumerate(found.parts) if not guess.material_stated]
    told = {k: telling[k] for k in open_to_it if k in telling}
    parts = tuple(replace(p, material=told.get(k, p.material)) for k, p in enumerate(found.parts))
    guessed = [parts[k] for k in open_to_it if k not in told]
    notes = (
        *_named("materials as the file tells", [parts[k] for k in told]),
        *_named("materials are guesses ([physics] of a recipe states others)", guessed),
    )
    return replace(found, parts=parts, notes=(*found.notes, *notes))


def _named(text: str, parts: Sequence[PartGuess]) -> tuple[Note, ...]:
    words = ", ".join(f"{part.name} {part.material}" for part in parts)
    return (Note("segment", "info", f"{text}: {words}"),) if parts else ()


def told_materials(mesh: Mesh, face_part: IntArray) -> Mapping[int, str]:
    """Keys of the material table by part, of parts that are mostly of what the file tells.

    Args:
        mesh: with the materials of its file.
        face_part: (F,) part of each face.
    """
    areas = mesh.face_areas
    shares = np.bincount(mesh.face_material, areas, minlength=len(mesh.materials)) / max(areas.sum(), 1e-30)
    stuffs = [_stuff(m, share >= _WHOLE) for m, share in zip(mesh.materials, shares, strict=True)]
    known = sorted({stuff for stuff in stuffs if stuff})
    if not known:
        return {}
    row = np.array([known.index(stuff) if stuff else len(known) for stuff in stuffs])[mesh.face_material]
    count = len(known) + 1
    parts = int(face_part.max()) + 1
    table = np.bincount(face_part * count + row, areas, minlength=parts * count).reshape(parts, count)
    best = table[:, :-1].argmax(1)
    mostly = table[np.arange(parts), best] > _MOSTLY * table.sum(1)
    return {int(part): known[best[part]] for part in np.flatnonzero(mostly)}


def _stuff(material: VisualMaterial, whole: bool) -> str:
    """Key of the material table, or "" where the file does not tell."""
    words = [word for word in words_of(material.name) if word not in _IDLE]
    meant = [rows for word in words if (rows := rows_meant(word))]
    if not meant:
        return "glass" if material.base_color[3] < _CLEAR and material.base_color_image is None else ""
    if whole and not rows_meant(words[-1]):
        return ""  # the last word is the object's
    agreed = [row for row in meant[0] if all(row in others for others in meant)]
    return agreed[0] if agreed else ""
