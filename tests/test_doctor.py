"""`simart-kit doctor`: what it finds, and that nothing takes it down."""

import json
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

import simart_kit as sk
from simart_kit import doctor, machine
from simart_kit.cli.main import run
from simart_kit.findings import Finding, library, named_weights, weights
from simart_kit.testing import fakes

RECIPE = 'schema = 1\n[segmenter]\nuse = "fake"\n{}[joints]\nuse = "hints"\n'


class Diagnosed:
    """A plugin with a segmenter, a recipe and something to say."""

    def __init__(self, said, path):
        self._said, self._path = said, path

    @sk.hookimpl
    def register_segmenters(self, register):
        register(fakes.segmenter())

    @sk.hookimpl
    def register_recipes(self, register):
        register("mine", self._path)

    @sk.hookimpl
    def diagnose(self):
        return self._said()


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "config.json").write_text("{}")
    save_file({"a": np.ones((4, 4), dtype=np.float32)}, tmp_path / "model.safetensors")
    return tmp_path


@pytest.fixture
def examined(write):
    """What the doctor says of the recipe "mine", by what its plugin says."""

    def examined(said) -> tuple[doctor.Diagnosis, Finding]:
        plugins = sk.Plugins(installed=False)
        plugins.register(Diagnosed(said, write("mine.toml", RECIPE.format(""))))
        diagnosis = doctor.examine(plugins)
        return diagnosis, next(r for r in diagnosis.recipes if r.subject == "mine")

    return examined


def test_a_library_that_is_there_tells_its_version():
    assert library("numpy", wanted=">=1.26") == Finding("numpy", "ok", version("numpy"))
    assert library("pillow").ok  # its module is PIL


def test_a_library_that_is_missing_tells_how_to_get_it():
    assert library("no-such-thing", wanted=">=2").remedy == "pip install 'no-such-thing>=2'"
    found = library("no-such-thing", extra="mllm", stages=("simart",))
    assert (found.state, found.stages) == ("missing", ("simart",))
    assert found.remedy == "pip install 'simart-kit[mllm]'"


def test_a_library_of_another_version_is_broken():
    assert library("numpy", wanted=">=999").state == "broken"
    assert library("numpy", wanted="<1").state == "broken"
    assert library("numpy", wanted=">=1.2,<999.0.1").ok


def test_whole_weights_tell_their_size(folder):
    found = weights("weights", folder, "again")
    assert (found.state, found.remedy) == ("ok", "")
    assert str(folder) in found.detail


def test_truncated_weights_are_broken(folder):
    file = folder / "model.safetensors"
    whole = file.read_bytes()
    file.write_bytes(whole[:-10])

    found = weights("weights", folder, "copy them again")

    assert (found.state, found.remedy) == ("broken", "copy them again")
    assert f"{len(whole) - 10} bytes, and its header tells of {len(whole)}" in found.detail


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "not a safetensors file"),
        (b"\x10\x00\x00\x00\x00\x00\x00\x00garbage that is no JSON", "its header cannot be read"),
        (b"\x02\x00\x00\x00\x00\x00\x00\x00[]", "its header cannot be read"),
        (b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"),
        (b"\xff" * 40, "not a safetensors file"),
    ],
)
def test_a_file_that_holds_no_weights_is_broken(folder, content, told):
    (folder / "model.safetensors").write_bytes(content)

    found = weights("weights", folder, "again")

    assert found.state == "broken"
    assert told in found.detail


def test_weights_that_are_not_there_are_missing(folder):
    (folder / "config.json").unlink()
    assert weights("weights", folder, "again").state == "missing"
    assert weights("weights", folder / "nowhere", "again").state == "missing"


def test_a_model_of_the_hub_is_looked_for_in_its_cache(folder, tmp_path, monkeypatch):
    monkeypatch.delenv("HF_HUB_CACHE", raising=False)
    monkeypatch.setenv("HF_HOME", str(tmp_path / "home"))
    absent = named_weights("model", "Owner/Model-8B")
    assert absent.state == "missing"
    assert "hf download Owner/Model-8B" in absent.remedy

    snapshot = tmp_path / "home" / "hub" / "models--Owner--Model-8B" / "snapshots" / "abc"
    snapshot.mkdir(parents=True)
    for name in ("config.json", "model.safetensors"):
        (snapshot / name).write_bytes((folder / name).read_bytes())
    assert named_weights("model", "Owner/Model-8B").ok
    assert named_weights("model", str(folder)).ok
    assert named_weights("model", str(folder / "nowhere")).state == "missing"


def test_a_recipe_runs_when_its_plugin_has_what_it_needs(examined):
    diagnosis, mine = examined(lambda: [Finding("thing", "ok", "1.0")])

    assert mine.ok
    assert diagnosis.ok
    (told,) = (p for p in diagnosis.plugins if ("segmenter", "fake") in p.stages)
    assert told.findings == (Finding("thing", "ok", "1.0"),)


@pytest.mark.parametrize("stages", [None, ("fake",)])
def test_a_recipe_cannot_run_without_what_its_stage_needs(examined, stages):
    diagnosis, mine = examined(lambda: [Finding("thing", "missing", "gone", "get it", stages)])

    assert (mine.state, mine.remedy) == ("missing", "get it")
    assert "thing is missing (gone)" in mine.detail
    assert diagnosis.ok  # the default recipe is another


