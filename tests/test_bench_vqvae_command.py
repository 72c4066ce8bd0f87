"""`simart-kit bench vqvae`: the rows, the tables and what it refuses; a tiny model on 16^3 voxels."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.ablation.autoencoder import start_from
from simart_kit_plugins.simart.ablation.budget import shrunk
from simart_kit_plugins.simart.ablation.coding import as_force_sparse, coding, coding_without, emptiness
from simart_kit_plugins.simart.ablation.experiment import Ablation, Block, Row
from simart_kit_plugins.simart.ablation.judging import Judgement, Scores, judge
from simart_kit_plugins.simart.ablation.lengths import lengths, objects_of
from simart_kit_plugins.simart.ablation.tables import verdict_lines
from simart_kit_plugins.simart.ablation.variants import VARIANTS, chosen_variants
from simart_kit_plugins.simart.models import build_model
from simart_kit_plugins.simart.training.config import TrainingConfig
from simart_kit_plugins.simart.training.evaluation import evaluate
from simart_kit_plugins.simart.training.grids import Grids, pack
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.usage import Usage

from simart_kit.cli.main import run
from simart_kit.testing.meshes import box

from .vqvae_cases import lively

pytestmark = pytest.mark.slow

TRAINING = {"stage1_steps": 2, "stage2_steps": 6, "batch_size": 2, "warm_up": 4, "checkpoint_every": 100}
KEYS = ["zero", "16x8x8", "codebook-x2", "force-sparse", "dense"]


def tiny(**changes):
    """A block model of 16^3 voxels: 8x8x8 tokens of 2^3 voxels."""
    sizes = {"token_channels": 4, "channels": 8, "neighbour_channels": 2, "hidden_channels": 8}
    base = {"resolution": 16, "grid": "8x8x8", "codebook_size": 9, "encoder_layers": 1, "decoder_layers": 1}
    return VqNanoConfig(**(sizes | base | changes))


def convolutional(**changes):
    """The full network's kind, of the same grids and tokens: its decoder may put voxels anywhere."""
    base = {"resolution": 16, "channels": (2, 4), "blocks_per_level": 0, "middle_blocks": 0}
    return VqvaeConfig(**(base | {"latent_channels": 4, "grid": "8x8x8", "codebook_size": 9} | changes))


