"""Shapes of the parts of an object, in two rows, so that two cores may make them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Literal

import numpy as np

from simart_kit.beside import Beside
from simart_kit.decompose import Budget, Decomposition, Surface, decompose_by_tool, decompose_surface
from simart_kit.fitting import aligned_box
from simart_kit.hulls import MIN_THICKNESS, convex_hull

Mode = Literal["auto", "decompose", "hull", "box", "none"]
Shapes = dict[str, Decomposition]  # by name of the part
_KEPT = 8  # so many times less than an equal share of the work is kept for each part that comes later


class Shaper:
    """Makes shapes of an object's parts.

    Which row a part is in depends on the parts alone, and each row has work of its own: shapes are the same
    with a second core and without.

    Args:
        surfaces: of the parts, by name.
        mode: of the modifier `collision`.
        beside: who makes those of the second row.
    """

    def __init__(self, surfaces: Mapping[str, Surface], mode: Mode, beside: Beside) -> None:
        self._surfaces, self._mode, self._beside = surfaces, mode, beside
        self._rows = _rows(surfaces)

    def made(self, names: Collection[str], budget: Budget, before: Shapes) -> Shapes:
        """Shapes of some of the parts; none where no work is left.

        Args:
            names: of the parts.
            budget: of each row, if nothing had been done before.
            before: what has been done, in either row.
        """
        left = replace(budget, work=budget.work - sum(m.work for m in before.values()))
        if left.work <= 0:
            return {}
        mine, theirs = ({name: self._surfaces[name] for name in row if name in names} for row in self._rows)
        if self._beside.helps:  # asked even of an empty row: what waits behind it begins
            sent = {name: Surface(s.vertices, s.faces, s.most) for name, s in theirs.items()}
            later = self._beside.ask(shapes_of, sent, self._mode, left)
            found = shapes_of(mine, self._mode, left) | later.result()
        else:  # the time for the tool is for all of them
            found = shapes_of(mine, self._mode, left)
            seconds = max(left.tool_seconds - sum(m.tool_seconds for m in found.values()), 0.0)
            found |= shapes_of(theirs, self._mode, replace(left, tool_seconds=seconds))
        return {name: found[name] for name in self._surfaces if name in found}


def shapes_of(surfaces: Mapping[str, Surface], mode: Mode, budget: Budget) -> Shapes:
    """Shapes of some parts, the largest last. Each may take nearly all that is left of work and time."""
    made: Shapes = {}
    order = sorted(surfaces, key=lambda name: len(surfaces[name].faces))
    kept, work, seconds = budget.work // (_KEPT * max(len(order), 1)), budget.work, budget.tool_seconds
    for done, name in enumerate(order):
        share = max(work - kept * (len(order) - done - 1), kept)
        shapes = _shapes(surfaces[name], mode, replace(budget, work=share, tool_seconds=seconds))
        work, seconds = max(work - shapes.work, 0), max(seconds - shapes.tool_seconds, 0.0)
        made[name] = shapes
    return made


def _rows(surfaces: Mapping[str, Surface]) -> tuple[list[str], list[str]]:
    """Two rows of about as many faces, the largest part in the first."""
    rows: tuple[list[str], list[str]] = ([], [])
    faces = [0, 0]
    for name in sorted(surfaces, key=lambda name: -len(surfaces[name].faces)):
        row = int(faces[1] < faces[0])
        rows[row].append(name)
        faces[row] += len(surfaces[name].faces)
    return rows


def _shapes(surface: Surface, mode: Mode, budget: Budget) -> Decomposition:
    match mode:
        case "none":
            return Decomposition(())
        case "box":
            points = surface.points
            grow = np.maximum(MIN_THICKNESS - np.ptp(points, axis=0), 0) / 2
            return Decomposition((aligned_box(points.min(axis=0) - grow, points.max(axis=0) + grow),))
        case "hull":
            return Decomposition((convex_hull(surface.points, budget.vertices),))
        case "decompose":
            return decompose_by_tool(surface.vertices, surface.faces, budget)
        case "auto":
            return decompose_surface(surface, budget)
