"""PNG files without what glTF tells readers to ignore."""

from __future__ import annotations

import struct

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_KEPT = {b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"}


def plain_png(png: bytes) -> bytes:
    """A PNG file without colour profiles, gamma, physical size, texts and times; pixels are the same.

    glTF 2.0 has colour information in pictures ignored; a renderer that heeds it shows other colours.
    """
    kept = [_SIGNATURE]
    start = len(_SIGNATURE)
    while start + 12 <= len(png):
        length, kind = struct.unpack_from(">I4s", png, start)
        if kind in _KEPT:
            kept.append(png[start : start + 12 + length])
        start += 12 + length
    return b"".join(kept)
