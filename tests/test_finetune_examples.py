"""Records as examples, and examples as batches."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.finetune.examples import UNCOUNTED, Drawn, ExampleMaker, draw
from simart_kit_plugins.simart.finetune.kinds import KINDS
from simart_kit_plugins.simart.finetune.objective import Objective
from simart_kit_plugins.simart.finetune.packing import batches, collate
from simart_kit_plugins.simart.finetune.plan import KindWeights
from simart_kit_plugins.simart.grammar.grammar import Grammar

from .finetune_cases import box, model, plan


@lru_cache(maxsize=1)
def bundle():
    made = model()
    return replace(made, settings=made.settings.model_copy(update={"prompt": "none"}))


def example(record, pair=0, picture=False, **changes):
    return ExampleMaker(bundle(), plan(**changes)).example(record, Drawn(record.pairs[pair], picture))


def counted(found, kind):
    """Ids of the tokens that were the model's choice and are of a kind."""
    return found.ids[found.kinds == KINDS.index(kind)].tolist()


def test_the_prompt_is_not_in_the_loss_and_the_answer_is_what_the_grammar_writes():
    record = box(1)
    found = example(record)
    answer = Grammar(bundle().tokenizer, bundle().vocabulary).encode_answer(
        record.answer, allowed=record.voxels.index
    )
    first = len(found) - len(answer.ids)
    assert found.ids[first:].tolist() == answer.ids.tolist()
    assert not found.weights[:first].any()
    assert (found.kinds[:first] == UNCOUNTED).all()
    assert (found.weights[first:] == ~answer.forced).all()


def test_codes_of_the_parts_are_counted_as_codes():
    # Number 1 has a body of cells 8, 10, 12 and a lid of cell 9, with codes 100 more.
    codes = [code - bundle().vocabulary.first_code for code in counted(example(box(1)), "code")]
    assert codes == [108, 110, 112, 109]


def test_grounding_is_answered_by_the_cells_of_the_part_alone():
    found = example(box(1), pair=1)
    assert [code - bundle().vocabulary.first_code for code in counted(found, "code")] == [109]
    assert not counted(found, "number")


def test_kinds_are_weighed():
    kinds = KindWeights(coordinate=1.0, code=0.25, number=2.0, word=0.5)
    found = example(box(1), kinds=kinds.model_dump(), forced_weight=0.125)
    weights = {KINDS[kind]: set(found.weights[found.kinds == kind].tolist()) for kind in range(4)}
    assert weights == {"coordinate": {1.0}, "code": {0.25}, "number": {2.0}, "word": {0.5}}
    assert set(found.weights[found.kinds == UNCOUNTED].tolist()) == {0.0, 0.125}


def test_a_record_is_asked_anew_in_each_epoch_in_the_shares_of_the_plan():
    shares = plan(picture_share=0.25, grounding_share=0.5)
    drawn = [draw(box(number), shares, epoch) for number in range(40) for epoch in range(10)]
    assert drawn[7] == draw(box(0), shares, 7)
    assert 0.4 < np.mean([d.pair.task == "grounding" for d in drawn]) < 0.6
    assert 0.15 < np.mean([d.picture for d in drawn]) < 0.35


def test_what_the_grammar_cannot_answer_does_not_fit():
    record = box(0)
    empty = replace(
        record.answer.parts[1], voxels=replace(record.voxels, index=np.array([], int), code=np.array([], int))
    )
    maker = ExampleMaker(bundle(), plan())
    assert maker.fits(record)
    assert not maker.fits(
        replace(record, answer=replace(record.answer, parts=(record.answer.parts[0], empty)))
    )


def single_losses(objective, found, padding):
    """Sum of the losses of each example, alone in its batch."""
    with torch.no_grad():
        return [float(objective(collate([[one]], padding, 1)).total) for one in found]


@pytest.mark.parametrize("picture", [False, True])
@pytest.mark.parametrize("packing", [False, True])
def test_batches_have_the_losses_of_their_examples(packing, picture):
    maker = ExampleMaker(bundle(), plan())
    records = [box(number, picture=True) for number in range(5)]
    found = [maker.example(r, Drawn(r.pairs[n % 2], picture and n != 1)) for n, r in enumerate(records)]
    made = batches(
        found, plan(packing=packing, batch_tokens=2048, multiple=64), maker.padding, np.random.default_rng(0)
    )
    objective = Objective(bundle().model)
    assert sum(batch.tokens for batch in made) == sum(map(len, found))
    with torch.no_grad():
        total = sum(float(objective(batch).total) for batch in made)
    assert total == pytest.approx(sum(single_losses(objective, found, maker.padding)), rel=1e-5)
    assert all(batch.ids.shape[1] % 64 == 0 for batch in made)
    assert all(len(batch.positions) == (4 if packing else 3) for batch in made)


def test_the_loss_is_that_of_the_model_itself():
    maker = ExampleMaker(bundle(), plan())
    record = box(2, picture=True)
    found = maker.example(record, Drawn(record.pairs[0], True))
    with torch.no_grad():
        ours = Objective(bundle().model)(collate([[found]], maker.padding, 64))
        ids = torch.from_numpy(found.ids)[None]
        labels = torch.where(torch.from_numpy(found.weights)[None] > 0, ids, -100)
        theirs = (
            bundle()
            .model(
                input_ids=ids,
                labels=labels,
                pixel_values=torch.from_numpy(found.patches.values),
                image_grid_thw=torch.tensor([found.patches.grid]),
                mm_token_type_ids=(ids == bundle().model.config.image_token_id).long(),
            )
            .loss
        )
    assert float(ours.total / ours.counts.sum()) == pytest.approx(float(theirs), rel=1e-5)


def test_examples_that_are_too_long_are_left_out():
    maker = ExampleMaker(bundle(), plan())
    found = [maker.example(box(0), Drawn(box(0).pairs[n], False)) for n in (0, 1)]
    longest = -(-len(found[1]) // 64) * 64
    assert longest < len(found[0])
    made = batches(found, plan(longest=longest), maker.padding, np.random.default_rng(0))
    assert [batch.tokens for batch in made] == [len(found[1])]
