"""What takes long to make and many tests look at: made by one process of a run for all of them."""

from __future__ import annotations

import fcntl
import io
import os
import pickle
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar

import pytest

R = TypeVar("R")


def made_once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], R]) -> R:
    """What `make` returns; it is called with a new folder by the first process of the run that asks.

    Nobody may change the files in the folder. Each process has a value of its own.

    Args:
        factory: of the folders of this run.
        name: of the folder; what is made depends on nothing else.
        make: returns a value that can be pickled.
    """
    base = factory.getbasetemp()
    home = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder, value = home / name, home / f"{name}.pickle"
    with (home / f"{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # the others wait, rather than do the same work
        if not value.exists():
            folder.mkdir()
            kept = io.BytesIO()
            _Fields(kept).dump(make(folder))
            value.write_bytes(kept.getvalue())
    with value.open("rb") as file:
        made: R = pickle.load(file)
    return made


class _Fields(pickle.Pickler):
    """Of dataclasses, the fields alone: what they keep beside them may be of native code."""

    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, type) or not is_dataclass(value):
            return NotImplemented
        return _filled, (type(value), {field.name: getattr(value, field.name) for field in fields(value)})


def _filled(kind: type, values: dict[str, Any]) -> Any:
    value = object.__new__(kind)
    for name, item in values.items():
        object.__setattr__(value, name, item)
    return value
