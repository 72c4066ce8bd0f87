"""Every error a user may meet. Each is one line: what, where, what to do next."""

from __future__ import annotations

from collections.abc import Iterable


class SimartKitError(Exception):
    """Base of all errors raised on purpose; `exit_code` is the CLI's exit status."""

    exit_code = 1


class BadInputError(SimartKitError):
    """The source file, an option or an edited asset cannot be used as it is."""

    exit_code = 2


class OutputError(SimartKitError):
    """The output folder cannot be written."""

    exit_code = 2


class RecipeError(SimartKitError):
    """A recipe is missing or wrong; the message lists every mistake found in it."""

    exit_code = 2


class PluginError(SimartKitError):
    """A plugin failed to load and was asked for (or strict mode is on)."""

    exit_code = 2


class UnknownPluginError(PluginError):
    """No plugin of that kind has this name; the message lists those that have one.

    Attributes:
        missing: what is unknown and what is known.
        failed: plugins that failed to load, one of which may be the one; "" when all loaded.
    """

    def __init__(self, kind: str, name: str, known: Iterable[str], failures: Iterable[str] = ()) -> None:
        self.missing = f"unknown {kind} '{name}': known are {', '.join(sorted(known)) or 'none'}"
        failed = list(failures)
        self.failed = f"{len(failed)} plugin(s) failed to load: " + "; ".join(failed) if failed else ""
        super().__init__("; ".join(filter(None, (self.missing, self.failed))))


class AmbiguousPluginError(PluginError):
    """Two plugins registered the same name and that name was used."""

    def __init__(self, kind: str, name: str, owners: Iterable[str]) -> None:
        super().__init__(
            f"{kind} '{name}' is registered by {' and by '.join(owners)}: "
            f"uninstall one, or pick plugins with SIMART_LOAD_PLUGINS"
        )


class StageError(SimartKitError):
    """A stage of a run failed; names the stage, its plugin and the plugin's distribution.

    Attributes:
        kind: stage kind, such as "segmenter".
        name: registered name of the stage.
        plugin: plugin that registered it.
        distribution: name of the installed distribution, or "built in" or a file.
        version: version of that distribution.
    """

    def __init__(
        self, kind: str, name: str, plugin: str, distribution: str, version: str, cause: BaseException
    ) -> None:
        # Set here and not only by `raise ... from`: observers are told of the failure before it is raised.
        self.__cause__ = cause
        self.kind, self.name, self.plugin = kind, name, plugin
        self.distribution, self.version = distribution, version
        reason = str(cause).strip().splitlines()
        text = f"{type(cause).__name__}: {reason[0]}" if reason else type(cause).__name__
        if reason and isinstance(cause, SimartKitError):
            text = reason[0]  # written for the user, who need not know its class
        origin = f"{distribution} {version}".rstrip()
        super().__init__(f"{kind} '{name}' failed (plugin {plugin}, {origin}): {text}")
