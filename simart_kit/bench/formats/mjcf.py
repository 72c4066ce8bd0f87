"""MJCF as truth (https://mujoco.readthedocs.io/en/stable/XMLreference.html), in the frame of its world."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from ...errors import BadInputError
from ..cases import Truth
from . import DEFAULT_VARIANT, TruthFormat
from .found_files import files_below, named, object_name
from .mjcf_model import articulation, compiled
from .urdf import check_variant

_HEAD = 1024


class MjcfTruth(TruthFormat):
    """Objects that are an MJCF file with its meshes. Metres, +z up, in the pose of the file."""

    name = "mjcf"
    layout = "NAME/*.xml with its mesh files, or NAME.xml; the root is <mujoco>"

    def find(self, root: Path) -> dict[str, Path]:
        """XML files that start with <mujoco>, by name: of the folder, or of the file where it has several.

        A file that another one beside it includes is a piece of that one.
        """
        if root.is_file():
            return {_name(root): root} if root.suffix.lower() == ".xml" and _is_mjcf(root) else {}
        return named(root, _models(files_below(root, ".xml")))

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read one file."""
        check_variant(path, variant)
        try:
            found = articulation(compiled(path), _name(path))
        except BadInputError as error:
            raise BadInputError(f"{path}: {error}") from error
        several = [link.name for link in found.links if link.also]
        text = f"bodies with several joints, any of which is right to predict: {', '.join(several)}"
        return Truth(found.name, found, up="+z", notes=(text,) if several else ())


def _name(path: Path) -> str:
    return object_name(path, _models(path.parent.glob("*.xml")))


def _models(files: Iterable[Path]) -> list[Path]:
    models = [path for path in sorted(files) if _is_mjcf(path)]
    folders = [path.parent for path in models]
    crowded = [path for path in models if folders.count(path.parent) > 1]
    pieces = {path.parent / name for path in crowded for name in _included(path)}
    return [path for path in models if path not in pieces]


def _is_mjcf(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return b"<mujoco" in file.read(_HEAD)
    except OSError:
        return False


def _included(path: Path) -> list[str]:
    return re.findall(r'<include\s[^>]*file="([^"]+)"', path.read_text(encoding="utf-8", errors="replace"))
