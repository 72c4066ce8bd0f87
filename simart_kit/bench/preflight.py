"""Mistakes that would fail every object alike: told once, before a run writes anything."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..errors import BadInputError
from .formats import DEFAULT_VARIANT, TruthFormat, prediction_formats
from .numbers import listed

_TRIED = 200  # objects that are looked for in other folders, to give a hint
_FOLDERS = 20  # folders that are looked into for it


def check_variant(truths: Mapping[str, tuple[TruthFormat, Path]], variant: str) -> None:
    """Raises BadInputError where no object has a variant, with the variants of one of them.

    Objects that are damaged are left to the run: each becomes a row that says so.
    """
    if variant == DEFAULT_VARIANT:
        return
    told = []
    for reader, path in truths.values():
        error = _error(reader, path, variant)
        if not error:
            return
        told.append(error)
    for error, (reader, path) in zip(told, truths.values(), strict=True):
        if not _error(reader, path, DEFAULT_VARIANT):
            raise BadInputError(f"no object has the variant '{variant}': {error}")


def check_predictions(root: Path, names: Sequence[str]) -> None:
    """Raises BadInputError where a folder holds no prediction for any object; says what it holds instead."""
    if _any_predicted(root, names):
        return
    others = f" or any other of the {len(names)} objects" if len(names) > 1 else ""
    there = sorted(path.name for path in root.iterdir() if not path.name.startswith("."))
    held = f"it holds {listed(there)}" if there else "it is empty"
    folders = [root / name for name in there[:_FOLDERS] if (root / name).is_dir()]
    near = [folder for folder in (*folders, root.parent) if _any_predicted(folder, names[:_TRIED])]
    known = "; ".join(reader.layout for reader in prediction_formats())
    hint = f"did you mean {near[0]}?" if near else f"name files and folders by their objects: {known}"
    raise BadInputError(f"no prediction for '{names[0]}'{others} in {root}: {held}; {hint}")


def _any_predicted(root: Path, names: Sequence[str]) -> bool:
    return any(_is_predicted(root, name) for name in names)


def _is_predicted(root: Path, name: str) -> bool:
    try:
        return any(reader.find(root, name) is not None for reader in prediction_formats())
    except BadInputError:
        return True  # there are several; the object's row will say so


def _error(reader: TruthFormat, path: Path, variant: str) -> str:
    """Why a variant of an object cannot be read, or ""."""
    try:
        reader.read(path, variant)
    except Exception as error:  # whatever it is, the object's row will say so, with its traceback
        return str(error) or type(error).__name__
    return ""
