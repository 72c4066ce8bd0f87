"""What an exporter must keep."""

from __future__ import annotations

from pathlib import Path

import pytest

from ...asset import Asset
from ...stages import Exporter
from .. import meshes
from ..export_text import complaints
from ..fingerprint import fingerprint, folder_fingerprint
from ..readers import reader
from .stages import StageContract


class ExporterContract(StageContract):
    """For Exporters."""

    kind = Exporter

    @pytest.fixture(params=["cabinet", "chain", "static"])
    def asset(self, request: pytest.FixtureRequest) -> Asset:
        """Textured parts with a hinge and a slide; slanted axes in a chain; one part that nothing moves."""
        made: Asset = getattr(meshes, f"{request.param}_asset")()
        return made

    def export(self, asset: Asset, directory: Path) -> Path:
        """Export into a fresh directory, as the core does; the main file."""
        directory.mkdir(parents=True)
        main = self.make().export(asset, directory)
        assert isinstance(main, Path), f"export() returned {type(main).__name__}, expected a Path"
        assert main.is_file(), f"export() returned {main}, which is no file"
        assert main.resolve().is_relative_to(directory.resolve()), f"{main} is outside the directory"
        return main

    def moving_joints(self, main: Path) -> int | None:
        """How many joints an independent reader finds; None skips the comparison.

        Override it for a format that `simart_kit.testing.readers` does not know.
        """
        read = reader(main)
        return None if read is None else read(main)

    def test_main_file_is_in_the_directory(self, asset: Asset, tmp_path: Path) -> None:
        self.export(asset, tmp_path / "made")

    def test_same_bytes_every_time(self, asset: Asset, tmp_path: Path) -> None:
        one = self.export(asset, tmp_path / "one")
        two = self.export(asset, tmp_path / "another" / "place")
        assert one.name == two.name
        first, second = folder_fingerprint(one.parent), folder_fingerprint(two.parent)
        differ = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
        assert not differ, f"these files differ between two exports: {', '.join(differ)}"

    def test_names_no_place_and_no_time(self, asset: Asset, tmp_path: Path) -> None:
        directory = tmp_path / "made"
        self.export(asset, directory)
        found = complaints(directory, forbidden=(str(tmp_path), str(Path.cwd())))
        assert not found, "\n".join(found)

    def test_writes_nothing_elsewhere(
        self, asset: Asset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        work = tmp_path / "work"
        work.mkdir()
        monkeypatch.chdir(work)
        self.export(asset, tmp_path / "made")
        assert {path.name for path in tmp_path.iterdir()} == {"work", "made"}
        assert list(work.iterdir()) == [], "export() wrote into the working directory"

    def test_leaves_the_asset_alone(self, asset: Asset, tmp_path: Path) -> None:
        before = fingerprint(asset)
        exporter = self.make()
        exporter.export(asset, tmp_path)
        exporter.unsupported(asset)
        assert fingerprint(asset) == before, "export() changed its input"

    def test_another_reader_finds_the_joints(self, asset: Asset, tmp_path: Path) -> None:
        found = self.moving_joints(self.export(asset, tmp_path / "made"))
        if found is None:
            pytest.skip("no independent reader for this format: override moving_joints()")
        assert found == sum(joint.moves for joint in asset.joints)

    def test_tells_what_it_cannot_express(self, asset: Asset) -> None:
        told = self.make().unsupported(asset)
        assert isinstance(told, tuple), f"unsupported() returned {type(told).__name__}, expected a tuple"
        assert all(isinstance(text, str) and text for text in told), "unsupported() must return sentences"
