"""Parts by P3-SAM, of a Hunyuan3D-Part that the user installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.hookspecs import hookimpl

if TYPE_CHECKING:
    from simart_kit.findings import Finding
    from simart_kit.hookspecs import Register


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `p3sam`."""
    from .segmenter import P3Sam

    register(P3Sam)


@hookimpl
def diagnose() -> list[Finding]:
    """Its checkout, its python, a GPU, and what its licence forbids."""
    from ..workers.installation import findings
    from .system import P3SAM

    return findings(P3SAM)
