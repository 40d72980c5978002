"""Whether parts of the body are inside each other.

Depth of the capsules of ``kinematics.capsules``. Their radii are those of an average man, so that a hand on
the hip is already some centimetres deep: what counts is what an edit adds.
"""

import numpy as np

from ...kinematics.capsules import capsules
from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how deep each pair of parts is inside each other (T, P), in centimetres."""
    shape = capsules(scene.motion, scene.body)
    depth = shape.contacts(scene.rotations, scene.positions).depth
    return Measured(np.maximum(depth, 0.0) * scene.centimetres, shape.pair_names())


CHECK = Check("collision", "parts inside each other", "cm", 1, limit=8.0, tolerance=1.5, measure=measure)
