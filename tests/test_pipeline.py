"""A run from end to end with fake stages: what it leaves, and what it leaves alone when a stage fails."""

import functools
import json
import sys
from pathlib import Path

import pytest

import simart_kit as sk
from simart_kit.beside import Beside
from simart_kit.errors import AmbiguousPluginError, BadInputError, OutputError, StageError
from simart_kit.pipeline import convert
from simart_kit.testing import fakes

from .workshop import Camera, Workshop, contents


@pytest.fixture
def shop(tmp_path, monkeypatch) -> Workshop:
    # Real pictures take seconds and have their own tests.
    quick = "simart_kit.render.write_preview"
    monkeypatch.setattr(quick, lambda asset, path: path.write_bytes(b"picture"))
    return Workshop(tmp_path)


def test_a_run_leaves_the_asset_the_exports_and_a_record_of_itself(shop):
    result = shop.run()

    assert set(contents(shop.out)) == {
        "asset.json",
        "parts.npz",
        "preview.png",
        "report.json",
        "provenance.json",
        "fake_text/cupboard.txt",
        "fake_text/limits.txt",
    }
    assert result.paths["fake_text"] == shop.out / "fake_text" / "cupboard.txt"
    assert result.paths["preview"] == shop.out / "preview.png"
    assert {"asset", "report", "provenance", "preview", "fake_text"} == set(result.paths)
    assert all(path.is_file() for path in result.paths.values())
    assert [(j.child, j.kind) for j in sk.load_asset(shop.out).joints] == [
        ("door", "revolute"),
        ("drawer", "prismatic"),
    ]
    report = json.loads((shop.out / "report.json").read_text())
    assert "fake_note: a remark" in report["notes"]
    assert report["unsupported"] == {"fake_text": ["text has no shape"]}


def test_the_record_names_every_stage_with_its_distribution_and_hashes_every_output(shop):
    shop.run()

    record = json.loads((shop.out / "provenance.json").read_text())
    stages = [(s["kind"], s["name"], s["distribution"], s["version"]) for s in record["stages"]]
    assert stages == [
        ("segmenter", "fake_labels", "fake-distribution", "9.8.7"),
        ("joint predictor", "fake_joints", "fake-distribution", "9.8.7"),
        ("modifier", "fake_note", "fake-distribution", "9.8.7"),
        ("exporter", "fake_text", "fake-distribution", "9.8.7"),
    ]
    assert set(record["outputs"]) == set(contents(shop.out)) - {"provenance.json"}


FAULTS = [
    ("segmenter.options.fault=raise", "segmenter 'fake_labels'", "RuntimeError: out of ideas", "mesh.npz"),
    ("segmenter.options.fault=exit", "segmenter 'fake_labels'", "SystemExit: 3", "mesh.npz"),
    ("segmenter.options.fault=hang", "segmenter 'fake_labels'", "longer than 0.2 s", "mesh.npz"),
    ("segmenter.options.fault=shape", "segmenter 'fake_labels'", "shape (107,), expected (108,)", "mesh.npz"),
    ("segmenter.options.fault=dtype", "segmenter 'fake_labels'", "float32, expected int32", "mesh.npz"),
    ("segmenter.options.fault=type", "segmenter 'fake_labels'", "ndarray, expected a", "mesh.npz"),
    ("joints.options.fault=raise", "joint predictor 'fake_joints'", "no joint today", "segmentation.npz"),
    ("joints.options.fault=unknown part", "joint predictor 'fake_joints'", "'lid'", "segmentation.npz"),
    ("modify.fake_note.options.fault=raise", "modifier 'fake_note'", "RuntimeError: cannot", "asset.json"),
    ("modify.fake_note.options.fault=nothing", "modifier 'fake_note'", "NoneType, expected", "asset.json"),
    ("export.fake_text.options.fault=half", "exporter 'fake_text'", "disk on fire", "asset.json"),
    ("export.fake_text.options.fault=elsewhere", "exporter 'fake_text'", "expected the path", "asset.json"),
    ("export.fake_text.options.fault=gaps", "exporter 'fake_text'", "lost count", "asset.json"),
]


@pytest.mark.parametrize(("fault", "stage", "reason", "kept"), FAULTS, ids=[f[0] for f in FAULTS])
def test_a_failing_stage_is_named_and_its_input_kept_and_nothing_else_written(
    shop, fault, stage, reason, kept
):
    with pytest.raises(StageError) as caught:
        shop.run("stage_timeout=0.2" if "hang" in fault else "seed=0", fault, observers=(Camera(),))

    line = str(caught.value)
    assert line.startswith(f"{stage} failed (plugin fakes, fake-distribution 9.8.7): ")
    assert reason in line
    assert "\n" not in line
    assert [p.name for p in shop.out.iterdir()] == ["failed"]
    left = contents(shop.out / "failed")
    assert f"input/{kept}" in left
    assert b"Traceback" in left["error.txt"]
    assert left["cupboard.rrd"].startswith(b"load fake\n")


