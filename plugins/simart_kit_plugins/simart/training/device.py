"""Where training computes, and how it does so the same way twice."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import torch

from simart_kit.errors import BadInputError

# cuBLAS sums in one order only with a workspace of fixed size; read when its first handle is made.
_WORKSPACE = ("CUBLAS_WORKSPACE_CONFIG", ":4096:8")


def training_device(name: str) -> torch.device:
    """The device of a config.

    Raises:
        BadInputError: this machine has no such device.
    """
    device = torch.device(name)
    if device.type == "cuda":
        count = torch.cuda.device_count()
        if (device.index or 0) >= count:
            there = f"its GPUs are cuda:0..cuda:{count - 1}" if count else "torch sees no GPU"
            raise BadInputError(f"device '{name}' is not on this machine: {there}; use another, such as cpu")
    return device


@contextmanager
def deterministic(device: torch.device) -> Iterator[None]:
    """Use only operations whose result is the same each time; torch's settings are restored at the end."""
    before = torch.are_deterministic_algorithms_enabled()
    only_warned = torch.is_deterministic_algorithms_warn_only_enabled()
    benchmark = torch.backends.cudnn.benchmark
    memory: Any = torch.utils.deterministic
    filled = memory.fill_uninitialized_memory
    if device.type == "cuda":
        os.environ.setdefault(*_WORKSPACE)
    torch.use_deterministic_algorithms(True)
    torch.backends.cudnn.benchmark = False
    # Nothing reads what nothing wrote; to fill it takes a sixth of a step.
    memory.fill_uninitialized_memory = False
    try:
        yield
    finally:
        torch.use_deterministic_algorithms(before, warn_only=only_warned)
        torch.backends.cudnn.benchmark = benchmark
        memory.fill_uninitialized_memory = filled
