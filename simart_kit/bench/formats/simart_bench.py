"""The SIMART-Bench format: a folder with meshes, gt.npz (part of each face) and gt.json (parts and joints).

    NAME/gt.json        category, frame and `parts`; see truth_tables.py
    NAME/gt.npz         `face_part` (F,): part id of each face; -1 for none
    NAME/input.glb      the mesh; faces numbered as `trimesh.load(path, process=False, force="mesh")` does
    NAME/VARIANT.glb    further meshes of the same object, with VARIANT.npz, or gt.npz where that is absent

or NAME.glb, NAME.gt.npz and NAME.gt.json side by side.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...asset import unique_names
from ...errors import BadInputError
from ...triangles import areas
from ..articulation import Articulation, ordered
from ..cases import Truth
from . import DEFAULT_VARIANT, TruthFormat
from .label_files import read_npz_labels
from .mesh_files import MESH_SUFFIXES, read_surface
from .truth_tables import ObjectTable, check_truth, read_table

TABLE, LABELS = "gt.json", "gt.npz"
FACE_PART = "face_part"


class SimartBench(TruthFormat):
    """Reads SIMART-Bench objects.

    A part that moves but has no face in the chosen variant, such as what a skin hides, cannot be found by
    anybody and is left out with a note, with what is fixed to it; parts that it carries hang on its parent.
    """

    name = "simart-bench"
    layout = f"NAME/{TABLE} with {LABELS} and {DEFAULT_VARIANT}.glb"

    def find(self, root: Path) -> dict[str, Path]:
        if root.is_file():
            table = _table_of(root)
            return {} if table is None else {_name(table): table.parent if table.name == TABLE else table}
        found = list(_objects(root))
        names = [_name(path) for path in found]
        count = Counter(names)
        full = [
            "_".join(path.relative_to(root).with_name(name).parts) if count[name] > 1 else name
            for path, name in zip(found, names, strict=True)
        ]
        return dict(sorted(zip(unique_names(full), found, strict=True)))

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        files = _files(path, variant)
        table = read_table(files.table)
        whole = _articulation(_name(path), table, files)
        seen, hidden = without_hidden(whole)
        notes = [f"'{name}' has no face in {files.mesh.name}: left out of the truth" for name in hidden]
        frame = table.frame
        return Truth(
            seen.name, seen, table.category, files.mesh, frame.up, frame.metres_per_unit, tuple(notes)
        )


def without_hidden(articulation: Articulation) -> tuple[Articulation, tuple[str, ...]]:
    """The object without the bodies that move and have no face, and the names of those that moved.

    A body is a link with all that is fixed to it. Links that a hidden body carries hang on its parent.
    """
    links = articulation.links
    body = list(range(len(links)))
    for index in ordered(links):
        if links[index].parent >= 0 and not links[index].joint.moves:
            body[index] = body[links[index].parent]
    shown = {body[label] for label in np.unique(articulation.labels) if label >= 0}
    hidden = [i for i in articulation.moving if i not in shown]
    kept = [i for i in range(len(links)) if body[i] not in hidden]
    if not hidden or not kept:
        return articulation, ()
    place = {-1: -1} | {old: new for new, old in enumerate(kept)}
    carrier = dict(place)
    for index in ordered(links):
        carrier.setdefault(index, carrier[links[index].parent])
    labels = np.array([place.get(i, -1) for i in range(len(links))] + [-1])  # the last is found by label -1
    rest = tuple(replace(links[i], parent=carrier[links[i].parent]) for i in kept)
    seen = replace(articulation, labels=labels[articulation.labels], links=rest)
    return seen, tuple(links[i].name for i in hidden)


@dataclass(frozen=True)
class _Files:
    """The files of one variant of an object."""

    table: Path
    labels: Path
    mesh: Path


def _files(path: Path, variant: str) -> _Files:
    """The files of a variant; raises BadInputError naming those that there are."""
    if path.is_dir():
        meshes, table, labels = _meshes(path), path / TABLE, path / f"{variant}.npz"
        labels = labels if labels.is_file() else path / LABELS
    else:
        beside = _meshes(path.parent).get(_name(path))
        meshes = {} if beside is None else {DEFAULT_VARIANT: beside}
        table, labels = path, path.with_name(f"{_name(path)}.{LABELS}")
    if variant not in meshes:
        known = ", ".join(sorted(meshes)) or "none"
        raise BadInputError(f"{path} has no mesh '{variant}': its variants are {known}")
    return _Files(table, labels, meshes[variant])


def _meshes(folder: Path) -> dict[str, Path]:
    """Mesh files of a folder by stem; of several, the first in the order of `MESH_SUFFIXES`."""
    there = folder.iterdir() if folder.is_dir() else ()
    files = [path for path in there if path.suffix.lower() in MESH_SUFFIXES]
    files.sort(key=lambda path: (MESH_SUFFIXES.index(path.suffix.lower()), path.name), reverse=True)
    return {path.stem: path for path in files}


def _articulation(name: str, table: ObjectTable, files: _Files) -> Articulation:
    try:
        links = table.links()
        check_truth(links)
    except BadInputError as error:
        raise BadInputError(f"{files.table}: {error}") from error
    vertices, faces = read_surface(files.mesh)
    if not areas(vertices[faces]).sum() > 0:
        raise BadInputError(f"{files.mesh}: none of its faces has an area")
    face_part = read_npz_labels(files.labels, FACE_PART)
    if len(face_part) != len(faces):
        raise BadInputError(
            f"{files.labels} labels {len(face_part)} faces, but {files.mesh.name} has {len(faces)}"
        )
    try:
        labels = table.labels(face_part)
    except BadInputError as error:
        raise BadInputError(f"{files.labels}: {error}") from error
    if not (labels >= 0).any():
        raise BadInputError(f"{files.labels}: no face is of a part: all are -1")
    try:
        return Articulation(name, vertices, faces, labels, links)
    except BadInputError as error:
        raise BadInputError(f"{files.table}: {error}") from error


def _objects(root: Path) -> Iterator[Path]:
    """Folders with a gt.json or gt.npz, not looked into further, and NAME.gt.json files; links followed."""
    seen: set[Path] = set()
    for place, folders, files in os.walk(root, followlinks=True):
        folder = Path(place)
        real = folder.resolve()
        ours = TABLE in files or LABELS in files
        if ours and real not in seen:
            yield folder
        if ours or real in seen:
            folders.clear()
        else:
            yield from (folder / name for name in sorted(files) if name.endswith(f".{TABLE}"))
        seen.add(real)
        folders[:] = sorted(name for name in folders if not name.startswith("."))


def _table_of(file: Path) -> Path | None:
    """The table of an object that is named by one of its files: the table itself, or the mesh beside it."""
    if file.name == TABLE or file.name.endswith(f".{TABLE}"):
        return file
    beside = file.with_name(f"{file.stem}.{TABLE}")
    return beside if file.suffix in MESH_SUFFIXES and beside.is_file() else None


def _name(path: Path) -> str:
    """Name of an object: of its folder, or of its table without the ending."""
    if path.name == TABLE:
        return path.resolve().parent.name
    return (path.resolve() if path.name in ("", "..") else path).name.removesuffix(f".{TABLE}")
