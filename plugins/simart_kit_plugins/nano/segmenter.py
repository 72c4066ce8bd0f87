"""Segmenter `nano`: a small network that says which pieces move together, and how."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Joint, Limits, Note, PartGuess, Segmentation, Segmenter
from simart_kit.arrays import frozen_ints, vec3
from simart_kit.asset import clean_name, unique_names
from simart_kit.errors import BadInputError
from simart_kit.segments import find_segments

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import IntArray

    from .meshes import MeshCloud
    from .predicting import PredictedPart, Prediction


class Nano(Segmenter):
    """Parts and joints by a small network that was trained on made-up objects."""

    name = "nano"

    class Options(simart_kit.Options):
        """Which weights, and how sure they have to be."""

        model: str = Field(
            default="", description="Folder of the weights, such as `train nano` writes; needed."
        )
        least: float = Field(
            default=0.4, ge=0, le=1, description="Parts less sure than this stay with the body."
        )
        seed: int = Field(default=0, ge=0, description="Of the places that the surface is looked at.")

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The body as part 0, then each part that moves, with its joint as a hint.

        Raises:
            BadInputError: no weights are named, or they cannot be read.
        """
        if not self.options.model:
            raise BadInputError(
                "no weights are named: add --set segmenter.options.model=RUN/model, "
                "which `simart-kit train nano --run RUN` writes"
            )
        from .meshes import mesh_cloud
        from .predicting import predict
        from .weights import load_network

        network = load_network(Path(self.options.model))
        segments = find_segments(mesh)
        seen = mesh_cloud(mesh, segments, np.random.default_rng(self.options.seed))
        said = predict(network, seen.cloud, self.options.least)
        face_part, parts = _shown(said, seen)
        names = unique_names(["body", *(clean_name(part.label or "part") for part in parts)])
        guesses = [
            PartGuess(name, label=part.label, score=part.score)
            for name, part in zip(names[1:], parts, strict=True)
        ]
        hints = [
            _joint(part, name, names[part.parent], seen) for part, name in zip(parts, names[1:], strict=True)
        ]
        return Segmentation(
            frozen_ints(face_part),
            (PartGuess(names[0], label="body"), *guesses),
            joints=tuple(hints),
            face_segment=frozen_ints(seen.face_piece.astype(np.int32)),
            notes=_notes(said, seen),
        )


def _shown(said: Prediction, seen: MeshCloud) -> tuple[IntArray, list[PredictedPart]]:
    """(F,) part of each face, and the parts that have faces, in the order of their numbers from 1."""
    label = said.piece_part[seen.face_piece]
    if label.all():  # the body's patches are the middle of no face
        label = np.where(label == np.bincount(label).argmax(), 0, label)
    kept = [number for number in range(1, len(said.parts) + 1) if (label == number).any()]
    place = {0: 0} | {number: k for k, number in enumerate(kept, start=1)}
    numbers = np.array([place.get(number, 0) for number in range(len(said.parts) + 1)], dtype=np.int32)
    parts = [said.parts[number - 1] for number in kept]
    return numbers[label], [replace(part, parent=place.get(part.parent, 0)) for part in parts]


def _joint(part: PredictedPart, name: str, parent: str, seen: MeshCloud) -> Joint:
    scale = seen.size if part.kind == "prismatic" else 1.0
    limited = part.kind in ("revolute", "prismatic")
    return Joint(
        f"{name}_joint",
        part.kind,
        parent,
        name,
        vec3(part.origin * seen.size + seen.center),
        vec3(part.axis),
        Limits(part.lower * scale, part.upper * scale) if limited else None,
        confidence=part.confidence,
        evidence=(f"simart-nano: {part.confidence:.2f} sure of kind and axis",),
    )


def _notes(said: Prediction, seen: MeshCloud) -> tuple[Note, ...]:
    kind = "patches of one skin" if seen.skin else "pieces that lie apart"
    what = f"taken for a {said.category} ({said.category_score:.2f})" if said.category else "of no known kind"
    return (
        Note("segment", "info", f"{seen.cloud.count} {kind}; {what}, about {said.size:.2g} m"),
        Note("segment", "info", f"{len(said.parts)} moving parts"),
    )
