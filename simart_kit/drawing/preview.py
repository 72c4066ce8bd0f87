"""preview.png: the object in three poses, from closed to open, with its joints drawn and named."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..asset import Asset
from ..camera import Camera, framed
from ..colors import Color
from ..kinematics import opened, rest_to_posed
from ..mesh import Mesh
from ..posing import PosableMesh
from ..rays import Rays
from ..render import render, rest_caster
from .joint_marks import Stroke, joint_strokes
from .legend import Entry, legend, part_entries, summary
from .pixel_rays import Frame, PixelRays

if TYPE_CHECKING:
    from PIL import Image, ImageDraw, ImageFont

PANEL = (500, 470)
"""Width and height of one view [pixels]."""
BACKGROUND: Color = (240, 242, 245)
INK: Color = (40, 44, 52)
_ELEVATION = np.deg2rad(24.0)
_AZIMUTHS = np.deg2rad([-33.0, 33.0, 147.0, -147.0])
_TINT = 0.7
_FADE = 38  # [pixels]; `framed` keeps the object further inside
_MARGIN = 20  # [pixels]
_LINE = 26  # [pixels]


def preview_png(asset: Asset) -> bytes:
    """PNG of an asset in three poses; of a static one, two views that say so.

    The words in the picture are also its PNG `Description`.
    """
    panels = _moving_panels(asset) if legend(asset) else _static_panels(asset)
    return _sheet(panels, summary(asset), legend(asset))


def poses(asset: Asset) -> dict[str, float]:
    """What to call each pose, and which share of its longer way every joint has gone; the first is at rest.

    What rests between its ends and goes farther back than on stands open in its file.
    """
    ajar = any(joint.limits and 0 < joint.limits.upper < -joint.limits.lower for joint in asset.joints)
    names = ("as modelled", "half way", "all the way") if ajar else ("closed", "half open", "open")
    return dict(zip(names, (0.0, 0.5, 1.0), strict=True))


def _moving_panels(asset: Asset) -> dict[str, Image.Image]:
    posable, shares = PosableMesh.of(asset), poses(asset)
    first, _, last = shares
    meshes = {name: posable.posed(opened(asset, share)) for name, share in shares.items()}
    marks = {name: _marks(posable, share) for name, share in shares.items() if share}
    shown = [m.vertices for m in meshes.values()]
    shown += [stroke.points for strokes in marks.values() for stroke, _ in strokes]
    casters = {name: _caster(posable, meshes[name]) for name in (first, last)}
    camera = _camera(casters[first], casters[last], np.concatenate(shown))
    ground = min(float(m.bounds[0, 2]) for m in meshes.values())
    paint = _paint(asset)

    def seen(name: str) -> Image.Image:
        own = paint if name in marks else None
        picture = _view(meshes[name], camera, ground, own, casters.get(name))
        return _drawn_over(picture, marks[name], camera) if name in marks else picture

    return _side_by_side(seen, shares)


def _static_panels(asset: Asset) -> dict[str, Image.Image]:
    mesh, caster = PosableMesh.of(asset).mesh, rest_caster(asset)
    azimuths = {"front left": _AZIMUTHS[0], "back right": _AZIMUTHS[2]}

    def seen(name: str) -> Image.Image:
        camera = framed(mesh.vertices, azimuths[name], _ELEVATION, aspect=PANEL[0] / PANEL[1])
        return _view(mesh, camera, float(mesh.bounds[0, 2]), None, caster)

    return _side_by_side(seen, azimuths)


def _caster(posable: PosableMesh, mesh: Mesh) -> Rays:
    """Of a posed mesh; where nothing is moved from rest, the one that other pictures of the asset use too."""
    if np.array_equal(mesh.vertices, posable.mesh.vertices):
        return rest_caster(posable.asset)
    return Rays(mesh.vertices, mesh.faces)


def _side_by_side(seen: Callable[[str], Image.Image], names: Iterable[str]) -> dict[str, Image.Image]:
    """The picture of each name, drawn at once: casting rays and adding arrays, threads seldom wait."""
    with ThreadPoolExecutor() as pool:
        return dict(zip(names, pool.map(seen, names), strict=True))


def _view(
    mesh: Mesh, camera: Camera, ground: float, paint: FloatArray | None, caster: Rays | None
) -> Image.Image:
    """One picture; towards its border the shadow on the ground fades, so that pictures join."""
    from PIL import Image

    pixels = render(mesh, camera, *PANEL, paint=paint, ground=ground, background=BACKGROUND, caster=caster)
    inside = [np.minimum(np.arange(n) + 0.5, n - np.arange(n) - 0.5) / _FADE for n in PANEL]
    ramp = np.clip(np.minimum(inside[0][None, :], inside[1][:, None]), 0, 1)[..., None]
    plain = np.array([*BACKGROUND, 255])
    return Image.fromarray(np.rint(plain + (pixels - plain) * ramp**2 * (3 - 2 * ramp)).astype(np.uint8))


def _camera(closed: Rays, opened_caster: Rays, points: FloatArray) -> Camera:
    """The first of the views that shows about as much of what opening reveals as any."""
    cameras = [framed(points, a, _ELEVATION, aspect=PANEL[0] / PANEL[1]) for a in _AZIMUTHS]
    revealed = [_revealed(closed, opened_caster, camera) for camera in cameras]
    return next(c for c, r in zip(cameras, revealed, strict=True) if 1.15 * r >= max(revealed))


def _revealed(closed: Rays, opened_caster: Rays, camera: Camera) -> int:
    """Pixels of the open object that show faces which are hidden while it is closed."""
    frame = Frame(camera, PANEL[0] // 4, PANEL[1] // 4)
    rays = PixelRays.single(frame, range(frame.height))
    before, after = (c.hits(rays.origins, rays.directions).face for c in (closed, opened_caster))
    return int((~np.isin(after, before)).sum())


def _paint(asset: Asset) -> FloatArray:
    """(F, 4) colour and strength: moving parts in the colour of their joint, the body as it is."""
    entries = part_entries(asset)
    rows = np.zeros((len(asset.parts), 4))
    for index, part in enumerate(asset.parts):
        if part.name in entries:
            rows[index] = [*np.array(entries[part.name].color) / 255.0, _TINT]
    return rows[asset.face_part]


def _marks(posable: PosableMesh, fraction: float) -> list[tuple[Stroke, Color]]:
    """The strokes of all joints, where the joints' parents are in this pose."""
    asset = posable.asset
    posed_T_rest = rest_to_posed(asset, opened(asset, fraction))
    marks = []
    for entry in legend(asset):
        joint = entry.joint
        points = posable.mesh.vertices[posable.vertex_part == asset.part_index(joint.child)]
        for stroke in joint_strokes(joint, points, asset.mesh.diagonal):
            marks.append((stroke.moved(posed_T_rest[joint.parent]), entry.color))
    return marks


