"""Folders of meshes into grids, and the grids that a step sees."""

import itertools

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.training import shapes
from simart_kit_plugins.simart.training.config import TrainingConfig
from simart_kit_plugins.simart.training.data import voxel_data
from simart_kit_plugins.simart.training.grids import Grids, joined, pack, unpack
from simart_kit_plugins.simart.training.sampling import Sampler, augmented, batch_rows, unpack_on

from simart_kit.asset_io import save_asset
from simart_kit.errors import BadInputError, OutputError
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .mesh_files import SQUARE, SQUARE_FACES, gltf, save_gltf

PLUGINS = Plugins(installed=False)
CPU = torch.device("cpu")
# Two unit boxes at the ends of a bar of 4 x 1 x 1.
TWO_BOXES = [((0, 0, 0), (1, 1, 1)), ((3, 0, 0), (4, 1, 1))]
ONE_BOX = [((0, 0, 0), (1, 2, 3))]


def save_boxes(path, bounds):
    """An OFF file (z up) of boxes, 12 faces each."""
    mesh = boxes_mesh(bounds)
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = [" ".join(map(str, v)) for v in mesh.vertices] + [f"3 {a} {b} {c}" for a, b, c in mesh.faces]
    path.write_text("\n".join(["OFF", f"{len(mesh.vertices)} {len(mesh.faces)} 0", *rows]) + "\n")
    return path


@pytest.fixture
def folder(tmp_path):
    save_boxes(tmp_path / "data" / "a.off", ONE_BOX)
    save_boxes(tmp_path / "data" / "deep" / "b.off", TWO_BOXES)
    return tmp_path / "data"


def read(folder, resolution=4, **options):
    return voxel_data(folder, resolution, folder.parent / "cache", PLUGINS, **options)


def cells(xs):
    """The cells of a box that spans these x and the two middle rows of y and z."""
    return set(itertools.product(xs, (1, 2), (1, 2)))


def on(grid):
    return set(map(tuple, np.argwhere(grid).tolist()))


def test_a_labelled_object_gives_itself_and_each_part_in_its_own_cube(tmp_path):
    path = save_boxes(tmp_path / "data" / "pair.off", TWO_BOXES)
    np.savez(path.with_suffix(".npz"), face_part=np.repeat([7, 3], 12))
    data = read(path.parent)
    assert data.grids.names == ("pair.off", "pair.off, part 1", "pair.off, part 2")
    assert (data.shapes, data.skipped) == (1, ())
    # A cube of 4 about the bar, cells of 1: the bar's y and z run from 1.5 to 2.5. The faces at x = 1 and
    # x = 3 lie on borders of cells and turn both sides on.
    whole, second, first = data.grids.occupancy([0, 1, 2])  # part 3 comes before part 7
    assert on(first) == cells((0, 1))
    assert on(second) == cells((2, 3))
    assert on(whole) == cells((0, 1, 2, 3))


@pytest.mark.parametrize(("labels", "grids"), [([0, 0], 1), ([-1, -1], 1), ([-1, 4], 2), ([0, 1], 3)])
def test_only_parts_that_are_less_than_the_whole_have_grids(tmp_path, labels, grids):
    path = save_boxes(tmp_path / "data" / "pair.off", TWO_BOXES)
    np.savez(path.parent / "gt.npz", face_part=np.repeat(labels, 12))
    assert len(read(path.parent).grids) == grids


def test_a_converted_asset_is_one_object_whatever_was_exported_beside_it(folder):
    save_asset(cabinet_asset(textured=False), folder / "cabinet")
    save_boxes(folder / "cabinet" / "urdf" / "door.off", ONE_BOX)
    parts = ("cabinet", "cabinet, part 1", "cabinet, part 2", "cabinet, part 3")
    assert read(folder).grids.names == ("a.off", *parts, "deep/b.off")


