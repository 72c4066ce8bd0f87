"""All objects of some packages: downloaded, read and written aside, then moved into place."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import staging

from .controller import read_controller
from .fetching import fetch
from .mjcf import read_mjcf
from .rigged import Rigged
from .sources import Entry, Source
from .sweet_home import read_sweet_home
from .urdf import read_urdf
from .writing import Origin, write_object

READERS: dict[str, Callable[[Path, Entry], Rigged]] = {
    "mjcf": read_mjcf,
    "urdf": read_urdf,
    "controller": read_controller,
    "sweet-home": read_sweet_home,
}
_REGISTRIES = {"wheel": "PyPI", "npm": "npm", "deb": "Debian"}
# Told of a source before it is downloaded.
Progress = Callable[[str], None]


def make_objects(sources: Mapping[str, Source], out: Path, progress: Progress) -> tuple[Path, ...]:
    """Write the objects of some sources as out/develop/NAME and out/verify/NAME: all of them, or nothing.

    Returns:
        The folders.

    Raises:
        BadInputError: one of the folders is there already, or a package cannot be had or read.
        OutputError: `out` cannot be written.
    """
    places = [Path(entry.set) / name for source in sources.values() for name, entry in source.objects.items()]
    there = [str(out / place) for place in places if (out / place).exists()]
    if there:
        more = f" and {len(there) - 1} more" if len(there) > 1 else ""
        raise BadInputError(f"{there[0]}{more} exists: remove it, or choose another folder")
    with staging(out) as draft:
        try:
            for name, source in sources.items():
                progress(f"{name} {source.version}: {source.megabytes} MB")
                package = draft / "package"
                _make(source, fetch(source, package), draft)
                shutil.rmtree(package)  # unpacked, the larger ones are hundreds of megabytes
            for place in places:
                (out / place).parent.mkdir(exist_ok=True)
                (draft / place).rename(out / place)
        except OSError as error:
            raise OutputError(f"cannot write to {out}: {error.strerror or error}") from error
    return tuple(out / place for place in places)


def _make(source: Source, root: Path, draft: Path) -> None:
    """Write all objects of an unpacked package."""
    for name, entry in source.objects.items():
        if not (root / entry.file).is_file():
            raise BadInputError(f"{source.package} {source.version} has no {source.root}/{entry.file}")
        rigged = READERS[source.reader](root / entry.file, entry)
        package = f"{_REGISTRIES[source.kind]} {source.package}"
        origin = Origin(package, source.version, f"{source.root}/{entry.file}", source.licence_of(name))
        write_object(rigged, name, entry.category, origin, draft / entry.set / name)
