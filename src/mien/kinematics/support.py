"""Where a body stands: the polygon of its planted feet on the floor, and how far a point is outside it."""

import numpy as np

from ..typing import Array, Mask
from .body import Body

HALF_WIDTH = 0.055  # leg lengths: half the breadth of a foot (ANSUR 2012: 10 cm)
TOES = 0.09  # leg lengths that the toes reach beyond the joint they bend at
DIRECTIONS = 180  # directions in which a polygon's edge is looked for


def outside(points: Array, feet: Array, planted: Mask, body: Body) -> Array:
    """Return how far ``points`` (T, 3) are outside the support over the ground (T,), negative inside.

    ``feet`` (T, 2, 2, 3) are the heels and toes and ``planted`` (T, 2, 2) which of them stand. The support is
    the convex hull of what stands, with the breadth of the feet: ``max over n of (n p - max over k of n f)``.
    Not a number where nothing stands.
    """
    return _farthest(points, feet, planted, body)[0]


def way_in(points: Array, feet: Array, planted: Mask, body: Body) -> Array:
    """Return the shortest way over the ground (T, 3) from ``points`` to the support; 0 inside or without."""
    found, away = _farthest(points, feet, planted, body)
    return -np.maximum(np.nan_to_num(found), 0.0)[:, None] * away


def _farthest(points: Array, feet: Array, planted: Mask, body: Body) -> tuple[Array, Array]:
    """Return the distance of ``outside`` (T,) and the direction (T, 3) in which it is."""
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    away = np.cos(angles)[:, None] * body.forward + np.sin(angles)[:, None] * body.left  # (D, 3)
    whole = planted.any(axis=2, keepdims=True) & np.ones(2, bool)  # a foot bears on all its length
    reach = np.where(whole[..., None], feet @ away.T, -np.inf)  # (T, 2, 2, D)
    reach[:, :, 1] += TOES * body.leg_length * np.maximum(_pointing(feet, away), 0.0)
    edge = reach.max(axis=(1, 2)) + HALF_WIDTH * body.leg_length
    beyond = points @ away.T - edge
    most = beyond.argmax(axis=1)
    found = np.take_along_axis(beyond, most[:, None], axis=1)[:, 0]
    return np.where(planted.any(axis=(1, 2)), found, np.nan), away[most]


def _pointing(feet: Array, away: Array) -> Array:
    """Return how far each foot points in each direction (T, 2, D), 1 along it."""
    line = feet[:, :, 1] - feet[:, :, 0]
    length = np.maximum(np.sqrt(np.einsum("tfi,tfi->tf", line, line)), 1e-12)[..., None]
    return (line / length) @ away.T
