"""Names of objects that are a URDF or MJCF file somewhere in a folder."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path

from ...asset_io import ASSET_FILE

USUAL_STEMS = ("mobility", "basic", "model", "robot")
"""File names, without their ends, that systems give to every object."""
_DEPTH = 4
_BY_FORMAT = ("urdf", "mjcf")


def files_below(root: Path, suffix: str) -> list[Path]:
    """Files that end so, in order, at most three folders below `root`; none in hidden folders."""
    levels = ("/".join(["*"] * depth + [f"*{suffix}"]) for depth in range(_DEPTH))
    found = (path for level in levels for path in root.glob(level) if path.is_file())
    return sorted(path for path in found if not _hidden(path.relative_to(root)))


def named(root: Path, files: Sequence[Path]) -> dict[str, Path]:
    """Files by the names of their objects. Of a folder with several, one named as the folder is its object.

    Objects that would have the same name get their path below `root` as a name, with _ for /.
    """
    chosen: list[tuple[str, Path]] = []
    for folder, group in groupby(sorted(files), key=lambda path: path.parent):
        siblings = list(group)
        same = [path for path in siblings if path.stem == folder.resolve().name]
        chosen += [(object_name(path, siblings), path) for path in same or siblings]
    names = [name for name, _ in chosen]
    found = {}
    for name, path in chosen:
        whole = "_".join(path.relative_to(root).with_suffix("").parts)
        found[whole if names.count(name) > 1 else name] = path
    return found


def object_name(path: Path, siblings: Sequence[Path]) -> str:
    """Name of the object that a file holds: of its folder; of the file where several share the folder.

    The folder of one of our outputs names what is exported in it. A folder `urdf` or `mjcf` names nothing:
    then it is the file, or the folder above where the file has a usual name.

    Args:
        path: of the file.
        siblings: the files of objects in its folder, itself among them.
    """
    folder = path.resolve().parent
    for outer in (folder, folder.parent):
        if (outer / ASSET_FILE).is_file():
            return outer.name
    if len(siblings) > 1:
        return path.stem
    if folder.name in _BY_FORMAT:
        return folder.parent.name if path.stem in USUAL_STEMS else path.stem
    return folder.name


def _hidden(path: Path) -> bool:
    return any(part.startswith(".") for part in path.parts)
