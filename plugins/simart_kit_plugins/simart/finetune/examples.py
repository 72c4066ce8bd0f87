"""Records as examples: what the model reads, what it should write, and how much each token counts."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, IntArray

from ..dataset.record import Pair, Record
from ..grammar.grammar import Encoded, Grammar
from ..mllm.simart_model import SimartModel
from ..prompt.picture import from_png
from ..prompt.pixels import Patches
from ..prompt.processor import Processor
from ..prompt.sequences import TokenSequence
from ..prompt.texts import system_prompt
from ..prompt.values import Prompt
from .adapters import plain_model
from .choices import last_cells, present_cells
from .kinds import kind_weights, token_kinds
from .plan import FinetunePlan

UNCOUNTED = -1


@dataclass(frozen=True, eq=False)
class Example:
    """A prompt and its answer as one sequence of L tokens.

    Attributes:
        key: of the record.
        ids: (L,) tokens.
        positions: (3, L) places in time, height and width for the rotary embedding.
        weights: (L,) weight of each token in the loss; 0 on the prompt.
        kinds: (L,) place in `KINDS` of each token that was the model's choice, else `UNCOUNTED`.
        present: (C,) bool, cells of the object.
        last: (L,) the last cell that the same part has at each place, as `CellChoices.last`.
        patches: of the picture, or None.
    """

    key: str
    ids: IntArray
    positions: IntArray
    weights: Float32Array
    kinds: IntArray
    present: BoolArray
    last: IntArray
    patches: Patches | None

    def __len__(self) -> int:
        return len(self.ids)


@dataclass(frozen=True)
class Drawn:
    """How a record is asked.

    Attributes:
        pair: the question.
        picture: whether the picture is shown.
    """

    pair: Pair
    picture: bool


class ExampleMaker:
    """Makes examples of one model's kind.

    Args:
        bundle: its tokenizer, vocabulary and settings are used, and how it places tokens.
        plan: shares and weights.
    """

    def __init__(self, bundle: SimartModel, plan: FinetunePlan) -> None:
        self._plan = plan
        self._vocabulary = bundle.vocabulary
        self._grammar = Grammar(bundle.tokenizer, bundle.vocabulary)
        self._processor = Processor.of(bundle)
        self._place = plain_model(bundle.model).model.get_rope_index
        self._kinds = token_kinds(bundle.tokenizer, bundle.vocabulary)
        self._kind_weights = np.array(kind_weights(plan.kinds), dtype=np.float32)
        self._system = system_prompt(bundle.vocabulary.grid, bundle.settings.prompt)
        self.padding = self._processor.pad

    def fits(self, record: Record) -> bool:
        """Whether the grammar can write the answer: not too many parts, and none without voxels."""
        parts = record.answer.parts
        return len(parts) <= self._grammar.max_parts and all(len(part.voxels.index) for part in parts)

    def drawn(self, record: Record, epoch: int) -> Example:
        """The example that an epoch asks of a record; the seed, the epoch and the key decide."""
        return self.example(record, draw(record, self._plan, epoch))

    def example(self, record: Record, drawn: Drawn) -> Example:
        """The example of a question."""
        answer = encoded(self._grammar, record, drawn.pair)
        return self._joined(record, self._processor.sequence(self.prompt(record, drawn)), answer)

    def prompt(self, record: Record, drawn: Drawn) -> Prompt:
        """What the model is asked."""
        shown = drawn.picture and record.picture is not None
        picture = from_png(record.picture) if shown and record.picture is not None else None
        return Prompt(self._system, drawn.pair.question, record.voxels, picture)

    def _joined(self, record: Record, asked: TokenSequence, answer: Encoded) -> Example:
        ids = np.concatenate([asked.ids, answer.ids]).astype(np.int64)
        first = len(asked.ids)
        weights = np.zeros(len(ids), dtype=np.float32)
        kinds = np.full(len(ids), UNCOUNTED)
        chosen = np.asarray(self._kinds[answer.ids])
        weights[first:] = np.where(answer.forced, self._plan.forced_weight, self._kind_weights[chosen])
        kinds[first:] = np.where(answer.forced, UNCOUNTED, chosen)
        return Example(
            key=record.key,
            ids=ids,
            positions=self._positions(ids, asked.patches),
            weights=weights,
            kinds=kinds,
            present=present_cells(record.voxels.index, self._vocabulary),
            last=last_cells(ids, self._vocabulary),
            patches=asked.patches,
        )

    def _positions(self, ids: IntArray, patches: Patches | None) -> IntArray:
        """(3, L), as the model itself gives them to a sequence that stands alone."""
        if patches is None:
            return np.tile(np.arange(len(ids)), (3, 1))
        import torch

        tokens = torch.from_numpy(ids)[None]
        types = (tokens == self._processor.image).long()
        grid = torch.tensor([patches.grid])
        positions, _ = self._place(tokens, mm_token_type_ids=types, image_grid_thw=grid)
        return np.asarray(positions[:, 0].numpy())


def encoded(grammar: Grammar, record: Record, pair: Pair) -> Encoded:
    """What answers a question, as tokens."""
    cells = record.voxels.index
    if pair.task == "grounding" and pair.part is not None:
        return grammar.encode_grounding(record.answer.parts[pair.part].voxels, allowed=cells)
    return grammar.encode_answer(record.answer, allowed=cells)


def draw(record: Record, plan: FinetunePlan, epoch: int) -> Drawn:
    """How an epoch asks a record."""
    rng = np.random.default_rng((plan.seed, epoch, zlib.crc32(record.key.encode())))
    ask_part, see, pick = rng.random(3)
    task = "grounding" if ask_part < plan.grounding_share else "urdf"
    pairs = [pair for pair in record.pairs if pair.task == task] or list(record.pairs)
    pair = pairs[int(pick * len(pairs))]
    return Drawn(pair, bool(see < plan.picture_share))
