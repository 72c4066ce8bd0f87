"""Scores of answers, and of guesses that need no model."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from simart_kit_plugins.simart.answer.values import Motion
from simart_kit_plugins.simart.finetune.baselines import borrowed, still
from simart_kit_plugins.simart.finetune.evaluation import baselines, evaluate, questions
from simart_kit_plugins.simart.finetune.scores import score

from .finetune_cases import box, model, voxels

# A body of cells 8, 10 and 12, and a lid of cell 9 that turns about x.
TRUE = box(1).answer


def with_lid(**changes):
    body, lid = TRUE.parts
    return replace(TRUE, parts=(body, replace(lid, **changes)))


def test_the_true_answer_is_perfect():
    found = score([TRUE], [TRUE], [1.0])
    assert (found.complete, found.count, found.iou, found.moving_iou, found.type) == (1, 1, 1, 1, 1)
    assert (found.spurious, found.axis, found.line, found.grounding_iou) == (0, 0, 0, 1)


def test_a_lid_that_is_too_large_turns_about_y_half_an_edge_away():
    # Two cells of which one is right; the axis (0, 1, 0) is at a right angle to x; its point is 100 of 200
    # grid points lower than the true line along x.
    wrong = Motion(center=(100, 100, 100), axis=(0, 100, 0), limits=(0, 50))
    found = score([TRUE], [with_lid(voxels=voxels([9, 11]), motion=wrong)])
    assert found.moving_iou == pytest.approx(0.5)
    assert found.iou == pytest.approx(0.75)
    assert found.type == 1
    assert found.axis == pytest.approx(np.pi / 2)
    assert found.line == pytest.approx(0.5)


def test_another_type_is_wrong_and_its_axis_does_not_count():
    slide = Motion(center=(100, 200, 100), axis=(0, 0, 100), limits=(0, 50))
    found = score([TRUE], [with_lid(type="prismatic", motion=slide)])
    assert (found.type, found.axis, found.line, found.moving_iou) == (0, None, None, 1)


def test_parts_that_are_missed_or_made_up_cost():
    found = score([TRUE, TRUE], [with_lid(voxels=voxels([60])), None])
    # The lid lies elsewhere: it is missed, and what is there instead is spurious. The second is not complete.
    assert (found.complete, found.count, found.moving_iou, found.type) == (0.5, 0.5, 0, 0)
    assert found.iou == pytest.approx(0.25)
    assert found.spurious == 0.5


def test_guesses_are_valid_answers_with_the_cells_of_the_object():
    record, other = box(1), box(2)
    assert [part.voxels.index.tolist() for part in still(record).parts] == [[8, 9, 10, 12]]
    # The other has 4 cells of body and 1 of lid; of 4 cells the shares are 3.2 and .8, at least one each.
    guess = borrowed(record, [other], np.random.default_rng(0))
    assert [len(part.voxels.index) for part in guess.parts] == [3, 1]
    cells = np.concatenate([part.voxels.index for part in guess.parts])
    assert sorted(cells.tolist()) == [8, 9, 10, 12]


def test_guesses_are_scored():
    found = baselines([box(1), box(2)], [box(0)])
    assert (found["nothing moves"].type, found["nothing moves"].count) == (0, 0)
    # The body has 3 of 4 and 4 of 5 cells of the object, the lids none.
    assert found["nothing moves"].iou == pytest.approx((0.75 + 0 + 0.8 + 0) / 4)
    assert found["borrowed at random"].count == 1
    assert found["borrowed at random"].grounded == 2


@lru_cache(maxsize=1)
def bundle():
    made = model()
    return replace(made, settings=made.settings.model_copy(update={"prompt": "none"}))


@pytest.mark.slow
def test_a_model_that_learnt_nothing_gives_answers_that_parse():
    records = [box(0, picture=True), box(1)]
    whole, parts = questions(records)
    assert [question.pair.task for question in whole + parts] == ["urdf"] * 2 + ["grounding"] * 2
    found = evaluate(bundle(), records)
    assert (found.objects, found.complete, found.grounded) == (2, 1, 2)
    assert 0 <= found.iou < 1
