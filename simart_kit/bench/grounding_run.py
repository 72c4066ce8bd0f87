"""Part grounding on objects with ground truth: a recipe against the nearest name and the largest part."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

import numpy as np

from ..arrays import BoolArray, IntArray
from ..assemble import checked
from ..errors import BadInputError, SimartKitError, StageError
from ..face_sources import face_sources
from ..grounding import Grounded, Grounder, by_names, find_part, named_parts
from ..loading import Source, read_source
from ..mesh import Mesh
from ..part_matching import nearest_name
from ..plugins import Plugins, Registration
from ..recipe import Recipe, build, check_extras
from ..stages import Segmentation, Segmenter
from .articulation import Articulation, Link
from .cases import Truth
from .formats import find_truths
from .frame import same_faces
from .grounding import Grounding, score_grounding

SYSTEMS = ("recipe", "nearest name", "largest part")


@dataclass(frozen=True)
class PartScores:
    """How well the systems find a part.

    Attributes:
        object: its name.
        part: name of the true part.
        description: what was asked for.
        scores: of each of `SYSTEMS`.
        failed: why the recipe gave no answer, in one line, or "": it then counts as not found.
    """

    object: str
    part: str
    description: str
    scores: tuple[Grounding, ...]
    failed: str = ""


@dataclass(frozen=True)
class ObjectScores:
    """What came of an object.

    Attributes:
        name: of the object.
        parts: a row a part that can be described.
        failed: why there are none, in one line, or "".
    """

    name: str
    parts: tuple[PartScores, ...] = ()
    failed: str = ""


def descriptions(links: Sequence[Link]) -> dict[int, str]:
    """By index, "the <name>" of each part whose name is the only one of its kind in the object."""
    words = [re.sub(r"[_\W]*\d+$", "", link.name).replace("_", " ").strip() for link in links]
    alone = Counter(words)
    return {i: f"the {word}" for i, word in enumerate(words) if word and alone[word] == 1}


def grounding_scores(
    data: Path, recipe: Recipe, baseline: Recipe, plugins: Plugins, only: Iterable[str] = ()
) -> Iterator[ObjectScores]:
    """Score every part of every object that a description names.

    A part that is not found counts as no face: IoU 0, and half the object's diagonal as CD.

    Args:
        data: folder of objects with ground truth.
        recipe: whose segmenter is scored.
        baseline: whose segmenter makes the parts of "nearest name" and "largest part".
        plugins: where to find the stages.
        only: patterns of object names; none means all.

    Raises:
        BadInputError: there is no object of such a name, or a segmenter lacks an extra.
    """
    patterns = tuple(only)
    truths = find_truths(data)
    names = [n for n in truths if not patterns or any(fnmatchcase(n, p) for p in patterns)]
    if not names:
        raise BadInputError(f"{data}: no object is named like {', '.join(patterns)}")
    check_extras([("segmenter", r.segmenter) for r in (recipe, baseline)], plugins)
    stages = [build(r.segmenter, Segmenter, plugins, r.seed) for r in (recipe, baseline)]
    for name in names:
        reader, path = truths[name]
        try:
            yield ObjectScores(name, _scored(reader.read(path), stages, recipe == baseline, plugins))
        except SimartKitError as error:
            yield ObjectScores(name, failed=" ".join(str(error).split()))


def means(objects: Iterable[ObjectScores]) -> dict[str, Grounding]:
    """Mean IoU and CD of each of `SYSTEMS` over all parts; empty where there is none."""
    scores = [part.scores for found in objects for part in found.parts]
    if not scores:
        return {}
    return {
        system: Grounding(
            float(np.mean([row[i].iou for row in scores])), float(np.mean([row[i].cd for row in scores]))
        )
        for i, system in enumerate(SYSTEMS)
    }


def _scored(
    truth: Truth, stages: Sequence[tuple[Segmenter, Registration]], alike: bool, plugins: Plugins
) -> tuple[PartScores, ...]:
    if truth.mesh is None:
        raise BadInputError(f"'{truth.name}' has no mesh file")
    loaded = read_source(truth.mesh, plugins, truth.up, truth.metres_per_unit)
    labels = _labels(truth, loaded)
    (asked, registration), basis = stages
    parts = _segmented(basis, loaded.mesh)
    named = None
    if not isinstance(asked, Grounder):
        named = parts if alike else _segmented(stages[0], loaded.mesh)
    rows = []
    for index, description in descriptions(truth.articulation.links).items():
        if not loaded.mesh.face_areas[labels == index].sum() > 0:
            continue  # a part that nobody can see
        if named is None:
            found, failed = _asked(asked, registration, loaded.mesh, description)
        else:
            found, failed = by_names(named, loaded.mesh, description), ""
        answers = (found, _nearest(parts, loaded.mesh, description), _largest(parts, loaded.mesh))
        scores = tuple(_score(loaded.mesh, labels == index, answer) for answer in answers)
        name = truth.articulation.links[index].name
        rows.append(PartScores(truth.name, name, description, scores, failed))
    return tuple(rows)


def _asked(
    stage: Segmenter, registration: Registration, mesh: Mesh, description: str
) -> tuple[Grounded, str]:
    """What a grounder says, or no face and why it failed."""
    try:
        return find_part(stage, registration, mesh, description), ""
    except StageError as error:
        failed = " ".join(str(error).split())
        return Grounded(np.zeros(len(mesh.faces), dtype=np.bool_), 0.0, failed), failed


def _segmented(stage: tuple[Segmenter, Registration], mesh: Mesh) -> Segmentation:
    segmenter, registration = stage
    try:
        return checked(segmenter.segment(mesh), mesh)
    except (Exception, SystemExit) as cause:
        raise registration.failure(cause) from cause


def _labels(truth: Truth, loaded: Source) -> IntArray:
    """(F,) true link of each face of the mesh as it was loaded, -1 for none."""
    known = truth.articulation
    matrix = np.linalg.inv(loaded.asset_from_source)
    vertices = loaded.mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    none = np.full(len(loaded.mesh.faces), -1)
    partner = same_faces(known, Articulation(known.name, vertices, loaded.mesh.faces, none, (Link("all"),)))
    if partner is None:
        raise BadInputError(f"'{truth.name}': {truth.mesh} has other faces than its ground truth")
    labels = none.copy()
    labels[partner] = known.labels
    return labels


def _score(given: Mesh, true_faces: BoolArray, answer: Grounded) -> Grounding:
    mesh = answer.mesh_of(given)
    sources = face_sources(mesh, given)
    return score_grounding(mesh, true_faces[sources] & (sources >= 0), answer.faces)


def _nearest(parts: Segmentation, given: Mesh, description: str) -> Grounded:
    chosen = nearest_name(description, named_parts(parts, given))
    return Grounded(parts.face_part == chosen, 1.0, "nearest name", mesh=parts.mesh)


def _largest(parts: Segmentation, given: Mesh) -> Grounded:
    areas = np.bincount(parts.face_part, parts.mesh_of(given).face_areas)
    return Grounded(parts.face_part == int(areas.argmax()), 1.0, "largest part", mesh=parts.mesh)
