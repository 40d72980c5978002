"""Apply steps and recipes to a motion.

Strength moves an edit's parameters from neutral; body parts and time spans blend the edited motion
with the one before, and weigh the strength of an edit of rhythm. Repairs get the reference: the motion before
the first step of its history, also when the steps were applied in several calls.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..curve import Varying, multiply, values
from ..errors import RecipeError, unknown
from ..kinematics.blending import blend
from ..kinematics.body import Body
from ..kinematics.parts import common_parts
from ..motion import Motion
from ..recipe import Recipe, Step
from ..typing import Array, Progress, untold
from .registry import EDITS

MOST = 2.0  # times the strength that a step is written with


def check(step: Step) -> Step:
    """Return the step with every parameter filled in, or raise ``RecipeError``.

    The message names the step, what does not fit, and the nearest thing that would.
    """
    if step.edit not in EDITS:
        raise RecipeError(unknown("edit", step.edit, EDITS))
    _check_strength(f"{step.edit}: strength", step.strength)
    if not step.ease >= 0.0:
        raise RecipeError(f"{step.edit}: ease must be 0 seconds or more, got {step.ease:g}")
    if step.span is not None and not step.span[0] < step.span[1]:
        raise RecipeError(f"{step.edit}: a span must end after it starts, got {step.span}")
    return replace(step, parameters=EDITS[step.edit].complete(step.parameters))


def apply(
    motion: Motion,
    recipe: Recipe | Iterable[Step],
    *,
    strength: Varying = 1.0,
    parts: Sequence[str] = (),
    span: tuple[float, float] | None = None,
    progress: Progress = untold,
) -> Motion:
    """Apply a recipe and return a new motion whose history has one more step for each step done.

    ``strength`` multiplies every step's own (0 returns the motion itself). Of steps that edit the pose
    only what lies within ``parts`` and ``span`` is done; repairs see the whole clip.
    """
    steps = plan(recipe, strength=strength, parts=parts, span=span)
    if span is not None and not (span[1] >= 0.0 and span[0] <= motion.duration and span[0] < span[1]):
        raise RecipeError(
            f"the span from {span[0]:g} to {span[1]:g} s holds nothing of the clip, which lasts "
            f"{motion.duration:g} s"
        )
    for number, step in enumerate(steps):
        progress(step.edit, number / len(steps))
        motion = _apply_step(motion, step)
    return motion


def plan(
    recipe: Recipe | Iterable[Step],
    *,
    strength: Varying = 1.0,
    parts: Sequence[str] = (),
    span: tuple[float, float] | None = None,
) -> list[Step]:
    """Return the steps that ``apply`` does, each complete and as it is done; without those that do nothing.

    Raises ``RecipeError`` for what is unknown or out of range.
    """
    _check_strength("strength", strength)
    steps = [check(s) for s in (recipe.steps if isinstance(recipe, Recipe) else recipe)]
    if not any(values(strength)):
        return []
    limited = (_limited(step, strength, tuple(parts), span) for step in steps)
    return [step for step in limited if step is not None and any(values(step.strength))]


def _check_strength(what: str, strength: Varying) -> None:
    for value in values(strength):
        if not 0.0 <= value <= MOST:
            raise RecipeError(f"{what} must be from 0 to 2, got {value:g}")


def _limited(
    step: Step, strength: Varying, parts: tuple[str, ...], span: tuple[float, float] | None
) -> Step | None:
    """Return the step as it is to be done, or None where nothing of it is left.

    When things happen is a matter of the whole body: of some parts only, the rhythm is left as it is.
    """
    kind = EDITS[step.edit].kind
    if kind in ("time", "repair"):
        return replace(step, parts=(), span=None)
    both = common_parts(step.parts, parts)
    if kind == "rhythm" and both:
        return None
    start, end = step.span or span or (0.0, 1.0)
    if step.span and span:
        start, end = max(step.span[0], span[0]), min(step.span[1], span[1])
    if both is None or start >= end:
        return None
    limits = (start, end) if step.span or span else None
    return replace(step, strength=multiply(step.strength, strength, most=MOST), parts=both, span=limits)


def _apply_step(motion: Motion, step: Step) -> Motion:
    edit = EDITS[step.edit]
    if edit.kind == "rhythm":
        within = _shown(motion, step) if step.span else None
        after = edit.perform(motion, step.parameters, strength=step.strength, within=within)
        return after.with_(history=(*motion.history, step))
    joints = Body.of(motion).joints(step.parts) if step.parts else None
    after = edit.perform(motion, step.parameters, strength=step.strength, joints=joints)
    if step.parts or step.span:
        wanted = np.zeros(len(motion.skeleton))
        wanted[slice(None) if joints is None else joints] = 1.0
        after = blend(motion, after, _shown(motion, step)[:, None] * wanted)
    return after.with_(history=(*motion.history, step))


def _shown(motion: Motion, step: Step) -> Array:
    """Return how much of the edit shows in each frame (T,): its span with the eases."""
    if step.span is None:
        return np.ones(len(motion))
    start, end = step.span
    ease = min(step.ease, 0.5 * (end - start))
    slack = 1e-6 * motion.frame_time  # frames on the border are inside: 3 * 0.1 s is above 0.3 s
    into = np.clip((motion.times - start) / ease, 0, 1) if ease else motion.times >= start - slack
    out = np.clip((end - motion.times) / ease, 0, 1) if ease else motion.times <= end + slack
    shown = np.minimum(into, out)
    return shown * shown * shown * (shown * (6 * shown - 15) + 10)  # no jump in speed or acceleration
