"""Tokens that may well come next: a part's voxels are mostly those of the prompt, in its order."""

from __future__ import annotations

from collections.abc import Sequence

_MOST = 24


class Proposer:
    """Proposes what follows the same token in the prompt, as long as that has been right.

    A coordinate, which the prompt has once, tells where in it an answer is. Proposals change what a pass
    through the model costs, never what is chosen.
    """

    def __init__(self, prompt: Sequence[int], coordinates: range) -> None:
        """Look up where the prompt's ids have these coordinates."""
        self._prompt = list(prompt)
        self._places = {token: place for place, token in enumerate(prompt) if token in coordinates}
        self._length = _MOST // 4

    def propose(self, written: Sequence[int]) -> list[int]:
        """Tokens that may follow what was written, none where the prompt does not tell."""
        for back, token in enumerate(reversed(written[-2:]), 1):
            if (place := self._places.get(token)) is not None:
                return self._prompt[place + back : place + back + self._length]
        return []

    def learn(self, accepted: int) -> None:
        """Propose more where much was right, and less where little was."""
        self._length = min(2 * accepted + 1, _MOST)