def test_a_stage_whose_constructor_fails_is_named_too(shop):
    heard = Heard()
    with pytest.raises(StageError, match=r"modifier 'fake_note' failed .*FileNotFoundError: weights.bin"):
        shop.run("modify.fake_note.options.fault=constructor", observers=(Camera(), heard))

    assert heard.told == ["load fake", "segment fake_labels", "joints fake_joints", "modify failed"]
    assert set(contents(shop.out / "failed")) == {"error.txt", "cupboard.rrd"}


def test_a_spec_that_does_not_fit_is_told_as_what_failed(shop):
    heard = Heard()
    spec = {"schema": 1, "parts": [{"name": "lid", "found_as": "hat"}]}
    with pytest.raises(sk.BadInputError, match="hat"):
        convert(shop.source, shop.recipe, out=shop.out, spec=spec, plugins=shop.plugins(heard))

    assert heard.told == ["load fake", "segment fake_labels", "spec failed"]
    assert not shop.out.exists()


def test_two_checks_of_one_name_are_told_before_anything_is_done(shop):
    heard = Heard()
    two = tuple(fakes.plugin(check=fakes.check(name="same")) for _ in range(2))
    with pytest.raises(AmbiguousPluginError, match="check 'same' is registered by"):
        shop.run(observers=(*two, heard))

    assert heard.told == []
    assert not shop.out.exists()


def test_the_input_of_a_failed_modifier_opens_as_an_asset(shop):
    with pytest.raises(StageError):
        shop.run("modify.fake_note.options.fault=raise")

    assert [j.name for j in sk.load_asset(shop.out / "failed" / "input").joints] == [
        "door_hinge",
        "drawer_slide",
    ]


@pytest.mark.parametrize("fault", ["segmenter.options.fault=raise", "export.fake_text.options.fault=half"])
def test_a_failed_run_leaves_the_previous_output_untouched_to_the_byte(shop, fault):
    shop.run()
    before = contents(shop.out)

    with pytest.raises(StageError):
        shop.run(fault)

    after = contents(shop.out)
    assert {name: after[name] for name in before} == before
    assert {Path(name).parts[0] for name in after.keys() - before.keys()} == {"failed"}


def test_the_next_good_run_removes_what_a_failed_one_kept(shop):
    with pytest.raises(StageError):
        shop.run("segmenter.options.fault=raise")
    shop.run()

    assert not (shop.out / "failed").exists()


def test_an_interrupted_run_leaves_nothing(shop):
    with pytest.raises(KeyboardInterrupt):
        shop.run("segmenter.options.fault=interrupt")

    assert not shop.out.exists()


def test_a_bad_source_leaves_nothing(shop):
    shop.source.write_text("wardrobe")

    with pytest.raises(BadInputError, match="is no cabinet"):
        shop.run()

    assert not shop.out.exists()


def test_a_file_where_the_output_folder_should_be_is_told(shop):
    shop.out.write_text("mine")

    with pytest.raises(OutputError, match="cannot write to output folder"):
        shop.run()
    with pytest.raises(OutputError, match="cannot write to output folder"):
        shop.run(out=shop.out / "below")

    assert shop.out.read_text() == "mine"


def test_files_the_user_changed_are_kept_beside_the_new_ones(shop):
    shop.run()
    (shop.out / "asset.json").write_text("edited")
    (shop.out / "fake_text" / "my_notes.txt").write_text("keep me")

    result = shop.run()

    assert (shop.out / "asset.json.bak1").read_text() == "edited"
    assert (shop.out / "fake_text.bak1" / "my_notes.txt").read_text() == "keep me"
    assert sorted(p.name for p in shop.out.iterdir() if ".bak" in p.name) == [
        "asset.json.bak1",
        "fake_text.bak1",
    ]
    assert any("kept as asset.json.bak1" in warning for warning in result.report.warnings)
    assert sk.load_asset(shop.out).name == "cupboard"


def test_two_runs_are_the_same_to_the_byte(shop):
    shop.run(out=shop.folder / "one")
    shop.run(out=shop.folder / "two")

    one, two = contents(shop.folder / "one"), contents(shop.folder / "two")
    assert {n: b for n, b in one.items() if n != "provenance.json"} == {
        n: b for n, b in two.items() if n != "provenance.json"
    }


