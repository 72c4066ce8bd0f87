"""Hinges that show where the leaves of generated objects turn."""

from collections.abc import Sequence

import numpy as np
import pytest
from simart_kit_plugins.nano.generate.hinges import hinged
from simart_kit_plugins.nano.generate.objects import Body, Look, Motion, hinge, root, slide, surface
from simart_kit_plugins.shapes.dice import Dice
from simart_kit_plugins.shapes.primitives import between

WOOD = Look("wood", (120, 90, 60))
BOX = root([surface([between((0, 0, 0), (1, 0.5, 2))], WOOD)])


def with_leaf(motion: Motion, label: str = "door") -> Sequence[Body]:
    """A box, and before it a leaf with its left edge at x = 0, from 0.5 to 1.5 m above the ground."""
    panel = surface([between((0, -0.03, 0.5), (1, -0.01, 1.5))], WOOD)
    return [BOX, Body("leaf", label, (panel,), 0, motion)]


def added(bodies: Sequence[Body], seed: int = 0) -> np.ndarray:
    """(N, 3) corners of what the box gets."""
    made = hinged(lambda dice: bodies, Dice(seed))
    assert [len(body.surfaces) for body in made[1:]] == [len(body.surfaces) for body in bodies[1:]]
    return np.concatenate([s.triangles for s in made[0].surfaces[1:]] or [np.zeros((0, 3, 3))]).reshape(-1, 3)


def shown(bodies: Sequence[Body]) -> list[np.ndarray]:
    """What is added by each of twenty dice."""
    return [added(bodies, seed) for seed in range(20)]


def test_barrels_lie_on_the_line_of_a_door_near_both_of_its_ends():
    found = [points for points in shown(with_leaf(hinge((0, -0.03, 1), (0, 0, -1), 1.6))) if len(points)]
    assert 10 <= len(found) < 20  # mostly they show
    for points in found:
        assert np.linalg.norm(points[:, :2] - [0, -0.03], axis=1).max() < 0.01
        assert np.ptp(points[:, 2]) == pytest.approx(0.76)
        assert points[:, 2].min() == pytest.approx(0.62)


@pytest.mark.parametrize(
    ("motion", "label"),
    [
        (hinge((0, -0.03, 1), (0, 0, -1), 1.6), "lever"),  # is no leaf
        (slide((0, -1, 0), 0.4), "door"),
        (hinge((0.5, -0.02, 1), (0, 1, 0), 1.6), "cover"),  # turns about its middle
        (hinge((0, -0.03, 0.001), (1, 0, 0), 1.6), "flap"),  # on the ground, and far from it
    ],
)
def test_what_is_no_leaf_that_turns_at_its_edge_has_none(motion, label):
    assert not any(len(points) for points in shown(with_leaf(motion, label)))


def test_leaves_of_one_object_have_them_or_have_none():
    left, right = (
        Body(name, "door", with_leaf(motion)[1].surfaces, 0, motion)
        for name, motion in (
            ("left", hinge((0, -0.03, 1), (0, 0, -1), 1.6)),
            ("right", hinge((1, -0.03, 1), (0, 0, 1), 1.6)),
        )
    )
    for points in shown([BOX, left, right]):
        sides = {bool(x > 0.5) for x in points[:, 0]}
        assert sides in (set(), {False, True})
