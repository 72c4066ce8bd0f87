"""Going on from a model: its weights, in a network that may have other names of parts and objects to tell."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from torch import Tensor

from simart_kit.errors import BadInputError

from ..config import NanoConfig
from ..weights import load_model
from .plan import TrainingPlan

# Heads with a row for each name of a list of the config, after one for none of them.
_NAMED = {"label": "labels", "category": "categories"}


def weights_of_start(plan: TrainingPlan, afresh: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The weights of the model that a plan goes on from, as the plan's network has them.

    Args:
        plan: with a `start`.
        afresh: weights of a network of the plan's: the rows of names that the model does not know are taken
            from there. What only the model knows is left out.

    Raises:
        BadInputError: the model cannot be read, or its network is of other sizes than the plan's.
    """
    network = load_model(Path(plan.start)).network
    _check_sizes(plan, network.config)
    weights = {name: tensor.to(plan.device) for name, tensor in network.state_dict().items()}
    for head, names in _NAMED.items():
        known, wanted = ("", *getattr(network.config, names)), ("", *getattr(plan.network, names))
        place = {name: row for row, name in enumerate(known)}
        rows = [row for row, name in enumerate(wanted) if name in place]
        for tensor in (f"{head}.weight", f"{head}.bias"):
            own = afresh[tensor].detach().clone()
            own[rows] = weights[tensor][[place[wanted[row]] for row in rows]]
            weights[tensor] = own
    return weights


def _check_sizes(plan: TrainingPlan, own: NanoConfig) -> None:
    names = set(_NAMED.values())
    has, wanted = own.model_dump(exclude=names), plan.network.model_dump(exclude=names)
    other = [name for name in has if has[name] != wanted[name]]
    if other:
        raise BadInputError(
            f"start: {plan.start} has other {' and '.join(other)} than this training: "
            "begin without --start, or go on from a model that was trained with them"
        )
