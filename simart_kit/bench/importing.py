"""Writes objects of any format with ground truth as SIMART-Bench objects: one mesh, labels, joints."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..errors import BadInputError, OutputError
from ..mesh import UpAxis, z_up_from
from ..output import staging
from .articulation import Articulation
from .cases import Truth
from .formats import DEFAULT_VARIANT, find_truths
from .formats.simart_bench import LABELS, TABLE
from .formats.truth_tables import check_truth, part_rows
from .numbers import counted

_GREY = (166, 166, 166, 255)


@dataclass(frozen=True)
class Imported:
    """What became of the objects of a data set.

    Attributes:
        written: names of those that were written.
        skipped: why the others were not, by name.
    """

    written: tuple[str, ...]
    skipped: dict[str, str]


def import_cases(source: Path, out: Path, report: Callable[[str, str], None]) -> Imported:
    """Write every object below a folder as OUT/NAME; each appears whole or not at all.

    Args:
        source: folder with objects of any format with ground truth.
        out: made if it is not there.
        report: told each object's name and what became of it, as it goes.

    Raises:
        BadInputError: there are no objects, or one of OUT/NAME exists already: then nothing is written.
        OutputError: `out` cannot be written.
    """
    found = find_truths(source)
    taken = [str(out / name) for name in found if (out / name).exists()]
    if taken:
        more = f" and {len(taken) - 3} more" if len(taken) > 3 else ""
        raise BadInputError(f"{', '.join(taken[:3])}{more} exists: remove it, or choose another folder")
    written, skipped = [], {}
    with staging(out) as draft:
        for name, (reader, path) in found.items():
            try:
                truth = reader.read(path)
                write_case(truth, draft / name)
                (draft / name).rename(out / name)
            except BadInputError as error:
                skipped[name] = str(error)
                report(name, f"skipped: {error}")
            except OSError as error:
                raise OutputError(f"cannot write {out / name}: {error.strerror or error}") from error
            else:
                written.append(name)
                report(name, _summary(truth))
    return Imported(tuple(written), skipped)


def write_case(truth: Truth, folder: Path) -> None:
    """Write an object as a SIMART-Bench folder: input.glb, gt.npz and gt.json; see formats/simart_bench.py.

    Mesh and joints are turned to +Y up and keep their unit. The mesh is one, of one colour, its faces in the
    order of the articulation; positions are rounded to single precision.

    Args:
        truth: the object.
        folder: made if it is not there.

    Raises:
        BadInputError: the object is a point cloud, or says of a joint what no truth may (see `check_truth`).
    """
    turned = truth.articulation.transformed(_y_up_from(truth.up)) if truth.up != "+y" else truth.articulation
    if turned.is_cloud:
        raise BadInputError(f"'{truth.name}' is a point cloud: it cannot be written as a mesh")
    check_truth(turned.links)
    data = _glb(turned)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{DEFAULT_VARIANT}.glb").write_bytes(data)
    np.savez_compressed(folder / LABELS, allow_pickle=False, face_part=turned.labels)
    text = json.dumps(_table(truth, turned), indent=1, allow_nan=False, ensure_ascii=False)
    (folder / TABLE).write_text(text + "\n", encoding="utf-8")


def _y_up_from(up: UpAxis) -> FloatArray:
    """(4, 4) rotation that brings a frame with this up axis to +Y up, as glTF has it."""
    matrix = np.eye(4)
    matrix[:3, :3] = z_up_from("+y").T @ z_up_from(up)
    return matrix


def _table(truth: Truth, turned: Articulation) -> dict[str, Any]:
    """The gt.json of an object."""
    return {
        "case": truth.name,
        "category": truth.category,
        "frame": {"up": "+Y", "metres_per_unit": truth.metres_per_unit},
        "parts": part_rows(turned.links),
        "notes": list(truth.notes),
    }


def _glb(articulation: Articulation) -> bytes:
    """The surface as a GLB file of one mesh."""
    import trimesh

    mesh = trimesh.Trimesh(articulation.vertices.astype(np.float32), articulation.faces, process=False)
    material = trimesh.visual.material.PBRMaterial(
        name="grey", baseColorFactor=_GREY, metallicFactor=0.0, roughnessFactor=0.8
    )
    mesh.visual = trimesh.visual.TextureVisuals(material=material)
    data: bytes = mesh.export(file_type="glb")
    return data


def _summary(truth: Truth) -> str:
    shape = truth.articulation
    parts = counted(len(shape.links), "part")
    return f"written: {counted(len(shape.faces), 'face')}, {parts}, {len(shape.moving)} moving"
