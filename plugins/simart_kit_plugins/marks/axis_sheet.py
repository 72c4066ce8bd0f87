"""The picture of a link's candidates: it in red, then lettered lines, a view for each direction of lines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import ByteArray, FloatArray
from simart_kit.camera import Camera
from simart_kit.colors import Color

from .badges import PAPER, Badge, draw_badges
from .lines import Line, Shape, groups
from .sheets import grid
from .views import Seen

if TYPE_CHECKING:
    from PIL import ImageDraw

PANEL = 520
"""Width and height of a view [pixels]."""
_PALE = (0.88, 0.89, 0.91, 0.8)
_LINK = (0.87, 0.25, 0.25, 0.75)
_AROUND = 2.5  # diagonals of a small link that its close-up shows
_BEYOND = 0.09  # of the span that a line is longer than the link, at each end
_ARROW = 0.25  # of the span: length of an arrow
_FINE = 3
_OFF_HEAD = 22  # pixels from the head of an arrow to the middle of its letter
_GLOW = np.array([222.0, 64.0, 64.0])
_CROWDED = 34  # pixels: letters of lines that end nearer than this stand off, with a line to their own
_INKS: tuple[Color, ...] = (
    (16, 84, 200),
    (10, 120, 60),
    (120, 40, 170),
    (150, 85, 0),
    (0, 125, 140),
    (175, 20, 110),
)


def axis_sheet(seen: Seen, members: Sequence[int], shape: Shape, lines: Sequence[Line]) -> ByteArray:
    """(H, W, 3) the link alone in red, and one view for each group of parallel lines or of arrows.

    Args:
        seen: the object.
        members: pieces of the link.
        shape: of the link.
        lines: candidates.
    """
    side = seen.best_side(members)
    drawn = [_ends(line, shape) for line in lines]
    ends = np.concatenate(drawn)
    far = seen.camera(side, ends)
    whole = _ground(seen, members, far)
    panels = [(f"the link in red, from the {side}", whole)]
    close = _span(shape) < shape.diagonal
    camera = seen.close_camera(side, np.concatenate([ends, shape.points])) if close else far
    ground = _ground(seen, members, camera) if close else whole
    for group in groups(lines).values():
        letters = ", ".join(lines[index].letter for index in group)
        what = "arrows" if lines[group[0]].source == "slide" else "lines"
        ways = [(lines[index], camera.project(drawn[index], PANEL, PANEL)) for index in group]
        panels.append((f"{what} {letters}{', close up' * close}", _drawn(ground, ways)))
    return grid(panels, 2 if len(panels) in (2, 4) else 3)


def _ground(seen: Seen, members: Sequence[int], camera: Camera) -> ByteArray:
    """The object, pale, with a link in red, also where others hide it."""
    mine = seen.faces(members)[:, None]
    ground = seen.picture(camera, PANEL, np.where(mine, np.array(_LINK), np.array(_PALE))).copy()
    hidden = seen.outline(members, camera, PANEL) & ~np.isin(seen.pieces_in(camera, PANEL), members)
    ground[hidden] = (0.55 * ground[hidden] + 0.45 * _GLOW).astype(np.uint8)
    return ground


def _span(shape: Shape) -> float:
    """What lines are sized by [m]: the object's diagonal; of a small link, a few times its own."""
    own = float(np.linalg.norm(np.ptp(shape.points, axis=0)))
    return min(shape.diagonal, _AROUND * own)


def _drawn(ground: ByteArray, ways: Sequence[tuple[Line, FloatArray]]) -> ByteArray:
    """A view with lines, given with the (2, 2) pixels where each begins and ends."""
    from PIL import Image, ImageDraw

    layer = Image.new("RGBA", (PANEL * _FINE, PANEL * _FINE))
    draw = ImageDraw.Draw(layer)
    ends = np.concatenate([way for _, way in ways])
    badges = []
    for index, (line, way) in enumerate(ways):
        ink = _INKS[index % len(_INKS)]
        arrow = line.source == "slide"
        _stroke(draw, _FINE * way, ink, arrow)
        end = way[1] if arrow or index % 2 == 0 else way[0]
        crowded = int((np.linalg.norm(ends - end, axis=1) < _CROWDED).sum()) > 1
        spot = _beyond(way) if arrow else end
        badges.append(Badge(line.letter, (float(spot[0]), float(spot[1])), ink, arrow or not crowded))
    picture = Image.fromarray(ground).convert("RGBA")
    picture = Image.alpha_composite(picture, layer.resize(picture.size, Image.Resampling.BOX)).convert("RGB")
    draw_badges(ImageDraw.Draw(picture), badges, picture.size)
    return np.array(picture)


def _ends(line: Line, shape: Shape) -> FloatArray:
    """(2, 3) where a line or an arrow begins and ends [m]."""
    along = (shape.points - line.origin) @ line.axis
    if line.source == "slide":
        start = float(along.max())
        return np.asarray(line.origin + np.outer([start, start + _ARROW * _span(shape)], line.axis))
    beyond = _BEYOND * _span(shape)
    return np.asarray(line.origin + np.outer([along.min() - beyond, along.max() + beyond], line.axis))


def _beyond(way: FloatArray) -> FloatArray:
    """(2,) pixel beyond the head of an arrow."""
    length = max(float(np.linalg.norm(way[1] - way[0])), 1e-9)
    return np.asarray(way[1] + _OFF_HEAD * (way[1] - way[0]) / length)


def _stroke(draw: ImageDraw.ImageDraw, line: FloatArray, ink: Color, head: bool) -> None:
    """A line with a light casing; an arrow has a head at its end."""
    for width, fill in ((7.0, PAPER), (3.5, ink)):
        draw.line([tuple(point) for point in line], fill=fill, width=round(width * _FINE))
        if head:
            draw.polygon([tuple(point) for point in _head(line, (9 + width) * _FINE)], fill=fill)


def _head(line: FloatArray, length: float) -> FloatArray:
    """(3, 2) triangle at the end of a line."""
    forward = (line[1] - line[0]) / max(float(np.linalg.norm(line[1] - line[0])), 1e-9)
    side = np.array([-forward[1], forward[0]])
    front, back = line[1] + 0.45 * length * forward, line[1] - 0.55 * length * forward
    return np.stack([front, back + 0.5 * length * side, back - 0.5 * length * side])
