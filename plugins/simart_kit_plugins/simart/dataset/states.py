"""Kinematic states: an object in other poses, each of which is the pose that its own joints count from."""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, unit, vec3
from simart_kit.asset import Asset, Joint, Limits
from simart_kit.kinematics import Positions, rest_to_posed
from simart_kit.posing import PosableMesh

from .source_object import SourceObject

# A ball joint is turned by so much at most [rad]; nobody states its ends.
_SWIVEL = np.pi / 4


def state_count(made: SourceObject, states: int) -> int:
    """How many states an object is shown in: one where nothing can be moved."""
    return states if any(_drawn_kind(joint) for joint in made.joints) else 1


def in_state(made: SourceObject, state: int, seed: int) -> SourceObject:
    """The object in one of its states.

    Args:
        made: in the pose of the source, which is state 0.
        state: number of the state, from 0.
        seed: of the data set; with the object's key and the state it decides all positions.
    """
    if state == 0:
        return made
    generator = np.random.default_rng((seed, zlib.crc32(made.key.encode()), state))
    positions = {joint.name: _drawn(joint, generator) for joint in made.joints if _drawn_kind(joint)}
    return replace(made, asset=posed(made.asset, positions))


def posed(asset: Asset, positions: Positions) -> Asset:
    """The asset with its joints at these positions [rad | m], which are 0 from now on.

    Limits are shifted by what is spent of them, and joints move with the parts that carry them.
    """
    moved = rest_to_posed(asset, positions)
    joints = tuple(_carried(joint, moved[joint.parent], positions.get(joint.name)) for joint in asset.joints)
    return replace(asset, mesh=PosableMesh.of(asset).posed(positions), joints=joints)


def _drawn_kind(joint: Joint) -> bool:
    """Whether a state moves this joint: loose parts stay where they lie."""
    if joint.limits is not None:
        return joint.limits.upper > joint.limits.lower
    return joint.kind in ("continuous", "ball")


def _drawn(joint: Joint, generator: np.random.Generator) -> float | list[float]:
    """A position anywhere within the limits; (3,) rotation vector of a ball joint."""
    if joint.limits is not None:
        return float(generator.uniform(joint.limits.lower, joint.limits.upper))
    if joint.kind == "continuous":
        return float(generator.uniform(-np.pi, np.pi))
    along = unit(generator.standard_normal(3))
    return [float(value) for value in along * generator.uniform(0.0, _SWIVEL)]


def _carried(joint: Joint, moved: FloatArray, position: object) -> Joint:
    """The joint after its parent moved by a (4, 4), counted from its own position."""
    limits = joint.limits
    if limits is not None and isinstance(position, float):
        # The position lies within; what rounding leaves on the other side of 0 is none.
        limits = Limits(min(limits.lower - position, 0.0), max(limits.upper - position, 0.0))
    origin = moved[:3, :3] @ np.array(joint.origin) + moved[:3, 3]
    axis = unit(moved[:3, :3] @ np.array(joint.axis))
    return replace(joint, origin=vec3(origin), axis=vec3(axis), limits=limits)
