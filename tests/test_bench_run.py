"""A run: every object a row whatever happens to it, gone on with where it was, summed up rightly."""

import csv
import json
from dataclasses import replace
from pathlib import Path
from shutil import copytree

import pytest

from simart_kit.bench import worker
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.bench.protocols import Metric, Protocol, Scores, protocol
from simart_kit.bench.results import Group, Mean, summarise
from simart_kit.bench.rows import Row, read_row
from simart_kit.bench.run import Watcher, left_to_do, run
from simart_kit.bench.worker import Job, Predictions
from simart_kit.errors import BadInputError, OutputError

from .bench_runs import converted, plan, write_home

pytestmark = pytest.mark.slow

PERFECT = {"type": 1.0, "axis": 0.0, "origin": 0.0, "iou": 1.0, "f1": 1.0}


@pytest.fixture
def home(tmp_path) -> Path:
    write_home(tmp_path, ["cabinet_a", "cabinet_b", "block"])
    return tmp_path


class Told(Watcher):
    def __init__(self) -> None:
        self.counts, self.names = (), []

    def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
        self.counts = (objects, done)

    def finished(self, row: Row) -> None:
        self.names.append(row.name)


def test_what_is_right_scores_perfect(home):
    told = Told()

    outcome = run(plan(home), told)

    assert [(row.name, row.category, row.status) for row in outcome.rows] == [
        ("block", "block", "scored"),
        ("cabinet_a", "cabinet", "scored"),
        ("cabinet_b", "cabinet", "scored"),
    ]
    for row in outcome.rows[1:]:
        found = {key: row.scores[key] for key in PERFECT}
        assert found == pytest.approx(PERFECT, abs=1e-5)
    assert outcome.rows[0].static is True
    assert outcome.rows[0].scores["f1"] == 1.0
    assert (told.counts, told.names) == ((3, 0), ["block", "cabinet_a", "cabinet_b"])
    assert {"bench.json", "results.json", "results.csv", "report.html", "objects"} <= {
        path.name for path in (home / "run").iterdir()
    }
    assert (home / "run" / "objects" / "cabinet_a" / "output" / "asset.json").is_file()


def test_an_object_that_breaks_its_process_is_a_row_and_ends_no_other(tmp_path):
    write_home(tmp_path, ["exit", "segfault", "raise", "cabinet"])

    outcome = run(plan(tmp_path, jobs=2))

    errors = {row.name: row.error for row in outcome.rows}
    assert errors == {
        "cabinet": "",
        "exit": "ended with exit status 3",
        "raise": errors["raise"],
        "segfault": "crashed (signal 11)",
    }
    assert "out of ideas" in errors["raise"]
    assert (outcome.summary.all.objects, outcome.summary.all.failed) == (4, 3)
    assert outcome.summary.all.means["type"].mean == pytest.approx(1 / 4)  # a failure has no part right
    # What is known of an object does not die with its process.
    assert all((row.category, row.static) == ("cabinet", False) for row in outcome.rows)
    assert "Segmentation fault" in (tmp_path / "run" / "objects" / "segfault" / "log.txt").read_text()


def test_an_object_that_never_ends_is_given_up(tmp_path):
    write_home(tmp_path, ["hang"])

    run(plan(tmp_path, timeout=1.0))

    row = read_row(tmp_path / "run", "hang")
    assert (row.status, row.error, row.scores["iou"]) == ("failed", "took longer than 1 s", 0.0)


def test_a_run_gone_on_with_does_what_was_left_and_finds_the_same(home):
    run(plan(home, only=("cabinet_a",)))
    assert left_to_do(plan(home)) == 2
    told = Told()

    run(plan(home), told)

    assert (told.counts, told.names) == ((3, 1), ["block", "cabinet_b"])
    assert converted(home) == ["cabinet_a", "block", "cabinet_b"]
    run(plan(home, "at_once", jobs=2))
    one, two = (json.loads((home / out / "results.json").read_text()) for out in ("run", "at_once"))
    assert one.pop("seconds").keys() == two.pop("seconds").keys()
    assert one == two


