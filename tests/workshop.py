"""Fake stages, right or with a fault, and a folder in which to run them."""

import time
from pathlib import Path
from typing import Literal

import numpy as np

import simart_kit as sk
from simart_kit.errors import BadInputError
from simart_kit.exports import export_folder
from simart_kit.pipeline import Result, convert
from simart_kit.plugins import Owner, Plugins
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh

OWNER = Owner("fakes", "fake-distribution", "9.8.7")
RECIPE = """
schema = 1
[segmenter]
use = "fake_labels"
[joints]
use = "fake_joints"
[[modify]]
use = "fake_note"
[[export]]
use = "fake_text"
"""


class Labels(sk.Segmenter):
    """The cabinet's true parts, or a fault."""

    name = "fake_labels"

    class Options(sk.Options):
        fault: Literal["none", "raise", "exit", "hang", "shape", "dtype", "type", "interrupt"] = "none"

    options: Options

    def segment(self, mesh: sk.Mesh) -> sk.Segmentation:
        labels = np.repeat([0, 1, 2], [60, 24, 24]).astype(np.int32)
        match self.options.fault:
            case "raise":
                raise RuntimeError("out of ideas\nsecond line")
            case "exit":
                raise SystemExit(3)
            case "hang":
                time.sleep(30)
            case "shape":
                labels = labels[:-1]
            case "dtype":
                labels = labels.astype(np.float32)
            case "type":
                return labels  # type: ignore[return-value]
            case "interrupt":
                raise KeyboardInterrupt
        return sk.Segmentation(labels, tuple(sk.PartGuess(n) for n in ("body", "door", "drawer")))


class Joints(sk.JointPredictor):
    """The cabinet's true joints, or a fault."""

    name = "fake_joints"

    class Options(sk.Options):
        fault: Literal["none", "raise", "unknown part"] = "none"

    options: Options

    def predict(self, mesh: sk.Mesh, segmentation: sk.Segmentation) -> tuple[sk.Joint, ...]:
        if self.options.fault == "raise":
            raise RuntimeError("no joint today")
        if self.options.fault == "unknown part":
            return (sk.Joint("lid_hinge", "fixed", "body", "lid"),)
        return cabinet_asset().joints


class Remark(sk.Modifier):
    """Adds a note, or a fault."""

    name = "fake_note"

    class Options(sk.Options):
        text: str = "a remark"
        fault: Literal["none", "raise", "nothing", "constructor"] = "none"

    options: Options

    def __init__(self, options: Options | None = None, *, seed: int = 0) -> None:
        super().__init__(options, seed=seed)
        if self.options.fault == "constructor":
            raise FileNotFoundError("weights.bin")

    def modify(self, asset: sk.Asset) -> sk.Asset:
        if self.options.fault == "raise":
            raise RuntimeError("cannot")
        if self.options.fault == "nothing":
            return None  # type: ignore[return-value]
        return asset.with_notes("fake_note", "info", [self.options.text])


class Text(sk.Exporter):
    """Writes the joints' limits as text, or half of it."""

    name = "fake_text"

    class Options(sk.Options):
        fault: Literal["none", "half", "elsewhere", "gaps"] = "none"
        greeting: str = "hello"

    options: Options

    def export(self, asset: sk.Asset, directory: Path) -> Path:
        main = directory / f"{asset.name}.txt"
        main.write_text(f"{self.options.greeting} {asset.name}\n")
        if self.options.fault == "half":
            raise RuntimeError("disk on fire")
        if self.options.fault == "elsewhere":
            return directory.parent / "asset.json"
        (directory / "limits.txt").write_text("".join(f"{j.name} {j.limits}\n" for j in asset.joints))
        return main

    def unsupported(self, asset: sk.Asset) -> tuple[str, ...]:
        if self.options.fault == "gaps":
            raise RuntimeError("lost count")
        return ("text has no shape",)


class Fakes:
    """All of the above, and a loader of `.fake` files."""

    @sk.hookimpl
    def register_segmenters(self, register):
        register(Labels)

    @sk.hookimpl
    def register_joint_predictors(self, register):
        register(Joints)

    @sk.hookimpl
    def register_modifiers(self, register):
        register(Remark)

    @sk.hookimpl
    def register_exporters(self, register):
        register(Text)

    @sk.hookimpl
    def load_mesh(self, path):
        if path.suffix != ".fake":
            return None
        if path.read_text() != "cabinet":
            raise BadInputError(f"{path} is no cabinet")
        return cabinet_mesh(textured=False)


class Camera:
    """An observer that leaves a recording, finished or not."""

    @sk.hookimpl
    def stage_finished(self, run, stage, name):
        with (run.folder / f"{run.name}.rrd").open("a") as file:
            file.write(f"{stage} {name}\n")


class Workshop:
    """A temporary folder with a source, a recipe and fresh plugins for each run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.out = folder / "out"
        self.source = folder / "cupboard.fake"
        self.source.write_text("cabinet")
        self.recipe = folder / "recipe.toml"
        self.recipe.write_text(RECIPE)

    def plugins(self, *observers: object) -> Plugins:
        plugins = Plugins(installed=False)
        plugins.register(Fakes(), OWNER)
        for observer in observers:
            plugins.register(observer)
        return plugins

    def run(self, *sets: str, observers: tuple[object, ...] = (), out: Path | None = None) -> Result:
        return convert(
            self.source,
            self.recipe,
            out=out or self.out,
            sets=sets,
            record=False,
            plugins=self.plugins(*observers),
        )

    def export(self, exporter: str = "fake_text"):
        return export_folder(self.out, exporter, self.plugins())


def contents(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
