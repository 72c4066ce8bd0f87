"""Prompts as token ids and tensors: as Qwen3-VL's own processor and chat template give them, in any batch."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytest.importorskip("transformers")

from simart_kit_plugins.simart.mllm.tokenizing import extended, small_tokenizer  # noqa: E402
from simart_kit_plugins.simart.prompt.pixels import PatchGrid, patches  # noqa: E402
from simart_kit_plugins.simart.prompt.processor import Processor  # noqa: E402
from simart_kit_plugins.simart.prompt.values import Prompt  # noqa: E402
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens  # noqa: E402
from simart_kit_plugins.simart.vocabulary import Vocabulary  # noqa: E402

from simart_kit.errors import BadInputError  # noqa: E402

GRID = TokenGrid()
CUT = PatchGrid(patch=16, merge=2, frames=2)


@dataclass
class Answer:
    """Ids of an answer, and which of them were forced."""

    ids: np.ndarray
    forced: np.ndarray


@pytest.fixture(scope="module")
def kit():
    tokenizer, vocabulary = extended(small_tokenizer([], 263), GRID)
    return SimpleNamespace(
        tokenizer=tokenizer, vocabulary=vocabulary, processor=Processor(tokenizer, vocabulary, CUT)
    )


def voxels(*pairs):
    cells, codes = zip(*pairs, strict=True) if pairs else ((), ())
    return VoxelTokens(GRID, np.array(cells, dtype=np.int32), np.array(codes, dtype=np.int32))


def noise(height, width, seed=0):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


PROMPTS = (
    Prompt("Be brief.", "what is it?", voxels((3, 7), (43, 1930)), noise(252, 252)),
    Prompt("", "where is the lid?", voxels((0, 1), (9, 2), (511, 4095))),
    Prompt("Be brief.", "is it a fridge?", voxels((100, 5)), noise(64, 96, 1)),
)
ANSWERS = tuple(
    Answer(np.array(ids, dtype=np.int32), np.array(forced, dtype=bool))
    for ids, forced in (
        ([65, 66, 67, 68], [True, False, False, True]),
        ([70], [False]),
        ([80, 81, 82, 83, 84, 85, 86], [True, True, False, False, True, False, False]),
    )
)


def test_a_prompt_is_the_chat_form_of_its_texts(kit):
    """What the tokenizer's template says, with names for voxels, and the placeholder once a visual token."""
    content = [{"type": "image"}, {"type": "text", "text": PROMPTS[0].voxels.atoms() + "what is it?"}]
    turns = [{"role": "system", "content": "Be brief."}, {"role": "user", "content": content}]
    text = kit.tokenizer.apply_chat_template(turns, tokenize=False, add_generation_prompt=True)
    assert "<voxel><xyz_3><mesh_7><voxel><xyz_43><mesh_1930>" in text
    text = text.replace("<|image_pad|>", "<|image_pad|>" * 64)
    assert kit.processor.ids(PROMPTS[0]) == kit.tokenizer.encode(text, add_special_tokens=False)


def test_pieces_that_a_prompt_lacks_are_left_out(kit):
    text = kit.tokenizer.decode(kit.processor.ids(Prompt("", "what?", voxels())))
    assert text == "<|im_start|>user\nwhat?<|im_end|>\n<|im_start|>assistant\n"


@pytest.mark.parametrize(
    ("size", "tokens"), [((252, 252), 64), ((256, 256), 64), ((64, 96), 6), ((5, 5), 1), ((80, 300), 18)]
)
def test_a_picture_has_a_visual_token_for_each_32_pixels(kit, size, tokens):
    prompt = Prompt("", "what?", voxels(), noise(*size))
    assert kit.processor.ids(prompt).count(kit.tokenizer.convert_tokens_to_ids("<|image_pad|>")) == tokens


