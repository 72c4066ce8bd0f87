"""A data set of cabinets, and a plugin that knows what a cabinet is and fails as the objects' names say."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from simart_kit.bench.importing import write_case
from simart_kit.bench.run import Plan
from simart_kit.bench.worker import Conversions
from simart_kit.plugins import Plugins
from simart_kit.recipe import load_recipe

from .bench_objects import block, cabinet, truth

PLUGIN = '''
import os, signal, time
from math import pi
from pathlib import Path
import numpy as np
import simart_kit as sk
import simart_kit.render

CONVERTED = Path(__file__).with_name("converted.txt")

class Cabinets(sk.Segmenter):
    """Knows one cabinet only; of anything else it says that it is one body."""
    name = "cabinets"
    def segment(self, mesh):
        # Real pictures take seconds and have their own tests. Only processes of the bench come here:
        # the tests' own reads this file too, and would never draw again.
        simart_kit.render.write_preview = lambda asset, path: path.write_bytes(b"picture")
        if len(mesh.faces) != 48:
            return sk.Segmentation(np.zeros(len(mesh.faces), int), (sk.PartGuess("body"),))
        names = ("body", "door_left", "door_right", "drawer")
        return sk.Segmentation(np.repeat(range(4), 12), tuple(map(sk.PartGuess, names)))

class Hinges(sk.JointPredictor):
    """Where a cabinet's joints are with z up and the middle of its box, y -0.27..0.25, at 0."""
    name = "hinges"
    def predict(self, mesh, segmentation):
        from simart_kit.asset import Joint, Limits
        if len(segmentation.parts) == 1:
            return ()
        def joint(name, child, kind, origin, axis, limits):
            return Joint(name, kind, "body", child, origin, axis, Limits(*limits))
        return (
            joint("left", "door_left", "revolute", (-0.5, -0.24, 0.4), (0, 0, 1), (-pi / 2, 0.0)),
            joint("right", "door_right", "revolute", (0.5, -0.24, 0.4), (0, 0, 1), (0.0, pi / 2)),
            joint("slide", "drawer", "prismatic", (0.0, -0.24, 0.875), (0, -1, 0), (0.0, 0.3)),
        )

@sk.hookimpl
def register_segmenters(register):
    register(Cabinets)

@sk.hookimpl
def register_joint_predictors(register):
    register(Hinges)

@sk.hookimpl
def load_mesh(path):
    name = path.parent.name
    with CONVERTED.open("a") as file:
        file.write(name + "\\n")
    if name.startswith("exit"):
        os._exit(3)
    if name.startswith("segfault"):
        os.kill(os.getpid(), signal.SIGSEGV)
    if name.startswith("hang"):
        while True:
            pass
    if name.startswith("raise"):
        raise RuntimeError("out of ideas")
    if name.startswith("slow"):
        time.sleep(1.0)
'''
RECIPE = """
schema = 1
[segmenter]
use = "cabinets"
[joints]
use = "hinges"
[[modify]]
use = "mass"
[[modify]]
use = "collision"
"""


def write_home(home: Path, names: Iterable[str]) -> None:
    """A data set, a recipe and a plugin file; objects called block... are static."""
    for name in names:
        known = block(name) if name.startswith("block") else cabinet(name)
        category = "block" if name.startswith("block") else "cabinet"
        write_case(truth(known, category), home / "data" / name)
    (home / "cabinets.py").write_text(PLUGIN)
    (home / "recipe.toml").write_text(RECIPE)


def plan(home: Path, out: str = "run", sets: Iterable[str] = (), **changes: object) -> Plan:
    """To convert and score the data set of a home, without pictures."""
    plugin = home / "cabinets.py"
    recipe = load_recipe(home / "recipe.toml", Plugins(files=[plugin]), [*sets, 'export=[{use="mjcf"}]'])
    system = Conversions("recipe recipe", recipe, (plugin,))
    usual = {"data": home / "data", "out": home / out, "system": system, "pictures": False}
    return Plan(**{**usual, **changes})


def converted(home: Path) -> list[str]:
    """Names of the objects whose conversion began, in that order."""
    path = home / "converted.txt"
    return path.read_text().split() if path.exists() else []
