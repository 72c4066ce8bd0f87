"""`convert --recipe nano` on meshes and weights that nobody would wish for: a result, or one clear line."""

import json
import shutil
import time

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.meshes import MOST_PIECES
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.stored_model import CONFIG_FILE, WEIGHTS_FILE, read_model
from simart_kit_plugins.nano.weights import save_network

from simart_kit.asset_io import load_asset
from simart_kit.cli.main import run
from simart_kit.errors import BadInputError
from simart_kit.testing.meshes import box
from simart_kit.topology import unique_rows

from .mesh_files import gltf, save_glb

CONFIG = NanoConfig(
    channels=16, layers=1, heads=2, hidden=16, point_channels=8, labels=("door",), categories=("cabinet",)
)


@pytest.fixture(autouse=True)
def _one_thread():
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """A network that was never trained: what it says is made up, and all pieces may move."""
    folder = tmp_path_factory.mktemp("weights") / "model"
    network = NanoNetwork(CONFIG, 1)
    with torch.no_grad():
        network.moves.bias.fill_(4.0)
    save_network(network, folder)
    return folder


def glb(folder, vertices, faces):
    return save_glb(folder / "mesh.glb", gltf(vertices, np.asarray(faces)))


def convert(mesh, model, out, least=0.3):
    sets = [f"segmenter.options.model={model}", f"segmenter.options.least={least}"]
    changes = [word for change in sets for word in ("--set", change)]
    return run(["convert", str(mesh), "--recipe", "nano", *changes, "--no-record", "-q", "-o", str(out)])


def boxes(places, size):
    vertices, faces = box((0, 0, 0), size)
    every = np.concatenate([vertices + place for place in places])
    return every, np.concatenate([faces + len(vertices) * k for k in range(len(places))])


def subdivided(vertices, faces, times):
    """Each triangle as four, `times` times."""
    corners = vertices[faces]
    for _ in range(times):
        a, b, c = corners.transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        corners = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    every = corners.reshape(-1, 3)
    first, ids = unique_rows(np.rint(every * 2**20).astype(np.int64))
    return every[first], ids.reshape(-1, 3)


def small_grid(count):
    side = int(np.ceil(count ** (1 / 3)))
    return np.stack(np.meshgrid(*[np.arange(side)] * 3), axis=-1).reshape(-1, 3)[:count]


def three_faces():
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), [[0, 1, 2], [0, 3, 1], [0, 2, 3]]


def one_face():
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.5]]), [[0, 1, 2]]


def square():
    return np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), [[0, 1, 2], [0, 2, 3]]


def fine_square():
    return subdivided(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), [[0, 1, 2], [0, 2, 3]], 4)


def all_twice():
    vertices, faces = boxes([(0, 0, 0), (2, 0, 0), (0, 2, 0)], (1, 1, 1))
    return vertices, np.concatenate([faces, faces])


def many_small_boxes():
    """More than the pieces that the network sees."""
    return boxes(small_grid(MOST_PIECES + 16), (0.6, 0.6, 0.6))


def objects_side_by_side():
    shapes = [(0.2, 1.0, 0.1), (0.5, 0.1, 0.9), (0.9, 0.9, 0.9), (0.05, 0.05, 1.0), (1.0, 0.3, 0.02)] * 2
    vertices, faces = zip(
        *(box((2 * k, 0, 0), (2 * k + x, y, z)) for k, (x, y, z) in enumerate(shapes)), strict=True
    )
    return np.concatenate(vertices) / 4, np.concatenate([f + 8 * k for k, f in enumerate(faces)])


MESHES = [
    three_faces, one_face, square, fine_square, all_twice, objects_side_by_side,
    pytest.param(many_small_boxes, marks=pytest.mark.slow),
]  # fmt: skip


@pytest.mark.parametrize("make", MESHES, ids=lambda make: make.__name__)
def test_every_surface_becomes_an_asset_whose_faces_all_have_a_part(tmp_path, model, make):
    vertices, faces = make()
    assert convert(glb(tmp_path, vertices, faces), model, tmp_path / "out") in (0, 1)  # 1: a check failed
    asset = load_asset(tmp_path / "out")
    assert len(asset.face_part) == len(faces)
    assert sorted(set(asset.face_part.tolist())) == list(range(len(asset.parts)))
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {"urdf", "mjcf", "usd", "report.json"}
    assert not (tmp_path / "out" / "failed").exists()


def test_faces_that_repeat_others_stay_with_them(tmp_path, model):
    vertices, faces = all_twice()
    convert(glb(tmp_path, vertices, faces), model, tmp_path / "out")
    first, second = load_asset(tmp_path / "out").face_part.reshape(2, -1)
    assert np.array_equal(first, second)


def test_faces_without_area_are_refused_in_one_line(tmp_path, model, capfd):
    mesh = glb(tmp_path, np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0]]), [[0, 1, 2], [0, 0, 1]])
    assert convert(mesh, model, tmp_path / "out") == 2
    told = capfd.readouterr().err.strip().splitlines()
    assert len(told) == 1
    assert str(mesh) in told[0]
    assert "surface of 0 m2" in told[0]
    assert not (tmp_path / "out").exists()


