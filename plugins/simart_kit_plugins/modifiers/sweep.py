"""Modifier `sweep`: stop a joint's range where surfaces meet, and flag what is stuck."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Modifier, hookimpl

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from simart_kit import Asset, Joint
    from simart_kit.beside import Beside
    from simart_kit.hookspecs import Register
    from simart_kit.waiting import FreeRange

_FEW = 0.01  # [m]: ways that are shorter are told in millimetres


class Sweep(Modifier):
    """Shortens limits to what is free, so that no part goes through another; turns or holds what is stuck.

    A joint that comes no farther than a quarter of its way has the wrong axis, mostly: fixed and flagged it
    harms nothing. So is one that was given no way at all. What is free the other way goes so. What alone
    holds a part down and turns about the same line goes along with it, as a stapler's cover its magazine.
    What stands in another part at rest, as a rod in its sleeve, may slide on in it, whether or not there is a
    hole.
    What its own joint takes out of the way is no obstacle: a rack keeps its range behind a door, and a note.
    """

    name = "sweep"
    corrects_joints = True

    class Options(simart_kit.Options):
        """How finely to look."""

        steps: int = Field(default=30, ge=2, le=720, description="Stops on the way to each limit.")
        least: float = Field(
            default=0.25,
            ge=0,
            le=1,
            description="Share of the wanted travel below which a joint counts as stuck.",
        )
        stuck: Literal["fix", "flag"] = Field(
            default="fix",
            description="What becomes of a stuck joint, which is flagged and told: fix holds it fixed, "
            "flag leaves it what is free.",
        )

    options: Options

    def modify(self, asset: Asset) -> Asset:
        """The asset with limits that surfaces allow; notes tell each change, warnings each stuck joint."""
        from simart_kit.beside import ALONE

        return self.modify_beside(asset, ALONE)

    def modify_beside(self, asset: Asset, beside: Beside) -> Asset:
        """As `modify`; half of the joints are left to another process, if there is one."""
        ranges, pressed = self._ways(asset, beside)
        stuck = [name for name, joint in pressed.items() if joint is None]
        eased = self._eased(asset, stuck) if stuck else asset
        if eased is not asset:
            ranges, pressed = self._ways(eased, beside)
        return self._settled(eased, ranges, pressed)

    def _eased(self, asset: Asset, stuck: Sequence[str]) -> Asset:
        """The asset with stuck joints that open the other way, or take along what holds them down."""
        from simart_kit.reversing import opening_otherwise
        from simart_kit.riding import riding

        look = (self.options.least, self.options.steps, self.seed)
        turned = opening_otherwise(asset, stuck, *look)
        riders = riding(asset, [name for name in stuck if name not in turned], *look)
        told = [f"{name}: blocked at once, opens the other way" for name in turned]
        told += [
            f"{joint.child}: on one pin with {joint.parent}, goes along with it" for joint in riders.values()
        ]
        return asset.with_joints(turned | riders).with_notes("sweep", "info", told) if told else asset

    def _ways(self, asset: Asset, beside: Beside) -> tuple[dict[str, FreeRange], dict[str, Joint | None]]:
        """How far each joint is free, and how each that stops at once sinks in all the same, or None."""
        from simart_kit.waiting import free_ranges, stops, sunk

        ranges = free_ranges(asset, self.options.steps, self.seed, beside)
        stopped = [n for n, free in ranges.items() if stops(asset.joint(n), free, self.options.least)]
        look = (self.options.steps, self.seed)
        pressed = {name: sunk(asset, asset.joint(name), *look) for name in stopped}
        held = {name: asset.joint(name).child for name, joint in pressed.items() if joint is None}
        # Keys lie on a plate that was taken for a part: held fixed, it is one with what carries them.
        for name in list(held) if self.options.stuck == "fix" else ():
            others = [child for other, child in held.items() if other != name]
            sinks = sunk(asset, asset.joint(name), *look, others) if others else None
            if sinks is not None:
                pressed[name] = sinks
                del held[name]
        return ranges, pressed

    def _settled(
        self, asset: Asset, ranges: Mapping[str, FreeRange], pressed: Mapping[str, Joint | None]
    ) -> Asset:
        """The asset with joints as `_ways` found them."""
        from simart_kit.clearing import held
        from simart_kit.waiting import wanted

        changed: dict[str, Joint] = {}
        told, stuck = [], []
        for name, free in ranges.items():
            joint = asset.joint(name)
            assert joint.limits is not None
            before = _range(joint, joint.limits.lower, joint.limits.upper)
            short = replace(joint, limits=simart_kit.Limits(free.lower, free.upper))
            sinks = pressed.get(name)
            if sinks is not None:
                changed[name] = sinks
                told.append(_sunk(joint, sinks))
                continue
            if name in pressed:
                way = _amount(joint, max(free.upper, -free.lower), wanted(joint))
                blocked = f"blocked after {way} of {before}"
                fixes = self.options.stuck == "fix"
                flag = f"sweep: {joint.kind} {blocked}"
                changed[name] = held(joint, flag) if fixes else replace(short, flags=(*joint.flags, flag))
                how = ", held fixed" if fixes else ""
                stuck.append(f"{name} is {blocked}{how}: its axis may be wrong, look at it")
                continue
            if short.limits != joint.limits:
                changed[name] = short
                told.append(f"{name}: {before} shortened to {_range(joint, free.lower, free.upper)}")
            if free.opened:
                waits = f"only when {' and '.join(asset.joint(o).child for o in free.opened)} is open"
                changed[name] = replace(short, evidence=(*joint.evidence, waits))
                told.append(f"{joint.child}: {waits}")
        return (
            asset.with_joints(changed).with_notes("sweep", "info", told).with_notes("sweep", "warning", stuck)
        )


def _sunk(joint: Joint, pressed: Joint) -> str:
    """That a joint moves into its carrier all the same, and how far where that is less than it wants."""
    text = f"{joint.child}: sinks into {joint.parent}, which has no hole for it"
    if joint.turns:
        text = f"{joint.child}: turns in {joint.parent}, which has no room for it"
    if pressed.limits is None or pressed.limits == joint.limits:
        return text
    return f"{text}, by {_range(joint, pressed.limits.lower, pressed.limits.upper)}"


def _range(joint: Joint, lower: float, upper: float) -> str:
    far = max(abs(lower), abs(upper))
    return f"{_amount(joint, lower, far)} .. {_amount(joint, upper, far)}"


def _amount(joint: Joint, position: float, far: float) -> str:
    """A position in words, in millimetres if none that is told with it is `far`."""
    if joint.turns:
        return f"{np.degrees(position):.0f} degrees"
    return f"{position:.3f} m" if far >= _FEW else f"{1000 * position:.2g} mm"


@hookimpl
def register_modifiers(register: Register) -> None:
    """Register `sweep`."""
    register(Sweep)
