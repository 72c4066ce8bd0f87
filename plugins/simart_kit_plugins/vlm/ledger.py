"""What the answers of a run took: calls, tokens and money, for its report."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit.mesh import Note
from simart_kit.usage import ModelUsage

from .options import VlmOptions
from .values import Reply

_MILLION = 1e6


@dataclass(frozen=True, slots=True)
class Ledger:
    """A sum over answers; `plus` gives the next one.

    Attributes:
        model: that answered.
        answers: their number.
        cached: how many of them were kept from earlier runs; nothing was spent on these.
        calls: to the model.
        input_tokens: read by it.
        output_tokens: written by it.
        remarks: on how answers came about, each once.
    """

    model: str = ""
    answers: int = 0
    cached: int = 0
    calls: int = 0
    input_tokens: int = 0
    output_tokens: int = 0
    remarks: tuple[str, ...] = ()

    def plus(self, reply: Reply) -> Ledger:
        """With one more answer."""
        used, spent = reply.usage, not reply.usage.cached
        return Ledger(
            reply.model,
            self.answers + 1,
            self.cached + used.cached,
            self.calls + used.calls * spent,
            self.input_tokens + used.input_tokens * spent,
            self.output_tokens + used.output_tokens * spent,
            tuple(dict.fromkeys((*self.remarks, *reply.remarks))),
        )

    def cost(self, options: VlmOptions) -> float:
        """What the tokens cost at the prices of the options, in their currency."""
        read, written = self.input_tokens * options.price_in, self.output_tokens * options.price_out
        return (read + written) / _MILLION

    def usage(self, options: VlmOptions) -> tuple[ModelUsage, ...]:
        """What provenance should say of it; nothing where nothing was asked."""
        if not self.answers:
            return ()
        told = not self.calls or self.input_tokens + self.output_tokens > 0
        priced = told and bool(options.price_in or options.price_out)
        return (
            ModelUsage(
                self.model,
                self.answers,
                self.cached,
                self.calls,
                self.input_tokens if told else None,
                self.output_tokens if told else None,
                self.cost(options) if priced else None,
            ),
        )

    def notes(self, stage: str, options: VlmOptions) -> tuple[Note, ...]:
        """What a report should say of it; nothing where nothing was asked."""
        if not self.answers:
            return ()
        told = f"vision-language model {self.model}, answers: {self.answers}, {self.cached} from the cache"
        if self.calls:
            told += f"; calls: {self.calls}, {self._spent(options)}"
        return tuple(Note(stage, "info", text) for text in (told, *self.remarks))

    def _spent(self, options: VlmOptions) -> str:
        if not self.input_tokens + self.output_tokens:
            return "tokens not told by the server"
        told = f"{self.input_tokens} tokens read, {self.output_tokens} written"
        priced = options.price_in or options.price_out
        return told + (f", cost {self.cost(options):.4g} at the given prices" if priced else "")
