"""The hooks a plugin may implement. `docs/plugins.md` documents each one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import pluggy

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .findings import Finding
    from .mesh import Mesh
    from .report import Report
    from .runner import Run
    from .stages import Check, Exporter, JointPredictor, Modifier, Segmentation, Segmenter

hookspec = pluggy.HookspecMarker("simart_kit")
hookimpl = pluggy.HookimplMarker("simart_kit")


class Register(Protocol):
    """What a `register_*` hook is called with: pass it a stage class."""

    def __call__(self, stage: type[Segmenter | JointPredictor | Modifier | Exporter | Check], /) -> None: ...


class RegisterRecipe(Protocol):
    """What `register_recipes` is called with: a recipe's name and its TOML file."""

    def __call__(self, name: str, path: Path, /) -> None: ...


class RegisterCommand(Protocol):
    """What `register_commands` is called with.

    Takes the command's name ("tokens", or "train vqvae" for one in a group), where its function is
    ("package.module:function"), a line on what it does, and an extra of simart-kit that it needs, such as
    "torch": who lacks it is told so when the command is used.
    """

    def __call__(self, name: str, target: str, help: str, extra: str = "") -> None: ...


@hookspec
def register_segmenters(register: Register) -> None:
    """Register Segmenter classes: `register(MySegmenter)`."""


@hookspec
def register_joint_predictors(register: Register) -> None:
    """Register JointPredictor classes."""


@hookspec
def register_modifiers(register: Register) -> None:
    """Register Modifier classes."""


@hookspec
def register_exporters(register: Register) -> None:
    """Register Exporter classes."""


@hookspec
def register_checks(register: Register) -> None:
    """Register Check classes."""


@hookspec
def register_recipes(register: RegisterRecipe) -> None:
    """Register recipe files that the plugin ships: `register("mine", path)`."""


@hookspec
def register_commands(register: RegisterCommand) -> None:
    """Register commands: `register("train mine", "package.module:function", "Train mine.")`.

    The function's module is imported when the command is used, and not before.
    """


@hookspec
def diagnose() -> Iterable[Finding] | None:
    """Tell `simart-kit doctor` what this plugin needs and whether it is there; import nothing heavy."""


@hookspec(firstresult=True)
def load_mesh(path: Path) -> Mesh | Segmentation | None:
    """Read a file into a Mesh in the file's own frame; None when the format is not yours.

    A file that states its parts and joints, as a robot description does, is read into a Segmentation with
    `mesh` and `joints`, both in the file's own frame: these are taken, whatever segmenter the recipe names.

    Raise BadInputError when the format is yours and the file is broken.
    """


@hookspec
def run_started(run: Run) -> None:
    """A run begins; nothing has been read yet."""


@hookspec
def stage_finished(run: Run, stage: str, name: str, value: object, seconds: float) -> None:
    """A stage returned `value`; `stage` is load, segment, spec, joints, modify, check, preview or export."""


@hookspec
def run_failed(run: Run, stage: str, error: BaseException) -> None:
    """A stage raised; the files in `run.folder` are kept for the user."""


@hookspec
def run_finished(run: Run, report: Report) -> None:
    """All stages are done; files written to `run.folder` become part of the output."""
