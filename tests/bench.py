"""Times the command line on the example cabinet as it is, and with each face split into 81.

Usage: python tests/bench.py [--recipe NAME]
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import trimesh

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "cabinet.glb"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--recipe", default="all")
    recipe = parser.parse_args().recipe
    with tempfile.TemporaryDirectory() as folder:
        for pieces in (1, 9):
            source = Path(folder) / f"cabinet_{pieces}.glb"
            faces = write_split(source, pieces)
            bench(source, recipe, Path(folder) / f"out_{pieces}", faces)


def write_split(path: Path, pieces: int) -> int:
    """Write the example with every edge cut into `pieces`; returns the number of faces."""
    mesh = trimesh.load(EXAMPLE, force="mesh", process=False)
    corners, triangles = split_triangle(pieces)
    vertices = np.einsum("pk,fkc->fpc", corners, mesh.vertices[mesh.faces]).reshape(-1, 3)
    uv = np.einsum("pk,fkc->fpc", corners, mesh.visual.uv[mesh.faces]).reshape(-1, 2)
    faces = (triangles[None] + np.arange(len(mesh.faces))[:, None, None] * len(corners)).reshape(-1, 3)
    visual = trimesh.visual.TextureVisuals(uv=uv, material=mesh.visual.material)
    trimesh.Trimesh(vertices, faces, visual=visual, process=False).export(path)
    return len(faces)


def split_triangle(pieces: int) -> tuple[np.ndarray, np.ndarray]:
    """Barycentric (P, 3) corners and (pieces^2, 3) triangles of a triangle cut into a grid."""
    index = {}
    for row in range(pieces + 1):
        for column in range(pieces + 1 - row):
            index[row, column] = len(index)
    corners = np.array([[pieces - r - c, c, r] for r, c in index]) / pieces
    triangles = []
    for row, column in index:
        if row + column < pieces:
            triangles.append([index[row, column], index[row, column + 1], index[row + 1, column]])
        if row + column < pieces - 1:
            across = index[row + 1, column + 1]
            triangles.append([index[row, column + 1], across, index[row + 1, column]])
    return corners, np.array(triangles)


def bench(source: Path, recipe: str, out: Path, faces: int) -> None:
    """Convert in a process of its own and print its stages, wall time and peak memory."""
    command = [
        sys.executable,
        "-m",
        "simart_kit",
        "convert",
        source,
        "--recipe",
        recipe,
        "--out",
        out,
        "--json",
    ]
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert process.stdout is not None
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    document = json.loads(text)
    print(f"{faces} faces, recipe {recipe}: {wall:.1f} s wall, {usage.ru_maxrss / 2**20:.2f} GiB at most")
    if status != 0:
        print(f"  failed: {document['error']}")
        return
    for row in document["seconds"]:
        print(f"  {row['stage']:<8} {row['name']:<12} {row['seconds']:7.2f} s")
    rest = wall - sum(row["seconds"] for row in document["seconds"])
    print(f"  {'start-up, recording and files':<21} {rest:7.2f} s")
    print(f"  {document['report']['summary']}")


if __name__ == "__main__":
    main()
