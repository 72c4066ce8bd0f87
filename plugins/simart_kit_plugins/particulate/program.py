"""Particulate as a program that is asked for parts and joints of one surface: its own `infer.py` is run."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import ClassVar

import numpy as np

from simart_kit import Mesh
from simart_kit.bench.articulation import Articulation
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats.particulate import ParticulatePrediction
from simart_kit.errors import BadInputError

from ..adapters.placing import bare
from ..workers.array_files import Arrays, Expected
from ..workers.asking import Call, Program
from ..workers.failures import WorkerError
from ..workers.installation import installation
from ..workers.surface import Surface
from ..workers.verifying import check_place
from .system import PARTICULATE

VERSION = 1
"""Of this adapter: raised when an answer in the cache would mean another thing."""
_FILES = {"npz": "pred.npz", "obj": "pred.obj"}


@dataclass(frozen=True, eq=False)
class ParticulateProgram(Program[Articulation]):
    """One question to Particulate. Its answer in the cache is the bytes of the two files that it writes.

    Attributes:
        mesh: what it is asked about.
        sent: the mesh as it is sent, +z up.
        python, folder: of the installation, as options give them.
        arguments: of `infer.py`, which the answer depends on.
    """

    mesh: Mesh
    sent: Surface
    python: str
    folder: str
    arguments: tuple[str, ...]
    name: ClassVar[str] = PARTICULATE.name
    expected: ClassVar[Mapping[str, Expected]] = {key: Expected("whole numbers", (-1,)) for key in _FILES}

    def prepare(self, place: Path) -> Call:
        """Write the surface as OBJ, one without nodes or looks: it would ignore them."""
        found = installation(PARTICULATE, self.python, self.folder)
        mesh, out = place / "input.obj", place / "output"
        mesh.write_bytes(_obj(self.sent))
        asked = ("--input_mesh", str(mesh), "--up_dir", "Z", "--output_dir", str(out), "--eval")
        return Call((str(found.python), "infer.py", *asked, *self.arguments), found.folder)

    def collect(self, place: Path, most: int) -> Arrays:
        """The bytes of the two files."""
        found = {}
        for key, file in _FILES.items():
            path = place / "output" / "eval" / file
            if not path.is_file():
                raise WorkerError(f"wrote no eval/{file}")
            if path.stat().st_size > most:
                raise WorkerError(f"wrote an eval/{file} of {path.stat().st_size / 1e6:.0f} MB: too long")
            found[key] = np.frombuffer(path.read_bytes(), dtype=np.uint8)
        return found

    def understand(self, arrays: Arrays) -> Articulation:
        """Links and joints on the surface that came back, in the canonical frame."""
        with TemporaryDirectory(prefix="simart-kit-") as folder:
            for key, file in _FILES.items():
                (Path(folder) / file).write_bytes(arrays[key].astype(np.uint8).tobytes())
            truth = Truth("object", bare(self.mesh), up="+z")
            try:
                found = ParticulatePrediction().read(Path(folder) / "pred.npz", truth).articulation
            except BadInputError as error:
                raise WorkerError(f"answered nonsense: {str(error).replace(f'{folder}/', '')}") from None
        if found.is_cloud:
            raise WorkerError("answered with points in place of a mesh")
        check_place(found, self.mesh)
        return found


def _obj(surface: Surface) -> bytes:
    """A Wavefront OBJ file of a surface."""
    text = io.BytesIO()
    np.savetxt(text, surface.vertices, "v %.9g %.9g %.9g")
    np.savetxt(text, surface.faces + 1, "f %d %d %d")
    return text.getvalue()
