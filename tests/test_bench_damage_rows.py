"""Damaged truths and predictions end as rows that name the file, and never score better than a failure."""

from __future__ import annotations

import json
import pickle
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from simart_kit.bench.importing import write_case
from simart_kit.bench.protocols import Metric, protocols
from simart_kit.cli.main import run

from .bench_objects import cabinet, truth
from .bench_predictions import (
    flatten,
    write_anymesh,
    write_labels,
    write_output,
    write_particulate,
    write_urdf,
)

pytestmark = pytest.mark.slow

Change = Callable[[Path], object]
Damage = tuple[str, Change, str]
"""File of a truth or prediction, what is done to it, and what the error says besides the file's name."""

CABINET = cabinet()
HUGE = 1e308


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def write(text: str) -> Change:
    return lambda path: path.write_text(text)


def edit(change: Callable[[Any], object]) -> Change:
    """Change what a JSON file holds, in place; NaN is written as NaN."""

    def done(path: Path) -> None:
        table = json.loads(path.read_text())
        change(table)
        path.write_text(json.dumps(table))

    return done


def put(*keys: str | int, to: Any) -> Change:
    """Set a value inside a JSON file."""

    def change(table: Any) -> None:
        for key in keys[:-1]:
            table = table[key]
        table[keys[-1]] = to

    return edit(change)


def swap(old: str, new: str) -> Change:
    """Replace text that a file has."""

    def done(path: Path) -> None:
        text = path.read_text()
        assert re.search(old, text)
        path.write_text(re.sub(old, new, text, count=1))

    return done


def arrays(**changed: Callable[[Any], Any]) -> Change:
    """Replace arrays of an .npz by what is made of them."""

    def done(path: Path) -> None:
        with np.load(path) as stored:
            found = dict(stored)
        np.savez(path, **(found | {name: make(found[name]) for name, make in changed.items()}))

    return done


def array(make: Callable[[Any], Any]) -> Change:
    return lambda path: np.save(path, make(np.load(path)))


def at(index: Any, value: Any) -> Callable[[Any], Any]:
    """A copy of an array with one value set."""

    def made(values: Any) -> Any:
        values = np.array(values)
        values[index] = value
        return values

    return made


def pickled(path: Path) -> None:
    """An archive whose array is a Python object."""
    np.savez(path, allow_pickle=True, face_part=np.array([{"a": 1}], dtype=object))


DOOR = ("parts", 1, "joint")
TRUTHS: dict[str, Damage] = {
    "no table": ("gt.json", Path.unlink, ""),
    "no labels": ("gt.npz", Path.unlink, "no such file"),
    "no mesh": ("input.glb", Path.unlink, "no mesh 'input'"),
    "table cut": ("gt.json", cut, "cannot be read as JSON"),
    "labels cut": ("gt.npz", cut, "cannot be read"),
    "mesh cut": ("input.glb", cut, "cannot be read"),
    "empty table": ("gt.json", write(""), "cannot be read as JSON"),
    "too few labels": ("gt.npz", arrays(face_part=lambda a: a[:-1]), "47 faces, but input.glb has 48"),
    "label of no part": ("gt.npz", arrays(face_part=at(7, 99)), "labels 99 are no part's id"),
    "negative label": ("gt.npz", arrays(face_part=at(7, -2)), "labels -2 are no part's id"),
    "huge label": ("gt.npz", arrays(face_part=lambda a: a.astype(np.int64) + 2**40), "beyond 32 bits"),
    "odd array": ("gt.npz", lambda path: np.savez(path, other=np.arange(48)), "no array 'face_part'"),
    "pickled array": ("gt.npz", pickled, "Python objects"),
    "pickle": ("gt.npz", lambda path: path.write_bytes(pickle.dumps({"face_part": [0]})), "Python objects"),
    "unknown kind": ("gt.json", put(*DOOR, "type", to="screw"), "joint.type"),
    "kind nobody said": ("gt.json", put(*DOOR, "type", to="unknown"), "door_left"),
    "nan axis": ("gt.json", put(*DOOR, "axis", to=[float("nan"), 0, 0]), "joint.axis"),
    "zero axis": ("gt.json", put(*DOOR, "axis", to=[0, 0, 0]), "axis"),
    "no axis": ("gt.json", put(*DOOR, "axis", to=None), "needs an axis"),
    "huge axis": ("gt.json", put(*DOOR, "axis", to=[HUGE, 0, 0]), "joint.axis"),
    "huge origin": ("gt.json", put(*DOOR, "origin", to=[10**400, 0, 0]), "joint.origin"),
    "huge limit": ("gt.json", put(*DOOR, "upper", to=HUGE), "joint.upper"),
    "loop": ("gt.json", put("parts", 0, "parent", to=1), "loop of parents"),
    "unknown parent": ("gt.json", put("parts", 1, "parent", to=77), "no parent with id 77"),
    "id twice": ("gt.json", put("parts", 1, "id", to=2), "part id 2 is used twice"),
    "reversed limits": ("gt.json", put(*DOOR, "lower", to=1.0), "lower limit 1.0 is above the upper"),
    "no parts": ("gt.json", put("parts", to=[]), "parts"),
    "table is a list": ("gt.json", write("[]"), "dictionary"),
    "table is a number": ("gt.json", write("7"), "dictionary"),
}  # fmt: skip


