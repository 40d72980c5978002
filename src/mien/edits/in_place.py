"""Take the travel out of a motion: walk as on a treadmill, keeping sway and bounce.

To the motion: the slow part of the hips' path over the ground is taken away; the first frame stays
where it is. To the viewer, and to a game engine: the body stays in place while the legs go on.

The slow part is the smoothest curve near the path (Whittaker 1923): a straight walk at any steady
speed is taken away exactly, whatever its length. Heading is kept. Feet now slide by intention: do
this last, after ``foot_plant``.
"""

from typing import Annotated

import numpy as np

from ..kinematics.body import Body
from ..kinematics.fk import chain
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .registry import Param, edit

CUTOFF = 0.5  # Hz: below a stride (about 0.9 Hz), whose sway stays, and above a change of course


@edit(
    kind="time",
    paper="Whittaker (1923), order 2",
    equation="x' = x - sum a dz,  z = argmin |x - z|^2 + (fps / (2 pi f))^4 |D^2 z|^2,  f = 0.5 Hz",
)
def in_place(
    motion: Motion,
    *,
    amount: Annotated[
        float | Array, Param("how much of the travel is taken out", 0.0, 1.0, neutral=0.0)
    ] = 1.0,
) -> Motion:
    """Take the travel over the ground out of the hips' path, up to ``amount`` of it (0 to 1).

    Height, heading and what is faster than 0.5 Hz stay; the path has response ``1 / (1 + (f / 0.5)^4)``.
    An ``amount`` that changes over time (T,) is the share of each step that is taken out.
    """
    if not np.any(amount) or len(motion) < 2:
        return motion
    body = Body.of(motion)
    hips, up = body.roles["hips"], body.up
    joints, rotations, positions = chain(motion, [hips])
    ground = positions[:, -1] - (positions[:, -1] @ up)[:, None] * up
    path = slow_path(ground, motion.fps)
    shift = -_travel(path, amount)
    above = int(motion.skeleton.parents[hips])
    if above >= 0:
        shift = quaternion.rotate(quaternion.conjugate(rotations[:, joints.index(above)]), shift)
    translations = np.array(motion.translations)
    translations[:, hips] += shift
    return motion.with_(translations=translations)


def _travel(path: Array, amount: float | Array) -> Array:
    """Return how far each frame (T, 3) has gone along ``path``, each step by its ``amount``."""
    if not isinstance(amount, np.ndarray):
        return amount * (path - path[0])
    share = 0.5 * (amount[1:] + amount[:-1])
    return np.concatenate([np.zeros((1, 3)), np.cumsum(share[:, None] * np.diff(path, axis=0), axis=0)])


def slow_path(x: Array, fps: float) -> Array:
    """Return the smooth path (T, 3) near ``x``: ``(1 + k D'D) z = x``, ``D`` second differences."""
    from scipy.linalg import solveh_banded

    if len(x) < 3:
        return x
    stiffness = (fps / (2.0 * np.pi * CUTOFF)) ** 4
    # The three diagonals of D'D: rows of 1 -2 1 overlap, less of them at the ends.
    bands = np.zeros((3, len(x)))
    for i, a in enumerate((1.0, -2.0, 1.0)):
        for j, b in enumerate((1.0, -2.0, 1.0)):
            if j >= i:
                bands[2 - (j - i), j : len(x) - 2 + j] += stiffness * a * b
    bands[2] += 1.0
    # A straight line is its own answer; taking it out first keeps its last digits.
    line = x[0] + (x[-1] - x[0]) * np.linspace(0.0, 1.0, len(x))[:, None]
    z: Array = line + solveh_banded(bands, x - line)
    return z
