"""The four rules that move the control points of a body: pelvis, head, hands, and the pace of all.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, table 2. A coefficient of 1
changes nothing. The printed table is mended: its vectors are read from the reference to the point that is
moved (as printed, a smaller ``c1`` would raise the pelvis), and ``g1`` above the height of the calm stance is
continuous at 1 (as printed it jumps there). Pure functions on arrays, in any unit; frames first. A
coefficient may be one number or one for each frame.
"""

import numpy as np

from ..typing import Array, Integers

# Rule -> the least and the most that its coefficient may be; ours, as the paper tells none.
BOUNDS = {"pelvis": (0.6, 1.4), "torso": (0.3, 5.0), "hand": (0.5, 2.0), "tempo": (0.6, 1.6)}
REFERENCES = ("head", "chest", "pelvis", "ground")  # what a hand comes nearer to or goes away from


def pelvis_height(height: Array, rest: float, c: Array | float) -> Array:
    """Return the heights (T,) of the pelvis after rule g1, ``rest`` being that of the calm stance.

    ``c h`` for ``c <= 1``. For larger ``c``: ``h + (h_T - h) (1 - 1/c)`` up to the calm stance, which is
    never passed, and ``h + (h - h_T) (c - 1)`` above it, as in a jump.

    >>> pelvis_height(np.array([0.8, 1.2]), 1.0, 0.5), pelvis_height(np.array([0.8, 1.2]), 1.0, 2.0)
    (array([0.4, 0.6]), array([0.9, 1.4]))
    """
    raised = height + (height - rest) * np.where(height <= rest, 1.0 / c - 1.0, c - 1.0)
    return np.where(np.asarray(c) <= 1.0, c * height, raised)


def torso_vector(torso: Array, rest: Array, c: Array | float) -> Array:
    """Return the vectors (T, 3) from pelvis to head after rule g2: ``d_T - (d_T - d) / c``.

    ``rest`` (T, 3) is that of the calm stance, turned into the heading of each frame. Larger ``c`` is nearer
    to upright, smaller bends further; a torso that is upright stays so.

    >>> torso_vector(np.array([[0.0, 0.9, 0.2]]), np.array([[0.0, 1.0, 0.0]]), 2.0)
    array([[0.  , 0.95, 0.1 ]])
    """
    return np.asarray(rest - (rest - torso) / np.asarray(c, float)[..., None])


def hand_position(hand: Array, references: Array, coefficients: Array) -> Array:
    """Return where a hand is (T, 3) after rule g3: ``p + 1/4 sum_r (p - r) (c_r - 1)``.

    ``references`` (T, 4, 3) are the places ``REFERENCES``, the ground straight below the hand, and
    ``coefficients`` (4,) or (T, 4) theirs: above 1 goes away from a place, below comes nearer.

    >>> spots = np.zeros((1, 4, 3))
    >>> hand_position(np.array([[0.0, 1.0, 0.4]]), spots, np.array([1.5, 1.5, 1.5, 1.5]))
    array([[0. , 1.5, 0.6]])
    """
    away = np.asarray(coefficients, float)[..., None] - 1.0
    return np.asarray(hand + 0.25 * ((hand[:, None] - references) * away).sum(axis=1))


def paced(values: Array, c: Array | float, *, order: Integers | int = 1) -> Array:
    """Return derivatives of some ``order`` (1 speed, 2 acceleration, 3 jerk) after rule g4: ``v c^order``.

    The clip is shown ``c`` times as fast, so it lasts ``1 / c`` as long.

    >>> paced(np.array([2.0]), 1.5, order=2)
    array([4.5])
    """
    return np.asarray(values * c**order)
