"""Whether the ground must hold feet back more than friction can, or pull them down.

The slope of the ground's push where feet are planted: its part along the ground over its part upward, which
shoes on a floor bear up to 0.8 or so before they slip. A ground that would have to pull counts as 3.
"""

import numpy as np

from ...kinematics.mass import GRAVITY
from .check import Check, Measured
from .scene import Scene

MOST = 3.0


def measure(scene: Scene) -> Measured:
    """Return the slope of the ground's push (T, 1) where feet are planted."""
    force, up = scene.dynamics.force, scene.body.up
    lift = force @ up
    along = np.linalg.norm(force - lift[:, None] * up, axis=1)
    slope = np.clip(along / np.maximum(lift, 0.05 * GRAVITY), 0.0, MOST)
    slope = np.where(lift < 0.0, MOST, slope)
    planted = scene.contacts.feet.any(axis=1)
    pulled = float((planted & (lift < 0.0)).mean())
    return Measured(np.where(planted, slope, 0.0)[:, None], ("feet",), {"frames the ground pulls": pulled})


CHECK = Check("ground", "friction needed", "", 2, limit=0.9, tolerance=0.15, factor=1.25, measure=measure)
