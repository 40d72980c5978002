"""Whether a clip is a loop: its last pose goes on to its first."""

from typing import Literal

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .body import Body
from .heading import heading_free

# What lies beyond the ends of a clip: its other end if it is a loop, the held pose, or its other end.
Boundary = Literal["auto", "hold", "wrap"]

# In root mean square steps from frame to frame, over all joints.
SAME_POSE, SAME_SPEED, FOLLOWS = 0.25, 1.5, 0.75
SHORTEST = 8


def period(motion: Motion, body: Body, boundary: Boundary) -> int:
    """Return the frames of one round of a clip as ``boundary`` wants it, 0 where the ends are held.

    ``wrap`` takes a clip that does not look like a loop for one round.
    """
    if boundary == "hold":
        return 0
    below = motion.skeleton.descendants(body.roles["hips"])
    found = loop_length(heading_free(motion, body)[0][:, below])
    return found or (len(motion) if boundary == "wrap" else 0)


def loop_length(rotations: Array) -> int:
    """Return the frames of one round of a looping motion ``(T, J, 4)``, or 0 where it does not loop.

    T - 1 where the last frame repeats the first, T where the first follows the last. The rotations must
    be free of heading, so that a walk that turns may loop.
    """
    frames = len(rotations)
    if frames < SHORTEST:
        return 0
    cosine = np.abs(np.einsum("tji,tji->tj", rotations[1:], rotations[:-1]))
    step = 2.0 * np.sqrt(2.0 * np.maximum(1.0 - cosine, 0.0).mean()) + 1e-6
    first, last, seam = (_turn(rotations[a], rotations[b]) for a, b in ((0, 1), (-2, -1), (-1, 0)))
    if _size(seam) <= SAME_POSE * step and _size(first - last) <= SAME_SPEED * step:
        return frames - 1
    return frames if _size(seam - 0.5 * (first + last)) <= FOLLOWS * step else 0


def _turn(a: Array, b: Array) -> Array:
    return quaternion.log(quaternion.multiply(quaternion.conjugate(a), b))


def _size(turns: Array) -> float:
    return float(np.sqrt((turns**2).sum(axis=-1).mean()))
