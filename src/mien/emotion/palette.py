"""The presets as points of one space, so that there is a recipe for every place of the disc between them.

A recipe of a preset is a handful of numbers: how far limbs go, how movement is timed, how the body is held,
how fast all is. The numbers of the presets whose words stand on the circumplex say what each direction of the
disc is, monotone from one word to the next; along it they grow in proportion from the centre, where
nothing changes, so that further is more. (Multiquadrics through the same words, as Aristidou et al. 2017
have for motion features, overshoot between neighbours such as afraid and angry: halfway between afraid and
excited the tempo fell.) Nothing of it is learned from data.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from ..edits.registry import EDITS
from ..recipe import Recipe, Step
from ..typing import Array
from .circumplex import ORIGIN, Point, clamp, point
from .presets import preset

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

# Presets whose words are on the disc. What is uneven in nervous is left out: there is no half of it.
ANCHORS = ("afraid", "angry", "excited", "happy", "nervous", "relaxed", "sad", "tired")


@dataclass(frozen=True)
class Knob:
    """One number of a recipe: a parameter of an edit, on some parts, with fixed other parameters.

    ``scale`` is how much is a clear change; factors are counted by their logarithm.
    """

    edit: str
    parameter: str
    scale: float
    parts: tuple[str, ...] = ()
    fixed: tuple[tuple[str, str], ...] = ()
    factor: bool = False


BODY = ("head", "torso", "legs")
KNOBS = (
    Knob("path_length", "mid", 0.3, BODY, factor=True),
    Knob("path_length", "mid", 0.3, ("arms",), factor=True),
    Knob("sway", "hips_turn", 0.3, factor=True),
    Knob("sway", "shoulders_tilt", 0.3, factor=True),
    Knob("sway", "shoulders_turn", 0.3, factor=True),
    Knob("sway", "shift", 2.0),
    Knob("bounce", "gain", 0.4, factor=True),
    Knob("bounce", "beat", 0.01),
    Knob("timing", "acceleration", 0.4),
    Knob("timing", "acceleration", 0.4, fixed=(("where", "impacts"),)),
    Knob("posture", "head", 12.0),
    Knob("posture", "trunk", 8.0),
    Knob("posture", "lean", 4.0),
    Knob("posture", "shoulders", 8.0),
    Knob("posture", "arms", 8.0),
    Knob("posture", "arms_forward", 10.0),
    Knob("posture", "elbows", 20.0),
    Knob("posture", "legs", 3.0),
    Knob("posture", "hips_height", 0.03),
    Knob("tempo", "rate", 0.15, factor=True),
)
DIGITS = {
    "hips_height": 3,
    "beat": 3,
    **dict.fromkeys(("mid", "acceleration", "rate", "gain", "hips_turn"), 2),
    **dict.fromkeys(("shoulders_tilt", "shoulders_turn"), 2),
}


def settings(steps: Iterable[Step]) -> Array:
    """Return the numbers (K,) of a recipe's steps, 0 where it changes nothing; factors as logarithms.

    What no knob stands for is passed over.
    """
    found = np.zeros(len(KNOBS))
    for step in steps:
        for i, knob in enumerate(KNOBS):
            if knob.edit == step.edit and _covers(step, knob):
                value = float(step.parameters.get(knob.parameter, _neutral(knob)))
                found[i] = np.log(max(value, 1e-3)) if knob.factor else value
    return found


def as_steps(numbers: Array) -> tuple[Step, ...]:
    """Return the steps for such numbers (K,), within the ranges of the edits; none where nothing changes."""
    steps: dict[tuple[object, ...], dict[str, object]] = {}
    for number, knob in zip(numbers, KNOBS, strict=True):
        about = EDITS[knob.edit].parameters[knob.parameter].about
        value = float(np.exp(number)) if knob.factor else float(number)
        value = round(float(np.clip(value, about.low, about.high)), DIGITS.get(knob.parameter, 1))
        if value != _neutral(knob):
            steps.setdefault((knob.edit, knob.parts, knob.fixed), dict(knob.fixed))[knob.parameter] = value
    made = [Step(str(edit), values, parts=parts) for (edit, parts, _), values in steps.items()]  # type: ignore[arg-type]
    return (*made, Step("foot_plant")) if made else ()


@cache
def _round(table: str) -> "PchipInterpolator":
    """Return angle in radians, from -pi to 3 pi -> numbers (K,) at a distance of 1."""
    from scipy.interpolate import PchipInterpolator

    places = np.array([point(word, table=table) for word in ANCHORS])
    numbers = np.array([settings(preset(word).steps) for word in ANCHORS])
    angles = np.arctan2(places[:, 1], places[:, 0])
    order = np.argsort(angles)
    numbers = (numbers / np.linalg.norm(places, axis=1)[:, None])[order]
    turns = angles[order] + 2.0 * np.pi * np.arange(-1, 3)[:, None]
    return PchipInterpolator(turns.ravel(), np.tile(numbers, (4, 1)))


def settings_at(valence: float, arousal: float, *, table: str = "ratings") -> Array:
    """Return the numbers (K,) of the recipe that belongs to a point of the disc."""
    place = clamp(valence, arousal)
    numbers: Array = _round(table)(np.arctan2(place.arousal, place.valence))
    return numbers * float(np.hypot(*place))


def recipe_at(valence: float, arousal: float, *, start: Point = ORIGIN, table: str = "ratings") -> Recipe:
    """Return the recipe that leads from one point of the disc, the centre unless said, to another.

    At the word of an anchor it has that preset's numbers, as far as knobs stand for them; from a point to
    itself it has no steps.
    """
    numbers = settings_at(valence, arousal, table=table) - settings_at(*start, table=table)
    name = f"valence {valence:.2f} arousal {arousal:.2f}"
    return Recipe(name, as_steps(numbers), safe=True)


def _covers(step: Step, knob: Knob) -> bool:
    """Return whether a step does what a knob stands for, on all of the knob's parts."""
    same = dict(knob.fixed).get("where", "everywhere") == step.parameters.get("where", "everywhere")
    return same and (not step.parts or not knob.parts or set(knob.parts) <= set(step.parts))


def _neutral(knob: Knob) -> float:
    return float(EDITS[knob.edit].parameters[knob.parameter].about.neutral or 0.0)
