"""Distance of two axis lines, with the flaw that published evaluations of articulation share."""

from __future__ import annotations

import numpy as np

from ...arrays import FloatArray

_PARALLEL = 1e-6
_NO_LENGTH = 1e-12
_X, _Y = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])


def published_line_distance(
    true_origin: FloatArray, true_axis: FloatArray, origin: FloatArray, axis: FloatArray
) -> float:
    """|p . (a2 x a1)| / |a2 x a1|, p from one origin to the other: the distance of two skew lines.

    Of parallel lines the cross product vanishes. It is then replaced by an arbitrary perpendicular: a2 x X,
    or a1 x Y where a2 is X. That measures one component of the offset and not the distance: a hinge on the
    other side can have 0. Where that product vanishes, too (a2 is -X), it is the distance of the origins.

    Source: Articulate-Anything (`utils/metric.py`) and URDF-Anything (`scripts/eval_metric.py`); the
    perpendicular is that of the latter.

    Args:
        true_origin: (3,) a point on the true axis [units].
        true_axis: (3,) a1, unit.
        origin: (3,) a point on the predicted axis [units].
        axis: (3,) a2, unit.

    Returns:
        The distance in units.
    """
    offset = true_origin - origin
    across = np.cross(axis, true_axis)
    if np.abs(across).max() <= _PARALLEL:
        along_x = np.abs(axis - _X).max() <= _PARALLEL
        across = np.cross(true_axis, _Y) if along_x else np.cross(axis, _X)
    length = float(np.linalg.norm(across))
    if length < _NO_LENGTH:
        return float(np.linalg.norm(offset))
    return abs(float(offset @ across)) / length
