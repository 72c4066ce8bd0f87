"""Where a first spec is written, and its picture."""

from __future__ import annotations

from pathlib import Path

from ..errors import OutputError
from .drafting import Draft

_FORMATS = (".toml", ".json")


def spec_path(source: Path, out: Path | None, force: bool) -> Path:
    """The file to write; the default is called after the source, in the working directory.

    Raises:
        OutputError: it is neither TOML nor JSON, has no folder, or is there already and `force` is not given.
    """
    path = out or Path(f"{source.stem}.spec.toml")
    if path.suffix.lower() not in _FORMATS:
        raise OutputError(f"{path}: a spec is a .toml or .json file")
    if path.is_dir() or not path.parent.is_dir():
        what = "is a folder" if path.is_dir() else f"there is no folder {path.parent}"
        raise OutputError(f"{path}: {what}: name a file in a folder that there is")
    if path.exists() and not force:
        raise OutputError(f"{path} is there already: give --force to write over it, or another --out")
    return path


def write_draft(draft: Draft, path: Path, source: Path, recipe: str) -> Path:
    """Write a spec and its picture beside it; returns the picture's path.

    Raises:
        OutputError: the folder cannot be written.
    """
    picture = path.with_suffix(".png")
    try:
        picture.write_bytes(draft.picture)
        path.write_text(draft.text(path, source, recipe), encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error
    return picture
