"""Check `sweep`: along its whole range a joint drives no body into another."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..arrays import FloatArray
from ..bench.mujoco_driving import rest_positions
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult, Fault
from .names import body_name, joint_name
from .subject import Subject
from .ways import Ways, meet, moving_alone, told

if TYPE_CHECKING:
    import mujoco


# Shapes of parts that a joint connects may meet on its way, where nothing has them touch, by so much of the
# diagonal: they are coarser than surfaces. What goes deeper goes the wrong way.
_COARSE = 0.05


class JointSweep(Check):
    """Each joint goes its range, others at rest or out of its way; what the file excludes is listed."""

    name = "sweep"

    class Options(StageOptions):
        """How finely to look, and how deep is too deep: either of the two is allowed."""

        steps: int = Field(default=41, ge=3, le=721, description="Poses of each joint.")
        depth: float = Field(default=0.002, ge=0, description="Deepest overlap [m].")
        share: float = Field(default=0.005, ge=0, description="The same, of the object's diagonal.")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The deepest pose of each joint and pair of bodies."""
        from .simulation import ranges

        simulation = subject.simulation
        model = simulation.unfiltered()
        allowed = max(self.options.depth, self.options.share * simulation.mechanism.diagonal)
        swept = ranges(model)
        excluded, unasked = (_named(p) for p in (simulation.mechanism.excluded, simulation.mechanism.passing))
        faults, waits = list[Fault](), dict[str, tuple[str, ...]]()
        for joint, span in swept.items():
            met, opened = self._deep(model, joint, span, allowed, excluded | unasked, simulation.ways)
            faults += met
            waits |= {joint_name(model, joint): opened} if opened else {}
        deep = sorted(faults, key=lambda f: (-f.depth, f.text))
        if any(fault.text not in excluded for fault in deep):
            worst = {fault.text: fault.depth for fault in reversed(deep)}
            coarse = _COARSE * simulation.mechanism.diagonal
            excluded |= {pair for pair in _passing(subject) if worst.get(pair, 0.0) <= coarse}
        wrong = [f for f in deep if f.text not in excluded]
        rows = [
            {"joint": joint, "position": round(value, 6), "pair": f.text, "depth": round(f.depth, 6)}
            for f in deep
            for joint, value in list(f.positions.items())[:1]
        ]
        return CheckResult(
            self.name,
            not wrong,
            _text(wrong, len({f.text for f in deep} & excluded), len(swept)) + told(waits),
            {
                "joints": len(swept),
                "allowed": allowed,
                "deep": rows,
                "excluded": sorted(excluded),
                "waits": waits,
            },
            wrong[0] if wrong else None,
        )

    def _deep(
        self,
        model: mujoco.MjModel,
        joint: int,
        span: tuple[float, float],
        allowed: float,
        excluded: set[str],
        ways: Ways,
    ) -> tuple[list[Fault], tuple[str, ...]]:
        """Faults with the others at rest, or none with those open that are named: racks are behind doors."""
        places = np.linspace(*span, self.options.steps)
        at_rest = [f for f in _faults(model, joint, places, rest_positions(model)) if f.depth > allowed]
        if all(fault.text in excluded for fault in at_rest):
            return at_rest, ()
        way = ways.way(joint)
        found = [f for f in _faults(model, joint, places, way.positions) if f.depth > allowed]
        return (found, way.opened) if all(fault.text in excluded for fault in found) else (at_rest, ())


def _named(pairs: Collection[frozenset[str]]) -> set[str]:
    return {" in ".join(sorted(pair)) for pair in pairs}


def _passing(subject: Subject) -> set[str]:
    """Pairs of an asset that its file need not exclude on their joint's way: they pass unasked.

    These are a part and the one that it moves on, with what is fixed to either; in MJCF not where that one is
    fixed to the world.
    """
    from ..separation import overlaps_on_the_way, rigid_bodies

    unasked = subject.simulation.mechanism.passing
    if subject.asset is None:
        return _named(unasked)
    model, asset, bodies = subject.simulation.model, subject.asset, rigid_bodies(subject.asset)
    moved = {body_name(model, body) for body in range(model.nbody) if model.body_weldid[body]}
    moved |= {joint.child for joint in asset.joints if joint.kind == "free"}  # there it stays where it lies
    group = {part.name: int(body) for part, body in zip(asset.parts, bodies, strict=True)}
    jointed = {frozenset((group[j.parent], group[j.child])) for j in asset.joints if j.parent in moved}
    jointed |= {frozenset(group[name] for name in pair) for pair in unasked}
    met = ((found.one, found.other) for found in overlaps_on_the_way(asset))
    return {" in ".join(sorted(pair)) for pair in met if frozenset(group[n] for n in pair) in jointed}


def _faults(model: mujoco.MjModel, joint: int, places: FloatArray, others: FloatArray) -> list[Fault]:
    """The deepest pose of each pair of bodies that a joint moves into each other."""
    import mujoco

    from .simulation import contacts

    alone = moving_alone(model, joint)
    data, name, deepest = mujoco.MjData(alone), joint_name(model, joint), dict[tuple[str, str], Fault]()
    for position in places:
        data.qpos[:] = others
        data.qpos[model.jnt_qposadr[joint]] = position
        meet(alone, data)
        for pair, contact in contacts(alone, data).items():
            if pair not in deepest or deepest[pair].depth < contact.depth:
                where = {name: float(position)}
                deepest[pair] = Fault(where, contact.point, contact.depth, " in ".join(pair))
    return list(deepest.values())


def _text(wrong: list[Fault], listed: int, joints: int) -> str:
    if wrong:
        (joint, position), depth = next(iter(wrong[0].positions.items())), wrong[0].depth * 1000
        more = f", and {len(wrong) - 1} more" if len(wrong) > 1 else ""
        return f"{joint} at {position:.3g} drives {wrong[0].text} by {depth:.3g} mm{more}"
    if not joints:
        return "static: nothing sweeps"
    rest = f"; {listed} excluded pairs overlap on their way" if listed else ""
    return f"{joints} joints sweep their range freely{rest}"
