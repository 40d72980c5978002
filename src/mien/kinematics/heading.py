"""Which way a body faces over time, and the frame that turns with it.

Heading is the yaw of the line from the right to the left hip about the up axis: steadier than any
Euler angle of the hips (METHODS F3).
"""

import numpy as np

from ..rotations import quaternion
from ..typing import Array
from .body import Body


def heading(positions: Array, body: Body) -> Array:
    """Return the yaw (T,) in radians about ``body.up`` from ``body.forward``, without jumps in time."""
    side = positions[:, body.roles["left_hip"]] - positions[:, body.roles["right_hip"]]
    facing = np.cross(side, body.up)
    return np.unwrap(np.arctan2(facing @ np.cross(body.up, body.forward), facing @ body.forward))


def heading_rotation(positions: Array, body: Body) -> Array:
    """Return the rotations (T, 4) that turn the neutral facing into the facing of each frame."""
    return quaternion.exp(heading(positions, body)[:, None] * body.up)
