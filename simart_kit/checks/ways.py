"""What has to be out of a joint's way before it can move: a rack waits for its door.

Something in the way is no obstacle if a joint of its own takes it out of the way, that joint being free to do
so, if need be after others. Two that wait for each other never move.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..bench.mujoco_driving import one_axis_joints, rest_positions
from .names import joint_name

if TYPE_CHECKING:
    import mujoco

_STOPS = 21  # on a joint's way
_TOUCH = 1e-4  # depth from which something is met [m]
_HELPS = 0.75  # of that depth at most is left once something is out of the way


@dataclass(frozen=True, eq=False)
class Way:
    """How others stand so that a joint can move.

    Attributes:
        positions: (nq,) of all joints, this one at rest.
        opened: names of the joints that are opened for it; none where nothing would help.
    """

    positions: FloatArray
    opened: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Ways:
    """The ways of one model's joints, each looked at when it is asked for.

    Attributes:
        model: what it excludes from contact is in nobody's way; not to be changed.
        allowed: how deep a joint may go into what stays and yet open for another [m].
    """

    model: mujoco.MjModel
    allowed: float
    _found: dict[int, dict[int, float]] = field(default_factory=dict)

    def way(self, joint: int) -> Way:
        """How others have to stand for a joint; they are at rest where opening them does not help."""
        if joint not in self._found:
            self._found[joint] = self._opened(joint, frozenset({joint}))
        positions = self._posed(self._found[joint])
        return Way(positions, tuple(joint_name(self.model, other) for other in self._found[joint]))

    def _opened(self, joint: int, waiting: frozenset[int]) -> dict[int, float]:
        """Positions of the joints that are opened for one, in this order, none of which waits for it."""
        opened: dict[int, float] = {}
        met = self._met(joint, opened)
        for body in sorted(met, key=lambda body: -met[body]):
            if body in met:
                for out in (o for j in self._movers(body, joint) for o in self._out(j, waiting)):
                    left = self._met(joint, opened | out)
                    if left.get(body, 0.0) < _HELPS * met[body]:
                        opened, met = opened | out, left
                        break
        return opened

    def _out(self, other: int, waiting: frozenset[int]) -> list[dict[int, float]]:
        """Positions with a joint at either end, the farther first, and what it waits for out of its way."""
        if other in waiting:
            return []
        before = self._opened(other, waiting | {other})
        if max(self._met(other, before).values(), default=0.0) > self.allowed:
            return []
        rest = float(rest_positions(self.model)[self.model.jnt_qposadr[other]])
        ends = sorted((float(end) for end in self.model.jnt_range[other]), key=lambda end: -abs(end - rest))
        return [before | {other: end} for end in ends if end != rest]

    def _movers(self, body: int, joint: int) -> list[int]:
        """The limited joints that move a body and not what carries the joint, outermost first."""
        model, found = self.model, []
        above = _ancestors(model, int(model.jnt_bodyid[joint]))
        for carrier in reversed(_ancestors(model, body)):
            first, count = int(model.body_jntadr[carrier]), int(model.body_jntnum[carrier])
            if carrier not in above:
                found += [j for j in range(first, first + count) if model.jnt_limited[j]]
        return [j for j in found if j in one_axis_joints(model)]

    def _met(self, joint: int, opened: Mapping[int, float]) -> dict[int, float]:
        """How deep a joint drives what it moves into other bodies on its way [m]."""
        import mujoco

        model = moving_alone(self.model, joint)
        data = mujoco.MjData(model)
        data.qpos[:] = self._posed(opened)
        lower, upper = (float(end) for end in model.jnt_range[joint])
        mine, found = subtree(model, int(model.jnt_bodyid[joint])), dict[int, float]()
        if not model.jnt_limited[joint]:
            lower, upper = 0.0, 2 * np.pi
        for position in np.linspace(lower, upper, _STOPS):
            data.qpos[model.jnt_qposadr[joint]] = position
            meet(model, data)
            depths = -data.contact.dist
            deep = depths > _TOUCH
            bodies = model.geom_bodyid[data.contact.geom[deep]]
            for (one, two), depth in zip(bodies.tolist(), depths[deep].tolist(), strict=True):
                if mine[one] != mine[two]:
                    other = two if mine[one] else one
                    found[other] = max(found.get(other, 0.0), depth)
        return found

    def _posed(self, opened: Mapping[int, float]) -> FloatArray:
        positions = rest_positions(self.model)
        for joint, position in opened.items():
            positions[self.model.jnt_qposadr[joint]] = position
        return positions


def told(waits: Mapping[str, tuple[str, ...]]) -> str:
    """The end of a sentence: which joints wait for which; "" where none does."""
    each = [f"{joint} once {' and '.join(opened)} is open" for joint, opened in waits.items()]
    return f"; {', '.join(each)}" if each else ""


def _ancestors(model: mujoco.MjModel, body: int) -> list[int]:
    """A body and those that carry it, up to the world."""
    found = [body]
    while found[-1]:
        found.append(int(model.body_parentid[found[-1]]))
    return found


def moving_alone(model: mujoco.MjModel, joint: int) -> mujoco.MjModel:
    """A copy in which what a joint moves meets what it does not, and nothing else meets anything.

    What else touches does so wherever the joint is, and among many parts takes nearly all of the time. A file
    that has masks of its own keeps them.
    """
    alone, meets = copy(model), np.array(model.geom_contype)
    if np.array_equal(meets, model.geom_conaffinity) and np.isin(meets, (0, 1)).all():
        mine = np.array(subtree(model, int(model.jnt_bodyid[joint])))[model.geom_bodyid]
        alone.geom_contype[:] = np.where(mine, 1, 2) * meets
        alone.geom_conaffinity[:] = np.where(mine, 2, 1) * meets
    return alone


def meet(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Find the contacts at `data.qpos`, and no forces."""
    import mujoco

    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)


def subtree(model: mujoco.MjModel, body: int) -> list[bool]:
    """(nbody,) whether each body is this one or is carried by it."""
    inside = [False] * model.nbody
    for index in range(1, model.nbody):
        inside[index] = index == body or inside[int(model.body_parentid[index])]
    return inside
