"""Change the frame rate: the same movement, sampled at other moments.

To the motion: new frames lie on a cubic spline through the old ones, so what coincides with an old
frame is that frame, and going up to a multiple of the rate and back gives the clip again. To the
viewer: nothing changes. Nothing is smoothed on the way down: captured bodies hold next to no power
above 10 Hz (Amaya et al. 1996), so frame rates from 24 up do not fold back, and foot strikes stay crisp.
"""

from math import floor
from typing import Annotated

import numpy as np

from ..kinematics.resampling import sampled
from ..motion import Motion
from .registry import Param, edit


@edit(
    kind="time",
    paper="",
    equation="q(t) = s(t) / |s(t)|, s the cubic spline through the sign-continuous quaternions",
)
def resample(
    motion: Motion,
    *,
    fps: Annotated[float | None, Param("new rate; none keeps it", 1e-3, 1e4, "frames a second")] = None,
) -> Motion:
    """Sample the motion at ``fps`` frames a second, from the first frame to at most the last.

    Rotations and moving translations follow cubic splines (straight lines between two frames); a
    translation that never moves keeps its number.
    """
    if fps is None or abs(fps * motion.frame_time - 1.0) < 1e-12:
        return motion
    count = floor(motion.duration * fps + 1e-6) + 1
    at = np.arange(count) / (fps * motion.frame_time)  # in frames of the clip
    whole = np.round(at)
    at = np.where(np.abs(at - whole) < 1e-9 * len(motion), whole, at)
    return sampled(motion, at, frame_time=1.0 / fps)
