"""A part as a few convex shapes: the ladder from primitives to voxels."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray, IntArray
from .asset import ConvexMesh
from .closing import MOST_PIECES, pieces_of
from .convex_decomposition import DecompositionError, Tool, run_tool
from .cutting import WORK, cut, cut_tight, is_loose
from .fitting import fitted_to
from .grouping import grouped
from .hulls import convex_hull
from .mending import mended
from .pieces import Piece, hulled
from .shells import find_shells
from .straightening import straightened
from .topology import occurring
from .triangles import unit_normals

if TYPE_CHECKING:
    from manifold3d import Manifold

_LEAST = 0.003  # of the hull of all, times how loose hulls may be: what one may hold besides its solid
_WHEEL = 1.25  # times its solid: what the hull of something round may hold
_FINER = 3  # times the shapes: pieces to cut first, which are then put together again
_CUTS = 64  # of a shell that the work has to allow, or else it is not cut if it is of rods
_LARGE = 0.01  # of the hull of all: excess from which on a piece is not joined with others
_HOPELESS = 1.3  # times its solid: what a hull may hold when cutting has ended, before a tool is asked
_WORTH_A_TOOL = 0.01  # of the hull of all: excess from which on a tool is asked
_FILLED = 0.25  # of the hull of all: excess of a solid, still there when cut, that asks a tool for the whole
_OF_VOXELS = 16  # vertices that a shape made of voxels is worth: more only take contacts and time
_MOST_HOLDERS = 64
_UNITED = 20_000  # faces of solids that are put together to see what they fill
_INSIDE = 1e-4  # [m] that something hidden in a shape may look out of it


@dataclass(frozen=True)
class Budget:
    """What a decomposition may cost.

    Attributes:
        shapes: of a part.
        vertices: of a shape; at least 8.
        tight: a shape is when it holds less than so many times the solid in it.
        work: see `cutting.WORK`.
        tool: for what cutting cannot part.
        tool_seconds: that the tool may take; 0 never runs it.
    """

    shapes: int = 32
    vertices: int = 64
    tight: float = 1.05
    work: int = WORK
    tool: Tool = "vhacd"
    tool_seconds: float = 4.0


@dataclass(frozen=True, eq=False)
class Surface:
    """What is to be stood for by shapes, with what does not depend on how tight these are to be.

    Attributes:
        vertices: (V, 3) [m].
        faces: (F, 3).
        most: pieces that it may come apart into, see `closing.pieces_of`.
    """

    vertices: FloatArray
    faces: IntArray
    most: int = MOST_PIECES

    @cached_property
    def points(self) -> FloatArray:
        """(N, 3) vertices that its faces use [m]."""
        return self.vertices[occurring(self.faces)]

    @cached_property
    def whole(self) -> Piece:
        """All of it, filled."""
        return hulled(self.points)

    @cached_property
    def pieces(self) -> list[Piece]:
        """The solids of its shells."""
        return pieces_of(find_shells(self.vertices, self.faces), self.most)


@dataclass(frozen=True, eq=False)
class Decomposition:
    """Convex shapes of a part.

    Attributes:
        shapes: at least one.
        problem: why the tool gave nothing; "" when it did, or was not asked.
        tool_seconds: that the tool took.
        work: faces that were cut.
        crowded: whether there were more pieces than shapes, so that some were put together again.
    """

    shapes: tuple[ConvexMesh, ...]
    problem: str = ""
    tool_seconds: float = 0.0
    work: int = 0
    crowded: bool = False

    @property
    def settled(self) -> bool:
        """Whether tighter ones would be no better: they would be put together again, or a tool has made some.

        Tools know no rebates.
        """
        return self.crowded or self.tool_seconds > 0


def decompose(vertices: FloatArray, faces: IntArray, budget: Budget = Budget()) -> Decomposition:
    """Shapes for (F, 3) faces on (V, 3) vertices [m], see `decompose_surface`."""
    return decompose_surface(Surface(vertices, faces), budget)


def decompose_surface(surface: Surface, budget: Budget) -> Decomposition:
    """The tightest shapes that a budget allows, by a ladder.

    One shape if the whole is convex. Else one for each shell: a primitive where that fits, or its hull where
    it is filled. Else the shell is cut along its own planes, and what then still is loose goes to the tool.

    Args:
        surface: of the part.
        budget: what it may cost.
    """
    whole, pieces = surface.whole, _visible(surface.pieces, budget.tight)
    solid = _solid_volume(pieces, whole.hull_volume / _WHEEL)
    if not pieces or (len(pieces) > 1 and whole.hull_volume <= budget.tight * solid):
        return Decomposition((_shape(replace(whole, volume=solid), budget),))
    if whole.hull_volume <= _WHEEL * solid and (wheel := _round(whole)):
        return Decomposition((wheel,))
    dear = 0 if len(pieces) > budget.shapes else budget.work // _CUTS
    least, finer = _LEAST * (budget.tight - 1) * whole.hull_volume, _FINER * budget.shapes
    cuts, work = cut(
        _joined(straightened(pieces, dear), finer, budget.tight, whole.hull_volume),
        finer,
        budget.tight,
        least,
        budget.work,
    )
    found = mended(cuts, budget.shapes, cut_tight(budget.tight), least)
    made = _with_tool(found, budget, _WORTH_A_TOOL * whole.hull_volume)
    filled = min(max(piece.excess for piece in those) for those in (pieces, found))
    if filled > _FILLED * whole.hull_volume and budget.tool_seconds > 0:
        coarse = replace(budget, vertices=min(budget.vertices, _OF_VOXELS))
        made = _less_filled(made, decompose_by_tool(surface.vertices, surface.faces, coarse), pieces)
    return replace(made, work=work, crowded=len(cuts) > budget.shapes)


def decompose_by_tool(vertices: FloatArray, faces: IntArray, budget: Budget) -> Decomposition:
    """The pieces that the tool makes of the whole surface, its hull when there are none."""
    started = time.monotonic()
    try:
        found = run_tool(budget.tool, vertices, faces, budget.shapes, budget.vertices, budget.tool_seconds)
    except DecompositionError as error:
        seconds = time.monotonic() - started
        hull = convex_hull(vertices[occurring(faces)], budget.vertices)
        return Decomposition((hull,), str(error), seconds)
    shapes = tuple(convex_hull(points, budget.vertices) for points in found)
    return Decomposition(shapes, "", time.monotonic() - started)


def _with_tool(pieces: Sequence[Piece], budget: Budget, worth: float) -> Decomposition:
    """Shapes of the pieces, the loosest one of which goes to the tool if it is very loose."""
    shapes = [_shape(piece, budget) for piece in pieces]
    room = budget.shapes - len(pieces) + 1
    loose = [i for i, p in enumerate(pieces) if is_loose(p, _HOPELESS, worth)]
    if not loose or room < 2 or budget.tool_seconds <= 0:
        return Decomposition(tuple(shapes))
    worst = max(loose, key=lambda i: pieces[i].excess)
    body = pieces[worst].body
    assert body is not None
    mesh = body.to_mesh64()
    points, corners = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    found = decompose_by_tool(points, corners, replace(budget, shapes=room))
    if _misses(found.shapes, body) < pieces[worst].excess:
        shapes[worst : worst + 1] = found.shapes
    return replace(found, shapes=tuple(shapes))


def _less_filled(made: Decomposition, other: Decomposition, pieces: Sequence[Piece]) -> Decomposition:
    """The one whose shapes are nearer to the solids of the pieces; the first where the other has failed."""
    import manifold3d

    bodies = [piece.body for piece in pieces if piece.body is not None]
    if other.problem or not bodies:
        return made
    solid = manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)
    nearer = min(made, other, key=lambda one: _misses(one.shapes, solid))
    return replace(nearer, tool_seconds=made.tool_seconds + other.tool_seconds)


def _misses(shapes: Sequence[ConvexMesh], body: Manifold) -> float:
    """[m^3] that shapes hold besides a solid, and that they lack of it: tools work on voxels, and slip."""
    import manifold3d

    hulls = [manifold3d.Manifold.hull_points(shape.vertices) for shape in shapes]
    union = manifold3d.Manifold.batch_boolean(hulls, manifold3d.OpType.Add)
    return float((union - body).volume() + (body - union).volume())


def _shape(piece: Piece, budget: Budget) -> ConvexMesh:
    """A primitive where one fits, else the hull."""
    fit = fitted_to(piece.hull, piece.volume, 1 / budget.tight) if piece.hull else None
    return fit or convex_hull(piece.points, budget.vertices)


def _round(piece: Piece) -> ConvexMesh | None:
    """The cylinder or sphere that its hull fills: wheels and knobs roll, whatever is carved in them."""
    shape = fitted_to(piece.hull, piece.hull_volume) if piece.hull else None
    return shape if shape and shape.primitive and shape.primitive.kind != "box" else None


def _solid_volume(pieces: Sequence[Piece], enough: float) -> float:
    """[m^3] that the pieces fill together. What overlaps counts once, where that can matter for `enough`.

    Of very many faces, those of the largest pieces count: it is no less than that.
    """
    import manifold3d

    total = sum(p.volume for p in pieces)
    bodies = [p.body for p in pieces if p.body is not None]
    if total < enough or len(bodies) < 2:
        return total
    rest = total - sum(b.volume() for b in bodies)
    bodies.sort(key=lambda body: -body.volume())
    faces = np.cumsum([body.num_tri() for body in bodies])
    bodies = bodies[: max(int(np.searchsorted(faces, _UNITED, side="right")), 1)]
    return float(rest + manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add).volume())


def _visible(pieces: Sequence[Piece], tight: float) -> list[Piece]:
    """The pieces that do not lie within a single filled one, as the inside of a wall and repeats do."""
    size = np.array([p.hull_volume for p in pieces])
    lower, upper = (np.array([getattr(p, end) for p in pieces]).reshape(-1, 3) for end in ("lower", "upper"))
    order = np.argsort(-size, kind="stable")
    hidden = np.zeros(len(pieces), dtype=bool)
    filled = [int(i) for i in order if pieces[i].hull_volume <= tight * pieces[i].volume]
    for holder in filled[:_MOST_HOLDERS]:
        if hidden[holder]:
            continue
        hull = pieces[holder].hull
        if hull is None:
            continue
        normals = unit_normals(hull.vertices[hull.faces])
        ends = np.einsum("fi,fi->f", normals, hull.vertices[hull.faces[:, 0]]) + _INSIDE
        inside = (lower >= lower[holder] - _INSIDE) & (upper <= upper[holder] + _INSIDE)
        for i in np.flatnonzero(inside.all(axis=1) & ~hidden & (size <= size[holder])).tolist():
            if i != holder and (pieces[i].points @ normals.T <= ends).all():
                hidden[i] = True
    return [piece for piece, skipped in zip(pieces, hidden, strict=True) if not skipped]


def _joined(pieces: Sequence[Piece], most: int, tight: float, whole: float) -> list[Piece]:
    """The pieces in `most` or fewer: those that lie close together share a hull, but large hollow ones."""
    if len(pieces) <= most:
        return list(pieces)
    hollow = [i for i, p in enumerate(pieces) if is_loose(p, tight, _LARGE * whole)]
    alone = sorted(hollow, key=lambda i: -pieces[i].excess)[: most // 4]
    others = [i for i in range(len(pieces)) if i not in alone]
    room = most // 2 if alone else most
    boxes = [np.array([pieces[i].points.min(axis=0), pieces[i].points.max(axis=0)]) for i in others]
    groups = [[others[i] for i in group] for group in grouped(boxes, room)] + [[i] for i in alone]
    return [_together([pieces[i] for i in group]) for group in sorted(groups)]


def _together(pieces: Sequence[Piece]) -> Piece:
    if len(pieces) == 1:
        return pieces[0]
    joined = hulled(np.concatenate([piece.points for piece in pieces]))
    return replace(joined, volume=min(sum(p.volume for p in pieces), joined.volume))
