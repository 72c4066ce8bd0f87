"""What a row is trained on: the same records for all, each in the row's form and codes."""

from __future__ import annotations

from collections.abc import Sequence

from ..dataset.record import Record
from ..finetune.examples import Example, ExampleMaker
from ..finetune.plan import FinetunePlan
from ..mllm.simart_model import SimartModel
from .dense_form import grammar_of
from .dropping import Recode


class RowExamples(ExampleMaker):
    """Makes examples of a row's model."""

    def __init__(self, bundle: SimartModel, plan: FinetunePlan, recode: Recode) -> None:
        """Take the row's model, the plan, and what gives records the row's codes."""
        super().__init__(bundle, plan)
        self._grammar = grammar_of(bundle)
        self._recode = recode

    def fits(self, record: Record) -> bool:
        """Whether the record can be written in the row's codes, and answered."""
        found = self._recode(record)
        return found is not None and super().fits(found)

    def drawn(self, record: Record, epoch: int) -> Example:
        """The example that an epoch asks of a record that fits."""
        found = self._recode(record)
        if found is None:
            raise ValueError(f"record {record.key} does not fit")
        return super().drawn(found, epoch)


def left_out(maker: ExampleMaker, records: Sequence[Record], longest: int) -> float:
    """Share of records that are not trained on: longer than an example may be, or not to be answered."""
    used = [maker.fits(record) and len(maker.drawn(record, 0)) <= longest for record in records]
    return 1 - sum(used) / len(used)
