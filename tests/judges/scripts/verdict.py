"""What every judge's script shares: files come in as one JSON file, a line of JSON a file goes out.

Run by the Python of the judge's own environment, so it needs the standard library only. A reading holds what
the judge says of a file; the keys that it cannot fill are left out:

    errors     [text]                                  what the judge refuses or complains about
    poses      [{link: 4x4 rows}]                      world_T_link [m] at each of the job's joint positions
    inertials  {link: {mass, center, inertia}}         [kg], [m] and [kg*m^2] along the link's axes
    limits     {joint: [lower, upper] or null}         [rad | m]; null for a joint that turns for ever
    colliders  {link: count}                           collision shapes
"""

import json
import os
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

Reading = dict[str, Any]
Positions = list[Mapping[str, float]]
Read = Callable[[Path, Positions], Reading]


def main(read: Read) -> None:
    """Read every file of the jobs that the first argument names.

    A judge that refuses a file raises whatever its library raises; that is its verdict.
    """
    # Libraries print what they like to standard output.
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answers:
        os.dup2(2, 1)
        for job in json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")):
            start = time.perf_counter()
            try:
                reading = read(Path(job["path"]), job["positions"])
            except Exception as error:
                reading = {"errors": [f"{type(error).__name__}: {error}"]}
            seconds = time.perf_counter() - start
            answers.write(json.dumps({"asset": job["asset"], "seconds": seconds, **reading}) + "\n")
            answers.flush()


def inertial(mass: float, center: Any, inertia: Any) -> dict[str, Any]:
    """Mass properties of a link as a reading holds them; arrays of (3,) and (3, 3)."""
    return {"mass": float(mass), "center": rows(center), "inertia": rows(inertia)}


def rows(array: Any) -> Any:
    """An array of any shape as nested lists of floats."""
    return [rows(row) for row in array] if hasattr(array, "__len__") else float(array)


def pose(rotation: Any, position: Any) -> list[list[float]]:
    """The 4x4 rows of a (3, 3) rotation and a (3,) position."""
    upper = [[*rows(row), float(shift)] for row, shift in zip(rotation, position, strict=True)]
    return [*upper, [0.0, 0.0, 0.0, 1.0]]


def turn(x: float, y: float, z: float, w: float) -> list[list[float]]:
    """The (3, 3) rotation of a unit quaternion."""
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def turned(moments: Any, axes: Any) -> list[list[float]]:
    """The (3, 3) tensor of (3,) principal moments along the columns of a (3, 3) rotation."""
    return [
        [sum(float(axes[i][k]) * float(moments[k]) * float(axes[j][k]) for k in range(3)) for j in range(3)]
        for i in range(3)
    ]
