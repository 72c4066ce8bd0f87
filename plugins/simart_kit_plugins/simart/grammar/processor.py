"""The grammar for `model.generate` of transformers: what is not allowed gets a score of minus infinity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import torch
from torch import FloatTensor, LongTensor
from transformers import LogitsProcessor

from .machine import Machine


class GrammarProcessor(LogitsProcessor):  # type: ignore[misc]  # transformers leaves its base classes untyped
    """Keeps greedy search and sampling within the grammar, a token at a time and without jumps.

    It follows the rows of one batch through one call of `generate`; beam search, which changes rows, is not
    supported. A row that is complete goes on with the token that ended it.
    """

    def __init__(self, machines: Sequence[Machine]) -> None:
        """Take a fresh machine for each prompt of the batch; they are used up."""
        self._machines = list(machines)
        self._seen = -1

    def __call__(self, input_ids: LongTensor, scores: FloatTensor) -> FloatTensor:
        """(B, V) scores, minus infinity where a token is not allowed behind (B, L) ids.

        Raises:
            ValueError: the batch has another size, or its rows are not those of the call before.
        """
        if len(input_ids) != len(self._machines) or self._seen not in (-1, input_ids.shape[1] - 1):
            raise ValueError(
                "a GrammarProcessor serves one generate() without beams, a machine for each prompt"
            )
        masked = torch.full_like(scores, -torch.inf)
        for row, machine in enumerate(self._machines):
            if self._seen >= 0 and not machine.done:
                machine.advance(int(input_ids[row, -1]))
            allowed = (
                input_ids[row, -1:] if machine.done else torch.tensor(machine.allowed()).to(scores.device)
            )
            masked[row, allowed] = scores[row, allowed]
        self._seen = input_ids.shape[1]
        return cast(FloatTensor, masked)
