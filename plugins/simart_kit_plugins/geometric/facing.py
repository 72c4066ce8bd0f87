"""Which way an object faces: controls are looked for where it opens to, whatever side of the file that is."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import replace

from simart_kit.arrays import FloatArray

from .contact import Contacts
from .movers import Mover
from .scene import FACINGS, Scene

_LEVEL = ("front", "right", "back", "left")

Finder = Callable[[Scene, Contacts, Set[int]], list[Mover]]
"""Finds movers among the pieces that are not taken yet."""


def ahead(scene: Scene, side: str) -> Scene:
    """The same pieces in a frame turned about the vertical, whose front is this side."""
    return scene if side == "front" else turned(scene, FACINGS[side])


def turned(scene: Scene, axes: FloatArray) -> Scene:
    """The same pieces in a frame in which (3, 3) rows across, up and out are those of the front."""
    turn, surface = FACINGS["front"].T @ axes, scene.surface
    vertices, from_asset = surface.vertices @ turn.T, turn @ surface.from_asset
    return replace(scene, surface=replace(surface, vertices=vertices, from_asset=from_asset))


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
