"""P3-SAM as a program that is asked for the parts of one surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from simart_kit import Mesh
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bench.articulation import Articulation, Link
from simart_kit.errors import BadInputError

from ..adapters.laying import laid
from ..workers.array_files import Arrays, Expected, read_arrays
from ..workers.asking import Call, Program
from ..workers.failures import WorkerError
from ..workers.installation import installation
from ..workers.protocol import RESULT, check_status, write_request
from ..workers.surface import Surface
from ..workers.verifying import check_place
from .system import P3SAM

VERSION = 1
"""Of this adapter: raised when an answer in the cache would mean another thing."""
_WORKER = Path(__file__).with_name("worker.py")
_NONE = (-1, -2)  # no mask, and too small a piece


@dataclass(frozen=True, eq=False)
class P3SamProgram(Program[IntArray]):
    """One question to P3-SAM.

    Attributes:
        mesh: what it is asked about.
        sent: the mesh as it is sent.
        python, folder: of the installation, as options give them.
        options: what the answer depends on: seed, threshold, post_process, prompt_batch, checkpoint.
    """

    mesh: Mesh
    sent: Surface
    python: str
    folder: str
    options: Mapping[str, Any]
    name: ClassVar[str] = P3SAM.name
    expected: ClassVar[Mapping[str, Expected]] = {
        "face_ids": Expected("whole numbers", (-1,)),
        "vertices": Expected("numbers", (-1, 3)),
        "faces": Expected("whole numbers", (-1, 3)),
    }

    def prepare(self, place: Path) -> Call:
        """Write the request; run the worker with P3-SAM's python, where P3-SAM's own script runs."""
        found = installation(P3SAM, self.python, self.folder)
        options = {**self.options, "checkpoint": _checkpoint(self.options["checkpoint"])}
        write_request(place, self.sent, found.folder, options)
        return Call((str(found.python), str(_WORKER), str(place)), found.folder / "P3-SAM" / "demo")

    def collect(self, place: Path, most: int) -> Arrays:
        """Face ids and the mesh that they are of."""
        check_status(place)
        return read_arrays(place / RESULT, self.expected, most)

    def understand(self, arrays: Arrays) -> IntArray:
        """(F,) part of each face of the mesh, in any numbers 0..; -1 for none."""
        ids, vertices, faces = arrays["face_ids"], arrays["vertices"], arrays["faces"]
        if len(ids) != len(faces):
            raise WorkerError(f"gave {len(ids)} face ids for a mesh of {len(faces)} faces")
        if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
            raise WorkerError("gave back a mesh that has no faces, or faces without vertices")
        if ids.min() < min(_NONE):
            raise WorkerError(f"gave face id {ids.min()}: parts are 0 or more, -1 and -2 are none")
        labels = _numbered(np.maximum(ids.astype(np.int64), -1))
        if np.array_equal(faces, self.sent.faces) and np.allclose(vertices, self.sent.vertices):
            placed = np.zeros_like(labels)
            placed[self.sent.face] = labels
            return placed
        return self._laid(self.sent.canonical(vertices.astype(np.float64)), faces, labels)

    def _laid(self, vertices: FloatArray, faces: IntArray, labels: IntArray) -> IntArray:
        """(F,) labels of another mesh of the object on the faces of this one."""
        links = tuple(Link(f"part_{number}") for number in range(int(labels.max()) + 1)) or (Link("none"),)
        try:
            found = Articulation("object", vertices, faces, labels, links)
        except BadInputError as error:
            raise WorkerError(f"gave back a mesh that is none: {error}") from None
        check_place(found, self.mesh)
        return laid(found, self.mesh)


def _numbered(ids: IntArray) -> IntArray:
    """(F,) ids without gaps; -1 stays."""
    _, which = np.unique(np.append(ids, -1), return_inverse=True)
    return np.asarray(which[:-1] - 1)


def _checkpoint(named: str) -> str:
    """A file of weights as a whole path: P3-SAM runs elsewhere; "" for its own."""
    path = Path(named).expanduser().absolute()
    if named and not path.is_file():
        raise BadInputError(f"no such file of weights: {named} (segmenter.options.checkpoint)")
    return str(path) if named else ""
