"""Pieces by any other segmenter: its own finer ones, or its parts."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from simart_kit import Mesh, Note, Segmenter
from simart_kit.arrays import IntArray
from simart_kit.assemble import checked
from simart_kit.errors import BadInputError
from simart_kit.plugins import Plugins
from simart_kit.recipe import Use, build

from .pieces import numbered_pieces
from .proposer import Proposer


@dataclass(frozen=True, eq=False)
class Proposed:
    """Pieces of a mesh.

    Attributes:
        mesh: that they are of; cut where the proposer cut it.
        piece: (F,) int32 pieces 0..N-1, largest first.
        notes: of the proposer, and of what became of its pieces.
        cut: whether the mesh is not the one that was given.
    """

    mesh: Mesh
    piece: IntArray
    notes: tuple[Note, ...]
    cut: bool


def proposed(
    mesh: Mesh, proposer: Proposer, plugins: Plugins, seed: int, most: int, crease: float
) -> Proposed:
    """Run a proposer and cut or join its pieces, so that they can be numbered.

    Args:
        mesh: in the canonical frame.
        proposer: which segmenter.
        plugins: where it is found.
        seed: of its random generators.
        most: of pieces.
        crease: edges sharper than this bound pieces as well [rad]; pi: none does.

    Raises:
        UnknownPluginError, RecipeError: there is no such segmenter, or it has no such options.
        BadInputError: it cannot be run as it is set up.
        StageError: it failed.
    """
    stage, registration = build(Use(use=proposer.use, options=proposer.options), Segmenter, plugins, seed)
    try:
        found = checked(stage.segment(mesh), mesh)
    except BadInputError as cause:
        raise BadInputError(
            f"proposer {proposer.use}: {cause} (its options are in segmenter.options.proposer.options; "
            'any segmenter will do, such as --set segmenter.options.proposer={use="geometric"})'
        ) from cause
    except Exception as cause:
        raise registration.failure(cause) from cause
    surface = found.mesh_of(mesh)
    given = found.face_part if found.face_segment is None else found.face_segment
    # Its parts bound pieces too: a part may end inside one of its pieces.
    _, both = np.unique(np.stack([given, found.face_part]), axis=1, return_inverse=True)
    both = both.reshape(-1)
    piece = numbered_pieces(surface, both, most, crease)
    told = f"{int(both.max()) + 1} pieces by {proposer.use}, {int(piece.max()) + 1} to number"
    # What it says of parts is of its own, and not of the links that are made of them.
    said = (replace(note, text=f"{proposer.use}: {note.text}") for note in found.notes)
    return Proposed(surface, piece, (*said, Note("segment", "info", told)), cut=found.mesh is not None)
