"""Modifier `clear`: ranges end where collision shapes meet, and what they block is held fixed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

import simart_kit
from simart_kit import Modifier, hookimpl

if TYPE_CHECKING:
    from simart_kit import Asset
    from simart_kit.hookspecs import Register


class Clear(Modifier):
    """Shortens ranges to what collision shapes allow; holds a joint that they block fixed, and flags it.

    What a joint of its own takes out of the way is no obstacle. Shapes are coarser than surfaces, and wrong
    joints drive parts into each other where surfaces alone do not tell. A sure joint is not held fixed.
    """

    name = "clear"
    corrects_joints = True

    class Options(simart_kit.Options):
        """What counts as blocked."""

        least: float = Field(
            default=0.25,
            ge=0,
            le=1,
            description="Share of the wanted travel below which a joint is held fixed.",
        )
        sure: float = Field(
            default=0.9,
            ge=0,
            le=1,
            description="Confidence from which on a joint is not held fixed: its shapes are too coarse then.",
        )

    options: Options

    def modify(self, asset: Asset) -> Asset:
        """The asset with limits that shapes allow; notes tell each change, warnings each joint held fixed."""
        from simart_kit.clearing import cleared, told

        done, found = cleared(asset, self.options.least, self.options.sure)
        fixed = [name for name in found if not done.joint(name).moves]
        left = [name for name in found if done.joint(name) == asset.joint(name)]
        infos = [told(asset.joint(name), found[name]) for name in found if name not in (*fixed, *left)]
        warnings = [
            f"{name} is held fixed, {done.joint(name).flags[-1].removeprefix('clear: ')}: "
            "its axis or its parts may be wrong, look at it"
            for name in fixed
        ]
        warnings += [
            f"{name} is blocked by collision shapes coarser than the parts: give collision more shapes"
            for name in left
        ]
        return done.with_notes("clear", "info", infos).with_notes("clear", "warning", warnings)


@hookimpl
def register_modifiers(register: Register) -> None:
    """Register `clear`."""
    register(Clear)
