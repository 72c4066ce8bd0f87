"""`dynamics`: damping, friction, armature, effort and velocity of joints that have none."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from pydantic import Field

import simart_kit as sk
from simart_kit.asset import Joint
from simart_kit.hookspecs import Register
from simart_kit.loads import Load, load, rolling_resistance

_SURPLUS = 0.2  # of what gravity exerts, by which friction exceeds it; at most `_BASE_SHARE` of a push
_DEFAULTS = {field.name: field.default for field in fields(Joint)}


@dataclass(frozen=True, slots=True)
class Rule:
    """How a kind of joint resists; turning joints in N*m and rad, slides in N and m.

    Attributes:
        friction: of what moves [rad/s^2 | m/s^2]: how fast it slows down.
        damping: of what moves [1/s]: moved freely, it slows down in the inverse of this.
        slowest: speed that a push reaches at least against damping [rad/s | m/s].
        sinking: speed at which it sinks where friction may not hold it [rad/s | m/s].
        least: friction [N*m | N], damping [N*m*s/rad | N*s/m] and armature [kg*m^2 | kg] of light things.
        velocity: highest speed [rad/s | m/s].
    """

    friction: float
    damping: float
    slowest: float
    sinking: float
    least: tuple[float, float, float]
    velocity: float


# A door of 4 kg, 0.6 m wide, gets 0.15 N*m and 0.5 N*m*s/rad; a drawer of 5 kg 2.5 N and 10 N*s/m, as of
# ball bearing runners. Proportional to what moves, so that things of all sizes come to rest alike.
_TURN = Rule(friction=0.3, damping=1.0, slowest=0.5, sinking=1.0, least=(1e-3, 1e-4, 1e-5), velocity=2.0)
_SLIDE = Rule(friction=0.5, damping=2.0, slowest=0.25, sinking=0.5, least=(0.05, 0.01, 1e-3), velocity=1.0)
_ROLL = replace(_TURN, damping=0.3, velocity=20.0)
RULES = {"revolute": _TURN, "ball": _TURN, "continuous": _ROLL, "prismatic": _SLIDE}
_BASE_SHARE, _OPEN_SHARE = 0.4, 0.8  # of the push: most friction of what weighs nothing; most that it takes
_ARMATURE = 0.01  # of the inertia that moves
_EFFORT = 2.0  # times what it takes to move it, and at least twice the push


class Dynamics(sk.Modifier):
    """Give joints the resistance of real hinges and runners: what is let go stays, a push moves it."""

    name = "dynamics"

    class Options(sk.Options):
        """How strong a push is."""

        torque: float = Field(
            5.0,
            gt=0,
            allow_inf_nan=False,
            description="of a robot on what turns [N*m]; friction stays below it",
        )
        force: float = Field(
            20.0,
            gt=0,
            allow_inf_nan=False,
            description="of a robot on what slides [N]; friction stays below it",
        )

    options: Options

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset with joints that resist; warns of those that a push cannot open or friction not hold."""
        moving = [joint for joint in asset.joints if joint.kind in RULES]
        loads = {joint.name: load(asset, joint) for joint in moving}
        rolling = rolling_resistance(asset, moving)
        changed = {j.name: self._resisting(j, loads[j.name], rolling.get(j.name, 0.0)) for j in moving}
        given = [joint.name for joint in moving if changed[joint.name] != joint]
        infos = [f"damping and friction in proportion to what moves: {', '.join(given)}"] if given else []
        warnings = [
            text for joint in changed.values() for text in self._doubts(joint, loads[joint.name]) if text
        ]
        result = asset.with_joints(changed)
        return result.with_notes("dynamics", "info", infos).with_notes("dynamics", "warning", warnings)

    def _push(self, joint: Joint) -> float:
        return self.options.force if joint.kind == "prismatic" else self.options.torque

    def _resisting(self, joint: Joint, moved: Load, rolling: float) -> Joint:
        """The joint, with a value where it has none; effort and velocity also where it has the default."""
        rule, push = RULES[joint.kind], self._push(joint)
        least_friction, least_damping, least_armature = rule.least
        base = max(min(rule.friction * moved.inertia, _BASE_SHARE * push), least_friction)
        friction = joint.friction or max(_friction(base, moved, push), rolling)
        fastest = max(push - friction, (1 - _OPEN_SHARE) * push) / rule.slowest
        sinks = max(moved.most - friction, 0.0) / rule.sinking
        damping = joint.damping or max(min(rule.damping * moved.inertia, fastest), sinks, least_damping)
        effort = _EFFORT * max(friction + moved.most, push)
        return replace(
            joint,
            friction=friction,
            damping=damping,
            armature=joint.armature or max(_ARMATURE * moved.inertia, least_armature),
            effort=effort if joint.effort in (0.0, _DEFAULTS["effort"]) else joint.effort,
            velocity=rule.velocity if joint.velocity in (0.0, _DEFAULTS["velocity"]) else joint.velocity,
        )

    def _doubts(self, joint: Joint, moved: Load) -> list[str]:
        """What a push or friction cannot do, with the numbers."""
        unit = "N" if joint.kind == "prismatic" else "N*m"
        does = "turn" if joint.kind == "continuous" else "open"
        needed, pulls, push = push_needed(joint, moved), moved.most, self._push(joint)
        texts = []
        if needed > push:
            texts.append(
                f"{joint.name}: takes {needed:.3g} {unit} to {does}, more than a push of {push:g} {unit}"
            )
        if pulls > joint.friction:
            texts.append(
                f"{joint.name}: gravity exerts up to {pulls:.3g} {unit}, friction holds {joint.friction:.3g} "
                f"{unit}: let go half-way it sinks; a real one has a spring"
            )
        return texts


def _friction(base: float, moved: Load, push: float) -> float:
    """Friction that holds what gravity pulls at, as far as a push still opens the joint [N*m | N].

    Nothing droops from rest, whatever the push; what is too heavy for it anyway is held everywhere, so that
    it stays where something stronger puts it.
    """
    holding, resting = (
        pull + min(_SURPLUS * pull, _BASE_SHARE * push) for pull in (moved.most, _pull_at_rest(moved))
    )
    opening = _OPEN_SHARE * push - _uphill(moved)
    return max(base, resting, min(holding, opening) if opening > base else holding)


def _pull_at_rest(moved: Load) -> float:
    """What gravity exerts at rest, unless a limit is in its way [N*m | N]."""
    pull = float(moved.gravity[np.abs(moved.positions).argmin()])
    return abs(pull) if (moved.positions * pull > 0).any() else 0.0


def push_needed(joint: Joint, moved: Load) -> float:
    """Least push that takes a joint over its longer way from rest, against friction and gravity [N*m | N]."""
    return joint.friction + _uphill(moved)


def _uphill(moved: Load) -> float:
    """Most that gravity exerts against the longer way from rest; negative where it helps all along."""
    far = moved.positions[np.abs(moved.positions).argmax()]
    way = 1.0 if far >= 0 else -1.0
    return float(np.max(-way * moved.gravity[moved.positions * way >= 0]))


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Dynamics)