def _drawn_over(picture: Image.Image, strokes: list[tuple[Stroke, Color]], camera: Camera) -> Image.Image:
    """The picture with strokes on top, drawn at three times its size and averaged."""
    from PIL import Image, ImageDraw

    fine = 3
    layer = Image.new("RGBA", (PANEL[0] * fine, PANEL[1] * fine))
    draw = ImageDraw.Draw(layer)
    for stroke, color in strokes:
        _draw_stroke(draw, stroke, camera.project(stroke.points, *layer.size), color, fine)
    return Image.alpha_composite(picture, layer.resize(PANEL, Image.Resampling.BOX))


def _draw_stroke(
    draw: ImageDraw.ImageDraw, stroke: Stroke, line: FloatArray, color: Color, fine: int
) -> None:
    """A line with a light casing, so that it shows on parts of its own colour."""
    dark = tuple(int(0.6 * c) for c in color)
    heads = [way for way, wanted in ((line, stroke.head), (line[::-1], stroke.tail)) if wanted]
    for width, fill in ((6.5, (255, 255, 255)), (3.0, dark)):
        draw.line([tuple(p) for p in line], fill=fill, width=round(width * fine), joint="curve")
        for head in heads:
            draw.polygon([tuple(p) for p in _arrow_head(head, (10 + width) * fine)], fill=fill)


def _arrow_head(line: FloatArray, length: float) -> FloatArray:
    """(3, 2) triangle at the end of a line."""
    tip = line[-1]
    away = np.linalg.norm(line - tip, axis=1)
    before = line[np.flatnonzero(away >= min(length, away.max()))[-1]]
    forward = (tip - before) / max(float(np.linalg.norm(tip - before)), 1e-9)
    side = np.array([-forward[1], forward[0]])
    front, back = tip + 0.45 * length * forward, tip - 0.55 * length * forward
    return np.stack([front, back + 0.5 * length * side, back - 0.5 * length * side])


def _sheet(panels: dict[str, Image.Image], title: str, entries: tuple[Entry, ...]) -> bytes:
    """Panels side by side, captions below, then the title and the legend in as many rows as they need."""
    from PIL import Image, ImageDraw

    width = PANEL[0] * len(panels)
    places, rows = _flow([title, *(e.text for e in entries)], width)
    top = PANEL[1] + _LINE + 12
    sheet = Image.new("RGB", (width, top + rows * _LINE + 12), BACKGROUND)
    draw = ImageDraw.Draw(sheet)
    for index, (caption, panel) in enumerate(panels.items()):
        sheet.paste(panel.convert("RGB"), (index * PANEL[0], 0))
        middle = (index * PANEL[0] + PANEL[0] // 2, PANEL[1] + _LINE // 2)
        draw.text(middle, caption, INK, _font(19), anchor="mm")
    draw.line([(_MARGIN, top - 4), (width - _MARGIN, top - 4)], (214, 217, 222))
    for text, color, (x, row) in zip(
        [title, *(e.text for e in entries)], [None, *(e.color for e in entries)], places, strict=True
    ):
        y = top + row * _LINE + _LINE // 2 + 4
        if color:
            draw.rounded_rectangle((x, y - 7, x + 14, y + 7), 3, color)
        draw.text((x + (22 if color else 0), y), text, INK, _font(16), anchor="lm")
    return _encoded(sheet, "; ".join([title, *panels, *(e.text for e in entries)]))


def _flow(texts: list[str], width: int) -> tuple[list[tuple[int, int]], int]:
    """Place texts one after the other in rows: (x, row) of each, and the number of rows."""
    x, row, places = _MARGIN, 0, []
    for text in texts:
        needed = int(_font(16).getlength(text)) + 22
        if x > _MARGIN and x + needed > width - _MARGIN:
            x, row = _MARGIN, row + 1
        places.append((x, row))
        x += needed + 24
    return places, row + 1


def _font(size: int) -> ImageFont.FreeTypeFont:
    from PIL import ImageFont

    font = ImageFont.load_default(size)
    assert isinstance(font, ImageFont.FreeTypeFont)
    return font


def _encoded(sheet: Image.Image, description: str) -> bytes:
    from PIL.PngImagePlugin import PngInfo

    words, buffer = PngInfo(), io.BytesIO()
    words.add_text("Description", description)
    sheet.save(buffer, "PNG", pnginfo=words)
    return buffer.getvalue()
