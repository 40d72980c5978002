"""Whether a body in the air falls as gravity has it.

In every flight, how far the acceleration of the centre of mass is from gravity, in metres a second squared,
on average. A flight is a time of 0.1 to 1.5 s with every part of the body clearly above the floor, in which
the body falls at least by a quarter of gravity: what falls less hangs or stands on what is not shown.
"""

import numpy as np

from ...kinematics.flights import airborne, falling
from ...kinematics.mass import GRAVITY
from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how far each flight is from free fall (T, 1), in m/s2."""
    held = np.linalg.norm(scene.dynamics.force, axis=1)
    values, found = np.zeros(len(held)), flights(scene.source or scene)
    for start, stop in found:
        values[start:stop] = held[start:stop].mean()
    return Measured(values[:, None], ("whole_body",), {"flights": float(len(found))})


def flights(scene: Scene) -> list[tuple[int, int]]:
    """Return the flights as ``(first frame, frame after the last)``."""
    held = np.linalg.norm(scene.dynamics.force, axis=1)
    planted, dt = scene.contacts.feet, scene.motion.frame_time
    return falling(airborne(scene.lowest, planted, scene.body.leg_length, dt), held, GRAVITY)


CHECK = Check("flight", "flight away from free fall", "m/s2", 1, limit=4.5, tolerance=2.0, measure=measure)
