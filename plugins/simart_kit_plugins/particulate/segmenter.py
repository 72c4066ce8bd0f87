"""Segmenter `particulate`: parts with joints by Particulate, on the faces of the mesh that was given."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from simart_kit import Note, Segmentation, Segmenter

from ..workers.options import WorkerOptions
from .system import PARTICULATE

if TYPE_CHECKING:
    from simart_kit import Mesh


class Particulate(Segmenter):
    """Parts and joints by Particulate, which you install: its `infer.py` is run."""

    name = "particulate"

    class Options(WorkerOptions):
        """How Particulate is asked; its random numbers do not follow the recipe's seed."""

        strict: bool = Field(
            default=True, description="Whether a connected piece is of one part; false for fused meshes."
        )
        min_part_confidence: float = Field(
            default=0.0, ge=0, le=1, description="Least confidence of a part, 0..1."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The root as the body, and the parts that hang on it; joints are hints.

        Raises:
            BadInputError: Particulate is not where options or variables say, and the cache has no answer.
            WorkerError: Particulate failed, took too long, or its answer makes no sense.
        """
        from ..adapters.laying import on_faces
        from ..adapters.stated_joints import stated
        from ..workers.asking import answer
        from ..workers.caching import AnswerCache, answer_key, cache_folder
        from ..workers.surface import sent_surface
        from .program import VERSION, ParticulateProgram

        options, sent = self.options, sent_surface(mesh, "+z")
        fused = () if options.strict else ("--no_strict",)
        arguments = ("--min_part_confidence", f"{options.min_part_confidence:g}", *fused)
        program = ParticulateProgram(mesh, sent, options.python, options.folder, arguments)
        key = answer_key(self.name, VERSION, {"arguments": arguments}, sent)
        cache = AnswerCache(cache_folder(options.cache, self.name))
        found = answer(program, key, len(mesh.faces), options.timeout, cache)
        whole, missing = on_faces(found, mesh)
        told = stated(whole)
        info = [
            f"{PARTICULATE.name} found {len(told.parts)} parts; its answer is {key}.npz in the cache",
            PARTICULATE.licence,
        ]
        if missing:
            info.append(f"{missing} of {len(mesh.faces)} faces are of no part: they go with their neighbours")
        return Segmentation(
            told.face_part,
            told.parts,
            joints=told.hints,
            notes=(
                *(Note("segment", "info", text) for text in info),
                *(Note("segment", "warning", text) for text in told.notes),
            ),
        )