def crossed(table: Any) -> None:
    """Let the two doors carry each other."""
    for joint, other in zip(table["joints"][:2], table["joints"][1::-1], strict=True):
        joint["parent"] = other["child"]


JOINT = ("joints", 0)
HINGE = '<joint name="left_hinge" type="revolute">'
LOOP = HINGE + '<parent link="door_right"/><child link="body"/></joint>'
OUTPUTS: dict[str, Damage] = {
    "nan axis": ("asset.json", put(*JOINT, "axis", to=[float("nan"), 0, 1]), "joints.0.axis"),
    "unknown kind": ("asset.json", put(*JOINT, "kind", to="screw"), "joints.0.kind"),
    "loop": ("asset.json", edit(crossed), ""),
    "no root": ("asset.json", put(*JOINT, "child", to="body"), ""),
    "huge origin": ("asset.json", put(*JOINT, "origin", to=[HUGE, 0, 0]), ""),
    "no way back": ("asset.json", put("asset_from_source", to=[[0] * 4] * 4), "asset_from_source"),
    "table is a list": ("asset.json", write("[]"), ""),
    "table cut": ("asset.json", cut, ""),
    "too few labels": ("parts.npz", arrays(face_part=lambda a: a[:-1]), "face_part"),
    "label of no part": ("parts.npz", arrays(face_part=at(3, 9)), "face_part"),
    "nan vertex": ("parts.npz", arrays(vertices=at((3, 0), np.nan)), ""),
    "no arrays": ("parts.npz", Path.unlink, "no such file"),
    "arrays cut": ("parts.npz", cut, ""),
}
URDFS: dict[str, Damage] = {
    "no mesh": ("1.obj", Path.unlink, "no such mesh file"),
    "mesh cut": ("1.obj", write("v 0 0 0\nv 1 0"), "fewer than three numbers"),
    "nan vertex": ("1.obj", swap(r"v \S+", "v nan"), "NaN"),
    "loop": ("NAME.urdf", swap('<parent link="body"/>', '<parent link="door_left"/>'), "loop"),
    "loop through the root": ("NAME.urdf", swap("</robot>", LOOP + "</robot>"), "loop"),
    "unknown parent": ("NAME.urdf", swap('<parent link="body"/>', '<parent link="b"/>'), "does not exist"),
    "unknown kind": ("NAME.urdf", swap('type="revolute"', 'type="screw"'), "type 'screw'"),
    "nan axis": ("NAME.urdf", swap('axis xyz="[^"]*"', 'axis xyz="0 nan 0"'), "0 nan 0"),
    "zero axis": ("NAME.urdf", swap('axis xyz="[^"]*"', 'axis xyz="0 0 0"'), "axis"),
    "huge limit": ("NAME.urdf", swap('upper="[^"]*"', 'upper="1e308"'), "limit 1e+308"),
    "huge origin": ("NAME.urdf", swap('origin xyz="[^"]*"', 'origin xyz="1e308 0 0"'), ""),
    "cut": ("NAME.urdf", cut, "XML"),
    "entities": ("NAME.urdf", swap("^", '<!DOCTYPE robot [<!ENTITY a "b">]>'), "DOCTYPE"),
}  # fmt: skip
PARTICULATES: dict[str, Damage] = {
    "no mesh": ("pred.obj", Path.unlink, "no such mesh file"),
    "too few labels": ("pred.npz", arrays(face_part_ids=lambda a: a[:-1]), "47 values for 48 faces"),
    "label of no part": ("pred.npz", arrays(face_part_ids=at(0, 4)), "none of 0..3"),
    "nan axis": ("pred.npz", arrays(revolute_plucker=at((1, 0), np.nan)), "NaN"),
    "zero axis": ("pred.npz", arrays(revolute_plucker=np.zeros_like), "axis"),
    "loop": ("pred.npz", arrays(motion_hierarchy=lambda a: np.array([[0, 1], [1, 0], [0, 2]])), "loop"),
    "two parents": ("pred.npz", arrays(motion_hierarchy=at(1, (3, 1))), "two parents"),
    "huge range": ("pred.npz", arrays(prismatic_range=lambda a: a * HUGE), "limit"),
    "cut": ("pred.npz", cut, ""),
}
ANYMESHES: dict[str, Damage] = {
    "cut": ("mobility.json", cut, "JSON"),
    "nan axis": ("mobility.json", put(1, "jointData", "axis", "direction", to=[0, 0, float("nan")]), ""),
    "unknown kind": ("mobility.json", put(1, "joint", to="screw"), "screw"),
    "loop": ("mobility.json", put(0, "parent", to="drawer"), "loop"),
    "no parts": ("mobility.json", write("[]"), "no parts"),
    "no meshes": ("mesh_parts", shutil.rmtree, "no .glb"),
    "mesh cut": ("mesh_parts/drawer.glb", cut, "cannot be read"),
}
LABELS: dict[str, Damage] = {
    "too few": (".npy", array(lambda a: a[:-1]), "labels 47 faces, but the truth has 48"),
    "fractions": (".npy", array(lambda a: a + 0.5), "fractions"),
    "nan": (".npy", array(lambda a: a * np.nan), "NaN"),
    "negative": (".npy", array(at(5, -9)), "label -9"),
    "of no part": (".npy", array(at(5, 9)), "labels 9 are no part's id"),
    "a table of them": (".npy", array(lambda a: a.reshape(4, 12)), "shape"),
    "cut": (".npy", cut, ""),
    "pickle": (".npy", lambda path: np.save(path, np.array([{}]), allow_pickle=True), "Python objects"),
    "joints cut": (".json", cut, "JSON"),
    "nan axis": (".json", put(*DOOR, "axis", to=[float("nan"), 0, 0]), "joint.axis"),
    "unknown parent": (".json", put("parts", 1, "parent", to=77), "no parent with id 77"),
}  # fmt: skip
WRITERS: dict[str, tuple[Callable[..., None], dict[str, Damage]]] = {
    "output": (write_output, OUTPUTS),
    "urdf": (partial(write_urdf, file_from_truth=np.eye(4)), URDFS),
    "particulate": (write_particulate, PARTICULATES),
    "anymesh": (write_anymesh, ANYMESHES),
    "labels": (write_labels, LABELS),
}


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """`data` and `predictions` of cabinets; each but those called whole and honest has one damage."""
    home = tmp_path_factory.mktemp("damaged")
    data, predictions = home / "data", home / "predictions"
    write_case(truth(CABINET, "cabinet"), home / "cabinet")
    for damage, (file, change, _) in TRUTHS.items():
        write_labels(predictions, f"truth {damage}", CABINET)
        change(shutil.copytree(home / "cabinet", data / f"truth {damage}") / file)
    for kind, (write_prediction, damages) in WRITERS.items():
        write_prediction(predictions, f"{kind} whole", CABINET)
        shutil.copytree(home / "cabinet", data / f"{kind} whole")
        for damage, (file, change, _) in damages.items():
            name = f"{kind} {damage}"
            write_prediction(predictions, name, CABINET)
            shutil.copytree(home / "cabinet", data / name)
            change(
                predictions / (name + file if kind == "labels" else f"{name}/{file.replace('NAME', name)}")
            )
    honest = replace(CABINET, labels=np.zeros(48, int), links=CABINET.links[:1])
    write_labels(predictions, "honest", honest)
    for name in ("honest", "no prediction"):
        shutil.copytree(home / "cabinet", data / name)
    return home


