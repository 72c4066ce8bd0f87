"""A plugin file with fake stages, and the command line as a process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FAKES = '''
import os, time
import manifold3d
import numpy as np
from pydantic import Field
import simart_kit as sk
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh

class Labels(sk.Segmenter):
    """Labels a cabinet.

    Knows one cabinet only.
    """
    name = "labels"
    class Options(sk.Options):
        fault: str = Field(default="", description="What goes wrong.")
    options: Options
    def segment(self, mesh):
        print("noise from python")
        os.write(1, b"noise from native code\\n")
        if self.options.fault == "hang":
            time.sleep(60)
        if self.options.fault == "raise":
            raise RuntimeError("out of ideas")
        if self.options.fault == "raise with a solid":
            solid = manifold3d.Manifold.cube()
            raise RuntimeError(f"cannot mend {solid.volume()}")
        if self.options.fault == "interrupt":
            raise KeyboardInterrupt
        names = ("body", "door", "drawer")
        return sk.Segmentation(np.repeat([0, 1, 2], [60, 24, 24]), tuple(map(sk.PartGuess, names)))

class Joints(sk.JointPredictor):
    name = "joints"
    def predict(self, mesh, segmentation):
        return cabinet_asset().joints

class Text(sk.Exporter):
    name = "text"
    def export(self, asset, directory):
        (directory / "main.txt").write_text(str([j.limits for j in asset.joints]))
        return directory / "main.txt"

@sk.hookimpl
def register_segmenters(register):
    register(Labels)

@sk.hookimpl
def register_joint_predictors(register):
    register(Joints)

@sk.hookimpl
def register_exporters(register):
    register(Text)

@sk.hookimpl
def load_mesh(path):
    return cabinet_mesh(textured=False) if path.suffix == ".fake" else None
'''
RECIPE = """
schema = 1
description = "for tests"
modify = []
[segmenter]
use = "labels"
[joints]
use = "joints"
[[export]]
use = "text"
"""


def furnished(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with a source, a recipe and a plugin file."""
    # Real pictures take seconds and have their own tests.
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path.write_bytes(b"picture"))
    monkeypatch.chdir(folder)
    (folder / "cupboard.fake").write_text("cabinet")
    (folder / "recipe.toml").write_text(RECIPE)
    (folder / "fakes.py").write_text(FAKES)
    return folder


CONVERT = ["convert", "cupboard.fake", "--recipe", "recipe.toml", "--plugin", "fakes.py", "--no-record"]


def process(*arguments: str, **options) -> subprocess.Popen:
    # Start-up is measured as users meet it: with compiled modules kept.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-m", "simart_kit", *arguments]
    return subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
    )


def finish(running: subprocess.Popen) -> tuple[int, str, str]:
    out, err = running.communicate(timeout=60)
    return running.returncode, out, err
