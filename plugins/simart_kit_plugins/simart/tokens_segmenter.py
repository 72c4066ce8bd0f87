"""Segmenter `tokens`: parts that come as voxel tokens in a file, decoded and laid onto the mesh's faces."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from simart_kit import Note, PartGuess, Segmentation, Segmenter
from simart_kit.errors import BadInputError

from .labelling import TransferOptions, labelled

if TYPE_CHECKING:
    from simart_kit import Mesh

    from .default_model import LoadedModel
    from .tokens_evidence import Decoded
    from .tokens_file import TokensFile


class Tokens(Segmenter):
    """Parts as voxel tokens: decodes them, and gives each face the part that its surroundings vote for."""

    name = "tokens"

    class Options(TransferOptions):
        """Which tokens, and how they are laid onto the mesh."""

        file: str = Field(
            default="", description="Tokens file, as `simart-kit tokens` writes it; needed to run."
        )
        model: str = Field(
            default="", description="Folder of the model that wrote it; empty: the shipped one."
        )

        def needed_extras(self) -> tuple[str, ...]:
            """That of the voxel model."""
            return ("torch",)

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The file's parts on the mesh's faces.

        Raises:
            BadInputError: no file is named, it cannot be read, it is of another model, or a part decodes to
                nothing.
        """
        from .codec import part_seeds
        from .default_model import load_model
        from .tokens_evidence import evidence
        from .tokens_file import read_tokens_file

        if not self.options.file:
            raise BadInputError(
                "no tokens file is named: add --set segmenter.options.file=parts.tokens.json, "
                "which `simart-kit tokens MESH --out parts.tokens.json` writes"
            )
        path = Path(self.options.file)
        loaded = load_model(Path(self.options.model) if self.options.model else None)
        file = read_tokens_file(path, loaded.fingerprint)
        decoded = _decoded(loaded, file, mesh)
        names = [part.name for part in file.parts]
        labels = labelled(mesh, part_seeds(decoded.parts, decoded.frame, names), names, self.options)
        parts = [file.parts[part] for part in labels.kept]
        return Segmentation(
            labels.face_part,
            tuple(PartGuess(part.name, part.label, part.material, material_stated=True) for part in parts),
            face_segment=labels.segments.face_segment,
            notes=(*_notes(path, loaded, file, decoded), *labels.notes),
            evidence=evidence(file, decoded, labels.moved),
        )


def _decoded(loaded: LoadedModel, file: TokensFile, mesh: Mesh) -> Decoded:
    from .codec import decode_tokens, object_frame, occupancy
    from .tokens_evidence import Decoded

    frame = object_frame(mesh)
    grids = decode_tokens(loaded.model, [file.object, *(part.tokens for part in file.parts)])
    return Decoded(frame, occupancy(mesh.triangles, frame), grids[0], grids[1:])


def _notes(path: Path, loaded: LoadedModel, file: TokensFile, decoded: Decoded) -> list[Note]:
    """What was read, and whether it seems to be of this mesh."""
    count = sum(len(part.tokens.index) for part in file.parts)
    told = f"{len(file.parts)} parts of {path.name}: {count} tokens of model {loaded.fingerprint}"
    notes = [Note("segment", "info", told)]
    here = np.flatnonzero(file.object.grid.occupied_cells(decoded.mesh))
    differ = len(np.setxor1d(here, file.object.index))
    if differ:
        text = (
            f"{differ} cells are occupied in the mesh or in {path.name} alone: "
            "check that the tokens are of this mesh and up axis"
        )
        notes.append(Note("segment", "warning", text))
    return notes
