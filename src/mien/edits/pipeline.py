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
from ..kinematics.parts import common_parts
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

    ``strength`` multiplies every step's own (0 returns the motion itself). Of steps that edit the pose
    only what lies within ``parts`` and ``span`` is done; repairs see the whole clip.
    """
    steps = plan(recipe, strength=strength, parts=parts, span=span)
    if span is not None and not (span[1] >= 0.0 and span[0] <= motion.duration and span[0] < span[1]):
        raise RecipeError(
            f"the span from {span[0]:g} to {span[1]:g} s holds nothing of the clip, which lasts "
            f"{motion.duration:g} s"
        )
    for step in steps:
        motion = _apply_step(motion, step)
    return motion


def plan(
    recipe: Recipe | Iterable[Step],
    *,
    strength: float = 1.0,
    parts: Sequence[str] = (),
    span: tuple[float, float] | None = None,
) -> list[Step]:
    """Return the steps that ``apply`` does, each complete and as it is done; without those that do nothing.

    Raises ``RecipeError`` for what is unknown or out of range.
    """
    if not 0.0 <= strength <= 2.0:
        raise RecipeError(f"strength must be from 0 to 2, got {strength:g}")
    steps = [check(s) for s in (recipe.steps if isinstance(recipe, Recipe) else recipe)]
    if strength == 0.0:
        return []
    limited = (_limited(step, strength, tuple(parts), span) for step in steps)
    return [step for step in limited if step is not None and step.strength > 0.0]


def _limited(
    step: Step, strength: float, parts: tuple[str, ...], span: tuple[float, float] | None
) -> Step | None:
    """Return the step as it is to be done, or None where nothing of it is left."""
    if EDITS[step.edit].kind != "pose":
        return replace(step, parts=(), span=None)
    both = common_parts(step.parts, parts)
    start, end = step.span or span or (0.0, 1.0)
    if step.span and span:
        start, end = max(step.span[0], span[0]), min(step.span[1], span[1])
    if both is None or start >= end:
        return None
    limits = (start, end) if step.span or span else None
    return replace(step, strength=min(step.strength * strength, 2.0), parts=both, span=limits)


def _apply_step(motion: Motion, step: Step) -> Motion:
    edit = EDITS[step.edit]
    joints = Body.of(motion).joints(step.parts) if step.parts else None
    after = edit.perform(motion, edit.scaled(step.parameters, step.strength), joints=joints)
    if step.parts or step.span:
        after = _blend(motion, after, _weights(motion, step, joints))
    return after.with_(history=(*motion.history, step))


def _weights(motion: Motion, step: Step, wanted: list[int] | None) -> Array:
    """Return how much of the edit shows (T, J): the body parts times the span with its eases."""
    joints = np.zeros(len(motion.skeleton))
    joints[slice(None) if wanted is None else wanted] = 1.0
    if step.span is None:
        return np.broadcast_to(joints, (len(motion), len(joints)))
    start, end = step.span
    ease = min(step.ease, 0.5 * (end - start))
    slack = 1e-6 * motion.frame_time  # frames on the border are inside: 3 * 0.1 s is above 0.3 s
    into = np.clip((motion.times - start) / ease, 0, 1) if ease else motion.times >= start - slack
    out = np.clip((end - motion.times) / ease, 0, 1) if ease else motion.times <= end + slack
    shown = np.minimum(into, out)
    shown = shown * shown * shown * (shown * (6 * shown - 15) + 10)  # no jump in speed or acceleration
    return shown[:, None] * joints


def _blend(before: Motion, after: Motion, weights: Array) -> Motion:
    """Blend joint by joint; weight 0 gives the numbers of ``before`` and 1 those of ``after``, exactly."""
    rotations, translations = np.array(before.rotations), np.array(before.translations)
    for joint in np.flatnonzero(weights.any(axis=0)):
        w = weights[:, joint]
        whole, part = w >= 1.0, (w > 0.0) & (w < 1.0)
        rotations[whole, joint] = after.rotations[whole, joint]
        translations[whole, joint] = after.translations[whole, joint]
        if part.any():
            here, there = before.rotations[part, joint], after.rotations[part, joint]
            rotations[part, joint] = quaternion.slerp(here, there, w[part])
            step = after.translations[part, joint] - before.translations[part, joint]
            translations[part, joint] += w[part, None] * step
    return after.with_(rotations=quaternion.continuous(rotations), translations=translations)
