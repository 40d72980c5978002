"""Numbers of a step that change over time: the edit is rendered at a few values and blended between them.

An edit may look at the whole clip (a filter does), so that a number which changes from frame to frame has
no meaning for it. What is meant is: at every frame what the edit does with the number of that moment.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

import numpy as np

from ..curve import Varying, evaluate, is_curve, values
from ..errors import RecipeError
from ..kinematics.blending import blend
from ..motion import Motion
from ..typing import Array

LEVELS = 9  # of one number; between them poses change almost in proportion
RENDERINGS = 81
STRENGTH = "strength"


@dataclass(frozen=True, eq=False)
class _Axis:
    """One number that changes: its value at every frame (T,) and the levels the edit is rendered at."""

    name: str
    at: Array
    levels: Array

    def shares(self, level: int) -> Array:
        """Return how much of a level shows in each frame (T,): 1 at the level, 0 from the next on."""
        return np.interp(self.at, self.levels, np.arange(len(self.levels)) == level)


def curves(given: Mapping[str, Any], numeric: Mapping[str, Any], strength: Varying) -> dict[str, Any]:
    """Return those of the ``numeric`` parameters in ``given`` that are curves, and the strength if it is."""
    found = {name: value for name, value in given.items() if name in numeric and is_curve(value)}
    return found | ({STRENGTH: strength} if is_curve(strength) else {})


def blended(
    motion: Motion, changing: Mapping[str, Varying], render: Callable[[Mapping[str, float]], Motion]
) -> Motion:
    """Return at every frame what ``render`` gives for the values that ``changing`` has at that moment.

    ``render`` is called with one number for each name, at most 9 different ones: those of the keys (of two,
    also the middle) or, of more keys, evenly spaced ones. A frame whose value is one of them is exactly that
    rendering's.
    """
    axes = [_axis(name, curve, motion.times) for name, curve in changing.items()]
    if prod(len(axis.levels) for axis in axes) > RENDERINGS:
        raise RecipeError(
            f"{', '.join(changing)} change over time with too many keys at once; use fewer keys, or two steps"
        )
    out, shown = motion, np.zeros(len(motion))
    for node in product(*(range(len(axis.levels)) for axis in axes)):
        weight = np.prod([axis.shares(level) for axis, level in zip(axes, node, strict=True)], axis=0)
        if not weight.any():
            continue
        here = render({axis.name: float(axis.levels[i]) for axis, i in zip(axes, node, strict=True)})
        shown = shown + weight
        share = np.where(shown > 0.0, weight / np.maximum(shown, 1e-300), 1.0)
        out = blend(out, here, np.broadcast_to(share[:, None], here.rotations.shape[:2]))
    return out


def _axis(name: str, curve: Varying, times: Array) -> _Axis:
    levels = np.unique(values(curve))
    if len(levels) == 2 or len(levels) > LEVELS:
        levels = np.linspace(levels[0], levels[-1], min(len(levels) + 1, LEVELS))
    return _Axis(name, evaluate(curve, times), levels)
