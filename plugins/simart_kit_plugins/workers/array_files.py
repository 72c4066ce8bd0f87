"""Arrays in an .npz file that somebody else wrote: read only when they are what was agreed on."""

from __future__ import annotations

import struct
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .failures import WorkerError

Arrays = Mapping[str, NDArray[Any]]
_DAMAGE = (OSError, ValueError, KeyError, EOFError, RuntimeError, NotImplementedError, zipfile.BadZipFile)
_KINDS = {"whole numbers": "iu", "numbers": "f"}


@dataclass(frozen=True)
class Expected:
    """What an array has to be.

    Attributes:
        kind: "whole numbers" for integers, "numbers" for finite floats.
        shape: -1 for any length.
    """

    kind: Literal["whole numbers", "numbers"]
    shape: tuple[int, ...]


def read_arrays(path: Path, expected: Mapping[str, Expected], most: int) -> Arrays:
    """Read the arrays that are expected, and no others.

    Args:
        path: an .npz file.
        expected: what each has to be, by its name.
        most: bytes that they may take together; what is longer is not read.

    Raises:
        WorkerError: the file is missing or damaged, or an array is missing, too long, of another dtype or
            shape, or holds NaN or infinity; in a phrase such as "wrote no result.npz".
    """
    if not path.is_file():
        raise WorkerError(f"wrote no {path.name}")
    found = {}
    try:
        with zipfile.ZipFile(path) as archive:
            for name, wanted in expected.items():
                found[name] = _read(archive, path.name, name, wanted, most)
                most -= found[name].nbytes
    except (*_DAMAGE, zlib.error, struct.error):
        raise WorkerError(f"wrote a {path.name} that cannot be read") from None
    return found


def _read(archive: zipfile.ZipFile, file: str, name: str, wanted: Expected, most: int) -> NDArray[Any]:
    """One array; its header is looked at before anything is read."""
    if f"{name}.npy" not in archive.namelist():
        raise WorkerError(f"wrote a {file} without '{name}'")
    with archive.open(f"{name}.npy") as stream:
        if np.lib.format.read_magic(stream) != (1, 0):
            raise ValueError("another version of the format")
        shape, fortran, dtype = np.lib.format.read_array_header_1_0(stream)
        _check(name, shape, dtype, wanted)
        size = int(np.prod(shape, dtype=object)) * dtype.itemsize
        if size > most:
            raise WorkerError(f"wrote a '{name}' of {size / 1e6:.0f} MB: more than there can be")
        content = stream.read(size + 1)  # the end of the member is where its checksum is looked at
    if len(content) != size:
        raise ValueError("shorter or longer than its header says")
    array = np.frombuffer(content, dtype).reshape(shape, order="F" if fortran else "C")
    if wanted.kind == "numbers" and not np.isfinite(array).all():
        raise WorkerError(f"wrote a '{name}' with values that are NaN or infinite")
    return array


def _check(name: str, shape: tuple[int, ...], dtype: np.dtype[Any], wanted: Expected) -> None:
    if dtype.kind not in _KINDS[wanted.kind]:
        raise WorkerError(f"wrote a '{name}' of dtype {dtype}: expected are {wanted.kind}")
    fits = len(shape) == len(wanted.shape) and all(
        n in (-1, m) for n, m in zip(wanted.shape, shape, strict=True)
    )
    if not fits:
        raise WorkerError(f"wrote a '{name}' of shape {shape}: expected is {wanted.shape} (-1 is any)")