def test_the_order_is_that_of_the_paths_not_of_the_disk(tmp_path):
    for place, names in (("one", "abc"), ("two", "cba")):
        for name in names:
            save_boxes(tmp_path / place / f"{name}.off", [((0, 0, 0), (1, 1, ord(name) - ord("a") + 1))])
    one, two = (read(tmp_path / place).grids for place in ("one", "two"))
    assert one.names == two.names == ("a.off", "b.off", "c.off")
    assert one.fingerprint == two.fingerprint
    assert Grids(4, one.packed[::-1], one.names).fingerprint != one.fingerprint


def test_a_second_run_voxelises_nothing(folder, monkeypatch):
    first = read(folder)

    def forbidden(*_):
        raise AssertionError("voxelised again")

    monkeypatch.setattr(shapes, "voxelise", forbidden)
    assert read(folder).grids.fingerprint == first.grids.fingerprint
    with pytest.raises(AssertionError, match="voxelised again"):
        read(folder, resolution=8)
    save_boxes(folder / "a.off", TWO_BOXES)  # as deep/b.off, whatever its name
    assert len(read(folder).grids) == 2
    save_boxes(folder / "a.off", TWO_BOXES[:1])
    with pytest.raises(AssertionError, match="voxelised again"):
        read(folder)


def test_new_labels_or_a_new_buffer_of_a_gltf_are_another_object(tmp_path):
    header = gltf(SQUARE, SQUARE_FACES)
    header["buffers"][0]["uri"] = "deep/numbers.data"
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "numbers.data").write_bytes(b"one")
    save_gltf(tmp_path / "square.gltf", header)

    def key():
        (shape,) = shapes.find_shapes(tmp_path)
        return shapes.content_key(shape, 4)

    first = key()
    assert key() == first
    (tmp_path / "deep" / "numbers.data").write_bytes(b"two")
    second = key()
    np.savez(tmp_path / "square.npz", face_part=np.array([0, 1]))
    assert len({first, second, key()}) == 3


def test_layers_of_usd_are_read_anew_since_others_may_have_changed(tmp_path):
    (tmp_path / "a.usda").write_text("#usda 1.0\n")
    (shape,) = shapes.find_shapes(tmp_path)
    assert shapes.content_key(shape, 4) is None


@pytest.mark.parametrize("damage", [b"", b"no array", b"\x93NUMPY\x01\x00"])
def test_a_damaged_cache_is_made_again(folder, damage):
    first = read(folder)
    files = sorted((folder.parent / "cache").iterdir())
    whole = [file.read_bytes() for file in files]
    for file in files:
        file.write_bytes(damage)
    assert read(folder).grids.fingerprint == first.grids.fingerprint
    assert [file.read_bytes() for file in files] == whole
    assert sorted((folder.parent / "cache").iterdir()) == files


def test_what_cannot_be_used_is_told_and_skipped(folder):
    (folder / "cut.glb").write_bytes(b"glTF\x02\x00")
    (folder / "empty.obj").write_bytes(b"")
    (folder / "notes.txt").write_text("no mesh")
    wrong = save_boxes(folder / "wrong.off", TWO_BOXES)
    np.savez(wrong.with_suffix(".npz"), face_part=np.zeros(23, dtype=int))
    (folder / "broken").mkdir()
    (folder / "broken" / "asset.json").write_text("{}")
    seen = []
    data = read(folder, progress=lambda done, total: seen.append((done, total)))
    assert data.grids.names == ("a.off", "deep/b.off")
    assert len(data.skipped) == 4
    for name in ("cut.glb", "empty.obj", "wrong.npz labels 23 faces, but wrong.off has 24", "parts.npz"):
        assert any(name in told and "\n" not in told for told in data.skipped)
    assert seen == [(done, 6) for done in range(1, 7)]


def test_nothing_to_train_on_is_one_clear_error(tmp_path):
    folder = tmp_path / "data"
    with pytest.raises(BadInputError, match="data is no folder"):
        read(folder)
    folder.mkdir()
    (folder / ".hidden").mkdir()
    save_boxes(folder / ".hidden" / "a.off", ONE_BOX)
    with pytest.raises(BadInputError, match="has no mesh file"):
        read(folder)
    (folder / "a.obj").write_text("")
    with pytest.raises(
        BadInputError, match=r"none of 1 shape in .* can be used; the first: .*a\.obj is empty"
    ):
        read(folder)


