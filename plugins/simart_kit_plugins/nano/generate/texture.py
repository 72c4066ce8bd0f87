"""One texture for an object: a tile for each look, with the grain of its material."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import ByteArray, FloatArray

from ...shapes.dice import Dice
from .objects import Look

TILE = 64
# Corners of faces stay so many pixels off the border of their tile: filters would mix in its neighbour.
_BORDER = 2
# How much the grain darkens, and how much longer than wide it is; materials not named are speckled a little.
_GRAIN = {
    "wood": (0.22, 16),
    "mdf": (0.05, 1),
    "fabric": (0.18, 1),
    "stone": (0.3, 2),
    "aluminium": (0.08, 32),
}


def atlas(looks: Sequence[Look], dice: Dice) -> ByteArray:
    """(H, W, 3) sRGB with the tiles of the looks, row by row, as many a row as there are rows."""
    across = _across(len(looks))
    picture = np.zeros((across * TILE, across * TILE, 3), dtype=np.uint8)
    for place, look in enumerate(looks):
        row, column = divmod(place, across)
        tile = (slice(row * TILE, (row + 1) * TILE), slice(column * TILE, (column + 1) * TILE))
        picture[tile] = _tile(look, dice)
    return picture


def coordinates(triangles: FloatArray, place: int, count: int) -> FloatArray:
    """(F, 3, 2) texture coordinates of the corners of (F, 3, 3) triangles; origin at the bottom left.

    Seen along the axis that a face looks along most. The object's longest side is the tile's, so that grain
    has one scale on all of it.

    Args:
        triangles: in the frame of the object, scaled into the cube 0..1.
        place: of the look's tile.
        count: of looks.
    """
    normals = np.abs(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]))
    facing = normals.argmax(axis=1)
    seen = np.array([[2, 1], [2, 0], [0, 1]])[facing]
    flat = np.take_along_axis(triangles, np.repeat(seen[:, None], 3, axis=1), axis=2)
    across = _across(count)
    row, column = divmod(place, across)
    inside = (_BORDER + flat * (TILE - 2 * _BORDER)) / TILE
    spot = inside + [column, across - 1 - row]
    return np.asarray(spot / across)


def _across(count: int) -> int:
    return int(np.ceil(np.sqrt(max(count, 1))))


def _tile(look: Look, dice: Dice) -> ByteArray:
    """(TILE, TILE, 3) a colour with the grain of its material, along the tile's height."""
    depth, stretch = _GRAIN.get(look.material, (0.02, 1))
    noise = dice.units(max(TILE // stretch, 1), TILE).repeat(stretch, axis=0)[:TILE]
    smooth = (noise + np.roll(noise, 1, axis=0) + np.roll(noise, 1, axis=1)) / 3
    shade = 1 - depth * smooth[..., None]
    return np.clip(np.round(np.array(look.color) * shade), 0, 255).astype(np.uint8)
