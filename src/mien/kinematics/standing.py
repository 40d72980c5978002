"""How much a body stands: both feet on the floor, and no step near."""

import numpy as np

from ..signal.waveshaping import smooth_step
from ..typing import Array, Mask

STEP, STILL = 0.2, 0.9  # seconds from the nearest step: to there none of it stands, from there on all


def standing(planted: Mask, frame_time: float) -> Array:
    """Return how much (T,) of a standing it is, from whether each foot is planted (T, 2): 0 to 1, smooth.

    1 where no foot is lifted within 0.9 s before or after, 0 within 0.2 s of one that is.
    """
    from scipy.ndimage import distance_transform_edt

    both = np.asarray(planted.all(axis=1))
    if both.all():
        return np.ones(len(both))
    return smooth_step(distance_transform_edt(both) * frame_time, STEP, STILL)
