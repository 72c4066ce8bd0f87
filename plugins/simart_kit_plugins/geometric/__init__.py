"""No weights: segments grouped into parts, and joint candidates chosen by evidence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import hookimpl

if TYPE_CHECKING:
    from simart_kit.hookspecs import Register


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `geometric`."""
    from .segmenter import Geometric

    register(Geometric)


@hookimpl
def register_joint_predictors(register: Register) -> None:
    """Register `geometric`."""
    from .predictor import GeometricJoints

    register(GeometricJoints)
