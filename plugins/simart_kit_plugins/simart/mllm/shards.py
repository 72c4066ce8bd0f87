"""Weights files: whether all are there, whole, and of one model, told from their headers alone."""

from __future__ import annotations

import json
from pathlib import Path

from simart_kit.errors import BadInputError

INDEX_FILE = "model.safetensors.index.json"
SINGLE_FILE = "model.safetensors"
ADAPTER_FILE = "adapter_model.safetensors"
IDENTITY = "simart"
"""Key of a weights file's metadata: `Settings.identity` of the model that it belongs to."""
_LARGEST_HEADER = 100_000_000


def check_weights(folder: Path, identity: str | None = None) -> tuple[Path, ...]:
    """Check a folder's weights without reading them, and return the files.

    Args:
        folder: with `model.safetensors`, or shards and their index.
        identity: what the files must carry; None for those of a plain model.

    Raises:
        BadInputError: a file is missing, truncated, damaged, or of another model; it is named.
    """
    single, index = folder / SINGLE_FILE, folder / INDEX_FILE
    if index.is_file():
        return _check_shards(folder, _weight_map(index), identity)
    if not single.is_file():
        raise BadInputError(f"{folder} has no weights: neither {SINGLE_FILE} nor {INDEX_FILE} is in it")
    check_file(single, identity)
    return (single,)


def check_file(path: Path, identity: str | None = None) -> frozenset[str]:
    """Check one file and return the names of its tensors; raises BadInputError as `check_weights` does."""
    header = _header(path)
    found = header.pop("__metadata__", {}).get(IDENTITY)
    if identity is not None and found != identity:
        raise BadInputError(
            f"{path} belongs to another model: it carries {found or 'no mark'} and simart.json says "
            f"{identity}; weights, tokenizer and codebook must be those that were saved together"
        )
    return frozenset(header)


def sort_metadata(path: Path) -> None:
    """Put a file's metadata in order, so that the same model gives the same bytes: the library writes any."""
    with path.open("r+b") as file:
        length = int.from_bytes(file.read(8), "little")
        header = json.loads(file.read(length))
        header["__metadata__"] = dict(sorted(header["__metadata__"].items()))
        text = json.dumps(header, separators=(",", ":"), ensure_ascii=False).encode()
        file.seek(8)
        file.write(text.ljust(length))


def _check_shards(folder: Path, places: dict[str, str], identity: str | None) -> tuple[Path, ...]:
    files = sorted(set(places.values()))
    missing = [name for name in files if not (folder / name).is_file()]
    if missing:
        raise BadInputError(f"{folder}: {', '.join(missing)} of {len(files)} weights files is missing")
    for name in files:
        there = check_file(folder / name, identity)
        absent = [tensor for tensor, place in places.items() if place == name and tensor not in there]
        if absent:
            raise BadInputError(f"{folder / name} lacks '{absent[0]}', which {INDEX_FILE} says it has")
    return tuple(folder / name for name in files)


def _weight_map(index: Path) -> dict[str, str]:
    try:
        table = json.loads(index.read_text(encoding="utf-8"))["weight_map"]
        return {str(tensor): Path(file).name for tensor, file in table.items()}
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise BadInputError(f"{index} is damaged: it has no weight_map of tensors to files") from error


def _header(path: Path) -> dict[str, dict[str, object]]:
    """Header of a safetensors file, checked against the file's size."""
    size = path.stat().st_size
    with path.open("rb") as file:
        length = int.from_bytes(file.read(8), "little")
        if size < 8 or length > min(size - 8, _LARGEST_HEADER):
            raise BadInputError(f"{path} is truncated or no safetensors file: copy or download it again")
        text = file.read(length)
    try:
        header: dict[str, dict[str, object]] = json.loads(text)
        ends = [entry["data_offsets"][1] for name, entry in header.items() if name != "__metadata__"]  # type: ignore[index]
        expected = 8 + length + max(map(int, ends), default=0)
    except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        raise BadInputError(f"{path} is damaged: its header cannot be read; download it again") from error
    if size != expected:
        raise BadInputError(
            f"{path} is truncated: it has {size:,} of {expected:,} bytes; copy or download it again"
        )
    return header
