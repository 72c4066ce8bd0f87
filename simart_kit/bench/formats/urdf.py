"""URDF as truth and as prediction (http://wiki.ros.org/urdf/XML), read leniently.

Files of research systems lack `<limit>`s, efforts and collisions, which stricter parsers refuse.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import numpy as np

from ...errors import BadInputError
from ..articulation import Articulation
from ..cases import Prediction, Truth
from . import DEFAULT_VARIANT, PredictionFormat, TruthFormat
from .folding import folded, grounded
from .found_files import USUAL_STEMS, files_below, named, object_name
from .mesh_files import joined, moved
from .urdf_shapes import link_surface
from .urdf_tree import read_tree
from .xml_files import read_xml

PARTNET_FILE = "mobility_v2.json"
_FRAME_NOTE = "in the frame of the URDF's root link, +z up: a URDF does not say how the truth stands in it"


class UrdfTruth(TruthFormat):
    """Objects that are a URDF file with its meshes. Metres, +z up, all joints at 0."""

    name = "urdf"
    layout = "NAME/*.urdf with its mesh files, or NAME.urdf"

    def find(self, root: Path) -> dict[str, Path]:
        """URDF files by name: of their folder; of the file where a folder has several.

        Folders of PartNet-Mobility are left to their own reader.
        """
        if root.is_file():
            return {_name(root): root} if root.suffix.lower() == ".urdf" else {}
        files = (path for path in files_below(root, ".urdf") if not (path.parent / PARTNET_FILE).exists())
        return named(root, list(files))

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read one file."""
        check_variant(path, variant)
        articulation, notes = read_urdf(path, _name(path))
        return Truth(articulation.name, articulation, up="+z", notes=notes)


class UrdfPrediction(PredictionFormat):
    """A URDF file with its meshes, as URDFormer, PhysX-Anything, Articulate-Anything and others write it."""

    name = "urdf"
    layout = "NAME.urdf, NAME/*.urdf, NAME/urdf*/*.urdf or labelNAME.urdf"
    stems: ClassVar[tuple[str, ...]] = USUAL_STEMS

    def find(self, root: Path, name: str) -> Path | None:
        """The file of an object; of several in a folder, NAME.urdf or one with a usual name.

        Raises:
            BadInputError: a folder holds several files, and none of them stands out.
        """
        folder = root / name
        inner = sorted(path for path in folder.glob("urdf*") if path.is_dir())
        for group in (
            [root / f"{name}.urdf"],
            sorted(folder.glob("*.urdf")),
            sorted(path for place in inner for path in place.glob("*.urdf")),
            [root / f"label{name}.urdf"],
        ):
            files = [path for path in group if path.is_file()]
            if files:
                return self._pick(files, name)
        return None

    def read(self, path: Path, truth: Truth) -> Prediction:
        """Read one file; it stays in its own frame."""
        articulation, notes = read_urdf(path, truth.name)
        return Prediction(articulation, path, (*notes, _FRAME_NOTE))

    def _pick(self, files: list[Path], name: str) -> Path:
        for stem in (name, *self.stems):
            same = [path for path in files if path.stem == stem]
            if len(same) == 1:
                return same[0]
        if len(files) > 1:
            names = ", ".join(path.name for path in files)
            raise BadInputError(f"{files[0].parent} holds {names}: name the one to score {name}.urdf")
        return files[0]


def read_urdf(path: Path, name: str) -> tuple[Articulation, tuple[str, ...]]:
    """Read a URDF file at position 0 of its joints, and what could not be taken over.

    Links keep the order of the file; those that only stand between two joints are folded away.

    Raises:
        BadInputError: the file or one of its meshes is missing or damaged; names the file.
    """
    try:
        robot = read_xml(path, "robot")
        tree = read_tree(robot)
        elements, pieces, labels = robot.findall("link"), [], []
        for index, (element, world_T_link) in enumerate(zip(elements, tree.poses, strict=True)):
            surface = link_surface(element, path.parent)
            if surface is not None:
                pieces.append(moved(surface, world_T_link))
                labels.append(np.full(len(surface[1]), index, dtype=np.int32))
        if not pieces:
            raise BadInputError("no link has a shape")
        vertices, faces = joined(pieces)
        whole = grounded(folded(Articulation(name, vertices, faces, np.concatenate(labels), tree.links)))
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
    gone = sorted({link.name for link in tree.links} - {link.name for link in whole.links})
    text = f"empty links are folded into the ones they carry: {', '.join(gone)}"
    return whole, (*tree.notes, *((text,) if gone else ()))


def check_variant(path: Path, variant: str) -> None:
    """Raises BadInputError for all but the one variant that these formats have."""
    if variant != DEFAULT_VARIANT:
        raise BadInputError(f"{path} has no variant '{variant}': its only one is '{DEFAULT_VARIANT}'")


def _name(path: Path) -> str:
    return object_name(path, list(path.parent.glob("*.urdf")))
