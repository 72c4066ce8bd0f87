"""All commands together."""

from __future__ import annotations

from typing import Annotated

import typer

from . import bench, plugins, recipes
from .check import check
from .common import help_when_alone
from .convert import convert
from .doctor import doctor
from .export import export
from .ground import ground
from .inspect import inspect
from .plugin_commands import PluginGroup
from .spec import spec
from .version import print_version, version

EPILOG = (
    "Exit codes: 0 done; 1 a conversion or a check failed; 2 bad input or usage; "
    "130 interrupted; 141 the reader of the output went away."
)

app = typer.Typer(
    name="simart-kit",
    cls=PluginGroup,
    help="Turn a static 3D mesh into a simulation-ready articulated asset: URDF, MJCF and USD.",
    epilog=EPILOG,
    # Rich help takes longer to load than all the rest of the command line.
    rich_markup_mode=None,
    add_completion=False,
)
for command in (convert, spec, ground, export, check, inspect, doctor, version):
    app.command(epilog=EPILOG)(command)
app.add_typer(bench.app, name="bench")
app.add_typer(recipes.app, name="recipes")
app.add_typer(plugins.app, name="plugins")


@app.callback(invoke_without_command=True)
def start(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=print_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Turn a static 3D mesh into a simulation-ready articulated asset: URDF, MJCF and USD."""
    help_when_alone(context)
