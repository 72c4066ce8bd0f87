"""`simart-kit check` and `convert --strict`: verdicts, exit codes, and one clear line for each mistake."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit.arrays import mat3
from simart_kit.asset_io import load_asset, save_asset
from simart_kit.cli.main import run

from .checks_cases import NAMES, cabinet, export, mjcf

FAKES = '''
import numpy as np
import simart_kit as sk
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh

class Labels(sk.Segmenter):
    """Labels a cabinet."""
    name = "labels"
    def segment(self, mesh):
        parts = tuple(sk.PartGuess(name) for name in ("body", "door", "drawer"))
        return sk.Segmentation(np.repeat([0, 1, 2], [60, 24, 24]), parts, cabinet_asset().joints)

class Ready(sk.Modifier):
    """Masses and shapes."""
    name = "ready"
    def modify(self, asset):
        return asset.with_parts({part.name: part for part in cabinet_asset().parts})

class Broken(sk.Check):
    """Raises."""
    name = "broken"
    def check(self, subject):
        raise RuntimeError("out of ideas")

@sk.hookimpl
def register_segmenters(register):
    register(Labels)

@sk.hookimpl
def register_modifiers(register):
    register(Ready)

@sk.hookimpl
def load_mesh(path):
    return cabinet_mesh() if path.suffix == ".fake" else None
'''
RECIPE = """schema = 1
segmenter = { use = "labels" }
joints = { use = "hints" }
modify = [{ use = "ready" }]
export = [{ use = "mjcf" }]
[checks]
realtime = false
[checks.settle]
speed = 0.01
"""
KINDS = ("urdf", "mjcf", "usd")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An output folder with each format, but no provenance."""
    folder = tmp_path_factory.mktemp("made")
    save_asset(cabinet(), folder)
    for kind in KINDS:
        export(cabinet(), folder, kind)
    return folder


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a mesh, a recipe and their plugin."""
    for name, text in (("box.fake", "mesh"), ("fakes.py", FAKES), ("recipe.toml", RECIPE)):
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    return tmp_path


def convert(*arguments: str) -> int:
    common = ["--recipe", "recipe.toml", "--plugin", "fakes.py", "--no-record", "--out", "out"]
    return run(["convert", "box.fake", *common, *arguments])


def lines(text: str) -> list[str]:
    return text.strip().splitlines()


def test_a_folder(made: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", str(made)]) == 0
    out, err = capfd.readouterr()
    assert [line.split(":")[0] for line in lines(out)] == [f"ok    {name}" for name in NAMES]
    assert "urdf" in out
    assert err == ""


@pytest.mark.parametrize("kind", KINDS)
def test_a_file(kind: str, made: Path, capfd: pytest.CaptureFixture[str]) -> None:
    suffix = {"urdf": ".urdf", "mjcf": ".xml", "usd": ".usda"}[kind]
    path = next(path for path in (made / kind).iterdir() if path.suffix == suffix and path.stem == "cabinet")
    assert run(["check", str(path), "--json"]) == 0
    document = json.loads(capfd.readouterr().out)
    assert document["ok"] is True
    assert document["files"] == {kind: str(path)}
    assert [check["name"] for check in document["checks"]] == list(NAMES)
    assert document["checks"][4]["evidence"]["shapes"] == 9


def test_urdf_in_a_file_called_xml(made: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(made / "urdf", tmp_path / "urdf")
    path = (tmp_path / "urdf/cabinet.urdf").rename(tmp_path / "urdf/cabinet.xml")
    assert run(["check", str(path), "--json"]) == 0
    assert json.loads(capfd.readouterr().out)["files"] == {"urdf": str(path)}


def test_a_failed_check_is_told_with_its_numbers(
    made: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    asset = cabinet()
    door = asset.part("door")
    assert door.mass is not None
    broken = replace(door, mass=replace(door.mass, inertia=mat3(-np.eye(3))))
    save_asset(asset.with_parts({"door": broken}), tmp_path)
    assert run(["check", str(tmp_path), "--json"]) == 1
    document = json.loads(capfd.readouterr().out)
    assert (document["ok"], document["files"]) == (False, {})
    assert not next(row for row in document["checks"] if row["name"] == "mass")["passed"]
    assert run(["check", str(made), "--set", "checks.settle.tilt=1e-12", "-v"]) == 1
    out = capfd.readouterr().out
    assert "FAIL  settle: it tilts by" in out
    assert "        speed: " in out


def test_thresholds_of_a_recipe(made: Path, home: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (home / "strict.toml").write_text(
        'schema = 1\nextends = "default"\n[checks]\nsweep = false\n[checks.joints]\nmost_turn = 1.0\n'
    )
    assert run(["check", str(made), "--recipe", "strict.toml"]) == 1
    out = capfd.readouterr().out
    assert [line for line in lines(out) if line.startswith("FAIL")] == [
        "FAIL  joints: door_hinge: it travels 1.5 rad, expected 0.018 to 1 rad"
    ]
    assert "sweep" not in out


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("nowhere", None, "nowhere: no such file or folder"),
        ("picture.png", "png", "picture.png: give an output folder of a conversion, or a file of .xml"),
        ("empty", "", "has no asset.json: give the output folder of a conversion"),
    ],
)
def test_mistakes(
    name: str, text: str | None, told: str, home: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    if text:
        (home / name).write_text(text)
    elif text is not None:
        (home / name).mkdir()
    assert run(["check", name]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert len(lines(err)) == 1
    assert told in err


@pytest.mark.parametrize("suffix", [".urdf", ".xml", ".usda", ".usd"])
def test_a_damaged_file_fails_and_says_why_once(
    suffix: str, home: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (home / f"half{suffix}").write_text("<robot><link")
    assert run(["check", f"half{suffix}"]) == 1
    out, err = capfd.readouterr()
    assert "Traceback" not in out + err
    assert sum("cannot be judged, see agreement" in line for line in lines(out)) == len(NAMES) - 3
    assert "[unreadable]" in out
    assert f"half{suffix}" in next(line for line in lines(out) if "agreement:" in line)


@pytest.mark.parametrize("text", ['{"recipe": 3', "[]", '{"recipe": {}}'])
def test_damaged_provenance(text: str, made: Path, home: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for name in ("asset.json", "parts.npz"):
        shutil.copy(made / name, home / name)
    (home / "provenance.json").write_text(text)
    assert run(["check", "."]) == 2
    err = capfd.readouterr().err
    assert "provenance.json" in err
    assert "Traceback" not in err


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("checks.sette.tilt=5", "unknown check 'sette': known are agreement, collision"),
        (
            "checks.settle.tild=5",
            "checks.settle.tild: no such key (got 5), known are height, seconds, speed, tilt, sink",
        ),
    ],
)
def test_unknown_names_list_those_there_are(
    change: str, told: str, made: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["check", str(made), "--set", change]) == 2
    assert told in capfd.readouterr().err


def test_a_check_that_raises_is_a_bug_of_its_plugin(home: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = mjcf(home, '<body name="b"><geom type="box" size="1 1 1"/></body>').files["mjcf"]
    (home / "fakes.py").write_text(
        FAKES + "\n@sk.hookimpl\ndef register_checks(register):\n    register(Broken)\n"
    )
    assert run(["check", str(path), "--plugin", "fakes.py"]) == 1
    err = capfd.readouterr().err
    assert "check 'broken' failed (plugin fakes" in err
    assert "out of ideas" in err
    assert "Traceback" not in err


class TestConvert:
    def test_strict_is_one_with_files_written_where_a_check_fails(
        self, home: Path, capfd: pytest.CaptureFixture[str]
    ) -> None:
        failing = ["--set", "checks.settle.tilt=1e-12"]
        assert convert(*failing) == 0
        assert convert("--strict", *failing) == 1
        assert "FAIL  settle" in capfd.readouterr().out
        assert (home / "out/mjcf/box.xml").is_file()
        assert convert("--strict") == 0

    def test_provenance_repeats_thresholds_and_check_takes_them(
        self, home: Path, capfd: pytest.CaptureFixture[str]
    ) -> None:
        assert convert("--set", "checks.settle.tilt=1e-12") == 0
        recipe = json.loads((home / "out/provenance.json").read_text())["recipe"]
        assert recipe["checks"]["realtime"] is False
        assert recipe["checks"]["settle"]["speed"] == 0.01
        assert recipe["checks"]["settle"]["tilt"] == 1e-12
        capfd.readouterr()
        assert run(["check", "out", "--plugin", "fakes.py"]) == 1
        out = capfd.readouterr().out
        assert "realtime" not in out
        assert "FAIL  settle: it tilts by" in out

    def test_reports_of_two_runs_are_the_same_bytes(self, home: Path) -> None:
        assert convert("--set", "checks.realtime={}") == 0
        first = (home / "out/report.json").read_bytes()
        assert convert("--set", "checks.realtime={}") == 0
        assert (home / "out/report.json").read_bytes() == first
        names = [row["name"] for row in json.loads(first)["checks"]]
        assert names == list(NAMES)
        assert load_asset(home / "out").name == "box"
