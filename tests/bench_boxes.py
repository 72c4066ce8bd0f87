"""Small articulations for tests of the bench: boxes as meshes, or points as they are."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Prediction, Truth

BODY = Link("body")
_QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
_BOX_FACES = np.array([f for a, b, c, d in _QUADS for f in ((a, b, c), (a, c, d))])


def corners(lower: Sequence[float], upper: Sequence[float]) -> FloatArray:
    """(8, 3) corners of a box."""
    return np.array(list(product(*zip(lower, upper, strict=True))), dtype=float)


def boxes(
    links: Sequence[Link], sizes: Sequence[tuple[Sequence[float], Sequence[float]]], labels: Sequence[int]
) -> Articulation:
    """A mesh of boxes of 12 faces each.

    Args:
        links: of the object.
        sizes: lower and upper corner of each box.
        labels: the link of each box.
    """
    vertices = np.concatenate([corners(lower, upper) for lower, upper in sizes])
    faces = np.concatenate([_BOX_FACES + 8 * i for i in range(len(sizes))])
    return Articulation("boxes", vertices, faces, np.repeat(labels, 12), tuple(links))


def cloud(*parts: tuple[Link, FloatArray]) -> Articulation:
    """Points as they are, a link with its points each."""
    points = [np.asarray(p, dtype=float).reshape(-1, 3) for _, p in parts]
    labels = np.repeat(np.arange(len(parts)), [len(p) for p in points])
    links = tuple(link for link, _ in parts)
    return Articulation("cloud", np.concatenate(points), np.zeros((0, 3), int), labels, links)


def slide(axis: Sequence[float] = (1, 0, 0), upper: float = 0.4, name: str = "") -> LinkJoint:
    """A prismatic joint from 0 to `upper`."""
    x, y, z = (float(v) for v in axis)
    return LinkJoint("prismatic", (x, y, z), (0.0, 0.0, 0.0), 0.0, upper, name)


def hinge(
    origin: Sequence[float] = (0, 0, 0),
    axis: Sequence[float] = (0, 0, 1),
    limits: tuple[float, float] | None = (0.0, 1.5),
    kind: str = "revolute",
    name: str = "",
) -> LinkJoint:
    """A joint that turns."""
    lower, upper = limits or (None, None)
    x, y, z = (float(v) for v in axis)
    a, b, c = (float(v) for v in origin)
    return LinkJoint(kind, (x, y, z), (a, b, c), lower, upper, name)  # type: ignore[arg-type]


def truth(articulation: Articulation) -> Truth:
    """As a truth."""
    return Truth("object", articulation)


def prediction(articulation: Articulation) -> Prediction:
    """As a prediction."""
    return Prediction(articulation)
