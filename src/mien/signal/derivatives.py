"""Speed, acceleration and jerk of sampled curves, low-passed, the same at any rate. Frames on axis 0.

Differences between neighbouring frames depend on the frame rate: a hand that goes to and fro three times a
second seems 7 % slower at 30 frames a second than it is. Here the curve is written as the line between its
ends and a series of sines, which is low-passed and differentiated term by term.
"""

from collections.abc import Sequence

import numpy as np

from ..typing import Array

CUTOFF = 6.0  # Hz: the usual one before captured positions are differentiated twice (Winter 2009)


def derivatives(
    values: Array, frame_time: float, *, orders: Sequence[int] = (1, 2, 3), cutoff: float = CUTOFF
) -> list[Array]:
    """Return the derivatives of ``values`` (T, ...) of each order, each (T, ...) per second^order.

    ``x(t) = line + sum_k b_k sin(w_k t)`` with ``w_k = pi k / duration`` goes through the gain
    ``exp(-(w s)^2 / 2)``, which halves what is at ``cutoff`` Hz; order 0 is the smoothed curve. The series
    goes on beyond the ends by point reflection, so ends, straight lines and constant speeds stay as they
    are, and the acceleration is 0 at the first and last frame. One frame does not move.

    >>> derivatives(np.array([0.0, 1.0, 2.0, 3.0]), 0.5, orders=[1])[0].tolist()
    [2.0, 2.0, 2.0, 2.0]
    """
    from scipy.fft import dst

    count = len(values)
    flat = np.asarray(values, np.float64).reshape(count, -1)
    span = max(count - 1, 1)
    slope = (flat[-1] - flat[0]) / span
    line = flat[0] + np.arange(count)[:, None] * slope
    waves = dst((flat - line)[1:-1], type=1, axis=0) / span if count > 2 else flat[:0]
    omega = (np.pi / (span * frame_time)) * np.arange(1, len(waves) + 1)[:, None]
    sigma = np.sqrt(2.0 * np.log(2.0)) / (2.0 * np.pi * cutoff)
    waves = waves * np.exp(-0.5 * (omega * sigma) ** 2)
    straight = {0: line, 1: slope / frame_time}
    return [
        (straight.get(order, 0.0) + _series(waves * omega**order, order, count)).reshape(np.shape(values))
        for order in orders
    ]


def _series(waves: Array, order: int, count: int) -> Array:
    """Return the ``order``-th derivative (T, C) of the sines whose amplitudes times w^order are ``waves``."""
    from scipy.fft import dct, dst

    out = np.zeros((count, waves.shape[1]))
    if len(waves) == 0:
        return out
    sign = -0.5 if order % 4 in (2, 3) else 0.5
    if order % 2:
        out[1:-1] = waves
        return sign * dct(out, type=1, axis=0)
    out[1:-1] = sign * dst(waves, type=1, axis=0)
    return out
