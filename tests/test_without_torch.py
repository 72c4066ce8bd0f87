"""Without torch: conversions run, and what needs it is refused in one line before anything is done."""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from simart_kit_plugins.simart.default_model import load_model

from simart_kit.cli.main import run
from simart_kit.commands import PluginCommand
from simart_kit.errors import BadInputError
from simart_kit.extras import EXTRAS
from simart_kit.plugins import Plugins
from simart_kit.recipe import Use, check_extras
from simart_kit.testing.meshes import cabinet_mesh

PROJECT = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text())["project"]
TORCH, MLLM = "pip install 'simart-kit[torch]'", "pip install 'simart-kit[mllm]'"
COMMANDS = {
    "tokens": (["box.obj", "--out", "box.json"], TORCH),
    "train nano": (["--run", "run"], TORCH),
    "train vqvae": (["--config", "micro", "--procedural", "1", "--run", "run"], TORCH),
    "train mllm": (["--config", "tiny", "--data", "data", "--run", "run"], MLLM),
    "dataset build": (["data", "--generate", "box"], TORCH),
    "model import-trellis": (["encoder", "decoder", "model"], TORCH),
    "model evaluate": ([], TORCH),
    "model shrink": (["model", "small"], TORCH),
    "bench vqvae": (["--run", "run"], TORCH),
    "bench mllm": (["out", "--data", "data"], MLLM),
}
FREE = {"generate", "bench oracle"}
BOX = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
# The picture takes a second and needs no network.
CONVERSION = """
import sys
sys.modules["torch"] = None
from simart_kit import render
render.write_preview = lambda asset, path: path.write_bytes(b"picture")
from simart_kit.cli.main import run
sys.exit(run(sys.argv[1:]))
"""


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A working folder with a mesh, of one who has no torch."""
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.obj").write_text(BOX)
    return tmp_path


def refusal(capfd, place, arguments):
    """The one line that a command line is refused with; nothing is written."""
    assert run(arguments) == 2
    out, err = capfd.readouterr()
    assert [path.name for path in place.iterdir()] == ["box.obj"]
    assert out == ""
    (line,) = err.splitlines()
    return line


def test_the_default_conversion_runs(tmp_path):
    mesh = cabinet_mesh(textured=False)
    rows = [f"v {x} {z} {-y}" for x, y, z in mesh.vertices.tolist()]  # OBJ stands on y
    rows += [f"f {a} {b} {c}" for a, b, c in (mesh.faces + 1).tolist()]
    (tmp_path / "cabinet.obj").write_text("\n".join(rows))
    arguments = ["convert", "cabinet.obj", "--no-record", "--json"]

    done = subprocess.run(
        [sys.executable, "-c", CONVERSION, *arguments], capture_output=True, text=True, cwd=tmp_path
    )

    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert document["ok"] is True
    assert {"urdf", "mjcf", "usd"} <= {path.name for path in (tmp_path / "out" / "cabinet").iterdir()}
    used = json.loads((tmp_path / "out" / "cabinet" / "provenance.json").read_text())
    assert used["recipe"]["segmenter"]["use"] == "nano"


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_is_refused_and_helps_all_the_same(capfd, place, name):
    arguments, remedy = COMMANDS[name]

    line = refusal(capfd, place, [*name.split(), *arguments])

    assert re.fullmatch(rf"error: command '{name}' needs torch[\w, ]*: {re.escape(remedy)}", line)
    assert run([*name.split(), "--help"]) == 0
    assert f"Usage: simart-kit {name} [OPTIONS]" in capfd.readouterr().out


def test_every_built_in_command_says_whether_it_needs_torch():
    registered = {r.name: r.value.extra for r in Plugins(installed=False).registrations("command")}

    assert {name for name, extra in registered.items() if extra} == set(COMMANDS)
    assert {name for name, extra in registered.items() if not extra} == FREE


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--recipe", "simart"], f"segmenter 'simart' needs torch: {MLLM}"),
        (["--recipe", "tokens"], f"segmenter 'tokens' needs torch: {TORCH}"),
        (
            ["--recipe", "simart", "--set", 'segmenter.options.endpoint="http://localhost:1/v1"'],
            f"segmenter 'simart' needs torch: {TORCH}",
        ),
        (
            ["--set", 'joints={use="p3sam-vlm",options={backend="transformers",model="a/b"}}'],
            f"joint predictor 'p3sam-vlm' needs torch: {MLLM}",
        ),
    ],
)
def test_a_recipe_is_refused_before_the_mesh_is_read(capfd, place, options, told):
    (place / "box.obj").write_text("not read")

    assert refusal(capfd, place, ["convert", "box.obj", *options]) == f"error: {told}"
    assert refusal(capfd, place, ["spec", "box.obj", *options]) == f"error: {told}"


@pytest.mark.parametrize("command", [["ground", "box.obj", "the lid"], ["bench", "run", "."]])
def test_other_commands_refuse_such_a_recipe_too(capfd, place, command):
    line = refusal(capfd, place, [*command, "--recipe", "tokens"])

    assert line == f"error: segmenter 'tokens' needs torch: {TORCH}"


@pytest.mark.parametrize(
    "use",
    [
        Use(use="nano"),
        Use(use="geometric"),
        Use(use="p3sam-vlm", options={"model": "any", "url": "http://localhost:1/v1"}),
        Use(use="p3sam-vlm", options={"model": "any", "backend": "transformers", "replay": True}),
    ],
    ids=lambda use: f"{use.use} {' '.join(use.options)}",
)
def test_other_segmenters_need_none(place, use):
    plugins = Plugins(installed=False)
    check_extras([("segmenter", use)], plugins)  # raises where one is needed

    with pytest.raises(BadInputError, match="segmenter 'tokens' needs torch"):
        check_extras([("segmenter", use), ("segmenter", Use(use="tokens"))], plugins)


def test_a_program_that_reads_a_voxel_model_is_told(place):
    with pytest.raises(BadInputError) as told:
        load_model()
    assert str(told.value) == f"a voxel model needs torch: {TORCH}"


def test_lists_work_and_the_doctor_tells(capfd, place):
    for arguments in (["--help"], ["plugins", "list"], ["recipes", "list"], ["recipes", "check", "simart"]):
        assert run(arguments) == 0
    assert run(["plugins", "show", "train nano"]) == 0
    assert f"It needs `{TORCH}`." in capfd.readouterr().out

    assert run(["doctor", "--json"]) == 0

    recipes = {row["subject"]: row for row in json.loads(capfd.readouterr().out)["recipes"]}
    assert recipes["default"]["state"] == "ok"
    assert recipes["tokens"]["remedy"] == TORCH
    assert TORCH in recipes["simart"]["remedy"]


def test_the_table_of_extras_is_that_of_the_project():
    stated = PROJECT["optional-dependencies"]
    assert set(EXTRAS) == set(stated) - {"test", "dev"}

    for extra, modules in EXTRAS.items():
        brought = set(re.findall(r"^(\w+)>=", "\n".join(stated[extra]), re.MULTILINE))
        within = re.findall(r"^simart-kit\[(\w+)\]$", "\n".join(stated[extra]), re.MULTILINE)
        assert brought | {name for inner in within for name in EXTRAS[inner]} <= set(modules)
    assert not [line for line in PROJECT["dependencies"] if re.match(r"torch\b|transformers\b", line)]


def test_an_extra_that_does_not_exist_is_no_extra_of_a_command():
    with pytest.raises(ValueError, match="needs extra 'cuda': there are coacd, mllm, torch"):
        PluginCommand("module:function", "Do it.", "cuda")
