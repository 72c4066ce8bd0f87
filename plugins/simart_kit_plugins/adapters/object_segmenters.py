"""Segmenters that read parts and joints: `particulate-files`, `anymesh-files` and `truth-files`."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import BadInputError, Note, Segmentation, Segmenter
from simart_kit.mesh import UpAxis, z_up_from

from .label_segmenters import named_path, only_file

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import FloatArray
    from simart_kit.bench.articulation import Articulation

    from .placing import Placed


class ObjectFiles(Segmenter):
    """Parts and joints of files with a surface of their own, laid onto the mesh by place."""

    class Options(simart_kit.Options):
        """Which object, and how it stands."""

        file: str = Field(default="", description="File or folder of the object; needed to run.")
        up: UpAxis | None = Field(
            default=None, description="Up axis of its frame; without it, it is found out."
        )

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The object's parts on the mesh's faces, and its joints as hints.

        Raises:
            BadInputError: no file is named, it is damaged, or it is of another mesh.
        """
        path = self._path()
        try:
            there, notes = self._placed(path, mesh)
            from .laying import on_faces
            from .stated_joints import stated

            whole, missing = on_faces(there.object, mesh)
            found = stated(whole)
        except BadInputError as error:
            raise BadInputError(str(error) if str(path) in str(error) else f"{path}: {error}") from error
        texts = [f"parts and joints of {path.name}: {there.way}", *notes]
        if missing:
            texts.append(
                f"{missing} of {len(mesh.faces)} faces are of no part: they go with their neighbours"
            )
        return Segmentation(
            found.face_part,
            found.parts,
            joints=found.hints,
            notes=(
                *(Note("segment", "info", text) for text in texts),
                *(Note("segment", "warning", text) for text in found.notes),
            ),
        )

    @abstractmethod
    def _path(self) -> Path:
        """Where the object is."""

    @abstractmethod
    def _placed(self, path: Path, mesh: Mesh) -> tuple[Placed, tuple[str, ...]]:
        """The object in the frame of the mesh, and notes of its reader."""


class ParticulateFiles(ObjectFiles):
    """Parts and joints that Particulate predicted: pred.npz and pred.obj of `infer.py --eval`.

    Joints lie in its normalised frame, turned by --up_dir, the geometry as its source did: `up` is both, the
    up axis of the source and what --up_dir said.
    """

    name = "particulate-files"

    def _path(self) -> Path:
        path = named_path(self.options.file, self.name, "eval/pred.npz")
        if (path / "eval").is_dir():
            path = path / "eval"
        return only_file(path, "*.npz")

    def _placed(self, path: Path, mesh: Mesh) -> tuple[Placed, tuple[str, ...]]:
        from simart_kit.bench.cases import Truth
        from simart_kit.bench.formats.particulate import ParticulatePrediction

        from .placing import bare, placed_by_up

        def read(up: UpAxis) -> Articulation:
            whole = bare(mesh).transformed(_z_up(up).T)
            found = ParticulatePrediction().read(path, Truth("mesh", whole, up=up))
            return found.articulation.transformed(_z_up(up))

        return placed_by_up(read, mesh, self.options.up), ()


class AnymeshFiles(ObjectFiles):
    """Parts and joints that Articulate-AnyMesh predicted: mobility.json with a mesh file a part."""

    name = "anymesh-files"

    def _path(self) -> Path:
        from simart_kit.bench.formats.articulate_anymesh import TABLE

        path = named_path(self.options.file, self.name, "NAME/mobility.json")
        folder = path if path.is_dir() else path.parent
        if not (folder / TABLE).is_file():
            raise BadInputError(
                f"{folder} has no {TABLE}: name the folder of an object of Articulate-AnyMesh"
            )
        return folder

    def _placed(self, path: Path, mesh: Mesh) -> tuple[Placed, tuple[str, ...]]:
        from simart_kit.bench.cases import Truth
        from simart_kit.bench.formats.articulate_anymesh import ArticulateAnyMesh

        from .placing import bare, placed

        found = ArticulateAnyMesh().read(path, Truth("mesh", bare(mesh), up="+z"))
        return placed(found.articulation, mesh, self.options.up), found.notes


class TruthFiles(ObjectFiles):
    """Parts and joints that a data set states of an object: every format that `simart-kit bench` reads.

    These are SIMART-Bench, PartNet-Mobility, PhysXNet, Particulate's point clouds, URDF and MJCF.
    """

    name = "truth-files"

    class Options(ObjectFiles.Options):
        """Which object, and how it stands."""

        object: str = Field(default="", description="Name of the object, where `file` holds several.")

    options: Options

    def _path(self) -> Path:
        return named_path(self.options.file, self.name, "NAME/gt.json")

    def _placed(self, path: Path, mesh: Mesh) -> tuple[Placed, tuple[str, ...]]:
        from simart_kit.bench.formats import find_truths

        from .placing import placed

        found = find_truths(path)
        name = self.options.object or (next(iter(found)) if len(found) == 1 else "")
        if name not in found:
            told = f"no object '{name}'" if name else f"{len(found)} objects"
            known = ", ".join(list(found)[:5]) + (" ..." if len(found) > 5 else "")
            raise BadInputError(
                f"{path} has {told}: choose with --set segmenter.options.object=NAME, of {known}"
            )
        reader, place = found[name]
        truth = reader.read(place)
        return placed(truth.articulation, mesh, self.options.up, truth.up), truth.notes


def _z_up(up: UpAxis) -> FloatArray:
    """(4, 4) rotation that brings a frame with this up axis to +Z up."""
    matrix = np.eye(4)
    matrix[:3, :3] = z_up_from(up)
    return matrix
