"""Segmenter `tokens`: parts that come as voxel tokens in a file, decoded and laid onto the mesh's faces."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Note, PartGuess, Segmentation, Segmenter
from simart_kit.errors import BadInputError
from simart_kit.segments import find_segments
from simart_kit.transfer import Transfer, TransferMode, transfer
from simart_kit.transfer.labels import AGREEMENT, ITERATIONS, SIGMA

from .codec import decode_tokens, object_frame, occupancy, part_seeds
from .default_model import load_model
from .tokens_evidence import Decoded, evidence
from .tokens_file import TokensFile, read_tokens_file

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import IntArray

    from .default_model import LoadedModel


class Tokens(Segmenter):
    """Parts as voxel tokens: decodes them, and gives each face the part that its surroundings vote for."""

    name = "tokens"

    class Options(simart_kit.Options):
        """Which tokens, and how they are laid onto the mesh."""

        file: str = Field(
            default="", description="Tokens file, as `simart-kit tokens` writes it; needed to run."
        )
        model: str = Field(
            default="", description="Folder of the model that wrote it; empty: the shipped one."
        )
        transfer: TransferMode = Field(
            default="segments",
            description="Label each face by itself (seeds), or also each segment that agrees (segments).",
        )
        sigma: float = Field(
            default=SIGMA,
            gt=0,
            allow_inf_nan=False,
            description="Reach of a seed [share of the bounding box's diagonal].",
        )
        iterations: int = Field(default=ITERATIONS, ge=0, description="Smoothing steps over the mesh.")
        agreement: float = Field(
            default=AGREEMENT, gt=0.5, le=1, description="Share of a segment's area that has to agree."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The file's parts on the mesh's faces.

        Raises:
            BadInputError: no file is named, it cannot be read, it is of another model, or a part decodes to
                nothing.
        """
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
        segments = find_segments(mesh)
        moved = transfer(
            mesh,
            part_seeds(decoded.parts, decoded.frame, names),
            mode=self.options.transfer,
            sigma=self.options.sigma,
            iterations=self.options.iterations,
            agreement=self.options.agreement,
            segments=segments,
        )
        labels = _without_lost(moved.face_part, file)
        return Segmentation(
            labels.face_part,
            labels.parts,
            face_segment=segments.face_segment,
            notes=(*_notes(path, loaded, file, decoded), *_transfer_notes(moved, names)),
            evidence=evidence(file, decoded, moved),
        )


@dataclass(frozen=True, eq=False)
class _Labels:
    face_part: IntArray
    parts: tuple[PartGuess, ...]


def _decoded(loaded: LoadedModel, file: TokensFile, mesh: Mesh) -> Decoded:
    frame = object_frame(mesh)
    grids = decode_tokens(loaded.model, [file.object, *(part.tokens for part in file.parts)])
    return Decoded(frame, occupancy(mesh.triangles, frame), grids[0], grids[1:])


def _without_lost(face_part: IntArray, file: TokensFile) -> _Labels:
    """Labels numbered without the parts that got no face; notes of the transfer tell of those."""
    used, numbered = np.unique(face_part, return_inverse=True)
    parts = [file.parts[part] for part in used.tolist()]
    guesses = tuple(PartGuess(part.name, part.label, part.material) for part in parts)
    return _Labels(numbered.reshape(-1).astype(np.int32), guesses)


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


def _transfer_notes(moved: Transfer, names: list[str]) -> list[Note]:
    """The transfer's own notes, parts by name."""
    texts = list(moved.notes)
    for part, name in enumerate(names):
        texts = [
            f"part '{name}' {text.removeprefix(f'part {part} ')}"
            if text.startswith(f"part {part} ")
            else text
            for text in texts
        ]
    return [Note("segment", "warning", text) for text in texts]
