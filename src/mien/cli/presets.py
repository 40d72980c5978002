"""``mien presets``: the emotions that ship with mien."""

from typing import Annotated

import typer

from . import arguments as a
from .report import show_json, show_table


def presets(
    name: Annotated[
        str | None, typer.Argument(help="An emotion word: print its recipe file.", show_default=False)
    ] = None,
    as_json: a.Json = False,
) -> None:
    """List the emotions, or print one as a recipe file to copy and change.

    mien presets sad > mine.toml
    """
    from ..emotion.presets import PRESETS, preset
    from ..emotion.recipe_text import format_recipe
    from ..emotion.resolve import resolve

    if name:
        typer.echo(format_recipe(resolve(name), kind="json" if as_json else "toml"), nl=False)
        return
    recipes = [(word, preset(word)) for word in PRESETS]
    if as_json:
        show_json([{"name": w, "description": r.description, "evidence": r.evidence} for w, r in recipes])
        return
    rows = [(word, recipe.description, recipe.evidence) for word, recipe in recipes]
    show_table(("emotion", "what it does", "evidence"), rows, numbers=3)
    typer.echo("\ns0/NAME: as in K. Förger's thesis (2011)")
