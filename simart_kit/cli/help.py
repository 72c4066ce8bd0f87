"""Help texts of all commands, for the documentation."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import redirect_stdout
from io import StringIO

from .main import run


def help_text(command: Sequence[str]) -> str:
    """What `simart-kit COMMAND --help` prints, but for the exit codes that all commands share."""
    printed = StringIO()
    with redirect_stdout(printed):
        run([*command, "--help"])
    return printed.getvalue().partition("\n  Exit codes:")[0].rstrip()
