"""Whether a joint, or the whole body, jumps from one frame to the next.

How far each joint is from half way between its neighbours in time, less twice what is usual around: a jump or
a single wrong frame stands out, fast movement does not. Rotations count by what they do at the end of a
segment of a quarter leg length, so that twists count too.
"""

import numpy as np

from ...rotations import quaternion
from ...typing import Array
from .check import Check, Measured
from .scene import Scene

LEVER = 0.25  # leg lengths
AROUND = 0.12  # seconds to either side


def measure(scene: Scene) -> Measured:
    """Return how far each joint jumps (T, R), in centimetres."""
    roles = dict(scene.body.roles)
    joints = list(roles.values())
    turned = LEVER * scene.body.leg_length * _bend(scene.motion.rotations[:, joints])
    hips = roles["hips"]
    moved = _half_way(scene.positions[:, [hips]])
    off = np.concatenate([turned, moved], axis=1)
    values = np.maximum(off - 2.0 * _usual(off, scene.motion.frame_time), 0.0)
    return Measured(values * scene.centimetres, (*roles, "place"))


def _bend(rotations: Array) -> Array:
    """Return the angle (T, J) between each rotation and the one half way between its neighbours."""
    out = np.zeros(rotations.shape[:2])
    if len(rotations) > 2:
        middle = quaternion.normalise(rotations[2:] + rotations[:-2])
        same = np.abs(np.einsum("tji,tji->tj", middle, rotations[1:-1]))
        out[1:-1] = 2.0 * np.arccos(np.minimum(same, 1.0))
    return out


def _half_way(places: Array) -> Array:
    out = np.zeros(places.shape[:2])
    if len(places) > 2:
        out[1:-1] = np.linalg.norm(places[1:-1] - 0.5 * (places[2:] + places[:-2]), axis=-1)
    return out


def _usual(values: Array, dt: float) -> Array:
    """Return the median of each column around each frame."""
    from scipy.ndimage import median_filter

    width = min(2 * max(2, round(AROUND / dt)) + 1, max(1, len(values) // 2 * 2 - 1))
    return median_filter(values, size=(width, 1), mode="nearest")


CHECK = Check(
    "popping",
    "jumps between frames",
    "cm",
    1,
    limit=6.0,
    tolerance=1.5,
    measure=measure,
    share=0.02,
    lasting=0.0,
)
