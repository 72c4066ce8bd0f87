"""A stand-in for an installed Hunyuan3D-Part: P3-SAM's documented interface with its traps, and no network.

It runs from P3-SAM/demo only, imports a module of XPart/partgen, wants a GPU in its constructor, ignores
point_num, prints to stdout, cleans the mesh unless told not to, and leaves faces at -1 and -2.

What a face is, by its middle in the frame that P3-SAM is given (+y up): `PART` of the test says the same in
the canonical frame.
"""

from __future__ import annotations

import sys
from pathlib import Path
from textwrap import dedent

import numpy as np
from simart_kit_plugins.p3sam.segmenter import P3Sam

from simart_kit import Mesh, Segmentation
from simart_kit.recipe import read_options
from simart_kit.testing.meshes import cabinet_mesh

AUTO_MASK = """
import os, signal, subprocess, sys, time

sys.path.append("..")
behaviour = open("behaviour.txt").read()


def note_pid(pid):
    with open("pids.txt", "a") as file:
        file.write(f"{pid}\\n")


note_pid(os.getpid())
print("imported", flush=True)
if behaviour == "segfault":
    os.kill(os.getpid(), signal.SIGSEGV)
if behaviour == "killed":
    os.kill(os.getpid(), signal.SIGKILL)
if behaviour == "silent":
    os._exit(0)
if behaviour == "hang":
    note_pid(subprocess.Popen(["sleep", "60"], start_new_session=True).pid)
    print("\\rNMS:  50%", flush=True)
    time.sleep(60)

from model import Network
import numpy as np


def clean_mesh(mesh):
    import trimesh

    return trimesh.Trimesh(mesh.vertices, mesh.faces[::-1][2:], process=False)


class AutoMask:
    def __init__(self, ckpt_path, point_num=100000, prompt_num=400, threshold=0.95, post_process=True):
        print("trying to download model from huggingface...")
        self.model = Network().cuda()
        self.threshold, self.post_process = threshold, post_process

    def predict_aabb(self, mesh, point_num=None, prompt_num=None, threshold=None, post_process=None,
                     save_path=None, save_mid_res=False, show_info=True, clean_mesh_flag=True, seed=42,
                     is_parallel=True, prompt_bs=32):
        point_num, prompt_num = 100000, 400
        assert not is_parallel and not save_mid_res
        if behaviour == "gpu memory":
            raise RuntimeError("CUDA out of memory. Tried to allocate 20.00 GiB (GPU 0; 23.69 GiB total)")
        if clean_mesh_flag or behaviour == "cleans anyway":
            mesh = clean_mesh(mesh)
        middles = mesh.vertices[mesh.faces].mean(axis=1)
        ids = np.where(middles[:, 1] > 0.6, 7, np.where(middles[:, 0] > 0, 3, 12))
        ids[middles[:, 2] > 0.205] = -1
        ids[(middles[:, 2] > 0.205) & (middles[:, 0] > 0.1)] = -2
        if behaviour == "no part":
            ids[:] = -1
        if behaviour == "nan":
            mesh.vertices = mesh.vertices * np.nan
        aabb = np.zeros((3, 2, 3))
        return aabb, ids, mesh
"""
MODEL = """
import os, sys
sys.path.append(os.path.join(os.path.dirname(__file__), "..", "XPart/partgen"))
from models import sonata


class Network:
    def cuda(self):
        if sonata.GPUS == 0:
            raise RuntimeError("Found no NVIDIA driver on your system.")
        return self
"""
# For speed: what is used of trimesh, in a module that hides the real one.
TRIMESH = """
class Trimesh:
    def __init__(self, vertices, faces, process=True):
        assert not process
        self.vertices, self.faces = vertices, faces
"""


class StandIn:
    """A checkout with a python of its own.

    Args:
        root: an empty folder.
        behaviour: how it goes wrong, or "fine".
        real_trimesh: whether it takes the trimesh of this environment.
    """

    def __init__(self, root: Path, behaviour: str = "fine", real_trimesh: bool = False) -> None:
        self.folder, self.demo = root / "Hunyuan3D-Part", root / "Hunyuan3D-Part" / "P3-SAM" / "demo"
        models = self.folder / "XPart" / "partgen" / "models"
        self.demo.mkdir(parents=True)
        models.mkdir(parents=True)
        (models / "__init__.py").touch()
        (models / "sonata.py").write_text("GPUS = 1\n")
        (self.demo / "auto_mask.py").write_text(AUTO_MASK)
        (self.demo / "behaviour.txt").write_text(behaviour)
        (self.demo.parent / "model.py").write_text(MODEL)
        if not real_trimesh:
            (self.demo / "trimesh.py").write_text(TRIMESH)
        self.python = root / "python"
        write_program(self.python, f'exec "{sys.executable}" -B "$@"')
        self.cache = root / "cache"
        self.options = {"folder": str(self.folder), "python": str(self.python), "cache": str(self.cache)}

    @property
    def pids(self) -> list[int]:
        """Every process that it was, or started."""
        file = self.demo / "pids.txt"
        return [int(line) for line in file.read_text().split()] if file.exists() else []

    @property
    def kept(self) -> list[str]:
        """Names of the files in the cache."""
        folder = self.cache / "p3sam"
        return sorted(path.name for path in folder.iterdir()) if folder.exists() else []


def write_program(path: Path, text: str) -> None:
    """Write a shell script that can be run."""
    path.write_text(dedent(f"#!/bin/sh\n{text}\n"))
    path.chmod(0o755)


def still_there(pids: list[int]) -> list[int]:
    """Those processes that are still there, as anything but a zombie."""
    return [pid for pid in pids if _state(pid) not in ("", "Z")]


def _state(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return ""


def expected_labels(middles: np.ndarray) -> np.ndarray:
    """What P3-SAM says of faces by their (F, 3) middles in the canonical frame, none filled in yet."""
    ids = np.where(middles[:, 2] > 0.6, 7, np.where(middles[:, 0] > 0, 3, 12))
    return np.where(middles[:, 1] < -0.205, -1, ids)


def run_alone(code: str) -> list[str]:
    """The command that runs some code in a bare python, which starts fast."""
    return [sys.executable, "-I", "-S", "-c", dedent(code)]


def segment(stand_in: StandIn, mesh: Mesh | None = None, **options: object) -> Segmentation:
    """What `p3sam` makes of a mesh, by default the cabinet, with a stand-in installed."""
    stage = P3Sam(read_options(P3Sam, {**stand_in.options, **options}), seed=42)
    return stage.segment(cabinet_mesh() if mesh is None else mesh)
