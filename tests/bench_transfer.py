"""Times the transfer of part seeds to meshes of growing size, against one bare k-d tree query.

The bare query builds one tree of all seeds and asks it for every vertex of the mesh as given, on one thread.

Usage: python tests/bench_transfer.py [FACES ...]
"""

import argparse
import multiprocessing
import resource
import time

import numpy as np
from scipy.spatial import cKDTree

from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.transfer import transfer
from simart_kit.voxels import cube_frame, voxelise

PARTS = 8


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("faces", nargs="*", type=int, default=[10_000, 100_000, 1_000_000])
    for faces in parser.parse_args().faces:
        # A process each: the peak memory of one has no part in the next.
        process = multiprocessing.get_context("spawn").Process(target=bench, args=(faces,))
        process.start()
        process.join()


def bench(count: int) -> None:
    mesh = wavy_ball(count)
    truth = sectors(mesh)
    frame = cube_frame(mesh.bounds, 64)
    seeds = [voxelise(mesh.triangles[truth == part], frame).centers for part in range(PARTS)]
    everything = np.concatenate(seeds)
    before = peak()
    seconds, found = {}, {}
    seconds["bare query"] = best(lambda: cKDTree(everything).query(mesh.vertices))[0]
    seconds["bare, threads"] = best(lambda: cKDTree(everything).query(mesh.vertices, workers=-1))[0]
    seconds["one query a part"] = best(
        lambda: [cKDTree(own).query(mesh.vertices, workers=-1) for own in seeds]
    )[0]
    seconds["segments alone"], segments = best(lambda: find_segments(mesh))
    seconds["seeds"], found["seeds"] = best(lambda: transfer(mesh, seeds, mode="seeds"))
    seconds["segments, known"], _ = best(lambda: transfer(mesh, seeds, segments=segments))
    seconds["segments"], found["segments"] = best(lambda: transfer(mesh, seeds))
    # A mesh that nobody has asked for its areas and normals yet.
    seconds["segments, cold"], _ = best(lambda: transfer(Mesh(mesh.vertices, mesh.faces), seeds))
    print(f"{len(mesh.faces)} faces, {len(mesh.vertices)} vertices, {PARTS} parts, {len(everything)} seeds")
    for name, value in seconds.items():
        print(f"  {name:<17} {value:7.3f} s  {value / seconds['bare query']:6.1f} x the bare query")
    for name, result in found.items():
        right = mesh.face_areas[result.face_part == truth].sum() / mesh.face_areas.sum()
        print(f"  {name:<17} {100 * right:7.2f} % of the area as it was")
    print(f"  peak memory {peak():.2f} GiB, before the transfers {before:.2f} GiB", flush=True)


def wavy_ball(count: int) -> Mesh:
    """A closed ball with waves, of about `count` faces."""
    rings = int(np.sqrt(count / 2))
    around, down = np.meshgrid(np.arange(rings), np.arange(rings + 1), indexing="ij")
    turn, tilt = 2 * np.pi * around / rings, np.pi * (down + 0.2) / (rings + 0.4)
    points = np.stack([np.cos(turn) * np.sin(tilt), np.sin(turn) * np.sin(tilt), np.cos(tilt)], axis=-1)
    points = points.reshape(-1, 3)
    start, end = (np.arange(rings) * (rings + 1), (np.arange(rings) + 1) % rings * (rings + 1))
    low = np.arange(rings)
    a, b = (start[:, None] + low).ravel(), (end[:, None] + low).ravel()
    faces = np.stack([a, b, b + 1, a, b + 1, a + 1], axis=-1).reshape(-1, 3)
    return Mesh(points * (1 + 0.1 * np.sin(5 * points[:, [1, 2, 0]])), faces)


def sectors(mesh: Mesh) -> np.ndarray:
    """(F,) which slice of the ball each face lies in."""
    x, y, _ = mesh.triangles.mean(axis=1).T
    return np.minimum((np.arctan2(y, x) + np.pi) / (2 * np.pi) * PARTS, PARTS - 1).astype(int)


def best(work):
    """Least seconds of three runs, and the result."""
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - start)
    return min(seconds), result


def peak() -> float:
    """Most memory this process has held [GiB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


if __name__ == "__main__":
    main()
