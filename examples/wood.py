"""Paints the texture atlas: two woods, a dark interior and brass, in horizontal bands.

Only sums, products and square roots are used, so that the pixels are the same on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SIZE = 1024
PIXELS_PER_METRE = 600
MARGIN = 3


@dataclass(frozen=True)
class Band:
    """Rows of the atlas that hold one material; the grain runs along the rows.

    Attributes:
        top: first row.
        height: rows.
        dark: sRGB of late wood, 0..255.
        light: sRGB of early wood, 0..255.
        plank: width of a plank [rows].
    """

    top: int
    height: int
    dark: tuple[int, int, int]
    light: tuple[int, int, int]
    plank: int


BANDS = {
    "walnut": Band(0, 300, (72, 42, 26), (150, 98, 62), 100),
    "oak": Band(300, 300, (150, 104, 58), (214, 172, 116), 75),
    "inside": Band(600, 300, (58, 40, 28), (112, 80, 56), 100),
    "brass": Band(900, 124, (0, 0, 0), (0, 0, 0), 124),
}


def paint(seed: int) -> NDArray[np.uint8]:
    """(SIZE, SIZE, 3) sRGB values of the atlas."""
    rng = np.random.default_rng(seed)
    rows = [_brass(b, rng) if name == "brass" else _wood(b, rng) for name, b in BANDS.items()]
    return np.clip(np.floor(np.concatenate(rows) + 0.5), 0, 255).astype(np.uint8)


def _wood(band: Band, rng: np.random.Generator) -> Array:
    """(height, SIZE, 3) planks, each sawn from its own place in a tree."""
    x, y = np.meshgrid(np.arange(SIZE) / SIZE, np.arange(band.height) / 100.0)
    plank = np.arange(band.height) // band.plank
    count = plank[-1] + 1
    heart, phase, tilt, tone = (rng.random(count)[plank][:, None] for _ in range(4))
    across = (np.arange(band.height)[:, None] % band.plank) / band.plank - heart
    sway = _noise(rng, 4, 5, y.shape) * 0.5 + _noise(rng, 14, 9, y.shape) * 0.12
    # Year rings are cones about the heart of the tree; a plank cuts them in long arches.
    depth = (across * across * 6.0 + (tilt - 0.5) * x * 2.4 + sway * 0.9 + phase * 7.0) * 4.0
    ring = depth - np.floor(depth)
    late = ring * ring * ring
    fibre = _noise(rng, band.height // 2, 14, y.shape)
    streak = _noise(rng, band.height // 7, 5, y.shape)
    pores = np.clip(_noise(rng, band.height, 50, y.shape) - 0.72, 0.0, 1.0) * (0.4 + late)
    value = (
        0.66 - 0.34 * late + 0.26 * (fibre - 0.5) + 0.34 * (streak - 0.5) + 0.36 * (tone - 0.5) - 1.5 * pores
    )
    edge = np.minimum(np.arange(band.height) % band.plank, 2)[:, None] / 2.0
    value = np.clip(value, 0.0, 1.0) * (0.72 + 0.28 * edge)
    dark, light = np.array(band.dark), np.array(band.light)
    return np.asarray(dark + (light - dark) * value[..., None])


def _brass(band: Band, rng: np.random.Generator) -> Array:
    """(height, SIZE, 3) what polished brass mirrors, from the sky (top row) to the floor."""
    heights = [0.0, 0.18, 0.34, 0.46, 0.54, 0.72, 0.88, 1.0]
    shades = [196, 242, 228, 176, 96, 128, 108, 74]
    shade = np.interp(np.arange(band.height) / (band.height - 1), heights, shades)[:, None]
    brushed = (_noise(rng, 8, 256, (band.height, SIZE)) - 0.5) * 10.0
    tint = np.array([1.0, 0.79, 0.42])
    return np.asarray((shade + brushed)[..., None] * tint)


def _noise(rng: np.random.Generator, rows: int, columns: int, shape: tuple[int, ...]) -> Array:
    """Smooth values 0..1 from a lattice of rows x columns."""
    lattice = rng.random((rows + 1, columns + 1))
    down, down_part = _steps(rows, shape[0])
    right, right_part = _steps(columns, shape[1])
    top = lattice[down][:, right] + (lattice[down][:, right + 1] - lattice[down][:, right]) * right_part
    low = lattice[down + 1]
    bottom = low[:, right] + (low[:, right + 1] - low[:, right]) * right_part
    return np.asarray(top + (bottom - top) * down_part[:, None])


def _steps(cells: int, length: int) -> tuple[NDArray[np.int64], Array]:
    """Cell of each pixel, and how far it is in it, eased at both ends."""
    place = np.arange(length) * cells / length
    cell = np.floor(place).astype(np.int64)
    part = place - cell
    return cell, part * part * (3.0 - 2.0 * part)
