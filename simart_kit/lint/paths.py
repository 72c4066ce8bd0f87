"""Rules on the files that a file names: there, inside the asset's folder, by relative paths."""

from __future__ import annotations

import re
from pathlib import Path

from .findings import Finding

_ABSOLUTE = re.compile(r"^(?:[a-zA-Z][\w+.-]*:|[/\\~])")  # URLs and drive letters alike


def is_absolute(name: str) -> bool:
    """Whether a name is an absolute path on any system, or a URL."""
    return bool(_ABSOLUTE.match(name))


def path_finding(name: str, home: Path, root: Path, where: str) -> Finding | None:
    """The breach by a file's name, or None.

    Args:
        name: as the file says it.
        home: folder that relative names start from.
        root: folder of the asset, out of which no name may lead; links count as where they lead to.
        where: what names the file.
    """
    if is_absolute(name):
        return Finding(
            "file-absolute", where, f"'{name}' is absolute: copy it into the folder, name it relatively"
        )
    try:
        target = (home / name.replace("\\", "/")).resolve()
        inside, there = target.is_relative_to(root.resolve()), target.is_file()
    except (OSError, ValueError, RuntimeError):  # no system has such a name, or links lead in a circle
        inside, there = True, False
    if not inside:
        return Finding("file-escapes", where, f"'{name}' is outside the asset's folder: copy it there")
    if not there:
        return Finding("file-missing", where, f"'{name}' does not exist: add it, or drop what names it")
    return None
