"""What is checked: an object's files, and the asset that they were made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ..asset import Asset
from ..errors import BadInputError
from .mechanism import Mechanism, of_asset

if TYPE_CHECKING:
    from ..lint import Finding
    from .simulation import Simulation

# Suffixes of main files, by format. The first format of an object that says how it moves is simulated.
_SIMULATED = {
    "mjcf": (".xml", ".mjz"),
    "urdf": (".urdf",),
    "usd": (".usd", ".usda", ".usdc"),
}
_SHOWN = {"usdz": (".usdz",), "glb": (".glb",)}
# USDZ of others may have physics.
_ALONE = _SIMULATED | {"usd": (*_SIMULATED["usd"], ".usdz")}


@dataclass(frozen=True, eq=False)
class Subject:
    """One object.

    Attributes:
        files: main file by format: "urdf", "mjcf", "usd"; other formats are only looked at as files.
        asset: what they were made from; None for files of others.
    """

    files: Mapping[str, Path] = field(default_factory=dict)
    asset: Asset | None = None

    @property
    def simulated(self) -> Mapping[str, Path]:
        """Those files that say how the object moves."""
        return {name: self.files[name] for name in _SIMULATED if name in self.files}

    @property
    def moving(self) -> int:
        """Joints of the asset that move; 0 where it is not known."""
        return sum(joint.moves for joint in self.asset.joints) if self.asset is not None else 0

    def bare(self) -> Subject:
        """The same without what has been read and worked out of it, to be sent to another process."""
        return Subject(self.files, self.asset and self.asset.bare())

    @cached_property
    def findings(self) -> Mapping[str, tuple[Finding, ...]]:
        """What the linter says of each file that it knows."""
        from ..lint import LINTERS, lint

        known = {k: p for k, p in self.files.items() if p.suffix.lower() in LINTERS and p.is_file()}
        return {name: lint(path) for name, path in known.items()}

    @cached_property
    def mechanisms(self) -> Mapping[str, Mechanism]:
        """What each file says; raises BadInputError when one cannot be read."""
        from .reading import read_mechanism

        return {name: read_mechanism(name, path) for name, path in self.simulated.items()}

    @cached_property
    def mechanism(self) -> Mechanism:
        """What the asset says, or else the first file; raises BadInputError when there is nothing."""
        if self.asset is not None:
            return of_asset(self.asset)
        if not self.simulated:
            raise BadInputError("nothing to check: give an asset folder, a URDF, an MJCF or a USD file")
        return next(iter(self.mechanisms.values()))

    @cached_property
    def simulation(self) -> Simulation:
        """The first of its files in MuJoCo, or the asset itself where none of them moves.

        Raises:
            BadInputError: it does not load.
        """
        from .simulation import Simulation

        kind, path = next(iter(self.simulated.items()), ("", None))
        if path is None:
            return Simulation.of_mechanism(self.mechanism)
        return Simulation.of_mechanism(self.mechanisms[kind]) if kind == "usd" else Simulation.of_file(path)


def subject_of(path: Path) -> Subject:
    """What a path is: the output folder of a conversion, or one file of a format.

    Raises:
        BadInputError: neither; the message says what can be checked.
    """
    if path.is_dir():
        from ..asset_io import load_asset

        return Subject(_exported(path), load_asset(path))
    if not path.is_file():
        raise BadInputError(f"{path}: no such file or folder")
    for kind, suffixes in _ALONE.items():
        if path.suffix.lower() in suffixes:
            return Subject({_kind(kind, path): path})
    known = ", ".join(suffix for suffixes in _ALONE.values() for suffix in suffixes)
    raise BadInputError(f"{path}: give an output folder of a conversion, or a file of {known}")


def _kind(kind: str, path: Path) -> str:
    """URDF may be in a file called XML."""
    from ..bench.mujoco_loading import is_urdf

    return "urdf" if path.suffix.lower() == ".xml" and is_urdf(path) else kind


def _exported(folder: Path) -> dict[str, Path]:
    """Main files in the folder of each format: the one that is called as the asset."""
    found = {}
    for kind, suffixes in (_SIMULATED | _SHOWN).items():
        files = sorted(p for p in (folder / kind).rglob("*") if p.suffix.lower() in suffixes)
        named = [p for p in files if p.parent == folder / kind and p.name != "package.xml"] or files
        if named:
            found[kind] = named[0]
    return found
