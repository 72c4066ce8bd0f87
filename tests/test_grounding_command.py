"""`simart-kit ground` and `simart-kit bench grounding`: what they print, and with which exit code."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.bench.articulation import Link
from simart_kit.bench.grounding_run import descriptions, grounding_scores, means
from simart_kit.cli.main import run
from simart_kit.recipe import load_recipe

from .bench_runs import write_home

GROUND = ["ground", "data/cabinet/input.glb", "--recipe", "recipe.toml", "--plugin", "cabinets.py"]
BENCH = ["bench", "grounding", "data", "-r", "recipe.toml", "--baseline", "recipe.toml"]


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.drawing.highlight.SIZE", 96)
    # The plugin of the test takes it out for good; this puts it back.
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    write_home(tmp_path, ["cabinet"])
    return tmp_path


def test_a_part_is_told_with_its_rivals_and_files(home, capfd):
    assert run([*GROUND, "the drawer"]) == 0

    out, err = capfd.readouterr()
    lines = out.splitlines()
    assert lines[0] == "the drawer: score 1.00, 'drawer' is the part's name"
    assert re.fullmatch(r"  \d+ of \d+ faces, \d+\.\d % of the surface", lines[1])
    assert lines[2].split()[:3] == ["*", "drawer", "1.00"]
    assert (home / "out" / "input_the_drawer" / "part.glb").is_file()
    assert "Traceback" not in err


def test_top_limits_the_list(capfd):
    assert run([*GROUND, "the drawer", "--top", "1"]) == 0
    one = capfd.readouterr().out
    assert run([*GROUND, "the drawer"]) == 0
    all_of_them = capfd.readouterr().out
    assert len(one.splitlines()) < len(all_of_them.splitlines())


def test_json_is_one_document_with_relative_paths(capfd):
    assert run([*GROUND, "the drawer", "--json", "--out", "found"]) == 0

    document = json.loads(capfd.readouterr().out)
    assert document["ok"] is True
    assert document["parts"] == ["drawer"]
    assert document["paths"]["part"] == str(Path("found/part.glb"))
    assert all(0 <= row["score"] <= 1 for row in document["candidates"])


def test_what_is_not_there_is_one_line_and_exit_code_2(home, capfd):
    assert run([*GROUND, "the steering wheel", "--out", "found"]) == 2

    out, err = capfd.readouterr()
    assert out == ""
    (line,) = (line for line in err.splitlines() if line.startswith("error:"))
    assert "no part fits 'the steering wheel': its parts are" in line
    assert "drawer" in line
    assert not (home / "found").exists()


def test_a_missing_mesh_is_bad_input(capfd):
    assert run(["ground", "nowhere.glb", "the lid"]) == 2
    assert "no such file: nowhere.glb" in capfd.readouterr().err


def test_only_names_of_their_own_are_asked_for():
    links = [Link(name) for name in ("body", "door", "door_2", "left_door", "lid_1", "7")]

    assert descriptions(links) == {0: "the body", 3: "the left door", 4: "the lid"}


def test_right_parts_score_1_and_the_largest_part_only_where_it_is_meant(home):
    plugins = sk.Plugins(installed=False, files=[home / "cabinets.py"])
    recipe = load_recipe(home / "recipe.toml", plugins)

    (found,) = grounding_scores(home / "data", recipe, recipe, plugins)

    assert found.failed == ""
    by_name = {part.part: part.scores for part in found.parts}
    assert len(by_name) >= 2
    assert all(scores[0].iou == pytest.approx(1.0) for scores in by_name.values())
    assert all(scores[0].cd == pytest.approx(0.0, abs=1e-9) for scores in by_name.values())
    largest = [scores[2].iou for scores in by_name.values()]
    assert np.isclose(largest, 1.0).sum() == 1
    assert means([found])["recipe"].iou == pytest.approx(1.0)
    assert means([found])["largest part"].iou == pytest.approx(np.mean(largest))


def test_the_bench_prints_a_table_and_its_document(capfd):
    assert run([*BENCH, "--plugin", "cabinets.py"]) == 0
    out, err = capfd.readouterr()
    assert re.match(r"\d+ parts of 1 objects, 0 failed\n", out)
    assert re.search(r"^  recipe +1\.000 +0\.000$", out, re.MULTILINE)
    assert "cabinet: " in err

    assert run([*BENCH, "--plugin", "cabinets.py", "--json"]) == 0
    document = json.loads(capfd.readouterr().out)
    assert document["mean"]["recipe"]["iou"] == pytest.approx(1.0)
    assert {row["object"] for row in document["parts"]} == {"cabinet"}


GROUNDER = """
import numpy as np
import simart_kit as sk

class Moody(sk.Segmenter):
    name = "moody"
    def segment(self, mesh):
        raise AssertionError("is not asked")
    def ground(self, mesh, description):
        if description != "the drawer":
            raise RuntimeError("no mood for " + description)
        return sk.Grounded(np.arange(len(mesh.faces)) >= 36, 1.0, "sure")

@sk.hookimpl
def register_segmenters(register):
    register(Moody)
"""


def test_a_grounder_that_fails_for_a_part_counts_as_not_having_found_it(home, capfd):
    (home / "moody.py").write_text(GROUNDER)
    (home / "moody.toml").write_text((home / "recipe.toml").read_text().replace("cabinets", "moody"))
    words = ["bench", "grounding", "data", "-r", "moody.toml", "--baseline", "recipe.toml", "--json"]

    assert run([*words, "--plugin", "cabinets.py", "--plugin", "moody.py"]) == 0

    out, err = capfd.readouterr()
    rows = {row["part"]: row for row in json.loads(out)["parts"]}
    assert rows["drawer"]["recipe"]["iou"] == pytest.approx(1.0)
    assert rows["drawer"]["failed"] == ""
    assert rows["body"]["recipe"]["iou"] == 0.0
    assert "no mood for the body" in rows["body"]["failed"]
    assert "no mood for the body" in err


def test_the_bench_tells_of_objects_that_fail(home, capfd):
    (home / "data" / "cabinet" / "gt.npz").write_bytes(b"damaged")

    assert run([*BENCH, "--plugin", "cabinets.py"]) == 1

    out, err = capfd.readouterr()
    assert out.startswith("0 parts of 1 objects, 1 failed")
    assert "warning: cabinet: " in err
    assert run([*BENCH, "--plugin", "cabinets.py", "--only", "x*"]) == 2
