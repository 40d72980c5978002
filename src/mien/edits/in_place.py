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
from ..kinematics.travel import slow_path
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .registry import Param, edit


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
    path = slow_path(positions[:, -1], up, motion.fps)
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
