"""Lays polygons on the texture atlas: along the grain on wood, by reflection on metal."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from solids import Polygon, Solid
from wood import BANDS, MARGIN, PIXELS_PER_METRE, SIZE


def texture_coordinates(solid: Solid, rng: np.random.Generator) -> list[NDArray[np.float64]]:
    """(N, 2) coordinates of each polygon, origin top left: planks are cut at random places of their band."""
    groups: dict[tuple[str, int, int, int], list[int]] = {}
    for i, polygon in enumerate(solid):
        facing = int(np.abs(polygon.normals.mean(axis=0)).argmax())
        groups.setdefault((polygon.wood, facing, polygon.grain, polygon.plank), []).append(i)
    result: dict[int, NDArray[np.float64]] = {}
    for (wood, facing, grain, _), members in groups.items():
        flats = [_flattened(solid[i], facing, grain) for i in members]
        low, high = np.concatenate(flats).min(axis=0), np.concatenate(flats).max(axis=0)
        band = BANDS[wood]
        room = np.array([SIZE, band.height]) - 2 * MARGIN - (high - low)
        assert (room >= 0).all(), f"a face of {high - low} pixels does not fit in band {wood}"
        start = np.array([MARGIN, band.top + MARGIN]) + np.floor(rng.random(2) * room)
        for i, flat in zip(members, flats, strict=True):
            result[i] = (_mirrored(solid[i]) if wood == "brass" else start + flat - low) / SIZE
    return [result[i] for i in range(len(solid))]


def _flattened(polygon: Polygon, facing: int, grain: int) -> NDArray[np.float64]:
    """(N, 2) corners in the plane that the polygon faces, along and across the grain [pixels]."""
    along = grain if grain != facing else (facing + 1) % 3
    across = 3 - facing - along
    return polygon.corners[:, [along, across]] * PIXELS_PER_METRE


def _mirrored(polygon: Polygon) -> NDArray[np.float64]:
    """(N, 2) pixels that metal shows: brightest where its normal points up, to the front and to the left."""
    band = BANDS["brass"]
    down = (1.0 - (polygon.normals * (-0.36, 0.64, 0.68)).sum(axis=1)) / 2
    rows = band.top + MARGIN + down * (band.height - 2 * MARGIN)
    columns = SIZE / 2 + polygon.corners[:, 0] * PIXELS_PER_METRE
    return np.stack([columns, rows], axis=1)
