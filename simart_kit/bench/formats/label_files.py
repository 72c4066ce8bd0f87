"""Arrays of labels, one a face, in files of NumPy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import IntArray, frozen_ints
from ...errors import BadInputError
from .files import reading

_LARGEST_LABEL = 2**31 - 1


def read_npy(path: Path) -> IntArray:
    """(N,) labels of a .npy file; see `checked_labels`.

    Raises:
        BadInputError: the file is missing or damaged, or holds something else.
    """
    with reading(path, "a NumPy array"):
        # Opened here: numpy leaves a file that it cannot read open.
        with path.open("rb") as file:
            stored = np.load(file, allow_pickle=False)
        if not isinstance(stored, np.ndarray):
            raise BadInputError("it is an archive of several arrays: give one .npy")
        return checked_labels(stored)


def read_npz_labels(path: Path, name: str) -> IntArray:
    """(N,) labels of one array of a .npz file; see `checked_labels`.

    Raises:
        BadInputError: the file is missing or damaged, or has no such array or another kind of one.
    """
    with reading(path, "a NumPy archive"), path.open("rb") as file:
        stored = np.load(file, allow_pickle=False)
        if not isinstance(stored, np.lib.npyio.NpzFile):
            raise BadInputError("it is a single array: a .npz archive is needed")
        with stored:
            if name not in stored.files:
                known = ", ".join(map(repr, stored.files)) or "nothing"
                raise BadInputError(f"it has no array '{name}', but {known}")
            return checked_labels(stored[name])


def checked_labels(stored: ArrayLike) -> IntArray:
    """(N,) labels as integers, of an array of one dimension that holds whole numbers.

    Raises:
        BadInputError: another shape or type, fractions, NaN, or numbers beyond 32 bits.
    """
    values = np.asarray(stored)
    if values.ndim != 1:
        raise BadInputError(f"labels of shape {values.shape}: one number a face is needed")
    if values.dtype.kind not in "iuf":
        raise BadInputError(f"labels of type {values.dtype}: whole numbers are needed")
    if values.size and not (np.isfinite(values).all() and np.array_equal(values, np.round(values))):
        raise BadInputError("labels with fractions or NaN: whole numbers are needed")
    if values.size and (values.min() < -_LARGEST_LABEL or values.max() > _LARGEST_LABEL):
        raise BadInputError(f"labels {values.min()}..{values.max()}: beyond 32 bits")
    return frozen_ints(values)
