from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.grammar.decoding import Generated, generate
from simart_kit_plugins.simart.grammar.proposing import Proposer
from simart_kit_plugins.simart.tokens import VoxelTokens
from torch import Tensor, nn

from .bench_grammar import MAX_PARTS, sample
from .grammar_models import GRID, grammar

PAIR = grammar()
WHOLE = VoxelTokens(GRID, np.arange(3, 43), np.arange(100, 140))


class Copier(nn.Module):
    """Wants the answer it was told by the place of each token, and counts its passes."""

    def __init__(self, prompt: int, ids: list[int]) -> None:
        super().__init__()
        self.prompt, self.ids, self.passes = prompt, torch.tensor(ids), 0

    def forward(self, position_ids: Tensor, logits_to_keep: int, **_: Any) -> SimpleNamespace:
        self.passes += 1
        place = position_ids[0, :, -logits_to_keep:] + 1 - self.prompt
        wanted = self.ids[place.clamp(0, len(self.ids) - 1)]
        rows = PAIR.vocabulary.first_id + len(PAIR.vocabulary)
        return SimpleNamespace(logits=nn.functional.one_hot(wanted, rows))


def copied(part: VoxelTokens, jump: bool) -> tuple[Generated, int]:
    """The answer of a model that wants to name these voxels, and how many passes it took."""
    encoded = PAIR.encode_grounding(part, allowed=WHOLE.index)
    prompt = [10, 11, *PAIR.vocabulary.encode(WHOLE).tolist(), 12]
    model = Copier(len(prompt), encoded.ids.tolist())
    ids = torch.tensor([prompt])
    inputs = {"input_ids": ids, "attention_mask": torch.ones_like(ids)}
    (made,) = generate(model, inputs, [PAIR.grounding_machine(WHOLE.index)], max_tokens=999, jump=jump)
    assert made.ids.tolist() == encoded.ids.tolist()
    return made, model.passes


def test_voxels_of_the_prompt_come_many_in_a_pass() -> None:
    made, walked = copied(WHOLE, jump=False)
    # The prompt, and each of 120 voxel tokens; nothing is asked behind the end.
    assert walked == 121
    # No choice: the first <voxel>, the last coordinate, as no other cell is left, and the end.
    assert np.flatnonzero(made.forced).tolist() == [0, 118, 120]
    _, jumped = copied(WHOLE, jump=True)
    assert jumped < 15


def test_proposals_that_are_wrong_are_taken_back() -> None:
    """Cells are left out and codes differ, so that most proposals fail somewhere."""
    part = VoxelTokens(GRID, WHOLE.index[::3], WHOLE.code[::3] + np.arange(14) % 2)
    _, walked = copied(part, jump=False)
    _, jumped = copied(part, jump=True)
    assert jumped < walked


def test_a_proposer_follows_the_prompt_from_a_coordinate_on() -> None:
    proposer = Proposer([1, 50, 7, 1, 51, 7, 1, 52, 8], range(50, 60))
    assert proposer.propose([1, 51]) == [7, 1, 52, 8]
    # Another token than the prompt's behind it: the place is still known.
    assert proposer.propose([50, 99]) == [1, 51, 7, 1, 52, 8]
    assert proposer.propose([50, 99, 98]) == []
    assert proposer.propose([7]) == []
    assert proposer.propose([]) == []


def test_a_proposer_leaves_out_what_is_never_the_prompts() -> None:
    """A model that names the prompt's cells in their order, with codes of its own."""
    prompt = [token for cell in range(30) for token in (1, 50 + cell, 7)]
    proposer = Proposer(prompt, range(50, 80))
    wasted = []
    for cell in range(29):
        after_coordinate = proposer.propose([1, 50 + cell])
        if after_coordinate:
            assert after_coordinate[0] == 7
            proposer.learn(0, len(after_coordinate))
        after_code = proposer.propose([50 + cell, 9])
        assert after_code[:2] == [1, 51 + cell]
        proposer.learn(2, len(after_code))
        wasted.append(len(after_coordinate) + len(after_code) - 2)
    assert sum(wasted[:5]) > 20  # at first it takes the codes for the prompt's
    assert sum(wasted[-10:]) <= 6  # later it tries a code now and then


def test_a_proposer_comes_back_to_codes_that_are_the_prompts_again() -> None:
    prompt = [token for cell in range(60) for token in (1, 50 + cell, 7)]
    proposer = Proposer(prompt, range(50, 110))
    for cell in range(10):
        if proposed := proposer.propose([1, 50 + cell]):
            proposer.learn(0, len(proposed))
    lengths = []
    for cell in range(10, 50):
        proposed = proposer.propose([1, 50 + cell])
        proposer.learn(len(proposed), len(proposed))
        lengths.append(len(proposed))
    assert lengths[0] <= 1
    assert lengths[-1] == 24


@pytest.mark.slow
def test_samples_of_random_weights_parse_and_jumps_take_half_the_time() -> None:
    many = sample(grammar(True, MAX_PARTS), range(300), 25, walk=False)
    assert many.different == 300
    spelt = sample(grammar(False, MAX_PARTS), range(12), 1, walk=True)
    # The measured factor is 2; a busy machine is given some room.
    assert spelt.walking > 1.5 * spelt.jumping
