"""Commands of plugins in the command line: looked for when a name is not the core's, imported when used."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command, get_group

from ..commands import GROUPS
from ..errors import PluginError
from ..extras import require_extra
from .common import help_when_alone, stdout_kept

if TYPE_CHECKING:
    from ..plugins import Plugins, Registration


class PluginGroup(TyperGroup):
    """A group that plugins may add to: the whole command line, `bench`, `train` or `model`.

    The core's own commands never load a plugin. Everything else does, once a command line.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        """The core's commands, then those of plugins."""
        self._complete(ctx)
        return super().list_commands(ctx)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """A command by its name, or None."""
        if cmd_name not in self.commands:
            self._complete(ctx)
        return super().get_command(ctx, cmd_name)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """The command that the arguments begin with; of an unknown one, also which plugins did not load."""
        try:
            return super().resolve_command(ctx, args)
        except typer.TyperException as error:
            failures = _plugins(ctx).failures
            if failures:
                told = "; ".join(map(str, failures))
                error.message += f" {len(failures)} plugin(s) failed to load: {told}"
            raise

    def _complete(self, ctx: Any) -> None:
        """Add what plugins registered for this group."""
        place = "" if ctx.parent is None else f"{self.name} "
        registrations = _plugins(ctx).registrations("command")
        owners = Counter(r.name for r in registrations)
        for registration in registrations:
            group, _, inside = registration.name.rpartition(" ")
            if not place and group and group not in self.commands:
                self.add_command(_group(group))
            elif registration.name == place + inside:
                self.add_command(PluginEntry(registration, owners[registration.name], self.epilog))


class PluginEntry(TyperCommand):
    """A command of a plugin as lists show it; used, it gives way to the real one.

    Args:
        registration: of the command; the first of several with its name.
        owners: how many plugins registered the name.
        epilog: of its group, ends its help.
    """

    def __init__(self, registration: Registration, owners: int, epilog: str | None) -> None:
        name = registration.name.rpartition(" ")[2]
        short = (
            registration.value.help if owners == 1 else f"Registered by {owners} plugins: see `plugins list`."
        )
        super().__init__(name, help=short, short_help=short, epilog=epilog, rich_markup_mode=None)
        self._full_name = registration.name

    def make_context(self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any) -> Any:
        """Import the command and have it parse its arguments.

        Raises:
            AmbiguousPluginError: several plugins registered its name.
            BadInputError: it needs an extra that is not there.
            PluginError: it cannot be imported, or is not annotated as typer needs it.
        """
        flags = parent.obj
        registration = _plugins(parent).find("command", self._full_name)
        # -v is parsed by the real command: too late for an error in its import.
        flags.verbose = "-v" in args or "--verbose" in args
        command = self._imported(registration)
        flags.verbose, flags.owner = False, registration.owner
        context = command.make_context(info_name, args, parent=parent, **extra)
        if registration.value.extra:
            require_extra(registration.value.extra, f"command '{registration.name}'")
        return context

    def _imported(self, registration: Registration) -> Any:
        single = typer.Typer(add_completion=False, rich_markup_mode=None)
        try:
            with stdout_kept(True):
                function = registration.value.load()
            single.command(self.name, epilog=self.epilog)(function)
            return get_command(single)
        except (Exception, SystemExit) as error:
            raise PluginError(
                f"command '{registration.name}' of plugin {registration.owner} cannot be imported from "
                f"{registration.value.target}: {type(error).__name__}: {error}"
            ) from error


def _group(name: str) -> TyperGroup:
    app = typer.Typer(name=name, cls=PluginGroup, help=GROUPS[name], rich_markup_mode=None)
    app.callback(invoke_without_command=True)(help_when_alone)
    return get_group(app)


def _plugins(ctx: Any) -> Plugins:
    """The plugins that may have commands, loaded once a command line."""
    from ..plugins import Plugins

    if ctx.obj.plugins is None:
        with stdout_kept(True):
            ctx.obj.plugins = Plugins(commands_only=True)
    plugins: Plugins = ctx.obj.plugins
    return plugins
