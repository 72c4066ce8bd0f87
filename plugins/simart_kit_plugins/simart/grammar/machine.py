"""Running a script: with an answer, to encode it; without, as the state machine that decodes one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, IntArray, frozen_ints

from .pen import Point, Writing


@dataclass(frozen=True, eq=False, slots=True)
class Encoded:
    """An answer as ids, with the token that ends it.

    Attributes:
        ids: (L,) token ids.
        forced: (L,) whether the grammar leaves no choice about a token. Training may leave these out of the
            loss, since decoding never asks a model for them.
    """

    ids: IntArray
    forced: BoolArray


def encode(script: Writing[None]) -> Encoded:
    """The ids of the answer that a script was given.

    Raises:
        ValueError: the script wants what it does not allow, or wants nothing.
    """
    ids: list[int] = []
    forced: list[bool] = []
    try:
        point = next(script)
        while True:
            if point.wanted is None or point.wanted not in point.allowed:
                raise ValueError(f"token {len(ids)}: the grammar does not allow id {point.wanted}")
            ids.append(point.wanted)
            forced.append(len(point.allowed) == 1)
            point = script.send(point.wanted)
    except StopIteration:
        return Encoded(frozen_ints(ids), np.array(forced, dtype=np.bool_))


class Machine:
    """What may be written next. It always stands at a real choice, behind a run of forced tokens.

    Whoever decodes appends `forced()`, asks the model for one of `allowed()`, and tells each id that was
    appended, forced or not, to `advance`, until the machine is `done`.

    Attributes:
        coordinates: ids of all cells of the grid, which a prompt and an answer share.
    """

    def __init__(self, script: Writing[None], coordinates: range) -> None:
        """Start a script that was given no answer."""
        self._script, self.coordinates = script, coordinates
        self._run: list[int] = []
        self._point: Point | None = None
        self._follow(next(script, None))

    @property
    def done(self) -> bool:
        """Whether the answer is complete, the token that ends it included."""
        return not self._run and self._point is None

    def forced(self) -> tuple[int, ...]:
        """Ids that come next without a choice; () at a choice."""
        return tuple(self._run)

    def allowed(self) -> IntArray:
        """(A,) ids of which one comes next; none when all is done."""
        if self._run:
            return frozen_ints(self._run[:1])
        return frozen_ints([]) if self._point is None else self._point.allowed

    def advance(self, token: int) -> None:
        """Append a token; raises ValueError for one that is not allowed."""
        if self._run and token == self._run[0]:
            self._run.pop(0)
            return
        if self._run or self._point is None or token not in self._point.allowed:
            raise ValueError(f"token {token} is not allowed here")
        self._follow(self._send(token))

    def _send(self, token: int) -> Point | None:
        try:
            return self._script.send(token)
        except StopIteration:
            return None

    def _follow(self, point: Point | None) -> None:
        """Go through forced points up to the next choice, or the end."""
        while point is not None and len(point.allowed) == 1:
            token = int(point.allowed[0])
            self._run.append(token)
            point = self._send(token)
        self._point = point
