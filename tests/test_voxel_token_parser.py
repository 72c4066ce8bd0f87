"""Strict reading of voxel tokens, as text and as ids: every mistake is named where it stands."""

import pickle
from ast import literal_eval

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.token_errors import Mistake, TokenError
from simart_kit_plugins.simart.token_parser import parse
from simart_kit_plugins.simart.tokens import TokenGrid
from simart_kit_plugins.simart.vocabulary import Vocabulary

SMALL = TokenGrid()
TALL = TokenGrid((16, 8, 8), 8192)
PAPER = "<voxel> 43 1930 <voxel> 44 7"


def pairs(tokens):
    return list(zip(tokens.index.tolist(), tokens.code.tolist(), strict=True))


# ---- strict reading: `|` stands before the token that the error must point at, and is taken out

M = Mistake
BAD_TEXTS = [
    ("|43 1930", M.MISSING_VOXEL, 0, "'43'"),
    ("|Sure: <voxel> 43 1930", M.MISSING_VOXEL, 0, "'Sure:'"),
    ("<voxel> 43 1930 |44 7", M.MISSING_VOXEL, 3, "'44'"),
    ("<voxel> 43 1930 |and <voxel> 44 7", M.MISSING_VOXEL, 3, "'and'"),
    ("<voxel> |<voxel> 43 1930", M.EXTRA_VOXEL, 1, "'<voxel>'"),
    ("<voxel> 43 |<voxel> 44 7", M.EXTRA_VOXEL, 2, "'<voxel>'"),
    ("<voxel> |x 7", M.BAD_INDEX, 1, "'x'"),
    ("<voxel> |-1 7", M.BAD_INDEX, 1, "'-1'"),
    ("<voxel> |+1 7", M.BAD_INDEX, 1, "'+1'"),
    ("<voxel> |1.0 7", M.BAD_INDEX, 1, "'1.0'"),
    ("<voxel> |043 7", M.BAD_INDEX, 1, "'043'"),
    ("<voxel> |4_3 7", M.BAD_INDEX, 1, "'4_3'"),
    ("<voxel> |٤٣ 7", M.BAD_INDEX, 1, "'٤٣'"),
    ("<voxel> |512 7", M.INDEX_OUT_OF_RANGE, 1, "'512'"),
    ("<voxel> |" + "9" * 9000 + " 7", M.INDEX_OUT_OF_RANGE, 1, "'" + "9" * 21 + "...'"),
    ("<voxel> 43 |seven", M.BAD_CODE, 2, "'seven'"),
    ("<voxel> 43 |4096", M.CODE_OUT_OF_RANGE, 2, "'4096'"),
    ("<voxel> 43 |0", M.EMPTY_CODE, 2, "'0'"),
    ("<voxel> 43 1930 <voxel> |43 7", M.DUPLICATE_INDEX, 4, "'43'"),
    ("<voxel> 5 1 <voxel> 6 1 <voxel> |5 7", M.DUPLICATE_INDEX, 7, "'5'"),
    ("<voxel> 43 1930\n<voxel>\t|42 7", M.DECREASING_INDEX, 4, "'42'"),
    ("<voxel>|", M.TRUNCATED, 1, "the end"),
    ("<voxel> 43|", M.TRUNCATED, 2, "the end"),
    ("<voxel> 43 1930 <voxel> 44 |", M.TRUNCATED, 5, "the end"),
    ("<voxel> 43 1930 |<vox", M.TRUNCATED, 3, "'<vox'"),
    ("<voxel> 43 1930 |...", M.TRAILING, 3, "'...'"),
    ('<voxel> 43 1930 |"} done', M.TRAILING, 3, "'\"}'"),
    ("<voxel> 43 1930|<eos>", M.TRAILING, 3, "'<eos>'"),
    # The same in atomic names, and the two notations mixed.
    ("|<xyz_43><mesh_1930>", M.MISSING_VOXEL, 0, "'<xyz_43>'"),
    ("<voxel><xyz_43><mesh_7>|<xyz_44><mesh_7>", M.MISSING_VOXEL, 3, "'<xyz_44>'"),
    ("<voxel><xyz_43>|<voxel><xyz_44><mesh_7>", M.EXTRA_VOXEL, 2, "'<voxel>'"),
    ("<voxel>|<mesh_7><xyz_43>", M.BAD_INDEX, 1, "'<mesh_7>'"),
    ("<voxel>|43<mesh_7>", M.BAD_INDEX, 1, "'43'"),
    ("<voxel><xyz_43>|1930", M.BAD_CODE, 2, "'1930'"),
    ("<voxel>|<xyz_043><mesh_7>", M.BAD_INDEX, 1, "'<xyz_043>'"),
    ("<voxel>|<xyz_512><mesh_7>", M.INDEX_OUT_OF_RANGE, 1, "'<xyz_512>'"),
    ("<voxel><xyz_43>|<mesh_4096>", M.CODE_OUT_OF_RANGE, 2, "'<mesh_4096>'"),
    ("<voxel><xyz_43>|<mesh_0>", M.EMPTY_CODE, 2, "'<mesh_0>'"),
    ("<voxel><xyz_43>|<mesh_19", M.TRUNCATED, 2, "'<mesh_19'"),
    ("<voxel><xyz_43><mesh_7><voxel>|<xyz_43><mesh_7>", M.DUPLICATE_INDEX, 4, "'<xyz_43>'"),
]


