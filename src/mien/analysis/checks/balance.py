"""Whether the body would fall over.

How far the zero-moment point is outside the polygon of the planted feet. For a body that stands still it lies
under the centre of mass; while it moves it is where the ground's push must act. Beside it, how far outside
the centre of mass is, which in a walk swings out with every step.
"""

import numpy as np

from ...kinematics.support import outside
from .check import LASTING_FORCES, Check, Measured
from .scene import Scene

MOST = 100.0  # centimetres: further out, the number says nothing more


def measure(scene: Scene) -> Measured:
    """Return how far the zero-moment point is outside the support (T, 1), in centimetres."""
    scale, planted = scene.body.metres_per_unit, scene.contacts.points
    point, centre = scene.dynamics.zero_moment / scale, scene.dynamics.centre / scale
    astray, leaning = (_outside(p, scene) for p in (point, centre))
    standing = planted.any(axis=(1, 2))
    facts = {"centre of mass outside, mean cm": float(leaning[standing].mean()) if standing.any() else 0.0}
    return Measured(astray[:, None], ("whole_body",), facts)


def _outside(points: np.ndarray, scene: Scene) -> np.ndarray:
    found = outside(points, scene.feet, scene.contacts.points, scene.body) * scene.centimetres
    return np.clip(np.nan_to_num(found), 0.0, MOST)


CHECK = Check(
    "balance",
    "balance point outside the feet",
    "cm",
    1,
    limit=25.0,
    tolerance=5.0,
    factor=1.25,
    share=0.2,
    lasting=LASTING_FORCES,
    measure=measure,
)
