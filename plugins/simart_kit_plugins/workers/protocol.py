"""What a worker is asked, and what it answers: files in a folder that is its last argument.

A worker is a script that runs in the environment of what it calls. simart-kit writes

    request.json   {"protocol": 1, "folder": the checkout, "options": {...}}
    mesh.npz       vertices (V, 3) float64, faces (F, 3) int32

and the worker answers with

    result.npz     the arrays that were agreed on
    result.json    {"protocol": 1, "status": "ok"}, or {"protocol": 1, "status": "error", "message": why}

result.json comes last, and the worker ends with status 0 in both cases. What it prints is kept, and shown
when something fails.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .failures import WorkerError, explained, shortened
from .surface import Surface

PROTOCOL = 1
RESULT = "result.npz"
_LONGEST_STATUS = 1 << 16  # bytes of result.json


def write_request(folder: Path, surface: Surface, checkout: Path, options: Mapping[str, Any]) -> None:
    """Write what a worker is asked into an empty folder."""
    request = {"protocol": PROTOCOL, "folder": str(checkout), "options": dict(options)}
    (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
    np.savez(folder / "mesh.npz", vertices=surface.vertices, faces=surface.faces)


def check_status(folder: Path) -> None:
    """See that a worker says that it is done.

    Raises:
        WorkerError: it says nothing, something else, or that it failed.
    """
    path = folder / "result.json"
    if not path.is_file():
        raise WorkerError("wrote no result.json")
    try:
        with path.open("rb") as file:
            told = json.loads(file.read(_LONGEST_STATUS))
        protocol, status, message = told["protocol"], told["status"], str(told.get("message", ""))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise WorkerError("wrote a result.json that cannot be read") from None
    if protocol != PROTOCOL:
        raise WorkerError(f"speaks protocol {shortened(str(protocol))}: expected is {PROTOCOL}")
    if status == "error":
        raise WorkerError(explained(message) or f"failed: {shortened(message) or 'it does not say why'}")
    if status != "ok":
        raise WorkerError(f"says that its status is '{shortened(str(status))}'")
