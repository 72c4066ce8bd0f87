"""Memory: what a model needs against what there is, before anything large is read."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from simart_kit.errors import BadInputError

from .counts import cache_numbers, parameter_counts
from .placing import Placing
from .sizes import MllmSize

GB = 1e9
_BYTES = {"float32": 4.0, "bfloat16": 2.0, "float16": 2.0}
# A quantised number, with the scales of its block.
_QUANTISED = {"none": None, "8bit": 1.03, "4bit": 0.56}
# Length of a long prompt and its answer, for the cache.
_TOKENS = 8192
# Libraries, activations and what the allocator cannot use.
_OVERHEAD = {"cpu": 0.4 * GB, "cuda": 1.5 * GB}
_SLACK = 1.05
# Larger models give about one token a second on a CPU, and an answer has some hundred.
_SLOW = 4_000_000_000


def needed_bytes(size: MllmSize, placing: Placing, voxel_tokens: int = 0) -> float:
    """Memory that asking a model takes: weights, the cache of a long prompt, and room to work."""
    counts, width = parameter_counts(size, voxel_tokens), _BYTES[placing.dtype]
    small = _QUANTISED[placing.quantisation]
    matrices = counts.layers + counts.vision
    weights = (counts.embeddings + counts.head) * width + matrices * (width if small is None else small)
    cache = _TOKENS * cache_numbers(size) * width
    return _SLACK * weights + cache + _OVERHEAD[placing.kind]


def available_bytes(placing: Placing) -> float | None:
    """Memory that is free on a device; None where the system does not tell."""
    if placing.kind == "cuda":
        import torch

        return float(torch.cuda.mem_get_info(torch.device(placing.device))[0])
    known = [value for value in (_system_bytes(), _container_bytes()) if value is not None]
    return min(known, default=None)


def require_memory(
    name: str, size: MllmSize, placing: Placing, *, voxel_tokens: int = 0, allow_slow: bool = False
) -> None:
    """Refuse a model that is too large for a device or too slow on it.

    Args:
        name: of the model, for messages.
        size: of its config.
        placing: where it shall go.
        voxel_tokens: tokens that are yet to be added.
        allow_slow: a CPU is good enough for a large one.

    Raises:
        BadInputError: with what is needed and what there is.
    """
    total = parameter_counts(size, voxel_tokens).total
    if placing.kind == "cpu" and total > _SLOW and not allow_slow:
        raise BadInputError(
            f"{name} has {total / GB:.1f} billion parameters, which a CPU runs at about one token a second: "
            "use a GPU (device cuda), a smaller model, or say that slow is fine (allow_slow)"
        )
    needed, available = needed_bytes(size, placing, voxel_tokens), available_bytes(placing)
    if available is not None and needed > available:
        raise BadInputError(
            f"{name} ({total / GB:.2g} billion parameters, {_kept(placing)}) needs {needed / GB:.1f} GB "
            f"of memory on {placing.device} and {available / GB:.1f} GB are free: use "
            f"{_advice(placing)}a smaller model or another device"
        )


@contextmanager
def memory_told(what: str) -> Iterator[None]:
    """Turn running out of memory, on a GPU or a CPU, into a BadInputError of one line.

    Args:
        what: was done, such as "loading MODEL".
    """
    import torch

    try:
        yield
    except (torch.OutOfMemoryError, MemoryError) as error:
        raise _out_of_memory(what, error) from error
    except RuntimeError as error:  # what torch's CPU allocator raises
        if "not enough memory" not in str(error) and "can't allocate memory" not in str(error):
            raise
        raise _out_of_memory(what, error) from error


def _out_of_memory(what: str, error: BaseException) -> BadInputError:
    lines = str(error).strip().splitlines()
    said = f" ({lines[0].rstrip('.')})" if lines else ""
    return BadInputError(
        f"out of memory while {what}{said}: free some, or use a smaller model, fewer objects at once, "
        "quantisation, or another device"
    )


def _kept(placing: Placing) -> str:
    return placing.dtype if placing.quantisation == "none" else placing.quantisation


def _advice(placing: Placing) -> str:
    if placing.kind == "cuda" and placing.quantisation != "4bit":
        return "quantisation 4bit, "
    return "dtype bfloat16, " if placing.dtype == "float32" else ""


def _system_bytes(path: Path = Path("/proc/meminfo")) -> float | None:
    """Memory that programs may still take: as Linux tells, else all that the machine has."""
    if path.is_file():
        for line in path.read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return float(line.split()[1]) * 1024
    if "SC_PHYS_PAGES" not in os.sysconf_names:
        return None
    return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))


def _container_bytes(folder: Path = Path("/sys/fs/cgroup")) -> float | None:
    """What a container's limit leaves; None where there is no limit."""
    limit, used = folder / "memory.max", folder / "memory.stat"
    if not limit.is_file() or not used.is_file() or limit.read_text().strip() == "max":
        return None
    table = dict(line.split() for line in used.read_text().splitlines())
    # Cached files are given back when memory is asked for.
    return float(limit.read_text()) - float(table.get("anon", 0))
