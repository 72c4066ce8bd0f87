"""How far collision shapes let joints go: what surfaces allow, coarser shapes may still be in the way of."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray
from .asset import Asset, Joint, Limits

if TYPE_CHECKING:
    import mujoco

    from .checks.ways import Ways

_STOPS = 30  # on the way to each limit
_TOUCH = 1e-4  # [m] depth up to which a position counts as free
_GRAZE, _GRAZE_SHARE = 0.002, 0.005  # how deep what makes way may go itself: [m], and of the diagonal

Span = tuple[float, float]


@dataclass(frozen=True)
class Clearing:
    """What shapes leave of a joint's range.

    Attributes:
        wanted: the range that it had [rad | m]; a full turn of a continuous joint.
        free: the part of it around rest that is free [rad | m].
    """

    wanted: Span
    free: Span

    @property
    def share(self) -> float:
        """Of the wanted travel that is left, 0..1."""
        return (self.free[1] - self.free[0]) / (self.wanted[1] - self.wanted[0])


def cleared(asset: Asset, least: float, sure: float) -> tuple[Asset, dict[str, Clearing]]:
    """The asset with joints that go no farther than shapes let them, and what became of each that is stopped.

    Of joints that block each other, that one gives way first which loses least. Where none would keep enough,
    the one that keeps least is held fixed, and is no obstacle of its own any more. What is in the way and can
    be taken out of it by its own joint is no obstacle, nor is contact that exports exclude.

    Args:
        asset: with collision shapes.
        least: share of its travel that a joint has to keep, or else it is held fixed.
        sure: confidence from which on a joint that would be held fixed is left as it is: then the shapes are
            wrong, not the joint.
    """
    found: dict[str, Clearing] = {}
    if not all(part.collision for part in asset.parts):
        return asset, found
    model = _model(asset)
    allowed = max(_GRAZE, _GRAZE_SHARE * asset.mesh.diagonal)
    for _ in asset.joints:
        stopped = _stopped(model, found, allowed)
        if not stopped:
            break
        keeping = [name for name, clearing in stopped.items() if clearing.share >= least]
        name = (max if keeping else min)(keeping or stopped, key=lambda n: stopped[n].share)
        joint = asset.joint(name)
        found[name] = stopped[name]
        if keeping:
            asset = asset.with_joints({name: _shortened(joint, stopped[name].free)})
            index = model.joint(name).id
            model.jnt_limited[index], model.jnt_range[index] = True, stopped[name].free
        elif joint.confidence < sure:
            asset = asset.with_joints({name: held(joint, _why(joint, stopped[name]))})
            model = _model(asset)
    return asset, found


def told(joint: Joint, clearing: Clearing) -> str:
    """What shapes leave of a joint's range, in words."""
    wanted, free = (_words(joint, span) for span in (clearing.wanted, clearing.free))
    return f"{joint.name}: {wanted} shortened to {free}, where collision shapes meet"


def _shortened(joint: Joint, free: Span) -> Joint:
    """A joint that goes no farther; one that turned without end turns between limits now."""
    kind = "revolute" if joint.kind == "continuous" else joint.kind
    return replace(joint, kind=kind, limits=Limits(*free))


def held(joint: Joint, why: str) -> Joint:
    """A joint that no longer moves, flagged."""
    return replace(joint, kind="fixed", limits=None, flags=(*joint.flags, why))


def _why(joint: Joint, clearing: Clearing) -> str:
    wanted, free = (_words(joint, span) for span in (clearing.wanted, clearing.free))
    return f"clear: {joint.kind} {wanted}, collision shapes leave {free}"


def _words(joint: Joint, span: Span) -> str:
    lower, upper = (f"{np.degrees(x):.0f} degrees" if joint.turns else f"{x:.3f} m" for x in span)
    return f"{lower} .. {upper}"


def _stopped(model: mujoco.MjModel, settled: Collection[str], allowed: float) -> dict[str, Clearing]:
    """The joints that shapes stop, by name, but those that have given way already."""
    from .checks.simulation import ranges
    from .checks.ways import Ways

    ways, found = Ways(model, allowed), dict[str, Clearing]()
    for index in ranges(model):
        name, span = str(model.joint(index).name), _span(model, index)
        if name not in settled:
            found[name] = Clearing(span, _free(model, index, span, ways))
    return {name: clearing for name, clearing in found.items() if clearing.share < 1}


def _model(asset: Asset) -> mujoco.MjModel:
    """The asset's shapes and joints; what is free stays on what carries it."""
    from .checks.building import spec_of
    from .checks.mechanism import of_asset
    from .checks.reading import compiled_spec
    from .separation import overlaps, overlaps_on_the_way, stopped_by_shapes

    met = (*overlaps(asset), *overlaps_on_the_way(asset), *stopped_by_shapes(asset))
    mechanism = of_asset(asset)
    links = tuple(replace(k, kind="fixed") if k.kind == "free" else k for k in mechanism.links)
    excluded = frozenset(frozenset((pair.one, pair.other)) for pair in met)
    return compiled_spec(spec_of(replace(mechanism, links=links, excluded=excluded)))


def _span(model: mujoco.MjModel, joint: int) -> Span:
    lower, upper = (float(end) for end in model.jnt_range[joint])
    return (lower, upper) if model.jnt_limited[joint] else (-np.pi, np.pi)


def _free(model: mujoco.MjModel, joint: int, span: Span, ways: Ways) -> Span:
    """What of a range is free, others at rest, or open where that yields more."""
    from .bench.mujoco_driving import rest_positions

    alone = _reached(model, joint, span, rest_positions(model))
    if alone == span:
        return alone
    way = ways.way(joint)
    waited = _reached(model, joint, span, way.positions) if way.opened else alone
    return max(alone, waited, key=lambda ends: ends[1] - ends[0])


def _reached(model: mujoco.MjModel, joint: int, span: Span, others: FloatArray) -> Span:
    """How far a joint goes to either side before shapes stop it, in whole steps."""
    ends = [_end(model, joint, limit, others) for limit in span]
    return ends[0], ends[1]


def _end(model: mujoco.MjModel, joint: int, limit: float, others: FloatArray) -> float:
    import mujoco

    from .checks.ways import meet, moving_alone
    from .separation import STUCK

    alone = moving_alone(model, joint)
    data, last = mujoco.MjData(alone), 0.0
    data.qpos[:] = others
    for stop in limit * np.arange(1, _STOPS + 1) / _STOPS if limit else ():
        data.qpos[model.jnt_qposadr[joint]] = stop
        meet(alone, data)
        depth = float(-data.contact.dist.min(initial=0.0))  # all of it between what moves and what does not
        if depth > STUCK:
            return last
        last = float(stop) if depth <= _TOUCH else last
    return limit
