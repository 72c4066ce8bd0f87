"""Where a program of others is: its checkout and its own python, by options or variables."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path

from simart_kit.errors import BadInputError
from simart_kit.findings import Finding


@dataclass(frozen=True)
class System:
    """A program that users install themselves.

    Attributes:
        name: as its authors write it, such as "P3-SAM".
        stage: name of the segmenter that calls it.
        repository: where it comes from, as "OWNER/NAME" on GitHub.
        needs: files of a checkout that have to be there.
        licence: what its licence forbids, in a sentence.
    """

    name: str
    stage: str
    repository: str
    needs: tuple[str, ...]
    licence: str

    @property
    def folder_variable(self) -> str:
        """Environment variable that says where the checkout is."""
        return f"SIMART_{self.stage.upper()}_FOLDER"

    @property
    def python_variable(self) -> str:
        """Environment variable that says where its python is."""
        return f"SIMART_{self.stage.upper()}_PYTHON"

    @property
    def remedy(self) -> str:
        """How to make it usable."""
        return (
            f"install github.com/{self.repository} in an environment of its own, and set "
            f"{self.folder_variable} to the checkout (or segmenter.options.folder)"
        )


@dataclass(frozen=True)
class Installation:
    """A program that can be run.

    Attributes:
        python: interpreter of its environment.
        folder: of the checkout.
    """

    python: Path
    folder: Path


def installation(system: System, python: str, folder: str) -> Installation:
    """Where a program is.

    Args:
        system: which.
        python: interpreter, as a path or a command; empty: the variable says.
        folder: checkout; empty: the variable says.

    Raises:
        BadInputError: it is not named, or not there.
    """
    for finding in (_folder(system, folder), _python(system, python)):
        if not finding.ok:
            raise BadInputError(f"{system.name} cannot be run: {finding.detail}; {finding.remedy}")
    checkout = _said(folder, system.folder_variable)
    command = shutil.which(_said(python, system.python_variable))
    assert command is not None
    # Not resolved: an environment's python is a link, and finds the environment by where the link is.
    return Installation(Path(command).absolute(), Path(checkout).resolve())


def findings(system: System) -> list[Finding]:
    """What the doctor says: checkout, python, GPU and licence."""
    licence = Finding(f"licence of {system.name}", "ok", system.licence, stages=())
    return [_folder(system, ""), _python(system, ""), _gpu(system), licence]


def _said(option: str, variable: str) -> str:
    return os.path.expanduser(option or os.environ.get(variable, ""))  # noqa: PTH111 (a command is no path)


def _folder(system: System, option: str) -> Finding:
    subject, said = f"checkout of {system.name}", _said(option, system.folder_variable)
    if not said:
        return Finding(subject, "missing", f"{system.folder_variable} is not set", system.remedy)
    folder = Path(said)
    if not folder.is_dir():
        return Finding(subject, "missing", f"there is no folder {folder}", system.remedy)
    for needed in system.needs:
        if not (folder / needed).exists():
            return Finding(subject, "broken", f"{folder} has no {needed}", system.remedy)
    return Finding(subject, "ok", str(folder))


def _python(system: System, option: str) -> Finding:
    subject, said = f"python of {system.name}", _said(option, system.python_variable)
    remedy = f"set {system.python_variable} to the python of its environment (or segmenter.options.python)"
    if not said:
        return Finding(subject, "missing", f"{system.python_variable} is not set", remedy)
    if shutil.which(said) is None:
        return Finding(subject, "missing", f"there is no program {said}", remedy)
    return Finding(subject, "ok", said)


def _gpu(system: System) -> Finding:
    subject = f"GPU for {system.name}"
    if any(Path("/dev").glob("nvidia[0-9]*")) or Path("/dev/dxg").exists():
        return Finding(subject, "ok", "by NVIDIA")
    # An answer that is in the cache needs none.
    return Finding(subject, "missing", "it runs with CUDA only", "run it where a GPU by NVIDIA is")