@pytest.mark.parametrize(("marked", "mistake", "token", "found"), BAD_TEXTS)
def test_a_mistake_is_named_where_it_stands(marked, mistake, token, found):
    with pytest.raises(TokenError) as caught:
        parse(marked.replace("|", ""), SMALL)
    error = caught.value
    assert (error.mistake, error.token, error.offset) == (mistake, token, marked.index("|"))
    assert error.found == found
    assert len(str(error).splitlines()) == 1
    assert len(str(error)) < 400


# Vocabulary(SMALL, 100): <voxel> 100, cells 101..612, codes 613..4708.
BAD_IDS = [
    ([144, 2543], M.MISSING_VOXEL, 0, "'<xyz_43>'"),
    ([100, 144, 620, 2], M.TRAILING, 3, "'id 2'"),
    ([100, 100, 144, 620], M.EXTRA_VOXEL, 1, "'<voxel>'"),
    ([100, 620, 144], M.BAD_INDEX, 1, "'<mesh_7>'"),
    ([100, 99, 620], M.BAD_INDEX, 1, "'id 99'"),
    ([100, 144, 4709], M.BAD_CODE, 2, "'id 4709'"),
    ([100, 144, 10**30], M.BAD_CODE, 2, "'id 100000000000000000...'"),
    ([100, 144.0, 620], M.BAD_INDEX, 1, "'144.0'"),
    ([100, 144, 613], M.EMPTY_CODE, 2, "'<mesh_0>'"),
    ([100, 144, 620, 100, 144, 620], M.DUPLICATE_INDEX, 4, "'<xyz_43>'"),
    ([100, 144, 620, 100, 143, 620], M.DECREASING_INDEX, 4, "'<xyz_42>'"),
    ([100, 144, 620, 100], M.TRUNCATED, 4, "the end"),
]


@pytest.mark.parametrize(("ids", "mistake", "token", "found"), BAD_IDS)
def test_a_mistake_among_ids_is_named_where_it_stands(ids, mistake, token, found):
    with pytest.raises(TokenError) as caught:
        Vocabulary(SMALL, 100).decode(ids)
    error = caught.value
    assert (error.mistake, error.token, error.offset, error.found) == (mistake, token, None, found)


def test_a_cell_that_the_input_does_not_occupy_is_foreign():
    whole = parse("<voxel> 42 5 <voxel> 43 1", SMALL)
    # The code may differ from the input's: parts that share a cell have each their own.
    assert pairs(parse("<voxel> 43 1930", SMALL, allowed=whole.index)) == [(43, 1930)]
    with pytest.raises(TokenError) as caught:
        parse(PAPER, SMALL, allowed=whole.index)
    # "<voxel> 43 1930 <voxel> " is 7+1+2+1+4+1+7+1 = 24 characters and 4 tokens.
    assert (caught.value.mistake, caught.value.token, caught.value.offset) == (M.FOREIGN_INDEX, 4, 24)
    with pytest.raises(TokenError, match="input does not occupy"):
        Vocabulary(SMALL, 9).decode(Vocabulary(SMALL, 9).encode(parse(PAPER, SMALL)), allowed=whole.index)


