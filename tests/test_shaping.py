"""Shapes of parts in two rows: who makes which, and that it makes no difference."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

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


SURFACES = {"lid": surface(1), "body": surface(10), "door": surface(6), "drawer": surface(5)}


def counts(shapes: dict[str, Decomposition]) -> dict[str, int]:
    return {name: len(made.shapes) for name, made in shapes.items()}


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
    helped = Shaper(SURFACES, "auto", Listening()).made(SURFACES, Budget(), {})
    for name, made in alone.items():
        for one, other in zip(made.shapes, helped[name].shapes, strict=True):
            np.testing.assert_array_equal(one.vertices, other.vertices)


def test_nothing_is_made_without_work_left() -> None:
    before = {"body": Decomposition((), work=30), "door": Decomposition((), work=30)}
    shaper = Shaper(SURFACES, "auto", ALONE)
    assert shaper.made({"lid"}, Budget(work=60), before) == {}
    assert set(shaper.made({"lid"}, Budget(work=61), before)) == {"lid"}


def test_of_no_parts_there_are_no_shapes() -> None:
    assert shapes_of({}, "auto", Budget()) == {}
    assert Shaper({}, "auto", ALONE).made((), Budget(), {}) == {}
