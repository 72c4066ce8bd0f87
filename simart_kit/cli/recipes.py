"""`simart-kit recipes list | show | check`."""

from __future__ import annotations

from typing import Annotated

import typer

from .common import help_when_alone, load_plugins, print_rows
from .options import PluginFiles, Sets, Verbose

app = typer.Typer(help="List, show and check recipes.", rich_markup_mode=None)
app.callback(invoke_without_command=True)(help_when_alone)
Source = Annotated[str, typer.Argument(metavar="NAME|FILE", help="Recipe.")]


@app.command("list")
def list_recipes(plugin: PluginFiles = None, verbose: Verbose = False) -> None:
    """The names that `convert --recipe` knows."""
    from ..errors import SimartKitError
    from ..recipe import load_recipe
    from ..recipe_files import known_recipes

    plugins = load_plugins(plugin)
    rows = []
    for name in sorted(known_recipes(plugins)):
        try:
            rows.append((name, load_recipe(name, plugins).description))
        except SimartKitError as error:
            rows.append((name, f"FAILED: {error}"))
    print_rows(rows)


@app.command()
def show(source: Source, sets: Sets = None, plugin: PluginFiles = None, verbose: Verbose = False) -> None:
    """Show a recipe as TOML.

    Its parents and all options are spelled out.
    """
    from ..recipe import load_recipe
    from ..toml_text import recipe_text

    print(recipe_text(load_recipe(source, load_plugins(plugin), sets or ())), end="")


@app.command()
def check(source: Source, sets: Sets = None, plugin: PluginFiles = None, verbose: Verbose = False) -> None:
    """Check a recipe.

    Every mistake is told at once; the exit code is then 2.
    """
    from ..recipe import load_recipe

    recipe = load_recipe(source, load_plugins(plugin), sets or ())
    stages = (recipe.segmenter, recipe.joints, *recipe.modify, *recipe.export)
    print(f"ok: {source}: {' > '.join(use.use for use in stages)}")
