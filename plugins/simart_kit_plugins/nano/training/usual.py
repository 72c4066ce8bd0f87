"""What a network makes of objects as they are read in use, not made harder as they are to learn from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments

from ..array_network import ArrayNetwork
from ..cloud import Cloud
from ..generate.catalogue import CATEGORIES, NAMELESS
from ..generate.category import named
from ..generate.data_set import generated
from ..generate.objects import GeneratedObject
from ..meshes import mesh_cloud
from ..network import NanoNetwork
from ..novelty import TokenStatistics, gathered
from .plan import TrainingPlan


def usual_tokens(network: NanoNetwork, plan: TrainingPlan) -> TokenStatistics:
    """The statistics of `plan.held_out` new objects, of all categories that it knows in turn."""
    weights = {name: tensor.detach().cpu().float().numpy() for name, tensor in network.state_dict().items()}
    return gathered(ArrayNetwork(network.config, weights), _clouds(plan))


def _clouds(plan: TrainingPlan) -> Iterator[Cloud]:
    names = plan.network.categories or NAMELESS
    for number in range(plan.held_out):
        category = named(names[number % len(names)], CATEGORIES)
        mesh = _mesh(generated(category, plan.seed, number // len(names)))
        yield mesh_cloud(mesh, find_segments(mesh), np.random.default_rng(number)).cloud


def _mesh(made: GeneratedObject) -> Mesh:
    """The object in the colours of its surfaces, without their texture."""
    surfaces = [surface for body in made.bodies for surface in body.surfaces]
    corners = np.concatenate([one.triangles for one in surfaces]).reshape(-1, 3)
    counts = [3 * len(one.triangles) for one in surfaces]
    colors = np.repeat([(*one.look.color, 255) for one in surfaces], counts, axis=0).astype(np.uint8)
    return Mesh(corners, np.arange(len(corners)).reshape(-1, 3), colors=colors)
