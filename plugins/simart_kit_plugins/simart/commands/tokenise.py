"""A mesh file to tokens and their measures: the steps of the command `tokens`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.loading import read_source, source_path
from simart_kit.plugins import Plugins

from ..codec import decode_tokens, encode_grids, object_grids
from ..default_model import load_model
from ..tokens_file import PartTokens, TokensFile
from .part_labels import part_labels
from .token_rows import Row, mean, row


@dataclass(frozen=True, eq=False)
class Tokenised:
    """What was made of a mesh.

    Attributes:
        file: its tokens.
        whole, parts, mean: measures of the object, of each part, and the mean of the parts.
        source: where the parts come from, for people.
        folder: of the model.
        warnings: parts that do not come back from their tokens.
    """

    file: TokensFile
    whole: Row
    parts: tuple[Row, ...]
    mean: Row
    source: str
    folder: Path
    warnings: tuple[str, ...]


def tokenise(
    mesh: Path, parts: Path | None, recipe: str | None, model: Path | None, plugins: Plugins
) -> Tokenised:
    """Read a mesh and a model, encode object and parts, decode them again and measure.

    Args:
        mesh: a mesh file.
        parts: labels or an asset's folder; see `part_labels`.
        recipe: whose segmenter finds the parts.
        model: folder of a model; None for the shipped one.
        plugins: loaders and segmenters.

    Raises:
        BadInputError: mesh, labels or model cannot be read, or do not fit each other.
        StageError: the segmenter failed.
    """
    path = source_path(mesh)
    loaded = load_model(model)
    surface = read_source(path, plugins).mesh
    labels = part_labels(path, surface, parts, recipe, plugins)
    names = [part.name for part in labels.parts]
    made = object_grids(labels.mesh or surface, labels.face_part, names)
    grids = np.concatenate([made.whole[None], made.parts])
    tokens = encode_grids(loaded.model, grids)
    decoded = decode_tokens(loaded.model, tokens)
    rows = [
        row(name, one, true, back)
        for name, one, true, back in zip([path.stem, *names], tokens, grids, decoded, strict=True)
    ]
    described = zip(labels.parts, tokens[1:], strict=True)
    file = TokensFile(
        loaded.fingerprint,
        tokens[0],
        tuple(PartTokens(part.name, one, part.label, part.material) for part, one in described),
    )
    gone = [r.name for r, back in zip(rows, decoded, strict=True) if not back.any()]
    return Tokenised(
        file,
        rows[0],
        tuple(rows[1:]),
        mean(rows[1:], f"mean of {len(names)} part{'s' * (len(names) != 1)}"),
        labels.source,
        loaded.folder,
        tuple(f"'{name}' decodes to no voxel: another model is needed for it" for name in gone),
    )
