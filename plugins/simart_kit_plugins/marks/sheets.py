"""The pictures of the first question: the object as it is, its pieces numbered, and each piece in red."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import BoolArray, ByteArray, FloatArray, IntArray
from simart_kit.colors import Color

from .badges import INK, PAPER, Badge, draw_badges, font, inner_spot
from .hues import piece_colors
from .views import Seen

PANEL = 620
"""Width and height of a view [pixels]."""
TILE = 250
"""Width and height of a view of one piece [pixels]."""
PER_SHEET = 20
_COLUMNS = 5
_CAPTION = 26
_TINT = 0.78
_RED = np.array([222.0, 28.0, 36.0])
_PALE = (0.87, 0.88, 0.90, 0.85)
_THROUGH = 0.5  # strength of the red where other pieces hide it
_SMALL = 0.012  # share of a tile below which a piece gets a ring around it
_LEAST = 12  # pixels that must be seen of a piece for a numeral
_SLIVER = 0.1  # of what its best view shows of a piece: a view with less leaves its numeral out
_PLENTY = 1500  # pixels that are no sliver


def plain_sheet(seen: Seen) -> ByteArray:
    """(H, W, 3) the object as it is, from the front left and from the back right."""
    return grid([(side, seen.picture(seen.cameras[side], PANEL)) for side in ("front left", "back right")], 2)


def marks_sheet(seen: Seen) -> ByteArray:
    """(H, W, 3) the pieces from four sides: a colour each, and a numeral where they are seen."""
    shown = {side: seen.pieces_in(camera, PANEL) for side, camera in seen.cameras.items()}
    colors = piece_colors(tuple(shown.values()), seen.count)
    paint = np.array([[*np.array(color) / 255.0, _TINT] for color in colors])[seen.piece]
    counts = {side: np.bincount(p[p >= 0], minlength=seen.count) for side, p in shown.items()}
    enough = np.clip(_SLIVER * np.max(list(counts.values()), axis=0), _LEAST, _PLENTY)
    panels = []
    for side, pieces in shown.items():
        picture = _bordered(seen.picture(seen.cameras[side], PANEL, paint), pieces)
        told = np.flatnonzero(counts[side] >= enough)
        told = told[np.argsort(counts[side][told], kind="stable")]  # small ones have the fewest places
        panels.append((side, _numbered(picture, pieces, told.tolist(), colors)))
    hidden = np.max(list(counts.values()), axis=0) < _LEAST
    return np.concatenate([grid(panels, 2), _legend(colors, hidden, 2 * PANEL)])


def red_sheets(seen: Seen, groups: Sequence[tuple[str, tuple[int, ...]]]) -> tuple[ByteArray, ...]:
    """(H, W, 3) sheets of small views, each with one group of pieces in red, also where others hide it.

    Args:
        seen: the object.
        groups: what stands in the corner of each view, and the pieces in red.
    """
    pale = np.tile(np.array(_PALE), (len(seen.mesh.faces), 1))
    ground = {side: seen.picture(camera, TILE, pale) for side, camera in seen.cameras.items()}
    pieces = {side: seen.pieces_in(camera, TILE) for side, camera in seen.cameras.items()}
    tiles = []
    for text, members in groups:
        side = seen.best_side(members)
        outline = seen.outline(members, seen.cameras[side], TILE)
        direct = np.isin(pieces[side], members)
        tiles.append((f"from the {side}", _red(ground[side], outline, direct, text)))
    starts = range(0, len(tiles), PER_SHEET)
    return tuple(grid(tiles[start : start + PER_SHEET], _COLUMNS, small=True) for start in starts)


def grid(panels: Sequence[tuple[str, ByteArray]], columns: int, *, small: bool = False) -> ByteArray:
    """(H, W, 3) panels of one size in rows, each with its caption below."""
    from PIL import Image, ImageDraw

    height, width = panels[0][1].shape[:2]
    columns = min(columns, len(panels))
    rows = -(-len(panels) // columns)
    sheet = Image.new("RGB", (columns * width, rows * (height + _CAPTION)), (255, 255, 255))
    draw = ImageDraw.Draw(sheet)
    for index, (caption, panel) in enumerate(panels):
        row, column = divmod(index, columns)
        left, top = column * width, row * (height + _CAPTION)
        sheet.paste(Image.fromarray(panel), (left, top))
        middle = (left + width // 2, top + height + _CAPTION // 2)
        draw.text(middle, caption, INK, font(14 if small else 18), anchor="mm")
        draw.rectangle((left, top, left + width - 1, top + height + _CAPTION - 1), outline=(205, 208, 214))
    return np.array(sheet)


def _numbered(
    picture: ByteArray, pieces: IntArray, told: Sequence[int], colors: Sequence[Color]
) -> ByteArray:
    """A picture with the numerals of some pieces that are seen in it."""
    from PIL import Image, ImageDraw

    badges = []
    for piece in told:
        spot, depth = inner_spot(pieces == piece)
        badges.append(Badge(str(piece), spot, _dark(colors[piece]), on_spot=depth > 9))
    image = Image.fromarray(picture)
    draw_badges(ImageDraw.Draw(image), badges, image.size)
    return np.array(image)


def _legend(colors: Sequence[Color], hidden: BoolArray, width: int) -> ByteArray:
    """(H, width, 3) rows of the pieces' colours; (N,) those that are hidden from all sides stand last."""
    from PIL import Image, ImageDraw

    entries: list[tuple[str, Color | None]] = [
        (str(piece), colors[piece]) for piece in np.flatnonzero(~hidden).tolist()
    ]
    if hidden.any():
        inside = ", ".join(map(str, np.flatnonzero(hidden).tolist()))
        entries.append((f"hidden from all four sides: {inside}", None))
    places, x, row = [], 14.0, 0
    for text, color in entries:
        needed = font(17).getlength(text) + (30 if color else 0)
        if x > 14 and x + needed > width - 14:
            x, row = 14.0, row + 1
        places.append((x, row * _CAPTION + _CAPTION / 2 + 4))
        x += needed + 20
    sheet = Image.new("RGB", (width, (row + 1) * _CAPTION + 8), PAPER)
    draw = ImageDraw.Draw(sheet)
    for (text, color), (left, middle) in zip(entries, places, strict=True):
        if color:
            draw.rounded_rectangle((left, middle - 9, left + 22, middle + 9), 3, color, INK)
        draw.text((left + (28 if color else 0), middle), text, INK, font(17), anchor="lm")
    return np.array(sheet)


