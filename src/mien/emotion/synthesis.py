"""From a place on the disc of emotions to the steps that bring a motion there: emotion control.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, section "Emotion to motion".
What is wanted is a change of Laban features (``wishes``). ``rules`` fits four rules to it one after the other
(``rule_fitting``), ``joint`` all at once, on the body that follows them (``joint_fitting``). Both give a
recipe of the steps ``control_points``, ``tempo`` and ``foot_plant``, which replays like any other.
"""

from typing import Literal

import numpy as np

from ..errors import MienError, unknown
from ..kinematics.control_points import NAMES
from ..motion import Motion, require_motion
from ..recipe import Recipe, Step
from ..typing import Array
from .circumplex import ORIGIN, Point, clamp, nearest
from .joint_fitting import joint
from .model import EmotionModel, shipped_model
from .rule_fitting import Wish, sequential
from .wishes import scales, wanted

Method = Literal["rules", "joint"]
METHODS = ("rules", "joint")
DIGITS = 3  # of coefficients in a recipe


def synthesise(
    motion: Motion,
    place: Point,
    *,
    start: Point = ORIGIN,
    method: Method = "rules",
    model: EmotionModel | None = None,
) -> Recipe:
    """Return the recipe that brings a motion to a place on the disc (Aristidou et al. 2017, equation 6).

    ``start`` is the place where the motion is now; the steps are those of the way between.
    ``mien.edit(motion, recipe)`` does them, also at another strength. ``model`` is a learned one, else the
    shipped one. A place that is the start gives no steps. Raises ``MienError`` for another method and for a
    model with too few places, ``BodyError`` where no body is found.

    >>> from mien.samples import walk
    >>> recipe = synthesise(walk(seconds=3.0).motion, Point(-0.65, -0.27))
    >>> [step.edit for step in recipe.steps]
    ['control_points', 'tempo', 'foot_plant']
    """
    require_motion(motion)
    if method not in METHODS:
        raise MienError(unknown("method of synthesis", method, METHODS))
    model = model or shipped_model()
    change = wanted(model, place, start=start)
    if not change.any():
        return _recipe(place, method, np.ones(len(NAMES) + 1))
    wish = Wish.of(motion, change, scales(model))
    found = sequential(wish)
    return _recipe(place, method, joint(wish, found) if method == "joint" else found)


def _recipe(place: Point, method: Method, c: Array) -> Recipe:
    """Return the steps for coefficients (11,), without what is 1."""
    c = np.round(c, DIGITS)
    pose = {name: float(value) for name, value in zip(NAMES, c[:-1], strict=True) if value != 1.0}
    steps = [Step("control_points", pose)] if pose else []
    steps += [Step("tempo", {"rate": float(c[-1])})] if c[-1] != 1.0 else []
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
