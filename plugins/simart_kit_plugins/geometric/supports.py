"""Edges of a panel behind which no wall is that could hold a hinge, as where two leaves meet."""

from __future__ import annotations

import numpy as np

from .casting import cast
from .scene import Scene
from .views import View

_INSIDE = 0.06  # of the panel's size, how far from its edge what holds it is looked for
_BEHIND = 0.008  # of the diagonal, how far behind its back
_REACH = 0.03  # of the diagonal, how far beyond the edge it may be
_ALONG = np.linspace(0.15, 0.85, 7)
_EDGES = {"left": (0, -1.0), "right": (0, 1.0), "bottom": (1, -1.0), "top": (1, 1.0)}


def unheld(scene: Scene, view: View, moving: tuple[int, ...]) -> frozenset[str]:
    """Edges of a part along which no wall is behind it; none where it has none at all.

    Args:
        scene: of parts.
        view: of the part.
        moving: the other parts that move, which hold nothing.
    """
    found = {edge for edge in _EDGES if not _held(scene, view, edge, moving)}
    return frozenset(found) if len(found) < len(_EDGES) else frozenset()


def _held(scene: Scene, view: View, edge: str, moving: tuple[int, ...]) -> bool:
    axis, sign = _EDGES[edge]
    panel = view.box
    inside = _INSIDE * panel.size[axis]
    starts = np.tile(panel.center, (len(_ALONG), 1))
    starts[:, 1 - axis] = panel.lower[1 - axis] + _ALONG * panel.size[1 - axis]
    starts[:, axis] = (panel.upper if sign > 0 else panel.lower)[axis] - sign * inside
    starts[:, 2] = panel.lower[2] - _BEHIND
    way = np.zeros(3)
    way[axis] = sign
    labels, far = cast(scene, view.axes, starts, way, (view.part, *moving))
    return bool(((labels >= 0) & (far < inside + _REACH)).mean() > 0.5)
