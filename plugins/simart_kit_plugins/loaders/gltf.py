"""What must hold of a glTF file before trimesh reads it: it trusts sizes, and skips what it does not know."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from simart_kit import BadInputError

# Extensions that may be required, for they change nothing but looks or are read.
HARMLESS = ("KHR_materials_", "KHR_lights_punctual", "KHR_texture_transform", "EXT_texture_webp")
QUANTIZED = "KHR_mesh_quantization"
FLOAT = 5126
_FAN = 6
_OLD = "glTF of version {}, which is not supported: export it as glTF 2.0"


def check_gltf(path: Path) -> list[str]:
    """Refuse what would be misread; returns what will be left out, a sentence each.

    Raises:
        BadInputError: not glTF, cut off, or stored in a way that is not supported.
    """
    header = _glb_header(path) if path.suffix.lower() == ".glb" else json.loads(path.read_bytes())
    if not isinstance(header, dict) or "asset" not in header:
        raise BadInputError("not glTF: the JSON has no 'asset'; check what wrote it")
    # Files of version 1, which have objects where version 2 has lists, need not say it.
    if str(header["asset"].get("version", "2")).startswith("1") or isinstance(header.get("meshes"), dict):
        raise BadInputError(_OLD.format(1))
    for name in header.get("extensionsRequired", []):
        if not name.startswith(HARMLESS) and name != QUANTIZED:
            raise BadInputError(f"it needs glTF extension {name}, which is not supported: export it without")
    if any(primitive.get("mode") == _FAN for primitive in _primitives(header)):
        # trimesh leaves them out.
        raise BadInputError("it stores triangle fans, which are not supported: export it as plain triangles")
    for attribute, index in _attributes(header):
        _check_accessor(header["accessors"][index], attribute, index)
    return list(_left_out(header))


def _glb_header(path: Path) -> Any:
    data = path.read_bytes()
    if data[:4] != b"glTF":
        raise BadInputError("not a GLB file: it does not start with 'glTF'; check what wrote it")
    if len(data) < 20:
        raise BadInputError(f"cut off after {len(data)} bytes; copy or export it again")
    _, version, length, chunk, kind = struct.unpack("<4sIII4s", data[:20])
    if version != 2:
        raise BadInputError(_OLD.format(version))
    if kind != b"JSON":
        raise BadInputError(f"damaged: its first chunk is {kind!r}, not JSON; export it again")
    if length > len(data) or 20 + chunk > len(data):
        raise BadInputError(f"cut off: it says {length} bytes and has {len(data)}; export it again")
    return json.loads(data[20 : 20 + chunk])


def _primitives(header: Any) -> Iterator[Any]:
    for mesh in header.get("meshes", []):
        yield from mesh["primitives"]


def _attributes(header: Any) -> Iterator[tuple[str, int]]:
    for primitive in _primitives(header):
        yield from primitive["attributes"].items()
        if "indices" in primitive:
            yield "indices", primitive["indices"]


def _check_accessor(accessor: Any, attribute: str, index: int) -> None:
    # trimesh reads these as zeros, or as the bare integers.
    integers = accessor["componentType"] != FLOAT
    if "sparse" in accessor or "bufferView" not in accessor:
        how = "sparse"
    elif attribute == "POSITION" and accessor.get("normalized"):
        how = "as normalized integers"
    elif attribute == "TEXCOORD_0" and integers:
        how = "as integers"
    else:
        return
    raise BadInputError(
        f"it stores {attribute} {how} (accessor {index}), which is not supported: export it as plain floats"
    )


def _left_out(header: Any) -> Iterator[str]:
    if header.get("skins"):
        yield "skinning is ignored: the mesh is taken as it is stored"
    if any("targets" in primitive for primitive in _primitives(header)):
        yield "morph targets are ignored: the mesh is taken as it is stored"
    if len(header.get("scenes", [])) > 1:
        yield f"it has {len(header['scenes'])} scenes: only its default one is read"
    for material in header.get("materials", []):
        name = material.get("name", "unnamed")
        for texture in _textures(material):
            if "KHR_texture_transform" in texture.get("extensions", {}):
                yield f"material '{name}': its texture transform is ignored"
            if texture.get("texCoord", 0):
                yield f"material '{name}' uses other texture coordinates than the first: the first are taken"


def _textures(material: Any) -> Iterator[Any]:
    surface = material.get("pbrMetallicRoughness", {})
    for place in (surface.get("baseColorTexture"), surface.get("metallicRoughnessTexture")):
        if place:
            yield place
    if material.get("normalTexture"):
        yield material["normalTexture"]
