"""Finds what must not be in an exported folder: absolute paths, ways out of the folder, and times."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

# Ways in which URDF, MJCF, OBJ, MTL and USD name another file.
_REFERENCES = (
    re.compile(r"""\b(?:filename|file|href|src|uri|meshdir|texturedir|assetdir)\s*=\s*["']([^"']*)["']"""),
    re.compile(r"^\s*(?:mtllib|map_\w+|bump|disp|norm)\s(?:.*\s)?(\S+)\s*$", re.MULTILINE),
    re.compile(r"@([^@\n]+)@"),
)
_OUTSIDE = re.compile(r"^(?:/|~|[A-Za-z]:[\\/]|\w+://)|(?:^|[\\/])\.\.(?:[\\/]|$)")
_PACKAGE = re.compile(r"^package://[\w.-]+/")
_TIME = re.compile(r"\b(?:19|20)\d\d-[01]\d-[0-3]\d\b|\b[0-2]\d:[0-5]\d:[0-5]\d\b")


def complaints(directory: Path, forbidden: Iterable[str]) -> list[str]:
    """A sentence for everything in a folder that ties it to a place or a moment.

    Args:
        directory: the exported folder.
        forbidden: texts that no file may hold, such as the path that was exported to.
    """
    found = []
    for path in sorted(p for p in directory.rglob("*") if p.is_file()):
        name, data = path.relative_to(directory).as_posix(), path.read_bytes()
        found += [f"{name} holds the path {text}" for text in forbidden if text.encode() in data]
        try:
            found += [f"{name} {text}" for text in _text_complaints(data.decode("utf-8"))]
        except UnicodeDecodeError:
            continue  # a binary file: only the paths above can be searched for
    return found


def _text_complaints(text: str) -> list[str]:
    references = [match for pattern in _REFERENCES for match in pattern.findall(text)]
    outside = [r for r in references if _OUTSIDE.search(_PACKAGE.sub("", r))]
    return [f"names {r}, which is outside its folder" for r in outside] + [
        f"holds what looks like a time: {moment}" for moment in _TIME.findall(text)
    ]
