"""The recipes that stand for emotion words: mien's own, and the thesis's as ``s0/NAME``.

Each is a file in ``recipes/`` with its evidence and the source of every number. None is learned from
data.
"""

from functools import cache
from importlib.resources import files

from ..errors import RecipeError, unknown
from ..recipe import Recipe
from .recipe_text import parse

OWN = (
    "afraid",
    "angry",
    "childish",
    "confident",
    "energetic-sad",
    "excited",
    "feminine",
    "giant",
    "happy",
    "masculine",
    "musical",
    "nervous",
    "old",
    "proud",
    "relaxed",
    "sad",
    "strong",
    "swaggering",
    "timid",
    "tired",
    "weak",
)
S0 = (
    "afraid",
    "angry",
    "energetic-sad",
    "excited",
    "feminine",
    "happy",
    "masculine",
    "relaxed",
    "sad",
    "strong",
    "tired",
    "weak",
)
PRESETS = (*OWN, *(f"s0/{name}" for name in S0))


def preset(name: str) -> Recipe:
    """Return the recipe of an emotion word such as ``"sad"`` or ``"s0/sad"``, in upper or lower case.

    Raises ``RecipeError`` with the nearest word when there is none of that name.
    """
    word = name.strip().casefold()
    if word not in PRESETS:
        raise no_emotion(name)
    return _read(word)


def no_emotion(name: str) -> RecipeError:
    """Return the error for a word that is none of the presets: the nearest one, and which there are."""
    if name.casefold().startswith("s0/"):
        return RecipeError(unknown("emotion", name, PRESETS[len(OWN) :]))
    return RecipeError(f"{unknown('emotion', name, OWN)}, and s0/NAME for the thesis (mien presets)")


@cache
def _read(name: str) -> Recipe:
    text = files(__package__).joinpath("recipes", f"{name}.toml").read_text(encoding="utf-8")
    return parse(text, where=f"preset {name}")