def _bordered(picture: ByteArray, pieces: IntArray) -> ByteArray:
    """A picture with dark lines where one piece ends and another begins."""
    edge = np.zeros(pieces.shape, dtype=np.bool_)
    edge[:, 1:] |= pieces[:, 1:] != pieces[:, :-1]
    edge[1:] |= pieces[1:] != pieces[:-1]
    dark = picture.copy()
    dark[edge] = (0.35 * dark[edge]).astype(np.uint8)
    return dark


def _red(ground: ByteArray, outline: BoolArray, direct: BoolArray, text: str) -> ByteArray:
    """A pale view with what is seen of a piece in red, and the rest of it shining through."""
    from PIL import Image, ImageDraw

    if (outline | direct).sum() < _SMALL * outline.size:  # a thin wire would not be noticed
        outline, direct = _thicker(outline), _thicker(direct)
    strength: FloatArray = np.where(direct, 0.85, np.where(outline, _THROUGH, 0.0))[..., None]
    light = ground.astype(np.float64)
    mixed = light * (1 - strength) + _RED * strength * (0.45 + 0.55 * light / 255.0)
    image = Image.fromarray(np.rint(mixed).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    where = np.argwhere(outline | direct)
    if len(where) and len(where) < _SMALL * outline.size:
        (top, left), (bottom, right) = where.min(axis=0), where.max(axis=0)
        reach = max(bottom - top, right - left) / 2 + 12
        x, y = (left + right) / 2, (top + bottom) / 2
        draw.ellipse((x - reach, y - reach, x + reach, y + reach), outline=(222, 28, 36), width=2)
    half = font(20).getlength(text) / 2
    draw_badges(draw, [Badge(text, (half + 12, 18), INK)], image.size)
    return np.array(image)


def _thicker(mask: BoolArray) -> BoolArray:
    """A (H, W) mask with the pixels around it."""
    padded = np.pad(mask, 1)
    rows = padded[:-2] | padded[1:-1] | padded[2:]
    return np.asarray(rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:])


def _dark(color: Color) -> Color:
    r, g, b = (int(0.7 * value) for value in color)
    return (r, g, b)
