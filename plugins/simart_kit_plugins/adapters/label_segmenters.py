"""Segmenters that read a label a face: `label-files`, `p3sam-files` and `partfield-files`."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, TypeVar

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import BadInputError, Note, PartGuess, Segmentation, Segmenter
from simart_kit.arrays import IntArray, frozen_ints
from simart_kit.mesh import UpAxis

if TYPE_CHECKING:
    from simart_kit import Mesh

Key = TypeVar("Key", int, str)

_UNASSIGNED = (-1, -2)
_MOST_LABELS = 1000
_LARGEST_LABEL = 1_000_000
_MESHES = (".ply", ".glb", ".obj")  # PLY keeps faces best
_CLUSTERS = re.compile(r"(.+)_0_(\d+)")


class LabelFiles(Segmenter):
    """Parts by a label a face in a .npy file, as most segmenters write; -1 and -2 are faces of no part.

    The labels are of the faces as `trimesh.load(path, process=False, force="mesh")` counts them. Of another
    mesh of the same object, they are laid onto this one by place.
    """

    name = "label-files"
    prefers_beside: ClassVar[bool] = False  # whether labels are of the mesh beside them, where there is one

    class Options(simart_kit.Options):
        """Which labels, and which mesh they are of."""

        file: str = Field(default="", description="File with the labels, or its folder; needed to run.")
        mesh: str = Field(
            default="",
            description="Mesh file that the labels are of; empty: the mesh that is converted, "
            "or else the one beside the labels whose faces they fit.",
        )
        up: UpAxis | None = Field(
            default=None, description="Up axis of that mesh file; without it, it is found out."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """A part for each label.

        Raises:
            BadInputError: no file is named, it is damaged, or its labels fit neither mesh nor one beside.
        """
        path, notes = self._file(), list[str]()
        labels = read_labels(path)
        other = self._other_mesh(path, labels, mesh)
        if other is not None:
            labels, how = _by_place(path, labels, other, mesh, self.options.up)
            notes.append(how)
        missing = int((labels < 0).sum())
        if missing:
            from .laying import filled

            labels = filled(labels, mesh)
            notes.append(f"{missing} of {len(labels)} faces had no label: they take that of their neighbours")
        used, face_part = np.unique(labels, return_inverse=True)
        notes.insert(0, f"{len(used)} parts of {path.name}")
        return Segmentation(
            frozen_ints(face_part),
            tuple(PartGuess(f"part_{label}") for label in used),
            notes=tuple(Note("segment", "info", text) for text in notes),
        )

    def _file(self) -> Path:
        """The file with the labels."""
        return only_file(named_path(self.options.file, self.name, "labels.npy"), "*.npy")

    def _other_mesh(self, path: Path, labels: IntArray, mesh: Mesh) -> Path | None:
        """The mesh file that the labels are of; None where that is the mesh which is converted."""
        if self.options.mesh:
            return Path(self.options.mesh)
        fits = len(labels) == len(mesh.faces)
        if fits and not self.prefers_beside:
            return None
        beside = [file for end in _MESHES for file in sorted(path.parent.glob(f"*{end}"))]
        found = _with_faces(beside, len(labels))
        if found is None and not fits:
            told = ", ".join(file.name for file in beside[:5])
            raise BadInputError(
                f"{path} labels {len(labels)} faces, the mesh has {len(mesh.faces)} "
                f"{f'and none of {told}' if beside else 'and no mesh is beside it'}: "
                "name the one that it is of with --set segmenter.options.mesh=FILE"
            )
        return found


class P3samFiles(LabelFiles):
    """Parts by the face ids that P3-SAM of Hunyuan3D-Part wrote, over-segmented as they are.

    P3-SAM merges vertices and drops faces before it counts: the labels are of the mesh that it wrote beside
    them, if that is still there.
    """

    name = "p3sam-files"
    prefers_beside = True

    def _file(self) -> Path:
        return only_file(named_path(self.options.file, self.name, "NAME_face_ids.npy"), "*_face_ids.npy")


class PartfieldFiles(LabelFiles):
    """Parts by PartField's clusters: files UID_0_NN.npy in its folder `cluster_out`, NN parts each."""

    name = "partfield-files"

    class Options(LabelFiles.Options):
        """Which clustering, and which mesh it is of."""

        clusters: int | None = Field(
            default=None, ge=1, description="Number of clusters, where `file` is a folder with several."
        )
        uid: str = Field(default="", description="Object, where `file` is a folder with several.")

    options: Options

    def _file(self) -> Path:
        path = named_path(self.options.file, self.name, "cluster_out")
        if not path.is_dir():
            return path
        found = {
            (match[1], int(match[2])): file
            for file in sorted(path.glob("*.npy"))
            if (match := _CLUSTERS.fullmatch(file.stem))
        }
        if not found:
            raise BadInputError(f"{path} has no file UID_0_NN.npy: name PartField's folder cluster_out")
        uid = _chosen(self.options.uid or None, {uid for uid, _ in found}, path, "object", "uid")
        counts = {count for name, count in found if name == uid}
        return found[uid, _chosen(self.options.clusters, counts, path, "number of clusters", "clusters")]


