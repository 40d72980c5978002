"""From what a person says (an emotion word, a file, a recipe, a few steps) to an edited motion."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from ..edits import pipeline
from ..errors import RecipeError, unknown
from ..motion import Motion
from ..recipe import Recipe, Step
from . import files

What = str | Path | Recipe | Iterable[Step]


def resolve(what: What) -> Recipe:
    """Return the recipe that is meant: an emotion word, a recipe file, a recipe or a list of steps.

    Raises ``RecipeError`` with the nearest emotion word when nothing of that name is known, or when
    ``what`` is none of these.
    """
    if isinstance(what, Recipe):
        return what
    if isinstance(what, Path) or (isinstance(what, str) and Path(what).suffix.lower() in files.SUFFIXES):
        return files.read_recipe(what)
    if isinstance(what, str):
        from .presets import PRESETS, preset

        if what not in PRESETS:
            raise RecipeError(unknown("emotion", what, PRESETS) + "; or give a recipe file (.toml or .json)")
        return preset(what)
    steps = tuple(what) if isinstance(what, Iterable) else (what,)
    if not all(isinstance(step, Step) for step in steps):
        raise RecipeError(
            f"give an emotion word, a recipe file, a Recipe or a list of Steps, not {what!r:.80}"
        )
    return Recipe(name="steps", steps=steps)


def edit(
    motion: Motion,
    what: What,
    *,
    strength: float = 1.0,
    parts: str | Sequence[str] = (),
    span: tuple[float, float] | None = None,
) -> Motion:
    """Return ``motion`` edited by an emotion word, a recipe file, a recipe or a list of steps.

    ``strength`` from 0 (nothing) over 1 (as written) to 2 multiplies every step's own; ``parts``
    (``"arms"`` or ``("head", "arms")``) and ``span`` (start and end in seconds) limit what is changed;
    the feet are put back over the whole clip. Raises ``RecipeError`` for what is unknown or out of range.
    """
    chosen = (parts,) if isinstance(parts, str) else tuple(parts)
    return pipeline.apply(motion, resolve(what), strength=strength, parts=chosen, span=span)