def test_a_cache_that_cannot_be_written_is_told(folder):
    (folder.parent / "cache").write_text("")
    with pytest.raises(OutputError, match="cannot write the voxel cache"):
        read(folder)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 5), st.integers(1, 4))
def test_packed_grids_come_back_here_and_on_a_device(seed, resolution, count):
    grids = np.random.default_rng(seed).random((count, *(resolution,) * 3)) < 0.5
    packed = pack(grids)
    assert packed.shape == (count, (resolution**3 + 7) // 8)
    assert np.array_equal(unpack(packed, resolution), grids)
    assert np.array_equal(unpack_on(packed, resolution, CPU)[:, 0].numpy(), grids.astype(np.float32))


def test_grids_join_only_at_one_resolution():
    one, two = (Grids(r, pack(np.ones((1, r, r, r), dtype=bool)), (f"edge {r}",)) for r in (2, 4))
    assert joined([one, one]).names == ("edge 2", "edge 2")
    with pytest.raises(BadInputError, match=r"grids of \[2, 4\] voxels an edge"):
        joined([one, two])


@pytest.mark.parametrize(("count", "batch_size"), [(7, 3), (3, 7), (4, 4), (1, 2)])
def test_each_pass_takes_every_row_once(count, batch_size):
    rows = np.concatenate([batch_rows(count, batch_size, 5, step) for step in range(2 * count)])
    passes = rows.reshape(-1, count)  # 2 * count steps are 2 * batch_size whole passes
    assert (np.sort(passes, axis=1) == np.arange(count)).all()


def test_the_order_depends_on_seed_and_pass_and_nothing_else():
    def whole(seed, step):
        return batch_rows(50, 50, seed, step).tolist()

    assert whole(0, 3) == whole(0, 3)
    assert len({tuple(whole(seed, step)) for seed in (0, 1) for step in (0, 1)}) == 4


def test_grids_are_turned_about_z_and_mirrored_and_nothing_else():
    edge, marks = 4, [(0, 1, 3), (0, 0, 0), (2, 1, 0)]  # no two of its eight poses are alike
    grid = torch.zeros(1, 1, edge, edge, edge)
    for x, y, z in marks:
        grid[0, 0, x, y, z] = 1
    last = edge - 1
    poses = [  # (x, y) of the eight symmetries of a square, written down
        lambda x, y: (x, y),
        lambda x, y: (last - y, x),
        lambda x, y: (last - x, last - y),
        lambda x, y: (y, last - x),
        lambda x, y: (last - x, y),
        lambda x, y: (x, last - y),
        lambda x, y: (y, x),
        lambda x, y: (last - y, last - x),
    ]
    allowed = {frozenset((*pose(x, y), z) for x, y, z in marks) for pose in poses}
    assert len(allowed) == 8
    turned = augmented(grid.expand(200, -1, -1, -1, -1), 0, 3)
    assert {frozenset(on(pose[0].numpy())) for pose in turned} == allowed
    assert torch.equal(turned, augmented(grid.expand(200, -1, -1, -1, -1), 0, 3))
    assert not torch.equal(turned, augmented(grid.expand(200, -1, -1, -1, -1), 0, 4))


def test_a_batch_holds_the_rows_of_its_step_turned_only_if_asked():
    occupancy = np.random.default_rng(0).random((5, 3, 3, 3)) < 0.4
    grids = Grids(3, pack(occupancy), tuple("abcde"))
    plain = Sampler(grids, TrainingConfig(batch_size=4, augment=False, seed=2), CPU)
    expected = torch.from_numpy(occupancy[batch_rows(5, 4, 2, 9)]).float()[:, None]
    assert torch.equal(plain.batch(9), expected)
    turned = Sampler(grids, TrainingConfig(batch_size=4, seed=2), CPU)
    assert torch.equal(turned.batch(9), augmented(expected, 2, 9))


def test_links_to_folders_are_not_followed(folder):
    (folder / "link").symlink_to(folder / "deep")
    assert read(folder).grids.names == ("a.off", "deep/b.off")
