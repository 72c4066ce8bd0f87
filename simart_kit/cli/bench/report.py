"""`simart-kit bench report`."""

from __future__ import annotations

from ..options import Verbose
from .options import Run


def report(run: Run, verbose: Verbose = False) -> None:
    """Write the page of a run again, from its rows."""
    from ...bench.page import write_page

    print(write_page(run))
