"""Recipe files, and the file beside an edited clip that says how it was made.

What is in them, ``recipe_text`` says. A file may carry a ``[provenance]`` table (what made a clip); it is not
part of the recipe.
"""

from pathlib import Path
from typing import Any

from ..errors import RecipeError
from ..formats import FORMATS
from ..recipe import Recipe
from . import recipe_text
from .presets import preset
from .recipe_text import Kind, decode, format_recipe, require

SUFFIXES = (".toml", ".json")
SIDECAR = ".recipe.toml"  # what the file beside an edited clip is called, after the clip's own name


def read_recipe(path: str | Path) -> Recipe:
    """Return the recipe in a TOML or JSON file.

    Raises ``RecipeError`` naming the file, the step by number, what does not fit and what would.
    """
    path = Path(path)
    return parse_recipe(_text(path), kind=_kind(path), where=str(path))


def read_provenance(path: str | Path) -> dict[str, Any]:
    """Return the ``[provenance]`` table of a recipe file: what made a clip. Empty where there is none."""
    path = Path(path)
    where = str(path)
    return dict(
        require(where, "provenance", decode(_text(path), _kind(path), where).get("provenance", {}), dict)
    )


def sidecar_of(clip: Path) -> Path:
    """Return the file that says how ``clip`` was made; it is a recipe, and replays to the same clip."""
    return clip.with_name(clip.name + SIDECAR)


def write_recipe(recipe: Recipe, path: str | Path) -> None:
    """Write a recipe as TOML, or as JSON when the file name ends in ``.json``."""
    path = Path(path)
    path.write_text(format_recipe(recipe, kind=_kind(path)), encoding="utf-8", newline="\n")


def parse_recipe(text: str, *, kind: Kind = "toml", where: str = "recipe") -> Recipe:
    """Return the recipe written in ``text``, with the presets as the emotions that steps may name.

    ``where`` names its place in error messages.
    """
    return recipe_text.parse(text, kind=kind, where=where, words=preset)


def _text(path: Path) -> str:
    if path.suffix.lower() in FORMATS:
        its = sidecar_of(path)
        hint = f"its recipe is {its}" if its.exists() else "a recipe is a .toml or .json file"
        raise RecipeError(f"{path}: is a clip; {hint}")
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise RecipeError(f"{path}: there is no such file") from None
    except OSError as error:
        raise RecipeError(f"{path}: cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise RecipeError(f"{path}: is not text (a recipe file is TOML or JSON in UTF-8)") from None


def _kind(path: Path) -> Kind:
    return "json" if path.suffix.lower() == ".json" else "toml"
