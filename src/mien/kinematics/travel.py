"""The way that a body travels over the ground, without the sway and surge of its steps."""

import numpy as np

from ..typing import Array

CUTOFF = 0.5  # Hz: below a stride (about 0.9 Hz), whose sway stays, and above a change of course


def slow_path(places: Array, up: Array, fps: float) -> Array:
    """Return the smooth path over the ground (T, 3) of ``places`` (T, 3): ``(1 + k D'D) z = x``.

    ``D`` are second differences (Whittaker 1923); the response is ``1 / (1 + (f / 0.5)^4)``. A straight way
    at a steady speed is its own path, whatever its length.
    """
    from scipy.linalg import solveh_banded

    x = places - (places @ up)[:, None] * up
    if len(x) < 3:
        return x
    stiffness = (fps / (2.0 * np.pi * CUTOFF)) ** 4
    # The three diagonals of D'D: rows of 1 -2 1 overlap, less of them at the ends.
    bands = np.zeros((3, len(x)))
    for i, a in enumerate((1.0, -2.0, 1.0)):
        for j, b in enumerate((1.0, -2.0, 1.0)):
            if j >= i:
                bands[2 - (j - i), j : len(x) - 2 + j] += stiffness * a * b
    bands[2] += 1.0
    # A straight line is its own answer; taking it out first keeps its last digits.
    line = x[0] + (x[-1] - x[0]) * np.linspace(0.0, 1.0, len(x))[:, None]
    z: Array = line + solveh_banded(bands, x - line)
    return z
