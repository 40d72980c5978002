"""Joint rotations without what is fast in them: the mean they go around; the movement without its noise."""

from functools import partial

import numpy as np

from ..rotations import quaternion
from ..signal import multiresolution
from ..signal.bridging import smooth
from ..typing import Array

_LOW, _LOW_AND_MID = (multiresolution.three_bands(*gains) for gains in ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0)))


def slow_mean(rotations: Array, fps: float, *, frames: int) -> tuple[Array, Array]:
    """Return the mean rotations (T, J, 4) around each frame, and how clear they are (T, J).

    ``rotations`` (T, J, 4), sign-continuous, go through the low-pass of ``path_length``: below 1 Hz
    (nominal; half amplitude at 0.5 Hz). ``frames`` is the length of one round of a loop (``loops.period``),
    or 0 where the ends are held. Clear is 1 where a joint keeps still and near 0 where it goes round and
    round, so that its mean says nothing.
    """
    once = rotations[: frames or None]
    smooth = _filtered(once, fps, _LOW, wrap=frames > 0)
    smooth = np.concatenate([smooth, smooth[: len(rotations) - len(once)]])
    return quaternion.normalise(smooth), np.sqrt(np.einsum("tji,tji->tj", smooth, smooth))


def without_fine(rotations: Array, fps: float) -> Array:
    """Return sign-continuous ``rotations`` (T, J, 4) below 12.5 Hz (nominal; half amplitude at 8.2 Hz)."""
    return quaternion.normalise(_filtered(rotations, fps, _LOW_AND_MID, wrap=False))


def calm_change(before: Array, after: Array, *, sigma: float) -> Array:
    """Return the rotations ``before`` (T, J, 4) with their change to ``after`` averaged over time.

    With a Gaussian of ``sigma`` frames, so that short changes get smaller as they get smoother.
    """
    change = quaternion.log(quaternion.multiply(quaternion.conjugate(before), after))
    calm = quaternion.exp(smooth(change, sigma=sigma))
    return quaternion.continuous(quaternion.multiply(before, calm))


def _filtered(rotations: Array, fps: float, gains: tuple[float, ...], *, wrap: bool) -> Array:
    response = partial(multiresolution.reference_response, gains=gains)
    support = multiresolution.REFERENCE_SUPPORT
    return multiresolution.regain(rotations, fps, response, support=support, wrap=wrap)
