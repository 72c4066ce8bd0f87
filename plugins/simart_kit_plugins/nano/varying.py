"""Made-up objects made harder: seen from elsewhere, stretched, noisy, with pieces fused and split."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .generate.objects import GeneratedObject


def placed(made: GeneratedObject, generator: np.random.Generator) -> GeneratedObject:
    """Stretched, mirrored, turned by quarters about z and a little beyond, centred, its longest side 1.

    A stretch that would bend a joint's circle is one of the plane it turns in, of no axis alone, where a part
    turns at all about an axis off the coordinate directions.
    """
    matrix = _turn(generator) @ _stretch(made, generator)
    everything = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3) @ matrix.T
    low, high = everything.min(axis=0), everything.max(axis=0)
    size = float((high - low).max())
    bodies = (body.placed(matrix / size, -(low + high) / 2 / size) for body in made.bodies)
    return GeneratedObject(made.category, tuple(bodies))


def _stretch(made: GeneratedObject, generator: np.random.Generator) -> FloatArray:
    """(3, 3) diagonal; one factor for all axes that a turn off the coordinate directions mixes."""
    if generator.random() < 0.5:
        return np.eye(3)
    factors = np.exp(generator.uniform(-0.35, 0.35, 3))
    for body in made.bodies[1:]:
        motion = body.motion
        turns = motion is not None and motion.kind in ("revolute", "continuous", "ball")
        if motion is not None and turns and np.abs(motion.axis).max() < 1 - 1e-6:
            return np.asarray(np.eye(3) * factors[0])
    return np.asarray(np.diag(factors))


def _turn(generator: np.random.Generator) -> FloatArray:
    """(3, 3) quarters about z, mirrored half of the time, sometimes a little off."""
    angle = generator.integers(4) * np.pi / 2
    if generator.random() < 0.25:
        angle += generator.normal(0, 0.12)
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    if generator.random() < 0.5:
        turn = turn @ np.diag([-1.0, 1.0, 1.0])
    return np.round(turn, 15)


def joined(piece: IntArray, body: IntArray, generator: np.random.Generator) -> IntArray:
    """(N,) pieces of which those of some bodies are one each, as whoever models for a simulator joins them.

    Args:
        piece: (N,) of the points, 0.. without gaps.
        body: (N,) of the points.
        generator: of the choice.
    """
    count = int(piece.max()) + 1
    chosen = generator.random(int(body.max()) + 1) < generator.random()
    owner = np.zeros(count, dtype=np.int64)
    owner[piece] = body
    one = np.where(chosen[owner], count + owner, np.arange(count))
    return np.asarray(np.unique(one[piece], return_inverse=True)[1].reshape(-1))


def fused(piece: IntArray, points: FloatArray, generator: np.random.Generator) -> IntArray:
    """(N,) pieces of which some neighbours are one, and some large ones are two.

    Args:
        piece: (N,) of the points, 0.. without gaps.
        points: (N, 3).
        generator: of the choice.
    """
    count = int(piece.max()) + 1
    merged = np.arange(count)
    sums = np.stack([np.bincount(piece, column, count) for column in points.T], axis=1)
    middles = sums / np.bincount(piece, minlength=count)[:, None]
    for one in generator.permutation(count)[: generator.binomial(count, 0.04)]:
        away = np.linalg.norm(middles - middles[one], axis=1)
        away[merged == merged[one]] = np.inf
        if np.isfinite(away.min()):
            merged[merged == merged[one]] = merged[int(away.argmin())]
    result = merged[piece]
    for one in generator.permutation(count)[: generator.binomial(count, 0.06)]:
        inside = np.flatnonzero(piece == one)
        if len(inside) >= 12:
            cut = points[inside] @ generator.normal(size=3)
            result[inside[cut > np.median(cut)]] = count + one
    return np.asarray(np.unique(result, return_inverse=True)[1].reshape(-1))
