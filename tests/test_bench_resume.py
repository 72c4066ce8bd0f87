"""A run gone on with after files have changed, and mistakes told once before anything is written."""

from pathlib import Path
from shutil import copytree, move, rmtree

import numpy as np
import pytest

from simart_kit.bench.fingerprint import fingerprint
from simart_kit.bench.frame import MISFIT, Placement
from simart_kit.bench.rows import Row, object_folder, read_row, write_row
from simart_kit.bench.run import Outcome, Watcher, run
from simart_kit.bench.worker import Predictions
from simart_kit.errors import BadInputError

from .bench_objects import cabinet
from .bench_predictions import write_labels, write_urdf
from .bench_runs import plan, write_home

pytestmark = pytest.mark.slow

NAMES = ("one", "two")


class Told(Watcher):
    """Which objects were done, and which of them because they had changed."""

    def __init__(self) -> None:
        self.changed: tuple[str, ...] = ()
        self.names: list[str] = []

    def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
        self.changed = changed

    def finished(self, row: Row) -> None:
        self.names.append(row.name)


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """Two cabinets and their labels."""
    write_home(tmp_path, NAMES)
    for name in NAMES:
        write_labels(tmp_path / "labels", name, cabinet(name))
    return tmp_path


def score(
    home: Path, folder: str = "labels", placement: Placement | None = None, **changes: object
) -> tuple[Told, Outcome]:
    told = Told()
    system = Predictions("predictions", home / folder, placement or Placement())
    return told, run(plan(home, system=system, jobs=2, **changes), told)


def touch(path: Path) -> None:
    """Other contents of the same size."""
    data = bytearray(path.read_bytes())
    data[-1] = (data[-1] + 1) % 256
    path.write_bytes(bytes(data))


def test_what_has_not_changed_is_not_done_again_wherever_it_lies(home: Path) -> None:
    score(home)
    move(home / "data", home / "elsewhere")
    copytree(home / "elsewhere", home / "place" / "data")

    told, outcome = score(home, data=home / "place" / "data")

    assert (told.names, told.changed, outcome.warnings) == ([], (), ())
    assert outcome.before == {"one", "two"}


@pytest.mark.parametrize("file", ["data/two/gt.json", "labels/two.npy", "labels/two.json"])
def test_an_object_whose_truth_or_prediction_has_changed_is_done_again(home: Path, file: str) -> None:
    score(home)
    path = home / file
    path.write_bytes(path.read_bytes() + b"\n")

    told, outcome = score(home)

    assert (told.names, told.changed) == (["two"], ("two",))
    assert (outcome.before, outcome.warnings) == ({"one"}, ())


def test_a_prediction_that_was_missing_is_scored_once_it_is_there(home: Path) -> None:
    move(home / "labels" / "two.npy", home / "later.npy")
    assert score(home)[1].summary.all.failed == 1
    move(home / "later.npy", home / "labels" / "two.npy")

    told, outcome = score(home)

    assert (told.names, outcome.summary.all.failed) == (["two"], 0)


def test_a_changed_plugin_makes_conversions_old(home: Path) -> None:
    run(plan(home, only=("one",)))
    row = read_row(home / "run", "one")
    (home / "cabinets.py").write_text((home / "cabinets.py").read_text() + "\n")
    told = Told()

    run(plan(home, only=("one",)), told)

    assert told.changed == ("one",)
    assert read_row(home / "run", "one").truth_sha256 == row.truth_sha256


def test_rows_of_objects_that_are_gone_or_have_changed_unseen_are_left_out(home: Path) -> None:
    write_home(home, ["three"])
    write_labels(home / "labels", "three", cabinet("three"))
    score(home)
    rmtree(home / "data" / "one")
    touch(home / "data" / "two" / "input.glb")

    told, outcome = score(home, only=("three",))

    assert told.names == []
    assert [row.name for row in outcome.rows] == ["three"]
    assert outcome.warnings == (
        "left out 1 row (one), no longer in DATA",
        "left out 1 row (two), of files that have changed since: give no --only to do them again",
    )
    assert (object_folder(home / "run", "one") / "old_row.json").is_file()
    assert score(home)[0].names == ["two"]


def test_a_damaged_row_that_is_not_done_again_is_told(home: Path) -> None:
    score(home)
    (object_folder(home / "run", "two") / "row.json").write_text("{")

    _, outcome = score(home, only=("one",))

    assert [row.name for row in outcome.rows] == ["one"]
    assert outcome.warnings == ("left out 1 row (two), damaged: give no --only to do them again",)


def test_predictions_are_placed_only_where_they_do_not_tell_their_frame(home: Path) -> None:
    for name in NAMES:
        write_urdf(home / "urdf", name, cabinet(name))
    placement = Placement("+z", "box")

    known = score(home, placement=placement)[1]
    unknown = score(home, "urdf", placement, out=home / "urdf_run")[1]

    for outcome in (known, unknown):
        assert [row.scores["iou"] for row in outcome.rows] == pytest.approx([1.0, 1.0], abs=1e-3)
    assert all("--up and --fit not needed: labels tells its frame" in row.notes for row in known.rows)
    assert not any("not needed" in note for row in unknown.rows for note in row.notes)


