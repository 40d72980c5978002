"""From what a person says (an emotion word, a file, a recipe, a few steps) to an edited motion."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from ..curve import Varying, read_varying
from ..edits import pipeline
from ..errors import RecipeError, unknown
from ..kinematics.body import PARTS, ROLES
from ..motion import Motion, require_motion
from ..recipe import Recipe, Step, read_parts, read_span
from ..typing import Progress, share_of, untold
from . import files

Steps = Recipe | Step | Iterable[Step]
What = str | Path | Steps
Strength = Varying | str | Sequence[Sequence[float]]
Parts = str | Sequence[str]
Span = str | tuple[float, float] | None


def resolve(what: What) -> Recipe:
    """Return the recipe that is meant: an emotion word, a recipe file, a recipe, a step or a list of steps.

    Upper and lower case of a word do not matter. Raises ``RecipeError`` with the nearest emotion word
    when nothing of that name is known, or when ``what`` is none of these.
    """
    if isinstance(what, Path) or (isinstance(what, str) and Path(what).suffix.lower() in files.SUFFIXES):
        return files.read_recipe(what)
    if isinstance(what, str):
        from .presets import preset

        try:
            return preset(what)
        except RecipeError as error:
            raise RecipeError(f"{error}; or give a recipe file (.toml or .json)") from None
    return _recipe(what, "an emotion word, a recipe file, ")


def edit(
    motion: Motion,
    what: What,
    *,
    strength: Strength = 1.0,
    parts: Parts = (),
    span: Span = None,
    foot_plant: bool = True,
    safe: bool | None = None,
) -> Motion:
    """Return ``motion`` edited by an emotion word, a recipe file, a recipe or a list of steps.

    ``strength`` from 0 (nothing) over 1 (as written) to 2 multiplies every step's own, and may be a curve of
    ``(seconds, value)`` such as ``[(0, 1), (5, 0)]``; ``parts``
    (``"head,arms"`` or ``("head", "arms")``) and ``span`` (start and end in seconds) limit what is changed;
    the feet are put back over the whole clip, where the recipe does so; not with ``foot_plant=False``.
    ``safe`` checks what was done and mends it where the body would break (``mien.emotion.safe``); None does
    so where the recipe asks for it, as presets do.
    Raises ``MienError`` for what is no motion, ``RecipeError`` for what is unknown or out of range.
    """
    require_motion(motion)
    recipe = resolve(what)
    if not foot_plant:
        recipe = replace(recipe, steps=tuple(step for step in recipe.steps if step.edit != "foot_plant"))
    recipe = recipe if safe is None else replace(recipe, safe=safe)
    return done(motion, recipe, strength=strength, parts=parts, span=span)


def done(
    motion: Motion,
    recipe: Recipe,
    *,
    strength: Strength = 1.0,
    parts: Parts = (),
    span: Span = None,
    progress: Progress = untold,
) -> Motion:
    """Return ``motion`` after a recipe, and safe if it asks for that; arguments as in ``edit``.

    ``progress`` is told each edit, check and round of mending before it begins.
    """
    first = share_of(progress, 0.0, 0.5) if recipe.safe else progress
    after = apply(motion, recipe, strength=strength, parts=parts, span=span, progress=first)
    if not recipe.safe:
        return after
    from .safe import safe

    return safe(after, progress=share_of(progress, 0.5, 1.0))


def apply(
    motion: Motion,
    recipe: Steps,
    *,
    strength: Strength = 1.0,
    parts: Parts = (),
    span: Span = None,
    progress: Progress = untold,
) -> Motion:
    """Return ``motion`` after a recipe, a step or a list of steps; one more step of history for each done.

    Those steps and no others are done: that a recipe asks to be ``safe`` is a matter of ``edit``.

    ``strength``, ``parts``, ``span`` and errors are as in ``edit``. Of steps that edit the pose only what
    lies within ``parts`` and ``span`` is done; repairs see the whole clip.
    """
    require_motion(motion)
    amount = read_varying("strength", strength)
    limits = _known(read_parts(parts))
    times = read_span(span)
    if times and not times[0] < times[1]:
        raise RecipeError(f"span must end after it starts, got {times}")
    return pipeline.apply(
        motion, _recipe(recipe), strength=amount, parts=limits, span=times, progress=progress
    )


def _recipe(steps: Steps, others: str = "") -> Recipe:
    """Return steps as a recipe; ``others`` names what else might have been given."""
    if isinstance(steps, Recipe):
        return steps
    found = (steps,) if isinstance(steps, Step) or not isinstance(steps, Iterable) else tuple(steps)
    if isinstance(steps, str) or not all(isinstance(step, Step) for step in found):
        example = 'mien.Step("posture", {"head": 20})'
        raise RecipeError(f"give {others}a Recipe or Steps such as {example}, not {steps!r:.80}")
    return Recipe(name="steps", steps=found)


def _known(parts: tuple[str, ...]) -> tuple[str, ...]:
    for part in parts:
        if part not in (*PARTS, *ROLES):
            raise RecipeError(unknown("body part or role", part, [*PARTS, *ROLES]))
    return parts
