"""The closed skin of a written object beside it: what a generative model delivers of it, or a scanner."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from simart_kit_plugins.nano.generate.skins import Skin, skin_of, write_skin
from simart_kit_plugins.nano.generate.writing import GeneratedMesh


def add_skin(folder: Path) -> Skin:
    """Write fused.glb and fused.npz into an object's folder, by what `generate --skins` does.

    A part that nobody sees from outside has no face there; a face has the mean colour of its corners.
    """
    mesh = trimesh.load(folder / "input.glb", process=False, force="mesh")
    assert isinstance(mesh, trimesh.Trimesh)
    count = len(mesh.faces)
    colors = np.asarray(mesh.visual.vertex_colors)[:, :3]
    # A picture with a pixel for each face, as textured objects have one.
    picture = colors[mesh.faces].mean(axis=1).round().astype(np.uint8)[None]
    across = np.repeat((np.arange(count) + 0.5) / count, 3)
    surface = GeneratedMesh(
        np.asarray(mesh.triangles, dtype=np.float32).reshape(-1, 3),
        np.column_stack([across, np.full(3 * count, 0.5)]),
        np.arange(3 * count).reshape(-1, 3),
        np.load(folder / "gt.npz")["face_part"].astype(np.int32),
        picture,
    )
    skin = skin_of(surface, np.random.default_rng(0))
    write_skin(skin, folder)
    return skin
