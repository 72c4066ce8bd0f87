"""Predictions as a label for each face, such as segmenters write, with or without joints."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...arrays import IntArray
from ...errors import BadInputError
from ..articulation import Articulation, Link, LinkJoint
from ..cases import Prediction, Truth
from . import PredictionFormat
from .label_files import read_npy
from .truth_tables import ObjectTable, read_table

MOST_LABELS = 1000
_NONE = (-1, -2)  # P3-SAM: no mask, and too small a piece


class LabelArray(PredictionFormat):
    """Reads a .npy of one whole number for each face of the truth's mesh; -1 and -2 are for no part.

    The file is NAME.npy, or in a folder NAME labels.npy, face_ids.npy, NAME_face_ids.npy, the only
    *_face_ids.npy, or the only .npy. Joints are in a JSON file beside it (NAME.json; in a folder labels.json
    or joints.json, too) with `parts` as in a gt.json, in the frame of the truth. Without one, every label but
    that of the largest area is taken to move in an unknown way: only metrics of parts mean anything then.
    """

    name = "labels"
    layout = "NAME.npy or NAME/labels.npy, one label a face, with joints in NAME.json if there are any"
    knows_frame = True

    def find(self, root: Path, name: str) -> Path | None:
        single = root / f"{name}.npy"
        if single.is_file():
            return single
        folder = root / name
        for known in ("labels.npy", "face_ids.npy", f"{name}_face_ids.npy"):
            if (folder / known).is_file():
                return folder / known
        for pattern in ("*_face_ids.npy", "*.npy"):
            found = sorted(folder.glob(pattern)) if folder.is_dir() else []
            if len(found) == 1:
                return found[0]
        return None

    def read(self, path: Path, truth: Truth) -> Prediction:
        known = truth.articulation
        labels = _read_labels(path, known)
        table = _joints_file(path, truth.name)
        try:
            if table is None:
                links, placed = _unjointed(labels, known)
            else:
                links, placed = _jointed(read_table(table), table, labels)
            predicted = Articulation(known.name, known.vertices, known.faces, placed, links)
        except BadInputError as error:
            raise BadInputError(f"{path}: {error}") from error
        notes = () if table else ("no joints given: parts are taken to move in an unknown way",)
        return Prediction(predicted, notes=notes)


def _read_labels(path: Path, known: Articulation) -> IntArray:
    """(F,) labels, -1 for none; raises BadInputError when they cannot be of the truth's mesh."""
    labels = read_npy(path)
    if labels.shape != known.labels.shape:
        what = "points" if known.is_cloud else "faces"
        raise BadInputError(f"{path} labels {len(labels)} {what}, but the truth has {len(known.labels)}")
    used = np.unique(labels)
    if len(used) > MOST_LABELS:
        raise BadInputError(f"{path} has {len(used)} labels: more than {MOST_LABELS} are no parts")
    if used[0] < min(_NONE):
        raise BadInputError(f"{path} has label {used[0]}: labels are 0 or more, -1 or -2 for no part")
    return np.where(np.isin(labels, _NONE), -1, labels)


def _joints_file(path: Path, name: str) -> Path | None:
    """The file with joints beside a label array; None where there is none."""
    names = (path.stem,) if path.stem == name else (name, "labels", "joints")
    found = [path.with_name(f"{stem}.json") for stem in names if path.with_name(f"{stem}.json").is_file()]
    return found[0] if found else None


def _jointed(table: ObjectTable, path: Path, labels: IntArray) -> tuple[tuple[Link, ...], IntArray]:
    """The links that a table tells of, and (F,) their places."""
    try:
        return table.links(), table.labels(labels)
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error


def _unjointed(labels: IntArray, known: Articulation) -> tuple[tuple[Link, ...], IntArray]:
    """A link a label, and (F,) their places: all move on the one of the largest area."""
    used, place = np.unique(labels[labels >= 0], return_inverse=True)
    if not len(used):
        return (Link("body"),), labels
    areas = np.bincount(place, known.weights[labels >= 0])
    body = int(areas.argmax())
    moved = LinkJoint("unknown")
    links = tuple(
        Link(f"label_{label}") if i == body else Link(f"label_{label}", body, moved)
        for i, label in enumerate(used)
    )
    placed = np.full(len(labels), -1)
    placed[labels >= 0] = place
    return links, placed
