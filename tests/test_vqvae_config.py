import json

import pytest
from pydantic import ValidationError
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.config_file import read_config, write_config

from simart_kit.errors import BadInputError

from .vqvae_cases import small


@pytest.mark.parametrize(
    ("config", "edge", "cells", "width"),
    [
        # 64 halved twice is 16; 8 channels times the 2x2x2, 1x2x2 or 2x2x1 latent cells of a token.
        (VqvaeConfig(), 16, (8, 8, 8), 64),
        (VqvaeConfig(grid="16x8x8"), 16, (16, 8, 8), 32),
        (VqvaeConfig(grid="8x8x16", layout="flat-view"), 16, (8, 8, 16), 32),
        (small(), 4, (2, 2, 2), 64),
        (small(grid="4x2x2"), 4, (4, 2, 2), 32),
        # No level below the first: nothing is halved, a latent cell is a voxel.
        (small(channels=(4,), resolution=4, latent_channels=1), 4, (2, 2, 2), 8),
    ],
)
def test_every_size_follows_from_the_numbers(config, edge, cells, width):
    assert (config.latent_edge, config.cells, config.vector_length) == (edge, cells, width)


def test_only_mode_zero_reserves_a_code():
    assert [small(mode=mode).first_code for mode in ("zero", "force-sparse", "dense")] == [1, 0, 0]


def test_a_config_survives_its_file(tmp_path):
    config = small(mode="force-sparse", codebook_update="ema", beta=0.5, dice_weight=1.5, layout="flat-view")
    write_config(config, tmp_path / "config.json")
    assert read_config(tmp_path / "config.json") == config


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"resolution": 18}, "resolution 18 cannot be halved 2 times"),
        ({"grid": "3x2x2"}, r"grid 3x2x2 does not divide the 4\^3 latent cells"),
        ({"grid": "8x8x8"}, r"grid 8x8x8 does not divide the 4\^3 latent cells"),
        ({"grid": "2x2"}, "pattern"),
        ({"codebook_size": 1}, "greater than or equal to 2"),
        ({"channels": ()}, "at least 1 item"),
        ({"channels": (4, 0)}, "greater than 0"),
        ({"mode": "sparse"}, "'zero', 'force-sparse' or 'dense'"),
        ({"beta": float("nan")}, "finite"),
        ({"ema_decay": 1.0}, "less than 1"),
        ({"depth": 3}, "Extra inputs"),
    ],
)
def test_a_config_that_cannot_be_is_refused(changes, message):
    with pytest.raises(ValidationError, match=message):
        small(**changes)


def file_with(tmp_path, change):
    path = tmp_path / "config.json"
    write_config(small(), path)
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))
    return path


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t["config"].update(depth=3), "depth: Extra inputs"),
        (lambda t: t.update(weights="x"), "weights: Extra inputs"),
        (lambda t: t.update(schema=2), "schema: Input should be 1"),
        (lambda t: t.update(model="other"), "model 'other' is not known: use sparse-vqvae or vq-nano"),
        (lambda t: t["config"].update(resolution="16"), "resolution: Input should be a valid integer"),
        (lambda t: t["config"].update(grid="5x5x5"), "grid 5x5x5 does not divide"),
        (lambda t: t.pop("config"), "config: Field required"),
    ],
)
def test_a_wrong_config_file_is_refused_in_one_line_with_its_name(tmp_path, change, message):
    path = file_with(tmp_path, change)
    with pytest.raises(BadInputError) as caught:
        read_config(path)
    told = str(caught.value)
    assert message in told
    assert str(path) in told
    assert "\n" not in told


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe\x00", b"[]", b"null"])
def test_a_damaged_config_file_is_refused(tmp_path, content):
    path = tmp_path / "config.json"
    path.write_bytes(content)
    with pytest.raises(BadInputError, match=r"config\.json is no config of a voxel model"):
        read_config(path)


def test_a_missing_config_file_is_refused(tmp_path):
    with pytest.raises(BadInputError, match=r"cannot read .*config\.json: No such file"):
        read_config(tmp_path / "config.json")
