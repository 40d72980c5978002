"""From a place on the disc of emotions to the steps that bring a motion there: emotion control.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, section 4. What is wanted is
a change of Laban features in each cluster of poses (``wishes``). ``rules`` fits four rules to it one after
the other (``rule_fitting``), ``joint`` all at once, on the body that follows them (``joint_fitting``). Both
give a recipe of the steps ``control_points``, ``tempo`` and ``foot_plant``, which replays like any other.
"""

from collections.abc import Sequence
from typing import Literal

from ..curve import Varying, values
from ..errors import MienError, unknown
from ..kinematics.control_points import NAMES
from ..motion import Motion, require_motion
from ..recipe import Recipe, Step
from .circumplex import ORIGIN, Point, clamp, nearest
from .joint_fitting import drifted, joint
from .model import EmotionModel, shipped_model
from .rule_curves import DIGITS, at_times, in_time, through
from .rule_fitting import sequential
from .rule_wish import Wish
from .wishes import MODES, Mode, wanted

Method = Literal["rules", "joint"]
METHODS = ("rules", "joint")


def synthesise(
    motion: Motion,
    place: Point,
    *,
    start: Point = ORIGIN,
    method: Method = "rules",
    mode: Mode = "relative",
    model: EmotionModel | None = None,
) -> Recipe:
    """Return the recipe that brings a motion to a place on the disc (Aristidou et al. 2017, equation 6).

    ``start`` is the place where the motion is now; the steps are those of the way between. ``mode``
    ``"absolute"`` asks for the features that emotions at the place have, whatever the motion does and is.
    ``mien.edit(motion, recipe)`` does the steps, also at another strength. ``model`` is a learned one,
    else the shipped one. A place that is the start gives no steps. Raises ``MienError`` for another method
    or mode and for a model with too few places, ``BodyError`` where no body is found.

    >>> from mien.samples import walk
    >>> recipe = synthesise(walk(seconds=3.0).motion, Point(-0.65, -0.27))
    >>> [step.edit for step in recipe.steps]
    ['control_points', 'tempo', 'foot_plant']
    """
    require_motion(motion)
    if method not in METHODS:
        raise MienError(unknown("method of synthesis", method, METHODS))
    if mode not in MODES:
        raise MienError(unknown("mode of synthesis", mode, MODES))
    asked = wanted(model or shipped_model(), place, start=start, mode=mode)
    if not asked.absolute and not asked.numbers.any():
        return _recipe(place, method, [1.0] * len(NAMES), 1.0)
    wish = Wish.of(motion, asked)
    found = sequential(wish)
    if method == "rules":
        return _recipe(place, method, in_time(wish.stays, found.pose), found.tempo)
    found = joint(wish, found)
    curves = in_time(wish.stays, found.pose)
    drift = drifted(wish, lambda times: at_times(curves, times))
    if drift.after < drift.before:
        curves = through(drift.times, drift.values)
    return _recipe(place, method, curves, found.tempo)


def _recipe(place: Point, method: Method, curves: Sequence[Varying], tempo: float) -> Recipe:
    """Return the steps for ten coefficients and the tempo, without what is 1."""
    rate = round(tempo, DIGITS)
    pose = {name: c for name, c in zip(NAMES, curves, strict=True) if any(v != 1.0 for v in values(c))}
    steps = [Step("control_points", pose)] if pose else []
    steps += [Step("tempo", {"rate": rate})] if rate != 1.0 else []
    steps += [Step("foot_plant")] if pose else []
    valence, arousal = clamp(*place)
    word = nearest(valence, arousal)[0][0]
    return Recipe(
        name=f"{method} {valence:.2f} {arousal:.2f}",
        steps=tuple(steps),
        description=f"Towards valence {valence:.2f}, arousal {arousal:.2f} on the disc, near {word}.",
        evidence="found by the rules of Aristidou et al. (2017) for one clip; it is about no other",
        safe=True,
    )
