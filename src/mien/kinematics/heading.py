"""Which way a body faces over time, and the frame that turns with it.

Heading is the yaw of the line from the right to the left hip about the up axis: steadier than any
Euler angle of the hips.
"""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array
from .body import Body
from .fk import chain

# Seconds: the Gaussian that halves what goes to and fro at 3 Hz.
STEADY = 0.0625


def heading(positions: Array, body: Body) -> Array:
    """Return the yaw (T,) in radians about ``body.up`` from ``body.forward``, without jumps in time."""
    return _yaw(positions[:, body.roles["left_hip"]] - positions[:, body.roles["right_hip"]], body)


def heading_rotation(positions: Array, body: Body) -> Array:
    """Return the rotations (T, 4) that turn the neutral facing into the facing of each frame."""
    return quaternion.exp(heading(positions, body)[:, None] * body.up)


def hips_frame(motion: Motion, body: Body, *, steady: bool = False) -> Array:
    """Return the rotations (T, 4) from the frame that turns with the heading to that of the hips' parent.

    ``local = frame * free``: multiply the hips' local rotations by the conjugate to free them of the
    heading (and of any joints above them), by the frame to put it back. ``steady`` leaves out of the
    heading what is faster than 3 Hz: a jerk of the hips that the spine takes back is no turn.
    """
    roles, parents = body.roles, motion.skeleton.parents
    joints, turned, positions = chain(motion, [roles["left_hip"], roles["right_hip"]])
    left, right = (positions[:, joints.index(roles[f"{side}_hip"])] for side in ("left", "right"))
    yaw = _yaw(left - right, body)
    if steady:
        yaw = smooth(yaw, sigma=STEADY / motion.frame_time)
    frame = quaternion.exp(yaw[:, None] * body.up)
    above = int(parents[roles["hips"]])
    if above < 0:
        return frame
    return quaternion.multiply(quaternion.conjugate(turned[:, joints.index(above)]), frame)


def heading_free(motion: Motion, body: Body, *, steady: bool = False) -> tuple[Array, Array]:
    """Return the local rotations (T, J, 4) with the hips' free of the heading, and the ``hips_frame``."""
    frame, hips = hips_frame(motion, body, steady=steady), body.roles["hips"]
    rotations = np.array(motion.rotations)
    rotations[:, hips] = quaternion.multiply(quaternion.conjugate(frame), rotations[:, hips])
    return rotations, frame


def _yaw(side: Array, body: Body) -> Array:
    facing = np.cross(side, body.up)
    return np.unwrap(np.arctan2(facing @ np.cross(body.up, body.forward), facing @ body.forward))
