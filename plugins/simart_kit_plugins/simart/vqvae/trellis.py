"""Published weights of TRELLIS' sparse-structure VAE as the start of a sparse VQ-VAE."""

from __future__ import annotations

from pathlib import Path

import torch

from .config import VqvaeConfig
from .initialise import initialise_zero_token
from .model import SparseVQVAE
from .weights import read_tensors

ENCODER_NAME = "ss_enc_conv3d_16l8_fp16.safetensors"
DECODER_NAME = "ss_dec_conv3d_16l8_fp16.safetensors"


def import_trellis(encoder_file: Path, decoder_file: Path, config: VqvaeConfig) -> SparseVQVAE:
    """A model whose encoder and decoder are TRELLIS', in float32, and whose zero token is its emptiness.

    The names and shapes of the published files are those of our encoder and decoder. The zero token becomes
    the mean feature of the cells of an empty grid: TRELLIS encodes emptiness as a vector far from zero. The
    entries stay random: `initialise_codebook` sets them from shapes (and the zero token anew, from the empty
    cells around these shapes).

    Raises:
        BadInputError: a file is missing or damaged, or its tensors are not those of the config; the message
            lists missing and unexpected names, and both shapes of those that differ.
    """
    model = SparseVQVAE(config)
    for part, path, name in (
        (model.encoder, encoder_file, ENCODER_NAME),
        (model.decoder, decoder_file, DECODER_NAME),
    ):
        advice = f"give TRELLIS' {name}, or a config with the channels of the file"
        part.load_state_dict(read_tensors(Path(path), part.state_dict(), advice))
    initialise_zero_token(model, torch.zeros(1, 1, *(config.resolution,) * 3))
    return model