def rewritten(change):
    def damage(folder):
        tensors = load_file(folder / WEIGHTS_FILE)
        change(tensors)
        save_file(tensors, folder / WEIGHTS_FILE)

    return damage


def spoiled(value):
    return rewritten(lambda tensors: tensors["moves.weight"].reshape(-1)[3:4].fill_(value))


def resized(key, value):
    def damage(folder):
        table = json.loads((folder / CONFIG_FILE).read_text())
        table["config"][key] = value
        (folder / CONFIG_FILE).write_text(json.dumps(table))

    return damage


def cut(folder):
    data = (folder / WEIGHTS_FILE).read_bytes()
    (folder / WEIGHTS_FILE).write_bytes(data[: len(data) // 2])


def emptied(folder):
    shutil.rmtree(folder)
    folder.mkdir()


def a_file(folder):
    shutil.rmtree(folder)
    folder.write_text("a model")


DAMAGES = {
    "cut": (cut, "model.safetensors is damaged"),
    "no bytes": (lambda f: (f / WEIGHTS_FILE).write_bytes(b""), "model.safetensors is damaged"),
    "no weights": (lambda f: (f / WEIGHTS_FILE).unlink(), "model.safetensors: no such file"),
    "no config": (lambda f: (f / CONFIG_FILE).unlink(), "config.json: no such file"),
    "not json": (lambda f: (f / CONFIG_FILE).write_bytes(b"\xff{"), "config.json holds no simart-nano"),
    "a list": (lambda f: (f / CONFIG_FILE).write_text("[]"), "config.json holds no simart-nano"),
    "wrong heads": (resized("heads", 3), "heads 3 does not divide channels 16"),
    "other size": (resized("channels", 32), "size mismatch"),
    "other labels": (resized("labels", ["door", "lid"]), "size mismatch for label"),
    "other categories": (resized("categories", []), "size mismatch for category"),
    "more layers": (resized("layers", 2), "Missing key"),
    "one more": (rewritten(lambda t: t.update(more=torch.zeros(2))), "Unexpected key"),
    "half the statistics": (
        rewritten(lambda t: t.update({"statistics.mean": torch.zeros(2, 16)})),
        "Missing key statistics.whitening",
    ),
    "other statistics": (
        rewritten(
            lambda t: t.update(
                {"statistics.mean": torch.zeros(2, 16), "statistics.whitening": torch.zeros(2, 8, 8)}
            )
        ),
        "size mismatch for statistics.whitening",
    ),
    "one less": (rewritten(lambda t: t.pop("moves.bias")), "Missing key.*moves.bias"),
    "not a number": (spoiled(torch.nan), "not all numbers of moves.weight are finite"),
    "infinite": (spoiled(-torch.inf), "not all numbers of moves.weight are finite"),
    "no fractions": (
        rewritten(lambda t: t.update({"moves.bias": t["moves.bias"].to(torch.int64)})),
        "not all numbers of moves.bias are finite",
    ),
    "no folder": (shutil.rmtree, "config.json: no such file"),
    "empty": (emptied, "config.json: no such file"),
    "a file": (a_file, "cannot read .*config.json"),
}


@pytest.mark.parametrize("kind", DAMAGES)
def test_weights_that_cannot_be_used_are_refused_with_what_where_and_what_to_do(tmp_path, model, kind):
    damage, told = DAMAGES[kind]
    folder = shutil.copytree(model, tmp_path / "model")
    damage(folder)
    with pytest.raises(BadInputError, match=told) as caught:
        read_model(folder)
    line = str(caught.value)
    assert "\n" not in line
    assert str(folder) in line
    assert line.endswith(("copy it again", "or train it again where an older version made it"))


def test_damaged_weights_end_the_command_with_one_line_and_leave_no_asset(tmp_path, model, capfd):
    folder = shutil.copytree(model, tmp_path / "model")
    cut(folder)
    assert convert(glb(tmp_path, *square()), folder, tmp_path / "out") != 0
    told = capfd.readouterr().err.strip().splitlines()
    assert len(told) == 1
    assert str(folder / WEIGHTS_FILE) in told[0]
    assert not (tmp_path / "out" / "asset.json").exists()
    assert not (tmp_path / "out" / "urdf").exists()


def a_wavy_skin():
    vertices, faces = subdivided(square()[0].astype(float), square()[1], 10)
    return vertices + 0.1 * np.sin(9 * vertices[:, [1, 2, 0]]), faces


def many_fine_solids():
    return subdivided(*boxes(small_grid(160), (0.6, 0.6, 0.6)), 5)


@pytest.mark.slow
@pytest.mark.timeout(900)
@pytest.mark.parametrize("make", [a_wavy_skin, many_fine_solids], ids=lambda make: make.__name__)
def test_two_million_faces_are_converted_in_bounded_time(tmp_path, model, make):
    vertices, faces = make()
    assert len(faces) > 1_900_000
    mesh = glb(tmp_path, vertices, faces)
    start = time.process_time()
    assert convert(mesh, model, tmp_path / "out", least=0.9) in (0, 1)
    assert time.process_time() - start < 240
    assert len(load_asset(tmp_path / "out").face_part) == len(faces)
