"""Skins of SIMART-Bench objects as generators of shapes deliver theirs, to measure how well these are read.

    python -m tests.delivered_skins OBJECTS OUT --faces 40000     # decimated
    python -m tests.delivered_skins OBJECTS OUT --wall 0.012      # with an inner side to each wall
    python -m tests.delivered_skins OBJECTS OUT --strays 30       # among small solids
    simart-kit bench run OUT --variant fused

Lengths are shares of the longest side; colours are those of vertices.
"""

from __future__ import annotations

import argparse
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh
from fast_simplification import simplify
from scipy.spatial import cKDTree

_STEPS = 6  # over which normals are smoothed before a wall's inner side is set off along them
_FARTHER = 0.06  # beyond the object's box that strays lie at most


def decimated(skin: trimesh.Trimesh, part: np.ndarray, faces: int) -> tuple[trimesh.Trimesh, np.ndarray]:
    """Of that many faces, by quadrics; with the colours and parts (F,) of what is nearest."""
    welded = trimesh.Trimesh(skin.vertices, skin.faces, process=False)
    welded.merge_vertices(merge_tex=True, merge_norm=True)
    most = min(faces, len(welded.faces) - 1)
    vertices, corners = simplify(
        np.array(welded.vertices), np.array(welded.faces, np.int32), target_count=most
    )
    colors = skin.visual.vertex_colors[cKDTree(skin.vertices).query(vertices)[1]]
    nearest = cKDTree(skin.triangles_center).query(vertices[corners].mean(axis=1))[1]
    return trimesh.Trimesh(vertices, corners, vertex_colors=colors, process=False), part[nearest]


def double_walled(skin: trimesh.Trimesh, part: np.ndarray, wall: float) -> tuple[trimesh.Trimesh, np.ndarray]:
    """With a second skin within, which looks inward."""
    normals, (a, b) = np.array(skin.vertex_normals), skin.edges_unique.T
    for _ in range(_STEPS):
        sums = normals.copy()
        np.add.at(sums, a, normals[b])
        np.add.at(sums, b, normals[a])
        normals = sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-9)
    inner = skin.vertices - wall * np.ptp(skin.vertices, axis=0).max() * normals
    both = trimesh.Trimesh(
        np.vstack([skin.vertices, inner]),
        np.vstack([skin.faces, skin.faces[:, ::-1] + len(inner)]),
        vertex_colors=np.tile(skin.visual.vertex_colors, (2, 1)),
        process=False,
    )
    return both, np.tile(part, 2)


def among_strays(skin: trimesh.Trimesh, part: np.ndarray, count: int) -> tuple[trimesh.Trimesh, np.ndarray]:
    """With grey lumps of 0.004 to 0.012 anywhere about it, which are of the body."""
    rng, size = np.random.default_rng(5), np.ptp(skin.vertices, axis=0).max()
    lower, upper = skin.bounds + size * np.array([[-_FARTHER], [_FARTHER]])
    lumps = []
    for _ in range(count):
        lump = trimesh.creation.icosphere(subdivisions=1, radius=size * rng.uniform(0.004, 0.012))
        lump.vertices = lump.vertices * rng.uniform(0.6, 1.4, 3) + rng.uniform(lower, upper)
        lump.visual.vertex_colors = np.tile([128, 128, 128, 255], (len(lump.vertices), 1))
        lumps.append(lump)
    faces = sum(len(lump.faces) for lump in lumps)
    return trimesh.util.concatenate([skin, *lumps]), np.concatenate([part, np.zeros(faces, part.dtype)])


def main(arguments: Sequence[str] | None = None) -> None:
    """Write each object anew, with another skin."""
    parser = argparse.ArgumentParser(prog="python -m tests.delivered_skins", description=__doc__)
    parser.add_argument("objects", type=Path)
    parser.add_argument("out", type=Path)
    how = parser.add_mutually_exclusive_group(required=True)
    how.add_argument("--faces", type=int)
    how.add_argument("--wall", type=float)
    how.add_argument("--strays", type=int)
    asked = parser.parse_args(arguments)
    for source in sorted(path.parent for path in asked.objects.glob("*/fused.glb")):
        folder = asked.out / source.name
        shutil.copytree(source, folder, symlinks=False, copy_function=shutil.copyfile)
        skin = trimesh.load(source / "fused.glb", process=False, force="mesh")
        part = np.load(source / "fused.npz")["face_part"]
        if asked.faces:
            skin, part = decimated(skin, part, asked.faces)
        elif asked.wall:
            skin, part = double_walled(skin, part, asked.wall)
        else:
            skin, part = among_strays(skin, part, asked.strays)
        skin.export(folder / "fused.glb")
        np.savez_compressed(folder / "fused.npz", face_part=part)


if __name__ == "__main__":
    main()
