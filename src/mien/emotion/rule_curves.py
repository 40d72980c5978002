"""Coefficients of clusters of poses in time: numbers, or curves where a motion changes clusters."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..curve import Varying, evaluate
from ..typing import Array

BLEND = 0.4  # seconds before and after a motion goes into another cluster
DIGITS = 3
SEEN = 0.01  # of a coefficient: a curve that stays within this is a number


def in_time(stays: Sequence[tuple[float, int]], pose: Array) -> list[Varying]:
    """Return one number or curve for each coefficient of ``pose`` (B, P), by (from when, cluster) ``stays``.

    >>> in_time([(0.0, 0), (2.0, 1)], np.array([[0.9, 1.0], [0.8, 1.0]]))
    [((1.6, 0.9), (2.4, 0.8)), 1.0]
    """
    rounded = np.round(pose, DIGITS)
    found: list[Varying] = []
    for values in rounded.T:
        keys: list[tuple[float, float]] = []
        for (_, before), (time, after) in pairwise(stays):
            if values[before] != values[after]:
                keys.append((round(time - BLEND, DIGITS), float(values[before])))
                keys.append((round(time + BLEND, DIGITS), float(values[after])))
        found.append(tuple(keys) if keys else float(values[stays[0][1]]))
    return found


def through(times: Array, values: Array) -> list[Varying]:
    """Return one number or curve for each column of ``values`` (K, P) at ``times`` (K,), with few keys.

    >>> through(np.arange(4.0), np.array([[0.9], [0.85], [0.8], [0.95]]))
    [((0.0, 0.9), (2.0, 0.8), (3.0, 0.95))]
    """
    found: list[Varying] = []
    for column in np.round(values, DIGITS).T:
        if np.ptp(column) <= SEEN:
            found.append(round(float(column.mean()), DIGITS))
        else:
            kept = _corners(times, column)
            keys = zip(np.round(times[kept], DIGITS).tolist(), column[kept].tolist(), strict=True)
            found.append(tuple((time, value) for time, value in keys))
    return found


def _corners(times: Array, values: Array) -> list[int]:
    """Return the keys without which straight lines would miss others by more than ``SEEN``."""
    kept, open_ = [0, len(times) - 1], [(0, len(times) - 1)]
    while open_:
        a, b = open_.pop()
        line = np.interp(times[a : b + 1], times[[a, b]], values[[a, b]])
        away = np.abs(values[a : b + 1] - line)
        if away.max() > SEEN:
            middle = a + int(away.argmax())
            kept.append(middle)
            open_ += [(a, middle), (middle, b)]
    return sorted(kept)


def at_times(curves: Sequence[Varying], times: Array) -> Array:
    """Return the values (T, P) of curves at ``times`` (T,) in seconds."""
    return np.stack([evaluate(curve, times) for curve in curves], axis=-1)