def test_predictions_that_do_not_fit_are_warned_of(home: Path) -> None:
    away = np.eye(4)
    away[0, 3] = 10.0
    write_urdf(home / "urdf", "one", cabinet("one"), away)
    write_urdf(home / "urdf", "two", cabinet("two"), np.eye(4))

    _, outcome = score(home, "urdf")

    assert [any(note.startswith(MISFIT) for note in row.notes) for row in outcome.rows] == [True, False]
    assert outcome.warnings == ("1 prediction does not fit the truth's box: see --up and --fit",)


# --- mistakes ---------------------------------------------------------------------------------------------


def test_a_folder_without_any_prediction_is_refused_with_what_it_holds(home: Path) -> None:
    (home / "wrong" / "deep").mkdir(parents=True)
    (home / "wrong" / "readme.txt").touch()

    with pytest.raises(BadInputError) as error:
        score(home, "wrong")

    text = str(error.value)
    assert text.startswith(f"no prediction for 'one' or any other of the 2 objects in {home / 'wrong'}: ")
    assert "it holds deep, readme.txt; name files and folders by their objects: " in text
    assert not (home / "run").exists()


@pytest.mark.parametrize(("given", "meant"), [("", "labels"), ("labels/more", "labels")])
def test_a_folder_of_the_wrong_level_is_refused_with_the_right_one(
    home: Path, given: str, meant: str
) -> None:
    (home / "labels" / "more").mkdir()

    with pytest.raises(BadInputError, match=rf"; did you mean {home / meant}\?$"):
        score(home, given)


def test_a_variant_that_some_objects_lack_is_no_mistake_and_one_that_all_lack_is(home: Path) -> None:
    copytree(home / "data" / "two", home / "spare")
    (home / "data" / "two" / "fused.glb").write_bytes((home / "spare" / "input.glb").read_bytes())

    assert score(home, variant="fused")[1].summary.all.failed == 1
    with pytest.raises(BadInputError, match=r"no object has the variant 'fuzed': .*variants are input$"):
        score(home, variant="fuzed", out=home / "none")
    assert not (home / "none").exists()


def test_damaged_objects_are_rows_whatever_the_variant(home: Path) -> None:
    for name in NAMES:
        (home / "data" / name / "gt.json").write_text("{")
        (home / "data" / name / "fused.glb").write_bytes(b"")

    assert score(home, variant="fused")[1].summary.all.failed == 2


# --- fingerprints -----------------------------------------------------------------------------------------


def test_a_file_stands_for_those_named_alike_and_a_folder_for_all_in_it(tmp_path: Path) -> None:
    for name in ("a.gt.json", "a.glb", "b.glb", "deep/er.bin"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(b"1")
    table = tmp_path / "a.gt.json"
    alike, whole = fingerprint(table), fingerprint(tmp_path)
    (tmp_path / "b.glb").write_bytes(b"2")
    assert fingerprint(table) == alike
    assert fingerprint(tmp_path) != whole
    (tmp_path / "a.glb").write_bytes(b"2")
    assert fingerprint(table) != alike
    whole = fingerprint(tmp_path)
    (tmp_path / "deep" / "er.bin").rename(tmp_path / "deep" / "est.bin")
    assert fingerprint(tmp_path) != whole
    assert (fingerprint(), len(whole)) == ("", 64)


def test_a_run_inside_an_object_is_no_part_of_it(tmp_path: Path) -> None:
    (tmp_path / "input.glb").write_bytes(b"1")
    before = fingerprint(tmp_path)
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "bench.json").write_text("{}")
    write_row(tmp_path / "run", Row("one"))
    assert fingerprint(tmp_path) == before


@pytest.mark.parametrize(
    ("name", "text", "mesh"),
    [
        ("o/o.urdf", '<mesh filename="../meshes/a.obj"/>', "meshes/a.obj"),
        ("o/o.urdf", "<mesh filename='package://kit/meshes/a.obj'/>", "kit/meshes/a.obj"),
        ("o/o.urdf", '<mesh filename="package://o/a &amp; b.obj"/>', "o/a & b.obj"),
        ("o/o.xml", '<compiler meshdir="../shapes"/><mesh file="a.obj"/>', "shapes/a.obj"),
        ("o/o.xml", f'<mesh vertex="{"0 1 " * 500}"/><mesh file="a.obj"/>', "o/a.obj"),
    ],
)
def test_what_a_urdf_or_mjcf_file_names_belongs_to_it(
    tmp_path: Path, name: str, text: str, mesh: str
) -> None:
    for path in (tmp_path / name, tmp_path / mesh):
        path.parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / name).write_text(text)
    (tmp_path / mesh).write_text("1")
    before = fingerprint(tmp_path / name)
    (tmp_path / mesh).write_text("2")
    assert fingerprint(tmp_path / name) != before


def test_included_files_and_the_meshes_of_physxnet_belong_to_an_object(tmp_path: Path) -> None:
    for name, text in (
        ("m/o.xml", '<include file="more.xml"/>'),
        ("m/more.xml", '<include file="o.xml"/><mesh file="../a.stl"/>'),
        ("a.stl", "1"),
        ("finaljson/7.json", "{}"),
        ("partseg/7/objs/0.obj", "1"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    paths = {"m/o.xml": "a.stl", "finaljson/7.json": "partseg/7/objs/0.obj"}
    for object_file, other in paths.items():
        before = fingerprint(tmp_path / object_file)
        (tmp_path / other).write_text("2")
        assert fingerprint(tmp_path / object_file) != before
