"""`simart-kit bench report`."""

from __future__ import annotations

from ..common import warn
from ..options import Verbose
from .options import Run


def report(run: Run, verbose: Verbose = False) -> None:
    """Write the page of a run again, from its rows."""
    from ...bench.numbers import counted, listed
    from ...bench.page import write_page
    from ...bench.rows import damaged_rows

    page = write_page(run)
    damaged = damaged_rows(run)
    if damaged:
        warn([f"{counted(len(damaged), 'row')} left out as damaged: {listed(damaged)}; run it again"])
    print(page)
