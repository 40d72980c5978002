"""What a motion expresses as it goes on: its place on the disc, read in windows of a few seconds."""

import numpy as np

from ..kinematics.lead_in import still_before
from ..motion import Motion, require_motion
from ..typing import Array
from .model import EmotionModel
from .reading import read

WINDOW, STRIDE = 2.5, 0.5  # seconds: a few steps; so often


def course(motion: Motion, *, model: EmotionModel | None = None) -> tuple[Array, Array]:
    """Return the times (W,) of windows' middles in seconds and the places (W, 2) read in them.

    An edited motion is compared window by window with what it was made from, any other with how people
    usually are. A motion shorter than a window is one window; windows begin after a still such as a T-pose.
    Raises ``BodyError`` where no body is found.

    >>> from mien.samples import walk
    >>> times, places = course(walk(seconds=4.0).motion)
    >>> places.shape
    (4, 2)
    """
    still = still_before(require_motion(motion))
    motion = motion[still:]
    frames = len(motion)
    length = min(frames, max(round(WINDOW / motion.frame_time), 2))
    stride = max(round(STRIDE / motion.frame_time), 1)
    starts = np.arange(0, frames - length + 1, stride)
    places = [read(motion[start : start + length], model=model).place for start in starts.tolist()]
    return (still + starts + 0.5 * (length - 1)) * motion.frame_time, np.array(places)
