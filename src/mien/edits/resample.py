"""Change the frame rate: the same movement, sampled at other moments.

To the motion: new frames lie on a cubic spline through the old ones, so what coincides with an old
frame is that frame, and going up to a multiple of the rate and back gives the clip again. To the
viewer: nothing changes. Nothing is smoothed on the way down: captured bodies hold next to no power
above 10 Hz (Amaya et al. 1996), so frame rates from 24 up do not fold back, and foot strikes stay crisp.
"""

from math import floor
from typing import Annotated

import numpy as np

from ..kinematics.lead_in import lead_in
from ..motion import Motion
from ..rotations import quaternion
from ..signal.sampling import spline
from ..typing import Array
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
    still = lead_in(motion)  # no curve is laid over the jump from a T-pose
    rotations = quaternion.normalise(_spline(quaternion.continuous(motion.rotations), at, still))
    translations = np.repeat(motion.translations[:1], count, axis=0)
    moving = np.ptp(motion.translations, axis=0).any(axis=-1)
    translations[:, moving] = _spline(motion.translations[:, moving], at, still)
    return motion.with_(
        rotations=quaternion.continuous(rotations),
        translations=translations,
        frame_time=1.0 / fps,
        source=None,
    )


def _spline(values: Array, at: Array, still: int) -> Array:
    """Return ``values`` (T, ...) at the moments ``at`` (in frames): straight up to ``still``, then smooth."""
    from scipy.interpolate import make_interp_spline

    out = spline(values[still:], np.maximum(at - still, 0.0))
    before = at < still
    if before.any():
        frames = np.arange(still + 1)
        out[before] = make_interp_spline(frames, values[: still + 1], k=1)(at[before])
    return out
