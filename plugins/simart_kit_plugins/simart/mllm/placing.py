"""Where a model's weights go and what numbers they are: device, dtype, quantisation."""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Literal, get_args

from simart_kit.errors import BadInputError

Dtype = Literal["auto", "float32", "bfloat16", "float16"]
Quantisation = Literal["none", "8bit", "4bit"]
# Above this float32 is a waste of memory on a CPU.
_LARGE = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Placing:
    """Choices without "auto".

    Attributes:
        device: "cpu", "cuda" or such as "cuda:1".
        dtype: of the weights.
        quantisation: of the large matrices.
    """

    device: str
    dtype: str
    quantisation: str = "none"

    @property
    def kind(self) -> str:
        """The device without its number: "cpu" or "cuda"."""
        return self.device.split(":")[0]


def placing(device: str, dtype: str, quantisation: str, parameters: int) -> Placing:
    """Decide what is left open.

    Args:
        device: "auto" (a GPU where there is one), "cpu", "cuda" or such as "cuda:1".
        dtype: "auto" is bfloat16 on GPUs that have it (float16 on others); on a CPU float32, or bfloat16
            above a billion parameters.
        quantisation: "none", "8bit" or "4bit".
        parameters: of the model.

    Raises:
        BadInputError: a word is unknown, a GPU is asked for and absent, or quantisation cannot work here.
    """
    _require_word("dtype", dtype, get_args(Dtype))
    _require_word("quantisation", quantisation, get_args(Quantisation))
    device = chosen_device(device)
    if quantisation != "none":
        _require_quantisation(quantisation, device)
    if dtype == "auto":
        dtype = _gpu_dtype() if device != "cpu" else "bfloat16" if parameters > _LARGE else "float32"
    return Placing(device, dtype, quantisation)


def chosen_device(device: str) -> str:
    """A device that there is, for "auto" a GPU before the CPU; raises BadInputError where it is absent."""
    import torch

    if device == "auto":
        return "cuda" if torch.cuda.is_available() else "cpu"
    if device == "cpu":
        return device
    if not re.fullmatch(r"cuda(:\d+)?", device):
        raise BadInputError(f"device '{device}' is not known: use auto, cpu, cuda or cuda:N")
    if not torch.cuda.is_available():
        raise BadInputError(
            f"device {device}: torch {torch.__version__} sees no CUDA GPU here: use device cpu, "
            "or install a torch that was built for your GPU"
        )
    count = torch.cuda.device_count()
    if ":" in device and int(device.split(":")[1]) >= count:
        raise BadInputError(f"device {device}: there are {count} GPUs, cuda:0 to cuda:{count - 1}")
    return device


def _gpu_dtype() -> str:
    import torch

    return "bfloat16" if torch.cuda.is_bf16_supported() else "float16"


def _require_quantisation(quantisation: str, device: str) -> None:
    if device == "cpu":
        raise BadInputError(f"quantisation {quantisation} needs a CUDA GPU: use none with device cpu")
    if find_spec("bitsandbytes") is None:
        raise BadInputError(f"quantisation {quantisation} needs bitsandbytes: pip install bitsandbytes")


def _require_word(what: str, word: str, known: tuple[str, ...]) -> None:
    if word not in known:
        raise BadInputError(f"{what} '{word}' is not known: use {', '.join(known)}")
