"""The entry point: runs one command line and turns whatever happens into an exit code."""

from __future__ import annotations

import gc
import io
import json
import os
import signal
import sys
import traceback
from collections.abc import Sequence

import typer
from typer.main import get_command

from ..errors import SimartKitError
from .app import app
from .options import Flags

FAILED, USAGE, INTERRUPTED, READER_GONE = 1, 2, 130, 141


def main() -> None:
    """Run the process's command line and exit."""
    # Before NumPy is loaded: products here are small, and threads of BLAS would wait for each other longer
    # than they work. It also makes the last digits the same on machines of any number of processors.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # What `kill`, `timeout` and containers send; unlike its default, this lets a run tidy up.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # a terminal may not know every letter of a path
    code = run(sys.argv[1:])
    # All that is left ends with the process: to look through it for cycles first takes a third of a second.
    # What a failure leaves in its traceback is let go of, since libraries complain of what they find then.
    if code == 0:
        gc.freeze()
    sys.exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run a command line; returns the exit code."""
    flags = Flags()
    try:
        try:
            return _run(arguments, flags)
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        _print_failure("interrupted", INTERRUPTED, flags)
        return INTERRUPTED
    except BrokenPipeError:
        # Python flushes stdout once more when it exits, and would complain then.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return READER_GONE


def _run(arguments: Sequence[str], flags: Flags) -> int:
    try:
        with get_command(app).make_context("simart-kit", list(arguments), obj=flags) as context:
            context.command.invoke(context)
    except typer.Exit as end:
        return end.exit_code
    except typer.TyperException as error:
        return _told(error.format_message().replace("Value error, ", ""), USAGE, Flags(json=flags.json))
    except SimartKitError as error:
        return _told("; ".join([str(error), *getattr(error, "__notes__", ())]), error.exit_code, flags)
    except BrokenPipeError:
        raise
    except Exception as error:
        where = f" in plugin {flags.owner}" if flags.owner else ""
        advice = "" if flags.verbose else "; run with -v for the traceback, and please report it"
        return _told(f"unexpected {type(error).__name__}{where}: {error}{advice}", FAILED, flags)
    return 0


def _told(message: str, code: int, flags: Flags) -> int:
    line = " ".join(message.split())
    if flags.verbose:
        traceback.print_exc(file=sys.stderr)
    print(f"error: {line}", file=sys.stderr)
    _print_failure(line, code, flags)
    return code


def _print_failure(text: str, code: int, flags: Flags) -> None:
    """The one document of a `--json` run that fails."""
    if flags.json:
        print(json.dumps({"ok": False, "error": text, "exit_code": code}))
