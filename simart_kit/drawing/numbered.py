"""A picture of an object from two sides, each of its parts or pieces in a colour and with its number."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import BoolArray, ByteArray, IntArray
from ..camera import framed
from ..colors import part_color
from ..mesh import Mesh
from ..render import WHITE, face_ids, render

if TYPE_CHECKING:
    from PIL import ImageDraw

SIZE = 620
"""Width and height of one view [pixels]."""
_ELEVATION = np.deg2rad(24.0)
_AZIMUTHS = np.deg2rad([-33.0, 147.0])
_STRENGTH = 0.7  # of the colours: some of the own look stays
_CAPTION = 30  # [pixels]
_ROOM = 5  # [pixels] from a number's middle to the border of its region, at least
_INK = (30, 34, 42)


def numbered_png(mesh: Mesh, rows: Mapping[str, IntArray]) -> bytes:
    """PNG with a row of two views, from the front left and the back right, for each labelling.

    Args:
        mesh: in the canonical frame.
        rows: (F,) number of each face, by the caption of its row. Numbers of regions too small to hold one,
            or hidden, are not drawn.
    """
    from PIL import Image, ImageDraw

    cameras = [framed(mesh.vertices[mesh.faces.ravel()], azimuth, _ELEVATION) for azimuth in _AZIMUTHS]
    seen = [face_ids(mesh, camera, SIZE, SIZE) for camera in cameras]
    looks = [render(mesh, camera, SIZE, SIZE)[..., :3] for camera in cameras]
    sheet = Image.new("RGB", (SIZE * len(cameras), (SIZE + _CAPTION) * len(rows)), WHITE)
    draw = ImageDraw.Draw(sheet)
    for row, (caption, labels) in enumerate(rows.items()):
        top = row * (SIZE + _CAPTION)
        draw.text((12, top + _CAPTION // 2), caption, _INK, font_size=17, anchor="lm")
        for column, (look, faces) in enumerate(zip(looks, seen, strict=True)):
            shown = np.where(faces >= 0, labels[faces], -1)
            view = Image.fromarray(_tinted(look, shown))
            _write_numbers(ImageDraw.Draw(view), shown)
            sheet.paste(view, (column * SIZE, top + _CAPTION))
    buffer = io.BytesIO()
    sheet.save(buffer, "PNG")
    return buffer.getvalue()


def spots(labels: IntArray) -> dict[int, tuple[int, int]]:
    """For each number in an (H, W) picture, column and row of a pixel far from its region's border.

    Numbers whose region is nowhere wide enough are left out, and so is -1.
    """
    depth = np.zeros(labels.shape, dtype=np.int32)
    inside = labels >= 0
    while inside.any():
        depth += inside
        inside = _eroded(inside, labels)
    found = {}
    for number in np.unique(labels[labels >= 0]).tolist():
        row, column = np.unravel_index(np.where(labels == number, depth, 0).argmax(), labels.shape)
        if depth[row, column] > _ROOM:
            found[number] = (int(column), int(row))
    return found


def _eroded(inside: BoolArray, labels: IntArray) -> BoolArray:
    """Pixels whose four neighbours are inside, too, and of the same region."""
    kept = np.zeros_like(inside)
    middle = labels[1:-1, 1:-1]
    kept[1:-1, 1:-1] = inside[1:-1, 1:-1]
    for rows, columns in ((slice(None, -2), slice(1, -1)), (slice(2, None), slice(1, -1))):
        kept[1:-1, 1:-1] &= inside[rows, columns] & (labels[rows, columns] == middle)
        kept[1:-1, 1:-1] &= inside[columns, rows] & (labels[columns, rows] == middle)
    return kept


def _tinted(look: ByteArray, labels: IntArray) -> ByteArray:
    """A picture (H, W, 3) in the colours of the (H, W) numbers, as bright as it was; -1 stays."""
    colors = np.array([part_color(number) for number in range(int(labels.max()) + 1)])
    bright = 0.4 + 0.6 * look.mean(axis=2, keepdims=True) / 255.0
    mixed = (1 - _STRENGTH) * look + _STRENGTH * colors[labels] * bright
    return np.where(labels[..., None] >= 0, np.rint(mixed), look).astype(np.uint8)


def _write_numbers(draw: ImageDraw.ImageDraw, labels: IntArray) -> None:
    for number, spot in spots(labels).items():
        draw.text(
            spot, str(number), _INK, font_size=16, anchor="mm", stroke_width=3, stroke_fill=(255, 255, 255)
        )
