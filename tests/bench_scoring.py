"""Times `bench score` on copies of the example cabinet, each face split into 9, and watches its memory.

Usage: python tests/bench_scoring.py [--objects 100] [--jobs 2]
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
from bench import EXAMPLE, write_split

PIECES = 3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--objects", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        faces = write_objects(Path(folder), arguments.objects)
        score(Path(folder), arguments.objects, arguments.jobs, faces)


def write_objects(folder: Path, count: int) -> int:
    """Write `data/N` with truth and `predictions/N` with a conversion, for each object; returns its faces."""
    truth, prediction = folder / "truth", folder / "prediction"
    truth.mkdir()
    faces = write_split(truth / "input.glb", PIECES)
    shutil.copy(EXAMPLE.with_suffix(".gt.json"), truth / "gt.json")
    with np.load(EXAMPLE.with_suffix(".gt.npz")) as stored:
        np.savez(truth / "gt.npz", face_part=np.repeat(stored["face_part"], PIECES**2))
    convert = ["convert", truth / "input.glb", "--recipe", "mjcf", "--no-record", "--quiet"]
    subprocess.run([sys.executable, "-m", "simart_kit", *convert, "--out", prediction], check=True)
    for number in range(count):
        shutil.copytree(truth, folder / "data" / f"cabinet_{number:03}", copy_function=os.link)
        shutil.copytree(prediction, folder / "predictions" / f"cabinet_{number:03}", copy_function=os.link)
    return faces


def score(folder: Path, objects: int, jobs: int, faces: int) -> None:
    """Score in a process of its own; print wall time, and memory of all its processes early and late."""
    command = ["bench", "score", folder / "data", folder / "predictions", "--out", folder / "run"]
    start = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "simart_kit", *command, "--jobs", str(jobs), "--json"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    used: list[float] = []
    watcher = threading.Thread(target=watch, args=(process, used))
    watcher.start()
    code = process.wait()
    wall = time.perf_counter() - start
    watcher.join()
    third = max(len(used) // 3, 1)
    print(f"{objects} objects of {faces} faces, {jobs} jobs: {wall:.1f} s wall, exit code {code}")
    print(f"memory of all processes: {max(used[:third]):.2f} GiB at most in the first third of the time,")
    print(f"  {max(used[-third:]):.2f} GiB in the last")


def watch(process: subprocess.Popen[bytes], used: list[float]) -> None:
    """Note the resident memory of a process and of all below it, ten times a second [GiB]."""
    while process.poll() is None:
        used.append(sum(resident(number) for number in family(process.pid)) / 2**30)
        time.sleep(0.1)


def family(root: int) -> set[int]:
    """A process and all that it started, directly or not."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(path.parent.name)] = int(path.read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue  # ended meanwhile
    found, grown = {root}, True
    while grown:
        more = {child for child, parent in parents.items() if parent in found} - found
        found, grown = found | more, bool(more)
    return found


def resident(number: int) -> int:
    """Memory that a process holds [bytes]; 0 when it has ended."""
    try:
        return int(Path(f"/proc/{number}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0


if __name__ == "__main__":
    main()
