"""How the rows of `bench mllm` write voxels: dense grids, and sequences of a model without zero token."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.answer.parsing import parse_answer, parse_grounding
from simart_kit_plugins.simart.comparing.counting import output_tokens
from simart_kit_plugins.simart.comparing.dense_form import (
    choices_of,
    grammar_of,
    sparse_ids,
    written_densely,
)
from simart_kit_plugins.simart.comparing.dropping import DroppedEmptiness, Recoder, dropping_codec
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.models import build_model
from simart_kit_plugins.simart.prompt.processor import Processor
from simart_kit_plugins.simart.prompt.values import Prompt
from simart_kit_plugins.simart.tokens import TokenGrid
from simart_kit_plugins.simart.training.grids import Grids, pack
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqvae.checkpoint import save_checkpoint

from simart_kit.errors import BadInputError

from .finetune_cases import GRID, box, voxels
from .mllm_cases import bundle
from .vqvae_cases import lively

CELLS = 1024


@pytest.fixture(scope="module")
def dense():
    return written_densely(bundle())


def without_zero_token(alive=True, **changes):
    """A block model of 16x8x8 cells and 8192 codes that quantises empty cells like all others.

    A lively one gives them many codes; else its encoder sees a cell alone, and they all have one.
    """
    sizes = {"token_channels": 4, "channels": 8, "neighbour_channels": 2, "hidden_channels": 8}
    base = {"grid": "16x8x8", "codebook_size": 8192, "contexts": 1, "candidates": 1, "mode": "dense"}
    layers = {"encoder_layers": 1, "decoder_layers": 1, "codebook_update": "loss"}
    made = build_model(VqNanoConfig(**(sizes | base | layers | changes)))
    return (lively(made) if alive else made).eval()


def cube(*corners):
    """(1, 1, 64, 64, 64) with 2^3 voxels on at each corner."""
    grid = torch.zeros(1, 1, 64, 64, 64)
    for x, y, z in corners:
        grid[0, 0, x : x + 2, y : y + 2, z : z + 2] = 1
    return grid


def test_a_dense_grid_has_a_code_for_every_cell_and_nothing_else(dense):
    ids = dense.vocabulary.encode(voxels([9, 500])) - dense.vocabulary.first_code
    expected = np.zeros(CELLS, dtype=int)
    expected[[9, 500]] = 109, 600
    assert ids.tolist() == expected.tolist()
    with pytest.raises(BadInputError, match="do not fit the vocabulary"):
        dense.vocabulary.encode(replace(voxels([9]), grid=TokenGrid((16, 8, 8), 4096), code=np.array([5])))


def test_dense_grids_become_the_triplets_that_they_stand_for(dense):
    sparse, first = bundle().vocabulary, dense.vocabulary.first_code
    ids = dense.vocabulary.encode(voxels([9, 500])).tolist()
    assert sparse_ids([7, *ids, 8, *ids], sparse) == [
        7,
        *(sparse.first_id, sparse.first_coordinate + 9, first + 109),
        *(sparse.first_id, sparse.first_coordinate + 500, first + 600),
        8,
        *sparse.encode(voxels([9, 500])).tolist(),
    ]
    assert sparse_ids([7, *ids[:-1]], sparse) == [7], "a grid that is cut off is no grid"


def test_what_is_trained_densely_parses_as_the_answer_that_it_was(dense):
    record = box(2)
    grammar = grammar_of(dense)
    encoded = grammar.encode_answer(record.answer, allowed=record.voxels.index)
    parts = parse_answer(grammar.text(encoded.ids), GRID).parts
    assert [part.voxels.index.tolist() for part in parts] == [[8, 10, 12, 14], [9]]
    assert [part.voxels.code.tolist() for part in parts] == [[108, 110, 112, 114], [109]]
    assert [part.name for part in parts] == ["box", "lid"]


def test_the_dense_grammar_leaves_a_choice_only_in_cells_of_the_input(dense):
    encoded = grammar_of(dense).encode_grounding(voxels([10]), allowed=np.array([9, 10, 11]))
    assert len(encoded.ids) == CELLS + 1
    assert np.flatnonzero(~encoded.forced).tolist() == [9, 10, 11]


def test_random_dense_choices_always_parse_and_never_name_an_empty_part(dense):
    grammar, rng, cells = grammar_of(dense), np.random.default_rng(0), np.array([3, 40, 41])
    sizes = set()
    for empty in [True, *[False] * 5]:
        machine, ids = grammar.grounding_machine(cells), []
        while not machine.done:
            token = machine.allowed()[0] if empty or machine.forced() else rng.choice(machine.allowed())
            ids.append(int(token))
            machine.advance(ids[-1])
        named = parse_grounding(grammar.text(ids), GRID, cells)
        sizes.add(len(named.index))
        assert len(ids) == CELLS + 1
    assert min(sizes) == 1, "with emptiness chosen wherever it may be, the last cell must hold something"


def test_emptiness_is_a_choice_of_the_dense_form_alone(dense):
    sparse = choices_of(bundle().vocabulary).codes
    assert sparse.start == bundle().vocabulary.first_code + 1
    assert choices_of(dense.vocabulary).codes == slice(sparse.start - 1, sparse.stop)


def test_the_question_is_in_the_same_form_as_the_answer(dense):
    asked = [Processor.of(one).ids(Prompt("", "?", box(0).voxels)) for one in (bundle(), dense)]
    assert len(asked[1]) - len(asked[0]) == CELLS - 3 * len(box(0).voxels.index)


def test_tokens_are_counted_as_they_are_written(dense):
    records = [box(0), box(2)]  # two parts each; 2 + 1 and 4 + 1 cells
    counted = [output_tokens(one, records, lambda record: record) for one in (bundle(), dense)]
    assert [count.voxels for count in counted] == [3 * (3 + 5) / 2, 2 * CELLS]
    assert counted[0].text == counted[1].text > 0
    assert (counted[0].parts, counted[0].objects) == (2, 2)
    none = output_tokens(dense, records, lambda record: None)
    assert (none.objects, none.all) == (0, 0)


def test_the_code_of_emptiness_and_code_0_change_places():
    model = without_zero_token()
    occupancy = cube((0, 0, 0), (40, 40, 40))
    plain = model.encode(occupancy).codes
    null = int(plain.flatten().mode().values)
    dropped = DroppedEmptiness(model, null)
    codes = dropped.encode(occupancy).codes
    assert torch.equal(codes == 0, plain == null)
    assert torch.equal(codes == null, (plain == 0) & (null != 0))
    others = (plain != null) & (plain != 0)
    assert torch.equal(codes[others], plain[others])
    everywhere = torch.ones_like(plain, dtype=torch.bool)
    assert torch.equal(dropped.decode(codes, everywhere), model.decode(plain, everywhere))
    entries = model.quantiser.entries.detach()
    assert torch.equal(dropped.quantiser.zero_token, entries[null])
    assert torch.equal(dropped.quantiser.entries[null - 1], entries[0])
    assert len(dropped.quantiser.entries) == 8191


def test_records_get_the_codes_of_the_other_model_within_the_cells_of_the_whole():
    model = without_zero_token()
    null = int(model.encode(cube((0, 0, 0))).codes.flatten().mode().values)
    data, codec = load_model().model, DroppedEmptiness(model, null)
    record = box(2)
    found = Recoder(data, codec)(record)
    assert found is not None
    assert found.key == record.key
    cells = set(found.voxels.index.tolist())
    for part, old in zip(found.answer.parts, record.answer.parts, strict=True):
        assert set(part.voxels.index.tolist()) <= cells
        assert (part.name, part.type, part.motion) == (old.name, old.type, old.motion)
    decoded = codec.encode(torch.from_numpy(_decoded(data, record.voxels))[None, None]).codes
    assert found.voxels.dense().tolist() == decoded[0].tolist()


def _decoded(model, tokens):
    from simart_kit_plugins.simart.codec import decode_tokens

    return decode_tokens(model, [tokens])[0]


def test_a_model_of_another_mode_or_grid_is_refused(tmp_path):
    grids = Grids(64, pack(cube((0, 0, 0))[:, 0].numpy() > 0), ("a",))
    save_checkpoint(without_zero_token(), tmp_path / "good")
    found, null = dropping_codec(tmp_path / "good", load_model(), grids)
    assert found.grid == GRID
    assert null.share > 0
    save_checkpoint(without_zero_token(mode="zero"), tmp_path / "zero")
    with pytest.raises(BadInputError, match="mode 'zero': force-sparse sequences need one of mode 'dense'"):
        dropping_codec(tmp_path / "zero", load_model(), grids)
    save_checkpoint(without_zero_token(grid="8x8x8"), tmp_path / "coarse")
    with pytest.raises(BadInputError, match="has 8x8x8 cells and 8192 codes, but the data 16x8x8 and 8192"):
        dropping_codec(tmp_path / "coarse", load_model(), grids)
