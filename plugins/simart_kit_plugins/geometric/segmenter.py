"""Segmenter `geometric`: imported at every start, so that it imports nothing of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Segmenter

if TYPE_CHECKING:
    from simart_kit import Mesh, Segmentation
    from simart_kit.spec.values import Spec


class Geometric(Segmenter):
    """Doors, drawers, lids, racks, wheels, rotors and controls by shape, handles and what lies around."""

    name = "geometric"

    class Options(simart_kit.Options):
        """What to look for."""

        max_parts: int = Field(default=32, ge=1, description="Most moving parts; the surest are kept.")
        crease: float = Field(default=25.0, gt=0, lt=90, description="Angle that bounds patches [degrees].")
        node_hint: bool = Field(default=False, description="Keep scene-graph nodes of the file apart.")

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The body as part 0, then every mover found; a static object is one part."""
        return self._segmented(mesh, None)

    def segment_to(self, mesh: Mesh, spec: Spec) -> Segmentation:
        """As `segment`, with as many movers of each kind as a spec states, where there are."""
        return self._segmented(mesh, spec)

    def _segmented(self, mesh: Mesh, spec: Spec | None) -> Segmentation:
        from .parts import parts_of

        options = self.options
        crease = float(np.deg2rad(options.crease))
        return parts_of(mesh, spec, options.max_parts, crease, options.node_hint)
