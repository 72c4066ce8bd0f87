"""What a stage took of a model that it asked: for provenance.json."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class ModelUsage:
    """What the answers of one model took in one stage.

    Attributes:
        model: that was asked.
        answers: their number.
        cached: how many of them were kept from earlier runs; nothing was spent on these.
        calls: to the model.
        input_tokens: read by it, as the server counts them; None where it does not.
        output_tokens: written by it, likewise.
        cost: at the prices that the user gave, in their currency; None without prices.
    """

    model: str
    answers: int
    cached: int = 0
    calls: int = 0
    input_tokens: int | None = None
    output_tokens: int | None = None
    cost: float | None = None

    def table(self) -> dict[str, Any]:
        """Plain values."""
        return asdict(self)
