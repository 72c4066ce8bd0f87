"""Times the USD exporter beside URDF -> USD by urdf-usd-converter, on the example cut into 45,632 faces.

Both run in processes of their own and write to the same kind of folder: the best of several goes, in which
ours, as in a conversion, comes after the preview and the other formats, whose work on the asset it shares;
on an asset fresh from its folder; and there without the thumbnail, which the converter does not draw.

Usage: python tests/bench_usd.py [--goes N]
"""

import argparse
import shutil
import subprocess
import tempfile
import time
import venv
from pathlib import Path

from bench import write_split

from simart_kit import Plugins, convert
from simart_kit.asset import Asset
from simart_kit.asset_io import load_asset
from simart_kit.recipe import build, load_recipe
from simart_kit.render import write_preview
from simart_kit.stages import Exporter

HOME = Path(__file__).resolve().parents[1] / "build" / "urdf-usd-converter"
CONVERTER = "urdf-usd-converter==0.3.4"
THEIRS = """
import sys, time
from urdf_usd_converter import Converter
for number in range(int(sys.argv[3])):
    converter, start = Converter(), time.perf_counter()
    converter.convert(sys.argv[1], f"{sys.argv[2]}/theirs_{number}")
    print(time.perf_counter() - start, flush=True)
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--goes", type=int, default=5)
    goes = parser.parse_args().goes
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        faces = write_split(folder / "cabinet.glb", 4)
        made = convert(folder / "cabinet.glb", "all", out=folder / "out", record=False)
        print(f"{faces} faces, {len(made.asset.parts)} parts, best of {goes}")
        theirs = their_seconds(made.paths["urdf"], folder, goes)
        print(f"  URDF -> USD by {CONVERTER}  {theirs:.3f} s")
        for words, before, thumbnail in (
            ("in a conversion", ("urdf", "mjcf"), True),
            ("by itself", (), True),
            ("no thumbnail", (), False),
        ):
            again = folder / "again"
            ours = min(our_seconds(folder / "out", again, before, thumbnail) for _ in range(goes))
            print(f"  ours {words:<16}  {ours:.3f} s, {theirs / ours:.1f} times as fast")


def their_seconds(urdf: Path, folder: Path, goes: int) -> float:
    """The best of several conversions in one process of the converter's own environment [s]."""
    python = HOME / "bin" / "python"
    if not python.exists():
        venv.create(HOME, with_pip=True)
        subprocess.run([str(python), "-m", "pip", "install", "--quiet", CONVERTER], check=True)
    command = [str(part) for part in (python, "-c", THEIRS, urdf, folder, goes)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    return min(float(line) for line in done.stdout.split())


def our_seconds(source: Path, out: Path, before: tuple[str, ...], thumbnail: bool) -> float:
    """One USD export of a converted asset, after its preview and other formats if there are any [s]."""
    shutil.rmtree(out, ignore_errors=True)
    asset = load_asset(source)
    out.mkdir()
    if before:
        write_preview(asset, out / "preview.png")
    for format_ in before:
        _export(format_, asset, out / format_, {})
    return _export("usd", asset, out / "usd", {"thumbnail": thumbnail})


def _export(format_: str, asset: Asset, folder: Path, options: dict[str, object]) -> float:
    plugins = Plugins()
    use = next(use for use in load_recipe(format_, plugins).export if use.use == format_)
    use = use.model_copy(update={"options": {**use.options, **options}})
    stage, _ = build(use, Exporter, plugins, 0)
    folder.mkdir()
    start = time.perf_counter()
    stage.export(asset, folder)
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
