"""The process that runs a convex decomposition: it may hang, crash or use up memory without harm.

A program of its own, run by its path: it imports numpy and the tool, and nothing of this package. It reads an
`.npz` with `vertices`, `faces` and the settings from stdin, and writes one with the hulls to stdout.
"""

from __future__ import annotations

import io
import os
import sys

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_MEMORY = 4 << 30
"""Most memory that the tool may ask for [bytes]."""


def main() -> None:
    """Read a mesh, decompose it, write the hulls."""
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # tools talk on stdout
    _limit_memory()
    with np.load(io.BytesIO(sys.stdin.buffer.read()), allow_pickle=False) as asked:
        tool, most, corners = str(asked["tool"]), int(asked["most"]), int(asked["corners"])
        vertices, faces = asked["vertices"], asked["faces"]
    hulls = {"vhacd": _vhacd, "coacd": _coacd}[tool](vertices, faces, most, corners)
    arrays = {f"hull_{i}": np.asarray(points, dtype=np.float64) for i, points in enumerate(hulls)}
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)  # type: ignore[arg-type]
    answer.write(buffer.getvalue())
    answer.close()


def _vhacd(vertices: Floats, faces: Integers, most: int, corners: int) -> list[Floats]:
    import vhacdx

    hulls = vhacdx.compute_vhacd(
        vertices,
        faces.astype(np.uint32),
        maxConvexHulls=most,
        resolution=30_000,
        minimumVolumePercentErrorAllowed=2.0,
        maxNumVerticesPerCH=corners,
        asyncACD=False,  # threads finish in any order
    )
    return [points for points, _ in hulls]


def _coacd(vertices: Floats, faces: Integers, most: int, corners: int) -> list[Floats]:
    import coacd

    coacd.set_log_level("error")
    hulls = coacd.run_coacd(
        coacd.Mesh(vertices, faces.astype(np.int32)),
        threshold=0.08,
        max_convex_hull=most,
        mcts_nodes=15,
        mcts_iterations=60,
        decimate=True,  # without it the next is ignored
        max_ch_vertex=corners,
        seed=0,
    )
    return [points for points, _ in hulls]


def _limit_memory() -> None:
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))


if __name__ == "__main__":
    main()
