"""GLB files node by node: names, poses, surfaces and colours, for what trimesh's scenes do not keep."""

from __future__ import annotations

import io
import json
import struct
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from simart_kit.arrays import FloatArray, IntArray

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_TRIANGLES = 4
_BRIGHT = 200.0  # of 255: white without a texture


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a node stands in its parent: (3,) shift, turn and (3,) scale."""

    shift: FloatArray
    turn: Rotation
    scale: FloatArray

    def matrix(self) -> FloatArray:
        """(4, 4) `parent_T_node`."""
        result = np.eye(4)
        result[:3, :3] = self.turn.as_matrix() * self.scale
        result[:3, 3] = self.shift
        return result

    def toward(self, other: Pose, share: float) -> Pose:
        """The pose at a share 0..1 of the way to another one."""
        turns = Slerp([0, 1], Rotation.concatenate([self.turn, other.turn]))
        shift, scale = (
            (1 - share) * a + share * b for a, b in ((self.shift, other.shift), (self.scale, other.scale))
        )
        return Pose(shift, turns(share), scale)


@dataclass(frozen=True, eq=False)
class Surface:
    """A primitive in the frame of its node: (V, 3), (F, 3), and (V, 3) colours 0..255."""

    vertices: FloatArray
    faces: IntArray
    colors: FloatArray


@dataclass(frozen=True, eq=False)
class GltfNodes:
    """The document of a GLB file, and its binary chunk."""

    document: dict[str, Any]
    binary: bytes

    @classmethod
    def read(cls, path: Path) -> GltfNodes:
        """Read a file."""
        data = path.read_bytes()
        (length,) = struct.unpack_from("<I", data, 12)
        return cls(json.loads(data[20 : 20 + length]), data[28 + length :])

    @property
    def count(self) -> int:
        """How many nodes there are."""
        return len(self.document["nodes"])

    @cached_property
    def by_name(self) -> dict[str, int]:
        """Index of the first node of each name."""
        nodes = list(enumerate(self.document["nodes"]))
        return {node["name"]: index for index, node in reversed(nodes) if "name" in node}

    @cached_property
    def parents(self) -> dict[int, int]:
        """Parent of each node that has one."""
        nodes = enumerate(self.document["nodes"])
        return {child: index for index, node in nodes for child in node.get("children", ())}

    def chain(self, index: int) -> tuple[int, ...]:
        """The nodes from the root down to this one."""
        found = [index]
        while found[-1] in self.parents:
            found.append(self.parents[found[-1]])
        return tuple(reversed(found))

    def pose(self, index: int) -> Pose:
        """Where a node stands in its parent."""
        node = self.document["nodes"][index]
        if "matrix" in node:
            matrix = np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
            scale = np.linalg.norm(matrix[:3, :3], axis=0)
            return Pose(matrix[:3, 3], Rotation.from_matrix(matrix[:3, :3] / scale), scale)
        shift, scale = (
            np.array(node.get(k, d), float) for k, d in (("translation", [0] * 3), ("scale", [1] * 3))
        )
        return Pose(shift, Rotation.from_quat(node.get("rotation", [0, 0, 0, 1])), scale)

    def surfaces(self, index: int) -> list[Surface]:
        """The triangles of a node's own mesh."""
        mesh = self.document["nodes"][index].get("mesh")
        primitives = [] if mesh is None else self.document["meshes"][mesh]["primitives"]
        return [self._surface(p) for p in primitives if p.get("mode", _TRIANGLES) == _TRIANGLES]

    def _surface(self, primitive: dict[str, Any]) -> Surface:
        vertices = self._values(primitive["attributes"]["POSITION"])
        corners = (
            self._values(primitive["indices"]).ravel() if "indices" in primitive else np.arange(len(vertices))
        )
        return Surface(
            vertices, corners.astype(np.int64).reshape(-1, 3), self._colors(primitive, len(vertices))
        )

    def _values(self, index: int) -> FloatArray:
        """(N, columns) values of an accessor; normalised integers as -1..1 or 0..1."""
        entry = self.document["accessors"][index]
        view = self.document["bufferViews"][entry["bufferView"]]
        kind, columns = np.dtype(_TYPES[entry["componentType"]]), _COLUMNS[entry["type"]]
        start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
        stride = view.get("byteStride", 0) or kind.itemsize * columns
        shape = (entry["count"], columns)
        values = np.ndarray(shape, kind, self.binary, start, (stride, kind.itemsize)).astype(np.float64)
        return values / np.iinfo(kind).max if entry.get("normalized") else values

    def _colors(self, primitive: dict[str, Any], count: int) -> FloatArray:
        """(V, 3) of a primitive: the texture at its vertices, else its base colour."""
        material = self.document["materials"][primitive["material"]] if "material" in primitive else {}
        older = material.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness", {})
        look = material.get("pbrMetallicRoughness", older)
        color = np.array(look.get("baseColorFactor", look.get("diffuseFactor", [1.0] * 4)))[:3]
        texture = look.get("baseColorTexture", look.get("diffuseTexture"))
        if texture is None or "TEXCOORD_0" not in primitive["attributes"]:
            return np.tile(color * _BRIGHT, (count, 1))
        picture = self._picture(self.document["textures"][texture["index"]]["source"])
        height, width = picture.shape[:2]
        spots = self._values(primitive["attributes"]["TEXCOORD_0"]) % 1.0
        column, row = (spots * (width, height)).astype(np.int64).T
        return np.asarray(picture[np.minimum(row, height - 1), np.minimum(column, width - 1)] * color)

    def _picture(self, index: int) -> FloatArray:
        """(H, W, 3) pixels, 0..255."""
        from PIL import Image

        view = self.document["bufferViews"][self.document["images"][index]["bufferView"]]
        start = view.get("byteOffset", 0)
        with Image.open(io.BytesIO(self.binary[start : start + view["byteLength"]])) as image:
            return np.asarray(image.convert("RGB"), dtype=np.float64)
