"""Predictions of Articulate-AnyMesh (arXiv 2502.02590): mobility.json and a mesh file a part.

    NAME/mobility.json          list of {id, parent, joint, name, jointData {axis {origin, direction}}}
    NAME/mesh_parts/PART.glb    PART is the name of a part, such as door@0, or its id

A parent is a name, an id, or nothing for a root ("None" and -1, too). There are no limits; a slide's origin
is written as 0 0 0 and says nothing. The frame is that of the system's own normalised mesh: centred, bounding
box diagonal 2, turned as the object's configuration said, which these files do not tell.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import get_args

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ...arrays import FloatArray, IntArray
from ...errors import BadInputError
from ..articulation import Articulation, Link, LinkJoint, LinkJointKind
from ..cases import Prediction, Truth
from . import PredictionFormat
from .files import reading
from .mesh_files import read_triangles
from .truth_tables import Point

TABLE, MESHES = "mobility.json", "mesh_parts"
PARTNET_TABLE = "mobility_v2.json"  # beside a mobility.json it tells a PartNet-Mobility folder
# The system says fixed, revolute, continuous or prismatic; the rest are PartNet-Mobility's words.
KINDS: dict[str, LinkJointKind] = {
    **{kind: kind for kind in get_args(LinkJointKind) if kind != "unknown"},
    "hinge": "revolute",
    "slider": "prismatic",
    "heavy": "fixed",
    "static": "fixed",
}
_ROOT = (None, -1, "", "-1", "None", "none", "null")


class _Row(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False)


class _Axis(_Row):
    origin: Point | None = None
    direction: Point | None = None


class _JointData(_Row):
    axis: _Axis = _Axis()


class _Part(_Row):
    id: int
    name: str
    parent: int | str | None = None
    joint: str
    data: _JointData | None = Field(default=None, alias="jointData")


_PARTS = TypeAdapter(tuple[_Part, ...])


class ArticulateAnyMesh(PredictionFormat):
    """Reads an object folder of Articulate-AnyMesh, in the system's own normalised frame."""

    name = "articulate-anymesh"
    layout = f"NAME/{TABLE} with NAME/{MESHES}/PART.glb"

    def find(self, root: Path, name: str) -> Path | None:
        folder = root / name
        ours = (folder / TABLE).is_file() and not (folder / PARTNET_TABLE).exists()
        return folder if ours else None

    def read(self, path: Path, truth: Truth) -> Prediction:
        parts = _read_parts(path / TABLE)
        files, notes = _files(path / MESHES, parts)
        surfaces = [read_triangles(file) if file else _nothing() for file in files]
        starts = np.cumsum([0] + [len(vertices) for vertices, _ in surfaces])
        try:
            predicted = Articulation(
                truth.name,
                np.concatenate([vertices for vertices, _ in surfaces]),
                np.concatenate([faces + start for (_, faces), start in zip(surfaces, starts, strict=False)]),
                np.repeat(np.arange(len(parts)), [len(faces) for _, faces in surfaces]),
                _links(parts),
            )
        except BadInputError as error:
            raise BadInputError(f"{path / TABLE}: {error}") from error
        return Prediction(predicted, notes=("in the frame of its normalised mesh", *notes))


def _read_parts(path: Path) -> tuple[_Part, ...]:
    with reading(path, "JSON"):
        try:
            parts = _PARTS.validate_python(json.loads(path.read_text(encoding="utf-8")))
        except ValidationError as error:
            told = [f"part {'.'.join(map(str, e['loc'])) or 'list'}: {e['msg']}" for e in error.errors()[:3]]
            raise BadInputError("; ".join(told)) from error
        if not parts:
            raise BadInputError("it lists no parts")
        for what in ("id", "name"):
            values = [getattr(part, what) for part in parts]
            twice = sorted({str(value) for value in values if values.count(value) > 1})
            if twice:
                raise BadInputError(f"part {what} {', '.join(twice)} is used twice")
    return parts


def _files(folder: Path, parts: tuple[_Part, ...]) -> tuple[list[Path | None], list[str]]:
    """The mesh file of each part, by its name or else its id, and notes on what has no counterpart."""
    there = {file.stem: file for file in sorted(folder.glob("*.glb"))} if folder.is_dir() else {}
    files = [there.get(part.name, there.get(str(part.id))) for part in parts]
    if not any(files):
        raise BadInputError(f"{folder} has no .glb named like a part or id of {TABLE}")
    bare = []
    for part, file in zip(parts, files, strict=True):
        if file is None and KINDS.get(part.joint.strip().lower()) != "fixed":
            raise BadInputError(f"{folder}: part '{part.name}' moves and has no mesh {part.name}.glb")
        if file is None:
            bare.append(f"part '{part.name}' has no mesh")
    spare = [f"{file.name} is of no part: left out" for file in there.values() if file not in files]
    return files, bare + spare


def _links(parts: tuple[_Part, ...]) -> tuple[Link, ...]:
    index: dict[int | str, int] = {str(part.id): i for i, part in enumerate(parts)}
    index |= {part.name: i for i, part in enumerate(parts)} | {part.id: i for i, part in enumerate(parts)}
    links = []
    for part in parts:
        if part.parent not in _ROOT and part.parent not in index:
            raise BadInputError(f"part '{part.name}': there is no parent '{part.parent}'")
        parent = -1 if part.parent in _ROOT or part.parent is None else index[part.parent]
        try:
            links.append(Link(part.name, parent, _joint(part, parent < 0), label=part.name.split("@")[0]))
        except BadInputError as error:
            raise BadInputError(f"part '{part.name}': {error}") from error
    return tuple(links)


def _joint(part: _Part, root: bool) -> LinkJoint:
    word = part.joint.strip().lower()
    if word not in KINDS:
        raise BadInputError(f"joint '{part.joint}' is not one of {', '.join(KINDS)}")
    kind = KINDS[word]
    if root and kind == "free":
        kind = "fixed"  # PartNet's word for an object that stands by itself
    axis = part.data.axis if part.data else _Axis()
    origin = None if kind == "prismatic" else axis.origin
    return LinkJoint(kind, axis.direction, origin)


def _nothing() -> tuple[FloatArray, IntArray]:
    return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32)
