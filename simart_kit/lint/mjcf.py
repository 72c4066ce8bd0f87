"""Lint of MJCF: what MuJoCo itself does not refuse, and in the end what it does.

MuJoCo loads whatever a file names. So names are checked first, and a file with a bad one is not loaded.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import BadZipFile, ZipFile

from ..bench.mujoco_loading import one_line, quiet_mujoco
from ..errors import BadInputError
from .findings import Finding
from .mjcf_bodies import body_findings, compiled_findings
from .mjcf_files import file_findings, models
from .mjcf_joints import joint_findings

_MOST_FILES, _MOST_BYTES = 1000, 512 << 20


def lint_mjcf(path: Path) -> tuple[Finding, ...]:
    """Findings about an MJCF file, or an archive (`.mjz`) of one with its files."""
    try:
        if path.suffix.lower() == ".mjz":
            with TemporaryDirectory() as folder:
                return tuple(_findings(_unpacked(path, Path(folder))))
        return tuple(_findings(path))
    except BadInputError as error:
        return (Finding("unreadable", path.name, f"{error}"),)


def _findings(path: Path) -> Iterator[Finding]:
    found = tuple(file_findings(path))
    yield from found
    if not any(finding.severity == "error" for finding in found):
        yield from _model_findings(path)


def _model_findings(path: Path) -> Iterator[Finding]:
    import mujoco

    with quiet_mujoco():
        try:
            spec = mujoco.MjSpec.from_file(str(path))
            found = (*body_findings(spec), *joint_findings(spec))
            yield from found
            # What is told in our words need not be told in MuJoCo's.
            if not any(finding.severity == "error" for finding in found):
                yield from compiled_findings(spec.compile())
        except (ValueError, TypeError, RuntimeError, OSError, MemoryError, mujoco.FatalError) as error:
            yield Finding("mujoco-refuses", path.name, f"{one_line(error)}: correct the file")


def _unpacked(path: Path, folder: Path) -> Path:
    """The model of an archive, whose files are written into `folder`."""
    try:
        with ZipFile(path) as archive:
            sizes = [entry.file_size for entry in archive.infolist()]
            if len(sizes) > _MOST_FILES or sum(sizes) > _MOST_BYTES:
                raise BadInputError("it unpacks to more than 1000 files or 512 MB: make it smaller")
            archive.extractall(folder)  # entries that lead out of the folder are put into it
    except (BadZipFile, zlib.error, EOFError, OSError, RuntimeError) as error:  # the last: encrypted
        raise BadInputError(f"it is no readable archive: {error}") from error
    found = models(folder)
    if len(found) != 1:
        raise BadInputError(f"it holds {len(found)} models: an archive should have one XML file at its top")
    return found[0]
