"""`simart-kit plugins list | show`."""

from __future__ import annotations

import inspect
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .common import help_when_alone, print_json, print_rows, stdout_kept
from .options import Json, PluginFiles, Verbose

if TYPE_CHECKING:
    from ..plugins import Plugins, Registration

app = typer.Typer(help="List and show plugins.", rich_markup_mode=None)
app.callback(invoke_without_command=True)(help_when_alone)


@app.command("list")
def list_plugins(
    plugin: PluginFiles = None,
    json: Json = False,
    check: Annotated[
        bool, typer.Option("--check", help="Exit code 1 if a plugin failed to load or a name is taken twice.")
    ] = False,
    verbose: Verbose = False,
) -> None:
    """All stages, commands, loaders and observers.

    Each with the plugin that it comes from; and what did not load.
    """
    from ..plugins import Plugins

    with stdout_kept(json):
        plugins = Plugins(files=plugin or ())
    if json:
        print_json(_document(plugins))
    else:
        _print(plugins, verbose)
    if check and (plugins.failures or plugins.conflicts()):
        raise typer.Exit(1)


@app.command()
def show(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of a stage or command, such as usd.")],
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """What a stage does, and its options with type, default and meaning.

    Of a command, what it does; its options are in its own help.
    """
    from ..errors import UnknownPluginError
    from ..extras import install_command
    from ..plugins import Plugins

    with stdout_kept(json):
        plugins = Plugins(files=plugin or ())
    known = [r for r in plugins.registrations() if r.kind != "recipe"]
    found = [r for r in known if r.name == name]
    if not found:
        raise UnknownPluginError(
            "stage or command", name, {r.name for r in known}, map(str, plugins.failures)
        )
    if json:
        print_json([_row(registration) | _details(registration) for registration in found])
        return
    for registration in found:
        print(f"{registration.kind} {registration.name}, from {registration.owner}\n")
        if registration.kind == "command":
            needs = registration.value.extra
            print(registration.value.help + (f" It needs `{install_command(needs)}`." if needs else ""))
            print(f"\n  simart-kit {name} --help")
        else:
            _print_stage(registration)


def _print_stage(registration: Registration) -> None:
    print(inspect.getdoc(registration.value) or "", end="\n\n")
    options = [tuple(row.values()) for row in _options(registration)]
    print_rows([("option", "type", "default", "meaning"), *options] if options else [("no options",)], "  ")


def _print(plugins: Plugins, verbose: bool) -> None:
    rows = [(r.kind, r.name, str(r.owner)) for r in plugins.registrations()]
    rows += [
        ("hooks", ", ".join(hooks), str(owner))
        for owner, names in plugins.hooks()
        if (hooks := [name for name in names if not name.startswith("register_")])
    ]
    print_rows(rows)
    for group in plugins.conflicts():
        owners = " and by ".join(str(r.owner) for r in group)
        print(f"CONFLICT  {group[0].kind} '{group[0].name}' is registered by {owners}")
    for failure in plugins.failures:
        print(f"FAILED  {failure}")
        if verbose:
            print(failure.trace)


def _document(plugins: Plugins) -> dict[str, Any]:
    return {
        "ok": not (plugins.failures or plugins.conflicts()),
        "stages": [_row(r) for r in plugins.registrations()],
        "hooks": [{**vars(owner), "hooks": list(names)} for owner, names in plugins.hooks()],
        "failures": [{**vars(f.owner), "phase": f.phase, "error": f.error} for f in plugins.failures],
        "conflicts": [[_row(r) for r in group] for group in plugins.conflicts()],
    }


def _row(registration: Registration) -> dict[str, str]:
    return {"kind": registration.kind, "name": registration.name, **vars(registration.owner)}


def _details(registration: Registration) -> dict[str, Any]:
    if registration.kind == "command":
        return asdict(registration.value)
    return {"options": _options(registration)}


def _options(registration: Registration) -> list[dict[str, str]]:
    from ..describe import field_rows

    return [vars(row) for row in field_rows(registration.value.Options)]
