"""A motion at other moments than its own frames."""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.sampling import spline
from ..typing import Array
from .lead_in import lead_in


def sampled(motion: Motion, at: Array, *, frame_time: float) -> Motion:
    """Return the motion at the moments ``at`` (M,), in frames, shown ``frame_time`` seconds apart.

    Rotations and moving translations follow cubic splines (straight lines between two frames, and in the rush
    from a T-pose before the motion); a translation that never moves keeps its number.
    """
    still = lead_in(motion)
    rotations = quaternion.normalise(_curve(quaternion.continuous(motion.rotations), at, still))
    translations = np.repeat(motion.translations[:1], len(at), axis=0)
    moving = np.ptp(motion.translations, axis=0).any(axis=-1)
    translations[:, moving] = _curve(motion.translations[:, moving], at, still)
    return motion.with_(
        rotations=quaternion.continuous(rotations),
        translations=translations,
        frame_time=frame_time,
        source=None,
    )


def _curve(values: Array, at: Array, still: int) -> Array:
    """Return ``values`` (T, ...) at the moments ``at`` (in frames): straight up to ``still``, then smooth."""
    from scipy.interpolate import make_interp_spline

    out = spline(values[still:], np.maximum(at - still, 0.0))
    before = at < still
    if before.any():
        frames = np.arange(still + 1)
        out[before] = make_interp_spline(frames, values[: still + 1], k=1)(at[before])
    return out
