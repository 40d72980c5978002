"""Several emotions in one recipe, each as strong as is asked: sad that turns into happy, proud and tired."""

from collections.abc import Mapping, Sequence

from ..curve import Varying, read_varying
from ..edits import pipeline
from ..edits.order import merged
from ..errors import RecipeError
from ..recipe import Recipe
from .presets import preset


def mixed(emotions: Mapping[str, Varying | str | Sequence[Sequence[float]]]) -> Recipe:
    """Return the recipe for several emotion words at once, each with a strength, or one that changes.

    Poses are edited first, tempo after them, and the feet put back last and once. Times of curves are those
    of the clip as it comes in, for tempo those of the clip at that step. Raises ``RecipeError`` for a word
    that is not known or a strength that is not from 0 to 2.

    >>> mixed({"sad": [(0, 1), (5, 0)], "happy": [(0, 0), (5, 1)]}).name
    'sad to happy'
    """
    strengths = {word: read_varying(f"strength of {word}", given) for word, given in emotions.items()}
    found = []
    for word, strength in strengths.items():
        try:
            found.append(pipeline.plan(preset(word), strength=strength))
        except RecipeError as error:
            raise RecipeError(f"{word}: {error}") from None
    turning = any(isinstance(strength, tuple) for strength in strengths.values())
    return Recipe((" to " if turning else " and ").join(emotions), merged(found), safe=True)
