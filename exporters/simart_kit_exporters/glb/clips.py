"""Animation clips: one a joint, so that each can be played or set by itself."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.kinematics import rest_origin

from ..sweeps import quaternions, shown_joints, stop_times, stops
from .builder import Builder, Json

_STEP = np.pi / 4  # between keys of a turn: readers take the shorter way, so it has to be below half a turn


def add_clips(builder: Builder, asset: Asset) -> None:
    """Add the clip of every joint with travel, under its name; node i is part i."""
    for joint in shown_joints(asset):
        builder.add("animations", _clip(builder, asset, joint))


def _clip(builder: Builder, asset: Asset, joint: Joint) -> Json:
    times, positions = _keys(joint)
    if joint.turns:
        path, values = "rotation", quaternions(joint, positions)
    else:
        rest = rest_origin(asset, joint.child) - rest_origin(asset, joint.parent)
        path, values = "translation", rest + positions[:, None] * np.array(joint.axis)
    sampler = {
        "input": builder.add_array(times.astype(np.float32), bounds=True),
        "output": builder.add_array(values.astype(np.float32)),
        "interpolation": "LINEAR",
    }
    target = {"node": asset.part_index(joint.child), "path": path}
    return {
        "name": joint.name,
        "channels": [{"sampler": 0, "target": target}],
        "samplers": [sampler],
        # Between keys the position is linear in time, so a position can be looked up as a time.
        "extras": {"joint": joint.name, "times": times.tolist(), "positions": positions.tolist()},
    }


def _keys(joint: Joint) -> tuple[FloatArray, FloatArray]:
    """(K,) times [s] and positions [rad | m]: the stops, and turns cut into steps between them."""
    ends = stops(joint)
    pieces = np.ones(len(ends) - 1, dtype=np.int64)
    if joint.turns:
        pieces = np.ceil(np.abs(np.diff(ends)) / _STEP - 1e-9).astype(np.int64)
    place = np.concatenate([i + np.arange(n) / n for i, n in enumerate(pieces)] + [[len(pieces)]])
    whole = np.arange(len(ends))
    return np.interp(place, whole, stop_times(ends)), np.interp(place, whole, ends)
