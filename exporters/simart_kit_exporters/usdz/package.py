"""USDZ packages: zip files with nothing compressed and every file at a multiple of 64 bytes.

https://openusd.org/release/spec_usdz.html. OpenUSD's own packager writes the time of day into them.
"""

from __future__ import annotations

import struct
import zipfile
from pathlib import Path

_ALIGNMENT = 64
_HEADER = 30  # bytes of a zip file's local header, before the name
_PADDING = 0x1986  # id of an extra field that readers skip; OpenUSD takes the same
_EPOCH = (1980, 1, 1, 0, 0, 0)  # the first moment that a zip file can tell


def write_package(path: Path, layer: Path) -> None:
    """Pack a layer, which USDZ wants first, and all else in its folder; the same bytes every time."""
    folder = layer.parent
    others = sorted(file for file in folder.rglob("*") if file.is_file() and file != layer)
    end = 0
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as package:
        for file in (layer, *others):
            entry = zipfile.ZipInfo(file.relative_to(folder).as_posix(), _EPOCH)
            entry.create_system = 0  # else it tells the operating system
            start = end + _HEADER + len(entry.filename.encode())
            entry.extra = _extra(-start % _ALIGNMENT)
            data = file.read_bytes()
            package.writestr(entry, data)
            end = start + len(entry.extra) + len(data)


def _extra(length: int) -> bytes:
    """An extra field of some bytes, or of 64 more where they are too few for one."""
    if 0 < length < 4:
        length += _ALIGNMENT
    return struct.pack("<HH", _PADDING, length - 4) + bytes(length - 4) if length else b""
