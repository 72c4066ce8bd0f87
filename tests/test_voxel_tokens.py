"""Voxel tokens: their forms and the ways between them, and counting."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from simart_kit_plugins.simart.token_counts import SequenceLength, token_counts
from simart_kit_plugins.simart.token_parser import parse
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens
from simart_kit_plugins.simart.vocabulary import Vocabulary

from simart_kit.errors import BadInputError

SMALL = TokenGrid()
TALL = TokenGrid((16, 8, 8), 8192)
GRIDS = [TokenGrid(shape, codebook) for shape in ((8, 8, 8), (16, 8, 8)) for codebook in (4096, 8192)]
PAPER = "<voxel> 43 1930 <voxel> 44 7"


def ints(*values):
    return np.array(values, dtype=np.int64)


def pairs(tokens):
    return list(zip(tokens.index.tolist(), tokens.code.tolist(), strict=True))


@st.composite
def cell_codes(draw):
    """A grid, and a dict of cell to code that is the independent record of what the tokens hold."""
    grid = draw(st.sampled_from(GRIDS))
    cells = st.integers(0, grid.shape[0] * 64 - 1)
    return grid, draw(st.dictionaries(cells, st.integers(1, grid.codebook - 1), max_size=40))


def tokens_of(grid, codes):
    return VoxelTokens(grid, ints(*sorted(codes)), ints(*(codes[cell] for cell in sorted(codes))))


# ---- the grid


def test_both_shapes_share_the_papers_index_formula():
    # 64 * 5 + 8 * 2 + 3 = 339; 64 * 15 + 8 * 7 + 7 = 1023, the last index of the paper's prompt.
    assert int(SMALL.index(ints(5, 2, 3))) == 339
    assert int(TALL.index(ints(15, 7, 7))) == 1023
    assert SMALL.coordinates(ints(0, 1, 8, 64)).tolist() == [[0, 0, 0], [0, 0, 1], [0, 1, 0], [1, 0, 0]]


@pytest.mark.parametrize("grid", GRIDS)
def test_every_index_comes_back_from_its_coordinate(grid):
    every = np.arange(grid.cells, dtype=np.uint64)
    assert grid.index(grid.coordinates(every)).tolist() == every.tolist()
    assert grid.coordinates(every).tolist() == np.argwhere(np.ones(grid.shape)).tolist()


def test_cells_cover_the_voxels():
    assert (SMALL.cells, SMALL.block) == (512, (8, 8, 8))
    assert (TALL.cells, TALL.block) == (1024, (4, 8, 8))


@pytest.mark.parametrize(("grid", "x"), [(SMALL, 1), (TALL, 3)])
def test_one_voxel_occupies_the_cell_that_holds_it(grid, x):
    # Voxel (15, 16, 63): x // 8 = 1 or x // 4 = 3, 16 // 8 = 2, 63 // 8 = 7.
    occupancy = np.zeros((64, 64, 64), dtype=np.bool_)
    occupancy[15, 16, 63] = True
    occupied = grid.occupied_cells(occupancy)
    assert np.argwhere(occupied).tolist() == [[x, 2, 7]]
    assert not occupied.flags.writeable


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(GRIDS), arrays(np.uint8, (12, 3), elements=st.integers(0, 63)))
def test_cells_are_occupied_by_what_floor_division_gives(grid, voxels):
    occupancy = np.zeros((64, 64, 64), dtype=np.bool_)
    occupancy[tuple(voxels.T)] = True
    expected = {
        tuple(voxel // size for voxel, size in zip(v, grid.block, strict=True)) for v in voxels.tolist()
    }
    assert set(map(tuple, np.argwhere(grid.occupied_cells(occupancy)).tolist())) == expected


# ---- round trips


@settings(max_examples=150, deadline=None)
@given(cell_codes(), st.integers(0, 2**20))
@example((TALL, {}), 151_670)
@example((TALL, {0: 1, 1023: 8191}), 0)
def test_all_forms_of_the_same_tokens_agree(case, first_id):
    grid, codes = case
    tokens, vocabulary, expected = tokens_of(grid, codes), Vocabulary(grid, first_id), sorted(codes.items())
    ids = vocabulary.encode(tokens)
    names = vocabulary.names
    assert len(ids) == 3 * len(codes)
    assert "".join(names[i - first_id] for i in ids.tolist()) == tokens.atoms()
    assert pairs(VoxelTokens.from_dense(grid, tokens.dense())) == expected
    assert pairs(parse(tokens.text(), grid)) == expected
    assert pairs(parse(tokens.atoms(), grid)) == expected
    assert pairs(parse(tokens.atoms().replace(">", "> "), grid)) == expected
    assert pairs(vocabulary.decode(ids)) == expected
    assert pairs(vocabulary.decode(ids.tolist(), allowed=tokens.index)) == expected


@settings(max_examples=50, deadline=None)
@given(cell_codes())
def test_the_dense_form_holds_each_code_at_its_coordinate_and_zero_elsewhere(case):
    grid, codes = case
    dense = tokens_of(grid, codes).dense()
    assert dense.shape == grid.shape
    assert {64 * x + 8 * y + z: int(dense[x, y, z]) for x, y, z in np.argwhere(dense).tolist()} == codes


def test_the_text_form_is_the_one_that_the_paper_prints():
    tokens = VoxelTokens(SMALL, ints(43, 44), ints(1930, 7))
    assert tokens.text() == PAPER
    assert tokens.atoms() == "<voxel><xyz_43><mesh_1930><voxel><xyz_44><mesh_7>"
    # 43 = 8 * 5 + 3
    assert tokens.coordinates.tolist() == [[0, 5, 3], [0, 5, 4]]


# ---- ids


@pytest.mark.parametrize("grid", GRIDS)
def test_ids_follow_the_tokenizers_own_without_gap(grid):
    vocabulary = Vocabulary(grid, 1000)
    names = vocabulary.names
    assert len(set(names)) == len(names) == len(vocabulary) == 1 + grid.cells + grid.codebook
    assert names[0] == "<voxel>"
    assert names[vocabulary.first_coordinate - 1000 + 43] == "<xyz_43>"
    assert names[vocabulary.first_code - 1000] == "<mesh_0>"
    assert names[-1] == f"<mesh_{grid.codebook - 1}>"


def test_ids_worked_out_by_hand():
    # <voxel> 100; <xyz_43> 101 + 43; <mesh_1930> 101 + 512 + 1930.
    ids = Vocabulary(SMALL, 100).encode(VoxelTokens(SMALL, ints(43), ints(1930)))
    assert ids.tolist() == [100, 144, 2543]


def test_tokens_of_another_codebook_have_no_ids():
    tokens = VoxelTokens(TokenGrid((8, 8, 8), 8192), ints(43), ints(8000))
    with pytest.raises(BadInputError, match="do not fit"):
        Vocabulary(SMALL, 0).encode(tokens)


@pytest.mark.parametrize("first_id", [-1, 2**31 - 4608])
def test_ids_that_int32_cannot_hold_are_refused(first_id):
    assert len(Vocabulary(SMALL, 2**31 - 4609)) == 4609
    with pytest.raises(BadInputError, match="first token id"):
        Vocabulary(SMALL, first_id)


# ---- values that are refused


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: TokenGrid((8, 8, 16), 4096), "8x8x8 or 16x8x8"),
        (lambda: TokenGrid((8, 8, 8), 1024), "4096 or 8192"),
        (lambda: VoxelTokens(SMALL, ints(1, 2), ints(5)), "equal in length"),
        (lambda: VoxelTokens(SMALL, ints(512), ints(5)), r"cell index 512 is out of range 0..511"),
        (lambda: VoxelTokens(SMALL, ints(2**32), ints(5)), "out of range"),
        (lambda: VoxelTokens(SMALL, ints(1), ints(0)), r"code 0 is out of range 1..4095"),
        (lambda: VoxelTokens(SMALL, ints(1), ints(4096)), "code 4096"),
        (lambda: VoxelTokens(SMALL, ints(3, 3), ints(5, 6)), "cell 3 follows cell 3"),
        (lambda: VoxelTokens(SMALL, ints(4, 3), ints(5, 6)), "cell 3 follows cell 4"),
        (lambda: VoxelTokens(SMALL, np.array([0.5]), ints(5)), "whole numbers"),
        (lambda: VoxelTokens.from_dense(SMALL, np.zeros((16, 8, 8), dtype=np.int32)), "expected"),
        (lambda: VoxelTokens.from_dense(SMALL, np.full((8, 8, 8), -1)), "code -1"),
        (lambda: SMALL.index(ints(8, 0, 0)), "outside the grid"),
        (lambda: SMALL.index(ints(1, 2)), "expected"),
        (lambda: SMALL.coordinates(ints(-1)), "cell index -1"),
        (lambda: SMALL.occupied_cells(np.zeros((32, 32, 32), dtype=np.bool_)), "occupancy"),
        (lambda: token_counts(np.zeros((4, 4, 4), dtype=np.bool_)), "must be one of"),
    ],
)
def test_values_that_mean_nothing_are_refused(make, message):
    with pytest.raises(BadInputError, match=message):
        make()


def test_tokens_cannot_be_written_to():
    tokens = VoxelTokens(SMALL, ints(43), ints(1930))
    for array in (tokens.index, tokens.code, tokens.dense(), tokens.coordinates):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


# ---- counting


def test_counts_of_one_grid():
    # 64 of 512 cells: 64 * 3 = 192 tokens against 512, 1 - 192/512 = 5/8; 7/8 of the cells are empty.
    occupied = np.zeros((8, 8, 8), dtype=np.bool_)
    occupied[3] = True
    counts = token_counts(occupied)
    assert counts.dense == SequenceLength(512, 512)
    assert counts.zero_sparse == counts.force_sparse == SequenceLength(64, 192)
    assert (counts.reduction.cells, counts.reduction.tokens) == (7 / 8, 5 / 8)


def test_a_bulky_object_gains_cells_but_no_tokens():
    # Half of 1024 cells: 512 * 3 = 1536 tokens against 1024.
    occupied = np.zeros((16, 8, 8), dtype=np.bool_)
    occupied[:8] = True
    reduction = token_counts(occupied).reduction
    assert (reduction.cells, reduction.tokens) == (0.5, -0.5)


def test_a_model_without_a_zero_token_keeps_what_its_codes_say():
    occupied = np.zeros((8, 8, 8), dtype=np.bool_)
    occupied[0, 0, :2] = True
    codes = np.full((8, 8, 8), 1849)
    codes[0, 0, :5] = 12
    counts = token_counts(occupied, force_kept=codes != 1849)
    assert counts.force_sparse == SequenceLength(5, 15)
    assert counts.zero_sparse == SequenceLength(2, 6)


def test_parts_add_up_and_repeat_the_dense_grid():
    # Four parts of 40 cells: 480 tokens against 4 * 512 = 2048.
    part = np.zeros((8, 8, 8), dtype=np.bool_)
    part.flat[:40] = True
    one = token_counts(part)
    total = one + one + one + one
    assert total.dense == SequenceLength(2048, 2048)
    assert total.zero_sparse == total.force_sparse == SequenceLength(160, 480)
    assert total.reduction.tokens == pytest.approx(1 - 480 / 2048)