def test_a_damaged_row_is_done_again(home):
    run(plan(home))
    row = home / "run" / "objects" / "block" / "row.json"
    row.write_text(row.read_text()[:50])

    run(plan(home))

    assert converted(home)[3:] == ["block"]
    assert read_row(home / "run", "block").status == "scored"


def test_retry_does_failures_again(tmp_path):
    write_home(tmp_path, ["cabinet", "raise"])
    run(plan(tmp_path))
    assert sorted(converted(tmp_path)) == ["cabinet", "raise"]

    run(plan(tmp_path, retry=True))

    assert sorted(converted(tmp_path)) == ["cabinet", "raise", "raise"]


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        (lambda home: plan(home, protocol="particulate"), "run with protocol 'simart/.*', not 'particulate/"),
        (lambda home: plan(home, sets=["seed=7"]), "run with another recipe: seed differ"),
        (lambda home: replace(plan(home), data=home / "others"), "run with data 'data', not 'others'"),
        (
            lambda home: plan(home, system=Predictions("predictions p", home / "run")),
            "'recipe recipe', not 'predic",
        ),
    ],
    ids=["protocol", "recipe", "data", "system"],
)
def test_a_folder_of_other_settings_is_refused(home, changed, told):
    run(plan(home, only=("block",)))
    copytree(home / "data", home / "others")

    with pytest.raises(BadInputError, match=told):
        run(changed(home))


def test_a_folder_that_is_no_run_or_is_in_use_is_refused(home):
    (home / "mine").mkdir()
    (home / "mine" / "thesis.txt").write_text("years of work")
    with pytest.raises(BadInputError, match="is not empty and no benchmark run"):
        run(plan(home, "mine"))
    with pytest.raises(OutputError, match="it is a file"):
        run(plan(home, "mine/thesis.txt"))

    class Second(Watcher):
        def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
            with pytest.raises(OutputError, match="another run is writing"):
                run(plan(home))

    assert len(run(plan(home), Second()).rows) == 3


def test_objects_that_nobody_has_are_refused(home):
    with pytest.raises(
        BadInputError, match=r"no object is called fridge\*: there are block, cabinet_a, cabinet_b"
    ):
        run(plan(home, only=("fridge*",)))
    with pytest.raises(BadInputError, match="unknown protocol 'paper'"):
        run(plan(home, protocol="paper"))
    assert not (home / "run").exists()


def test_damaged_truth_is_a_failure_with_the_worst_scores(home):
    table = home / "data" / "cabinet_a" / "gt.json"
    table.write_text(table.read_text().replace('"revolute"', '"revolving"', 1))

    run(plan(home, only=("cabinet_a",)))

    row = read_row(home / "run", "cabinet_a")
    assert (row.status, row.static) == ("failed", None)
    assert "gt.json" in row.error
    assert row.scores == dict(protocol("simart").score(None, None).values)
    (line,) = csv.DictReader((home / "run" / "results.csv").read_text().splitlines())
    assert (line["found"], line["missed"], line["invented"]) == ("", "", "")  # of how many, nobody knows


def test_predictions_are_scored_and_missing_ones_fail(home):
    run(plan(home))
    predictions = home / "predictions"
    for name in ("block", "cabinet_a"):
        copytree(home / "run" / "objects" / name / "output", predictions / name)

    outcome = run(plan(home, "scored", system=Predictions("predictions p", predictions)))

    rows = {row.name: row for row in outcome.rows}
    assert rows["cabinet_a"].scores["iou"] == pytest.approx(1.0, abs=1e-5)
    assert (rows["cabinet_b"].status, rows["cabinet_b"].scores["iou"]) == ("failed", 0.0)
    assert "no prediction for 'cabinet_b'" in rows["cabinet_b"].error


def test_an_object_in_pieces_is_written_as_one_mesh_and_converted(home):
    """Of formats without a single mesh."""
    reader = InPieces()
    job = a_job(home, reader=reader)

    worker.work(job)

    row = read_row(home / "run", "cabinet_a")
    assert (row.status, row.error, row.category) == ("scored", "", "cabinet")
    assert row.scores["iou"] == pytest.approx(1.0, abs=1e-5)
    assert (job.folder / "input" / "input.glb").is_file()


