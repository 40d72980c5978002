"""What ``mien edit`` is asked to do, checked before a single clip is read."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..curve import Varying, read_varying, values
from ..edits import pipeline
from ..edits.registry import EDITS
from ..emotion.mix import mixed
from ..emotion.resolve import resolve
from ..errors import MienError, RecipeError, unknown
from ..kinematics.body import PARTS, ROLES
from ..recipe import Recipe
from .flags import compose
from .inputs import existing
from .report import note


def recipe_of(
    emotions: list[str] | None,
    path: Path | None,
    flags: Mapping[str, Mapping[str, Any]],
    foot_plant: bool | None,
    goal: str,
) -> Recipe:
    """Return the steps to do, from one of emotions, a file and flags; ``goal`` names where clips go.

    Raises ``MienError`` where they say nothing, contradict each other, or a step cannot be done.
    """
    if emotions and path:
        raise MienError("give --emotion or --recipe, not both")
    if goal and (emotions or path):
        raise MienError("give an emotion, a recipe or a place or example to move to, one of them")
    if not (emotions or path or flags or goal):
        raise MienError(
            "say what to change: --emotion, --to, --recipe or a flag of an edit "
            "(mien presets lists emotions, mien edit --help all flags, --repair-what floor mends a clip)"
        )
    recipe = _emotions(emotions) if emotions else resolve(existing(path)) if path else Recipe("edited", ())
    if goal:
        return Recipe(goal, compose((), flags, foot_plant=foot_plant), safe=True)
    if foot_plant is None and not path:
        foot_plant = True
    steps = compose(recipe.steps, flags, foot_plant=foot_plant)
    for step in steps:
        pipeline.check(step)
    kinds = {EDITS[step.edit].kind for step in steps}
    if path and foot_plant is None and "pose" in kinds and "repair" not in kinds:
        note(f"mien: note: {path} puts no feet back on the floor; --foot-plant adds that step")
    return replace(recipe, steps=steps)


def _emotions(given: list[str]) -> Recipe:
    """Return the recipe of emotion words; of several, or with strengths (``sad=0:1,5:0``), all in one."""
    if len(given) == 1 and "=" not in given[0]:
        return resolve(given[0])
    pairs = [(word.strip(), strength) for word, _, strength in (item.partition("=") for item in given)]
    if len(dict(pairs)) < len(pairs):
        raise MienError(f"--emotion: {' and '.join(word for word, _ in pairs)}: give each emotion once")
    return mixed({word: strength or 1.0 for word, strength in pairs})


def eased(recipe: Recipe, ease: float | None, limited: bool) -> Recipe:
    """Return the recipe with another ease of its pose edits; ``limited`` says that a span is given."""
    if ease is None:
        return recipe
    if not (limited or any(step.span for step in recipe.steps)):
        raise MienError("--ease is how long the ends of a span take to set in: give --span too")
    steps = [replace(s, ease=ease) if EDITS[s.edit].kind in ("pose", "rhythm") else s for s in recipe.steps]
    return replace(recipe, steps=tuple(pipeline.check(step) for step in steps))


def strength_of(text: str) -> Varying:
    """Return what --strength says; raise ``MienError`` for anything but numbers from 0 to 2."""
    strength = read_varying("--strength", text)
    for value in values(strength):
        if not 0.0 <= value <= 2.0:
            raise MienError(f"--strength must be from 0 to 2, got {value:g}")
    return strength


def parts_of(text: str) -> tuple[str, ...]:
    """Return what --parts says; raise ``RecipeError`` for what is neither a part nor a role."""
    parts = tuple(part.strip() for part in text.split(",") if part.strip())
    for part in parts:
        if part not in (*PARTS, *ROLES):
            raise RecipeError("--parts: " + unknown("body part or role", part, [*PARTS, *ROLES]))
    return parts


def span_of(text: str) -> tuple[float, float] | None:
    """Return what --span says, in seconds; raise ``MienError`` unless it is two times in order."""
    if not text:
        return None
    try:
        start, end = (float(time) for time in text.split(","))
    except ValueError:
        raise MienError(f"--span needs two times in seconds, e.g. 1.0,3.5, got {text!r}") from None
    if not start < end:
        raise MienError(f"--span must end after it starts, got {text!r}")
    return start, end
