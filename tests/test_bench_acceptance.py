"""The bench through its command line: seeded faults, real objects and odd folders in every format."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.bench.importing import write_case
from simart_kit.cli.main import run

from .bench_objects import cabinet, truth
from .bench_predictions import (
    Z_UP,
    Row,
    flatten,
    write_anymesh,
    write_labels,
    write_output,
    write_particulate,
    write_urdf,
)
from .real_objects import DATA, needs_data
from .test_bench_simart import CHANGED, FAULTS, PERFECT, wardrobe

pytestmark = pytest.mark.slow

# Joint numbers that a fault may change; those of shape only where both meshes are the same faces.
JOINT_NUMBERS = (
    "type",
    "type_coarse",
    "axis",
    "direction",
    "origin",
    "origin_line",
    "limits_iou",
    "hierarchy",
)


def bench_score(
    data: Path, predictions: Path, out: Path, *options: str, code: int = 0
) -> dict[str, dict[str, Any]]:
    """Score without pictures; the rows of results.json by name."""
    command = ["bench", "score", str(data), str(predictions), "--out", str(out), "--no-pictures"]
    assert run([*command, *options]) == code
    rows = json.loads((out / "results.json").read_text())["rows"]
    return {row["name"]: row for row in rows}


# --- seeded faults ----------------------------------------------------------------------------------------

SEEDED = (
    "nothing", "shifted origin", "flipped axis", "wrong type", "body only", "merged doors",
    "one part split in two", "reversed limits", "mirrored hinge",
)  # fmt: skip
NOT_AS_OUTPUT = ("reversed limits",)  # its limits run from lower to upper
FORMATS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "labels": (write_labels, ()),
    "urdf": (write_urdf, ("--up", "+z")),
    "output": (write_output, ()),
}


@pytest.fixture(scope="module")
def fault_rows(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Row]]:
    """By format and fault, the row of a wardrobe of which a prediction has that fault."""
    home = tmp_path_factory.mktemp("faults")
    true = Truth("wardrobe", wardrobe(), up="+z")
    to_file = np.linalg.inv(Z_UP)  # objects are written +Y up
    for fault in SEEDED:
        predicted = FAULTS[fault][0].transformed(to_file)
        write_case(true, home / "data" / fault)
        for name, (write, _) in FORMATS.items():
            if name != "output" or fault not in NOT_AS_OUTPUT:
                write(home / name, fault, predicted)
    return {
        name: bench_score(home / "data", home / name, home / "out" / name, "-j", "2", *options)
        for name, (_, options) in FORMATS.items()
    }


@pytest.mark.parametrize(("name", "fault"), list(product(FORMATS, SEEDED)))
def test_a_fault_scores_in_every_format_as_worked_out_by_hand(fault_rows, name, fault):
    if name == "output" and fault in NOT_AS_OUTPUT:
        assert fault_rows[name][fault]["status"] == "failed"
        return
    row = fault_rows[name][fault]
    assert row["status"] == "scored", row["error"]
    for key, value in {**PERFECT, **FAULTS[fault][1]}.items():
        if value == CHANGED:
            continue
        near = 0.03 if name == "urdf" and key not in JOINT_NUMBERS else 1e-4
        expected = None if value is None else pytest.approx(value, abs=near)
        assert row["scores"][key] == expected, key


# --- real objects -----------------------------------------------------------------------------------------

REAL = ("painted_wooden_cabinet_02", "jsk_fridge")
REAL_FORMATS = FORMATS | {
    "particulate": (write_particulate, ()),
    "anymesh": (write_anymesh, ("--fit", "box")),
}


@pytest.fixture(scope="module")
def real_rows(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Row]]:
    home = tmp_path_factory.mktemp("real")
    (home / "data").mkdir()
    for name in REAL:
        (home / "data" / name).symlink_to(DATA / name)
        known = SimartBench().read(DATA / name).articulation
        for kind, (write, _) in REAL_FORMATS.items():
            write(home / kind, name, known)
    return {
        kind: bench_score(home / "data", home / kind, home / "out" / kind, "-j", "2", *options)
        for kind, (_, options) in REAL_FORMATS.items()
    }


@needs_data
@pytest.mark.parametrize(("kind", "name"), list(product(REAL_FORMATS, REAL)))
def test_the_truth_of_a_real_object_given_back_scores_perfect(real_rows, kind, name):
    row = real_rows[kind][name]
    assert row["status"] == "scored", row["error"]
    scores = row["scores"]
    assert [scores[k] for k in ("type", "type_matched", "hierarchy", "precision", "recall", "f1")] == [1] * 6
    assert scores["axis"] < 1e-6
    assert scores["iou"] > 0.99
    assert scores["body_iou"] > 0.99
    assert scores["cd"] < 0.02
    # A line holds no point, and Articulate-AnyMesh no limits.
    assert scores["origin_line"] < 1e-6
    if kind != "particulate":
        assert scores["origin"] < 1e-6
    if kind != "anymesh":
        assert scores["limits_iou"] == pytest.approx(1.0, abs=1e-6)
        assert scores["direction"] < 1e-6
        assert scores["articulated_giou"] > 0.99


# --- odd names, folders and shapes ------------------------------------------------------------------------

NAMES = ("with space", "ünïcödé 椅子", "v1.0.glb", "-dash", "#[br]&c", "100%", "x" * 200)
CABINET = cabinet()


def write_pair(home: Path, name: str, predicted: Articulation, true: Articulation = CABINET) -> None:
    """An object and a URDF of it, in one frame."""
    write_case(truth(true), home / "data" / name)
    write_urdf(home / "predictions", name, predicted, np.eye(4))


def test_objects_may_have_any_name_and_the_same_one(tmp_path):
    for name in NAMES:
        write_case(truth(CABINET), tmp_path / "data" / name)
        write_labels(tmp_path / "predictions", name, CABINET)
    for room in ("kitchen", "hall"):
        write_case(truth(CABINET), tmp_path / "data" / room / "twin")
        write_output(tmp_path / "predictions", f"{room}_twin", CABINET)

    rows = bench_score(tmp_path / "data", tmp_path / "predictions", tmp_path / "out", "-q", "-j", "2")

    assert set(rows) == {*NAMES, "kitchen_twin", "hall_twin"}
    assert {row["scores"]["type"] for row in rows.values()} == {1.0}
    page = (tmp_path / "out" / "report.html").read_text()
    assert "ünïcödé 椅子" in page
    assert "#[br]&amp;c" in page


def test_it_does_not_matter_how_the_data_folder_is_given(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a", "b"):
        write_pair(tmp_path, name, CABINET)
    (tmp_path / "link").symlink_to("data")
    first = bench_score(tmp_path / "data", Path("predictions"), Path("out"), "-q")
    done = {path: path.stat().st_mtime_ns for path in Path("out").rglob("row.json")}

    for same in ("data/", "./data", "link", "link/../data/"):
        assert run(["bench", "score", same, "predictions/", "-o", "out/", "--no-pictures", "-q"]) == 0

    again = {row["name"]: row for row in json.loads(Path("out/results.json").read_text())["rows"]}
    assert again == first
    assert {path: path.stat().st_mtime_ns for path in Path("out").rglob("row.json")} == done


def test_a_run_compared_with_itself_differs_in_nothing(tmp_path, capfd):
    write_pair(tmp_path, "a", CABINET)
    write_pair(tmp_path, "b", replace(CABINET, labels=np.zeros(48, int)))
    out = tmp_path / "out"
    bench_score(tmp_path / "data", tmp_path / "predictions", out, "-q")

    assert run(["bench", "compare", str(out), str(out), "--json"]) == 0

    changes = json.loads(capfd.readouterr().out)["metrics"]
    assert changes
    assert {change["difference"] for change in changes} <= {0.0, None}
    assert {change["verdict"] for change in changes} <= {"no clear difference", ""}
    shutil.rmtree(out / "objects")
    assert run(["bench", "report", str(out)]) == 0
    assert run(["bench", "compare", str(out), str(out)]) == 2
    assert "nothing to compare" in capfd.readouterr().err


def test_odd_shapes_are_scored_or_say_what_is_wrong(tmp_path):
    flap = Link("flap", 0, LinkJoint("revolute", (0, 1, 0), (0, 0, 0), 0.0, 1.0))
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    triangle = Articulation("triangle", corners, np.array([[0, 1, 2]]), np.array([1]), (Link("body"), flap))
    ghost = replace(CABINET, links=(*CABINET.links, flap))
    write_pair(tmp_path, "triangle", triangle, triangle)
    write_pair(tmp_path, "ghost in truth", CABINET, ghost)
    write_pair(tmp_path, "ghost predicted", ghost)
    write_pair(tmp_path, "large", CABINET.transformed(np.diag([1000.0, 1000.0, 1000.0, 1.0])))
    for name in ("flat", "no surface", "point"):
        write_pair(tmp_path, name, CABINET)
    for path in (tmp_path / "predictions" / "flat").glob("*.obj"):
        flatten(path, (1, 0, 0))
    flatten(tmp_path / "data" / "no surface" / "input.glb", (1, 0, 0))
    flatten(tmp_path / "data" / "point" / "input.glb", (0, 0, 0))

    rows = bench_score(tmp_path / "data", tmp_path / "predictions", tmp_path / "out", "-q", "-j", "2")

    for name in ("triangle", "ghost in truth", "ghost predicted"):
        found = [rows[name]["scores"][key] for key in ("type", "iou", "f1", "recall")]
        assert found == pytest.approx([1.0] * 4), name
    # A thousand times as large lies nowhere near: nothing is found.
    assert [rows["large"]["scores"][key] for key in ("type", "iou", "f1")] == [0.0] * 3
    assert any("box differs from the truth's" in note for note in rows["large"]["notes"])
    for name in ("flat", "no surface", "point"):
        assert rows[name]["status"] == "failed", name
        assert [rows[name]["scores"][key] for key in ("type", "iou", "f1")] == [0.0] * 3, name
        assert min(rows[name]["scores"][key] for key in ("origin", "cd", "articulated_cd")) > 0.4, name


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--jobs", "-1"], "--jobs"),
        (["--jobs", "abc"], "--jobs"),
        (["--only", "fridge*"], "no object is called fridge*: there are a"),
        (["--protocol", "simrat"], "unknown protocol 'simrat'"),
        (["--out", "data"], "data is not empty and no benchmark run"),
        (["--out", "predictions"], "predictions is not empty and no benchmark run"),
        (["--out", "data/a/gt.json/out"], "cannot write to output folder data/a/gt.json/out"),
        (["--variant", "fused"], "no object has the variant 'fused'"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_a_mistake_is_one_line_and_harms_nothing(tmp_path, monkeypatch, capfd, options, told):
    monkeypatch.chdir(tmp_path)
    write_pair(tmp_path, "a", CABINET)
    before = sorted(path for path in tmp_path.rglob("*") if path.is_file())

    code = run(["bench", "score", "data", "predictions", "-q", "--no-pictures", *options])

    (line,) = capfd.readouterr().err.splitlines()
    assert line.startswith("error: ")
    assert told in line
    assert code == 2
    assert set(before) <= set(tmp_path.rglob("*"))
