"""From a cloud to what the model of a folder says of it: what another process may be asked for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .cloud import Cloud
    from .predicting import Prediction


def said_by(folder: Path, weights_file: str, cloud: Cloud, votes: int) -> Prediction:
    """What weights in a model's folder say of a cloud, seen from so many sides, 1..8.

    Raises:
        BadInputError: see `stored_model.read_model`.
    """
    from .predicting import predict
    from .stored_model import read_model

    model = read_model(folder, weights_file)
    return predict(model.network, cloud, votes, model.statistics)
