"""Whether a body in the air falls as gravity has it.

In every flight, how far the acceleration of the centre of mass is from gravity, in metres a second squared,
on average. A flight is a time of 0.1 to 1.5 s with every part of the body clearly above the floor, in which
the body falls at least by a quarter of gravity: what falls less hangs or stands on what is not shown.
"""

import numpy as np

from ...kinematics.contacts import spans
from ...kinematics.mass import GRAVITY
from ...typing import Mask
from .check import Check, Measured
from .scene import Scene

CLEAR = 0.06  # leg lengths above the floor
SHORTEST, LONGEST = 0.1, 1.5  # seconds
FALLS = 0.75  # of gravity that a body in flight may at most be held up with


def measure(scene: Scene) -> Measured:
    """Return how far each flight is from free fall (T, 1), in m/s2."""
    held = np.linalg.norm(scene.dynamics.force, axis=1)
    values = np.zeros(len(held))
    for start, stop in flights(scene):
        mean = float(held[start:stop].mean())
        values[start:stop] = mean if mean < FALLS * GRAVITY or scene.source else 0.0
    return Measured(values[:, None], ("whole_body",), {"flights": float(len(flights(scene)))})


def flights(scene: Scene) -> list[tuple[int, int]]:
    """Return the flights as ``(first frame, frame after the last)``: the source's where there is one."""
    if scene.source is not None:
        held = np.linalg.norm(scene.source.dynamics.force, axis=1)
        return [(a, b) for a, b in flights(scene.source) if held[a:b].mean() < FALLS * GRAVITY]
    dt = scene.motion.frame_time
    air: Mask = (scene.lowest > CLEAR * scene.body.leg_length) & ~scene.contacts.feet.any(axis=1)
    return [(a, b) for a, b in spans(air) if SHORTEST <= (b - a) * dt <= LONGEST]


CHECK = Check("flight", "flight away from free fall", "m/s2", 1, limit=4.5, tolerance=2.0, measure=measure)
