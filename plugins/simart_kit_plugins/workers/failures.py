"""Why a program gave no answer, in one line that says what to do."""

from __future__ import annotations

import re
import signal

from simart_kit.errors import SimartKitError

from .running import Ended

_GPU_MEMORY = re.compile(
    r"CUDA out of memory|OutOfMemoryError|CUDA error: out of memory|CUBLAS_STATUS_ALLOC_FAILED"
)
_NO_MODULE = re.compile(r"ModuleNotFoundError: (No module named '[\w.]+')")
_LONGEST = 240  # characters of a program's own words
_LINES = 3


class WorkerError(SimartKitError):
    """A program of others gave no answer that can be used; the line says why and what to do."""


def reason(ended: Ended, seconds: float) -> str:
    """What went wrong with a program whose status is not 0, as "was killed".

    Args:
        ended: how it ended.
        seconds: how long it was allowed to take.
    """
    if ended.status is None:
        return f"took longer than {seconds:g} s and was stopped: raise segmenter.options.timeout"
    known = explained(ended.output)
    if known:
        return known
    if ended.status in (128 + signal.SIGKILL, -signal.SIGKILL):
        return "was killed (SIGKILL): most likely the memory was full"
    if ended.status > 128:
        return f"crashed ({_signal(ended.status - 128)})"
    return f"failed with status {ended.status}"


def explained(words: str) -> str:
    """What a program's words mean, where they are known to mean something; else ""."""
    if _GPU_MEMORY.search(words):
        return "ran out of GPU memory: free some of it, take a larger GPU, or a mesh with fewer faces"
    missing = _NO_MODULE.search(words)
    if missing:
        return f"failed ({missing[1]}): install that in its own environment, or see segmenter.options.python"
    return ""


def last_lines(output: str) -> str:
    """The last lines that were printed, as one, without control characters; "" where there are none."""
    shown = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", output)  # colours
    lines = ["".join(c for c in line if c.isprintable()).strip() for line in re.split(r"[\r\n]+", shown)]
    return shortened(" | ".join([line for line in lines if line][-_LINES:]))


def shortened(text: str) -> str:
    """The end of a text that is too long to be told: there the reason is."""
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= _LONGEST else f"...{text[-_LONGEST:]}"


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
