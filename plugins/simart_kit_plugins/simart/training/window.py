"""Steps into rows of the log."""

from __future__ import annotations

import time
from pathlib import Path

import torch
from torch import Tensor

from ..vqnano.model import BlockOutput
from ..vqvae.config import CodebookConfig
from ..vqvae.model import Output
from ..vqvae.usage import count_codes, usage
from .config import TrainingConfig
from .log import Log, LogRow


class Window:
    """What is gathered between two rows.

    Args:
        path: of the log.
        model: config of the model in training.
        step: where the run begins or goes on.
    """

    def __init__(self, path: Path, model: CodebookConfig, step: int) -> None:
        self._log, self._model = Log(path, step), model
        self._began = time.perf_counter() - self._log.seconds
        self._counts, self._revived = self._nothing(), 0

    def add(self, output: Output | BlockOutput, revived: int) -> None:
        """Take in a step."""
        self._counts += count_codes(output.codes.cpu(), self._model)
        self._revived += revived

    def close(
        self, done: int, config: TrainingConfig, output: Output | BlockOutput, voxels: Tensor
    ) -> LogRow:
        """Write the row of the steps taken in, the last of which gave `output` from `voxels`."""
        used = usage(self._counts)
        terms = output.losses
        row = LogRow(
            step=done,
            stage=config.stage(done - 1),
            rate=config.rate(done - 1),
            total=terms.total.item(),
            reconstruction=terms.reconstruction.item(),
            dice=terms.dice.item(),
            codebook=terms.codebook.item(),
            commitment=terms.commitment.item(),
            iou=batch_iou(output.logits, voxels),
            codes_used=used.used,
            perplexity=used.perplexity,
            revived=self._revived,
            seconds=time.perf_counter() - self._began,
        )
        self._counts, self._revived = self._nothing(), 0
        self._log.add(row)
        return row

    def _nothing(self) -> Tensor:
        return torch.zeros(self._model.codebook_size - self._model.first_code, dtype=torch.int64)


def batch_iou(logits: Tensor, voxels: Tensor) -> float:
    """Mean over (B, 1, R, R, R) grids of intersection over union; 1 where both are empty."""
    decoded, true = (logits > 0).flatten(1), (voxels > 0).flatten(1)
    union = (decoded | true).sum(1)
    shares = torch.where(union > 0, (decoded & true).sum(1) / union.clamp(min=1), 1.0)
    return shares.mean().item()
