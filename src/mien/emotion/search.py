"""Search how much of a recipe one clip needs, so that the change can be seen on it.

What a recipe changes depends on the clip: an arm that is raised moves less when it is turned, hands that hang
at the hips cannot come closer, steps on the spot cannot get much shorter. The same numbers are a clear change
on one clip and hardly any on another. So the change is measured on the clip itself (``analysis.visible``) and
the strength of the steps is moved, between bounds, until the change is as large as that of acted takes:
secant steps of ``|change(c)| = clear``. The answer is the same recipe with other strengths, to be tuned by
hand.

The size of acted changes is the one number that was looked up in clips; the recipe itself, and so the
direction of the change, needs no data. Moving every number by itself, until the change is that of the recipe
on mien's own walk and wave, or that of actors, was tried as well; recognisers knew the results less often
(docs/effect.md).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..analysis.visible import Look, visible_change
from ..curve import multiply
from ..edits import pipeline
from ..edits.registry import EDITS
from ..kinematics.body import Body
from ..motion import Motion, require_motion
from ..recipe import Recipe, Step
from ..typing import Array

CLEAR = 5.0  # size of a visible change: the median of acted takes (Bandai-Namco, 14 styles: 4.3, 5.1, 5.9)
LEAST, MOST = 1.0, 1.6  # times what is written: never less, and no caricature
LOOKS = 3  # how often the change is measured
CLOSE = 0.03  # share of what is wanted that may be missed
LONGEST, FPS = 12.0, 20.0  # seconds and Hz of what is looked at: movement up to 6 Hz counts as manner


@dataclass(frozen=True, eq=False)
class Trial:
    """The part of a clip on which recipes are tried, thinned, and how it looks before."""

    motion: Motion
    body: Body
    look: Look

    @classmethod
    def of(cls, motion: Motion) -> Self:
        """Return the middle of a motion, at most 12 s at about 20 frames a second."""
        motion = require_motion(motion).with_(history=())
        frames = max(round(LONGEST / motion.frame_time), 2)
        start = max(len(motion) - frames, 0) // 2
        motion = motion[start : start + frames]
        if motion.fps > 1.2 * FPS and motion.duration > 4.0 / FPS:
            motion = pipeline.apply(motion, [Step("resample", {"fps": FPS})]).with_(history=())
        body = Body.of(motion)
        return cls(motion, body, Look.of(motion, body=body))

    def change(self, recipe: Recipe) -> Array:
        """Return what a recipe visibly changes (14,), in units of what is clear.

        Feet are not put back on the floor for that: hips and legs then show what was asked.
        """
        after = pipeline.apply(self.motion, [step for step in recipe.steps if step.edit != "foot_plant"])
        return visible_change(self.look, Look.of(after, body=self.body))


def searched(motion: Motion, recipe: Recipe, *, clear: float = CLEAR) -> Recipe:
    """Return the recipe with the strength that makes a ``clear`` change on one motion.

    The strength of every step is multiplied by ``times_for``; where the recipe changes enough as it is, it
    comes back as it is. Raises ``BodyError`` where no body is found, ``RecipeError`` for a recipe that is out
    of range.

    >>> from mien import samples
    >>> from mien.emotion.presets import preset
    >>> recipe = searched(samples.walk(seconds=3.0).motion, preset("happy"))
    >>> 1.0 < recipe.steps[0].strength <= 1.6
    True
    """
    return stronger(recipe, times_for(motion, recipe, clear=clear))


def times_for(motion: Motion, recipe: Recipe, *, clear: float = CLEAR) -> float:
    """Return how many times as strong, from 1 to 1.6, a recipe makes a ``clear`` change on one motion.

    Raises ``BodyError`` where no body is found.
    """
    require_motion(motion)
    if not recipe.steps:
        return LEAST
    trial = Trial.of(motion)
    return round(amount_for(lambda c: float(np.linalg.norm(trial.change(stronger(recipe, c)))), clear), 2)


def amount_for(size: Callable[[float], float], wanted: float) -> float:
    """Return the amount c in [1, 1.6] for which ``size(c)``, which grows with c, is nearest to ``wanted``.

    Secant steps, the first from ``size(0) = 0``; at most three calls of ``size``.

    >>> round(amount_for(lambda c: 4.0 * c, 5.0), 2)
    1.25
    """
    before, had, amount = 0.0, 0.0, LEAST
    for _ in range(LOOKS):
        found = size(amount)
        if abs(found - wanted) <= CLOSE * wanted or (found - had) * (amount - before) <= 0.0:
            break
        step = (wanted - found) * (amount - before) / (found - had)
        following = float(np.clip(amount + step, LEAST, MOST))
        if following == amount:
            break
        before, had, amount = amount, found, following
    return amount


def stronger(recipe: Recipe, times: float) -> Recipe:
    """Return a recipe whose steps are so many times as strong, at most 2; repairs stay as they are."""
    if times == 1.0:
        return recipe
    steps = tuple(
        step
        if EDITS[step.edit].kind == "repair"
        else replace(step, strength=multiply(step.strength, times, most=pipeline.MOST))
        for step in map(pipeline.check, recipe.steps)
    )
    said = f"{recipe.description}; {times:g} times as strong, so that it shows on this clip"
    return replace(recipe, steps=steps, description=said.removeprefix("; "))
