"""Array types, and the one way to make an array that nobody can write to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
IntArray = NDArray[np.integer[Any]]
ByteArray = NDArray[np.uint8]
BoolArray = NDArray[np.bool_]
T = TypeVar("T", bound=np.generic)
Vec3 = tuple[float, float, float]
Mat3 = tuple[Vec3, Vec3, Vec3]
UP: Vec3 = (0.0, 0.0, 1.0)


def frozen_floats(values: ArrayLike) -> FloatArray:
    """A read-only, contiguous float64 array; never a view of a writable one."""
    return _freeze(np.array(values, dtype=np.float64, order="C"))


def frozen_ints(values: ArrayLike) -> IntArray:
    """A read-only, contiguous int32 array; never a view of a writable one."""
    return _freeze(np.array(values, dtype=np.int32, order="C"))


def frozen_bools(values: ArrayLike) -> BoolArray:
    """A read-only, contiguous bool array; never a view of a writable one."""
    return _freeze(np.array(values, dtype=np.bool_, order="C"))


def frozen_bytes(values: ArrayLike) -> ByteArray:
    """A read-only, contiguous uint8 array; never a view of a writable one."""
    return _freeze(np.array(values, dtype=np.uint8, order="C"))


def vec3(values: Sequence[float] | FloatArray) -> Vec3:
    """Three plain floats, as values hold them."""
    x, y, z = (float(v) for v in values)
    return (x, y, z)


def mat3(values: Sequence[Sequence[float]] | FloatArray) -> Mat3:
    """Three rows of three plain floats."""
    a, b, c = (vec3(row) for row in values)
    return (a, b, c)


def unit(values: Sequence[float] | FloatArray) -> FloatArray:
    """The vector divided by its length; raises ValueError when it has none."""
    vector = np.asarray(values, dtype=np.float64)
    length = float(np.linalg.norm(vector))
    if not np.isfinite(length) or length < 1e-12:
        raise ValueError(f"a direction needs a length, got {vector.tolist()}")
    return vector / length


def units(vectors: FloatArray, otherwise: Vec3 = (0.0, 0.0, 0.0)) -> FloatArray:
    """(N, 3) vectors divided by their lengths; `otherwise` where that is 0."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    result = np.tile(np.array(otherwise), (len(vectors), 1))
    return np.asarray(np.divide(vectors, length, out=result, where=length > 0))


def sums_by(vectors: FloatArray, label: IntArray) -> FloatArray:
    """(L, 3) sums of the (N, 3) vectors that have each of the labels 0.., all of which occur."""
    return np.column_stack([np.bincount(label, column) for column in vectors.T])


def _freeze(array: NDArray[T]) -> NDArray[T]:
    array.setflags(write=False)
    return array