@pytest.mark.parametrize(("height", "width"), [(252, 252), (256, 320), (300, 400)])
@pytest.mark.parametrize(("patch", "merge"), [(16, 2), (14, 2), (8, 4)])
def test_pixels_are_those_of_transformers(height, width, patch, merge):
    """Its picture processor with the numbers that Qwen3-VL's preprocessor_config.json has."""
    from transformers.models.qwen2_vl.image_processing_pil_qwen2_vl import Qwen2VLImageProcessorPil

    theirs = Qwen2VLImageProcessorPil(
        patch_size=patch,
        merge_size=merge,
        temporal_patch_size=2,
        image_mean=[0.5, 0.5, 0.5],
        image_std=[0.5, 0.5, 0.5],
        size={"shortest_edge": 1024, "longest_edge": 16777216},
    )
    picture = noise(height, width)
    picture.setflags(write=False)
    expected = theirs(images=[picture.copy()], return_tensors="np")
    mine = patches(picture, PatchGrid(patch, merge, 2))
    assert mine.grid == tuple(expected["image_grid_thw"][0].tolist())
    np.testing.assert_allclose(mine.values, expected["pixel_values"], atol=1e-6)
    assert mine.values.dtype == np.float32
    assert mine.tokens * merge**2 == len(mine.values)


def test_a_batch_to_generate_from_is_filled_on_the_left(kit):
    batch = kit.processor.inputs(PROMPTS)
    lengths = [len(kit.processor.ids(prompt)) for prompt in PROMPTS]
    for row, (prompt, length) in enumerate(zip(PROMPTS, lengths, strict=True)):
        assert batch["input_ids"][row, -length:].tolist() == kit.processor.ids(prompt)
        assert batch["attention_mask"][row].tolist() == [0] * (max(lengths) - length) + [1] * length
    assert batch["mm_token_type_ids"].sum(dim=1).tolist() == [64, 0, 6]
    assert batch["image_grid_thw"].tolist() == [[1, 16, 16], [1, 4, 6]]
    assert batch["pixel_values"].shape == (256 + 24, 3 * 2 * 16 * 16)
    assert batch.keys() == {
        "input_ids",
        "attention_mask",
        "mm_token_type_ids",
        "pixel_values",
        "image_grid_thw",
    }


def test_a_batch_without_pictures_has_no_pixels(kit):
    batch = kit.processor.inputs([PROMPTS[1]] * 2)
    assert batch.keys() == {"input_ids", "attention_mask", "mm_token_type_ids"}
    assert not batch["mm_token_type_ids"].any()


def test_a_batch_to_train_on_has_the_answers_as_labels(kit):
    batch = kit.processor.training(PROMPTS, ANSWERS, forced_weight=0.25)
    for row, (prompt, answer) in enumerate(zip(PROMPTS, ANSWERS, strict=True)):
        head, count = len(kit.processor.ids(prompt)), len(answer.ids)
        rest = batch["labels"].shape[1] - head - count
        assert batch["input_ids"][row, : head + count].tolist() == [
            *kit.processor.ids(prompt),
            *answer.ids.tolist(),
        ]
        assert batch["attention_mask"][row].tolist() == [1] * (head + count) + [0] * rest
        assert batch["labels"][row].tolist() == [-100] * head + answer.ids.tolist() + [-100] * rest
        expected = [0.25 if forced else 1.0 for forced in answer.forced]
        assert batch["loss_weights"][row].tolist() == [0.0] * head + expected + [0.0] * rest


def test_forced_tokens_can_be_left_out_of_the_loss(kit):
    batch = kit.processor.training(PROMPTS, ANSWERS, forced_weight=0)
    kept = batch["labels"][batch["labels"] != -100].tolist()
    assert kept == [66, 67, 70, 82, 83, 85, 86]
    assert ((batch["labels"] != -100) == (batch["loss_weights"] == 1)).all()


def test_another_models_tokens_are_refused(kit):
    with pytest.raises(BadInputError, match="tokenizer and voxel vocabulary are of different models"):
        Processor(kit.tokenizer, Vocabulary(GRID, kit.vocabulary.first_id + 1), CUT)
    other = VoxelTokens(TokenGrid((16, 8, 8), 8192), np.array([1]), np.array([1]))
    with pytest.raises(BadInputError, match="do not fit the vocabulary"):
        kit.processor.inputs([Prompt("", "what?", other)])


