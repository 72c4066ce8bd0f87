"""One number for what is in the files of an object or of a prediction, to see whether they have changed."""

from __future__ import annotations

import hashlib
import html
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from .rows import SETTINGS_FILE

_XML = (".urdf", ".xml")
_VALUE = re.compile(r"""(\w+)\s*=\s*(["'])([^<\n]+?)\2""")


def fingerprint(*paths: Path) -> str:
    """SHA-256 over the files that belong to some paths: their names and what is in them.

    A folder stands for all that is in it, but for hidden files and for benchmark runs. A file stands for
    itself, the files beside it that are named alike, such as NAME.glb beside NAME.gt.json, the meshes of
    PhysXNet's table, and what a URDF or MJCF file names.

    Returns:
        64 hexadecimal digits, the same wherever the paths lie; "" where there is no file.
    """
    files = sorted({file.resolve() for path in paths for file in _files(path)})
    if not files:
        return ""
    base = (paths[0] if paths[0].is_dir() else paths[0].parent).resolve()
    total = hashlib.sha256()
    for file in files:
        name = os.path.relpath(file, base).replace(os.sep, "/")
        total.update(os.fsencode(name) + b"\0" + _digest(file))
    return total.hexdigest()


def _digest(file: Path) -> bytes:
    try:
        with file.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").digest()
    except OSError as error:  # the reader of the format will say so in the object's row
        return str(error.errno).encode()


def _files(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from _below(path)
    elif path.is_file():
        yield from _with_named([path])
        stem = path.name.partition(".")[0]
        yield from (other for other in path.parent.glob(f"{_literal(stem)}.*") if other.is_file())
        yield from _below(path.parent / stem)
        if path.parent.name == "finaljson":
            yield from _below(path.parent.parent / "partseg" / path.stem)


def _below(folder: Path) -> Iterator[Path]:
    for place, folders, files in os.walk(folder):
        here = Path(place)
        folders[:] = [
            name
            for name in folders
            if not name.startswith(".") and not (here / name / SETTINGS_FILE).exists()
        ]
        yield from (here / name for name in files if not name.startswith(".") and (here / name).is_file())


def _with_named(files: Iterable[Path]) -> Iterator[Path]:
    """Files that XML files name, and all files in the folders; what XML files among them name, too."""
    left, seen = list(files), set[Path]()
    while left:
        file = left.pop()
        if file in seen:
            continue
        seen.add(file)
        yield file
        if file.suffix.lower() in _XML:
            left += _places(file)


def _places(file: Path) -> Iterator[Path]:
    """Existing files that the values in an XML file may mean; packages may lie around its folder.

    Of MJCF's `meshdir` and the like, all files.
    """
    try:
        text = file.read_text(encoding="utf-8", errors="replace")
    except OSError:  # the reader of the format will say so in the object's row
        return
    folder = file.resolve().parent
    for key, value in sorted({(key, html.unescape(value)) for key, _, value in _VALUE.findall(text)}):
        scheme, found, path = value.rpartition("://")
        outer = [folder, *folder.parents] if found and scheme != "file" else [folder]
        names = [path, path.partition("/")[2]] if found else [path]
        places = [place / name for place in outer for name in names if name]
        yield from (place.resolve() for place in places if _is_file(place))
        if key.endswith("dir") and Path(os.path.normpath(folder / value)) not in (folder, *folder.parents):
            yield from _below(folder / value)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a value that is no path, such as a list of numbers
        return False


def _literal(name: str) -> str:
    """A name as a glob pattern."""
    return re.sub(r"([*?[])", r"[\1]", name)
