"""Which way an object faces: controls are looked for where it opens to, whatever side of the file that is."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import replace

from .contact import Contacts
from .movers import Mover
from .scene import FACINGS, Scene

_LEVEL = ("front", "right", "back", "left")

Finder = Callable[[Scene, Contacts, Set[int]], list[Mover]]
"""Finds movers among the pieces that are not taken yet."""


def ahead(scene: Scene, side: str) -> Scene:
    """The same pieces in a frame turned about the vertical, whose front is this side."""
    if side == "front":
        return scene
    turn = FACINGS["front"].T @ FACINGS[side]
    surface = scene.surface
    turned = replace(surface, vertices=surface.vertices @ turn.T, from_asset=turn @ surface.from_asset)
    return replace(scene, surface=turned)


def faced(scene: Scene, fronts: Sequence[Mover]) -> list[Scene]:
    """The scene with the side ahead on which most opens; where none does, with each side ahead."""
    weights = {side: sum(front.score for front in fronts if front.facing == side) for side in _LEVEL}
    main = max(_LEVEL, key=lambda side: weights[side])
    return [ahead(scene, side) for side in ((main,) if weights[main] else _LEVEL)]


def held(scene: Scene) -> list[Scene]:
    """The scene as it lies, and turned a quarter: a hand reaches around a thing from both of its sides."""
    return [scene, ahead(scene, "right")]


def most(finder: Finder, scenes: Sequence[Scene], contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """What a finder finds in the scene in which it finds most, the first of several."""
    return max((finder(scene, contacts, taken) for scene in scenes), key=len)
