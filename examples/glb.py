"""Writes one mesh with one PNG texture as a binary glTF 2.0 file (Khronos specification, section 4.4)."""

from __future__ import annotations

import json
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

_FLOAT, _USHORT = 5126, 5123
_ARRAY_BUFFER, _ELEMENT_BUFFER = 34962, 34963


def glb(
    name: str,
    vertices: NDArray[np.float32],
    normals: NDArray[np.float32],
    uv: NDArray[np.float32],
    faces: NDArray[np.uint16],
    pixels: NDArray[np.uint8],
) -> bytes:
    """The bytes of a .glb file with one node, one mesh, one primitive and one material.

    Args:
        name: of the node, the mesh and the material.
        vertices: (V, 3) [m].
        normals: (V, 3) unit.
        uv: (V, 2), origin top left.
        faces: (F, 3).
        pixels: (H, W, 3) sRGB.
    """
    chunks = [a.tobytes() for a in (vertices, normals, uv, faces)] + [png(pixels)]
    views, offset = [], 0
    for chunk, target in zip(chunks, [_ARRAY_BUFFER] * 3 + [_ELEMENT_BUFFER, None], strict=True):
        view = {"buffer": 0, "byteOffset": offset, "byteLength": len(chunk)}
        views.append(view if target is None else view | {"target": target})
        offset += len(_padded(chunk, b"\0"))
    document = {
        "asset": {"version": "2.0", "generator": "simart-kit examples"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": name, "mesh": 0}],
        "meshes": [{"name": name, "primitives": [_PRIMITIVE]}],
        "materials": [{"name": name, "pbrMetallicRoughness": _LOOK}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9729, "minFilter": 9987}],
        "images": [{"name": "atlas", "mimeType": "image/png", "bufferView": 4}],
        "accessors": [
            _accessor(0, vertices, "VEC3", _FLOAT)
            | {"min": vertices.min(axis=0).tolist(), "max": vertices.max(axis=0).tolist()},
            _accessor(1, normals, "VEC3", _FLOAT),
            _accessor(2, uv, "VEC2", _FLOAT),
            _accessor(3, faces.reshape(-1), "SCALAR", _USHORT),
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": offset}],
    }
    text = _padded(json.dumps(document, separators=(",", ":")).encode(), b" ")
    binary = b"".join(_padded(chunk, b"\0") for chunk in chunks)
    total = 12 + 8 + len(text) + 8 + len(binary)
    header = struct.pack("<4sII", b"glTF", 2, total)
    return (
        header
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(binary), b"BIN\0")
        + binary
    )


_PRIMITIVE = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}
_LOOK = {"baseColorTexture": {"index": 0}, "metallicFactor": 0.0, "roughnessFactor": 0.55}


def png(pixels: NDArray[np.uint8]) -> bytes:
    """An 8-bit RGB PNG file (RFC 2083); each row holds the differences to its left neighbours."""
    height, width, _ = pixels.shape
    differences = np.diff(pixels, axis=1, prepend=np.zeros((height, 1, 3), np.uint8))
    rows = np.concatenate([np.ones((height, 1), np.uint8), differences.reshape(height, -1)], axis=1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + _png_chunk(b"IHDR", header)
        + _png_chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + _png_chunk(b"IEND", b"")
    )


def _png_chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _accessor(view: int, values: NDArray[np.generic], kind: str, component: int) -> dict[str, object]:
    return {"bufferView": view, "componentType": component, "count": len(values), "type": kind}


def _padded(data: bytes, fill: bytes) -> bytes:
    return data + fill * (-len(data) % 4)
