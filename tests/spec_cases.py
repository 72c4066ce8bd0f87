"""A cupboard with two drawers above two doors, and runs that read it from no file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import simart_kit as sk
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import boxes_mesh

from .furniture import Box, bar, box, carcass, drawer, panel

# Placed with its middle at x = y = 0, standing on z = 0; the handles reach out to y = -0.25.
TWO_DOORS = {
    "door": {"count": 2, "joint": "revolute", "axis": "outer edge"},
    "drawer": {"count": 0},
}
TWO_DOORS_SPEC: dict[str, Any] = {"schema": 1, "kinds": TWO_DOORS}


def cupboard() -> list[Box]:
    """0.9 x 0.4 x 0.9 m: boxes 0-4 carcass, 5-6 shelf and wall, 7-10 doors and handles, 11-24 two drawers."""
    shelf = box((-0.432, 0.432), (-0.18, 0.19), (0.66, 0.678))
    wall = box((-0.009, 0.009), (-0.18, 0.19), (0.678, 0.882))
    low = (0.002, 0.658)
    doors = [panel((-0.448, -0.0015), -0.22, low), panel((0.0015, 0.448), -0.22, low)]
    handles = [bar(-0.04, 0.35, -0.22), bar(0.04, 0.35, -0.22)]
    high = (0.682, 0.878)
    drawers = [*drawer((-0.448, -0.0015), -0.22, 0.15, high), *drawer((0.0015, 0.448), -0.22, 0.15, high)]
    return [*carcass((-0.45, 0.45), (-0.2, 0.2), (0.0, 0.9)), shelf, wall, *doors, *handles, *drawers]


class Given:
    """A plugin that reads every `.fake` file as one mesh."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh

    @sk.hookimpl
    def load_mesh(self, path: Path) -> Mesh | None:
        return self._mesh if path.suffix == ".fake" else None


def converted(
    folder: Path, spec: Any, boxes: Sequence[Box], recipe: str = "geometric", extra: Sequence[object] = ()
) -> sk.Result:
    """The boxes converted with a spec: parts and joints, swept; nothing exported."""
    plugins = Plugins(installed=False)
    for plugin in (Given(boxes_mesh(boxes)), *extra):
        plugins.register(plugin)
    source = folder / "cupboard.fake"
    source.write_text("fake")
    sets = ("export=[]", 'modify=[{use="sweep"}]')
    return sk.convert(source, recipe, out=folder / "out", spec=spec, sets=sets, record=False, plugins=plugins)


def told(result: sk.Result) -> dict[str, str]:
    """What is said of each statement."""
    texts = [note.text for note in result.report.notes if note.stage == "spec"]
    return {statement: said for statement, _, said in (text.partition(": ") for text in texts)}
