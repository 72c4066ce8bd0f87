"""Decoding under a grammar: a model is asked at real choices only, among what is valid there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.errors import BadInputError

from .machine import Machine
from .member import Generated, Member
from .proposing import Proposer

if TYPE_CHECKING:
    from torch import Tensor, nn

    from .stream import Stream

__all__ = ["Generated", "generate"]


def generate(
    model: nn.Module,
    inputs: Mapping[str, Tensor],
    machines: Sequence[Machine],
    *,
    temperature: float = 0.0,
    seed: int | Sequence[int] = 0,
    max_tokens: int,
    jump: bool = True,
) -> list[Generated]:
    """Let a model answer a batch of prompts under the grammar.

    An answer depends on its prompt and seed alone, not on the batch that it is in.

    Args:
        model: a Qwen3-VL for conditional generation, in evaluation mode.
        inputs: what the model reads of the prompts, padded on the left, on the model's device: input_ids,
            attention_mask, and with pictures pixel_values, image_grid_thw and mm_token_type_ids.
        machines: a fresh machine for each prompt; they are used up.
        temperature: 0 takes the likeliest of the allowed tokens; else they are sampled by it.
        seed: of the sampling, one for all members, or one each.
        max_tokens: longest answer, forced tokens and the end included.
        jump: whether a pass through the model takes many tokens: the choice before it, the forced tokens
            behind that, and voxels of the prompt that may well come next, which are kept as far as they are
            what would have been chosen. Without, each token takes a pass; the answers are the same.

    Raises:
        BadInputError: the numbers of prompts, machines and seeds differ, or the temperature is below 0.
    """
    import torch

    from .stream import Stream

    seeds = [seed] * len(machines) if isinstance(seed, int) else list(seed)
    if not len(inputs["input_ids"]) == len(machines) == len(seeds):
        counts = f"{len(inputs['input_ids'])} prompts, {len(machines)} machines and {len(seeds)} seeds"
        raise BadInputError(f"cannot decode {counts}: there must be as many of each")
    if not (temperature >= 0 and np.isfinite(temperature)):
        raise BadInputError(f"temperature {temperature} must be 0 or above")
    prompts = [
        row[mask.bool()].tolist()
        for row, mask in zip(inputs["input_ids"], inputs["attention_mask"], strict=True)
    ]
    members = [
        Member(machine, temperature, one, max_tokens, Proposer(prompt, machine.coordinates) if jump else None)
        for machine, one, prompt in zip(machines, seeds, prompts, strict=True)
    ]
    with torch.inference_mode():
        _answer(Stream(model), inputs, members)
    return [member.result() for member in members]


def _answer(stream: Stream, inputs: Mapping[str, Tensor], members: Sequence[Member]) -> None:
    """Ask the model, pass by pass, until all members have ended."""
    logits, active = stream.read(inputs), list(members)
    while active:
        rejected = [member.write(rows) for member, rows in zip(active, logits, strict=True)]
        going = [row for row, member in enumerate(active) if not member.ended]
        active = [active[row] for row in going]
        if active:
            stream.take_back(rejected)
            stream.keep(going)
            runs = [member.next_run() for member in active]
            logits = stream.add(runs, 1 + max(len(member.proposed) for member in active))
