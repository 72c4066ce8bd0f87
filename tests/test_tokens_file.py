"""The file of voxel tokens: what is written is read, and every mistake is one line that says where."""

import json
import re

import numpy as np
import pytest
from simart_kit_plugins.simart.token_errors import Mistake, TokenError
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens
from simart_kit_plugins.simart.tokens_file import (
    PartTokens,
    TokensFile,
    read_tokens_file,
    write_tokens_file,
)

from simart_kit.errors import BadInputError, OutputError

from .token_models import FINGERPRINT

TABLE = {
    "schema": 1,
    "grid": "8x8x8",
    "codebook": 4096,
    "model": FINGERPRINT,
    "object": "<voxel> 43 1930 <voxel> 44 7 <voxel> 511 4095",
    "parts": [
        {"name": "body", "label": "body", "material": "steel", "tokens": "<voxel> 43 1 <voxel> 511 2"},
        {"name": "door", "label": "door", "tokens": "<voxel><xyz_44><mesh_9>"},
    ],
}


def cells(*pairs):
    index, code = np.array(pairs).T
    return VoxelTokens(TokenGrid(), index, code)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "parts.json"


def changed(path, **keys):
    path.write_text(json.dumps(TABLE | keys))
    return path


def with_door(path, tokens):
    return changed(path, parts=[TABLE["parts"][0], {"name": "door", "tokens": tokens}])


def test_a_file_is_read_as_it_says(path):
    file = read_tokens_file(changed(path), FINGERPRINT)
    assert file.model == FINGERPRINT
    assert file.object.index.tolist() == [43, 44, 511]
    assert file.object.code.tolist() == [1930, 7, 4095]
    body, door = file.parts
    assert (body.name, body.label, body.material) == ("body", "body", "steel")
    assert (body.tokens.index.tolist(), body.tokens.code.tolist()) == ([43, 511], [1, 2])
    assert (door.material, door.tokens.index.tolist(), door.tokens.code.tolist()) == ("wood", [44], [9])


@pytest.mark.parametrize("notation", ["text", "atoms"])
def test_what_is_written_is_read_and_written_alike(path, notation):
    file = TokensFile(
        FINGERPRINT,
        cells((3, 8), (9, 4095)),
        (PartTokens("Tür", cells((9, 17)), "door", "glass"), PartTokens("body", cells((3, 8)))),
    )
    write_tokens_file(file, path, notation)
    again = read_tokens_file(path)
    assert [(p.name, p.label, p.material) for p in again.parts] == [
        ("Tür", "door", "glass"),
        ("body", "", "wood"),
    ]
    assert [p.tokens.text() for p in again.parts] == ["<voxel> 9 17", "<voxel> 3 8"]
    assert again.object.text() == "<voxel> 3 8 <voxel> 9 4095"
    before = path.read_bytes()
    write_tokens_file(again, path, notation)
    assert path.read_bytes() == before
    assert [file.name for file in path.parent.iterdir()] == ["parts.json"]


def test_the_larger_grid_and_codebook(path):
    text = "<voxel> 1023 8191"
    parts = [{"name": "body", "tokens": text}]
    file = read_tokens_file(changed(path, grid="16x8x8", codebook=8192, object=text, parts=parts))
    assert file.object.coordinates.tolist() == [[15, 7, 7]]


def refusal(path, kind=BadInputError, model=None):
    with pytest.raises(kind) as caught:
        read_tokens_file(path, model)
    told = str(caught.value)
    assert "\n" not in told
    assert str(path) in told
    return caught.value


@pytest.mark.parametrize(
    ("tokens", "mistake", "found"),
    [
        ("<voxel> x 9", Mistake.BAD_INDEX, "'x'"),
        ("<voxel> 512 9", Mistake.INDEX_OUT_OF_RANGE, "'512'"),
        ("<voxel> 44 4096", Mistake.CODE_OUT_OF_RANGE, "'4096'"),
        ("<voxel> 44 0", Mistake.EMPTY_CODE, "'0'"),
        ("<voxel> 44 9 <voxel> 44 9", Mistake.DUPLICATE_INDEX, "'44'"),
        ("<voxel> 45 9", Mistake.FOREIGN_INDEX, "'45'"),
        ("<voxel> 44", Mistake.TRUNCATED, "the end"),
        ("<voxel><xyz_44><mes", Mistake.TRUNCATED, "'<mes'"),
    ],
)
def test_a_wrong_token_is_told_with_its_part(path, tokens, mistake, found):
    error = refusal(with_door(path, tokens), TokenError)
    assert (error.mistake, error.found) == (mistake, found)
    assert "part 'door'" in str(error)


def test_a_wrong_token_of_the_object_is_told(path):
    error = refusal(changed(path, object="<voxel> 43 1930 <voxel> 44"), TokenError)
    assert error.source.endswith("parts.json, object")
    assert error.mistake is Mistake.TRUNCATED


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"schema": 2}, "schema: Input should be 1"),
        ({"grid": "4x4x4"}, "grid: .*'8x8x8' or '16x8x8'"),
        ({"codebook": 100}, "codebook of 100"),
        ({"codebook": "4096"}, "codebook: .*integer"),
        ({"model": "vq-nano"}, "model: .*pattern"),
        ({"extra": 1}, "extra: Extra inputs are not permitted"),
        ({"parts": []}, "parts: .*at least 1 item"),
        ({"parts": [{"name": "door"}]}, r"parts\.0\.tokens: Field required"),
        ({"parts": [TABLE["parts"][1]] * 2}, "part 'door' comes twice"),
        ({"parts": [{"name": "door", "tokens": ""}]}, "part 'door' has no tokens"),
        ({"object": "", "parts": [{"name": "a", "tokens": ""}]}, "the object has no tokens"),
    ],
)
def test_a_wrong_table_is_told(path, keys, told):
    error = refusal(changed(path, **keys))
    assert re.search(told, str(error)), str(error)


def test_a_file_that_is_cut_off_is_told(path):
    text = json.dumps(TABLE)
    path.write_text(text[: len(text) // 2])
    assert "is no tokens file" in str(refusal(path))


def test_a_missing_file_is_told_with_the_command_that_writes_one(path):
    assert "simart-kit tokens MESH --out" in str(refusal(path))


def test_tokens_of_another_model_are_refused(path):
    error = refusal(changed(path), model="fedcba9876543210")
    assert FINGERPRINT in str(error)
    assert "fedcba9876543210" in str(error)


def test_foreign_cells_are_refused_before_they_are_written():
    with pytest.raises(BadInputError, match="part 'door' has cell 5, which the object has not"):
        TokensFile(FINGERPRINT, cells((3, 8)), (PartTokens("door", cells((5, 1))),))


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path):
    file = TokensFile(FINGERPRINT, cells((3, 8)), (PartTokens("door", cells((3, 1))),))
    with pytest.raises(OutputError, match=r"cannot write .*gone"):
        write_tokens_file(file, tmp_path / "gone" / "parts.json")
    (tmp_path / "folder").mkdir()
    with pytest.raises(OutputError, match=r"cannot write .*folder"):
        write_tokens_file(file, tmp_path / "folder")
    assert [entry.name for entry in tmp_path.iterdir()] == ["folder"]
