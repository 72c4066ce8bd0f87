"""What a GLB file says, read from its bytes with numpy alone: accessors, node transforms, clips."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_TYPES = {5126: "<f4", 5123: "<u2", 5125: "<u4"}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True, eq=False)
class Glb:
    """A file: its JSON document and its binary chunk."""

    json: dict[str, Any]
    binary: bytes

    @classmethod
    def read(cls, path: Path) -> Glb:
        """Read a file, whose header and chunks must add up."""
        data = path.read_bytes()
        magic, version, total, length, kind = struct.unpack_from("<4sII I4s", data)
        assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
        text, rest = data[20 : 20 + length], data[20 + length :]
        size, kind = struct.unpack_from("<I4s", rest)
        assert kind == b"BIN\0"
        assert size == len(rest) - 8
        assert length % 4 == size % 4 == 0
        return cls(json.loads(text), rest[8:])

    def node(self, name: str) -> int:
        """Index of the one node of a name."""
        (index,) = [i for i, node in enumerate(self.json["nodes"]) if node["name"] == name]
        return index

    def view(self, index: int) -> bytes:
        """The bytes of a buffer view."""
        entry = self.json["bufferViews"][index]
        assert entry["byteOffset"] % 4 == 0
        return self.binary[entry["byteOffset"] : entry["byteOffset"] + entry["byteLength"]]

    def array(self, index: int) -> Array:
        """(N, columns) values of an accessor; normalised integers as 0..1."""
        entry = self.json["accessors"][index]
        raw = np.frombuffer(self.view(entry["bufferView"]), _TYPES[entry["componentType"]])
        values = raw.reshape(entry["count"], _COLUMNS[entry["type"]]).astype(np.float64)
        if "min" in entry:
            assert np.array_equal(entry["min"], values.min(axis=0))
            assert np.array_equal(entry["max"], values.max(axis=0))
        return values / np.iinfo(raw.dtype).max if entry.get("normalized") else values

    def poses(self, clip: str | None = None, time: float = 0.0) -> dict[str, Array]:
        """`scene_T_node` (4, 4) by node name, at rest or at a time [s] of a clip."""
        moved = {} if clip is None else self._moved(clip, time)
        found: dict[str, Array] = {}

        def visit(index: int, scene_T_parent: Array) -> None:
            node = {**self.json["nodes"][index], **moved.get(index, {})}
            scene_T_node = scene_T_parent @ _local(node)
            found[node["name"]] = scene_T_node
            for child in node.get("children", ()):
                visit(child, scene_T_node)

        for root in self.json["scenes"][self.json["scene"]]["nodes"]:
            visit(root, np.eye(4))
        return found

    def clip(self, name: str) -> dict[str, Any]:
        """The animation of a name."""
        (entry,) = [entry for entry in self.json["animations"] if entry["name"] == name]
        return dict(entry)

    def triangles(self, part: str) -> Array:
        """(F, 3, 3) corners of a part's primitives in the frame of the scene, at rest."""
        node = self.json["nodes"][self.node(part)]
        pose = self.poses()[part]
        corners = []
        for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
            points = self.array(primitive["attributes"]["POSITION"])
            indices = self.array(primitive["indices"]).astype(np.int64).reshape(-1, 3)
            corners.append((points @ pose[:3, :3].T + pose[:3, 3])[indices])
        return np.concatenate(corners)

    def _moved(self, clip: str, time: float) -> dict[int, dict[str, Array]]:
        entry = self.clip(clip)
        result = {}
        for channel in entry["channels"]:
            sampler = entry["samplers"][channel["sampler"]]
            assert sampler["interpolation"] == "LINEAR"
            times, values = self.array(sampler["input"]).ravel(), self.array(sampler["output"])
            path = channel["target"]["path"]
            result[channel["target"]["node"]] = {path: _between(times, values, time, path == "rotation")}
        return result


def rotation(quaternion: Array) -> Array:
    """(3, 3) of a unit quaternion x, y, z, w."""
    x, y, z, w = quaternion
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)


def _local(node: dict[str, Any]) -> Array:
    result = np.eye(4)
    result[:3, :3] = rotation(np.array(node.get("rotation", (0.0, 0.0, 0.0, 1.0))))
    result[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return result


def _between(times: Array, values: Array, time: float, turns: bool) -> Array:
    """Value between two keys; quaternions by the shorter way at even speed, as glTF says."""
    assert (np.diff(times) > 0).all()
    index = int(np.clip(np.searchsorted(times, time, side="right") - 1, 0, len(times) - 2))
    share = np.clip((time - times[index]) / (times[index + 1] - times[index]), 0.0, 1.0)
    one, two = values[index], values[index + 1]
    cosine = float(one @ two)
    if not turns or abs(cosine) > 1.0 - 1e-12:
        return np.asarray(one + share * (two - one))
    angle = np.arccos(abs(cosine))
    way = np.sin((1.0 - share) * angle) * one + np.sign(cosine) * np.sin(share * angle) * two
    return np.asarray(way / np.sin(angle))