def read_labels(path: Path) -> IntArray:
    """(F,) labels of a .npy file, -1 for none.

    Raises:
        BadInputError: the file is missing or damaged, or holds no labels, or too many.
    """
    from simart_kit.bench.formats.label_files import read_npy

    labels = read_npy(path)
    if not (labels >= 0).any():
        raise BadInputError(f"{path} gives no face a label")
    used = np.unique(labels)
    if used[-1] > _LARGEST_LABEL:
        raise BadInputError(f"{path} has label {used[-1]}: more than {_LARGEST_LABEL} is no number of a part")
    if used[0] < min(_UNASSIGNED):
        raise BadInputError(f"{path} has label {used[0]}: labels are 0 or more, -1 or -2 for no part")
    if len(used) > _MOST_LABELS:
        raise BadInputError(f"{path} has {len(used)} labels: more than {_MOST_LABELS} are no parts")
    return np.maximum(labels, -1)


def named_path(text: str, segmenter: str, example: str) -> Path:
    """The path that the option `file` names; raises BadInputError when it names none, or nothing is there."""
    if not text:
        raise BadInputError(f"{segmenter}: no file is named: add --set segmenter.options.file={example}")
    path = Path(text)
    if not path.exists():
        raise BadInputError(f"no such file: {path}")
    return path


def only_file(path: Path, pattern: str) -> Path:
    """The path itself, or the only file of a folder with such a name; raises BadInputError otherwise."""
    if not path.is_dir():
        return path
    found = sorted(path.glob(pattern))
    if len(found) != 1:
        told = ", ".join(file.name for file in found[:5]) or "none"
        raise BadInputError(f"{path} should have one file {pattern}, it has {told}: name the file itself")
    return found[0]


def _chosen(wanted: Key | None, known: set[Key], path: Path, what: str, option: str) -> Key:
    """The one that is wanted, or the only one; raises BadInputError that names those there are."""
    if wanted is None and len(known) == 1:
        return next(iter(known))
    if wanted in known and wanted is not None:
        return wanted
    told = ", ".join(map(str, sorted(known)))
    said = f"no {what} {wanted}" if wanted is not None else f"more than one {what}"
    raise BadInputError(f"{path} has {said}: choose with --set segmenter.options.{option}=..., of {told}")


def _with_faces(files: list[Path], count: int) -> Path | None:
    """The first mesh file of so many faces."""
    from simart_kit.bench.formats.mesh_files import read_surface

    return next((file for file in files if len(read_surface(file)[1]) == count), None)


def _by_place(
    path: Path, labels: IntArray, file: Path, mesh: Mesh, up: UpAxis | None
) -> tuple[IntArray, str]:
    """(F,) labels of the mesh's faces, by those of the mesh file that they are of, and how that lies."""
    from simart_kit.bench.articulation import Articulation, Link
    from simart_kit.bench.formats.mesh_files import read_surface

    from .laying import laid
    from .placing import placed

    vertices, faces = read_surface(file)
    if len(faces) != len(labels):
        raise BadInputError(f"{path} labels {len(labels)} faces, but {file} has {len(faces)}")
    links = tuple(Link(f"part_{label}") for label in range(int(labels.max()) + 1))
    try:
        there = placed(Articulation(file.stem, vertices, faces, labels, links), mesh, up)
    except BadInputError as error:
        raise BadInputError(f"{file}: {error}") from error
    return laid(there.object, mesh), f"laid on by place from {file.name}: {there.way}"
