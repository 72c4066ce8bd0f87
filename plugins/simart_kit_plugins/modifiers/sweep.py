"""Modifier `sweep`: stop a joint's range where surfaces meet, and flag what is stuck."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Modifier, hookimpl
from simart_kit.kinematics import carried

if TYPE_CHECKING:
    from simart_kit import Asset, Joint
    from simart_kit.hookspecs import Register


class Sweep(Modifier):
    """Shortens limits to what is free, so that no part goes through another; flags a joint that is stuck."""

    name = "sweep"

    class Options(simart_kit.Options):
        """How finely to look."""

        steps: int = Field(default=30, ge=2, le=720, description="Stops on the way to each limit.")
        least: float = Field(
            default=0.25,
            ge=0,
            le=1,
            description="Share of the wanted travel below which a joint counts as stuck.",
        )

    options: Options

    def modify(self, asset: Asset) -> Asset:
        """The asset with limits that surfaces allow; notes tell each change, warnings each stuck joint."""
        changed: dict[str, Joint] = {}
        shortened, stuck = [], []
        for joint in asset.joints:
            if joint.limits is None:
                continue
            lower, upper = self._free(asset, joint)
            wanted = joint.limits.upper - joint.limits.lower
            before = _range(joint, joint.limits.lower, joint.limits.upper)
            free = replace(joint, limits=simart_kit.Limits(lower, upper))
            if upper - lower < self.options.least * wanted:
                told = f"blocked after {_amount(joint, max(upper, -lower))} of {before}"
                changed[joint.name] = replace(free, flags=(*joint.flags, f"sweep: {told}"))
                stuck.append(f"{joint.name} is {told}: its axis may be wrong, look at it")
            elif free.limits != joint.limits:
                changed[joint.name] = free
                shortened.append(f"{joint.name}: {before} shortened to {_range(joint, lower, upper)}")
        return (
            asset.with_joints(changed)
            .with_notes("sweep", "info", shortened)
            .with_notes("sweep", "warning", stuck)
        )

    def _free(self, asset: Asset, joint: Joint) -> tuple[float, float]:
        """Free range within the joint's limits [rad | m]."""
        from simart_kit import sweeping

        moving = np.isin(asset.face_part, [asset.part_index(name) for name in carried(asset, joint.child)])
        mesh = asset.mesh
        sweep = sweeping.Sweep(mesh.vertices, mesh.faces[moving], mesh.faces[~moving], self.seed)
        return sweeping.free_range(joint, sweep, self.options.steps)


def _range(joint: Joint, lower: float, upper: float) -> str:
    return f"{_amount(joint, lower)} .. {_amount(joint, upper)}"


def _amount(joint: Joint, position: float) -> str:
    return f"{np.degrees(position):.0f} degrees" if joint.turns else f"{position:.3f} m"


@hookimpl
def register_modifiers(register: Register) -> None:
    """Register `sweep`."""
    register(Sweep)
