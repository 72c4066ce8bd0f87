"""`collision`: convex shapes for every part, tight where things can reach, and clear of their neighbours."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import replace
from typing import Literal

from pydantic import Field

import simart_kit as sk
from simart_kit.asset import ConvexMesh
from simart_kit.beside import ALONE, Beside
from simart_kit.carving import carved_apart
from simart_kit.closing import MOST_PIECES
from simart_kit.coarsening import coarsened
from simart_kit.convex_decomposition import lacks
from simart_kit.cutting import WORK
from simart_kit.decompose import Budget, Decomposition, Surface
from simart_kit.easing import eased
from simart_kit.findings import Finding, library
from simart_kit.hinge_relief import relieved
from simart_kit.hookspecs import Register
from simart_kit.separation import Overlap, overlaps, separated
from simart_kit.wheels import wheels

from .shaping import Early, Mode, Shaper, Shapes

_MOST_FACES = 60_000  # of a part that shapes are fitted to; finer ones are coarsened first
_LEAST_PIECES = 32  # that even a part with few of the faces may come apart into
_REBATES = 1.01  # how tight shapes have to be where parts overlap


class Collision(sk.Modifier):
    """Give every part convex collision shapes, in the asset frame."""

    name = "collision"

    class Options(sk.Options):
        """How tight and how large the shapes may be."""

        mode: Mode = Field(
            "auto",
            description="auto: primitives where they fit, cylinders for wheels, hulls of what is convex, and "
            "cuts along the part's own planes, so that what is hollow stays hollow; decompose: the whole "
            "surface by `tool`; hull: one convex hull; box: the bounding box; none: no shape",
        )
        tool: Literal["vhacd", "coacd"] = Field(
            "vhacd",
            description="convex decomposition for mode decompose, and in mode auto for what no cut makes "
            "tight; coacd follows surfaces better, is slow and an extra: `pip install 'simart-kit[coacd]'`",
        )
        tool_timeout: float = Field(
            4.0, ge=0, description="time that `tool` may take for all parts; hulls then stand in [s]"
        )
        max_shapes: int = Field(32, ge=1, description="most shapes of a part in modes auto and decompose")
        max_vertices: int = Field(64, ge=8, description="most vertices of a shape; simulators take 64")
        margin: float = Field(
            0.002,
            ge=0,
            le=0.05,
            description="most that a shape gives way on a side where it overlaps or touches a part that "
            "moves against its own [m]",
        )

    options: Options
    _early: Early | None = None

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset with new collision shapes.

        Raises:
            BadInputError: the tool is needed and not installed.
        """
        return self.modify_beside(asset, ALONE)

    def modify_beside(self, asset: sk.Asset, beside: Beside) -> sk.Asset:
        """As `modify`; about half of the shapes are left to another process, if there is one."""
        options = self.options
        lacking = options.mode in ("auto", "decompose") and lacks(options.tool)
        if lacking:
            raise sk.BadInputError(f"modifier collision: {options.tool} is not installed: {lacking}")
        rolling, surfaces = self._parted(asset)
        early = self._early.shapes if self._early and self._early.fits(asset, surfaces) else None
        shaper = Shaper(surfaces, options.mode, beside, early)
        made = rolling | shaper.made(surfaces, self._first_budget, {})
        done = self._placed(asset, made)
        found: Sequence[Overlap] = overlaps(done)
        if found and options.mode == "auto":
            made, done, found = self._refined(asset, shaper, made, done, found)
        if found and options.margin and options.mode in ("auto", "decompose"):
            done = carved_apart(done, beside=beside)
            found = overlaps(done)
        done = eased(done) if options.margin and options.mode in ("auto", "decompose") else done
        done, freed = relieved(done) if options.margin and options.mode != "box" else (done, ())
        problems = [f"{name} has looser shapes: {m.problem}" for name, m in made.items() if m.problem]
        done = done.with_notes(
            "collision", "info", [_counts(options.mode, done), *_told(found), *_freed(freed)]
        )
        return done.with_notes("collision", "warning", problems)

    def begun(self, asset: sk.Asset, beside: Beside) -> Collision:
        """One whose shapes another process makes already, if one part has most of the faces: of that part."""
        _, surfaces = self._parted(asset)
        shaper = Shaper(surfaces, self.options.mode, beside)
        if not shaper.uneven:
            return self
        early = copy(self)
        early._early = Early(
            asset, frozenset(surfaces), shaper.begun(self._first_budget, self._tighter_budget)
        )
        return early

    def _parted(self, asset: sk.Asset) -> tuple[Shapes, dict[str, Surface]]:
        """The cylinders of wheels, and the surfaces of all other parts."""
        round_ones = wheels(asset) if self.options.mode == "auto" else {}
        rolling = {name: Decomposition((cylinder,)) for name, cylinder in round_ones.items()}
        names = {index: part.name for index, part in enumerate(asset.parts) if part.name not in rolling}
        return rolling, {name: _surface(asset, index) for index, name in names.items()}

    def _refined(
        self,
        asset: sk.Asset,
        shaper: Shaper,
        made: Shapes,
        done: sk.Asset,
        found: Sequence[Overlap],
    ) -> tuple[Shapes, sk.Asset, Sequence[Overlap]]:
        """What is known, or tighter shapes where parts overlap, if these overlap less: rebates are small.

        A part keeps its shapes if they are settled.
        """
        names = {name for overlap in found for name in (overlap.one, overlap.other)}
        settled = {name for name, m in made.items() if m.settled}
        tighter = shaper.made(names - settled, self._tighter_budget, made)
        if not tighter:
            return made, done, found
        finer = made | tighter
        tried = self._placed(asset, finer)
        remaining = overlaps(tried)
        if sum(o.depth for o in remaining) < sum(o.depth for o in found):
            return finer, tried, remaining
        return made, done, found

    def _placed(self, asset: sk.Asset, made: Shapes) -> sk.Asset:
        """The asset with shapes, which give way to those of neighbours."""
        changed = {name: replace(asset.part(name), collision=m.shapes) for name, m in made.items()}
        margin = self.options.margin
        return separated(asset.with_parts(changed), margin) if margin else asset.with_parts(changed)

    @property
    def _first_budget(self) -> Budget:
        return self._budget(Budget().tight, self.options.tool_timeout)

    @property
    def _tighter_budget(self) -> Budget:
        return self._budget(_REBATES, 0.0)

    def _budget(self, tight: float, seconds: float) -> Budget:
        options = self.options
        return Budget(options.max_shapes, options.max_vertices, tight, WORK, options.tool, seconds)


