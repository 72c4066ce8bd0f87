"""A stand-in for a checkout of Particulate: `infer.py` with its documented arguments and files, no network.

Of the cabinet it knows the parts by where their faces are; anything else is one part. Joints are in its
normalised frame, as the real one writes them; pred.obj is as the input was.
"""

from __future__ import annotations

import sys
from pathlib import Path

from .p3sam_stand_in import write_program

INFER = """
import argparse, os, subprocess, sys, time
from pathlib import Path

behaviour = open("behaviour.txt").read()
with open("pids.txt", "a") as file:
    file.write(f"{os.getpid()}\\n")
Path("arguments.txt").write_text("\\n".join(sys.argv[1:]))
if behaviour == "no cuda":
    raise RuntimeError("CUDA is required for inference")
if behaviour == "hang":
    child = subprocess.Popen(["sleep", "60"], start_new_session=True)
    with open("pids.txt", "a") as file:
        file.write(f"{child.pid}\\n")
    time.sleep(60)

import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--input_mesh", required=True)
parser.add_argument("--output_dir", default="inference_outputs")
parser.add_argument("--up_dir", default="-Z")
parser.add_argument("--min_part_confidence", type=float, default=0.0)
parser.add_argument("--no_strict", action="store_true")
parser.add_argument("--eval", action="store_true")
args = parser.parse_args()
assert Path("configs/particulate-B.yaml").is_file(), "it has to run in its checkout"

words = [line.split() for line in open(args.input_mesh)]
vertices = np.array([[float(x) for x in w[1:]] for w in words if w[0] == "v"])
faces = np.array([[int(i) - 1 for i in w[1:]] for w in words if w[0] == "f"])
low, high = vertices.min(axis=0), vertices.max(axis=0)
center, scale = (low + high) / 2, (high - low).max()

x, y, z = vertices[faces].mean(axis=1).T
inside = (abs(x) < 0.276) & (y < 0.16) & (0.021 < z) & (z < 0.775)
ids = np.where(inside, np.where(z < 0.53, 1, 2), 0) if inside.sum() == 48 else np.zeros(len(faces), int)
parts = ids.max() + 1
direction, point = np.array([0, 0, 1.0]), (np.array([-0.275, -0.19, 0.2]) - center) / scale
lines = np.zeros((3, 6))
lines[1] = [*direction, *np.cross(direction, point)]
arrays = dict(
    face_part_ids=ids,
    motion_hierarchy=[(0, 1), (0, 2)] if parts == 3 else [],
    is_part_revolute=np.array([False, True, False])[:parts],
    is_part_prismatic=np.array([False, False, True])[:parts],
    revolute_plucker=lines[:parts],
    revolute_range=np.array([[0, 0], [-1.5, 0], [0, 0]])[:parts],
    prismatic_axis=np.array([[0, 0, 0], [0, 0, 0], [0, -1.0, 0]])[:parts],
    prismatic_range=np.array([[0, 0], [0, 0], [0, 0.3 / scale]])[:parts],
)
if behaviour == "nothing":
    sys.exit()
if behaviour == "nan":
    arrays["revolute_range"] = arrays["revolute_range"] * np.nan
if behaviour == "short":
    arrays["face_part_ids"] = ids[1:]
out = Path(args.output_dir) / "eval"
out.mkdir(parents=True)
with open(out / "pred.obj", "w") as file:
    for vertex in vertices:
        file.write("v {:.8f} {:.8f} {:.8f}\\n".format(*vertex))
    for face in faces + 1:
        file.write("f {} {} {}\\n".format(*face))
np.savez(out / "pred.npz", **arrays)
if behaviour == "garbage":
    (out / "pred.npz").write_bytes(b"garbage")
print(f"Found {parts} unique parts")
"""


class ParticulateStandIn:
    """A checkout with a python of its own.

    Args:
        root: an empty folder.
        behaviour: how it goes wrong, or "fine".
    """

    def __init__(self, root: Path, behaviour: str = "fine") -> None:
        self.folder, python = root / "particulate", root / "python"
        (self.folder / "configs").mkdir(parents=True)
        (self.folder / "configs" / "particulate-B.yaml").touch()
        (self.folder / "infer.py").write_text(INFER)
        (self.folder / "behaviour.txt").write_text(behaviour)
        write_program(python, f'exec "{sys.executable}" -B "$@"')
        self.options = {"folder": str(self.folder), "python": str(python), "cache": str(root / "cache")}

    @property
    def pids(self) -> list[int]:
        """Every process that it was, or started."""
        file = self.folder / "pids.txt"
        return [int(line) for line in file.read_text().split()] if file.exists() else []

    @property
    def arguments(self) -> list[str]:
        """What it was called with last."""
        return (self.folder / "arguments.txt").read_text().splitlines()
