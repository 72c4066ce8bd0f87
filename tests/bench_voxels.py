"""Times exact surface voxelisation at 64^3 beside trimesh's, which samples and may miss cells.

Usage: python tests/bench_voxels.py
"""

import resource
import time
from collections.abc import Callable

import numpy as np
import trimesh
from bench import EXAMPLE, split_triangle

from simart_kit.voxels import cube_frame, voxelise

CELLS, PIECES, REPEATS = 64, 19, 3


def main() -> None:
    for name, vertices, faces in (("bumpy sphere", *sphere()), ("example cabinet, split", *cabinet())):
        bench(name, vertices, faces)
    print(f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB at most")


def sphere() -> tuple[np.ndarray, np.ndarray]:
    mesh = trimesh.creation.icosphere(subdivisions=8)
    vertices = np.asarray(mesh.vertices)
    return vertices * (1 + 0.05 * np.sin(9 * vertices[:, [1, 2, 0]])), np.asarray(mesh.faces)


def cabinet() -> tuple[np.ndarray, np.ndarray]:
    """The example with each face split into `PIECES`^2."""
    mesh = trimesh.load(EXAMPLE, force="mesh", process=False)
    corners, triangles = split_triangle(PIECES)
    vertices = np.einsum("pk,fkc->fpc", corners, mesh.vertices[mesh.faces]).reshape(-1, 3)
    starts = np.arange(len(mesh.faces))[:, None, None] * len(corners)
    return vertices, (triangles[None] + starts).reshape(-1, 3)


def bench(name: str, vertices: np.ndarray, faces: np.ndarray) -> None:
    frame = cube_frame(np.array([vertices.min(axis=0), vertices.max(axis=0)]), CELLS)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    triangles = vertices[faces]  # as `Mesh.triangles` keeps them
    ours, mine = quickest(lambda: len(voxelise(triangles, frame).indices))
    theirs, other = quickest(lambda: mesh.voxelized(frame.voxel_size).filled_count)
    print(
        f"{name}, {len(faces)} faces: {ours:.2f} s for {mine} voxels; "
        f"trimesh {theirs:.2f} s for {other}: {theirs / ours:.1f} times as long"
    )


def quickest(work: Callable[[], int]) -> tuple[float, int]:
    """Least wall time of a few runs [s], and the result."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        result = work()
        times.append(time.perf_counter() - start)
    return min(times), result


if __name__ == "__main__":
    main()
