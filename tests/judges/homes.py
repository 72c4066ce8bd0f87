"""The environments that judges run in: made once, and again when what they hold has changed."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from .panel import Judge

GLTF_VALIDATOR = "gltf-validator@2.0.0-dev.3.10"
STAMP = "installed.txt"


class NotInstalledError(Exception):
    """A judge cannot be asked here; the message says what it lacks."""


def command(judge: Judge, build: Path) -> list[str]:
    """How to run a judge's script; its environment is made below `build` if need be.

    Raises:
        NotInstalledError: something that only an administrator can install is missing.
        subprocess.CalledProcessError: pip, npm or apt-get failed; it has said why.
    """
    script = str(judge.script_path)
    if judge.home is None:
        return [sys.executable, script]
    if judge.home == "apt":
        _need_check_urdf()
        return [sys.executable, script]
    if judge.home == "npm":
        modules = _npm(build / "npm").resolve() / "node_modules"
        return ["env", f"NODE_PATH={modules}", _need("node"), script]
    assert judge.requirements is not None
    return [str(_venv(build / "venvs" / judge.home, judge.requirements)), script]


def _venv(folder: Path, requirements: Path) -> Path:
    """Its Python."""
    python = folder / "bin" / "python"
    key = hashlib.sha256(requirements.read_bytes() + sys.version.encode()).hexdigest()
    if _is_current(folder, key):
        return python
    _tell(f"installing {folder.name}: {folder}")
    shutil.rmtree(folder, ignore_errors=True)
    _run([sys.executable, "-m", "venv", str(folder)])
    _run([str(python), "-m", "pip", "install", "--quiet", "--requirement", str(requirements)])
    (folder / STAMP).write_text(key, encoding="utf-8")
    return python


def _npm(folder: Path) -> Path:
    """The folder that has node_modules."""
    npm = _need("npm")
    if not _is_current(folder, GLTF_VALIDATOR):
        _tell(f"installing {GLTF_VALIDATOR}: {folder}")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        _run([npm, "install", "--silent", "--no-audit", "--no-fund", "--prefix", str(folder), GLTF_VALIDATOR])
        (folder / STAMP).write_text(GLTF_VALIDATOR, encoding="utf-8")
    return folder


def _need_check_urdf() -> None:
    if shutil.which("check_urdf"):
        return
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise NotInstalledError("no check_urdf: apt-get install liburdfdom-tools")
    _tell("installing liburdfdom-tools by apt-get")
    _run(["apt-get", "install", "--quiet", "--yes", "--no-install-recommends", "liburdfdom-tools"])


def _need(program: str) -> str:
    found = shutil.which(program)
    if found is None:
        raise NotInstalledError(f"no {program}: install Node.js")
    return found


def _is_current(folder: Path, key: str) -> bool:
    stamp = folder / STAMP
    return stamp.exists() and stamp.read_text(encoding="utf-8") == key


def _run(words: list[str]) -> None:
    subprocess.run(words, check=True, stdout=sys.stderr)


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
