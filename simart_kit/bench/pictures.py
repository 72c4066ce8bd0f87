"""Pictures of an object for the page: as it looks, the true parts and the predicted ones, closed and open.

All pictures of an object have one camera, so that they can be laid side by side.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..arrays import ByteArray, FloatArray
from ..camera import Camera, framed
from ..colors import Color
from ..drawing.pixel_rays import Frame, PixelRays
from ..mesh import Mesh, z_up_from
from ..normals import with_normals
from ..rays import Rays
from ..render import render
from .articulation import Articulation
from .cases import Prediction, Truth
from .figure import Figure
from .metrics.parts import iou_matrix, match
from .overlay import overlay

PICTURES = ("input", "truth", "prediction", "truth_open", "prediction_open")
"""What is shown, in the order of the page."""
SIZE = 200
"""Width and height of a picture [pixels]."""
BACKGROUND: Color = (244, 245, 247)
_ELEVATION = np.deg2rad(26.0)
_AZIMUTHS = np.deg2rad([-33.0, 33.0, 147.0, -147.0])
_BETTER = 1.15  # a later view has to show this much more than an earlier one
_SKETCH = 64  # [pixels]
_COMPARED, _COMPARED_LEAST = 4000, 64  # points of a surface and of a part, to tell which parts are alike
_FAR = 30.0  # diagonals of the true object; what is further from it is in no picture


def write_pictures(
    folder: Path, truth: Truth, prediction: Prediction | None, look: Mesh | None
) -> dict[str, str]:
    """Write PNG pictures of an object.

    Moving parts have colours, a predicted one that of the true part that it is most like; the body is grey,
    faces of no part are pale. Without "open" the object is at rest, as it was given; "open" is with all
    joints at the end of their way. Points of a cloud are drawn as small octahedra. Parts that a prediction
    sends far away are outside the picture.

    Args:
        folder: exists; files of the same name are replaced.
        truth: framed closed and open; turned so that its up axis points up.
        prediction: in the frame of the truth; None where there is none.
        look: the object in the canonical frame with its textures, laid on the true object's bounding box;
            None to show the true surface in grey.

    Returns:
        File names by what they show, keys of `PICTURES`; without predictions where there is none.
    """
    z_up = np.eye(4)
    z_up[:3, :3] = z_up_from(truth.up)
    true = truth.articulation.transformed(z_up).rigid()
    figures = {"truth": Figure.of(true)}
    if prediction is not None:
        predicted = prediction.articulation.transformed(z_up).rigid()
        figures["prediction"] = Figure.of(predicted, _numbers(true, predicted), figures["truth"])
    view = _View(figures["truth"])
    files = {"input": _write(folder, "input", view.plain(look))}
    for name, figure in figures.items():
        closed = view.of(figure, figure.closed)
        opened = view.of(figure, figure.opened) if figure.travels else closed
        files[name] = _write(folder, name, closed)
        files[f"{name}_open"] = _write(folder, f"{name}_open", opened)
    return {key: files[key] for key in PICTURES if key in files}


def _numbers(true: Articulation, predicted: Articulation) -> dict[int, int]:
    """Number of the colour of each predicted link that moves: that of its true part, else one of its own."""
    laid = overlay(true, predicted, points=_COMPARED, least=_COMPARED_LEAST)
    shape = len(true.links), len(predicted.links)
    iou = iou_matrix(laid.true_labels, laid.predicted_labels, laid.weights, shape)
    pairs = match(iou[np.ix_(true.moving, predicted.moving)])
    numbers = {predicted.moving[b]: a + 1 for a, b in pairs}
    others = [link for link in predicted.moving if link not in numbers]
    return numbers | {link: number for number, link in enumerate(others, start=len(true.moving) + 1)}


class _View:
    """A camera and a ground for all pictures of an object.

    Args:
        truth: the true object, which the camera frames closed and open.
    """

    def __init__(self, truth: Figure) -> None:
        self._truth = truth
        self._bounds = truth.closed.bounds
        self._camera = _camera(truth)
        self._ground = float(min(truth.closed.bounds[0, 2], truth.opened.bounds[0, 2]))

    def of(self, figure: Figure, posed: Mesh) -> ByteArray:
        """(SIZE, SIZE, 3) picture of a figure in a pose, parts in their colours."""
        diagonal = max(float(np.linalg.norm(self._bounds[1] - self._bounds[0])), 1e-12)
        away = np.abs(posed.vertices - self._bounds.mean(axis=0)).max(axis=1) > _FAR * diagonal
        near = ~away[posed.faces].any(axis=1)
        if not near.any():
            return np.full((SIZE, SIZE, 3), BACKGROUND, dtype=np.uint8)
        if near.all():
            return self._picture(posed, figure.paint)
        shown = Mesh(posed.vertices, posed.faces[near], posed.normals)
        return self._picture(shown, figure.paint[near])

    def plain(self, look: Mesh | None) -> ByteArray:
        """(SIZE, SIZE, 3) picture of the object as it looks, or of the true surface in grey."""
        if look is None:
            return self._picture(self._truth.closed, self._truth.unpainted)
        return self._picture(_laid_on(look, self._bounds), None)

    def _picture(self, mesh: Mesh, paint: FloatArray | None) -> ByteArray:
        pixels = render(
            mesh, self._camera, SIZE, SIZE, paint=paint, ground=self._ground, background=BACKGROUND
        )
        return pixels[..., :3]


def _camera(truth: Figure) -> Camera:
    """The first of the views that shows about as much of the moving parts, closed and open, as any.

    Which way an object faces differs between data sets.
    """
    points = np.concatenate([truth.closed.vertices, truth.opened.vertices])
    cameras = [framed(points, azimuth, _ELEVATION) for azimuth in _AZIMUTHS]
    shown = np.zeros(len(cameras), dtype=np.int64)
    if truth.moves.any():
        for mesh in (truth.closed, truth.opened) if truth.travels else (truth.closed,):
            caster = Rays(mesh.vertices, mesh.faces)
            shown += [_moving_pixels(caster, truth, camera) for camera in cameras]
    return next(c for c, s in zip(cameras, shown, strict=True) if _BETTER * s >= shown.max())


def _moving_pixels(caster: Rays, truth: Figure, camera: Camera) -> int:
    """Pixels of a small picture that show a part that moves."""
    frame = Frame(camera, _SKETCH, _SKETCH)
    rays = PixelRays.single(frame, range(_SKETCH))
    face = caster.hits(rays.origins, rays.directions).face
    return int(truth.moves[face[face >= 0]].sum())


def _laid_on(look: Mesh, bounds: FloatArray) -> Mesh:
    """A mesh moved and scaled so that its box has the middle and the longest side of the (2, 3) bounds."""
    longest = max(float(np.ptp(look.bounds, axis=0).max()), 1e-12)
    scale = max(float(np.ptp(bounds, axis=0).max()), 1e-12) / longest
    target_from_look = np.diag([scale, scale, scale, 1.0])
    target_from_look[:3, 3] = bounds.mean(axis=0) - scale * look.bounds.mean(axis=0)
    return with_normals(look).transformed(target_from_look)


def _write(folder: Path, name: str, pixels: ByteArray) -> str:
    from PIL import Image

    file = f"{name}.png"
    Image.fromarray(pixels).save(folder / file, "PNG")
    return file
