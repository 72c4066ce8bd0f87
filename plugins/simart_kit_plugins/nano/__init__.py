"""simart-nano: the small model that is shipped, and the objects it learns from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.hookspecs import hookimpl

if TYPE_CHECKING:
    from simart_kit.findings import Finding
    from simart_kit.hookspecs import Register, RegisterCommand

_COMMANDS = "simart_kit_plugins.nano.commands"


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `nano`."""
    from .segmenter import Nano

    register(Nano)


@hookimpl
def register_commands(register: RegisterCommand) -> None:
    """Register `generate`, `train nano` and `bench oracle`."""
    register("generate", f"{_COMMANDS}.generate:generate", "Write made-up articulated objects.")
    register(
        "train nano",
        f"{_COMMANDS}.train_nano:train_nano",
        "Train the small model of parts and joints.",
        "torch",
    )
    register("bench oracle", f"{_COMMANDS}.oracle:oracle", "Tell where nano loses parts and joints.")


@hookimpl
def diagnose() -> list[Finding]:
    """The libraries that the network needs, and its weights."""
    from .diagnosis import findings

    return findings()
