"""`simart-kit tokens`: what it prints where, what it writes, and what it refuses."""

import json
import re

import numpy as np
import pytest
from simart_kit_plugins.simart.tokens_file import read_tokens_file
from simart_kit_plugins.simart.vqvae.config_file import write_config

from simart_kit.asset_io import save_asset
from simart_kit.cli.main import run
from simart_kit.testing.meshes import cabinet_asset

from .token_models import tiny_config, tiny_folder, use_dictionary

# Two boxes as in test_codec.py: in their cube the small one has voxels 6..19 in x and y, 51..63 in z.
BOXES = [((0, 0, 0), (1, 1, 1)), ((0, 0, 1), (0.25, 0.25, 1.25))]


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A working folder with two boxes, and a model that loses nothing as the shipped one."""
    monkeypatch.chdir(tmp_path)
    use_dictionary(monkeypatch, tmp_path / "model")
    return tmp_path


@pytest.fixture
def mesh(home):
    from simart_kit.testing.meshes import boxes_mesh

    made = boxes_mesh(BOXES)
    lines = [f"v {x} {z} {-y}" for x, y, z in made.vertices]  # OBJ files have y up
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in made.faces]
    (home / "boxes.obj").write_text("\n".join(lines))
    return "boxes.obj"


@pytest.fixture
def labels(home, mesh):
    np.savez(home / "boxes.npz", face_part=np.repeat([0, 7], 12))
    return "boxes.npz"


def rows(text):
    """Cells of the printed table by the first column."""
    return {
        line.split("  ")[0].strip(): re.split(r"\s{2,}", line.strip())[1:] for line in text.splitlines()[1:]
    }


def test_tokens_go_to_stdout_and_the_table_to_stderr(mesh, labels, capfd):
    assert run(["tokens", mesh]) == 0
    out, err = capfd.readouterr()
    assert re.fullmatch(r"(<voxel> \d+ \d+ ?)+\n", out)
    table = rows(err)
    # The small box: voxels 6..19 are cells 0..2 in x and y, 51..63 are 6..7 in z, and none is inside only.
    cells, dense, force, zero, empty, _, iou, distance = table["part_7"]
    assert (cells, dense, force, zero) == ("18", "512", "54", "54")
    assert (empty, iou, distance) == (f"{1 - 18 / 512:.1%}", "1.000", "0.00")
    assert int(table["boxes"][0]) == out.count("<voxel>")
    assert table["mean of 2 parts"][0] == f"{(int(table['part_0'][0]) + 18) / 2:g}"
    assert "parts from boxes.npz" in err


def test_with_out_the_table_goes_to_stdout_and_tokens_to_the_file(home, mesh, labels, capfd):
    assert run(["tokens", mesh, "--out", "parts.json"]) == 0
    out, err = capfd.readouterr()
    assert "zero-sparse" in out
    assert "part_7" not in err
    file = read_tokens_file(home / "parts.json")
    assert [part.name for part in file.parts] == ["part_0", "part_7"]
    assert len(file.parts[1].tokens.index) == 18


@pytest.mark.parametrize(
    ("form", "shape"), [("atoms", r"(<voxel><xyz_\d+><mesh_\d+>)+\n"), ("ids", r"(0 \d+ \d+ ?)+\n")]
)
def test_other_forms(mesh, labels, form, shape, capfd):
    assert run(["tokens", mesh, "--format", form]) == 0
    assert re.fullmatch(shape, capfd.readouterr().out)


def test_json_is_one_document(mesh, labels, capfd):
    assert run(["tokens", mesh, "--json", "--format", "ids"]) == 0
    document = json.loads(capfd.readouterr().out)
    assert document["ok"]
    part = document["parts"][1]
    assert (part["name"], part["cells"], part["iou"], len(part["tokens"])) == ("part_7", 18, 1.0, 54)
    assert document["mean_of_parts"]["cells"] == (document["parts"][0]["cells"] + 18) / 2


def test_names_come_from_the_table_beside_the_labels(home, mesh, labels, capfd):
    still = {"type": "fixed"}
    parts = [
        {"id": 0, "name": "Base", "joint": still},
        {"id": 7, "name": "Top Box", "label": "lid", "joint": still},
    ]
    (home / "boxes.json").write_text(json.dumps({"parts": parts}))
    assert run(["tokens", mesh, "--json"]) == 0
    document = json.loads(capfd.readouterr().out)
    assert [(p["name"], p["label"]) for p in document["parts"]] == [("base", ""), ("top_box", "lid")]


def test_parts_of_a_segmenter_where_there_are_no_labels(mesh, capfd):
    assert run(["tokens", mesh]) == 0
    assert "parts from segmenter 'nano'" in capfd.readouterr().err


def test_a_recipe_is_asked_although_labels_are_there(mesh, labels, capfd):
    assert run(["tokens", mesh, "--recipe", "geometric"]) == 0
    assert "parts from segmenter 'geometric'" in capfd.readouterr().err


def test_parts_of_a_converted_asset(home, capfd):
    asset = cabinet_asset(textured=False)
    save_asset(asset, home / "asset")
    lines = [f"v {x} {z} {-y}" for x, y, z in asset.mesh.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in asset.mesh.faces]
    (home / "cabinet.obj").write_text("\n".join(lines))
    assert run(["tokens", "cabinet.obj", "--parts", "asset"]) == 0
    assert {"body", "door", "drawer", "mean of 3 parts"} <= set(rows(capfd.readouterr().err))


def refused(arguments, capfd, home):
    """The one line of a refusal; nothing was written."""
    before = sorted(home.rglob("*"))
    assert run(["tokens", *arguments]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert sorted(home.rglob("*")) == before
    told = re.fullmatch("error: (.*)\n", err)
    assert told, err
    return told[1]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["gone.obj"], "no such file: gone.obj"),
        (["boxes.obj", "--parts", "gone.npz"], "gone.npz"),
        (["boxes.obj", "--parts", "short.npz"], "short.npz labels 5 faces, but boxes.obj has 24"),
        (["boxes.obj", "--parts", "none.npz"], "none.npz labels no face"),
        (["boxes.obj", "--parts", "model"], "model has no asset.json"),
        (["boxes.obj", "--parts", "short.npz", "--recipe", "default"], "exclude each other"),
        (["boxes.obj", "--out", "a.json", "--format", "ids"], "text or atoms"),
        (["boxes.obj", "--out", "gone/a.json"], "cannot write gone/a.json"),
        (["boxes.obj", "--recipe", "nosuch"], "unknown recipe 'nosuch'"),
        (["flat.obj"], "no faces"),
        (["dot.obj"], "flat|across"),
    ],
)
def test_mistakes(home, mesh, arguments, told, capfd):
    np.savez(home / "short.npz", face_part=np.zeros(5, dtype=int))
    np.savez(home / "none.npz", face_part=np.full(24, -1))
    (home / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    (home / "dot.obj").write_text("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n")
    assert re.search(told, refused(arguments, capfd, home))


def _damage(folder):
    data = (folder / "model.safetensors").read_bytes()
    (folder / "model.safetensors").write_bytes(data[:200])


def _other_codebook(folder):
    write_config(tiny_config(codebook_size=8192), folder / "config.json")


def _other_shapes(folder):
    write_config(tiny_config(channels=(1, 2, 8)), folder / "config.json")


def _no_weights(folder):
    (folder / "model.safetensors").unlink()


@pytest.mark.parametrize(
    ("break_it", "told"),
    [
        (_damage, "damaged or no safetensors file"),
        (_other_codebook, r"entries is \(4095, 8\), not \(8191, 8\)"),
        (_other_shapes, "does not fit"),
        (_no_weights, "no such file"),
    ],
)
def test_broken_models(tmp_path, monkeypatch, break_it, told, capfd):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "boxes.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    break_it(tiny_folder(tmp_path / "bad"))
    assert re.search(told, refused(["boxes.obj", "--model", "bad"], capfd, tmp_path))


@pytest.mark.parametrize("mode", ["dense", "force-sparse"])
def test_a_model_without_a_zero_token_is_refused(tmp_path, monkeypatch, mode, capfd):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "boxes.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    tiny_folder(tmp_path / "other", mode=mode)
    told = refused(["boxes.obj", "--model", "other"], capfd, tmp_path)
    assert re.search(f"other: a model of mode '{mode}' has no zero token", told)