@pytest.mark.parametrize("stages", [(), ("another",)])
def test_what_a_recipe_does_not_use_does_not_keep_it(examined, stages):
    assert examined(lambda: [Finding("thing", "broken", "gone", "get it", stages)])[1].ok


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (lambda: 1 / 0, "ZeroDivisionError"),
        (lambda: ["fine"], "returned str, expected findings"),
        (lambda: sys.exit("bye"), "SystemExit: bye"),
        (lambda: 5, "TypeError"),
    ],
)
def test_a_plugin_that_cannot_be_asked_is_told_and_the_rest_goes_on(examined, said, told):
    diagnosis, mine = examined(said)

    (finding,) = next(p.findings for p in diagnosis.plugins if ("segmenter", "fake") in p.stages)
    assert (finding.subject, finding.state) == ("diagnose()", "broken")
    assert told in finding.detail
    assert mine.ok
    assert diagnosis.ok


def test_a_plugin_that_does_not_load_is_told(write):
    broken = write("broken.py", "raise RuntimeError('out of order')\n")
    diagnosis = doctor.examine(sk.Plugins(installed=False, files=[broken]))

    (told,) = (p for p in diagnosis.plugins if p.owner.plugin == "broken")
    assert told.findings[0].state == "broken"
    assert "out of order" in told.findings[0].detail


def test_a_model_that_a_recipe_names_is_looked_for(write):
    options = '[segmenter.options]\nmodel = "nowhere/at all"\n'
    plugins = sk.Plugins(installed=False)
    recipe = write("mine.toml", RECIPE.replace("fake", "nano").format(options))
    plugins.register(fakes.plugin(recipes={"mine": recipe}))

    mine = next(r for r in doctor.examine(plugins).recipes if r.subject == "mine")

    assert mine.state == "missing"
    assert "model of nano is missing" in mine.detail


def test_broken_weights_of_the_default_recipe_make_the_exit_code_1(folder, monkeypatch, capfd):
    assert run(["doctor"]) == 0
    capfd.readouterr()
    (folder / "model.safetensors").write_bytes(b"")
    monkeypatch.setattr("simart_kit_plugins.nano.diagnosis.shipped_folder", lambda: folder)

    assert run(["doctor"]) == 1

    out = capfd.readouterr().out
    (line,) = (line for line in out.splitlines() if line.split()[:2] == ["BROKEN", "default"])
    assert "weights of nano is broken" in line


def test_a_missing_core_library_keeps_every_recipe(monkeypatch):
    gone = Finding("embreex", "missing", "not installed", "pip install embreex")
    monkeypatch.setattr(doctor, "_libraries", lambda: (gone,))

    diagnosis = doctor.examine(sk.Plugins(installed=False))

    assert not diagnosis.ok
    assert not any(recipe.ok for recipe in diagnosis.recipes)
    default = next(recipe for recipe in diagnosis.recipes if recipe.subject == "default")
    assert (default.state, default.remedy) == ("missing", "pip install embreex")


def test_the_document_holds_all_of_it(capfd):
    assert run(["doctor", "--json"]) == 0
    document = json.loads(capfd.readouterr().out)

    assert document["ok"] is True
    assert {"python", "memory", "GPU"} <= {row["subject"] for row in document["machine"]}
    assert {"numpy", "torch"} <= {row["subject"] for row in document["libraries"]}
    assert "pytest" not in {row["subject"] for row in document["libraries"]}
    nano = next(p for p in document["plugins"] if {"kind": "segmenter", "name": "nano"} in p["stages"])
    assert "weights of nano" in {row["subject"] for row in nano["findings"]}
    assert {"default", "geometric"} <= {row["subject"] for row in document["recipes"]}


def test_a_library_of_several_extras_is_told_once_with_the_smaller_one(monkeypatch):
    lines = [f"no-such-thing>=1; extra == '{extra}'" for extra in ("mllm", "torch", "test")]
    monkeypatch.setattr(doctor, "requires", lambda name: lines)

    (found,) = doctor.examine(sk.Plugins(installed=False)).libraries

    assert (found.subject, found.state, found.stages) == ("no-such-thing", "missing", ())
    assert found.remedy == "pip install 'simart-kit[torch]'"


def test_a_driver_that_hangs_or_fails_is_told(monkeypatch, write):
    monkeypatch.setattr(machine.platform, "system", lambda: "Linux")
    tool = write("nvidia-smi", "#!/bin/sh\nexit 9\n")
    tool.chmod(0o755)
    monkeypatch.setattr(machine.shutil, "which", lambda name: str(tool))
    assert next(f for f in machine.machine() if f.subject == "GPU").state == "broken"
    tool.write_text("#!/bin/sh\necho 'Some GPU, 80 GiB'\n")
    assert next(f for f in machine.machine() if f.subject == "GPU").detail == "Some GPU, 80 GiB"


def test_nothing_heavy_is_imported():
    code = (
        "import sys\nfrom simart_kit.cli.main import run\nrun(['doctor', '--json'])\n"
        "heavy = {'torch', 'transformers', 'mujoco', 'pxr', 'rerun', 'scipy', 'trimesh'} & set(sys.modules)\n"
        "print(sorted(heavy), file=sys.stderr)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stderr.splitlines()[-1] == "[]"
