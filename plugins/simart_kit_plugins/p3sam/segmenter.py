"""Segmenter `p3sam`: the parts that P3-SAM sees, each with a face or more of the mesh that was given."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from simart_kit import Note, PartGuess, Segmentation, Segmenter
from simart_kit.arrays import frozen_ints

from ..workers.options import WorkerOptions
from .system import P3SAM

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import FloatArray, IntArray


class P3Sam(Segmenter):
    """Parts by P3-SAM, of a Hunyuan3D-Part that you install; it finds many and names none."""

    name = "p3sam"

    class Options(WorkerOptions):
        """How P3-SAM is asked; its seed is the recipe's."""

        threshold: float = Field(default=0.95, gt=0, le=1, description="P3-SAM's threshold of overlap, 0..1.")
        post_process: bool = Field(default=True, description="Whether P3-SAM joins small pieces to others.")
        prompt_batch: int = Field(
            default=32, ge=1, le=400, description="Prompts at once; fewer take less GPU memory."
        )
        checkpoint: str = Field(default="", description="File of weights; empty: P3-SAM downloads its own.")
        max_parts: int = Field(
            default=64, ge=1, description="Most parts; smaller ones are joined to what is beside them."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The largest part as the body, then the others by their area.

        Raises:
            BadInputError: P3-SAM is not where options or variables say, and the cache has no answer.
            WorkerError: P3-SAM failed, took too long, or its answer makes no sense.
        """
        from ..adapters.laying import filled
        from ..workers.asking import answer
        from ..workers.caching import AnswerCache, answer_key, cache_folder
        from ..workers.surface import sent_surface
        from .program import VERSION, P3SamProgram

        options, sent = self.options, sent_surface(mesh, "+y")
        asked = {
            "seed": self.seed,
            "threshold": options.threshold,
            "post_process": options.post_process,
            "prompt_batch": options.prompt_batch,
            "checkpoint": options.checkpoint,
        }
        program = P3SamProgram(mesh, sent, options.python, options.folder, asked)
        key = answer_key(self.name, VERSION, asked, sent)
        cache = AnswerCache(cache_folder(options.cache, self.name))
        labels = answer(program, key, len(mesh.faces), options.timeout, cache)
        pieces = _by_area(filled(labels, mesh) if (labels >= 0).any() else labels, mesh.face_areas)
        kept = np.where(pieces < options.max_parts, pieces, -1)
        face_part = _by_area(filled(kept, mesh), mesh.face_areas)
        return Segmentation(
            frozen_ints(face_part),
            tuple(_guess(number) for number in range(int(face_part.max()) + 1)),
            face_segment=frozen_ints(pieces),
            notes=_notes(mesh, labels, int(pieces.max()) + 1, options.max_parts, key),
        )


def _by_area(labels: IntArray, areas: FloatArray) -> IntArray:
    """(F,) labels numbered anew, the largest 0."""
    _, which = np.unique(labels, return_inverse=True)
    order = np.argsort(-np.bincount(which, areas), kind="stable")
    return np.asarray(np.argsort(order)[which])


def _guess(number: int) -> PartGuess:
    return PartGuess(f"part_{number}") if number else PartGuess("body", label="body")


def _notes(mesh: Mesh, labels: IntArray, found: int, most: int, key: str) -> tuple[Note, ...]:
    """What was found and how, what was filled, and the licence."""
    notes = [
        Note("segment", "info", f"{P3SAM.name} found {found} parts; its answer is {key}.npz in the cache"),
        Note("segment", "info", P3SAM.licence),
    ]
    none = labels < 0
    if none.all():
        notes.append(Note("segment", "warning", f"{P3SAM.name} saw no part: the object stays one"))
    elif none.any():
        share = mesh.face_areas[none].sum() / mesh.face_areas.sum()
        text = f"{share:.1%} of the surface was in no part, and got the one that is nearest over the surface"
        notes.append(Note("segment", "info", text))
    if found > most:
        text = f"{found - most} of the parts, the smallest, were joined to what is beside them (max_parts)"
        notes.append(Note("segment", "info", text))
    return tuple(notes)
