"""The tables and the binary chunk of a GLB file while they are filled.

https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from simart_kit.mesh import Image

from .png import plain_png

Json = dict[str, Any]

VERTICES, INDICES = 34962, 34963  # targets of buffer views
_COMPONENTS = {"float32": 5126, "uint16": 5123, "uint32": 5125}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_LINEAR, _MIPMAPS, _REPEAT = 9729, 9987, 10497


class Builder:
    """Collects what a GLB holds; whatever is added gets an index in its table."""

    def __init__(self) -> None:
        self._tables: dict[str, list[Json]] = {}
        self._data = bytearray()
        self._textures: dict[bytes, int] = {}

    def add(self, table: str, entry: Json) -> int:
        """Append to a top-level table such as "nodes"; returns its index there."""
        entries = self._tables.setdefault(table, [])
        entries.append(entry)
        return len(entries) - 1

    def add_array(
        self, values: NDArray[Any], target: int | None = None, *, bounds: bool = False, unit: bool = False
    ) -> int:
        """Add an accessor.

        Args:
            values: (N,) or (N, 2..4) float32, uint16 or uint32, rows of a multiple of 4 bytes for vertices.
            target: `VERTICES`, `INDICES`, or None for what is not drawn.
            bounds: whether to tell the least and greatest values.
            unit: whether integers stand for 0..1.
        """
        rows = values.reshape(len(values), -1)
        entry: Json = {
            "bufferView": self._add_view(np.ascontiguousarray(values).tobytes(), target),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(rows),
            "type": _TYPES[rows.shape[1]],
        }
        if unit:
            entry["normalized"] = True
        if bounds:
            entry |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return self.add("accessors", entry)

    def add_texture(self, image: Image) -> int:
        """Add a picture that repeats, once however often it is used."""
        png = plain_png(image.png)
        if png not in self._textures:
            if not self._textures:
                sampler = {"magFilter": _LINEAR, "minFilter": _MIPMAPS, "wrapS": _REPEAT, "wrapT": _REPEAT}
                self.add("samplers", sampler)
            source = self.add("images", {"bufferView": self._add_view(png), "mimeType": "image/png"})
            self._textures[png] = self.add("textures", {"sampler": 0, "source": source})
        return self._textures[png]

    def glb(self, top: Json) -> bytes:
        """The file, with `top` as further members of the JSON document."""
        document = {"asset": {"version": "2.0", "generator": "simart-kit"}, **top, **self._tables}
        document["buffers"] = [{"byteLength": len(self._data)}]
        text = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()
        chunks = [(b"JSON", text + b" " * (-len(text) % 4)), (b"BIN\0", bytes(self._data))]
        body = b"".join(struct.pack("<I4s", len(data), kind) + data for kind, data in chunks)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body

    def _add_view(self, data: bytes, target: int | None = None) -> int:
        entry: Json = {"buffer": 0, "byteOffset": len(self._data), "byteLength": len(data)}
        if target:
            entry["target"] = target
        self._data += data + bytes(-len(data) % 4)
        return self.add("bufferViews", entry)
