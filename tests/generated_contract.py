"""What every category of generated objects promises."""

import re

import numpy as np
from simart_kit_plugins.nano.generate.category import Category
from simart_kit_plugins.nano.generate.objects import GeneratedObject
from simart_kit_plugins.shapes.dice import Dice

from simart_kit.physics import MATERIALS
from simart_kit.triangles import areas

SEEDS = 6
# Furniture, appliances, tools and vehicles [m].
SMALLEST, LARGEST = 0.01, 6.0


def check(category: Category) -> None:
    """All promises, on a few objects of a category."""
    made = [category.make(Dice((5, seed))) for seed in range(SEEDS)]
    for one in made:
        _check_object(one, category.moves)
    prints = {b"".join(body.triangles.tobytes() for body in one.bodies) for one in made}
    assert len(prints) == SEEDS
    again = category.make(Dice((5, 0)))
    assert all(
        np.array_equal(a.triangles, b.triangles) for a, b in zip(again.bodies, made[0].bodies, strict=True)
    )


def _check_object(made: GeneratedObject, moves: bool) -> None:
    assert moves == (len(made.bodies) > 1)
    assert len(made.bodies) <= 100
    names = [body.name for body in made.bodies]
    assert len(set(names)) == len(names)
    everything = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3)
    low, high = everything.min(axis=0), everything.max(axis=0)
    assert SMALLEST < (high - low).max() < LARGEST
    assert abs(low[2]) < 1e-6 * (high - low).max()  # stands on z = 0
    assert len(everything) < 3 * 30_000
    corners = [set(map(tuple, np.round(body.triangles.reshape(-1, 3), 9).tolist())) for body in made.bodies]
    assert sum(map(len, corners)) == len(set.union(*corners))  # or a reader may weld two bodies together
    for number, body in enumerate(made.bodies):
        assert re.fullmatch(r"[a-z][a-z0-9_]*", body.name)
        assert re.fullmatch(r"[a-z][a-z ]*", body.label)
        assert np.isfinite(body.triangles).all()
        assert areas(body.triangles).sum() > 0
        assert {surface.look.material for surface in body.surfaces} <= set(MATERIALS)
        assert (body.motion is None) == (number == 0)
        if body.motion is not None:
            _check_motion(made, number)


def _check_motion(made: GeneratedObject, number: int) -> None:
    body = made.bodies[number]
    motion = body.motion
    assert 0 <= body.parent < number
    assert motion.kind in ("revolute", "continuous", "prismatic", "ball", "free")
    assert np.linalg.norm(motion.axis) - 1 < 1e-9
    assert motion.lower <= 0 <= motion.upper
    if motion.kind in ("revolute", "prismatic"):
        assert motion.upper - motion.lower > 1e-3
        assert motion.upper - motion.lower <= 2 * np.pi
    else:
        assert (motion.lower, motion.upper) == (0, 0)
    if motion.kind in ("revolute", "continuous", "ball"):
        # A hinge is at or beside the body that it carries.
        points = body.triangles.reshape(-1, 3)
        away = np.linalg.norm(points - np.clip(motion.origin, points.min(0), points.max(0)), axis=1).min()
        along = np.cross(points - motion.origin, motion.axis)
        assert min(away, np.linalg.norm(along, axis=1).min()) < np.ptp(points, axis=0).max()
