"""Laban's four Effort factors of the whole body, from its moving masses: Weight, Time, Space and Flow.

C. Larboulette & S. Gibet, *A review of computable expressive descriptors of human motion*, MOCO 2015, with
the segment masses of de Leva (1996) as weights. Lengths are divided by the standing height and masses by the
body's, so that people of any size can be compared; derivatives are per second after a low-pass at 6 Hz.

Space is told as directness, the inverse of their quotient of way and displacement: theirs grows beyond all
bounds where a limb comes back to where it was.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..errors import MienError
from ..kinematics.body import Body
from ..kinematics.fk import world
from ..kinematics.lead_in import still_before
from ..kinematics.mass import mass_model
from ..motion import Motion, require_motion
from ..signal.derivatives import derivatives
from ..typing import Array
from .windows import STRIDE, around, window_frames, window_starts, windowed

# Name -> what it is told by, and its unit; the order of the columns. Low to high: light to strong, sustained
# to sudden, indirect to direct, bound to free.
EFFORT: Mapping[str, tuple[str, str]] = {
    "weight": ("kinetic energy", "heights^2/s^2"),
    "time": ("acceleration", "heights/s^2"),
    "space": ("directness", "share"),
    "flow": ("jerk", "heights/s^3"),
}
_STILL = 1e-9  # heights: a shorter way is none


@dataclass(frozen=True, eq=False)
class Effort:
    """The Effort factors of one motion, all finite.

    ``times`` (T,) in seconds, without a T-pose at the start. ``frames`` (T, 4) in the order of ``EFFORT``:
    ``weight = sum m_i |v_i|^2 / 2``, ``time = sum m_i |a_i|`` and ``flow = sum m_i |jerk_i|`` of the frame,
    and ``space = sum m_i |displacement_i| / sum m_i way_i`` of the window of 1.17 s around it, 0 to 1, 1 for
    a body at rest. ``clip`` (4,): mean over all windows. ``frame_time`` in seconds.
    """

    times: Array
    frames: Array
    clip: Array
    frame_time: float

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the four factors, in order."""
        return tuple(EFFORT)

    def windows(self, *, stride: float = STRIDE) -> Array:
        """Return the factors (W, 4) of windows of 1.17 s, ``stride`` seconds apart.

        The largest ``weight``, the mean ``time`` and ``flow`` as in the paper, the window's own ``space``.
        Raises ``MienError`` for a stride that is not above 0.

        >>> from mien.samples import walk
        >>> effort(walk(seconds=2.0).motion).windows(stride=0.25).shape
        (4, 4)
        """
        if not (np.isfinite(stride) and stride > 0):
            raise MienError(f"stride must be above 0 seconds, got {stride}")
        return _of_windows(self.frames, self.frame_time, stride)


def effort(motion: Motion, *, body: Body | None = None) -> Effort:
    """Return the Effort factors of a motion (Larboulette & Gibet 2015).

    ``body`` saves or overrides the search for one. Raises ``BodyError`` if the skeleton is no humanoid.

    >>> from mien.samples import still, walk
    >>> bool(effort(walk(seconds=2.0).motion).clip[0] > effort(still(seconds=2.0).motion).clip[0])
    True
    """
    motion = require_motion(motion)
    body = body or Body.of(motion)
    start = still_before(motion)
    motion = motion[start:]
    model = mass_model(motion, body)
    centres = model.centres(*world(motion)) / body.height
    smooth, velocity, acceleration, jerk = derivatives(centres, motion.frame_time, orders=(0, 1, 2, 3))
    speed = _length(velocity)
    frames = np.stack(
        [
            0.5 * speed**2 @ model.shares,
            _length(acceleration) @ model.shares,
            _directness(smooth, speed, model.shares, motion.frame_time),
            _length(jerk) @ model.shares,
        ],
        axis=1,
    )
    clip = _of_windows(frames, motion.frame_time, STRIDE).mean(axis=0)
    for array in (frames, clip):
        array.setflags(write=False)
    return Effort(start * motion.frame_time + motion.times, frames, clip, motion.frame_time)


def _directness(points: Array, speed: Array, shares: Array, frame_time: float) -> Array:
    """Return displacement over way (T,) in the window around each frame: points (T, S, 3), speed (T, S)."""
    count = len(points)
    first = around(count, window_frames(count, frame_time))
    last = first + window_frames(count, frame_time) - 1
    steps = 0.5 * (speed[1:] + speed[:-1]) @ shares * frame_time
    way = np.concatenate([[0.0], np.cumsum(steps)])
    gone = _length(points[last] - points[first]) @ shares
    whole = way[last] - way[first]
    return np.where(whole > _STILL, np.minimum(gone / np.maximum(whole, _STILL), 1.0), 1.0)


def _length(vectors: Array) -> Array:
    return np.sqrt(np.einsum("...i,...i->...", vectors, vectors))


def _of_windows(frames: Array, frame_time: float, stride: float) -> Array:
    length = window_frames(len(frames), frame_time)
    starts = window_starts(len(frames), length, frame_time, stride=stride)
    values = windowed(frames, starts, length)
    mean = values.mean(axis=-1)
    space = frames[starts + length // 2, 2]
    return np.stack([values[:, 0].max(axis=-1), mean[:, 1], space, mean[:, 3]], axis=1)
