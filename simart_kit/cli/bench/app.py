"""All commands of `simart-kit bench` together."""

from __future__ import annotations

import typer

from ...commands import GROUPS
from ..common import help_when_alone
from ..plugin_commands import PluginGroup
from .compare import compare
from .grounding import grounding
from .importing import import_objects
from .report import report
from .run import run
from .score import score

app = typer.Typer(cls=PluginGroup, help=GROUPS["bench"], rich_markup_mode=None)
app.callback(invoke_without_command=True)(help_when_alone)
for command in (run, score, compare, report, grounding):
    app.command()(command)
app.command("import")(import_objects)
