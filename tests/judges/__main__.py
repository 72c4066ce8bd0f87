"""Ask the judges: `make judges`, or `PYTHONPATH=tests python -m judges --help`."""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from simart_kit.errors import BadInputError

from .asking import verdicts
from .assets import BUILD, known, prepare
from .homes import NotInstalledError
from .panel import JUDGES, Judge
from .seeding import seeded
from .table import Hearing, report

SOUND = "cabinet"  # with hinges and slides, to seed defects in


def main() -> int:
    """Ask, print, and return 1 if anything is wrong, 2 if the command line is."""
    options = _options()
    try:
        judges = _chosen(options.judges, [judge.name for judge in JUDGES if judge.light or not options.light])
        if options.folders:
            folders = {folder.resolve().name: folder for folder in options.folders}
        else:
            folders = prepare(_chosen(options.assets, known()))
        sound = prepare([SOUND])[SOUND] if options.seeded else None
        hearings = [ask(judge, folders, sound) for judge in JUDGES if judge.name in judges]
    except BadInputError as error:
        print(error, file=sys.stderr)
        return 2
    print(report(hearings, list(folders)))
    return int(any(hearing.failed for hearing in hearings))


def ask(judge: Judge, folders: dict[str, Path], sound: Path | None, build: Path = BUILD) -> Hearing:
    """What a judge says, or why it is not asked; `sound` is an output to seed defects in, or None."""
    print(f"asking {judge.name}", file=sys.stderr, flush=True)
    try:
        missed = _missed(judge, sound, build) if sound else ()
        return Hearing(judge.name, verdicts(judge, folders, build), missed)
    except NotInstalledError as error:
        return Hearing(judge.name, {}, absent=f"not asked: {error}")
    except subprocess.CalledProcessError as error:
        return Hearing(judge.name, {}, absent=f"cannot be installed: {error}", broken=True)


def _missed(judge: Judge, sound: Path, build: Path) -> tuple[str, ...]:
    """Defects that a judge is shown, in copies of an asset, and says nothing of."""
    home = build / "seeded" / judge.format
    copies = {defect: seeded(sound, judge.format, defect, home / defect) for defect in judge.sees}
    found = verdicts(judge, {"": sound, **copies}, build)
    usual = set(found[""].errors)
    return tuple(defect for defect in copies if usual.issuperset(found[defect].errors))


def _chosen(asked: str, names: list[str]) -> list[str]:
    """Those that are asked for, or all."""
    chosen = [name.strip() for name in asked.split(",") if name.strip()]
    unknown = sorted(set(chosen) - set(names))
    if unknown:
        raise BadInputError(f"no {', '.join(unknown)}: there are {', '.join(names)}")
    return chosen or names


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="judges", description="Ask other tools what they make of our exports."
    )
    parser.add_argument(
        "folders", nargs="*", type=Path, help="outputs of conversions; default: our own objects"
    )
    parser.add_argument("--judges", default="", help="only these, with commas between them")
    parser.add_argument("--assets", default="", help="only these objects, with commas between them")
    parser.add_argument(
        "--light", action="store_true", help="only judges that need no environment of their own"
    )
    parser.add_argument("--seeded", action="store_true", help="also show each judge defects that it must see")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
