"""Records: what an object in a state becomes."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from simart_kit_plugins.simart.codec import TokenModel, nearest_codes, object_grids
from simart_kit_plugins.simart.dataset.generated import GeneratedJob
from simart_kit_plugins.simart.dataset.record import Record
from simart_kit_plugins.simart.dataset.record_json import from_json, to_json
from simart_kit_plugins.simart.dataset.records import RecordOptions, records_of, shape_hash, voxels_of
from simart_kit_plugins.simart.dataset.source_object import SourceObject
from simart_kit_plugins.simart.dataset.states import in_state
from simart_kit_plugins.simart.dataset.statistics import Statistics, of_records, quantile, skip
from simart_kit_plugins.simart.dataset.truths import truth_jobs
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.prompt.texts import URDF_QUESTION

from simart_kit.errors import BadInputError

from .dataset_objects import chest
from .real_objects import DATA, needs_data
from .test_bench_physxnet import write_object


@pytest.fixture(scope="module")
def model() -> TokenModel:
    import torch

    torch.set_num_threads(1)
    return nearest_codes(load_model().model)


def records(made: SourceObject, model: TokenModel, **options: bool | int) -> list[Record]:
    chosen = RecordOptions(
        states=int(options.get("states", 2)), seed=3, pictures=bool(options.get("pictures", False))
    )
    return list(records_of(made, voxels_of(made), model, chosen))


def test_the_answer_tells_parts_and_joints_in_the_units_of_the_paper(model: TokenModel) -> None:
    first = records(chest(), model, states=1)[0]
    body, drawer, knob = first.answer.parts
    # The longest side is y, -0.55..0.6: 1.15 m, and the cube's edge.
    assert first.answer.scale == 115.0
    assert [part.name for part in first.answer.parts] == ["body", "drawer", "knob"]
    assert (body.parent, drawer.parent, knob.parent) == (None, 0, 1)
    assert drawer.motion is not None
    assert knob.motion is not None
    # 0.4 m of 1.15 m to -y: the axis is written +y and the limits change sign.
    assert (drawer.motion.axis, drawer.motion.limits) == ((0, 100, 0), (-35, 0))
    # Middle of the drawer: x 0, y -0.1 and z 0.5; the cube's is (0, 0.025, 0.5), its edge 1.15.
    assert drawer.motion.center == (100, round((-0.1 + 0.55) / 1.15 * 200), 100)
    assert knob.motion.limits == (-50, 50)
    # The axis through z 0.5 at the middle of the knob, y -0.525.
    assert knob.motion.center == (100, round(0.025 / 1.15 * 200), 100)


def test_voxels_are_of_the_state_and_parts_inside_others_have_theirs(model: TokenModel) -> None:
    made = chest()
    for state, record in enumerate(records(made, model, states=3)):
        there = in_state(made, state, 3)
        grids = object_grids(there.asset.mesh, there.asset.face_part, ["body", "drawer", "knob"])
        assert np.array_equal(voxels_of(there).whole, grids.whole)
        grid = record.voxels.grid
        whole = np.flatnonzero(grid.occupied_cells(grids.whole))
        assert record.voxels.index.tolist() == whole.tolist()
        for part, occupied in zip(record.answer.parts, grids.parts, strict=True):
            cells = np.flatnonzero(grid.occupied_cells(occupied))
            assert part.voxels.index.tolist() == cells.tolist()
            assert set(cells) <= set(whole)


def test_both_instruction_sets_are_there_and_point_at_parts(model: TokenModel) -> None:
    found = records(chest(), model, states=8)
    for record in found:
        asked, *grounding = record.pairs
        assert asked.task == "urdf"
        assert URDF_QUESTION in asked.question
        assert {pair.part for pair in grounding} == {0, 1, 2}
        drawer = [pair.question for pair in grounding if pair.part == 1]
        assert len(set(drawer)) == len(drawer) == 2
        assert all(pair.question.startswith("Generate the part of this object with") for pair in grounding)
    # Now and then the question for all says what it is, as a user may.
    hinted = [record.pairs[0].question.startswith("This object is a thing. ") for record in found]
    assert 0 < sum(hinted) < len(hinted)


def test_keys_and_a_picture_of_each_state(model: TokenModel) -> None:
    made = GeneratedJob("cabinet", 0, 0).make()
    one, two = records(made, model, pictures=True)
    assert (one.key, two.key) == ("generated-cabinet-0-00000-00", "generated-cabinet-0-00000-01")
    assert one.object == two.object == "generated-cabinet-0-00000"
    assert one.picture is not None
    assert two.picture is not None
    pixels = [np.asarray(Image.open(io.BytesIO(data)).convert("RGB")) for data in (one.picture, two.picture)]
    assert pixels[0].shape == (252, 252, 3)
    assert not np.array_equal(*pixels)


def test_equal_objects_have_equal_hashes_whatever_they_are_called() -> None:
    made = chest()
    grids = voxels_of(made)
    assert shape_hash(grids, ["a", "b"]) == shape_hash(voxels_of(chest()), ["b", "a"])
    assert shape_hash(grids, ["a", "b"]) != shape_hash(grids, ["a", "c"])
    moved = voxels_of(in_state(made, 1, 0))
    assert shape_hash(grids, ["a"]) != shape_hash(moved, ["a"])


def test_a_record_comes_back_from_its_document(model: TokenModel) -> None:
    made = GeneratedJob("clamp", 0, 0).make()
    record = records(made, model)[1]
    again = from_json(to_json(record), b"png", "here")
    assert to_json(again) == to_json(record)
    assert again.pairs == record.pairs
    assert again.answer.parts[1].motion == record.answer.parts[1].motion
    assert again.picture == b"png"
    assert {part.type for part in again.answer.parts} >= {"fixed", "prismatic", "revolute", "hinge"}


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (b'"schema":1', b'"schema":2', "schema 2, this version reads 1"),
        (b'"parent":0', b'"parent":7', "parent 7 is not an earlier part"),
        (b'"task":"grounding"', b'"task":"poetry"', "a 'poetry' question about part"),
        (b'"part":1', b'"part":9', "a 'grounding' question about part 9 of 3"),
        (b'"codebook":8192', b'"codebook":81', "codebook of 81"),
        (b'"answer"', b'"anger"', "is damaged: KeyError 'answer'"),
    ],
)
def test_a_damaged_document_is_refused_in_one_line(
    model: TokenModel, old: bytes, new: bytes, told: str
) -> None:
    data = to_json(records(chest(), model, states=1)[0])
    assert old in data
    with pytest.raises(BadInputError) as caught:
        from_json(data.replace(old, new, 1), None, "shard.tar: KEY")
    assert str(caught.value).startswith("shard.tar: KEY")
    assert told in str(caught.value)
    with pytest.raises(BadInputError, match=r"shard\.tar: KEY is damaged"):
        from_json(data[:-20], None, "shard.tar: KEY")


def test_statistics_add_up(model: TokenModel) -> None:
    made = records(chest(), model, states=3)
    counts = of_records(made).plus(skip("too ugly")).plus(of_records(made))
    cells = [sum(len(part.voxels.index) for part in record.answer.parts) for record in made]
    assert (counts.objects, counts.static, counts.records) == (2, 0, 6)
    assert counts.skipped == {"too ugly": 1}
    assert counts.types == {"fixed": 6, "prismatic": 6, "revolute": 6}
    assert counts.zero_sparse_tokens == 2 * 3 * sum(cells)
    # Three parts of 16 x 8 x 8 cells, in each of six records.
    assert counts.dense_tokens == 6 * 3 * 1024
    assert quantile(counts.part_cells, 1.0) == max(cells)
    assert quantile({"9": 5, "10": 4, "200": 1}, 0.5) == 9
    assert Statistics.model_validate_json(counts.model_dump_json()) == counts


def test_physxnet_says_materials_names_and_what_parts_are_for(tmp_path: Path, model: TokenModel) -> None:
    path = write_object(tmp_path)
    text = path.read_text().replace(
        '"name": "lid"', '"name": "lid", "Functional_description": "It keeps the drink fresh."'
    )
    path.write_text(text)
    (job,) = truth_jobs(tmp_path)
    made = job.make()
    record = records(made, model, states=1)[0]
    assert job.key == "physxnet-77"
    assert record.answer.name == "Bottle"
    # "8*20*4" cm, and the longest side is along the longest of the mesh.
    assert record.answer.scale == 20.0
    assert [part.name for part in record.answer.parts] == ["glass", "lid", "cap"]
    assert {part.material for part in record.answer.parts} == {"Glass"}
    assert "It keeps the drink fresh" in made.words[1].texts


@needs_data
def test_real_objects_keep_their_looks_and_parts(model: TokenModel) -> None:
    (job,) = truth_jobs(DATA / "painted_wooden_stool")
    made = job.make()
    found = records(made, model, states=2)
    assert made.asset.mesh.materials[0].base_color_image is not None
    assert [[part.type for part in record.answer.parts] for record in found] == [["fixed"]]
    (door,) = truth_jobs(DATA / "gz_hinged_door")
    assert [(j.parent, j.child, j.kind) for j in door.make().joints] == [
        ("base", "door", "revolute"),
        ("door", "handles", "revolute"),
    ]
