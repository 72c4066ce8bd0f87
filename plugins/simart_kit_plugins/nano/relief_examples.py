"""Made-up objects as closed skins cut by relief: what the network for these is given and should say."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import IntArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments

from ..shapes.dice import Dice
from .cloud import sample_pieces
from .examples import MOST_PIECES, POINTS, Example, example_of, seen_somehow
from .generate.objects import GeneratedObject
from .generate.skins import Skin, skin_of
from .generate.writing import mesh_of
from .meshes import cloud_of, few
from .truth import majority

# Voxels along the longest side of an object, and how often its skin has one colour.
_CELLS, _PLAIN = (80, 116), 0.2


def relief_example(made: GeneratedObject, generator: np.random.Generator) -> Example:
    """An example of an object's skin, in a pose and look that the generator chooses.

    Args:
        made: the object.
        generator: of the choices.
    """
    seen, size = seen_somehow(made, generator)
    textured = mesh_of(seen, Dice(int(generator.integers(2**31))))
    skin = skin_of(textured, generator, int(generator.integers(*_CELLS, endpoint=True)))
    mesh = surface_of(skin, colored=generator.random() >= _PLAIN)
    piece = relief_of(mesh)
    samples = sample_pieces(mesh.face_areas, piece, POINTS, generator)
    # As in use, but in the frame of the object and not of its skin, which is a little larger.
    cloud = cloud_of(mesh, samples, piece[samples.face], np.zeros(3), 1.0)
    part = majority(skin.face_part, piece, mesh.face_areas, len(made.bodies), cloud.count)
    return example_of(seen, cloud, part, size)


def surface_of(skin: Skin, colored: bool = True) -> Mesh:
    """A skin in the frame of generated objects."""
    x, y, z = np.asarray(skin.vertices, dtype=np.float64).T
    rgb = skin.colors if colored else np.full_like(skin.colors, 128)
    colors = np.column_stack([rgb, np.full(len(rgb), 255, dtype=np.uint8)])
    return Mesh(np.column_stack([x, -z, y]), skin.faces, colors=colors)


def skin_mesh(made: GeneratedObject, generator: np.random.Generator) -> Mesh:
    """The skin of an object in its colours."""
    textured = mesh_of(made, Dice(int(generator.integers(2**31))))
    return surface_of(skin_of(textured, generator))


def relief_of(mesh: Mesh) -> IntArray:
    """(F,) pieces of a skin, 0.. without gaps, no more than the network learns from."""
    piece = np.minimum(few(mesh, find_segments(mesh, relief=True).face_segment), MOST_PIECES - 1)
    return np.asarray(np.unique(piece, return_inverse=True)[1].reshape(-1))