class InPieces(SimartBench):
    def read(self, path: Path, variant: str = "input"):
        return replace(super().read(path, variant), mesh=None)


class Broken(Protocol):
    name, version, source = "broken", "1", "nowhere"
    metrics = (Metric("hits", "Hits", "higher", "how often", headline=True),)

    def score(self, truth, prediction):
        if truth is not None:
            raise ZeroDivisionError("no\nluck")
        return Scores({"hits": 0.0})


def test_a_bug_in_scoring_is_a_row_that_keeps_its_traceback(home, monkeypatch):
    monkeypatch.setattr(worker, "protocol", lambda name: Broken())
    job = a_job(home)

    worker.work(job)

    row = read_row(home / "run", "cabinet_a")
    assert (row.status, row.error) == ("failed", "scoring failed: ZeroDivisionError: no luck")
    assert row.scores == {"hits": 0.0}
    assert "Traceback" in (job.folder / "error.txt").read_text()


def test_pictures_that_fail_cost_no_score(home, monkeypatch):
    monkeypatch.setattr("simart_kit.bench.pictures.write_pictures", lambda *given: 1 / 0)

    worker.work(a_job(home, pictures=True))

    row = read_row(home / "run", "cabinet_a")
    assert (row.status, row.pictures) == ("scored", {})
    assert any("no pictures: drawing failed: ZeroDivisionError" in note for note in row.notes)


def test_pictures_that_end_the_process_cost_no_score(home, monkeypatch):
    def die(*given):
        raise KeyboardInterrupt

    monkeypatch.setattr("simart_kit.bench.pictures.write_pictures", die)
    job = a_job(home, pictures=True)
    with pytest.raises(KeyboardInterrupt):
        worker.work(job)
    assert read_row(home / "run", "cabinet_a") is None

    worker.work(replace(job, died="crashed (signal 11)"))

    row = read_row(home / "run", "cabinet_a")
    assert (row.status, row.scores["type"]) == ("scored", 1.0)
    assert "no pictures: crashed (signal 11)" in row.notes
    assert sorted(path.name for path in job.folder.iterdir()) == ["row.json"]


def a_job(home: Path, **changes: object) -> Job:
    """The first cabinet, to be done in this process."""
    of_run = plan(home)
    job = Job(
        of_run.out,
        "cabinet_a",
        SimartBench(),
        home / "data" / "cabinet_a",
        "input",
        of_run.system,
        "simart",
        pictures=False,
    )
    job.folder.mkdir(parents=True, exist_ok=True)
    (of_run.out / "recipe.toml").write_text((home / "recipe.toml").read_text() + '[[export]]\nuse = "mjcf"\n')
    return replace(job, **changes)


class Counted(Protocol):
    name, version, source = "counted", "3", "here"
    metrics = (
        Metric("iou", "IoU", "higher", "penalised", headline=True),
        Metric("iou_matched", "IoU, matched", "higher", "matched only"),
        Metric("axis", "Axis", "lower", "of all parts"),
    )

    def score(self, truth, prediction):
        raise NotImplementedError


LID = {"outcome": "matched", "true": "lid", "iou": 1.0, "axis": 0.2}
WIDE, NARROW = ({"outcome": "matched", "true": name, "iou": iou} for name, iou in (("x", 0.7), ("y", 0.9)))
RIGHT, POOR = LID | {"found": True}, WIDE | {"found": False, "predicted": "w"}
MISSED, INVENTED = {"outcome": "missed", "true": "door"}, {"outcome": "invented", "predicted": "z"}
BODY = {"outcome": "matched", "true": "body", "true_kind": "fixed"}


def scores(iou: float, matched: float | None = None, axis: float | None = None) -> dict[str, float | None]:
    return {"iou": iou, "iou_matched": matched, "axis": axis}


