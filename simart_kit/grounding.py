"""ground(): the faces of a mesh that a description means, such as "the lid" or "the upper left door"."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol, TypeVar, runtime_checkable

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, frozen_bools, frozen_ints
from .assemble import checked
from .errors import BadInputError
from .loading import read_source, source_path
from .mesh import Mesh, Note, UpAxis
from .part_matching import match
from .part_places import NamedPart, named_part
from .plugins import Plugins, Registration
from .recipe import build, check_extras, load_recipe
from .stages import Segmentation, Segmenter
from .timeout import time_limit
from .usage import ModelUsage

T = TypeVar("T")


@dataclass(frozen=True)
class Candidate:
    """A part that the description might mean.

    Attributes:
        name: of the part.
        score: 0..1, how well it fits.
        chosen: whether it is taken as meant.
        reason: a phrase.
    """

    name: str
    score: float
    chosen: bool = False
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Grounded:
    """What a description means.

    Attributes:
        faces: (F,) whether each face belongs to it: of `mesh` where there is one, else of the mesh given.
        score: 0..1, how sure that is.
        reason: one sentence.
        candidates: the parts that were looked at; none where no parts were made.
        face_candidate: (F,) index into `candidates` of each face, -1 for none; None where there are none.
        mesh: the mesh that `faces` is of, where faces had to be cut; None: the mesh that was given.
        notes: what was decided on the way.
        usage: what it took of models that were asked, for provenance.
    """

    faces: BoolArray
    score: float
    reason: str
    candidates: tuple[Candidate, ...] = ()
    face_candidate: IntArray | None = None
    mesh: Mesh | None = None
    notes: tuple[Note, ...] = ()
    usage: tuple[ModelUsage, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "faces", frozen_bools(self.faces))
        if self.face_candidate is not None:
            object.__setattr__(self, "face_candidate", frozen_ints(self.face_candidate))

    def mesh_of(self, given: Mesh) -> Mesh:
        """The mesh that `faces` is of: the `given` one, unless faces had to be cut."""
        return given if self.mesh is None else self.mesh


@runtime_checkable
class Grounder(Protocol):
    """A segmenter that finds what a description means by itself, without naming all parts first."""

    def ground(self, mesh: Mesh, description: str) -> Grounded:
        """The faces meant, of a mesh in the canonical frame; none where there is nothing of the kind."""


@dataclass(frozen=True, eq=False)
class Grounding:
    """What `ground` found, and where it was written.

    Attributes:
        description: as given.
        grounded: faces, score and candidates.
        mesh: the one that `grounded.faces` is of, in the canonical frame [m].
        asset_from_source: (4, 4) maps the file's coordinates to the mesh's.
        paths: "part", "picture", "labels", "grounding" and "provenance"; none where nothing was written.
        folder: the output folder, or None.
        notes: what was decided, and what was in the way in the folder.
    """

    description: str
    grounded: Grounded
    mesh: Mesh
    asset_from_source: FloatArray
    paths: dict[str, Path]
    folder: Path | None = None
    notes: tuple[Note, ...] = ()

    @property
    def area_share(self) -> float:
        """Area of the faces found, as a share of the object's."""
        areas = self.mesh.face_areas
        return float(areas[self.grounded.faces].sum() / areas.sum())


def ground(
    source: str | Path,
    description: str,
    recipe: str | Path = "default",
    *,
    out: str | Path | None = None,
    sets: Iterable[str] = (),
    up: UpAxis | None = None,
    unit: str | float | None = None,
    plugins: Plugins | None = None,
) -> Grounding:
    """Find the part of a mesh file that a description means.

    A segmenter that is a `Grounder` is asked; of any other, the names of the parts that it finds are compared
    with the description.

    Args:
        source: mesh file; formats are those of the loaded plugins.
        description: such as "the lid", "second drawer from the top" or "both doors".
        recipe: whose segmenter: a recipe's name, a TOML file, or the provenance.json of an earlier run.
        out: folder to write; None writes nothing.
        sets: recipe changes such as "segmenter.options.max_parts=8".
        up: the file's up axis, where the file does not say or says wrong.
        unit: the file's unit: "mm", "cm", "m", "in", "ft", or metres a unit.
        plugins: the default loads all installed ones.

    Raises:
        BadInputError: the source cannot be used, or no part fits; names those that there are.
        RecipeError, PluginError: the recipe cannot be run.
        StageError: the segmenter failed.
    """
    plugins = plugins or Plugins()
    path = source_path(source)
    if not description.strip():
        raise BadInputError('the description is empty: say which part is meant, such as "the lid"')
    resolved = load_recipe(recipe, plugins, sets)
    check_extras([("segmenter", resolved.segmenter)], plugins)
    loaded = read_source(path, plugins, up, unit)
    stage, registration = build(resolved.segmenter, Segmenter, plugins, resolved.seed)
    if loaded.stated is None:
        grounded = find_part(stage, registration, loaded.mesh, description, resolved.stage_timeout)
    else:  # as in `convert`, whatever segmenter the recipe names
        grounded = by_names(loaded.stated, loaded.mesh, description)
    if not grounded.faces.any():
        raise BadInputError(f"{path}: {_nothing(description, grounded)}")
    found = Grounding(
        description=description,
        grounded=grounded,
        mesh=grounded.mesh_of(loaded.mesh),
        asset_from_source=loaded.asset_from_source,
        paths={},
        notes=loaded.mesh.notes + grounded.notes,
    )
    if out is None:
        return found
    from .grounding_files import Origin, write_grounding

    arguments = {"description": description, "up": up, "unit": unit}
    origin = Origin(path, loaded, resolved, registration, arguments)
    return write_grounding(found, origin, plugins, Path(out))


