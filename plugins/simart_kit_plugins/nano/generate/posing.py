"""Objects in other poses: doors ajar, drawers pulled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import rotation
from .objects import GeneratedObject, Motion

# A continuous joint and a ball turn by so much at most [rad].
_TURN = np.pi


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
    """Each joint, in a `share` of the cases, somewhere between its limits."""
    positions = [0.0]
    for body in made.bodies[1:]:
        assert body.motion is not None
        moves = dice.chance(share)
        positions.append(_somewhere(body.motion, dice) if moves else 0.0)
    return posed(made, positions)


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