def object_with_two_parts():
    """Grids of a whole and its parts: voxels of 2 and 3 of the 8x8x8 cells, one of which is in both."""
    first, second = np.zeros((2, 16, 16, 16), dtype=np.bool_)
    first[0, 0, 0:4] = True  # cells (0, 0, 0) and (0, 0, 1)
    second[1, 1, 3:7] = True  # cells (0, 0, 1), (0, 0, 2) and (0, 0, 3)
    return Grids(16, pack(np.stack([first | second, first, second])), ("a", "a part 0", "a part 1"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    table = {"schema": 1, "model": "vq-nano", "config": tiny().model_dump(mode="json"), "training": TRAINING}
    (tmp_path / "tiny.json").write_text(json.dumps(table))
    (tmp_path / "full.json").write_text(
        json.dumps(
            {**table, "model": "sparse-vqvae", "config": {"resolution": 8, "channels": [2], "grid": "8x8x8"}}
        )
    )
    return tmp_path


def bench(*more, rows="zero,dense", folder="out", config="tiny.json"):
    chosen = ["--rows", rows] if rows else []
    counts = ["--procedural", "1", "--held-out", "1", "--threads", "1"]
    return run(["bench", "vqvae", "--config", config, "--run", folder, *chosen, *counts, *more])


def test_it_prints_both_tables_and_writes_them(home, capfd):
    (home / "meshes").mkdir()
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {}".format(*f) for f in faces + 1]
    (home / "meshes" / "cube.obj").write_text("\n".join(lines) + "\n")

    assert bench("--steps", "4", "--data", "meshes", rows=None) == 0

    out, err = capfd.readouterr()
    titles = [f"  {variant.title} " for variant in VARIANTS]
    assert all(out.count(title) == 3 for title in titles[:4])  # budget, and two blocks of reconstruction
    assert "Each row: 1 + 3 steps of 2 grids = 8 grids seen" in out
    assert "Reconstruction of meshes: 1 grid\n" in out
    # A cube's surface has voxels in all 8^3 cells but the 6^3 inside.
    assert re.search(r"^  Zero sparse +888\.0 +42\.2% +-73\.4% +888\.0 +42\.2% +-73\.4%$", out, re.MULTILINE)
    assert re.search(r"^  Dense +512\.0 +0\.0% +0\.0% +512\.0 ", out, re.MULTILINE)
    assert re.search(r"force sparse .*on CD on 1 grids of meshes in this run", out)
    assert "row codebook-x2: 4 steps on " in err

    written = json.loads((home / "out" / "ablation.json").read_text())
    rows = {row["row"]: row for row in written["rows"]}
    assert [key for key in rows if key != "dense-dropped"] == KEYS
    assert {row["config"]["codebook_size"] for key, row in rows.items() if key != "codebook-x2"} == {9}
    assert rows["codebook-x2"]["config"]["codebook_size"] == 18
    assert rows["16x8x8"]["config"]["grid"] == "16x8x8"
    assert rows["dense-dropped"]["seconds"] is None
    assert written["budget"]["grids_seen"] == 8
    cube = written["tokens"][1]
    assert (cube["objects"], cube["sums"]["whole"]["zero_sparse"]) == (1, {"cells": 296, "tokens": 888})
    text = (home / "out" / "ablation.md").read_text()
    assert text.count("\n| Sparse 16x8x8 | ") == 3
    assert text.startswith("# Ablation of `tiny.json`\n")


def test_a_run_that_was_stopped_goes_on_and_trains_no_row_twice(home, capfd):
    assert bench("-q") == 0
    first = json.loads((home / "out" / "ablation.json").read_text())
    log = (home / "out" / "zero" / "log.csv").read_bytes()
    assert bench() == 2
    assert (
        "out has an ablation already, row zero up to step-0000008: go on with --resume"
        in capfd.readouterr().err
    )

    assert bench("--resume", "--json", rows="zero,force-sparse,dense") == 0

    out, err = capfd.readouterr()
    document = json.loads(out)
    assert [row["row"] for row in document["rows"]] == ["zero", "force-sparse", "dense", "dense-dropped"]
    assert document["rows"][0] == first["rows"][0]
    assert (home / "out" / "zero" / "log.csv").read_bytes() == log
    # Only the new row has lines of its steps.
    after = dict(re.findall(r"^row (\S+):.*\n((?:step .*\n)*)", err, re.MULTILINE))
    assert [name for name, text in after.items() if text] == ["force-sparse"]
    assert bench("--resume", "--steps", "3") == 2
    assert "is of another training config (stage1_steps 2, now 1" in capfd.readouterr().err


def test_ctrl_c_says_how_to_go_on(home, capfd, monkeypatch):
    from simart_kit_plugins.simart.commands.training_display import Display

    def interrupt(self, row, config, codes):
        raise KeyboardInterrupt

    monkeypatch.setattr(Display, "row", interrupt)

    assert bench() == 130
    assert "out keeps what was done: the same command with --resume goes on" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--rows", "zero,sparse"], "--rows: unknown row 'sparse'; rows are zero, 16x8x8, codebook-x2,"),
        (["--rows", ","], "--rows: no row; rows are zero,"),
        (["--steps", "0"], "--steps 0: give at least 1"),
        (["--config", "huge"], "unknown config 'huge'"),
        (
            ["--config", "full.json", "--rows", "16x8x8"],
            "cannot be changed to row '16x8x8' (file: Value error,",
        ),
        (["--data", "nowhere"], "nowhere is no folder"),
        (["--held-out", "0"], "there is nothing to judge on: give --held-out N, --data DIR, or both"),
        (["--seed", "4294967295"], "the seed of the held-out"),
        (["--device", "abacus"], "training options: device: "),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_a_mistake_is_one_line_and_makes_no_run(home, capfd, options, told):
    assert bench(*options) == 2

    (line,) = re.findall(r"^error: .*$", capfd.readouterr().err, re.MULTILINE)
    assert told in line
    assert not (home / "out").exists()


def test_rows_are_of_the_paper_and_in_its_order():
    assert [variant.key for variant in VARIANTS] == KEYS
    assert [variant.key for variant in chosen_variants("dense, zero")] == ["zero", "dense"]
    made = {variant.key: variant.of(VqvaeConfig(grid="16x8x8", mode="dense")) for variant in VARIANTS}
    assert made == {
        "zero": VqvaeConfig(),
        "16x8x8": VqvaeConfig(grid="16x8x8"),
        "codebook-x2": VqvaeConfig(codebook_size=8192),
        "force-sparse": VqvaeConfig(mode="force-sparse"),
        "dense": VqvaeConfig(mode="dense"),
    }


def test_fewer_steps_keep_the_shares_of_stages_and_warm_up():
    preset = TrainingConfig(stage1_steps=100, stage2_steps=300, warm_up=40)

    short = shrunk(preset, 20)

    assert (short.stage1_steps, short.stage2_steps, short.warm_up) == (5, 15, 2)
    assert shrunk(preset, None) == preset


def test_token_counts_of_a_known_object():
    grids = object_with_two_parts()

    found = lengths(grids, (8, 8, 8), None)

    assert (found.objects, found.parts, found.forced) == (1, 2, False)
    assert (found.whole.dense.tokens, found.summed.dense.tokens) == (512, 1024)
    assert (found.whole.zero_sparse.cells, found.summed.zero_sparse.cells) == (4, 5)
    assert (found.whole.zero_sparse.tokens, found.summed.zero_sparse.tokens) == (12, 15)

    kept = np.zeros((3, 8, 8, 8), dtype=np.bool_)
    kept[0, 0], kept[1, 0, 0], kept[2, 0, 0, 0] = True, True, True
    forced = lengths(grids, (8, 8, 8), kept)
    assert (forced.whole.force_sparse.tokens, forced.summed.force_sparse.tokens) == (3 * 64, 3 * (8 + 1))
    assert forced.summed.zero_sparse == found.summed.zero_sparse


def test_parts_belong_to_the_whole_before_them():
    names = ("object 1", "object 1 part 0", "object 12", "a.glb", "a.glb, part 1", "a.glb part", "b, part 1")
    assert objects_of(names) == [[0, 1], [2], [3, 4], [5], [6]]


def test_emptiness_is_the_code_that_most_empty_cells_have():
    model = build_model(tiny(mode="dense"))
    codes = torch.full((3, 8, 8, 8), 7)
    codes[:, 0, 0, :4] = torch.tensor([7, 1, 2, 3])  # the occupied cells, and in the parts one or two more
    codes[:, 7, 7, :6] = 5
    occupied = torch.zeros(3, 8, 8, 8, dtype=torch.bool)
    occupied[:, 0, 0, :4] = True
    encoded = type(model.encode(torch.zeros(1, 1, 16, 16, 16)))(codes, occupied)
    model.encode = lambda voxels: encoded

    found = emptiness(model, object_with_two_parts())

    # Of 512 - 4 empty cells, 6 have code 5: less than 99 % have code 7.
    assert (found.code, found.codes, found.geometry) == (7, 2, 0.25)
    assert found.share == pytest.approx(502 / 508)


@pytest.mark.parametrize("mode", ["zero", "force-sparse", "dense"])
def test_masked_scores_are_those_of_evaluate_and_the_decoder_alone_leaks(mode):
    model, grids = lively(build_model(convolutional(mode=mode))), object_with_two_parts()
    with torch.no_grad():
        model.decoder.out_layer[-1].bias.fill_(1.0)  # on, wherever nothing says otherwise

    judged = judge(model, grids, coding(model))

    expected = evaluate(model, grids.occupancy(range(3)))
    masked = judged.masked
    assert (masked.iou, masked.mse) == pytest.approx((expected.iou, expected.mse))
    assert masked.cd_squared == pytest.approx(expected.cd_squared)
    assert judged.usage == expected.usage
    assert judged.each_alone.mean() == pytest.approx(judged.alone.cd_squared)
    assert (judged.alone.cd_squared > masked.cd_squared) == (mode != "dense")


def test_the_block_model_decodes_nothing_where_there_is_no_token():
    model, grids = lively(build_model(tiny())), object_with_two_parts()
    judged = judge(model, grids, coding(model))
    assert (judged.alone.iou, judged.alone.cd_squared) == (judged.masked.iou, judged.masked.cd_squared)


def test_a_dense_model_without_its_code_of_emptiness_decodes_as_a_force_sparse_one():
    dense = lively(build_model(tiny(mode="dense")))
    voxels = torch.from_numpy(object_with_two_parts().occupancy([0]))[:, None]
    code = int(dense.encode(voxels).codes[0, 7, 7, 7])

    codes, kept = coding_without(dense, code)(voxels)

    assert not kept[0, 7, 7, 7]
    assert codes[~kept].unique().tolist() == [-1]
    logits = as_force_sparse(dense).decode(codes, kept)
    assert logits[0, 0, 14:, 14:, 14:].max() == -torch.inf


def test_the_verdict_gives_both_numbers_and_no_more_than_the_data():
    def row(key, cd, lost):
        scores = Scores(0.1, cd, 0.5, lost)
        each = np.array([cd - 1e-4, cd + 1e-4])
        gone = np.arange(2) < lost
        masked = replace(scores, cd_squared=cd / 2)
        return Row(key, key, tiny(), 1, 1.0, (Judgement(masked, scores, each, gone, Usage(8, 2, 1.5)),))

    grids = object_with_two_parts()
    two = Grids(16, grids.packed[:2], grids.names[:2])
    block = Block("held-out objects", two)

    def told(zero, force):
        return verdict_lines(Ablation(None, (block,), (zero, force), (), None))

    (line,) = told(row("zero", 2e-3, 0), row("force-sparse", 2.1e-3, 0))
    assert line == (
        "The zero token beat force sparse on CD on 2 grids of held-out objects in this run, codes alone: "
        "CD x1e5 200.00 against 210.00, lower on 2 grids, equal on 0; masked 100.00 against 105.00."
    )
    (line,) = told(row("zero", 3e-3, 1), row("force-sparse", 2e-3, 0))
    assert line.startswith("The zero token did not beat force sparse on CD")
    # The first grid is lost to one of the two; the second has the mean's CD and 1e-4 more.
    assert "Of 1 and 0 grids nothing came back" in line
    assert line.endswith("; on the others 310.00 against 210.00.")
    (line,) = told(row("zero", 3e-3, 2), row("force-sparse", 2e-3, 0))
    assert line.endswith(": train longer to compare the two.")
    assert "needs both rows" in told(row("zero", 1, 0), row("dense", 1, 0))[0]


def test_all_rows_start_from_one_autoencoder_if_asked_to(home, capfd):
    table = {"schema": 1, "model": "sparse-vqvae", "config": convolutional().model_dump(mode="json")}
    (home / "conv.json").write_text(json.dumps({**table, "training": TRAINING}))
    assert bench("--autoencoder", "3", config="conv.json") == 0
    start = load_checkpoint(home / "out" / "autoencoder")
    fresh = build_model(start.config, 0)
    assert not torch.equal(start.encoder.input_layer.weight, fresh.encoder.input_layer.weight)
    assert "from an autoencoder of 3 steps" in capfd.readouterr().out

    begun = build_model(start.config.model_copy(update={"mode": "dense"}), 0)
    start_from(begun, start)
    same = zip(begun.decoder.parameters(), start.decoder.parameters(), strict=True)
    assert all(torch.equal(mine, its) for mine, its in same)
    assert bench("--autoencoder", "3", rows="zero", folder="nano") == 2
    assert "vq-nano starts from principal components" in capfd.readouterr().err
