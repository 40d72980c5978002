"""Whether parts of the body sink into the floor, or planted feet hover above it.

The floor is level, where the source's feet stand: a point of a foot counts from its own usual standing
height, so that thick shoes and toes without a joint do no harm; any other part from the floor itself.
"""

import numpy as np

from ...kinematics.contacts import standing_level
from ...kinematics.raising import lowest
from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how deep feet and the rest of the body sink, and how high planted feet hover (T, 5), in cm."""
    up, floor = scene.body.up, scene.body.floor
    height = scene.feet @ up
    level = _level(scene)
    sunk = np.maximum(level - height, 0.0).max(axis=2)
    hover = np.where(scene.contacts.points, np.maximum(height - level, 0.0), np.inf).min(axis=2)
    hover = np.where(np.isfinite(hover), hover, 0.0)
    rest = np.maximum(floor - lowest(scene.motion, scene.body, scene.positions), 0.0)
    values = np.concatenate([sunk, hover, rest[:, None]], axis=1)
    return Measured(values * scene.centimetres, PARTS)


PARTS = ("left_foot", "right_foot", "left_foot_above", "right_foot_above", "body")


def _level(scene: Scene) -> np.ndarray:
    """Return the height (2, 2) at which each point of the source's feet usually stands."""
    of = scene.source or scene
    return standing_level(of.feet @ of.body.up, of.body.leg_length)


CHECK = Check("floor", "feet sink or hover", "cm", 1, limit=8.0, tolerance=1.0, measure=measure)
