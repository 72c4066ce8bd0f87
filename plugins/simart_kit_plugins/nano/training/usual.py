"""What a network makes of objects as they are read in use, not made harder as they are to learn from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments

from ..array_network import ArrayNetwork
from ..generate.catalogue import CATEGORIES, NAMELESS
from ..generate.category import named
from ..generate.data_set import generated
from ..generate.objects import GeneratedObject
from ..kinds import kinds_of, place_of
from ..meshes import mesh_cloud
from ..network import NanoNetwork
from ..novelty import Moments, TokenStatistics, gathered, moments_of, tokens_of
from ..relief_examples import skin_mesh
from ..voting import say
from .plan import TrainingPlan
from .pool import Progress, each

_AT_ONCE = 100  # objects that a process reads before it tells


@dataclass(frozen=True, eq=False)
class _Read:
    """Of an object: the number of its category, its place, and its moments if these are asked for."""

    kind: int
    place: FloatArray
    moments: Moments | None


def usual_tokens(
    network: NanoNetwork, plan: TrainingPlan, processes: int = 1, progress: Progress | None = None
) -> TokenStatistics:
    """The statistics of `plan.held_out` new objects, and of `plan.of_each` of each category that it knows.

    Args:
        network: that reads them.
        plan: of its training.
        processes: that read, some objects at a time.
        progress: told how many are read.
    """
    weights = {name: tensor.detach().cpu().float().numpy() for name, tensor in network.state_dict().items()}
    reading, known = ArrayNetwork(network.config, weights), len(plan.network.categories)
    of_kinds, told = plan.of_each * known, list[_Read]()
    count = max(plan.held_out, of_kinds)
    jobs = [range(first, min(first + _AT_ONCE, count)) for first in range(0, count, _AT_ONCE)]
    for some in each(partial(_read, reading, plan), jobs, processes):
        told += some
        if progress is not None:
            progress(len(told), count)
    statistics = gathered([one.moments for one in told if one.moments is not None])
    if not of_kinds:
        return statistics
    kinds = kinds_of([(one.kind, one.place) for one in told[:of_kinds]], known)
    return replace(statistics, kinds=kinds)


def _read(network: ArrayNetwork, plan: TrainingPlan, numbers: range) -> list[_Read]:
    """Some of the objects, of all categories in turn."""
    names, read = plan.network.categories or NAMELESS, list[_Read]()
    for number in numbers:
        turn, kind = divmod(number, len(names))
        made = generated(named(names[kind], CATEGORIES), plan.seed, turn)
        generator = np.random.default_rng(number)
        skin = plan.relief_share > 0 and generator.random() < plan.relief_share
        mesh = skin_mesh(made, generator) if skin else _mesh(made)
        cloud = mesh_cloud(mesh, find_segments(mesh, relief=skin), generator).cloud
        tokens = tokens_of(say(network, cloud))
        moments = moments_of(tokens) if number < plan.held_out else None
        read.append(_Read(kind, place_of(tokens), moments))
    return read


def _mesh(made: GeneratedObject) -> Mesh:
    """The object in the colours of its surfaces, without their texture."""
    surfaces = [surface for body in made.bodies for surface in body.surfaces]
    corners = np.concatenate([one.triangles for one in surfaces]).reshape(-1, 3)
    counts = [3 * len(one.triangles) for one in surfaces]
    colors = np.repeat([(*one.look.color, 255) for one in surfaces], counts, axis=0).astype(np.uint8)
    return Mesh(corners, np.arange(len(corners)).reshape(-1, 3), colors=colors)
