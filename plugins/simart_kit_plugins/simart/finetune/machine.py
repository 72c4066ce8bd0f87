"""Where a fine-tuning computes: devices and processes, through accelerate."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import torch
from torch import nn

from simart_kit.errors import BadInputError

from .adapters import plain_model
from .plan import FinetunePlan

if TYPE_CHECKING:
    from accelerate import Accelerator


# A thread of gloo's drops the tensors of the last exchange as soon as it gets hold of the interpreter [s]. If
# that is ending by then, the process aborts.
_LETTING_GO = 0.2


@contextmanager
def machine(plan: FinetunePlan, device: str) -> Iterator[Accelerator]:
    """The processes of this run, as `accelerate launch` or `torchrun` started them, or this one alone.

    Args:
        plan: precision, lanes and whether weights are shared out.
        device: auto, cpu or cuda.

    Raises:
        BadInputError: there is no such device, or the plan does not fit the number of processes.
    """
    from accelerate import Accelerator
    from accelerate.state import AcceleratorState

    if device == "cuda" and not torch.cuda.is_available():
        raise BadInputError("device 'cuda' is not on this machine: torch sees no GPU; use cpu")
    mixed = "bf16" if plan.precision == "bf16" and not plan.fsdp else "no"
    accelerator = Accelerator(cpu=device == "cpu", mixed_precision=mixed)
    try:
        if plan.lanes % accelerator.num_processes:
            raise BadInputError(
                f"{plan.lanes} lanes cannot be shared out over {accelerator.num_processes} processes: "
                "take a multiple"
            )
        yield accelerator
    finally:
        if accelerator.num_processes > 1:
            time.sleep(_LETTING_GO)
        # accelerate keeps the first precision of a process for good; the next run may want another.
        AcceleratorState._reset_state()


def sharded(objective: nn.Module, plan: FinetunePlan, accelerator: Accelerator) -> nn.Module:
    """The module with its weights shared out over the processes (FSDP2), a decoder layer at a time.

    The vision tower and the embeddings belong to the whole: a tower whose layers are gathered one by one
    would have to run in all processes at the same moment.
    """
    from torch.distributed.device_mesh import init_device_mesh
    from torch.distributed.fsdp import MixedPrecisionPolicy, fully_shard

    mesh = init_device_mesh(accelerator.device.type, (accelerator.num_processes,))
    low = torch.bfloat16 if plan.precision == "bf16" else None
    policy = MixedPrecisionPolicy(param_dtype=low, reduce_dtype=torch.float32)
    for layer in plain_model(objective.model).model.language_model.layers:
        fully_shard(layer, mesh=mesh, mp_policy=policy)
    fully_shard(objective, mesh=mesh, mp_policy=policy)
    return objective


def average_gradients(module: nn.Module, accelerator: Accelerator) -> None:
    """Make the gradients of all processes their mean, where the weights are not shared out."""
    for parameter in module.parameters():
        if parameter.requires_grad:
            if parameter.grad is None:  # such as the vision tower's, where no picture was shown
                parameter.grad = torch.zeros_like(parameter)
            parameter.grad = accelerator.reduce(parameter.grad, reduction="mean")


def whole_state(module: nn.Module) -> dict[str, Any]:
    """The weights of a module in one piece, on the first process; all processes must call it."""
    from torch.distributed.checkpoint.state_dict import StateDictOptions, get_model_state_dict

    options = StateDictOptions(full_state_dict=True, cpu_offload=True)
    return get_model_state_dict(module, options=options)
