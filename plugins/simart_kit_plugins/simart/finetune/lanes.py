"""A lane: an endless, resumable row of batches. A step takes one batch of every lane."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simart_kit.errors import BadInputError

from ..dataset.record import Record
from .examples import ExampleMaker
from .packing import Batch, batches
from .plan import FinetunePlan
from .records import Records


@dataclass(frozen=True, slots=True)
class Place:
    """Where a lane stands.

    Attributes:
        epoch: times that the records were gone through.
        pool: pools of this epoch that are done.
        batch: batches of this pool that are done.
    """

    epoch: int = 0
    pool: int = 0
    batch: int = 0


class Lane:
    """One lane of a run; its batches depend on the seed, its number and its place only.

    Args:
        records: to ask.
        maker: makes examples of them.
        plan: seed, lanes, pool and batches.
        number: 0..lanes-1.
        place: where to go on.

    Attributes:
        place: after the last batch that was taken.
        left_out: records that were too long, or that the grammar cannot answer.
    """

    def __init__(
        self, records: Records, maker: ExampleMaker, plan: FinetunePlan, number: int, place: Place
    ) -> None:
        self.place = place
        self.left_out = 0
        self._records, self._maker, self._plan, self._number = records, maker, plan, number
        self._walk = self._batches(place)

    def take(self) -> Batch:
        """The next batch.

        Raises:
            BadInputError: there is none in a whole epoch.
        """
        batch, self.place = next(self._walk)
        return batch

    def _batches(self, start: Place) -> Iterator[tuple[Batch, Place]]:
        for epoch in itertools.count(start.epoch):
            found = False
            for number, pool in enumerate(self._pools(epoch)):
                found = True
                if epoch == start.epoch and number < start.pool:
                    continue
                done = start.batch if (epoch, number) == (start.epoch, start.pool) else 0
                for count, batch in enumerate(self._made(pool, epoch, number)[done:], done + 1):
                    yield batch, Place(epoch, number, count)
            if not found or (epoch > start.epoch and self.place.epoch < epoch):
                raise BadInputError(
                    f"lane {self._number} of {self._plan.lanes} has no example of at most "
                    f"{self._plan.longest} tokens: give more records, fewer lanes or a larger longest"
                )

    def _pools(self, epoch: int) -> Iterator[list[Record]]:
        own = self._records.training(self._plan.seed, epoch, self._number, self._plan.lanes)
        while pool := list(itertools.islice(own, self._plan.pool)):
            yield pool

    def _made(self, pool: list[Record], epoch: int, number: int) -> list[Batch]:
        examples = [self._maker.drawn(record, epoch) for record in pool if self._maker.fits(record)]
        fitting = sum(len(example) <= self._plan.longest for example in examples)
        self.left_out += len(pool) - fitting
        rng = np.random.default_rng((self._plan.seed, epoch, number, self._number))
        return batches(examples, self._plan, self._maker.padding, rng)
