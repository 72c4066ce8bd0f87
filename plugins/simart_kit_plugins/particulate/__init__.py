"""Parts and joints by Particulate, of a checkout that the user installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.hookspecs import hookimpl

if TYPE_CHECKING:
    from simart_kit.findings import Finding
    from simart_kit.hookspecs import Register


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `particulate`."""
    from .segmenter import Particulate

    register(Particulate)


@hookimpl
def diagnose() -> list[Finding]:
    """Its checkout, its python, a GPU, and what its licence forbids."""
    from ..workers.installation import findings
    from .system import PARTICULATE

    return findings(PARTICULATE)
