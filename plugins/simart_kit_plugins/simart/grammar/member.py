"""One answer of a batch in the making."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, FloatArray, IntArray, frozen_floats, frozen_ints

from .machine import Machine
from .proposing import Proposer


@dataclass(frozen=True, eq=False, slots=True)
class Generated:
    """What a model wrote.

    Attributes:
        ids: (L,) token ids, with the token that ends the answer where it is complete.
        probability: (L,) share that the model gave to each token among those that were allowed; 1 where
            there was no choice.
        forced: (L,) whether there was no choice.
        complete: whether the answer came to its end within the limit; if not, it does not parse.
    """

    ids: IntArray
    probability: FloatArray
    forced: BoolArray
    complete: bool


class Member:
    """An answer that is written pass by pass.

    Attributes:
        proposed: tokens at the end of the last run that nobody has chosen yet.
    """

    def __init__(
        self, machine: Machine, temperature: float, seed: int, limit: int, proposer: Proposer | None
    ) -> None:
        """Begin.

        Args:
            machine: what may be written.
            temperature: 0 takes the likeliest token.
            seed: of the sampling.
            limit: most tokens.
            proposer: proposes tokens; None writes a single token a pass.
        """
        self._machine, self._temperature, self._limit, self._proposer = machine, temperature, limit, proposer
        self._rng = np.random.default_rng(seed)
        self._ids: list[int] = []
        self._probability: list[float] = []
        self._forced: list[bool] = []
        self._unread: list[int] = []
        self.proposed: Sequence[int] = ()

    @property
    def ended(self) -> bool:
        """Whether nothing more is to be written."""
        return self._machine.done or len(self._ids) >= self._limit

    def write(self, logits: Float32Array) -> int:
        """Write what can be told after a pass.

        Choices as long as the proposed tokens are chosen, one more, and the forced tokens behind it.

        Args:
            logits: (P, V); the last row follows the whole run, the one before it all of it but one token.

        Returns:
            How many of the proposed tokens were wrong and must be taken back.
        """
        accepted, known = 0, logits[len(logits) - len(self.proposed) - 1 :]
        while not self.ended:
            if self._machine.forced():
                token = self._append(self._machine.forced()[0], 1.0, True)
            elif self._unread:
                break
            else:
                token = self._choice(known[accepted])
            if not self._unread and self.proposed[accepted : accepted + 1] == [token]:
                accepted += 1
            else:
                self._unread.append(token)
            if self._proposer is None:
                break
        if self._proposer is not None and self.proposed:
            self._proposer.learn(accepted, len(self.proposed))
        return len(self.proposed) - accepted

    def next_run(self) -> list[int]:
        """What the model must read next: tokens that were written, and tokens that may come next."""
        run, self._unread = self._unread, []
        self.proposed = [] if self._proposer is None else self._proposer.propose(self._ids)
        return [*run, *self.proposed]

    def result(self) -> Generated:
        """What was written."""
        forced = np.array(self._forced, dtype=np.bool_)
        return Generated(frozen_ints(self._ids), frozen_floats(self._probability), forced, self._machine.done)

    def _choice(self, logits: Float32Array) -> int:
        allowed = self._machine.allowed()
        place, probability = _choose(logits[allowed], self._temperature, self._rng)
        return self._append(int(allowed[place]), probability, False)

    def _append(self, token: int, probability: float, forced: bool) -> int:
        self._machine.advance(token)
        self._ids.append(token)
        self._probability.append(probability)
        self._forced.append(forced)
        return token


def _choose(logits: Float32Array, temperature: float, rng: np.random.Generator) -> tuple[int, float]:
    """Place of the chosen one among (A,) logits, and its share at temperature 1."""
    above = logits.astype(np.float64) - logits.max()
    weight = np.exp(above)
    if temperature == 0:
        place = int(above.argmax())
    else:
        sums = np.exp(above / temperature).cumsum()
        place = int(np.searchsorted(sums, rng.random() * sums[-1], side="right"))
    return place, float(weight[place] / weight.sum())
