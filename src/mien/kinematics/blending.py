"""Go over from one motion to another of the same skeleton and frames, joint by joint and frame by frame."""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array


def blend(before: Motion, after: Motion, weights: Array) -> Motion:
    """Return ``before`` where ``weights`` (T, J) are 0, ``after`` where they are 1, and slerps in between.

    Weight 0 gives the numbers of ``before`` and 1 those of ``after``, exactly. All else is as in ``after``.
    """
    rotations, translations = np.array(before.rotations), np.array(before.translations)
    for joint in np.flatnonzero(weights.any(axis=0)):
        w = weights[:, joint]
        whole, part = w >= 1.0, (w > 0.0) & (w < 1.0)
        rotations[whole, joint] = after.rotations[whole, joint]
        translations[whole, joint] = after.translations[whole, joint]
        if part.any():
            here, there = before.rotations[part, joint], after.rotations[part, joint]
            rotations[part, joint] = quaternion.slerp(here, there, w[part])
            step = after.translations[part, joint] - before.translations[part, joint]
            translations[part, joint] += w[part, None] * step
    return after.with_(rotations=quaternion.continuous(rotations), translations=translations)
