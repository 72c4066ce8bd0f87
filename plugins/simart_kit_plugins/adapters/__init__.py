"""What other systems wrote: robot descriptions as sources, and files with parts and joints as segmenters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import hookimpl

from .label_segmenters import LabelFiles, P3samFiles, PartfieldFiles
from .object_segmenters import AnymeshFiles, ParticulateFiles, TruthFiles

if TYPE_CHECKING:
    from pathlib import Path

    from simart_kit import Mesh, Segmentation
    from simart_kit.hookspecs import Register


@hookimpl
def load_mesh(path: Path) -> Mesh | Segmentation | None:
    """Read a URDF, or an object of PhysXNet (finaljson/ID.json), with its parts and joints."""
    if path.suffix.lower() == ".urdf":
        from .urdf import read_urdf

        return read_urdf(path)
    if path.match("finaljson/*.json"):
        from .physxnet import read_physxnet

        return read_physxnet(path)
    return None


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register those that read the files of other systems."""
    for segmenter in (LabelFiles, P3samFiles, PartfieldFiles, ParticulateFiles, AnymeshFiles, TruthFiles):
        register(segmenter)
