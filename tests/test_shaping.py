"""Shapes of parts in two rows: who makes which, and that it makes no difference."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import manifold3d
import numpy as np
from simart_kit_plugins.modifiers.shaping import Shaper, shapes_of

from simart_kit.beside import ALONE, Beside, Later
from simart_kit.decompose import Budget, Decomposition, Surface
from simart_kit.testing.meshes import boxes_mesh


class Listening(Beside):
    """Says that it helps, remembers what it is asked for, and does it here."""

    def __init__(self) -> None:
        super().__init__(wanted=False)
        self.names: list[set[str]] = []

    @property
    def helps(self) -> bool:
        return True

    def ask(self, function: Callable[..., Any], *args: Any, **kwargs: Any) -> Later[Any]:
        self.names.append(set(args[0]))
        return super().ask(function, *args, **kwargs)


def surface(boxes: int) -> Surface:
    mesh = boxes_mesh([((2 * i, 0, 0), (2 * i + 1, 1, 1)) for i in range(boxes)])
    return Surface(np.array(mesh.vertices), np.array(mesh.faces))


def notched() -> Surface:
    """A block without a fifth of two sides along an edge, whose hull holds 2 percent besides it."""
    outline = manifold3d.CrossSection([[(0, 0), (1, 0), (1, 0.8), (0.8, 0.8), (0.8, 1), (0, 1)]])
    mesh = outline.extrude(1.0).to_mesh64()
    return Surface(np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts).astype(np.int32))


SURFACES = {"lid": surface(1), "body": surface(10), "door": surface(6), "drawer": surface(5)}


def counts(shapes: dict[str, Decomposition]) -> dict[str, int]:
    return {name: len(made.shapes) for name, made in shapes.items()}


def assert_same(found: dict[str, Decomposition], expected: dict[str, Decomposition]) -> None:
    assert list(found) == list(expected)
    for name, made in expected.items():
        for one, other in zip(found[name].shapes, made.shapes, strict=True):
            np.testing.assert_array_equal(one.vertices, other.vertices)


def test_each_row_has_about_half_of_the_faces_and_the_largest_part_stays_here() -> None:
    beside = Listening()
    made = Shaper(SURFACES, "auto", beside).made(SURFACES, Budget(), {})
    assert beside.names == [{"door", "drawer"}]
    assert list(counts(made).items()) == [("lid", 1), ("body", 10), ("door", 6), ("drawer", 5)]


def test_only_what_is_asked_for_is_made_and_even_no_part_lets_what_waits_behind_it_begin() -> None:
    beside = Listening()
    assert set(Shaper(SURFACES, "auto", beside).made({"lid", "body"}, Budget(), {})) == {"lid", "body"}
    assert beside.names == [set()]


def test_one_after_the_other_makes_the_same() -> None:
    alone = Shaper(SURFACES, "auto", ALONE).made(SURFACES, Budget(), {})
    assert_same(Shaper(SURFACES, "auto", Listening()).made(SURFACES, Budget(), {}), alone)


def test_nothing_is_made_of_a_row_without_work_left() -> None:
    before = {"body": Decomposition((), work=30), "door": Decomposition((), work=40)}
    shaper = Shaper(SURFACES, "auto", ALONE)
    assert shaper.made(SURFACES, Budget(work=30), before) == {}
    assert set(shaper.made(SURFACES, Budget(work=31), before)) == {"body", "lid"}
    assert set(shaper.made(SURFACES, Budget(work=41), before)) == set(SURFACES)


def test_what_began_early_is_what_both_rounds_make() -> None:
    surfaces = {"body": notched(), "lid": surface(1)}
    first, tighter = Budget(), Budget(tight=1.01, tool_seconds=0.0)
    alone = Shaper(surfaces, "auto", ALONE)
    made = alone.made(surfaces, first, {})
    finer = alone.made(surfaces, tighter, made)
    assert counts(made) == {"body": 1, "lid": 1}
    assert counts(finer) == {"body": 2, "lid": 1}
    beside = Listening()
    early = Shaper(surfaces, "auto", beside, Shaper(surfaces, "auto", beside).begun(first, tighter))
    assert beside.names == [{"body"}]
    assert_same(early.made(surfaces, first, {}), made)
    assert_same(early.made(surfaces, tighter, made), finer)
    assert set(early.made({"lid"}, tighter, made)) == {"lid"}
    assert beside.names == [{"body"}]


def test_of_no_parts_there_are_no_shapes() -> None:
    assert shapes_of({}, "auto", Budget()) == {}
    assert Shaper({}, "auto", ALONE).made((), Budget(), {}) == {}