def find_part(
    stage: Segmenter, registration: Registration, mesh: Mesh, description: str, seconds: float = 0.0
) -> Grounded:
    """The faces that a description means, by a segmenter; no face where nothing fits.

    Args:
        stage: the segmenter.
        registration: of it, for errors.
        mesh: in the canonical frame.
        description: of the part.
        seconds: longest time that it may take [s]; 0: no limit.

    Raises:
        StageError: the segmenter failed or returned something else.
    """
    if isinstance(stage, Grounder):
        asked = partial(stage.ground, mesh, description)
        return _run(registration, seconds, lambda: checked_grounded(asked(), mesh))
    segmentation = _run(registration, seconds, lambda: checked(stage.segment(mesh), mesh))
    return by_names(segmentation, mesh, description)


def by_names(segmentation: Segmentation, given: Mesh, description: str) -> Grounded:
    """Compare a description with the parts of a segmentation as `assemble.checked` returns it."""
    parts = named_parts(segmentation, given)
    found = match(description, parts)
    candidates = tuple(
        Candidate(part.name, round(float(score), 4), index in found.chosen, reason)
        for index, (part, score, reason) in enumerate(zip(parts, found.scores, found.reasons, strict=True))
    )
    return Grounded(
        faces=np.isin(segmentation.face_part, found.chosen),
        score=round(found.score, 4),
        reason=found.reason,
        candidates=candidates,
        face_candidate=segmentation.face_part,
        mesh=segmentation.mesh,
        notes=segmentation.notes,
        usage=segmentation.usage,
    )


def named_parts(segmentation: Segmentation, given: Mesh) -> tuple[NamedPart, ...]:
    """The parts of a segmentation with their places and sizes."""
    mesh = segmentation.mesh_of(given)
    return tuple(
        named_part(mesh, segmentation.face_part == index, guess)
        for index, guess in enumerate(segmentation.parts)
    )


def checked_grounded(value: object, given: Mesh) -> Grounded:
    """What a `Grounder` returned, if it is right.

    Raises:
        ValueError: it is no `Grounded`, or its arrays do not fit the mesh.
    """
    if not isinstance(value, Grounded):
        raise ValueError(
            f"ground() returned {type(value).__name__}, expected a simart_kit.grounding.Grounded"
        )
    count, of = len(value.mesh_of(given).faces), value.face_candidate
    if value.faces.shape != (count,):
        raise ValueError(f"faces has shape {value.faces.shape}, expected ({count},): one bool a face")
    if not 0.0 <= value.score <= 1.0:
        raise ValueError(f"score {value.score} must lie in 0..1")
    known = len(value.candidates)
    if of is not None and (of.shape != (count,) or not -1 <= of.min() <= of.max() < known):
        raise ValueError(f"face_candidate is not -1..{known - 1} for each of {count} faces")
    return value


def _run(registration: Registration, seconds: float, call: Callable[[], T]) -> T:
    """Run a plugin's step within a time limit; whatever it raises becomes a StageError that names it."""
    try:
        with time_limit(seconds):
            return call()
    except (Exception, SystemExit) as cause:
        raise registration.failure(cause) from cause


def _nothing(description: str, grounded: Grounded) -> str:
    names = ", ".join(candidate.name for candidate in grounded.candidates)
    there = f"its parts are {names}" if names else grounded.reason
    return f"no part fits '{' '.join(description.split())}': {there}"
