"""V-HACD and CoACD at arm's length: in their own process, with a time limit, and their answer checked."""

from __future__ import annotations

import importlib.util
import io
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np

from .arrays import FloatArray, IntArray
from .extras import install_command

Tool = Literal["vhacd", "coacd"]
_MODULES = {"vhacd": "vhacdx", "coacd": "coacd"}
_INSTALL = {"vhacd": "pip install vhacdx", "coacd": install_command("coacd")}
_WORKER = (sys.executable, str(Path(__file__).with_name("convex_worker.py")))
_ASTRAY = 0.1  # of the mesh's size that a hull may reach beyond it


class DecompositionError(Exception):
    """A tool gave no usable answer; the text says why, in a phrase."""


def lacks(tool: Tool) -> str:
    """What to do to install a tool; "" when it is there."""
    return "" if importlib.util.find_spec(_MODULES[tool]) else _INSTALL[tool]


def run_tool(
    tool: Tool,
    vertices: FloatArray,
    faces: IntArray,
    most: int,
    corners: int,
    seconds: float,
    worker: Sequence[str] = _WORKER,
) -> list[FloatArray]:
    """(N, 3) points of each convex piece of a mesh [m].

    Args:
        tool: which.
        vertices: (V, 3) [m].
        faces: (F, 3).
        most: pieces.
        corners: of each piece, at most.
        seconds: after which the process is killed.
        worker: command that answers as `convex_worker` does.

    Raises:
        DecompositionError: it took too long, crashed, or its answer is no set of pieces within the mesh.
    """
    buffer = io.BytesIO()
    np.savez(buffer, tool=tool, most=most, corners=corners, vertices=vertices, faces=faces)
    try:
        done = subprocess.run(
            worker, input=buffer.getvalue(), capture_output=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        raise DecompositionError(f"{tool} took longer than {seconds:.3g} s") from None
    if done.returncode:
        last = done.stderr.decode(errors="replace").strip().rpartition("\n")[2]
        raise DecompositionError(f"{tool} failed with status {done.returncode}{last and ': ' + last[:200]}")
    return _checked(tool, done.stdout, vertices)


def _checked(tool: Tool, answer: bytes, vertices: FloatArray) -> list[FloatArray]:
    """The pieces in an answer, if they lie where the mesh is."""
    try:
        with np.load(io.BytesIO(answer), allow_pickle=False) as arrays:
            hulls = [np.asarray(arrays[f"hull_{i}"], dtype=np.float64) for i in range(len(arrays.files))]
    except (ValueError, KeyError, OSError, EOFError, zipfile.BadZipFile, AttributeError):
        raise DecompositionError(f"{tool} gave an answer that cannot be read") from None
    if not hulls:
        raise DecompositionError(f"{tool} found no pieces")
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    slack = _ASTRAY * float(np.linalg.norm(upper - lower))
    for hull in hulls:
        fits = hull.ndim == 2 and hull.shape[1] == 3 and len(hull) >= 4 and np.isfinite(hull).all()
        if not (fits and (hull >= lower - slack).all() and (hull <= upper + slack).all()):
            raise DecompositionError(f"{tool} gave a piece that does not lie in the mesh")
    return hulls
