"""Apply steps and recipes to a motion.

Strength moves an edit's parameters from neutral; body parts and time spans blend the edited motion
with the one before. Repairs get the reference: the motion before the first step of its history, also
when the steps were applied in several calls.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..errors import RecipeError, unknown
from ..kinematics.body import Body
from ..motion import Motion
from ..recipe import Recipe, Step
from ..rotations import quaternion
from ..typing import Array
from .registry import EDITS


def check(step: Step) -> Step:
    """Return the step with every parameter filled in, or raise ``RecipeError``.

    The message names the step, what does not fit, and the nearest thing that would.
    """
    if step.edit not in EDITS:
        raise RecipeError(unknown("edit", step.edit, EDITS))
    if not 0.0 <= step.strength <= 2.0:
        raise RecipeError(f"{step.edit}: strength must be from 0 to 2, got {step.strength:g}")
    if not step.ease >= 0.0:
        raise RecipeError(f"{step.edit}: ease must be 0 seconds or more, got {step.ease:g}")
    if step.span is not None and not step.span[0] < step.span[1]:
        raise RecipeError(f"{step.edit}: a span must end after it starts, got {step.span}")
    return replace(step, parameters=EDITS[step.edit].complete(step.parameters))


def apply(
    motion: Motion,
    recipe: Recipe | Iterable[Step],
    *,
    strength: float = 1.0,
    parts: Sequence[str] = (),
    span: tuple[float, float] | None = None,
) -> Motion:
    """Apply a recipe and return a new motion whose history has one more step for each step done.

    ``strength`` multiplies every step's own (0 returns the motion itself); ``parts`` and ``span``
    limit the steps that name none.
    """
    if not 0.0 <= strength <= 2.0:
        raise RecipeError(f"strength must be from 0 to 2, got {strength:g}")
    steps = [check(s) for s in (recipe.steps if isinstance(recipe, Recipe) else recipe)]
    if strength == 0.0:
        return motion
    for step in steps:
        pose = EDITS[step.edit].kind == "pose"
        step = replace(
            step,
            strength=min(step.strength * strength, 2.0) if pose else step.strength,
            parts=step.parts or tuple(parts) if pose else (),
            span=step.span or span if pose else None,
        )
        motion = _apply_step(motion, step)
    return motion


def _apply_step(motion: Motion, step: Step) -> Motion:
    if step.strength == 0.0:
        return motion
    edit = EDITS[step.edit]
    after = edit.perform(motion, edit.scaled(step.parameters, step.strength))
    if step.parts or step.span:
        after = _blend(motion, after, _weights(motion, step))
    return after.with_(history=(*motion.history, step))


def _weights(motion: Motion, step: Step) -> Array:
    """Return how much of the edit shows (T, J): the body parts times the span with its eases."""
    joints = np.zeros(len(motion.skeleton))
    joints[Body.of(motion).joints(step.parts) if step.parts else slice(None)] = 1.0
    if step.span is None:
        return np.broadcast_to(joints, (len(motion), len(joints)))
    start, end = step.span
    ease = min(step.ease, 0.5 * (end - start))
    into = np.clip((motion.times - start) / ease, 0, 1) if ease else motion.times >= start
    out = np.clip((end - motion.times) / ease, 0, 1) if ease else motion.times <= end
    shown = np.minimum(into, out)
    shown = shown * shown * shown * (shown * (6 * shown - 15) + 10)  # no jump in speed or acceleration
    return shown[:, None] * joints


def _blend(before: Motion, after: Motion, weights: Array) -> Motion:
    """Blend joint by joint; weight 0 gives the numbers of ``before`` and 1 those of ``after``, exactly."""
    rotations, translations = np.array(before.rotations), np.array(before.translations)
    whole, part = weights >= 1.0, (weights > 0.0) & (weights < 1.0)
    rotations[whole], translations[whole] = after.rotations[whole], after.translations[whole]
    w = weights[part]
    rotations[part] = quaternion.slerp(before.rotations[part], after.rotations[part], w)
    translations[part] += w[:, None] * (after.translations[part] - before.translations[part])
    return after.with_(rotations=quaternion.continuous(rotations), translations=translations)
