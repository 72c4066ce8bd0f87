"""Controllers of the WebXR input profiles: GLB files with two nodes for the ends of every movement.

A profile says of each component, such as a trigger, which node moves (`valueNodeName`) between the poses of
which two others (`minNodeName`, `maxNodeName`). Sticks rest in the middle, all else at the lower end.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.formats.mesh_files import moved

from .gltf_nodes import GltfNodes
from .motions import Sweep, joint_of
from .rigged import Piece, Rigged
from .sources import Entry

CATEGORY = "xr controller"
_TWO_SIDED = ("xAxis", "yAxis")


@dataclass(frozen=True)
class _Response:
    """A node that moves: of which component, between the poses of which nodes, and where it rests, 0..1."""

    component: str
    name: str
    low: int
    high: int
    rest: float


@dataclass(frozen=True, eq=False)
class _Controller:
    """A file, the nodes of it that move, and those that are not seen."""

    file: GltfNodes
    responses: dict[int, _Response]
    hidden: frozenset[int]

    def world(self, index: int, at: dict[int, float]) -> FloatArray:
        """(4, 4) `world_T_node` with some responses at a share 0..1 of their way, and all others at rest."""
        result = np.eye(4)
        for node in self.file.chain(index):
            response = self.responses.get(node)
            if response is None:
                pose = self.file.pose(node)
            elif node in at and at[node] in (0.0, 1.0):
                pose = self.file.pose(response.high if at[node] else response.low)
            else:
                pose = self.file.pose(response.low).toward(self.file.pose(response.high), response.rest)
            result = result @ pose.matrix()
        return result


@dataclass(frozen=True, eq=False)
class _Seen:
    """A surface in the world at rest, and the nodes from the root down to its own."""

    piece: Piece
    chain: tuple[int, ...]


def read_controller(path: Path, entry: Entry) -> Rigged:
    """Read HAND.glb with the profile.json beside it; metres, +y up, at rest."""
    profile = json.loads((path.parent / "profile.json").read_text(encoding="utf-8"))
    controller = _controller(GltfNodes.read(path), _layout(profile["layouts"], path.stem))
    seen = _seen(controller)
    size = float(np.ptp(np.concatenate([one.piece.vertices for one in seen]), axis=0).max())
    joints: dict[int, LinkJoint] = {}
    for node in controller.responses:
        below = [one.piece.vertices for one in seen if node in one.chain]
        if below:
            joint = joint_of(_sweep(controller, node, np.concatenate(below)), size)
            joints |= {} if joint is None else {node: joint}
    pieces, links = _linked(seen, joints, controller)
    return Rigged(pieces, links, "+y", category=CATEGORY)


def _layout(layouts: dict[str, Any], hand: str) -> dict[str, Any]:
    """What the profile says of a hand, which may stand there together with another one."""
    found: dict[str, Any] = layouts.get(hand) or next(row for name, row in layouts.items() if hand in name)
    return found


def _controller(file: GltfNodes, layout: dict[str, Any]) -> _Controller:
    responses: dict[int, _Response] = {}
    hidden: set[int] = set()
    for component, row in layout["components"].items():
        for name, told in row.get("visualResponses", {}).items():
            node = file.by_name.get(told["valueNodeName"])
            if node is None:
                continue
            if told["valueNodeProperty"] == "visibility":
                if told["componentProperty"] == "state" and "default" not in told["states"]:
                    hidden.add(node)
                continue
            ends = [file.by_name.get(told.get(end, "")) for end in ("minNodeName", "maxNodeName")]
            if ends[0] is not None and ends[1] is not None:
                rest = 0.5 if told["componentProperty"] in _TWO_SIDED else 0.0
                responses[node] = _Response(component, name, ends[0], ends[1], rest)
        touched = file.by_name.get(row.get("touchPointNodeName", ""))
        if touched is not None:
            hidden.add(touched)
    return _Controller(file, responses, frozenset(hidden))


def _seen(controller: _Controller) -> list[_Seen]:
    """All surfaces that are seen at rest."""
    found = []
    for node in range(controller.file.count):
        chain = controller.file.chain(node)
        surfaces = [] if controller.hidden & set(chain) else controller.file.surfaces(node)
        for surface in surfaces:
            vertices, faces = moved((surface.vertices, surface.faces), controller.world(node, {}))
            found.append(_Seen(Piece(vertices, faces, surface.colors, 0), chain))
    return found


def _sweep(controller: _Controller, node: int, points: FloatArray) -> Sweep:
    response = controller.responses[node]
    rest, low, high = (controller.world(node, at) for at in ({}, {node: 0.0}, {node: 1.0}))
    back = np.linalg.inv(rest)
    return Sweep(response.name, points, low @ back, high @ back, response.rest)


def _linked(
    seen: list[_Seen], joints: dict[int, LinkJoint], controller: _Controller
) -> tuple[tuple[Piece, ...], tuple[Link, ...]]:
    """A link for each set of moving nodes that a surface hangs on; several joints where they are several."""
    links = [Link("body")]
    number: dict[tuple[int, ...], int] = {(): 0}
    pieces = []
    for one in sorted(seen, key=lambda one: sum(node in joints for node in one.chain)):
        key = tuple(node for node in one.chain if node in joints)
        if key not in number:
            carrier = next(key[:n] for n in reversed(range(len(key))) if key[:n] in number)
            several = [joints[node] for node in key[len(carrier) :]]
            several.sort(key=lambda joint: not joint.turns)  # a stick tilts first of all
            name = controller.responses[key[-1]].component
            number[key] = len(links)
            links.append(Link(name, number[carrier], several[0], tuple(several[1:])))
        pieces.append(Piece(one.piece.vertices, one.piece.faces, one.piece.colors, number[key]))
    return tuple(pieces), tuple(links)
