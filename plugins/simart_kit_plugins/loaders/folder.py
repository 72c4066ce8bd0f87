"""The files beside a source file, and nothing else on the disk."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

from simart_kit import BadInputError


class AssetFolder:
    r"""Reads what a mesh file refers to, from the file's own folder and below; remembers what it could not.

    Has the methods that trimesh asks of a resolver.

    Args:
        source: the mesh file.
        within: the folder that files must lie in: the source's own, or one around it.
        strict: names must be right as they stand. Otherwise a name with a wrong folder, as exporters leave in
            MTL and DAE files ("C:\\\\work\\\\wood.png"), is looked for beside the source too.

    Attributes:
        file_name: of the source.
        missing: a sentence for each name that was asked for in vain.
    """

    def __init__(self, source: Path, within: Path, strict: bool) -> None:
        self.file_name = source.name
        self.missing: list[str] = []
        self._home, self._root = source.parent.resolve(), within.resolve()
        self._strict = strict

    def get(self, name: str) -> bytes:
        """The bytes of a file; raises BadInputError for one that is missing or outside the folder."""
        candidates = [name, unquote(name)]
        if not self._strict:
            plain = unquote(name.strip().strip('"')).replace("\\", "/").removeprefix("file://")
            candidates += [plain, plain.rsplit("/", 1)[-1]]
        for candidate in candidates:
            if path := inside(self._root, str(self._home / candidate)):
                return path.read_bytes()
        outside = all(
            inside(self._root, str(self._home / candidate), exists=False) is None for candidate in candidates
        )
        reason = "is outside its folder: copy it there" if outside else "is not in its folder: copy it there"
        sentence = f"'{name}', which it refers to, {reason}"
        if sentence not in self.missing:
            self.missing.append(sentence)
        raise BadInputError(sentence)

    def __getitem__(self, name: str) -> bytes:
        return self.get(name)

    def keys(self) -> Iterator[str]:
        """Names of all files below the folder."""
        return (p.relative_to(self._root).as_posix() for p in self._root.rglob("*") if p.is_file())


def inside(root: Path, name: str, exists: bool = True) -> Path | None:
    """The file of this name below `root`; None when it lies elsewhere (also by a link) or is not there."""
    try:
        path = (root / name).resolve()
        fits = path.is_relative_to(root) and (path.is_file() or not exists)
    except (OSError, ValueError):  # a name that no file can have
        return None
    return path if fits else None
