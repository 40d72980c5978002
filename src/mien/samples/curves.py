"""Smooth curves of time: minimum-jerk moves between keys, and slow deterministic sways."""

from collections.abc import Sequence

import numpy as np

from ..typing import Array

Key = tuple[float, ...]


def keyed(t: Array, keys: Sequence[Key]) -> Array:
    """Return the curve through ``keys`` at the times ``t``, with continuous speed and acceleration.

    A key is ``(time, value[, slope[, acceleration]])``; what is left out is 0. Between two keys
    runs the polynomial of degree five that meets both; from rest to rest that is the minimum-jerk
    profile ``10 u^3 - 15 u^4 + 6 u^5`` of human reaching (Flash & Hogan 1985). Before the first key
    and after the last one the value is held.
    """
    full = np.array([(*key, 0.0, 0.0, 0.0)[:4] for key in keys])
    t = np.clip(t, full[0, 0], full[-1, 0])
    index = np.searchsorted(full[:, 0], t, side="right") - 1
    start, end = full[index], full[np.minimum(index + 1, len(full) - 1)]
    length = np.maximum(end[:, 0] - start[:, 0], 1e-12)
    u = (t - start[:, 0]) / length
    return quintic(u, start[:, 1:] * _powers(length), end[:, 1:] * _powers(length))


def quintic(u: Array, start: Array, end: Array) -> Array:
    """Return the degree-five polynomial on ``u`` in [0, 1].

    ``start`` and ``end`` hold value, first and second derivative with respect to ``u`` on their last axis.
    """
    p, v, a = (start[..., i] for i in range(3))
    gap = end[..., 0] - p - v - 0.5 * a
    slope = end[..., 1] - v - a
    bend = end[..., 2] - a
    c3 = 10.0 * gap - 4.0 * slope + 0.5 * bend
    c4 = -15.0 * gap + 7.0 * slope - bend
    c5 = 6.0 * gap - 3.0 * slope + 0.5 * bend
    return p + u * (v + u * (0.5 * a + u * (c3 + u * (c4 + u * c5))))


def _powers(length: Array) -> Array:
    return np.stack([np.ones_like(length), length, length * length], axis=-1)


def cycle(phase: Array, mean: float, *harmonics: tuple[float, float]) -> Array:
    """Return ``mean + sum_k amplitude_k cos(2 pi k (phase - peak_k))``, phase in cycles."""
    out = np.full_like(phase, mean)
    for k, (amplitude, peak) in enumerate(harmonics, start=1):
        out += amplitude * np.cos(2.0 * np.pi * k * (phase - peak))
    return out
