"""Several processes take the steps of one; FSDP2 shares weights out, adapters train few of them."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from simart_kit_plugins.simart.finetune.evaluation import evaluate
from simart_kit_plugins.simart.finetune.loop import finetune
from simart_kit_plugins.simart.finetune.plan import Lora
from simart_kit_plugins.simart.finetune.records import Records
from simart_kit_plugins.simart.mllm.bundle import load_bundle

from .finetune_cases import box, data, model, plan

ROOT = Path(__file__).parent.parent
_SCRIPT = """
import sys
from pathlib import Path
from tests.test_finetune_processes import trained
trained(Path(sys.argv[1]), fsdp=sys.argv[2] == "fsdp", resume=sys.argv[3] == "resume")
"""


def records(folder):
    return data(folder, [[box(number, picture=True) for number in range(8)]])


def trained(folder, fsdp=False, resume=False):
    """Two steps of two lanes, half of the questions with a picture; the data lie beside the folder."""
    config = plan(steps=2, lanes=2, picture_share=0.5, fsdp=fsdp, checkpoint_every=1, learning_rate=1e-4)
    there = Records((folder.parent / "data" / "shard-000000.tar",), 0.0, "tests")
    return finetune(model(), there, config, folder, device="cpu", resume=resume)


def two_processes(folder, mode, resume="begin"):
    records(folder.parent / "data")
    script = folder.parent / "script.py"
    script.write_text(_SCRIPT)
    command = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2"]
    arguments = [str(script), str(folder), mode, resume]
    paths = {"PYTHONPATH": f"{ROOT}:{ROOT / 'plugins'}", "OMP_NUM_THREADS": "1", "ACCELERATE_USE_CPU": "true"}
    done = subprocess.run(
        [*command, *arguments], cwd=ROOT, env=os.environ | paths, capture_output=True, text=True, timeout=280
    )
    assert done.returncode == 0, done.stderr[-3000:]


def losses(folder):
    with (folder / "log.csv").open(newline="") as file:
        return [(float(row["loss"]), float(row["norm"]), int(row["tokens"])) for row in csv.DictReader(file)]


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["fsdp", "copies"])
def test_two_processes_take_the_steps_of_one(tmp_path, mode):
    records(tmp_path / "data")
    trained(tmp_path / "one")
    two_processes(tmp_path / "two", mode)
    assert len(losses(tmp_path / "two")) == 2
    for one, two in zip(losses(tmp_path / "one"), losses(tmp_path / "two"), strict=True):
        assert two == pytest.approx(one, rel=2e-4)
    one, two = (load_file(tmp_path / name / "model" / "model.safetensors") for name in ("one", "two"))
    assert one.keys() == two.keys()
    # A step moves no weight by more than the rates, 1e-4 at most; where a gradient is nothing but rounding,
    # AdamW may go either way.
    assert max(float((one[name] - two[name]).abs().max()) for name in one) < 5e-4
    same = [float(((one[name] - two[name]).abs() < 1e-6).float().mean()) for name in one]
    assert sum(same) / len(same) > 0.95


@pytest.mark.slow
def test_shared_out_weights_are_kept_and_gone_on_with(tmp_path):
    run = tmp_path / "run"
    two_processes(run, "fsdp")
    last = run / "checkpoints" / "step-0000002"
    assert sorted(path.name for path in last.iterdir()) == [
        "rank-00000.safetensors",
        "rank-00001.safetensors",
        "state.json",
    ]
    before = (run / "model" / "model.safetensors").read_bytes()
    shutil.rmtree(last)  # as if the run had been killed after its first step
    two_processes(run, "fsdp", "resume")
    assert (run / "model" / "model.safetensors").read_bytes() == before


def test_adapters_train_few_weights_and_are_read_beside_their_base(tmp_path):
    base = model()
    before = {name: tensor.clone() for name, tensor in base.model.state_dict().items()}
    config = plan(steps=2, lora=Lora(rank=4, alpha=8.0).model_dump(), learning_rate=1e-2, evaluate_every=1)
    judged = []
    folder = finetune(
        base,
        records(tmp_path / "data"),
        config,
        tmp_path / "run",
        device="cpu",
        judge=lambda bundle, step: judged.append((step, evaluate(bundle, [box(0)]).objects)),
    )
    assert judged == [(1, 1)]
    loaded = load_bundle(str(folder), device="cpu")
    size = (folder / "adapter_model.safetensors").stat().st_size
    assert size < sum(tensor.numel() * 4 for tensor in before.values())
    plain = loaded.model.get_base_model().state_dict()
    layer = "model.language_model.layers.0.self_attn.q_proj"
    assert torch.equal(plain[f"{layer}.base_layer.weight"], before[f"{layer}.weight"])
    assert plain[f"{layer}.lora_B.default.weight"].abs().max() > 0
