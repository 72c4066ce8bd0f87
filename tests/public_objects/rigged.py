"""Rigged: an object as its source has it, pieces of surface on links with joints."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bench.articulation import FULL_TURN, Articulation, Link, LinkJoint
from simart_kit.bench.formats.mesh_files import joined
from simart_kit.mesh import UpAxis

GREY = np.array([178.0, 178.0, 178.0])


@dataclass(frozen=True, eq=False)
class Piece:
    """A surface of one link.

    Attributes:
        vertices: (V, 3) in the frame of the object.
        faces: (F, 3).
        colors: (V, 3) or (3,) sRGB, 0..255.
        link: index of its link.
    """

    vertices: FloatArray
    faces: IntArray
    colors: FloatArray
    link: int


@dataclass(frozen=True, eq=False)
class Rigged:
    """An object in the frame and unit of its source.

    Attributes:
        pieces: in the order of the source, which that of the faces follows.
        links: the first is the base.
        up: which axis points up.
        scale: length of a unit [m].
        category: such as "cabinet"; "" where the source does not say.
        notes: what a reader of the truth should know.
    """

    pieces: tuple[Piece, ...]
    links: tuple[Link, ...]
    up: UpAxis = "+z"
    scale: float = 1.0
    category: str = ""
    notes: tuple[str, ...] = ()

    def articulation(self, name: str) -> Articulation:
        """The object with its pieces as one surface."""
        vertices, faces = joined([(piece.vertices, piece.faces) for piece in self.pieces])
        labels = np.concatenate([np.full(len(piece.faces), piece.link) for piece in self.pieces])
        return Articulation(name, vertices, faces, labels, self.links)

    def colors(self) -> FloatArray:
        """(V, 3) colours of the vertices of that surface."""
        return np.concatenate([np.broadcast_to(p.colors, (len(p.vertices), 3)) for p in self.pieces])


def unlimited(joint: LinkJoint) -> LinkJoint:
    """The joint; a turn without limits, or with some that hold nothing back, is continuous."""
    if joint.kind != "revolute":
        return joint
    if joint.lower is not None and joint.upper is not None and 0 < joint.upper - joint.lower < FULL_TURN:
        return joint
    return replace(joint, kind="continuous", lower=None, upper=None)
