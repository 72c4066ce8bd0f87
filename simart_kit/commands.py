"""Commands that plugins add to the command line: which names are free, and where their functions are."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .extras import EXTRAS

# Groups that take commands of plugins. Those that are not the core's own exist once a command is in them.
GROUPS = {
    "bench": "Score articulation against ground truth.",
    "dataset": "Make data to train models on.",
    "model": "Import and inspect model weights.",
    "train": "Train a model.",
}
# Names of the command line itself, which a plugin cannot have: it would stand in the way of the tool.
CORE_NAMES = frozenset(
    {
        *(
            "convert",
            "spec",
            "ground",
            "export",
            "check",
            "inspect",
            "doctor",
            "version",
            "recipes",
            "plugins",
        ),
        *GROUPS,
        *(f"bench {name}" for name in ("run", "score", "compare", "report", "import", "grounding")),
    }
)
_WORD = r"[a-z][a-z0-9]*(-[a-z0-9]+)*"


@dataclass(frozen=True)
class PluginCommand:
    """A command that has not been imported.

    Attributes:
        target: "package.module:function"; the function is annotated as typer reads it.
        help: a line for lists of commands.
        extra: of simart-kit, without which it is refused, such as "torch"; "" for none.
    """

    target: str
    help: str
    extra: str = ""

    def __post_init__(self) -> None:
        if not re.fullmatch(r"[\w.]+:\w+", self.target):
            raise ValueError(f"'{self.target}' is not of the form package.module:function")
        if not self.help or "\n" in self.help:
            raise ValueError(f"the help of {self.target} is not one line")
        if self.extra and self.extra not in EXTRAS:
            raise ValueError(f"{self.target} needs extra '{self.extra}': there are {', '.join(EXTRAS)}")

    def load(self) -> Callable[..., Any]:
        """Import the function; raises whatever its module raises, and AttributeError if it has none."""
        module, _, function = self.target.partition(":")
        loaded: Callable[..., Any] = getattr(importlib.import_module(module), function)
        return loaded


def checked_name(name: str, plugin: str) -> str:
    """The name, if a command of a plugin can have it: "tokens", or "train vqvae" in a group.

    Raises:
        ValueError: it is malformed, in a group that takes no commands, or the name of a core command.
    """
    if name in CORE_NAMES:
        raise ValueError(f"command '{name}' is registered by simart_kit (built in) and by {plugin}")
    if not re.fullmatch(rf"{_WORD}( {_WORD})?", name):
        raise ValueError(f"command name '{name}' is not one or two words of a-z, 0-9 and -")
    group, _, inside = name.partition(" ")
    if inside and group not in GROUPS:
        raise ValueError(f"command '{name}' is in no group that takes commands: {', '.join(GROUPS)}")
    return name
