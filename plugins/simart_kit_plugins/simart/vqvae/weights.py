"""Tensors of a safetensors file, checked against what a model expects before any of them is used."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from simart_kit.errors import BadInputError

_FLOATS = ("F64", "F32", "F16", "BF16")
_INTEGERS = {torch.int64: ("I64",), torch.int8: ("I8",)}
# Names told of each kind of mistake; a file of another model has hundreds.
_TOLD = 4


def read_tensors(path: Path, expected: Mapping[str, Tensor], advice: str) -> dict[str, Tensor]:
    """Read exactly the tensors of `expected`, each in its type; half precision becomes float32.

    Args:
        path: a safetensors file.
        expected: names, shapes and types, such as a model's state_dict.
        advice: what to do about a wrong file; ends the message.

    Raises:
        BadInputError: the file cannot be read or is damaged, or a tensor is missing, unexpected, of another
            shape or type, or not finite. All names and shapes that are wrong are in the one message.
    """
    with _opened(path, advice) as file:
        _check(path, file, expected, advice)
        tensors = {name: file.get_tensor(name).to(like.dtype) for name, like in expected.items()}
    wrong = [name for name, tensor in tensors.items() if not torch.isfinite(tensor).all()]
    if wrong:
        raise BadInputError(f"{path}: {_some(wrong)} not finite: {advice}")
    return tensors


def names(path: Path, advice: str) -> set[str]:
    """The names of the tensors of a safetensors file; errors as of `read_tensors`."""
    with _opened(path, advice) as file:
        return set(file.keys())


@contextmanager
def _opened(path: Path, advice: str) -> Iterator[Any]:
    from safetensors import SafetensorError, safe_open

    try:
        with safe_open(path, framework="pt") as file:
            yield file
    except FileNotFoundError as error:
        raise BadInputError(f"cannot read {path}: no such file: {advice}") from error
    except (OSError, SafetensorError) as error:
        raise BadInputError(
            f"cannot read {path}: damaged or no safetensors file ({error}): {advice}"
        ) from error


def _check(path: Path, file: Any, expected: Mapping[str, Tensor], advice: str) -> None:
    present = set(file.keys())
    missing = [name for name in expected if name not in present]
    unexpected = sorted(present - set(expected))
    shared = [name for name in expected if name in present]
    misfits = [text for name in shared if (text := _misfit(name, file.get_slice(name), expected[name]))]
    mistakes = [f"missing {_some(missing)}"] if missing else []
    mistakes += [f"unexpected {_some(unexpected)}"] if unexpected else []
    mistakes += [_some(misfits)] if misfits else []
    if mistakes:
        raise BadInputError(f"{path} does not fit: {'; '.join(mistakes)}: {advice}")


def _misfit(name: str, found: Any, like: Tensor) -> str:
    shape, kind = tuple(found.get_shape()), found.get_dtype()
    if shape != tuple(like.shape):
        return f"{name} is {shape}, not {tuple(like.shape)}"
    kinds = _FLOATS if like.is_floating_point() else _INTEGERS[like.dtype]
    return "" if kind in kinds else f"{name} is of type {kind}, not {' or '.join(kinds)}"


def _some(texts: list[str]) -> str:
    """The first few, and how many more."""
    more = f" and {len(texts) - _TOLD} more" if len(texts) > _TOLD else ""
    return ", ".join(texts[:_TOLD]) + more
