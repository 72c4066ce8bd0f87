"""Small objects with known parts and joints, whose sizes and areas are easy to work out by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray, IntArray, Vec3
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Prediction, Truth

Piece = tuple[Link, Vec3, Vec3]
"""A link that is a box, with its lower and upper corner."""

BODY, DOOR_LEFT, DOOR_RIGHT, DRAWER = range(4)
# Face areas of the cabinet's parts: 4 walls of 1 x 0.5 and 2 of 1 x 1; 0.5 x 0.75 x 0.02; 1 x 0.25 x 0.02.
AREAS = (4.0, 0.8, 0.8, 0.55)

# Two triangles for each side of a box, counter-clockwise from outside; corner number = 4 x + 2 y + z.
_SIDES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5],
        [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
        [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip


def box(lower: Vec3, upper: Vec3) -> tuple[FloatArray, IntArray]:
    """(8, 3) corners and (12, 3) triangles of a closed box."""
    ends = np.array([lower, upper])
    corners = [(ends[i, 0], ends[j, 1], ends[k, 2]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    return np.array(corners), _SIDES.copy()


def of_boxes(name: str, pieces: Sequence[Piece]) -> Articulation:
    """An object of one box a link, 12 faces each, in the order given."""
    boxes = [box(lower, upper) for _, lower, upper in pieces]
    return Articulation(
        name,
        np.concatenate([corners for corners, _ in boxes]),
        np.concatenate([faces + 8 * i for i, (_, faces) in enumerate(boxes)]),
        np.repeat(np.arange(len(pieces)), 12),
        tuple(link for link, _, _ in pieces),
    )


def cabinet(name: str = "cabinet") -> Articulation:
    """A cabinet with two doors that open to the front (+Z) by 90 degrees, and a drawer above; +Y up.

    Body x -0.5..0.5, y 0..1, z -0.25..0.25; the fronts are 0.02 thick on its front side. Longest side 1.
    """
    left = LinkJoint("revolute", (0, 1, 0), (-0.5, 0.4, 0.25), -math.pi / 2, 0.0, "left_hinge")
    right = LinkJoint("revolute", (0, 1, 0), (0.5, 0.4, 0.25), 0.0, math.pi / 2, "right_hinge")
    slide = LinkJoint("prismatic", (0, 0, 1), (0.0, 0.875, 0.25), 0.0, 0.3, "drawer_slide")
    return of_boxes(
        name,
        [
            (Link("body", label="cabinet"), (-0.5, 0.0, -0.25), (0.5, 1.0, 0.25)),
            (Link("door_left", BODY, left, label="door"), (-0.5, 0.0, 0.25), (0.0, 0.75, 0.27)),
            (Link("door_right", BODY, right, label="door"), (0.0, 0.0, 0.25), (0.5, 0.75, 0.27)),
            (Link("drawer", BODY, slide, label="drawer"), (-0.5, 0.75, 0.25), (0.5, 1.0, 0.27)),
        ],
    )


def block(name: str = "block") -> Articulation:
    """A unit cube on the ground (y 0..1) that nothing moves on."""
    return of_boxes(name, [(Link("body"), (-0.5, 0.0, -0.5), (0.5, 1.0, 0.5))])


def fan(name: str = "fan") -> Articulation:
    """A post, a blade that spins on it (continuous about +Z), and a weight that slides out on the blade."""
    spin = LinkJoint("continuous", (0, 0, 1), (0.0, 1.0, 0.1), name="spin")
    slide = LinkJoint("prismatic", (1, 0, 0), (0.0, 1.0, 0.2), 0.0, 0.5, "slide")
    return of_boxes(
        name,
        [
            (Link("post"), (-0.1, 0.0, -0.1), (0.1, 1.2, 0.1)),
            (Link("blade", 0, spin), (-0.8, 0.9, 0.1), (0.8, 1.1, 0.2)),
            (Link("weight", 1, slide), (0.0, 0.95, 0.2), (0.1, 1.05, 0.3)),
        ],
    )


def with_link(articulation: Articulation, index: int, link: Link) -> Articulation:
    """The object with one link replaced."""
    links = list(articulation.links)
    links[index] = link
    return replace(articulation, links=tuple(links))


def with_joint(articulation: Articulation, index: int, joint: LinkJoint) -> Articulation:
    """The object with the joint of one link replaced."""
    return with_link(articulation, index, replace(articulation.links[index], joint=joint))


def truth(articulation: Articulation, category: str = "", mesh: Path | None = None) -> Truth:
    """The object as truth, by its own name; +Y up, metres."""
    return Truth(articulation.name, articulation, category, mesh)


def prediction(articulation: Articulation) -> Prediction:
    """The object as a prediction of nobody in particular."""
    return Prediction(articulation)
