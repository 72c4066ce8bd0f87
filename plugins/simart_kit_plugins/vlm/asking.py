"""A question to its answer: kept from before, or asked, read, asked once more where needed, and kept."""

from __future__ import annotations

from dataclasses import dataclass, replace

from simart_kit.errors import BadInputError

from .cache import Cache
from .http import quoted
from .json_reply import read_answer
from .values import Correction, Question, Reply, Speaker, Usage


@dataclass(frozen=True, slots=True)
class Asking:
    """A `Vlm` of its pieces.

    Attributes:
        model: name of the model.
        speaker: who answers, or None: answers are in the cache, or there are none.
        cache: of answers, or None.
        max_tokens: longest answer, for messages.
    """

    model: str
    speaker: Speaker | None
    cache: Cache | None
    max_tokens: int

    def ask(self, question: Question) -> Reply:
        """See `values.Vlm`."""
        try:
            kept = self.cache.read(question) if self.cache else None
        except BadInputError:
            if self.speaker is None:
                raise
            return self._asked(self.speaker, question, ("a damaged answer in the cache was asked for again",))
        if kept:
            return kept
        if self.speaker is None:
            raise self._not_kept(question)
        return self._asked(self.speaker, question)

    def _asked(self, speaker: Speaker, question: Question, remarks: tuple[str, ...] = ()) -> Reply:
        reply = self._answered(speaker, question)
        if self.cache:
            try:
                self.cache.write(question, reply)
            except TimeoutError:  # of the run's time limit
                raise
            except OSError as error:
                remarks = (*remarks, f"an answer could not be kept in the cache: {error.strerror or error}")
        return replace(reply, remarks=(*remarks, *reply.remarks))

    def _answered(self, speaker: Speaker, question: Question) -> Reply:
        """The answer, at the second try where the first one cannot be used."""
        usage, correction = Usage(), None
        while True:
            completion = speaker.say(question, correction)
            usage = usage.plus(completion)
            try:
                value = read_answer(completion.text, question.answer)
            except BadInputError as error:
                cut = f"it is cut off at max_tokens, {self.max_tokens}: "
                mistake = str(error) if completion.complete else cut + str(error)
            else:
                return Reply(
                    value, usage, self.model, completion.text, completion.remarks + _remarks(correction)
                )
            if correction:
                raise _useless(speaker, mistake, completion.text)
            correction = Correction(completion.text, mistake)

    def _not_kept(self, question: Question) -> BadInputError:
        folder = self.cache.folder if self.cache else "no cache"
        return BadInputError(
            f"replay: {folder} keeps no answer of model {self.model} to the question "
            f"{quoted(question.text)!r}: run once without replay, or give the folder, model and options of "
            "the run that asked it"
        )


def _remarks(correction: Correction | None) -> tuple[str, ...]:
    if correction is None:
        return ()
    return (f"a first answer could not be used ({quoted(correction.mistake)}), the second could",)


def _useless(speaker: Speaker, mistake: str, text: str) -> BadInputError:
    said = quoted(text) or "nothing"
    return BadInputError(f"{speaker.who}: two answers could not be used: {quoted(mistake)}; it said: {said}")