ROWS = (
    Row("a", "box", static=False, scores=scores(0.5, 1.0, 0.2), parts=(BODY, LID, MISSED)),
    Row("b", "box", static=False, scores=scores(0.8, 0.8), parts=(WIDE, NARROW, INVENTED)),
    Row("c", "lamp", status="failed", error='bad, "very"', scores=scores(0.0, None, 1.0)),
    Row("d", "", static=True, scores=scores(1.0)),
)


def test_means_are_over_objects_and_micro_means_over_parts():
    summary = summarise(ROWS, Counted())

    found = summary.all
    assert (summary.protocol, found.objects, found.failed, found.static) == ("counted/3", 4, 1, 1)
    assert found.true_parts == 4  # lid and door, x and y
    assert (found.found, found.missed, found.invented) == (None, None, None)
    iou, matched, axis = (found.means[key] for key in ("iou", "iou_matched", "axis"))
    assert (iou.mean, iou.n, iou.micro) == (pytest.approx(0.575), 4, None)  # (0.5 + 0.8 + 0 + 1) / 4
    assert 0.0 <= iou.lower < 0.575 < iou.upper <= 1.0
    assert (matched.mean, matched.n) == (pytest.approx(0.9), 2)  # (1 + 0.8) / 2
    assert (matched.micro, matched.parts) == (pytest.approx(2.6 / 3), 3)  # 1, 0.7 and 0.9
    assert (axis.mean, axis.n, axis.micro, axis.parts) == (pytest.approx(0.6), 2, pytest.approx(0.2), 1)


def test_a_part_is_found_missed_or_invented():
    # Found: the lid. Missed: the door, and x, which w covers poorly. Invented: w and z. No body counts.
    body = BODY | {"predicted": "body", "predicted_kind": "fixed", "found": False}
    rows = (
        Row("a", "box", static=False, parts=(body, RIGHT, MISSED)),
        Row("b", "lamp", static=False, parts=(POOR, INVENTED)),
    )

    summary = summarise(rows, Counted())

    numbers = {name: counts(group) for name, group in (("all", summary.all), *summary.categories.items())}
    assert numbers == {"all": (3, 1, 2, 2), "box": (2, 1, 1, 0), "lamp": (1, 0, 1, 2)}


def counts(group: Group) -> tuple[int | None, ...]:
    return group.true_parts, group.found, group.missed, group.invented


def test_categories_have_means_of_their_own():
    categories = summarise(ROWS, Counted()).categories

    assert list(categories) == ["box", "lamp"]
    assert categories["box"].means["iou"].mean == pytest.approx(0.65)
    assert categories["lamp"].means["iou"] == Mean(0.0, None, None, 1)
    assert categories["lamp"].means["iou_matched"] == Mean(None, None, None, 0)
    assert (categories["box"].failed, categories["lamp"].failed) == (0, 1)


def test_the_files_say_the_same_as_the_rows(home):
    write_home(home, ["raise"])
    outcome = run(plan(home))

    table = json.loads((home / "run" / "results.json").read_text(), parse_constant=pytest.fail)
    assert table["schema"] == 1
    assert table["settings"]["system"] == "recipe recipe"
    assert table["summary"]["all"]["failed"] == 1
    assert [row["name"] for row in table["rows"]] == ["block", "cabinet_a", "cabinet_b", "raise"]
    with (home / "run" / "results.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    keys = [metric.key for metric in protocol("simart").metrics]
    heads = ["name", "category", "status", "error", "static"]
    assert list(lines[0]) == [*heads, "found", "missed", "invented", *keys, "seconds"]
    right = {line["name"]: (line["found"], line["missed"], line["invented"]) for line in lines}
    # A cabinet has two doors and a drawer.
    assert right == {
        "block": ("0", "0", "0"),
        "cabinet_a": ("3", "0", "0"),
        "cabinet_b": ("3", "0", "0"),
        "raise": ("0", "3", "0"),
    }
    for line, row in zip(lines, outcome.rows, strict=True):
        assert (line["name"], line["status"], line["error"]) == (row.name, row.status, row.error)
        for key in keys:
            assert line[key] == ("" if row.scores[key] is None else str(row.scores[key]))
