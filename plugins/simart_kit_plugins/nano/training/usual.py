"""What a network makes of objects as they are read in use, not made harder as they are to learn from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments

from ..array_network import ArrayNetwork
from ..cloud import Cloud
from ..generate.catalogue import CATEGORIES, NAMELESS
from ..generate.category import named
from ..generate.data_set import generated
from ..generate.objects import GeneratedObject
from ..kinds import kinds_of, place_of
from ..meshes import mesh_cloud
from ..network import NanoNetwork
from ..novelty import TokenStatistics, gathered, tokens_of
from ..voting import say
from .plan import TrainingPlan
from .pool import Progress, each

_AT_ONCE = 100  # objects that a process measures before it tells


def usual_tokens(
    network: NanoNetwork, plan: TrainingPlan, processes: int = 1, progress: Progress | None = None
) -> TokenStatistics:
    """The statistics of `plan.held_out` new objects, and of `plan.of_each` of each category that it knows.

    Args:
        network: that reads them.
        plan: of its training.
        processes: that measure the latter, some at a time.
        progress: told how many of them are.
    """
    weights = {name: tensor.detach().cpu().float().numpy() for name, tensor in network.state_dict().items()}
    reading, known = ArrayNetwork(network.config, weights), len(plan.network.categories)
    statistics = gathered(reading, (cloud for _, cloud in _clouds(plan, range(plan.held_out))))
    total, told = plan.of_each * known, list[tuple[int, FloatArray]]()
    if not total:
        return statistics
    jobs = [range(first, min(first + _AT_ONCE, total)) for first in range(0, total, _AT_ONCE)]
    for some in each(partial(_places, reading, plan), jobs, processes):
        told += some
        if progress is not None:
            progress(len(told), total)
    return replace(statistics, kinds=kinds_of(told, known))


def _places(network: ArrayNetwork, plan: TrainingPlan, numbers: range) -> list[tuple[int, FloatArray]]:
    return [(kind, place_of(tokens_of(say(network, cloud)))) for kind, cloud in _clouds(plan, numbers)]


def _clouds(plan: TrainingPlan, numbers: range) -> Iterator[tuple[int, Cloud]]:
    """Some of the objects, of all categories in turn, and the number of the category of each."""
    names = plan.network.categories or NAMELESS
    for number in numbers:
        turn, kind = divmod(number, len(names))
        mesh = _mesh(generated(named(names[kind], CATEGORIES), plan.seed, turn))
        yield kind, mesh_cloud(mesh, find_segments(mesh), np.random.default_rng(number)).cloud


def _mesh(made: GeneratedObject) -> Mesh:
    """The object in the colours of its surfaces, without their texture."""
    surfaces = [surface for body in made.bodies for surface in body.surfaces]
    corners = np.concatenate([one.triangles for one in surfaces]).reshape(-1, 3)
    counts = [3 * len(one.triangles) for one in surfaces]
    colors = np.repeat([(*one.look.color, 255) for one in surfaces], counts, axis=0).astype(np.uint8)
    return Mesh(corners, np.arange(len(corners)).reshape(-1, 3), colors=colors)
