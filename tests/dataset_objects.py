"""Objects of boxes for data sets, whose states and descriptions are easy to work out by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from simart_kit_plugins.simart.dataset.building import Build, build, build_options
from simart_kit_plugins.simart.dataset.jobs import Jobs
from simart_kit_plugins.simart.dataset.manifest import Manifest
from simart_kit_plugins.simart.dataset.source_object import SourceObject
from simart_kit_plugins.simart.dataset.truths import source_object
from simart_kit_plugins.simart.default_model import LoadedModel, load_model

from simart_kit.arrays import Vec3
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.cases import Truth

from .bench_objects import of_boxes

Piece = tuple[Link, Vec3, Vec3]


def boxed(pieces: Sequence[Piece], category: str = "thing") -> SourceObject:
    """An object of boxes, given with +Z up and fronts at -Y, as a source gives it."""
    truth = Truth("boxes", of_boxes("boxes", pieces), category, up="+z")
    return source_object(truth, "test-boxes", "test")


def chest() -> SourceObject:
    """Body 1 x 1 x 1, a drawer that slides out to the front (-Y), and on it a knob that turns about Y."""
    slide = LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.4)
    turn = LinkJoint("revolute", (0, 1, 0), (0.0, -0.5, 0.5), -math.pi / 2, math.pi / 2)
    return boxed(
        [
            (Link("body", label="body"), (-0.5, -0.4, 0.0), (0.5, 0.6, 1.0)),
            (Link("drawer", 0, slide, label="drawer"), (-0.4, -0.5, 0.4), (0.4, 0.3, 0.6)),
            (Link("knob", 1, turn, label="knob"), (-0.05, -0.55, 0.45), (0.05, -0.5, 0.55)),
        ]
    )


def drawers(places: Sequence[tuple[float, float]], names: Sequence[str] = ()) -> SourceObject:
    """A body with drawers whose fronts have these middles (x, z), 0..1 of its width and height."""
    slide = LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.3)
    called = list(names) or [f"drawer_{number}" for number in range(len(places))]
    fronts: list[Piece] = [
        (Link(name, 0, slide, label="drawer"), (x - 0.05, -0.02, z - 0.05), (x + 0.05, 0.0, z + 0.05))
        for name, (x, z) in zip(called, places, strict=True)
    ]
    return boxed([(Link("body", label="body"), (0.0, 0.0, 0.0), (1.0, 0.5, 1.0)), *fronts])


def few(categories: Sequence[str], count: int = 1, seed: int = 0) -> Jobs:
    """Jobs of generated objects."""
    return Jobs((), (), tuple(categories), count, seed)


def built(
    out: Path,
    jobs: Jobs,
    *,
    states: int = 2,
    shard_size: int = 3,
    limit: int | None = None,
    workers: int = 1,
    pictures: bool = False,
    max_parts: int = 32,
) -> Manifest:
    """A data set made with the shipped model."""
    codec = _codec()
    options = build_options(jobs, codec, states, pictures, max_parts, shard_size, limit)
    return build(Build(jobs, options, codec.grid, None, workers), out, lambda progress: None)


@cache
def _codec() -> LoadedModel:
    return load_model()
