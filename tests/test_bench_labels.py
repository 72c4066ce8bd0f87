"""Readers of predictions: labels of faces, and Articulate-AnyMesh."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from simart_kit.bench.articulation import Articulation, LinkJoint
from simart_kit.bench.formats.articulate_anymesh import ArticulateAnyMesh
from simart_kit.bench.formats.labels import LabelArray
from simart_kit.bench.importing import write_case
from simart_kit.errors import BadInputError

from .bench_objects import BODY, DOOR_LEFT, DOOR_RIGHT, DRAWER, block, cabinet, truth

CABINET = truth(cabinet(), "cabinet")


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """The cabinet as a SIMART-Bench folder."""
    write_case(CABINET, tmp_path / "data" / "cabinet")
    return tmp_path / "data" / "cabinet"


# --- labels -----------------------------------------------------------------------------------------------


def save_labels(path: Path, labels: Any) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, np.asarray(labels))
    return path


def test_labels_with_joints_are_a_whole_prediction(case: Path) -> None:
    path = save_labels(case.parent / "cabinet.npy", CABINET.articulation.labels)
    shutil.copy(case / "gt.json", case.parent / "cabinet.json")
    assert LabelArray().find(case.parent, "cabinet") == path
    read = LabelArray().read(path, CABINET)
    assert read.articulation.links == CABINET.articulation.links
    np.testing.assert_array_equal(read.articulation.labels, CABINET.articulation.labels)


def test_labels_alone_move_on_the_largest_in_an_unknown_way(tmp_path: Path) -> None:
    # Areas: body 4, doors 0.8 each, drawer 0.55. Label 9 is the body; the right door has none.
    mine = np.array([9, 5, -2, 7])[CABINET.articulation.labels]
    read = LabelArray().read(save_labels(tmp_path / "labels.npy", mine.astype(float)), CABINET)
    links = read.articulation.links
    assert [(link.name, link.joint.kind, link.parent) for link in links] == [
        ("label_5", "unknown", 2),
        ("label_7", "unknown", 2),
        ("label_9", "fixed", -1),
    ]
    expected = np.array([2, 0, -1, 1])[CABINET.articulation.labels]
    np.testing.assert_array_equal(read.articulation.labels, expected)
    assert "no joints given" in read.notes[0]


def test_no_label_at_all_is_a_static_prediction(tmp_path: Path) -> None:
    read = LabelArray().read(save_labels(tmp_path / "a.npy", np.full(48, -1)), CABINET)
    assert read.articulation.is_static


@pytest.mark.parametrize(
    ("there", "chosen"),
    [
        (("labels.npy", "face_ids.npy", "x.npy"), "labels.npy"),
        (("face_ids.npy", "cabinet_face_ids.npy"), "face_ids.npy"),
        (("cabinet_face_ids.npy", "other_face_ids.npy"), "cabinet_face_ids.npy"),
        (("mesh_face_ids.npy", "mesh_aabb.npy"), "mesh_face_ids.npy"),
        (("anything.npy",), "anything.npy"),
        (("a.npy", "b.npy"), None),
    ],
)
def test_the_label_file_of_a_folder(tmp_path: Path, there: tuple[str, ...], chosen: str | None) -> None:
    for name in there:
        save_labels(tmp_path / "cabinet" / name, [0])
    expected = None if chosen is None else tmp_path / "cabinet" / chosen
    assert LabelArray().find(tmp_path, "cabinet") == expected


@pytest.mark.parametrize(
    ("labels", "told"),
    [
        (np.zeros(47, dtype=int), "labels 47 faces, but the truth has 48"),
        (np.full(48, 0.5), "with fractions or NaN"),
        (np.full(48, np.nan), "with fractions or NaN"),
        (np.zeros((48, 1), dtype=int), r"shape \(48, 1\)"),
        (np.full(48, -3), "has label -3"),
        (np.full(48, 2**40), "beyond 32 bits"),
        (np.array(["a"] * 48), "whole numbers are needed"),
    ],
)
def test_labels_that_cannot_be_are_refused(tmp_path: Path, labels: Any, told: str) -> None:
    path = save_labels(tmp_path / "cabinet.npy", labels)
    with pytest.raises(BadInputError, match=told) as error:
        LabelArray().read(path, CABINET)
    assert str(path) in str(error.value)


def test_python_objects_and_too_many_labels_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.array([{}] * 48, dtype=object), allow_pickle=True)
    with pytest.raises(BadInputError, match=r"a.npy cannot be read .* holds Python objects"):
        LabelArray().read(tmp_path / "a.npy", CABINET)
    many = block()
    many = Articulation(
        "many", many.vertices, np.tile(many.faces, (1000, 1)), np.zeros(12000, dtype=int), many.links
    )
    with pytest.raises(BadInputError, match="12000 labels: more than 1000"):
        LabelArray().read(save_labels(tmp_path / "b.npy", np.arange(12000)), truth(many))


def test_labels_without_a_part_in_the_joints_file_are_told(case: Path) -> None:
    path = save_labels(case / "labels.npy", np.full(48, 8))
    shutil.copy(case / "gt.json", case / "joints.json")
    with pytest.raises(BadInputError, match=r"joints.json: labels 8 are no part's id"):
        LabelArray().read(path, CABINET)


def test_reversed_limits_of_a_prediction_are_kept(case: Path) -> None:
    path = save_labels(case / "labels.npy", CABINET.articulation.labels)
    shutil.copy(case / "gt.json", case / "labels.json")
    table = json.loads((case / "labels.json").read_text())
    table["parts"][DRAWER]["joint"]["lower"] = 0.4
    (case / "labels.json").write_text(json.dumps(table))
    assert LabelArray().read(path, CABINET).articulation.links[DRAWER].joint.lower == 0.4


# --- Articulate-AnyMesh -----------------------------------------------------------------------------------


def anymesh_rows() -> list[dict[str, Any]]:
    """The cabinet as the system would say it: ids by place, base last, parents by name."""
    door: dict[str, Any] = {"parent": "base", "joint": "revolute"}
    return [
        door | {"id": 0, "name": "door@0", "jointData": _axis([-0.5, 0.4, 0.25], [0, 2, 0])},
        door | {"id": 1, "name": "door@1", "jointData": _axis([0.5, 0.4, 0.25], [0, 1, 0])},
        {
            "id": 2,
            "name": "drawer@0",
            "parent": "base",
            "joint": "prismatic",
            "jointData": _axis([0, 0, 0], [0, 0, 1]),
        },
        {"id": 3, "name": "base", "parent": None, "joint": "fixed", "jointData": {}},
    ]


def _axis(origin: list[float], direction: list[float]) -> dict[str, Any]:
    return {"axis": {"origin": origin, "direction": direction}}


def write_anymesh(folder: Path, rows: list[dict[str, Any]], stems: tuple[str, ...]) -> Path:
    """A prediction for the cabinet; `stems` name the files of the body, the doors and the drawer."""
    (folder / "mesh_parts").mkdir(parents=True)
    whole = CABINET.articulation
    for index, stem in enumerate(stems):
        part = trimesh.Trimesh(whole.vertices, whole.faces[whole.labels == index], process=False)
        part.export(folder / "mesh_parts" / f"{stem}.glb")
    (folder / "mobility.json").write_text(json.dumps(rows))
    return folder


NAMES = ("base", "door@0", "door@1", "drawer@0")


@pytest.mark.parametrize("stems", [NAMES, ("3", "0", "1", "2")])
def test_parts_and_joints_of_articulate_anymesh(tmp_path: Path, stems: tuple[str, ...]) -> None:
    path = write_anymesh(tmp_path / "cabinet", anymesh_rows(), stems)
    assert ArticulateAnyMesh().find(tmp_path, "cabinet") == path
    read = ArticulateAnyMesh().read(path, CABINET)
    links = read.articulation.links
    assert [(link.name, link.label, link.parent) for link in links] == [
        ("door@0", "door", 3),
        ("door@1", "door", 3),
        ("drawer@0", "drawer", 3),
        ("base", "base", -1),
    ]
    assert links[0].joint == LinkJoint("revolute", (0, 1, 0), (-0.5, 0.4, 0.25))
    assert links[2].joint == LinkJoint("prismatic", (0, 0, 1))  # the origin of a slide says nothing
    for index, part in enumerate((DOOR_LEFT, DOOR_RIGHT, DRAWER, BODY)):
        mine = read.articulation.triangles[read.articulation.labels == index]
        true = CABINET.articulation.triangles[CABINET.articulation.labels == part]
        np.testing.assert_allclose(mine, true, atol=1e-6)


@pytest.mark.parametrize(
    ("word", "kind"),
    [
        ("hinge", "revolute"),
        ("slider", "prismatic"),
        ("Static", "fixed"),
        ("heavy", "fixed"),
        ("free", "free"),
    ],
)
def test_partnet_words_for_joints_are_understood(tmp_path: Path, word: str, kind: str) -> None:
    rows = anymesh_rows()
    rows[0]["joint"], rows[0]["parent"] = word, 3
    read = ArticulateAnyMesh().read(write_anymesh(tmp_path, rows, NAMES), CABINET)
    assert (read.articulation.links[0].joint.kind, read.articulation.links[0].parent) == (kind, 3)


def test_partnet_mobility_is_not_taken_for_it(tmp_path: Path) -> None:
    path = write_anymesh(tmp_path / "cabinet", anymesh_rows(), NAMES)
    (path / "mobility_v2.json").write_text("[]")
    assert ArticulateAnyMesh().find(tmp_path, "cabinet") is None


def test_files_without_parts_and_still_parts_without_files_are_noted(tmp_path: Path) -> None:
    rows = anymesh_rows()
    next(row for row in rows if row["name"] == "door@1").update(joint="fixed")
    path = write_anymesh(tmp_path, rows, ("base", "door@0", "spare", "drawer@0"))
    notes = ArticulateAnyMesh().read(path, CABINET).notes
    assert notes[1:] == ("part 'door@1' has no mesh", "spare.glb is of no part: left out")


def test_a_moving_part_without_a_file_is_refused(tmp_path: Path) -> None:
    path = write_anymesh(tmp_path, anymesh_rows(), ("base", "door@0", "drawer@0"))
    with pytest.raises(BadInputError, match="part 'door@1' moves and has no mesh"):
        ArticulateAnyMesh().read(path, CABINET)


ANYMESH_FAULTS: dict[str, tuple[Callable[[Any], object], str]] = {
    "word": (lambda t: t[0].update(joint="screw"), "part 'door@0': joint 'screw' is not one of fixed"),
    "axis": (lambda t: t[0].update(jointData={}), "part 'door@0': .*needs an axis"),
    "parent": (lambda t: t[0].update(parent="attic"), "part 'door@0': there is no parent 'attic'"),
    "loop": (lambda t: t[3].update(parent="door@0"), "form a loop"),
    "twice": (lambda t: t[1].update(name="door@0"), "part name door@0 is used twice"),
    "NaN": (lambda t: t[1].update(jointData=_axis([0, 0, 0], [math.nan, 0, 0])), "part 1.jointData.axis"),
    "empty": (lambda t: t.clear(), "it lists no parts"),
}


@pytest.mark.parametrize("fault", ANYMESH_FAULTS)
def test_a_wrong_mobility_table_is_told(tmp_path: Path, fault: str) -> None:
    change, told = ANYMESH_FAULTS[fault]
    rows = anymesh_rows()
    change(rows)
    path = write_anymesh(tmp_path, rows, NAMES)
    with pytest.raises(BadInputError, match=told) as error:
        ArticulateAnyMesh().read(path, CABINET)
    assert str(path / "mobility.json") in str(error.value)


def test_missing_part_meshes_are_told(tmp_path: Path) -> None:
    path = write_anymesh(tmp_path, anymesh_rows(), ("x",))
    with pytest.raises(BadInputError, match=r"mesh_parts has no .glb named like a part"):
        ArticulateAnyMesh().read(path, CABINET)
    shutil.rmtree(path / "mesh_parts")
    with pytest.raises(BadInputError, match=r"mesh_parts has no .glb named like a part"):
        ArticulateAnyMesh().read(path, CABINET)
