"""Boxes with lids as instruction data, a plan that is done in a second, and a model of two narrow layers."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import torch
from simart_kit_plugins.simart.answer.values import Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.dataset.record import Pair, Record
from simart_kit_plugins.simart.dataset.record_json import to_json
from simart_kit_plugins.simart.dataset.shards import Entry, ShardWriter, shard_name
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.finetune.plan import FinetunePlan, changed_plan
from simart_kit_plugins.simart.finetune.records import Records
from simart_kit_plugins.simart.mllm.building import build
from simart_kit_plugins.simart.prompt.picture import png
from simart_kit_plugins.simart.prompt.texts import URDF_QUESTION, grounding_question
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from .mllm_cases import SIZE

torch.set_num_threads(1)

GRID = TokenGrid((16, 8, 8), 8192)
PLAN = FinetunePlan(
    size="tiny",
    prompt="none",
    steps=4,
    batch_tokens=1024,
    longest=1024,
    learning_rate=1e-3,
    warm_up=1,
    pool=6,
    log_every=1,
    checkpoint_every=2,
    held_out=0.0,
)


def plan(**changes):
    return changed_plan(PLAN, changes)


def voxels(cells):
    """Tokens of cells; the code of a cell is 100 more than its number."""
    cells = np.array(sorted(cells))
    return VoxelTokens(GRID, cells, cells + 100)


def box(number, state=0, picture=False):
    """An object of `number % 3 + 2` cells of body from cell 8 on, and a lid of one cell above the first."""
    body = [8 + 2 * cell for cell in range(number % 3 + 2)]
    lid = Motion(center=(100, 200, 100), axis=(100, 0, 0), limits=(0, 50))
    parts = (
        PartAnswer("fixed", voxels(body), "box", material="Wood", density=0.6),
        PartAnswer("revolute", voxels([9]), "lid", parent=0, motion=lid, material="Wood", density=0.6),
    )
    pairs = (Pair("urdf", URDF_QUESTION), Pair("grounding", grounding_question("the lid"), 1))
    gray = np.full((64, 64, 3), 40 * (number % 5), dtype=np.uint8)
    return Record(
        f"box-{number}-{state}",
        f"box-{number}",
        "tests",
        "box",
        state,
        voxels([*body, 9]),
        ObjectAnswer(f"box {number}", 10.0 + number, parts),
        pairs,
        png(gray) if picture else None,
    )


def data(folder, shards, held_out=0.0):
    """Records in files, a list of them for each shard."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for number, records in enumerate(shards):
        writer = ShardWriter(folder / shard_name(number), folder / "partial")
        writer.add([Entry(record.key, to_json(record), record.picture) for record in records])
        written.append(folder / writer.close().file)
    return Records(tuple(written), held_out, "tests")


@lru_cache(maxsize=1)
def codec():
    return load_model()


def model(seed=0):
    """A model with fresh weights."""
    return build(SIZE, codec(), seed=seed)
