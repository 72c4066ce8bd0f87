"""First values of the voxel tokens' rows, and models that are made with them."""

from pathlib import Path

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.mllm.base import extend_base
from simart_kit_plugins.simart.mllm.embeddings import codebook_vectors, fill_rows, token_features
from simart_kit_plugins.simart.tokens import TokenGrid
from simart_kit_plugins.simart.vocabulary import Vocabulary

from simart_kit.errors import BadInputError

from .mllm_folders import micro_codec, micro_model, plain_folder, shared_model

GRID = TokenGrid((16, 8, 8), 8192)


def test_a_code_has_the_mean_vector_of_the_shipped_models_eight_codebooks() -> None:
    codec = load_model()
    vectors = codebook_vectors(codec)
    entries = codec.model.state_dict()["quantiser.entries"].numpy()  # type: ignore[attr-defined]
    assert vectors.shape == (8192, 64)
    expected = sum(entries[book * 8191 + 1929] for book in range(8)) / 8
    np.testing.assert_allclose(vectors[1930], expected, rtol=1e-5, atol=1e-6)
    zero = codec.model.state_dict()["quantiser.zero_token"].numpy()  # type: ignore[attr-defined]
    np.testing.assert_array_equal(vectors[0], zero)


def features(width: int = 64) -> np.ndarray:
    codebook = np.random.default_rng(0).standard_normal((8192, 5)).astype(np.float32)
    codebook[7] = codebook[6] + 0.01
    return token_features(Vocabulary(GRID, 0), codebook, width, seed=3)


def test_cells_that_are_near_in_space_have_rows_that_are_near() -> None:
    cells = features()[1:1025]

    def apart(a: tuple[int, int, int], b: tuple[int, int, int]) -> float:
        return float(np.linalg.norm(cells[GRID.index(np.array(a))] - cells[GRID.index(np.array(b))]))

    for step in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        near, far = np.array(step), 5 * np.array(step)
        assert apart((0, 0, 0), tuple(near)) < apart((0, 0, 0), tuple(far))


def test_all_cells_have_rows_of_their_own() -> None:
    cells = features()[1:1025].astype(np.float64)
    squares = np.square(cells).sum(axis=1)
    distances = squares[:, None] + squares - 2 * cells @ cells.T + np.eye(1024)
    assert distances.min() > 0.01


def test_codes_that_are_alike_have_rows_that_are_alike() -> None:
    codes = features()[1025:]
    alike = np.linalg.norm(codes[6] - codes[7])
    assert alike < 0.1 * np.median(np.linalg.norm(codes[6] - codes[100:200], axis=1))


def test_cells_and_codes_have_the_spread_of_one_about_zero() -> None:
    rows = features()
    for kind in (rows[1:1025], rows[1025:]):
        assert np.square(kind).mean() == pytest.approx(1, abs=0.1)


def test_new_rows_lie_about_the_mean_of_the_trained_ones_with_their_spread() -> None:
    weight = torch.zeros(6, 2)
    weight[:4] = torch.tensor([[1.0, 2.0], [3.0, 2.0], [1.0, 6.0], [3.0, 6.0]])
    # Mean (2, 4); deviations 1 and 2, so the mean square is 2.5.
    fill_rows(weight, np.array([[1, -1]], dtype=np.float32), first_id=4)
    torch.testing.assert_close(weight[4], torch.tensor([2 + 2.5**0.5, 4 - 2.5**0.5]))
    assert weight[5].tolist() == [0, 0]


def test_the_same_seed_gives_the_same_model_and_another_seed_another() -> None:
    one, same, other = (micro_model(seed=seed).model.state_dict() for seed in (0, 0, 1))
    assert all(torch.equal(one[name], same[name]) for name in one)
    assert not torch.equal(one["model.language_model.embed_tokens.weight"], other["lm_head.weight"])


def test_building_leaves_the_callers_random_numbers_alone() -> None:
    torch.manual_seed(1)
    expected = torch.rand(1)
    torch.manual_seed(1)
    micro_model()
    assert torch.equal(torch.rand(1), expected)


def test_a_model_that_ties_its_embeddings_writes_with_what_it_reads() -> None:
    bundle = shared_model()
    assert bundle.model.get_output_embeddings().weight is bundle.model.get_input_embeddings().weight


@pytest.mark.parametrize("form", ["4.57", "5"])
def test_a_base_with_the_hubs_files_keeps_what_it_knows(tmp_path: Path, form: str) -> None:
    plain = plain_folder(tmp_path, form=form)
    bundle = extend_base(str(tmp_path), micro_codec())
    assert bundle.settings.base == str(tmp_path)
    known, first = bundle.vocabulary.first_id, 320
    ids = torch.tensor([bundle.tokenizer("<|im_start|>the lid of the box").input_ids])
    with torch.no_grad():
        expected = plain(input_ids=ids).logits[..., :known]
        torch.testing.assert_close(bundle.model(input_ids=ids).logits[..., :known], expected)
    assert known < first < bundle.model.get_input_embeddings().weight.shape[0]
    assert bundle.model.config.text_config.rope_parameters["rope_theta"] == 5_000_000


def test_both_matrices_of_a_base_get_the_new_rows(tmp_path: Path) -> None:
    plain = plain_folder(tmp_path)
    bundle = extend_base(str(tmp_path), micro_codec())
    first, last = bundle.vocabulary.first_id, bundle.vocabulary.first_id + len(bundle.vocabulary)
    for name in ("get_input_embeddings", "get_output_embeddings"):
        old = getattr(plain, name)().weight.detach()[:first]
        new = getattr(bundle.model, name)().weight.detach()
        assert torch.equal(new[:first], old)
        assert float(new[first:last].std()) == pytest.approx(float(old.std()), rel=0.1)
    assert len(bundle.model.get_output_embeddings().weight) % 64 == 0


def test_embeddings_with_rows_to_spare_are_not_resized(tmp_path: Path) -> None:
    plain_folder(tmp_path, rows=8000)
    bundle = extend_base(str(tmp_path), micro_codec())
    assert len(bundle.tokenizer) < 8000
    assert bundle.model.get_input_embeddings().weight.shape[0] == 8000
    assert bundle.model.config.text_config.vocab_size == 8000


def test_a_simart_model_is_not_extended_again(tmp_path: Path) -> None:
    (tmp_path / "simart.json").write_text("{}")
    with pytest.raises(BadInputError, match="is a SIMART model already"):
        extend_base(str(tmp_path), micro_codec())