def test_the_record_is_a_recipe_that_repeats_the_run(shop):
    shop.run("seed=7", "modify.fake_note.options.text=again", "export.fake_text.options.greeting=ahoy")
    repeated = shop.folder / "repeated"

    convert(shop.source, shop.out / "provenance.json", out=repeated, record=False, plugins=shop.plugins())

    first, second = contents(shop.out), contents(repeated)
    assert first["fake_text/cupboard.txt"] == b"ahoy cupboard\n"
    assert {n: b for n, b in second.items() if n != "provenance.json"} == {
        n: b for n, b in first.items() if n != "provenance.json"
    }


def test_an_observer_that_raises_is_a_warning_and_the_others_still_hear(shop):
    heard = []

    class Broken:
        @sk.hookimpl
        def stage_finished(self, stage):
            raise RuntimeError(f"cannot bear {stage}")

    class Listener:
        @sk.hookimpl
        def run_started(self, run):
            heard.append(f"started {run.name}")

        @sk.hookimpl
        def stage_finished(self, stage, name):
            heard.append(f"{stage} {name}")

        @sk.hookimpl
        def run_finished(self, report):
            heard.append(f"finished {report.name}")

    result = shop.run(observers=(Broken(), Listener()))

    assert (
        "observer: Broken (registered object) failed in stage_finished: RuntimeError: cannot bear load"
        in (result.report.warnings)
    )
    assert heard == [
        "started cupboard",
        "load fake",
        "segment fake_labels",
        "joints fake_joints",
        "modify fake_note",
        "preview preview",
        "export fake_text",
        "check checks",
        "finished cupboard",
    ]


def test_observers_hear_of_a_failure_with_the_stage(shop):
    heard = []

    class Listener:
        @sk.hookimpl
        def run_failed(self, stage, error):
            heard.append((stage, type(error)))

    with pytest.raises(StageError):
        shop.run("joints.options.fault=raise", observers=(Listener(),))

    assert heard == [("joints", StageError)]


@pytest.fixture
def beside(monkeypatch):
    """A second core takes the picture of a small mesh too; it has just ended, so that it is drawn here."""
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    monkeypatch.setattr("simart_kit.pipeline._MANY", 0)
    ended = functools.partial(Beside, worker=(sys.executable, "-c", ""))
    monkeypatch.setattr("simart_kit.pipeline.Beside", ended)


class Heard:
    """What an observer is told."""

    def __init__(self):
        self.told = []

    @sk.hookimpl
    def stage_finished(self, stage, name):
        self.told.append(f"{stage} {name}")

    @sk.hookimpl
    def run_failed(self, stage, error):
        self.told.append(f"{stage} failed")
        self.notes = getattr(error, "__notes__", [])


def test_a_second_core_draws_while_formats_are_written_and_checked(shop, beside):
    heard = Heard()
    result = shop.run(observers=(heard,))
    assert heard.told[-3:] == ["export fake_text", "check checks", "preview preview"]
    assert result.paths["preview"].read_bytes() == b"picture"


def test_a_format_that_fails_waits_for_the_picture_before_observers_are_told(shop, beside):
    heard = Heard()
    with pytest.raises(StageError, match="disk on fire"):
        shop.run("export.fake_text.options.fault=half", observers=(heard,))
    assert heard.told[-2:] == ["preview preview", "export failed"]


def test_a_picture_that_fails_too_does_not_hide_why_a_format_failed(shop, beside, monkeypatch):
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: 1 / 0)
    heard = Heard()
    with pytest.raises(StageError, match="disk on fire"):
        shop.run("export.fake_text.options.fault=half", observers=(heard,))
    assert heard.told[-1] == "export failed"
    assert heard.notes[0] == "what went on beside it failed too: division by zero"


def test_a_check_that_raises_is_told_too_and_the_recording_kept(shop):
    wrong = fakes.plugin(check=fakes.check(error=RuntimeError("no idea")))
    heard = Heard()
    with pytest.raises(StageError, match="no idea") as caught:
        shop.run(observers=(wrong, heard, Camera()))
    assert heard.told[-2:] == ["export fake_text", "check failed"]
    assert set(contents(shop.out / "failed")) == {"error.txt", "cupboard.rrd"}
    assert caught.value.__notes__ == [f"the traceback is in {shop.out / 'failed'}"]


def test_the_recording_of_a_failed_run_is_kept(shop):
    with pytest.raises(StageError):
        convert(
            shop.source,
            shop.recipe,
            out=shop.out,
            sets=["modify.fake_note.options.fault=raise"],
            plugins=shop.plugins(),
        )

    assert (shop.out / "failed" / "cupboard.rrd").read_bytes()[:4] == b"RRF2"
    assert not list(shop.out.glob("*.rrd"))
