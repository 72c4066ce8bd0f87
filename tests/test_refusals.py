"""What the command line refuses and what it survives, with the shipped example as the input."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

import simart_kit as sk
from simart_kit.cli.main import run

from .export_cases import folder_hashes
from .real_objects import EXAMPLE

RECIPE = """
schema = 1
extends = "default"
sed = 3
segmenter = { use = "geometric", options = { nope = 1 } }
joints = { use = "geometric", options = { open_angle = "wide" } }
modify = [{ use = "mass", options = { density = -1.0 } }, { use = "nosuch" }]
"""
SEGMENTER = '''
import time
import numpy as np
from pydantic import Field
import simart_kit as sk

class Faulty(sk.Segmenter):
    """Goes wrong as asked."""
    name = "faulty"
    class Options(sk.Options):
        fault: str = Field(description="How.")
    options: Options
    def segment(self, mesh):
        faces = np.zeros(len(mesh.faces), dtype=np.int32)
        if self.options.fault == "raise":
            raise RuntimeError("out of ideas")
        if self.options.fault == "hang":
            time.sleep(60)
        labels = {"short": faces[:-1], "float": faces + 0.5}[self.options.fault]
        return sk.Segmentation(labels, (sk.PartGuess("body"),))

@sk.hookimpl
def register_segmenters(register):
    register(Faulty)
'''
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
FILES = {
    "empty.obj": b"",
    "points.obj": OBJ.encode(),
    "nan.obj": OBJ.replace("1", "nan").encode() + b"f 1 2 3\n",
    "infinite.obj": OBJ.replace("1", "inf").encode() + b"f 1 2 3\n",
    "range.obj": OBJ.encode() + b"f 1 2 9\n",
    "zero.glb": b"",
    "cut.glb": EXAMPLE.read_bytes()[:20000],
    "text.glb": b"hello",
    "mesh.blend": b"BLENDER",
    "gone.gltf": b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 9}]}',
    "outside.gltf": b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "../a.bin", "byteLength": 9}]}',
    "recipe.toml": RECIPE.encode(),
}
MISTAKES: dict[str, tuple[list[str], str]] = {
    "missing file": (["gone.glb"], "gone.glb"),
    "folder": (["folder"], "folder"),
    "unknown extension": (["mesh.blend"], "'.blend'.*glb"),
    "empty obj": (["empty.obj"], "empty"),
    "obj of points": (["points.obj"], "no faces"),
    "nan": (["nan.obj"], "NaN"),
    "infinite": (["infinite.obj"], "infinite"),
    "index out of range": (["range.obj"], "range.obj.*index"),
    "zero bytes": (["zero.glb"], "empty"),
    "truncated": (["cut.glb"], "cut off"),
    "text named glb": (["text.glb"], "not a GLB"),
    "uri missing": (["gone.gltf"], "'gone.bin'"),
    "uri outside": (["outside.gltf"], "'../a.bin'.*outside"),
    "unwritable output": ([str(EXAMPLE), "--out", "zero.glb/out"], "cannot write to output folder"),
    "unknown recipe": ([str(EXAMPLE), "--recipe", "nosuch"], "'nosuch'.*default"),
    "five mistakes": (
        [str(EXAMPLE), "--recipe", "recipe.toml"],
        "5 mistake.*sed.*nope.*open_angle.*density.*nosuch",
    ),
    "unknown segmenter": ([str(EXAMPLE), "--set", 'segmenter.use="nosuch"'], "'nosuch'.*geometric"),
}
FAULTS = {
    "raise": "RuntimeError: out of ideas",
    "hang": "TimeoutError",
    "short": r"face_part.*shape",
    "float": r"face_part.*float64",
}


@pytest.fixture
def inbox(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with everything that is wrong in it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    (tmp_path / "folder").mkdir()
    for name, data in FILES.items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_one_line_and_leaves_nothing(
    mistake: str, inbox: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    arguments, told = MISTAKES[mistake]
    before = sorted(inbox.rglob("*"))
    assert run(["convert", *arguments]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert re.fullmatch(f"error: .*{told}.*\n", err)
    assert sorted(inbox.rglob("*")) == before


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory, converted: Callable[[str], sk.Result]) -> Path:
    """A good conversion, and a plugin file beside it."""
    home = tmp_path_factory.mktemp("good")
    (home / "faulty.py").write_text(SEGMENTER, encoding="utf-8")
    shutil.copytree(converted("example").folder, home / "out")
    return home


@pytest.mark.parametrize("fault", FAULTS)
def test_a_segmenter_that_fails_is_named_and_its_input_kept(
    fault: str, good: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    before = folder_hashes(good / "out")
    faulty = f'segmenter={{use="faulty",options={{fault="{fault}"}}}}'
    plugin = ["--plugin", str(good / "faulty.py"), "--set", faulty, "--set", "stage_timeout=1.0"]
    assert run(["convert", str(EXAMPLE), "--recipe", "usd", "--out", str(good / "out"), *plugin]) == 1
    lines = [line for line in capfd.readouterr().err.splitlines() if line.startswith("error: ")]
    assert len(lines) == 1
    assert re.search(rf"segmenter 'faulty'.*faulty\.py.*{FAULTS[fault]}", lines[0]), lines[0]
    after = folder_hashes(good / "out")
    kept = {name for name in after if name.startswith("failed/")}
    assert {name: after[name] for name in set(after) - kept} == {
        name: before[name] for name in before if not name.startswith("failed/")
    }
    assert {"failed/error.txt", "failed/cabinet.rrd"} < kept
    assert any(name.startswith("failed/input") for name in kept)
