"""Pretrained weights as a start: a plain Qwen3-VL becomes a SIMART model."""

from __future__ import annotations

from simart_kit.errors import BadInputError
from simart_kit.extras import require_extra

from ..default_model import LoadedModel
from .building import simart_model
from .hub import located
from .settings import SETTINGS_FILE
from .simart_model import SimartModel
from .weights import Choices, load_plain

_ON_CPU = Choices(device="cpu", allow_slow=True)


def extend_base(base: str, codec: LoadedModel, seed: int = 0, choices: Choices = _ON_CPU) -> SimartModel:
    """Add the voxel tokens to a plain Qwen3-VL; the same arguments give the same model.

    Args:
        base: folder, or hub id such as "Qwen/Qwen3-VL-8B-Instruct".
        codec: the voxel model whose codes the tokens are.
        seed: of the new rows.
        choices: where it goes; by default the CPU, for training loops that place it themselves.

    Raises:
        BadInputError: the extra is not installed; files are missing, damaged or of another architecture; the
            base is a SIMART model already; or device or memory do not do.
    """
    require_extra("mllm", "the language model")
    if (located(base, weights=False) / SETTINGS_FILE).is_file():
        raise BadInputError(f"{base} is a SIMART model already: load it, do not extend it")
    plain = load_plain(base, choices, voxel_tokens=1 + codec.grid.cells + codec.grid.codebook)
    return simart_model(plain.model, plain.tokenizer, codec, base=base, seed=seed)
