"""What a place on the disc of emotions asks of a motion: a change of its Laban features, cluster by cluster.

Aristidou et al. 2017, equations 3 and 4: for each feature a multiquadric function of valence and arousal goes
through the change that each learned emotion makes, in each cluster of poses for itself. ``relative``: what is
wanted is the feature of the motion, plus the function at the wanted place, less the function at the place it
is now. ``absolute``, as the paper is written: what is wanted is the feature that emotions at the wanted place
have, whatever the motion has; that asks for another content too.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..errors import MienError
from ..signal.radial import Radial, through
from ..typing import Array
from .circumplex import ORIGIN, Point, clamp
from .control_features import NUMBERS, POSE
from .model import EmotionModel
from .pose_clusters import PoseSet

FEWEST = 4  # places, so that a function of two numbers has a bend
# Times the mean change of acted takes that is wished, of poses and of pace: actors differ in how they show an
# emotion, so that their mean is weaker than any of them.
EMPHASIS = np.array([2.0 if number in POSE else 1.3 for number in NUMBERS])
Mode = Literal["relative", "absolute"]
MODES = ("relative", "absolute")


@dataclass(frozen=True, eq=False)
class Wanted:
    """What is wanted in each cluster of poses, whose ``centres`` (C) are.

    ``numbers`` (C, 30), in the order of ``control_features.NUMBERS``: changes, or the features themselves
    where it is ``absolute``; ``weights`` (C, 30) how much each counts.
    """

    centres: PoseSet
    numbers: Array
    weights: Array
    absolute: bool = False


def surfaces(model: EmotionModel) -> Radial:
    """Return the function from places (..., 2) to changes (..., C * 30) in all clusters, own units.

    Raises ``MienError`` where the model has fewer than four labels with a place and a change, or all of them
    lie on one line.

    >>> from mien.emotion.model import shipped_model
    >>> surfaces(shipped_model())(np.zeros(2)).shape
    (150,)
    """
    tables = model.clusters.changes
    labels = [label for label in model.places if label in tables]
    if len(labels) < FEWEST:
        raise MienError(
            f"the model knows how features change for {len(labels)} places ({', '.join(labels)}); it takes "
            f"{FEWEST} or more, so learn from more emotions that stand on the disc"
        )
    points = np.array([model.places[label] for label in labels])
    return through(points, np.array([tables[label].ravel() for label in labels]))


def wanted(model: EmotionModel, place: Point, *, start: Point = ORIGIN, mode: Mode = "relative") -> Wanted:
    """Return what is wanted of a motion that is at ``start`` and is to be at ``place``.

    Places outside the disc are drawn in. Raises ``MienError`` as ``surfaces`` does.

    >>> from mien.emotion.model import shipped_model
    >>> float(abs(wanted(shipped_model(), Point(0.5, 0.2), start=Point(0.5, 0.2)).numbers).max())
    0.0
    """
    function, tables = surfaces(model), model.clusters
    there = function(np.array(clamp(*place))).reshape(tables.rest.shape)
    if mode == "absolute":
        return Wanted(tables.centres, tables.rest + there, tables.weights, absolute=True)
    here = function(np.array(clamp(*start))).reshape(tables.rest.shape)
    return Wanted(tables.centres, EMPHASIS * (there - here), tables.weights)
