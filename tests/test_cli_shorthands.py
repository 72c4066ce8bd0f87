"""`convert --image`, `--text` and `--transfer`: short for options of the recipe's segmenter."""

import json
import re
import tomllib

import pytest

from simart_kit.cli.main import run
from simart_kit.cli.shorthands import SHORTHANDS, shorthand_sets
from simart_kit.errors import RecipeError
from simart_kit.plugins import Plugins
from simart_kit.recipe import load_recipe

PLUGIN = '''
from pathlib import Path
import numpy as np
from pydantic import Field
import simart_kit as sk
from simart_kit.testing.meshes import cabinet_mesh

class Looker(sk.Segmenter):
    """Tells what it was shown."""
    name = "looker"
    class Options(sk.Options):
        image: str = Field(default="", description="Photo.")
        text: str = Field(default="", description="What it is.")
    options: Options
    def segment(self, mesh):
        seen = Path(self.options.image).read_text() if self.options.image else "nothing"
        note = sk.Note("segment", "info", f"saw {seen}, heard {self.options.text}")
        return sk.Segmentation(np.zeros(len(mesh.faces), np.int32), (sk.PartGuess("body"),), notes=(note,))

@sk.hookimpl
def register_segmenters(register):
    register(Looker)

@sk.hookimpl
def load_mesh(path):
    return cabinet_mesh(textured=False) if path.suffix == ".fake" else None
'''
RECIPE = (
    'schema = 1\nseed = 0\nmodify = []\nexport = []\n[segmenter]\nuse = "looker"\n[joints]\nuse = "hints"\n'
)
CONVERT = ["convert", "cupboard.fake", "--recipe", "recipe.toml", "--plugin", "lookers.py", "--no-record"]


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A working folder with a source, a recipe, a photo and a plugin whose segmenter looks and listens."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    for name, text in (("cupboard.fake", "fake"), ("recipe.toml", RECIPE), ("lookers.py", PLUGIN)):
        (tmp_path / name).write_text(text)
    (tmp_path / "photo.jpg").write_text("a fridge")
    return tmp_path


def recorded(home):
    """Options of the segmenter as the run recorded them."""
    told = json.loads((home / "out" / "cupboard" / "provenance.json").read_text())
    return told["recipe"]["segmenter"]["options"]


def test_a_photo_and_a_text_reach_the_segmenter(home, capfd):
    assert run([*CONVERT, "--image", "photo.jpg", "--text", "a fridge", "--verbose"]) == 0
    assert "saw a fridge, heard a fridge" in capfd.readouterr().out
    assert recorded(home) == {"image": "photo.jpg", "text": "a fridge"}


def test_a_photo_may_have_an_absolute_path(home, capfd):
    assert run([*CONVERT, "--image", str(home / "photo.jpg"), "--quiet"]) == 0, capfd.readouterr().err
    assert recorded(home)["image"] == str(home / "photo.jpg")


@pytest.mark.parametrize("text", ['a "big" fridge', "7", "true", "", "kühl\\schrank\x7f", "a = [1]\n[b]"])
def test_any_text_arrives_as_it_was_said(text, home):
    plugins = Plugins(files=[home / "lookers.py"])
    made = shorthand_sets({"text": text}, "recipe.toml", (), plugins)
    assert [tomllib.loads(change) for change in made] == [{"segmenter": {"options": {"text": text}}}]
    assert load_recipe("recipe.toml", plugins, made).segmenter.options["text"] == text


def test_it_has_the_last_word_over_set(home, capfd):
    changes = ["--set", "segmenter.options.text=a bin", "--text", "a fridge", "--quiet"]
    assert run([*CONVERT, *changes]) == 0, capfd.readouterr().err
    assert recorded(home)["text"] == "a fridge"


def test_the_segmenter_that_set_chooses_is_meant(home, capfd):
    assert run([*CONVERT, "--set", 'segmenter.use="geometric"', "--text", "a fridge"]) == 2
    assert "segmenter 'geometric' reads no text" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--image", "photo.jpg"], "--image photo.jpg: segmenter 'geometric' looks at no picture; .*simart"),
        (["--text", "a fridge"], "--text a fridge: segmenter 'geometric' reads no text; .*--recipe simart"),
        (["--transfer", "seeds"], "--transfer seeds: segmenter 'geometric' decodes no .*--recipe tokens"),
    ],
)
def test_a_segmenter_without_the_option_is_told_before_anything_is_done(home, capfd, arguments, told):
    before = _files(home)
    assert (
        run(["convert", "cupboard.fake", "--plugin", "lookers.py", "--recipe", "geometric", *arguments]) == 2
    )
    assert re.fullmatch(f"error: {told}\n", capfd.readouterr().err)
    assert _files(home) == before


@pytest.mark.parametrize("missing", ["none.jpg", ".", "x" * 300])
def test_a_photo_that_is_not_there_is_told_before_anything_is_done(home, capfd, missing):
    before = _files(home)
    assert run([*CONVERT, "--image", missing]) == 2
    assert capfd.readouterr().err == f"error: --image {missing}: there is no such file\n"
    assert _files(home) == before


@pytest.mark.parametrize("option", ["--image", "--text"])
def test_bytes_that_are_no_text_are_told(home, capfd, option):
    assert run([*CONVERT, option, "\udcff.jpg"]) == 2
    assert capfd.readouterr().err == f"error: {option} '\\udcff.jpg': this is not UTF-8 text\n"


def test_options_that_are_not_given_change_nothing():
    none = dict.fromkeys(SHORTHANDS)
    assert shorthand_sets(none, "no recipe at all", (), Plugins()) == []
    with pytest.raises(RecipeError, match="unknown recipe"):
        shorthand_sets({**none, "text": ""}, "no recipe at all", (), Plugins())


def _files(home):
    """All files, but what Python keeps of the plugin that it imported."""
    return sorted(path for path in home.rglob("*") if "__pycache__" not in path.parts)