def expected_errors() -> dict[str, tuple[str, str]]:
    """By name of each damaged object: the file that its error has to name, and what else it has to say."""
    found = {f"truth {damage}": (file, said) for damage, (file, _, said) in TRUTHS.items()}
    for kind, (_, damages) in WRITERS.items():
        for damage, (file, _, said) in damages.items():
            name = f"{kind} {damage}"
            found[name] = (name + file if kind == "labels" else file.replace("NAME", name), said)
    found["truth no mesh"] = ("truth no mesh", "has no mesh 'input'")
    return found | {"no prediction": ("predictions", "no prediction for 'no prediction'")}


def is_better(metric: Metric, mine: float | None, other: float | None) -> bool:
    matched_only = metric.key.endswith(("_matched", "_nopunish"))
    if mine is None or other is None or not metric.better or matched_only:
        return False
    return mine > other + 1e-9 if metric.better == "higher" else mine < other - 1e-9


@pytest.mark.parametrize("protocol", protocols())
def test_damage_is_a_row_that_says_so_and_gains_nothing(home, tmp_path, capfd, protocol):
    command = ["bench", "score", str(home / "data"), str(home / "predictions"), "--fit", "box", "-j", "2"]
    # A protocol is not told why an object failed: of the others, some of each side are enough.
    chosen = ("* cut", "truth no*", "truth *axis", "urdf no*", "no prediction", "honest", "labels whole")
    only = [] if protocol == "simart" else [word for name in chosen for word in ("--only", name)]

    code = run([*command, *only, "--out", str(tmp_path), "--no-pictures", "--protocol", protocol])

    out, err = capfd.readouterr()
    assert code == 0
    assert "Traceback" not in out + err
    rows = {row["name"]: row for row in json.loads((tmp_path / "results.json").read_text())["rows"]}
    expected = {name: told for name, told in expected_errors().items() if name in rows or not only}
    wrong = []
    for name, (file, said) in expected.items():
        row = rows.get(name, {"status": "no row", "error": ""})
        folder = f"{name}/" if name.startswith("output ") else file  # its two files are one value
        if row["status"] != "failed" or folder not in row["error"] or said not in row["error"]:
            wrong.append(f"{name}: {row['status']}: {row['error']}")
        if "Error:" in row["error"] or "\n" in row["error"]:
            wrong.append(f"{name}: not told as bad input: {row['error']}")
        wrong += [
            f"{name}: {metric.key} is better than that of '{other}'"
            for other in ("honest", f"{name.split()[0]} whole")
            for metric in protocols()[protocol].metrics
            if name in rows and other in rows
            if is_better(metric, row["scores"][metric.key], rows[other]["scores"][metric.key])
        ]
    assert not wrong, "\n".join(wrong)
    scored = {name for name, row in rows.items() if row["status"] == "scored"}
    assert scored == {name for name in rows if name == "honest" or name.endswith(" whole")}


@pytest.mark.parametrize("protocol", protocols())
def test_a_mesh_without_surface_fails_under_every_protocol(tmp_path, protocol):
    for name in ("predicted", "true"):
        write_case(truth(CABINET), tmp_path / "data" / name)
        write_urdf(tmp_path / "predictions", name, CABINET, np.eye(4))
    for path in (tmp_path / "predictions" / "predicted").glob("*.obj"):
        flatten(path, (1, 0, 0))
    flatten(tmp_path / "data" / "true" / "input.glb", (1, 0, 0))
    places = [str(tmp_path / folder) for folder in ("data", "predictions")]

    code = run(
        ["bench", "score", *places, "--no-pictures", "--protocol", protocol, "-o", str(tmp_path / "o")]
    )

    predicted, true = json.loads((tmp_path / "o" / "results.json").read_text())["rows"]
    assert (code, predicted["status"], true["status"]) == (1, "failed", "failed")
    assert "predicted.urdf" in predicted["error"]
    assert "input.glb" in true["error"]