def test_a_tokenizer_of_another_family_is_refused(kit):
    from transformers import Qwen2Tokenizer

    plain = Qwen2Tokenizer(vocab={"<|endoftext|>": 0, "a": 1}, merges=[])
    with pytest.raises(BadInputError, match=r"has no token <\|im_start\|>: it must be one of Qwen3-VL"):
        Processor(plain, kit.vocabulary, CUT)


@pytest.fixture(scope="module")
def model(kit):
    from transformers import Qwen3VLConfig, Qwen3VLForConditionalGeneration

    torch.set_num_threads(1)
    token = kit.tokenizer.convert_tokens_to_ids
    rope = {"rope_type": "default", "rope_theta": 5e6, "mrope_section": [4, 2, 2], "mrope_interleaved": True}
    config = Qwen3VLConfig(
        text_config={
            "vocab_size": len(kit.tokenizer),
            "hidden_size": 32,
            "intermediate_size": 64,
            "num_hidden_layers": 2,
            "num_attention_heads": 2,
            "num_key_value_heads": 1,
            "head_dim": 16,
            "rope_parameters": rope,
        },
        vision_config={
            "depth": 1,
            "hidden_size": 32,
            "intermediate_size": 64,
            "num_heads": 2,
            "patch_size": 16,
            "spatial_merge_size": 2,
            "temporal_patch_size": 2,
            "out_hidden_size": 32,
            "num_position_embeddings": 256,
            "deepstack_visual_indexes": [0],
        },
        image_token_id=token("<|image_pad|>"),
        video_token_id=token("<|video_pad|>"),
        vision_start_token_id=token("<|vision_start|>"),
        vision_end_token_id=token("<|vision_end|>"),
    )
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(0)
        made = Qwen3VLForConditionalGeneration(config).eval()
        for weight in made.parameters():  # large ones, so that what is read shows
            weight.data.mul_(5)
    return made


def test_the_processor_of_a_model_cuts_pictures_as_its_vision_tower_does(kit, model):
    bundle = SimpleNamespace(model=model, tokenizer=kit.tokenizer, vocabulary=kit.vocabulary)
    assert Processor.of(bundle).cut == PatchGrid(patch=16, merge=2, frames=2)


@pytest.mark.parametrize("forced_weight", [1.0, 0.0])
@pytest.mark.parametrize("chosen", [(0, 1, 2), (1, 1), (1, 2)])
def test_the_loss_of_a_batch_is_that_of_its_rows(kit, model, forced_weight, chosen):
    """The mean over all tokens that count, by hand from the logits of each row alone."""
    prompts, answers = [PROMPTS[i] for i in chosen], [ANSWERS[i] for i in chosen]
    batch = kit.processor.training(prompts, answers, forced_weight=forced_weight)
    del batch["loss_weights"]
    lost = []
    with torch.no_grad():
        together = model(**batch).loss.item()
        for prompt, answer in zip(prompts, answers, strict=True):
            alone = kit.processor.training([prompt], [answer])
            shown = {key: alone[key] for key in alone if key not in ("labels", "loss_weights")}
            chances = model(**shown).logits[0].log_softmax(dim=-1)
            head = len(kit.processor.ids(prompt))
            for place, (token, forced) in enumerate(zip(answer.ids.tolist(), answer.forced, strict=True)):
                if forced_weight or not forced:
                    lost.append(-chances[head + place - 1, token].item())
    assert together == pytest.approx(np.mean(lost), rel=1e-5)


def test_rows_of_a_batch_generate_what_they_do_alone(kit, model):
    def told(*prompts):
        batch = kit.processor.inputs(prompts)
        made = model.generate(**batch, max_new_tokens=8, do_sample=False, pad_token_id=0, eos_token_id=None)
        return made[:, batch["input_ids"].shape[1] :].tolist()

    together = told(*PROMPTS)
    assert together == [told(prompt)[0] for prompt in PROMPTS]
    assert together[0] != together[1]


def test_the_model_sees_the_picture(kit, model):
    """Another picture, the same prompt else: other logits, so that pixels and placeholders do meet."""
    asked = PROMPTS[0]
    other = Prompt(asked.system, asked.question, asked.voxels, noise(252, 252, 9))
    with torch.no_grad():
        first, second = (model(**kit.processor.inputs([p])).logits[0, -1] for p in (asked, other))
    assert (first - second).abs().max() > 1e-3
