"""What a token is compared with in the loss: what the grammar would allow, and nothing else."""

import math

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.finetune.choices import NO_CELL, CellChoices, Rows, last_cells, losses
from simart_kit_plugins.simart.finetune.kinds import CODE, COORDINATE, WORD
from simart_kit_plugins.simart.finetune.plan import changed_plan, read_plan
from simart_kit_plugins.simart.tokens import TokenGrid
from simart_kit_plugins.simart.vocabulary import Vocabulary

from simart_kit.errors import BadInputError

VOCABULARY = Vocabulary(TokenGrid((8, 8, 8), 4096), 10)
ROWS = Rows.of(VOCABULARY)


def voxel(cell: int, code: int) -> list[int]:
    return [VOCABULARY.first_id, VOCABULARY.first_coordinate + cell, VOCABULARY.first_code + code]


def test_the_last_cell_lasts_through_a_list_and_not_beyond_it():
    ids = np.array([3, *voxel(5, 9), *voxel(7, 2), 4, VOCABULARY.first_id])
    expected = [NO_CELL, NO_CELL, 5, 5, 5, 7, 7, NO_CELL, NO_CELL]
    assert last_cells(ids, VOCABULARY).tolist() == expected


def test_cells_that_may_come_next_are_the_objects_own_and_later_than_the_last():
    present = torch.zeros(2, 512, dtype=torch.bool)
    present[0, [1, 4, 6]] = True
    present[1, [0, 2]] = True
    choices = CellChoices(present, torch.tensor([[0, 0, 1]]), torch.tensor([[NO_CELL, 4, 0]]))
    allowed = choices.allowed(torch.tensor([[True, True, True]]))
    assert [row.nonzero()[:, 0].tolist() for row in allowed] == [[1, 4, 6], [6], [2]]


def test_with_equal_scores_the_loss_counts_the_choices():
    hidden, head = torch.zeros(3, 4), torch.zeros(10 + len(VOCABULARY), 4)
    targets = torch.tensor([VOCABULARY.first_coordinate + 4, VOCABULARY.first_code + 8, 3])
    allowed = torch.zeros(1, 512, dtype=torch.bool)
    allowed[0, [1, 4, 6]] = True
    kinds = torch.tensor([COORDINATE, CODE, WORD])
    each, _ = losses(hidden, head, targets, kinds, allowed, ROWS)
    # Three cells, all codes but that of emptiness, and ten words with what opens a voxel.
    assert each.tolist() == pytest.approx([math.log(3), math.log(4095), math.log(11)])


def test_a_barred_cell_is_never_the_likeliest():
    head = torch.zeros(10 + len(VOCABULARY), 2)
    head[VOCABULARY.first_coordinate + 5] = torch.tensor([9.0, 0.0])
    allowed = torch.zeros(1, 512, dtype=torch.bool)
    allowed[0, [4, 6]] = True
    head[VOCABULARY.first_coordinate + 6] = torch.tensor([1.0, 0.0])
    target = torch.tensor([VOCABULARY.first_coordinate + 6])
    hidden = torch.tensor([[1.0, 0.0]])
    each, right = losses(hidden, head, target, torch.tensor([COORDINATE]), allowed, ROWS)
    assert right.tolist() == [True]
    assert float(each) == pytest.approx(math.log(1 + math.exp(-1.0)))


@pytest.mark.parametrize("changes", [{"forced_weight": 0.5}, {"fsdp": True}])
def test_what_does_not_go_with_a_constrained_loss_is_told(changes):
    with pytest.raises(BadInputError, match="constrained"):
        changed_plan(read_plan("tiny"), {"constrained": True, **changes})