def _surface(asset: sk.Asset, index: int) -> Surface:
    """The surface of a part, coarsened where it is very fine, in pieces by its share of the faces."""
    faces = asset.mesh.faces[asset.face_part == index]
    most = max(MOST_PIECES * len(faces) // len(asset.mesh.faces), _LEAST_PIECES)
    return Surface(*coarsened(asset.mesh.vertices, faces, _MOST_FACES), most)


def _counts(mode: str, asset: sk.Asset) -> str:
    """How many shapes each part has, and of what kind."""
    counts = ", ".join(f"{part.name} {len(part.collision)}" for part in asset.parts)
    kinds = _kinds(shape for part in asset.parts for shape in part.collision)
    return f"convex shapes ({mode}): {counts}; {kinds}"


def _kinds(shapes: Iterable[ConvexMesh]) -> str:
    found = Counter(shape.primitive.kind if shape.primitive else "hull" for shape in shapes)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(found.items())) or "no shapes"


def _told(found: Iterable[Overlap]) -> list[str]:
    """A sentence naming the parts that still overlap at rest; none when none do."""
    words = [f"{o.one} and {o.other} ({1000 * o.depth:.2g} mm)" for o in found]
    return (
        [f"collision shapes overlap at rest, simulators exclude the pairs: {', '.join(words)}"]
        if words
        else []
    )


def _freed(names: Sequence[str]) -> list[str]:
    """A sentence naming the parts whose shapes give way at their hinge; none when none do."""
    return [f"collision shapes begin off the hinge, to pass what is beside it: {', '.join(names)}"] * bool(
        names
    )


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Collision)


@sk.hookimpl
def diagnose() -> list[Finding]:
    """The tools of mode decompose; without them, hulls stand in."""
    return [library("vhacdx", stages=()), library("coacd", extra="coacd", stages=())]
