"""Whether a surface that came back is that of the mesh that was sent."""

from __future__ import annotations

from simart_kit import Mesh
from simart_kit.bench.articulation import Articulation
from simart_kit.errors import BadInputError

from ..adapters.placing import Placed, best_of
from .failures import WorkerError


def check_place(found: Articulation, mesh: Mesh) -> None:
    """See that an object lies where the mesh does.

    Args:
        found: in the canonical frame.
        mesh: that was sent.

    Raises:
        WorkerError: it is elsewhere, of another size, or another object.
    """
    try:
        best_of([Placed(found, "as it was sent")], mesh)
    except BadInputError as error:
        raise WorkerError(f"gave back another surface than it was sent: {error}") from None
