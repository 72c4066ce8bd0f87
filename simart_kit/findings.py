"""Finding: what `simart-kit doctor` says of one thing, and how plugins look for what they need."""

from __future__ import annotations

import json
import os
import re
import sys
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from .extras import install_command

State = Literal["ok", "missing", "broken"]
# Distributions whose module has another name.
_MODULES = {"pillow": "PIL", "usd-core": "pxr", "rerun-sdk": "rerun", "pycollada": "collada"}
_POINTER = b"version https://git-lfs"
_LONGEST_HEADER = 100_000_000  # bytes; what the safetensors format allows


@dataclass(frozen=True)
class Finding:
    """What was found of one thing that may be needed.

    Attributes:
        subject: what was looked for, such as "torch" or "weights of nano".
        state: whether it is there and usable.
        detail: version, size or what is wrong, in one line.
        remedy: what to do about it, such as a command; "" where nothing has to be done.
        stages: names of the plugin's stages that cannot work without; None: none of them can. () is for
            what is useful and nothing depends on.
    """

    subject: str
    state: State
    detail: str = ""
    remedy: str = ""
    stages: tuple[str, ...] | None = None

    @property
    def ok(self) -> bool:
        """Whether it is there and usable."""
        return self.state == "ok"


def library(
    distribution: str, *, wanted: str = "", extra: str = "", stages: tuple[str, ...] | None = None
) -> Finding:
    """Look for an installed library, without importing it.

    Args:
        distribution: its name for pip.
        wanted: versions, such as ">=2.5,<3".
        extra: of simart-kit that brings it, or "".
        stages: as in `Finding`.
    """
    remedy = install_command(extra) if extra else f"pip install '{distribution}{wanted}'"
    module = _MODULES.get(distribution, distribution.replace("-", "_"))
    try:
        found = version(distribution)
    except PackageNotFoundError:
        if extra or not _importable(module):
            return Finding(distribution, "missing", "not installed", remedy, stages)
        return Finding(distribution, "ok", "installed, by another name", "", stages)
    if not _importable(module):
        return Finding(distribution, "broken", f"{found}, but there is no module {module}", remedy, stages)
    if not _allowed(found, wanted):
        return Finding(distribution, "broken", f"{found}, needed is {wanted}", remedy, stages)
    return Finding(distribution, "ok", found, "", stages)


def weights(subject: str, folder: Path, remedy: str, *, stages: tuple[str, ...] | None = None) -> Finding:
    """Look at a folder of weights: config.json, and safetensors files as long as their headers say."""
    if not folder.is_dir():
        return Finding(subject, "missing", f"there is no folder {folder}", remedy, stages)
    files = sorted(folder.glob("*.safetensors"))
    if not files or not (folder / "config.json").is_file():
        lacking = "config.json" if files else "*.safetensors"
        return Finding(subject, "missing", f"no {lacking} in {folder}", remedy, stages)
    for file in files:
        wrong = _damage(file)
        if wrong:
            return Finding(subject, "broken", f"{file}: {wrong}", remedy, stages)
    size = sum(file.stat().st_size for file in files)
    return Finding(subject, "ok", f"{size / 1e6:.1f} MB in {folder}", "", stages)


def named_weights(subject: str, name: str, *, stages: tuple[str, ...] | None = None) -> Finding:
    """Look for weights by a folder, or by an id "OWNER/NAME" in the cache of Hugging Face's hub."""
    if Path(name).is_dir():
        return weights(subject, Path(name), "copy the folder again", stages=stages)
    remedy = f"download it with `hf download {name}`, or give a folder"
    if not re.fullmatch(r"[\w.-]+/[\w.-]+", name):
        return Finding(subject, "missing", f"there is no folder {name}", "give a folder that exists", stages)
    cache = hub_cache() / f"models--{name.replace('/', '--')}" / "snapshots"
    snapshots = sorted(cache.glob("*")) if cache.is_dir() else []
    if not snapshots:
        return Finding(subject, "missing", f"{name} is not in {hub_cache()}", remedy, stages)
    looked = [weights(subject, snapshot, remedy, stages=stages) for snapshot in snapshots]
    return next((found for found in looked if found.ok), looked[-1])


def hub_cache() -> Path:
    """Where Hugging Face's hub keeps what was downloaded, by the variables that it reads."""
    home = Path(os.environ.get("HF_HOME") or Path.home() / ".cache" / "huggingface")
    return Path(os.environ.get("HF_HUB_CACHE") or home / "hub")


def _importable(module: str) -> bool:
    if module in sys.modules:
        return sys.modules[module] is not None  # None: its import is forbidden
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def _allowed(found: str, wanted: str) -> bool:
    """Whether a version is within bounds such as ">=2.5,<3"; other bounds are not looked at."""
    for bound in filter(None, wanted.split(",")):
        sign, _, number = re.match(r"\s*([<>=!~]*)(\s*)(.*)", bound).groups()  # type: ignore[union-attr]
        if sign == ">=" and _numbers(found) < _numbers(number):
            return False
        if sign == "<" and _numbers(found) >= _numbers(number):
            return False
    return True


def _numbers(text: str) -> tuple[int, ...]:
    """The release numbers of a version, without zeros at the end, for comparison."""
    release = re.match(r"\d+(\.\d+)*", text)
    numbers = [int(number) for number in release[0].split(".")] if release else []
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)


def _damage(file: Path) -> str:
    """What is wrong with a safetensors file, by its header and its length; "" when nothing is."""
    try:
        with file.open("rb") as stream:
            start = stream.read(8)
            if _POINTER.startswith(start) and start:
                return "a pointer of git-lfs: run `git lfs pull`"
            length = int.from_bytes(start, "little")
            if len(start) < 8 or length > _LONGEST_HEADER:
                return "not a safetensors file"
            header = json.loads(stream.read(length))
        ends = [entry["data_offsets"][1] for key, entry in header.items() if key != "__metadata__"]
    except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        return f"its header cannot be read ({type(error).__name__})"
    size, expected = file.stat().st_size, 8 + length + max(ends, default=0)
    return "" if size == expected else f"{size} bytes, and its header tells of {expected}"
