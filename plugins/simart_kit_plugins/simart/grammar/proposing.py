"""Tokens that may well come next: a part's voxels are mostly those of the prompt, in its order."""

from __future__ import annotations

from collections.abc import Sequence

_MOST = 24  # tokens proposed for one pass
_LEAST = 0.5  # chance that all so far are right, below which no more are proposed
_RATE = 0.2  # how fast a chance follows what was right or wrong
_RETURN = 0.01  # how fast a chance that is too low to be tried comes back
_TRIPLET = 3  # <voxel>, coordinate, code


class Proposer:
    """Proposes what follows the same token in the prompt, as far as that is likely to be right.

    A coordinate, which the prompt has once, tells where in it an answer is. How likely the next coordinate,
    the code and another voxel are those of the prompt is learnt on the way, each by itself: a model may
    name the cells of the prompt and give them codes of its own. Proposals change what a pass through the
    model costs, never what is chosen.
    """

    def __init__(self, prompt: Sequence[int], coordinates: range) -> None:
        """Look up where the prompt's ids have these coordinates."""
        self._prompt = list(prompt)
        self._places = {token: place for place, token in enumerate(prompt) if token in coordinates}
        # By place behind a coordinate: the next one, the code, the next <voxel>.
        self._chance = [1.0] * _TRIPLET
        self._first = 0

    def propose(self, written: Sequence[int]) -> list[int]:
        """Tokens that may follow what was written, none where the prompt does not tell."""
        for back, token in enumerate(reversed(written[-2:]), 1):
            if (place := self._places.get(token)) is not None:
                self._first = back
                return self._prompt[place + back : place + back + self._likely()]
        return []

    def learn(self, accepted: int, proposed: int) -> None:
        """Take in how many of the tokens that were proposed last were right."""
        for number in range(min(accepted + 1, proposed)):
            kind = (self._first + number) % _TRIPLET
            self._chance[kind] += _RATE * (float(number < accepted) - self._chance[kind])

    def _likely(self) -> int:
        """How many tokens to propose."""
        chance = 1.0
        for number in range(_MOST):
            kind = (self._first + number) % _TRIPLET
            chance *= self._chance[kind]
            if chance < _LEAST:
                if self._chance[kind] < _LEAST:
                    self._chance[kind] += _RETURN * (1.0 - self._chance[kind])
                return number
        return _MOST
