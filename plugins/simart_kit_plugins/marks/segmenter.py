"""Segmenter `p3sam-vlm`: another segmenter's pieces, named, merged and moved by a vision-language model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from simart_kit import Segmentation, Segmenter
from simart_kit.stages import Composed

from ..vlm import VlmOptions
from .proposer import Proposer

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.grounding import Grounded
    from simart_kit.plugins import Plugins
    from simart_kit.spec.values import Spec

    from ..vlm import Vlm
    from .proposing import Proposed
    from .talk import Talk


class P3SamVlm(Composed, Segmenter):
    """Parts and joints by a vision-language model that chooses among drawn numbers and letters.

    Args:
        options: which model, and whose pieces.
        seed: of the proposer's generators.
        plugins: where the proposer is found; None: all that are installed.
        vlm: that is asked; None: the one of the options.
    """

    name = "p3sam-vlm"

    class Options(VlmOptions):
        """Which model is asked, about which pieces."""

        proposer: Proposer = Field(
            default=Proposer(use="p3sam"),
            description="Segmenter whose pieces are numbered: its finer ones if it has them, else its parts.",
        )
        max_pieces: int = Field(
            default=40,
            ge=2,
            le=99,
            description="Most pieces to number; the smallest beyond join what they are next to.",
        )
        crease: float = Field(
            default=180.0,
            gt=0,
            le=180,
            description="Edges sharper than this cut pieces further, as far as max_pieces lets [degrees].",
        )
        critic: int = Field(
            default=0, ge=0, le=3, description="Most rounds in which the model looks for faults in motion."
        )

    options: Options

    def __init__(
        self,
        options: Options | None = None,
        *,
        seed: int = 0,
        plugins: Plugins | None = None,
        vlm: Vlm | None = None,
    ) -> None:
        super().__init__(options, seed=seed, plugins=plugins)
        self._vlm = vlm

    def segment(self, mesh: Mesh) -> Segmentation:
        """The body as part 0, then each link, with its joint as a hint.

        Raises:
            BadInputError: the model cannot be asked, or gives no usable answer.
            StageError, UnknownPluginError, RecipeError: the proposer fails or is none.
        """
        return self._segmented(mesh, None)

    def segment_to(self, mesh: Mesh, spec: Spec) -> Segmentation:
        """As `segment`, the model being told what a person states; errors are the same."""
        return self._segmented(mesh, spec)

    def ground(self, mesh: Mesh, description: str) -> Grounded:
        """The faces that a description means, of whole pieces; none where the model sees nothing of the kind.

        Raises:
            BadInputError: the model cannot be asked, or gives no usable answer.
            StageError, UnknownPluginError, RecipeError: the proposer fails or is none.
        """
        from .grounded import grounded

        return grounded(self._talk(), self._proposed(mesh), description)

    def _segmented(self, mesh: Mesh, spec: Spec | None) -> Segmentation:
        from .conversion import articulated
        from .wishes import wishes_text

        talk, found = self._talk(), self._proposed(mesh)
        return articulated(talk, found, self.options.critic, wishes_text(spec))

    def _talk(self) -> Talk:
        from ..vlm import open_vlm
        from .prompts import SYSTEM
        from .talk import Talk

        return Talk(self._vlm or open_vlm(self.options), SYSTEM, self.options)

    def _proposed(self, mesh: Mesh) -> Proposed:
        from simart_kit.plugins import Plugins

        from .proposing import proposed

        options = self.options
        plugins = self.plugins or Plugins()
        crease = float(np.deg2rad(options.crease))
        return proposed(mesh, options.proposer, plugins, self.seed, options.max_pieces, crease)
