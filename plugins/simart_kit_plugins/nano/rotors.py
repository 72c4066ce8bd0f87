"""Blades turn together: where geometry sees a rotor, what the network takes its blades for is one part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..geometric.rotors import ROTORS
from .proposals import Proposal, only

if TYPE_CHECKING:
    from simart_kit import Mesh

_LEFT = 0.5  # of its area that a part keeps at least, or else it was one of blades
# Blades are set by turning about themselves if the network is so sure, and that is so far off the rotor.
_SURE, _ACROSS = 0.7, np.cos(np.deg2rad(45.0))


def with_rotors(mesh: Mesh, proposals: Sequence[Proposal], geometry: Sequence[Proposal]) -> list[Proposal]:
    """The network's proposals with each rotor of geometry's in place of what they take its blades for.

    A rotor hangs on what the largest of these hangs on. Blades that are surely set, as a wind turbine's, are
    parts of their own.

    Args:
        mesh: of the faces.
        proposals: the network's; none share a face.
        geometry: what geometry finds.
    """
    areas, kept = mesh.face_areas, list(proposals)
    for rotor in (p for p in geometry if p.guess.label in ROTORS):
        shared = [float(areas[p.faces & rotor.faces].sum()) for p in kept]
        blades = [k for k, p in enumerate(kept) if shared[k] > (1 - _LEFT) * float(areas[p.faces].sum())]
        if sum(_set(kept[k], rotor) for k in blades) > len(blades) / 2:
            continue
        kept = [replace(p, faces=p.faces & ~rotor.faces) if shared[k] else p for k, p in enumerate(kept)]
        if not blades:
            kept.append(replace(rotor, parent=None))
            continue
        first = max(blades, key=lambda k: shared[k])
        carrier = None if kept[first].parent in blades else kept[first].parent
        guess = kept[first].guess if kept[first].guess.label in ROTORS else rotor.guess
        kept[first] = Proposal(rotor.faces, guess, rotor.joint, carrier)
        kept = only(kept, [k for k in range(len(kept)) if k == first or k not in blades])
    return kept


def _set(blade: Proposal, rotor: Proposal) -> bool:
    """Whether a blade surely turns about a line across its rotor's axis."""
    across = abs(float(np.dot(blade.joint.axis, rotor.joint.axis))) < _ACROSS
    return across and blade.joint.turns and blade.joint.confidence >= _SURE
