"""What a place on the disc of emotions asks of a motion: a change of its Laban features.

Aristidou et al. 2017, equations 3 and 4: for each selected feature a multiquadric function of valence and
arousal goes through the change that each learned emotion makes. The relative form: what is wanted is the
feature of the motion, plus the function at the wanted place, less the function at the place it is now.
"""

import numpy as np

from ..analysis.laban_table import SELECTED
from ..errors import MienError
from ..signal.radial import Radial, through
from ..typing import Array
from .circumplex import ORIGIN, Point, clamp
from .model import EmotionModel

FEWEST = 4  # places, so that a function of two numbers has a bend
# Unit of a feature -> a change so small that nobody sees it: no feature is told apart more finely.
FLOOR = {
    "heights": 0.005,
    "heights^2/s": 0.005,
    "heights^3": 0.001,
    "heights/s": 0.05,
    "heights/s^2": 0.5,
    "heights/s^3": 5.0,
    "per window": 0.2,
    "share": 0.05,
}
_CHOSEN = [d.number - 1 for d in SELECTED]


def surfaces(model: EmotionModel) -> Radial:
    """Return the function from places (..., 2) to changes of the selected features (..., 31), own units.

    Raises ``MienError`` where the model has fewer than four labels with a place and a change, or all of them
    lie on one line.

    >>> from mien.emotion.model import shipped_model
    >>> surfaces(shipped_model())(np.zeros(2)).shape
    (31,)
    """
    labels = [label for label in model.places if label in model.changes]
    if len(labels) < FEWEST:
        raise MienError(
            f"the model knows how features change for {len(labels)} places ({', '.join(labels)}); it takes "
            f"{FEWEST} or more, so learn from more emotions that stand on the disc"
        )
    points = np.array([model.places[label] for label in labels])
    return through(points, np.array([model.changes[label][_CHOSEN] for label in labels]))


def wanted(model: EmotionModel, place: Point, *, start: Point = ORIGIN) -> Array:
    """Return the wanted change (31,) of the selected features from ``start`` to ``place``, in own units.

    Places outside the disc are drawn in. Raises ``MienError`` as ``surfaces`` does.

    >>> from mien.emotion.model import shipped_model
    >>> float(abs(wanted(shipped_model(), Point(0.5, 0.2), start=Point(0.5, 0.2))).max())
    0.0
    """
    function = surfaces(model)
    found: Array = function(np.array(clamp(*place))) - function(np.array(clamp(*start)))
    return found


def scales(model: EmotionModel) -> Array:
    """Return how much each selected feature (31,) usually changes: root mean square over emotions."""
    changes = [model.changes[label][_CHOSEN] for label in model.places if label in model.changes]
    usual = np.sqrt(np.mean(np.square([c for c in changes if np.any(c)] or changes), axis=0))
    return np.maximum(usual, [FLOOR[d.feature.unit] for d in SELECTED])
