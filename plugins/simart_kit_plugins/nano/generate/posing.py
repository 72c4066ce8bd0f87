"""Objects in other poses: doors ajar, drawers pulled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bounds import bounds_of
from simart_kit.sweeping import sample_surface

from ...shapes.dice import Dice
from ...shapes.placing import rotation
from .objects import Body, GeneratedObject, Motion

# A continuous joint and a ball turn by so much at most [rad].
_TURN = np.pi
_POINTS = 400  # looked at of what may be in a slide's way
_MET = 0.01  # share of them from which on it is
_SLACK = 0.002  # [m] by which neighbours that are passed may be touched


def posed(made: GeneratedObject, positions: Sequence[float]) -> GeneratedObject:
    """The object with its joints at these positions, which are 0 from now on.

    Args:
        made: in its present pose.
        positions: one a body [rad | m]; the root's is not read. Ball joints turn about z; free bodies stay.
    """
    world_T_now = [np.eye(4)]
    bodies = [made.bodies[0]]
    for body, position in zip(made.bodies[1:], positions[1:], strict=True):
        assert body.motion is not None
        before = world_T_now[body.parent]
        after = before @ _displacement(body.motion, position)
        world_T_now.append(after)
        shapes = tuple(one.placed(after[:3, :3], after[:3, 3]) for one in body.surfaces)
        bodies.append(replace(body, surfaces=shapes, motion=_carried(body.motion, before, position)))
    return GeneratedObject(made.category, tuple(bodies))


def ajar(made: GeneratedObject, dice: Dice, share: float = 1 / 3) -> GeneratedObject:
    """Each joint, in a `share` of the cases, somewhere between its limits.

    What slides stays where it is if another moving body is in its way, as a rack behind a closed door.
    """
    positions = [0.0]
    for body in made.bodies[1:]:
        assert body.motion is not None
        moves = dice.chance(share)
        positions.append(_somewhere(body.motion, dice) if moves else 0.0)
    there = posed(made, positions)
    sliding = [n for n, body in enumerate(made.bodies) if positions[n] and _slides(body)]
    stopped = [n for n in sliding if _is_held_up(there, n, positions[n])]
    return posed(made, [0.0 if n in stopped else x for n, x in enumerate(positions)]) if stopped else there


def _slides(body: Body) -> bool:
    return body.motion is not None and body.motion.kind == "prismatic"


def _is_held_up(there: GeneratedObject, number: int, position: float) -> bool:
    """Whether a body has slid to where another one is that neither carries it nor hangs on it."""
    body = there.bodies[number]
    assert body.motion is not None
    way = position * body.motion.axis
    low, high = bounds_of(body.triangles.reshape(-1, 3))
    # What it covers now and did not before, seen along its way.
    main = int(np.abs(way).argmax())
    if way[main] > 0:
        low[main] = max(low[main], high[main] - way[main])
    else:
        high[main] = min(high[main], low[main] - way[main])
    low, high = low + _SLACK, high - _SLACK
    for index, other in enumerate(there.bodies[1:], start=1):
        if number in _above(there, index) or index in _above(there, number):
            continue
        points = sample_surface(other.triangles, _POINTS, np.random.default_rng(0))
        if ((points > low) & (points < high)).all(axis=1).mean() > _MET:
            return True
    return False


def _above(there: GeneratedObject, number: int) -> list[int]:
    """A body and those that carry it, the root left out."""
    found = []
    while number > 0:
        found.append(number)
        number = there.bodies[number].parent
    return found


def _somewhere(motion: Motion, dice: Dice) -> float:
    if motion.kind in ("revolute", "prismatic"):
        return dice.between(motion.lower, motion.upper)
    return 0.0 if motion.kind == "free" else dice.between(-_TURN, _TURN)


def _displacement(motion: Motion, position: float) -> FloatArray:
    """(4, 4) what a position does to the body."""
    matrix = np.eye(4)
    if motion.kind == "prismatic":
        matrix[:3, 3] = position * motion.axis
    elif motion.kind != "free":
        matrix[:3, :3] = rotation(motion.axis, position)
        matrix[:3, 3] = motion.origin - matrix[:3, :3] @ motion.origin
    return matrix


def _carried(motion: Motion, before: FloatArray, position: float) -> Motion:
    """The motion after its parent moved by a (4, 4), counted from its own position."""
    limited = motion.kind in ("revolute", "prismatic")
    there = motion.placed(before[:3, :3], before[:3, 3])
    spent = position if limited else 0.0
    return replace(there, lower=there.lower - spent, upper=there.upper - spent)
