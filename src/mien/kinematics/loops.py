"""Whether a clip is a loop: its last pose goes on to its first."""

from typing import Literal

import numpy as np

from ..rotations import quaternion
from ..typing import Array

# What lies beyond the ends of a clip: its other end if it is a loop, the held pose, or its other end.
Boundary = Literal["auto", "hold", "wrap"]

SHORTEST = 8
# In root mean square steps from frame to frame: how near the last pose is to the first to be its
# repetition, and how rough the seam of any other loop may be.
SAME_POSE, SMOOTH = 0.25, 1.1
# How much rougher than the roughest place inside the seam may be.
ROUGHER = 1.2


def period(rotations: Array, boundary: Boundary) -> int:
    """Return the frames of one round of a motion as ``boundary`` wants it, 0 where the ends are held.

    ``rotations`` as for ``loop_length``. ``wrap`` takes what does not look like a loop for one round.
    """
    if boundary == "hold":
        return 0
    return loop_length(rotations) or (len(rotations) if boundary == "wrap" else 0)


def loop_length(rotations: Array) -> int:
    """Return the frames of one round of a looping motion ``(T, J, 4)``, or 0 where it does not loop.

    T - 1 where the last frame repeats the first, T where the first follows the last. A loop goes on over
    its seam about as smoothly as inside. The rotations must be free of heading, so that a walk that
    turns may loop.
    """
    frames = len(rotations)
    if frames < SHORTEST:
        return 0
    q = quaternion.continuous(np.concatenate([rotations, rotations[:2]]))
    step = _size(np.diff(q[:frames], axis=0)).mean() + 1e-9
    inside = _size(np.diff(q[:frames], n=2, axis=0)).max() + 1e-9
    if _size(q[frames : frames + 1] - q[frames - 1 : frames])[0] <= SAME_POSE * step:
        closed = quaternion.continuous(np.concatenate([q[frames - 3 : frames - 1], q[:2]]))
        if _size(np.diff(closed, n=2, axis=0)).max() <= ROUGHER * inside:
            return frames - 1
    seam = _size(np.diff(q[frames - 2 :], n=2, axis=0)).max()
    return frames if seam <= min(SMOOTH * step, ROUGHER * inside) else 0


def _size(differences: Array) -> Array:
    """Return the root mean square over the joints of differences of quaternions, for each frame."""
    size: Array = np.sqrt(np.einsum("tji,tji->t", differences, differences) / differences.shape[1])
    return size
