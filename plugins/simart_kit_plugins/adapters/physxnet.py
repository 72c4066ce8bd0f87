"""An object of PhysXNet as a source: it is a mesh file a part, and no mesh of the whole."""

from __future__ import annotations

from pathlib import Path

from simart_kit import Mesh, Note, Segmentation
from simart_kit.bench.formats.physxnet import PhysXNet

from .stated_joints import stated


def read_physxnet(path: Path) -> Segmentation:
    """Read finaljson/ID.json with partseg/ID/objs/*.obj: parts and joints on a mesh of one colour, +Y up.

    Raises:
        BadInputError: a file is missing or damaged; names it.
    """
    truth = PhysXNet().read(path)
    found = stated(truth.articulation)
    mesh = Mesh(
        truth.articulation.vertices,
        truth.articulation.faces,
        up=truth.up,
        metres_per_unit=truth.metres_per_unit,
    )
    texts = [*truth.notes, *found.notes]
    return Segmentation(
        found.face_part,
        found.parts,
        joints=found.hints,
        notes=tuple(Note("load", "warning", text) for text in texts),
        mesh=mesh,
    )
