"""The objects that judges see, converted once and again when the package has changed."""

from __future__ import annotations

import hashlib
import shutil
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import simart_kit as sk

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "judges"
EXAMPLES, DATA = ROOT / "examples", ROOT.parent / "shared" / "data"
SOURCES = ("simart_kit", "plugins", "exporters", "recipes")
RECIPE = "all"
# Twenty, of all kinds of joints, in and out of the kitchen; the last one has none.
GENERATED = [
    "cabinet",
    "drawer_chest",
    "wardrobe",
    "fridge",
    "oven",
    "dishwasher",
    "washing_machine",
    "microwave",
    "door",
    "window",
    "laptop",
    "trash_can",
    "toilet",
    "scissors",
    "office_chair",
    "globe",
    "fan",
    "tap",
    "sliding_cabinet",
    "chair",
]


def known() -> list[str]:
    """Names of all objects: examples, real ones where they are kept, and generated ones."""
    real = sorted(path.parent.name for path in DATA.glob("*/input.glb"))
    return (
        [path.stem for path in sorted(EXAMPLES.glob("*.glb"))] + real + [f"generated_{g}" for g in GENERATED]
    )


def prepare(names: Iterable[str]) -> dict[str, Path]:
    """Output folder of each object, by name.

    Raises:
        SimartKitError: an object cannot be converted.
    """
    return {name: _converted(name) for name in names}


def _converted(name: str) -> Path:
    # A folder is named as its asset: layouts of USD assets ask for it.
    folder, stamp = BUILD / "assets" / name, BUILD / "assets" / f"{name}.sha256"
    source = _source(name)
    key = hashlib.sha256(source.read_bytes() + _package().encode()).hexdigest()
    if not (stamp.exists() and stamp.read_text(encoding="utf-8") == key):
        print(f"converting {name}", file=sys.stderr, flush=True)
        shutil.rmtree(folder, ignore_errors=True)
        sk.convert(source, RECIPE, out=folder, name=name, sets=[f"export=[{_exports()}]"], record=False)
        stamp.write_text(key, encoding="utf-8")
    return folder


def _source(name: str) -> Path:
    if not name.startswith("generated_"):
        paths = (EXAMPLES / f"{name}.glb", DATA / name / "input.glb")
        return next(path for path in paths if path.exists())
    return _generated() / f"{name.removeprefix('generated_')}_0000" / "input.glb"


@cache
def _generated() -> Path:
    from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
    from simart_kit_plugins.nano.generate.category import named
    from simart_kit_plugins.nano.generate.data_set import write_objects

    folder = BUILD / "generated"
    stamp = folder / "package.sha256"
    if not (stamp.exists() and stamp.read_text(encoding="utf-8") == _package()):
        shutil.rmtree(folder, ignore_errors=True)
        categories = tuple(named(name, CATEGORIES) for name in GENERATED)
        write_objects(categories, 1, 0, folder, 1 / 3, lambda done, of: None)
        stamp.write_text(_package(), encoding="utf-8")
    return folder


@cache
def _exports() -> str:
    """Every exporter that is registered, as a list of TOML."""
    names = sorted(r.name for r in sk.Plugins(installed=False).registrations("exporter"))
    return ", ".join(f'{{use="{name}"}}' for name in names)


@cache
def _package() -> str:
    """Hash of all that decides what a conversion gives."""
    digest = hashlib.sha256()
    for path in sorted(p for source in SOURCES for p in (ROOT / source).rglob("*") if p.is_file()):
        if "__pycache__" not in path.parts:
            digest.update(str(path.relative_to(ROOT)).encode() + path.read_bytes())
    return digest.hexdigest()
