"""The sides from which an object is shown, and what is seen from each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simart_kit.arrays import BoolArray, ByteArray, FloatArray, IntArray
from simart_kit.camera import Camera, framed
from simart_kit.mesh import Mesh
from simart_kit.normals import with_normals
from simart_kit.rays import Rays
from simart_kit.render import WHITE, face_ids, render

SIDES = {"front left": -35.0, "front right": 35.0, "back right": 145.0, "back left": -145.0}
"""Names of the views, with the azimuth of the eye [degrees]."""
_ELEVATION = np.deg2rad(26.0)
_LOOK = 96  # pixels of the small pictures that views are chosen by
_HIDDEN = 0.02  # what a pixel counts that would show a piece if nothing were before it


@dataclass(frozen=True, eq=False)
class Seen:
    """An object and the pieces that its faces are of.

    Attributes:
        mesh: in the canonical frame, with normals.
        piece: (F,) piece of each face, 0..N-1.
        count: N.
    """

    mesh: Mesh
    piece: IntArray
    count: int

    @classmethod
    def of(cls, mesh: Mesh, piece: IntArray) -> Seen:
        """Prepare an object for many pictures."""
        return cls(with_normals(mesh), piece, int(piece.max()) + 1)

    @cached_property
    def rays(self) -> Rays:
        """All faces, for casting."""
        return Rays(self.mesh.vertices, self.mesh.faces)

    @cached_property
    def cameras(self) -> dict[str, Camera]:
        """The views by name."""
        return {name: self.camera(name, np.zeros((0, 3))) for name in SIDES}

    def camera(self, side: str, besides: FloatArray) -> Camera:
        """A view in which (N, 3) more points have their place besides the object [m]."""
        points = np.concatenate([self.mesh.vertices[self.mesh.faces.ravel()], besides])
        return framed(points, np.deg2rad(SIDES[side]), _ELEVATION)

    def close_camera(self, side: str, points: FloatArray) -> Camera:
        """A view of only the place of (N, 3) points [m]."""
        return framed(points, np.deg2rad(SIDES[side]), _ELEVATION, perspective=False)

    def faces(self, members: Sequence[int]) -> BoolArray:
        """(F,) whether each face is of one of some pieces."""
        return np.asarray(np.isin(self.piece, members))

    def pieces_in(self, camera: Camera, size: int) -> IntArray:
        """(size, size) piece seen in each pixel, -1 for none."""
        found = face_ids(self.mesh, camera, size, size)
        return np.where(found >= 0, self.piece[np.maximum(found, 0)], -1)

    def picture(self, camera: Camera, size: int, paint: FloatArray | None = None) -> ByteArray:
        """(size, size, 3) on white; `paint` is (F, 4) colour and strength, or None."""
        drawn = render(self.mesh, camera, size, size, paint=paint, background=WHITE, caster=self.rays)
        return drawn[..., :3]

    def outline(self, members: Sequence[int], camera: Camera, size: int) -> BoolArray:
        """(size, size) pixels in which some pieces would be seen if all others were glass."""
        return _cast(self._alone(members), camera, size) >= 0

    def best_side(self, members: Sequence[int]) -> str:
        """The first side that shows about as much of some pieces as any; of hidden ones, their outline."""
        mine, alone = self.faces(members), self._alone(members)
        shown = {}
        for side, camera in self.cameras.items():
            first, outline = _cast(self.rays, camera, _LOOK), _cast(alone, camera, _LOOK) >= 0
            shown[side] = int(mine[first[first >= 0]].sum()) + _HIDDEN * int(outline.sum())
        most = max(shown.values())
        return next(side for side, pixels in shown.items() if 1.15 * pixels >= most)

    def _alone(self, members: Sequence[int]) -> Rays:
        return Rays(self.mesh.vertices, self.mesh.faces[self.faces(members)])


def _cast(rays: Rays, camera: Camera, size: int) -> IntArray:
    """(size, size) index of the triangle met in the middle of each pixel, -1 for none."""
    rows, columns = np.mgrid[0:size, 0:size] + 0.5
    pixels = np.stack([columns.ravel(), rows.ravel()], axis=1)
    origins, directions = camera.rays(pixels, size, size)
    return np.asarray(rays.hits(origins, directions).face).reshape(size, size)
