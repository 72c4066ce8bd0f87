"""Shapes of the parts of an object, in two rows, so that two cores may make them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from simart_kit import Asset
from simart_kit.beside import Beside, Later
from simart_kit.decompose import Budget, Decomposition, Surface, decompose_by_tool, decompose_surface
from simart_kit.fitting import aligned_box
from simart_kit.hulls import MIN_THICKNESS, convex_hull

Mode = Literal["auto", "decompose", "hull", "box", "none"]
Shapes = dict[str, Decomposition]  # by name of the part
_UNEVEN = 2  # times the faces of the second row: with more, the other process would idle while it waits
_KEPT = 8  # so many times less than an equal share of the work is kept for each part that comes later


@dataclass(frozen=True, eq=False)
class Rounds:
    """Shapes of a row of parts.

    Attributes:
        first: of all of them.
        tighter: of those that are not settled, for where they overlap their neighbours.
    """

    first: Shapes
    tighter: Shapes


@dataclass(frozen=True, eq=False)
class Early:
    """Shapes of the first row that another process is making already.

    Attributes:
        asset: whose.
        names: of all parts that get shapes so.
        shapes: of those in the first row.
    """

    asset: Asset
    names: frozenset[str]
    shapes: Later[Rounds]

    def fits(self, asset: Asset, names: Collection[str]) -> bool:
        """Whether they are those of another asset, in which joints may differ."""
        same = self.asset.mesh is asset.mesh and self.names == set(names)
        return same and np.array_equal(self.asset.face_part, asset.face_part)


class Shaper:
    """Makes shapes of an object's parts.

    Which row a part is in depends on the parts alone, and each row has work of its own: shapes are the same
    with a second core and without.

    Args:
        surfaces: of the parts, by name.
        mode: of the modifier `collision`.
        beside: who makes those of one row.
        early: what `begun` gave.
    """

    def __init__(
        self,
        surfaces: Mapping[str, Surface],
        mode: Mode,
        beside: Beside,
        early: Later[Rounds] | None = None,
    ) -> None:
        self._surfaces, self._mode, self._beside, self._later = surfaces, mode, beside, early
        self._rows = _rows(surfaces)

    @property
    def uneven(self) -> bool:
        """Whether the first row takes so much longer that it had better begin early; it is one part then."""
        first, second = (sum(len(self._surfaces[name].faces) for name in row) for row in self._rows)
        return first > _UNEVEN * second

    def begun(self, budget: Budget, tighter: Budget) -> Later[Rounds]:
        """Shapes of the first row, which the other process makes while this one does something else."""
        return self._beside.ask(rounds_of, self._sent(self._rows[0]), self._mode, budget, tighter)

    def made(self, names: Collection[str], budget: Budget, before: Shapes) -> Shapes:
        """Shapes of some of the parts; none of those in a row where no work is left.

        Args:
            names: of the parts; the second time of none that is settled.
            budget: of each row, if nothing had been done before; the first or the second one of `begun`.
            before: what has been done, in either row: nothing, or the first shapes of all.
        """
        (mine, my_budget), (theirs, their_budget) = (
            self._left(row, names, budget, before) for row in self._rows
        )
        if self._later is not None:
            self._beside.go_on()
            found = shapes_of(theirs, self._mode, their_budget)
            early = self._early.tighter if before else self._early.first
            found |= {name: early[name] for name in mine}
        elif self._beside.helps:  # asked even of an empty row: what waits behind it begins
            later = self._beside.ask(shapes_of, self._sent(theirs), self._mode, their_budget)
            found = shapes_of(mine, self._mode, my_budget) | later.result()
        else:  # the time for the tool is for all of them
            found = shapes_of(mine, self._mode, my_budget)
            seconds = max(budget.tool_seconds - sum(m.tool_seconds for m in found.values()), 0.0)
            found |= shapes_of(theirs, self._mode, replace(their_budget, tool_seconds=seconds))
        return {name: found[name] for name in self._surfaces if name in found}

    def _left(
        self, row: Iterable[str], names: Collection[str], budget: Budget, before: Shapes
    ) -> tuple[dict[str, Surface], Budget]:
        """Those of a row that are wanted, if it has work left, and what is left of its budget."""
        left = _less(budget, [before[name] for name in row if name in before])
        wanted = {name: self._surfaces[name] for name in row if name in names and left.work > 0}
        return wanted, left

    @cached_property
    def _early(self) -> Rounds:
        assert self._later is not None
        return self._later.result()

    def _sent(self, names: Iterable[str]) -> dict[str, Surface]:
        """Some of the surfaces, without what is kept with them."""
        chosen = {name: self._surfaces[name] for name in names}
        return {name: Surface(s.vertices, s.faces, s.most) for name, s in chosen.items()}


def rounds_of(surfaces: Mapping[str, Surface], mode: Mode, budget: Budget, tighter: Budget) -> Rounds:
    """Shapes of some parts, and at once those that are asked for next if they overlap others."""
    first = shapes_of(surfaces, mode, budget)
    left = _less(tighter, first.values())
    rest = {name: surface for name, surface in surfaces.items() if not first[name].settled and left.work > 0}
    return Rounds(first, shapes_of(rest, mode, left))


def _less(budget: Budget, done: Iterable[Decomposition]) -> Budget:
    """A budget without the work that was done."""
    return replace(budget, work=budget.work - sum(made.work for made in done))


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
