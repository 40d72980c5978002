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
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    away = np.cos(angles)[:, None] * body.forward + np.sin(angles)[:, None] * body.left  # (D, 3)
    ground, bears = _ground(feet, planted, body)
    reach = np.where(bears[..., None], ground @ away.T, -np.inf).max(axis=1)  # (T, D)
    found: Array = (points @ away.T - reach - HALF_WIDTH * body.leg_length).max(axis=1)
    return np.where(planted.any(axis=(1, 2)), found, np.nan)


def way_in(points: Array, feet: Array, planted: Mask, body: Body) -> Array:
    """Return the shortest way over the ground (T, 3) from ``points`` to the support; 0 inside or without it.

    The nearest point of a hull is on a line between two of its points.
    """
    ground, bears = _ground(feet, planted, body)
    a, b = np.triu_indices(ground.shape[1])
    line = _level(ground[:, b] - ground[:, a], body)
    ways = _level(ground[:, a] - points[:, None], body)
    square = np.maximum(np.einsum("tpi,tpi->tp", line, line), 1e-12 * body.leg_length**2)
    along = np.clip(-np.einsum("tpi,tpi->tp", ways, line) / square, 0.0, 1.0)
    ways = ways + along[..., None] * line
    lengths = np.where(bears[:, a] & bears[:, b], np.linalg.norm(ways, axis=-1), np.inf)
    best = lengths.argmin(axis=1)[:, None]
    way, length = np.take_along_axis(ways, best[..., None], 1)[:, 0], np.take_along_axis(lengths, best, 1)
    out = np.nan_to_num(outside(points, feet, planted, body)) > 0.0
    share = np.maximum(1.0 - HALF_WIDTH * body.leg_length / np.maximum(length, 1e-12), 0.0)
    return np.where(out[:, None] & np.isfinite(length), way * share, 0.0)


def _ground(feet: Array, planted: Mask, body: Body) -> tuple[Array, Mask]:
    """Return heel, ball and tip of both feet (T, 6, 3), and which of them bear: a foot does on its length."""
    line = feet[:, :, 1] - feet[:, :, 0]
    length = np.maximum(np.linalg.norm(line, axis=-1, keepdims=True), 1e-12)
    tips = feet[:, :, 1] + TOES * body.leg_length * line / length
    ground = np.concatenate([feet, tips[:, :, None]], axis=2).reshape(len(feet), 6, 3)
    return ground, np.repeat(planted.any(axis=2), 3, axis=1)


def _level(v: Array, body: Body) -> Array:
    return v - (v @ body.up)[..., None] * body.up
