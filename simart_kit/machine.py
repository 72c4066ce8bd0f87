"""The machine in a few lines: system, processor, memory and accelerator, found without any library."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from pathlib import Path

from .findings import Finding

_GPU_SECONDS = 1.0  # the driver's own tool may hang
_DRIVER = Path("/proc/driver/nvidia/gpus")


def machine() -> tuple[Finding, ...]:
    """What simart-kit runs on; nothing of it is ever missing, but a GPU, which nothing needs."""
    return (
        Finding("python", "ok", f"{platform.python_version()} ({platform.python_implementation()})"),
        Finding("platform", "ok", platform.platform(terse=True)),
        Finding("processor", "ok", _processor()),
        Finding("memory", "ok", _memory()),
        _gpu(),
    )


def usable_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _processor() -> str:
    return f"{platform.machine()}, {usable_cores()} of {os.cpu_count()} cores usable"


def _memory() -> str:
    """Size of the memory, and the limit that a container sets, where it does."""
    try:
        total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return "not known on this system"
    limit = _number(Path("/sys/fs/cgroup/memory.max"))
    told = f"{total / 2**30:.1f} GiB"
    return (
        told if limit is None or limit >= total else f"{told}, of which {limit / 2**30:.1f} GiB may be used"
    )


def _gpu() -> Finding:
    if platform.system() == "Darwin" and platform.machine() == "arm64":
        return Finding("GPU", "ok", "Apple, by Metal", stages=())
    tool = shutil.which("nvidia-smi")
    if tool:
        told = _asked(tool)
        if told:
            return Finding("GPU", "ok", told, stages=())
        return Finding("GPU", "broken", "nvidia-smi gives no answer", "see to the driver", stages=())
    count = len(list(_DRIVER.glob("*"))) if _DRIVER.is_dir() else 0
    if count:
        return Finding("GPU", "ok", f"{count} by NVIDIA", stages=())
    return Finding("GPU", "missing", "none found; all runs on the processor", stages=())


def _asked(tool: str) -> str:
    """Names and memory of NVIDIA's GPUs; "" when their driver does not answer."""
    query = [tool, "--query-gpu=name,memory.total", "--format=csv,noheader"]
    try:
        done = subprocess.run(query, capture_output=True, text=True, timeout=_GPU_SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return "; ".join(done.stdout.split("\n")).strip("; ") if done.returncode == 0 else ""


def _number(path: Path) -> int | None:
    try:
        return int(path.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return None