@given(st.permutations(range(4)))
def test_unordered_text_is_put_in_order_on_request(order):
    text = " ".join(f"<voxel> {10 * i} {100 + i}" for i in order)
    assert pairs(parse(text, SMALL, ordered=False)) == [(0, 100), (10, 101), (20, 102), (30, 103)]


def test_the_same_cell_twice_is_a_mistake_in_any_order():
    with pytest.raises(TokenError, match="cell named twice at token 7"):
        parse("<voxel> 9 1 <voxel> 6 1 <voxel> 9 7", SMALL, ordered=False)


def test_ranges_are_those_of_the_grid_and_codebook():
    text = "<voxel> 1023 8191"
    assert pairs(parse(text, TALL)) == [(1023, 8191)]
    with pytest.raises(TokenError, match=r"expected a cell index 0\.\.511"):
        parse(text, TokenGrid((8, 8, 8), 8192))
    with pytest.raises(TokenError, match=r"expected a code 1\.\.4095"):
        parse(text, TokenGrid((16, 8, 8), 4096))


def test_the_message_says_what_where_and_what_next():
    with pytest.raises(TokenError) as caught:
        parse(PAPER + " <voxel> 44 9 <voxel> 50 3", SMALL, source="answer.json, part '1'")
    # Seven tokens before it; PAPER has 28 characters, " <voxel> " 9 more.
    assert str(caught.value) == (
        "answer.json, part '1': cell named twice at token 7, character 37 (from 0): found '44', "
        "expected a cell not named before; near '... 44 7 <voxel> >>44<< 9 <voxel> 50 ...'"
    )


def test_the_excerpt_stops_at_either_end_of_the_text():
    with pytest.raises(TokenError) as caught:
        parse("<voxel> x 1930", SMALL)
    assert caught.value.excerpt == "'<voxel> >>x<< 1930'"


def test_the_error_comes_back_whole_from_another_process():
    with pytest.raises(TokenError) as caught:
        parse("<voxel> 43 0", SMALL)
    error = pickle.loads(pickle.dumps(caught.value))
    assert str(error) == str(caught.value)
    assert (error.mistake, error.token, error.offset) == (M.EMPTY_CODE, 2, 11)


pieces = st.sampled_from(
    ["<voxel>", "<voxel", "43", "44", "0", "4096", "<xyz_5>", "<mesh_6>", "<mesh_", "x", ">", "\n"]
)
scraps = st.one_of(st.text(), st.lists(st.one_of(pieces, st.text(max_size=3)), max_size=12).map(" ".join))


def outcome(read, *arguments, **options):
    """What reading gives: tokens, or the one error that it may raise."""
    try:
        return read(*arguments, **options)
    except TokenError as error:
        return error


@settings(max_examples=400, deadline=None)
@given(st.one_of(scraps, st.text(alphabet=st.characters(codec=None), max_size=20)), st.booleans())
def test_whatever_the_text_reading_gives_valid_tokens_or_a_token_error(text, ordered):
    result = outcome(parse, text, SMALL, ordered=ordered)
    if isinstance(result, TokenError):
        rest = text[result.offset :]
        assert rest == "" if result.found == "the end" else rest.startswith(literal_eval(result.found)[:21])
        assert len(str(result).splitlines()) == 1
    else:
        assert pairs(parse(result.text(), SMALL)) == pairs(result)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.one_of(st.integers(95, 640), st.integers(), st.just(100)), max_size=9))
def test_whatever_the_ids_reading_gives_the_same_ids_or_a_token_error(ids):
    vocabulary = Vocabulary(SMALL, 100)
    result = outcome(vocabulary.decode, ids)
    if isinstance(result, TokenError):
        assert 0 <= result.token <= len(ids)
    else:
        assert vocabulary.encode(result).tolist() == ids
