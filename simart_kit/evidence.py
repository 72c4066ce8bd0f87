"""What a stage can give a recording to show how it came to its result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .arrays import ByteArray, Float32Array, FloatArray, IntArray, frozen_bytes, frozen_floats, frozen_ints
from .voxels import GridFrame


@dataclass(frozen=True, eq=False)
class VoxelEvidence:
    """Cells of a cubic grid, each with a number or a kind.

    Attributes:
        name: of its view; several pieces of evidence of one stage have names of their own.
        frame: where the grid lies, in the mesh's frame [m].
        indices: (K, 3) int32 cells.
        values: (K,) float64 numbers, drawn on a scale from the least to the greatest; or (K,) int32 kinds
            from 0 on, such as codes or part ids, drawn in a colour each.
        names: of the kinds 0, 1, ..., for a legend; none for kinds without names, and for numbers.

    Raises:
        ValueError: wrong shapes, values that are not finite, or kinds that the names do not cover.
    """

    name: str
    frame: GridFrame
    indices: IntArray
    values: FloatArray | IntArray
    names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Check the shapes and take copies that nobody can write to."""
        where = _named(self.name, "voxel evidence")
        _require_shape(where, "indices", self.indices, (len(self.indices), 3))
        _require_shape(where, "values", self.values, (len(self.indices),))
        object.__setattr__(self, "indices", frozen_ints(self.indices))
        if self.categorical:
            _require_kinds(where, self.values, self.names)
        elif self.names:
            raise ValueError(f"{where}: names are for whole values 0, 1, ..., found {self.values.dtype}")
        freeze = frozen_ints if self.categorical else frozen_floats
        object.__setattr__(self, "values", freeze(self.values))
        _require_finite(where, self.values)

    @property
    def categorical(self) -> bool:
        """Whether the values are kinds, not numbers."""
        return bool(np.issubdtype(self.values.dtype, np.integer))


@dataclass(frozen=True, eq=False)
class PointEvidence:
    """Points in groups, such as the seeds of each part.

    Attributes:
        name: of its view.
        points: (N, 3) in the mesh's frame [m].
        group: (N,) int32 group of each point, 0..G-1.
        names: G names of groups; drawn in the colours that parts of these numbers have.

    Raises:
        ValueError: wrong shapes, values that are not finite, or groups without a name.
    """

    name: str
    points: FloatArray
    group: IntArray
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        """Check the shapes and take copies that nobody can write to."""
        where = _named(self.name, "point evidence")
        _require_shape(where, "points", self.points, (len(self.points), 3))
        _require_shape(where, "group", self.group, (len(self.points),))
        if not self.names:
            raise ValueError(f"{where}: groups need names")
        _require_kinds(where, self.group, self.names)
        object.__setattr__(self, "points", frozen_floats(self.points))
        object.__setattr__(self, "group", frozen_ints(self.group))
        _require_finite(where, self.points)


@dataclass(frozen=True, eq=False)
class VertexEvidence:
    """Shares at the vertices of the mesh, such as the probability of each part.

    Attributes:
        name: of its view.
        values: (V, P) float32 shares 0..1 of P things at the mesh's vertices; (V,) for a single one.
        names: P names; for (V,) values none are needed.

    Raises:
        ValueError: wrong shapes, shares outside 0..1, or as many names as there are not things.
    """

    name: str
    values: Float32Array
    names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Check the shapes and take a copy that nobody can write to."""
        where = _named(self.name, "vertex evidence")
        if self.values.ndim == 1 and not self.names:
            object.__setattr__(self, "values", self.values[:, None])
            object.__setattr__(self, "names", (self.name,))
        _require_shape(where, "values", self.values, (len(self.values), len(self.names)))
        if not ((self.values >= 0) & (self.values <= 1 + 1e-6)).all():
            raise ValueError(f"{where}: shares must lie in 0..1")
        values = np.array(self.values, dtype=np.float32)
        values.setflags(write=False)
        object.__setattr__(self, "values", values)


@dataclass(frozen=True, slots=True)
class TextEvidence:
    """Words, such as what a language model was asked and said.

    Attributes:
        name: of its view.
        markdown: the text.

    Raises:
        ValueError: there is no name.
    """

    name: str
    markdown: str

    def __post_init__(self) -> None:
        """Check the name."""
        _named(self.name, "text evidence")


@dataclass(frozen=True, eq=False)
class PictureEvidence:
    """A picture, such as the one that a model was shown.

    Attributes:
        name: of its view.
        pixels: (H, W, 3) uint8 sRGB.

    Raises:
        ValueError: another shape or dtype, or no pixel.
    """

    name: str
    pixels: ByteArray

    def __post_init__(self) -> None:
        """Check the shape and take a copy that nobody can write to."""
        where = _named(self.name, "picture evidence")
        if self.pixels.dtype != np.uint8:
            raise ValueError(f"{where}: pixels must be uint8, found {self.pixels.dtype}")
        _require_shape(where, "pixels", self.pixels, (*self.pixels.shape[:2], 3))
        if not self.pixels.size:
            raise ValueError(f"{where}: there is no pixel")
        object.__setattr__(self, "pixels", frozen_bytes(self.pixels))


Evidence = VoxelEvidence | PointEvidence | VertexEvidence | TextEvidence | PictureEvidence


def check_evidence(evidence: Sequence[Evidence], vertices: int) -> None:
    """Refuse evidence that is not of a mesh with so many vertices, or that shares its name.

    Raises:
        ValueError: naming the piece of evidence.
    """
    names = [piece.name for piece in evidence]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ValueError(f"evidence '{twice[0]}' comes twice: each needs a name of its own")
    for piece in evidence:
        if isinstance(piece, VertexEvidence) and len(piece.values) != vertices:
            raise ValueError(
                f"evidence '{piece.name}' has {len(piece.values)} rows for a mesh of {vertices} vertices"
            )


def _named(name: str, kind: str) -> str:
    if not name.strip():
        raise ValueError(f"{kind} needs a name: its view is called by it")
    return f"evidence '{name}'"


def _require_shape(where: str, what: str, array: Any, expected: tuple[int, ...]) -> None:
    if array.shape != expected:
        raise ValueError(f"{where}: {what} has shape {array.shape}, expected {expected}")


def _require_kinds(where: str, kinds: Any, names: tuple[str, ...]) -> None:
    if not np.issubdtype(kinds.dtype, np.integer):
        raise ValueError(f"{where}: groups must be whole numbers, found {kinds.dtype}")
    if kinds.size and (kinds.min() < 0 or (names and kinds.max() >= len(names))):
        raise ValueError(f"{where}: {kinds.min()}..{kinds.max()} for {len(names)} names")


def _require_finite(where: str, values: Any) -> None:
    if not np.isfinite(values).all():
        raise ValueError(f"{where}: values must be finite")
