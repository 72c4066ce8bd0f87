"""Where the command `tokens` takes the parts of a mesh from: labels, an asset, or a recipe's segmenter."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import IntArray
from simart_kit.assemble import checked
from simart_kit.asset import clean_name, unique_names
from simart_kit.asset_io import load_asset
from simart_kit.bench.formats.label_files import read_npz_labels
from simart_kit.bench.formats.truth_tables import read_table
from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.recipe import build, load_recipe
from simart_kit.stages import PartGuess, Segmenter

from ..training.shapes import FACE_PART


@dataclass(frozen=True, eq=False)
class PartLabels:
    """The parts of a mesh.

    Attributes:
        face_part: (F,) int32 part 0..P-1 of every face, -1 for none.
        parts: one a part.
        source: where they come from, for people.
        mesh: the mesh that `face_part` is of, where a segmenter cut faces; None: the mesh file's.
    """

    face_part: IntArray
    parts: tuple[PartGuess, ...]
    source: str
    mesh: Mesh | None = None


def part_labels(
    path: Path, mesh: Mesh, given: Path | None, recipe: str | None, plugins: Plugins
) -> PartLabels:
    """The parts of a mesh file: those given, else those beside it, else what a recipe's segmenter finds.

    Args:
        path: the mesh file.
        mesh: what was read from it.
        given: labels (.npz) or the folder of a converted asset.
        recipe: whose segmenter is asked even if labels lie beside the mesh; None for default.
        plugins: to find the segmenter.

    Raises:
        BadInputError: labels that cannot be read, or are of another mesh.
    """
    if given is not None:
        found = _of_asset(given) if given.is_dir() else _of_file(given)
    elif recipe is None and (beside := _labels_beside(path)) is not None:
        found = _of_file(beside)
    else:
        return _of_segmenter(mesh, recipe or "default", plugins)
    if len(found.face_part) != len(mesh.faces):
        raise BadInputError(
            f"{found.source} labels {len(found.face_part)} faces, but {path} has {len(mesh.faces)}: "
            "give its own with --parts, or a segmenter with --recipe"
        )
    return found


def _labels_beside(path: Path) -> Path | None:
    """Labels as SIMART-Bench places them, found as `training.shapes.find_shapes` does."""
    names = (f"{path.stem}.npz", f"{path.stem}.gt.npz", "gt.npz")
    return next((file for name in names if (file := path.with_name(name)).is_file()), None)


def _of_file(path: Path) -> PartLabels:
    """Labels by number; named by the table beside them if there is one."""
    labels = read_npz_labels(path, FACE_PART)
    if labels.min(initial=0) < -1:
        raise BadInputError(f"{path}: label {labels.min()}: parts count from 0, and -1 is no part")
    ids, numbered = np.unique(labels, return_inverse=True)
    numbered = numbered.reshape(-1) - int(ids[0] == -1) if len(ids) else numbered
    ids = ids[ids >= 0]
    if not len(ids):
        raise BadInputError(f"{path} labels no face: nothing is told of parts")
    table = path.with_suffix(".json")
    rows = {row.id: row for row in read_table(table).parts} if table.is_file() else {}
    names = [clean_name(rows[i].name) if i in rows else f"part_{i}" for i in ids.tolist()]
    labelled = [rows[i].label if i in rows else "" for i in ids.tolist()]
    guesses = [PartGuess(n, label) for n, label in zip(unique_names(names), labelled, strict=True)]
    return PartLabels(numbered.astype(np.int32), tuple(guesses), str(path))


def _of_asset(folder: Path) -> PartLabels:
    asset = load_asset(folder)
    parts = tuple(PartGuess(p.name, p.label, p.material.name) for p in asset.parts)
    return PartLabels(asset.face_part, parts, str(folder))


def _of_segmenter(mesh: Mesh, recipe: str, plugins: Plugins) -> PartLabels:
    resolved = load_recipe(recipe, plugins)
    stage, registration = build(resolved.segmenter, Segmenter, plugins, resolved.seed)
    try:
        found = checked(stage.segment(mesh), mesh)
    except Exception as cause:
        raise registration.failure(cause) from cause
    return PartLabels(found.face_part, found.parts, f"segmenter '{stage.name}'", found.mesh)
