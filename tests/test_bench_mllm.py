"""`simart-kit bench mllm`: the rows' budgets, scores and tables, and what it refuses."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import typer
from simart_kit_plugins.simart.codec import decode_tokens
from simart_kit_plugins.simart.commands.bench_mllm import bench_mllm
from simart_kit_plugins.simart.comparing.asking import answers
from simart_kit_plugins.simart.comparing.dense_form import written_densely
from simart_kit_plugins.simart.comparing.examples import RowExamples, left_out
from simart_kit_plugins.simart.comparing.rows import ROWS, chosen_rows
from simart_kit_plugins.simart.comparing.scoring import Truth, scored
from simart_kit_plugins.simart.comparing.training import Budget, trained
from simart_kit_plugins.simart.dataset.manifest import MANIFEST, BuildOptions, Manifest, write_whole
from simart_kit_plugins.simart.dataset.manifest import Shard as ShardEntry
from simart_kit_plugins.simart.dataset.statistics import Statistics
from simart_kit_plugins.simart.vqvae.checkpoint import save_checkpoint
from typer.testing import CliRunner

from simart_kit.errors import BadInputError

from .finetune_cases import GRID, box, codec, data, model, plan, voxels
from .mllm_cases import SIZE
from .test_bench_mllm_forms import without_zero_token

pytestmark = pytest.mark.slow

SIZES = {"longest": 6144, "batch_tokens": 6144, "constrained": True, "grounding_share": 0.0, "pool": 4}


def folder(path, pictures):
    """A finished data set of five boxes; 0 and 3 are held out by their names."""
    records = [box(number, picture=pictures) for number in range(5)]
    written = data(path, [records])
    shards = tuple(
        ShardEntry(file=shard.name, sha256="0" * 64, bytes=shard.stat().st_size, records=len(records))
        for shard in written.shards
    )
    options = BuildOptions(codec=codec().fingerprint)
    table = Manifest(
        options=options,
        grid=GRID.shape,
        codebook=GRID.codebook,
        shards=shards,
        statistics=Statistics(records=len(records)),
        skipped=(),
    )
    write_whole(path / MANIFEST, table)
    return path


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "size.json").write_text(SIZE.model_dump_json())
    from simart_kit_plugins.simart.finetune import plan as plans

    preset = {"schema": 1, "plan": plan().model_dump(mode="json")}
    (tmp_path / "plan.json").write_text(json.dumps(preset))
    monkeypatch.setattr(plans, "packaged_plans", lambda: {"tiny": tmp_path / "plan.json"})
    save_checkpoint(without_zero_token(alive=False), tmp_path / "without")
    return tmp_path


def bench(*arguments):
    app = typer.Typer()
    app.command()(bench_mllm)
    fixed = ["--size", "size.json", "--threads", "1", "--device", "cpu", "--judged", "1", "--counted", "2"]
    state = SimpleNamespace(json=False, verbose=False)
    return CliRunner().invoke(app, [*map(str, arguments), *fixed], obj=state)


def test_rows_are_trained_and_judged_alike(home):
    folder(home / "data", pictures=True)
    options = ["--rows", "force-sparse,vision", "--steps", "2", "--codec-without-zero", "without"]
    result = bench("--data", "data", *options, "out")
    assert result.exit_code == 0, result.output
    written = json.loads((home / "out" / "ablation.json").read_text())
    dropped, seen = written["rows"]
    assert [row["row"] for row in written["rows"]] == ["force-sparse", "vision"]
    for row in (dropped, seen):
        assert row["training"]["steps"] == 2
        assert row["scores"]["objects"] == 1
        assert row["scores_of_true_codes"]["type"] == 1
    assert seen["scores_of_true_codes"]["iou"] == 1, "the data's own codes are the truth"
    assert 0 < written["emptiness"]["share"] <= 1
    table = (home / "out" / "ablation.md").read_text()
    for word in ("Force sparse", "Zero sparse + vision", "862", "516", "Centre"):
        assert word in table
        assert word in result.output


def test_dense_answers_are_asked_for_and_those_that_do_not_fit_are_none():
    bundle = written_densely(model())
    found, none = (next(answers(bundle, [box(0)], longest)) for longest in (16384, 1100))
    assert none is None
    assert found is not None
    assert {cell for part in found.parts for cell in part.voxels.index} <= {8, 9, 10}


def test_tokens_alone_are_counted_without_training(home):
    folder(home / "data", pictures=False)
    result = bench("--data", "data", "--rows", "zero-sparse,dense", "--steps", "0", "out")
    assert result.exit_code == 0, result.output
    written = json.loads((home / "out" / "ablation.json").read_text())
    assert [row["training"] for row in written["rows"]] == [None, None]
    assert "Centre" not in result.output
    assert written["rows"][0]["tokens"]["parts"] == 2


def test_a_row_whose_examples_are_all_too_long_is_told_and_the_others_go_on(home):
    folder(home / "data", pictures=False)
    sizes = ["--longest", "1024", "--batch-tokens", "1024", "--steps", "1"]
    result = bench("--data", "data", "--rows", "dense,zero-sparse", *sizes, "out")
    assert result.exit_code == 0, result.output
    dense, sparse = json.loads((home / "out" / "ablation.json").read_text())["rows"]
    assert (dense["scores"], dense["left_out"]) == (None, 1)
    assert sparse["scores"]["objects"] == 1
    assert "too long" in result.output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--steps", "1", "--minutes", "1"], "two budgets"),
        (["--minutes", "0"], "give more than 0"),
        (["--rows", "sparse"], "unknown row 'sparse'; rows are dense, force-sparse, zero-sparse, vision"),
        (["--rows", "vision"], "row vision needs pictures"),
        (["--rows", "force-sparse", "--codec-without-zero", "nothing"], "nothing"),
    ],
)
def test_what_cannot_be_compared_is_refused(home, arguments, message):
    folder(home / "data", pictures=False)
    result = bench("--data", "data", *arguments, "out")
    assert isinstance(result.exception, BadInputError)
    assert message in str(result.exception)


def test_rows_keep_the_table_s_order():
    assert chosen_rows(None) == ROWS
    assert [row.key for row in chosen_rows("vision, dense")] == ["dense", "vision"]
    with pytest.raises(BadInputError, match="no row"):
        chosen_rows(" ,")


def test_the_same_seed_gives_the_same_weights_and_time_ends_a_row(tmp_path):
    records = data(tmp_path, [[box(number) for number in range(4)]])
    own, weights = plan(**SIZES, steps=2), []
    for _ in range(2):
        bundle = written_densely(model())
        spent = trained(
            bundle,
            records,
            RowExamples(bundle, own, lambda record: record),
            Budget(own),
            "cpu",
            lambda step, loss: None,
        )
        assert (spent.steps, spent.examples) == (2, 2)
        weights.append(next(bundle.model.parameters()).detach().clone())
    assert weights[0].equal(weights[1])
    bundle = model()
    maker = RowExamples(bundle, own, lambda record: record)
    timed = trained(bundle, records, maker, Budget(own, 1e-9), "cpu", lambda step, loss: None)
    assert timed.steps <= 1


def test_records_are_left_out_that_are_too_long_or_have_no_codes():
    own, bundle = plan(**SIZES), written_densely(model())
    records = [box(0), box(1)]
    whole = RowExamples(bundle, own, lambda record: record)
    assert left_out(whole, records, 6144) == 0
    assert left_out(whole, records, 3072) == 1, "a question and two parts have a grid each, and words"
    half = RowExamples(bundle, own, lambda record: record if record.key == "box-0-0" else None)
    assert left_out(half, records, 6144) == 0.5


def truth(record):
    grids = decode_tokens(codec().model, [part.voxels for part in record.answer.parts])
    assert grids.any(axis=(1, 2, 3)).all()
    return Truth(record.answer, grids)


def test_the_true_answer_has_no_fault():
    found = scored([truth(box(2))], [box(2).answer], codec().model, GRID)
    assert (found.type, found.center, found.iou, found.cell_iou, found.cd) == (1, 0, 1, 1, 0)
    assert (found.objects, found.complete, found.centers) == (1, 1, 1)


def test_an_answer_that_did_not_end_misses_every_part():
    found = scored([truth(box(2))], [None], codec().model, GRID)
    assert (found.type, found.center, found.iou, found.cell_iou, found.complete) == (0, None, 0, 0, 0)
    assert found.cd == pytest.approx(np.sqrt(3) / 2)


def test_types_and_centres_are_compared_of_parts_that_share_cells():
    true = box(2)
    body, lid = true.answer.parts
    moved = replace(lid, motion=replace(lid.motion, center=(100, 180, 100)))
    slid = replace(lid, type="prismatic", voxels=voxels([9]))
    elsewhere = replace(lid, voxels=voxels([500]))
    scores = [
        scored([truth(true)], [replace(true.answer, parts=(body, other))], codec().model, GRID)
        for other in (moved, slid, elsewhere)
    ]
    assert [score.type for score in scores] == [1, 0, 0]
    assert [score.center for score in scores] == [pytest.approx(20 / 200), None, None]
    assert [score.cell_iou for score in scores] == [1, 1, 0.5]
