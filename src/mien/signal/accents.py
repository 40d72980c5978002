"""Maps of time that hurry into given moments, and pay for it in the stretch before.

An accent is a stretch of time. Its last part runs faster (or slower), what comes before runs slower (or
faster), and outside of it nothing changes: time runs at its own pace there, and goes over into the accent
without a corner. All times are in one unit, whichever.
"""

import numpy as np

from ..typing import Array

# No more than half of an accent is hurried, so that what pays for it need not go further from its pace.
MOST = 0.5


def accented(times: Array, accents: Array, *, pace: float, length: float) -> Array:
    """Return the moments of the source (T,) shown at ``times`` (T,), with an accent in each row (N, 2).

    With ``f`` the ``length`` of the source to hurry, at most half of the accent,
    ``P = (pace - 1) f / length``, as little time needs a gentler pace, ``F = f / (1 + P / 2)`` and
    ``Q = P F / (end - start - F)``::

        u'(t) = 1 + P sin^2(pi (t - end + F) / F)                in the last F
        u'(t) = 1 - Q sin^2(pi (t - start) / (end - start - F))  before

    so that ``u`` is the time itself at both ends, and its slope between ``1 / pace`` and ``pace`` (above 0).
    Accents must not overlap; outside them ``times`` come back unchanged.
    """
    out = np.array(times, float)
    for start, end in accents:
        inside = (times > start) & (times < end)
        span = end - start
        source = min(length, MOST * span)
        gain = (pace - 1.0) * source / length
        hurried = source / (1.0 + 0.5 * gain)
        before = gain * hurried / (span - hurried)
        at = out[inside]
        turn = end - hurried
        out[inside] = at + gain * _bell(at, turn, end) - before * _bell(at, start, turn)
    return out


def _bell(at: Array, start: float, end: float) -> Array:
    """Return the integral up to ``at`` of ``sin^2`` over one arch from ``start`` to ``end``."""
    share = np.clip((at - start) / (end - start), 0.0, 1.0)
    area: Array = 0.5 * (end - start) * (share - np.sin(2.0 * np.pi * share) / (2.0 * np.pi))
    return area
