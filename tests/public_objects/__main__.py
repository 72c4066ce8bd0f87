"""Make real articulated objects of what public packages hold: `python -m tests.public_objects OUT`."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from simart_kit.errors import SimartKitError

from .making import make_objects
from .skinned import add_skin
from .sources import Source, known_sources


def main(arguments: Sequence[str] | None = None) -> int:
    """Make them, and return the exit status."""
    known = known_sources()
    options = _options(list(known), arguments)
    chosen = {name: known[name] for name in options.source or known}
    if options.out is None:
        _tell(_listing(chosen), sys.stdout)
        return 0
    try:
        made = make_objects(chosen, options.out, lambda text: _tell(text, sys.stderr))
    except SimartKitError as error:
        _tell(f"error: {error}", sys.stderr)
        return error.exit_code
    for folder in made if options.skins else ():
        add_skin(folder)
    sets = Counter(folder.parent.name for folder in made)
    _tell(f"{len(made)} objects in {options.out}: {_counts(sets)}; for evaluation only", sys.stdout)
    return 0


def _options(known: list[str], arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="public_objects",
        description="Make real articulated objects with ground truth, of what public packages hold.",
        epilog="The objects are those of others, under their licences, and for evaluation only.",
    )
    target = parser.add_mutually_exclusive_group(required=True)
    target.add_argument(
        "out", nargs="?", type=Path, help="folder to write: OUT/develop/NAME, OUT/verify/NAME"
    )
    target.add_argument("--list", action="store_true", help="say what there is, and download nothing")
    parser.add_argument("--source", nargs="+", choices=known, metavar="NAME", help="only these packages")
    parser.add_argument("--skins", action="store_true", help="write a closed skin of each, too: fused.glb")
    return parser.parse_args(arguments)


def _listing(sources: dict[str, Source]) -> str:
    lines = []
    for name, source in sources.items():
        sets = Counter[str](entry.set for entry in source.objects.values())
        lines.append(
            f"{name:<23}{source.version:<13}{source.megabytes:>4} MB  {_counts(sets):<24}{source.licence}"
        )
    return "\n".join(lines)


def _counts(sets: Counter[str]) -> str:
    return ", ".join(f"{sets[name]} {name}" for name in ("develop", "verify") if sets[name])


def _tell(text: str, stream: TextIO) -> None:
    print(text, file=stream, flush=True)


if __name__ == "__main__":
    sys.exit(main())
