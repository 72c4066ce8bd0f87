"""Set of marks: a vision-language model chooses among numbers and letters drawn on pictures of the object."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import hookimpl

if TYPE_CHECKING:
    from simart_kit.hookspecs import Register


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `p3sam-vlm`."""
    from .segmenter import P3SamVlm

    register(P3SamVlm)


@hookimpl
def register_joint_predictors(register: Register) -> None:
    """Register `p3sam-vlm`."""
    from .predictor import VlmJoints

    register(VlmJoints)
