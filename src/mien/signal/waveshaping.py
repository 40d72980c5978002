"""Curves through which the size of a movement goes (after Bruderlin & Williams 1995).

Sizes are 0 or more, arrays of any shape. Each curve begins at 0, never falls and has no kink.
"""

import numpy as np

from ..typing import Array


def two_gains(x: Array, *, small: float, large: float, border: float) -> Array:
    """Return sizes that grow by ``small`` where they are small and by ``large`` where they are large.

    ``f(x) = large x + (small - large) border arctan(x / border)``: the slope goes from ``small`` at 0 to
    ``large`` far away, and is half way between them at ``border`` (above 0). So for gains of 0 or more it
    never falls.
    """
    return large * x + (small - large) * border * np.arctan(x / border)


def soft_limit(x: Array, limit: Array | float, softness: Array | float) -> Array:
    """Return sizes that never go beyond ``limit``: unchanged up to ``softness`` before it, then ever slower.

    ``x`` for ``x <= k``, else ``b - s exp(-(x - k) / s)`` with ``b`` the limit, ``s`` the softness (0 to
    ``b``) and ``k = b - s``. With softness 0 the limit is hard.
    """
    knee = np.asarray(limit) - softness
    over = np.maximum(x - knee, 0.0)
    return np.minimum(x, knee) - softness * np.expm1(-over / np.maximum(softness, 1e-300))


def smooth_step(x: Array, low: float, high: float) -> Array:
    """Return 0 up to ``low``, 1 from ``high`` on, and ``3 s^2 - 2 s^3`` between; falls where high < low."""
    s = np.clip((x - low) / (high - low), 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)
