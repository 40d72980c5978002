"""Noise that is a function of time: seeded, band-limited, the same at whatever moments it is asked for."""

import numpy as np

from ..typing import Array

# With fewer, beats would show; more would look the same.
COMPONENTS = 32


def noise(at: Array, *, low: float, high: float, seed: int, stream: str) -> Array:
    """Return noise (T,) between ``low`` and ``high`` Hz at the moments ``at`` (T,) in seconds.

    ``x(t) = sqrt(2 / N) sum_i cos(2 pi f_i t + p_i)``, ``N = 32``: one frequency at a random place in each of
    ``N`` equal parts of the band, phases random. Over all seeds its mean is 0, its variance 1 and its
    distribution nearly normal: beyond 2 in 4.5 % of the time, beyond 3 in 0.2 %, never beyond
    ``sqrt(2 N) = 8``. Over ``T`` seconds of one seed, mean and variance differ from 0 and 1 by less than
    ``1 / (4 low T)`` and ``1 / sqrt((high - low) T)``, root mean square. It never repeats.

    ``seed`` (0 or more) and ``stream`` choose the noise. Streams of different names know nothing of each
    other, so that another one more changes none. Random bits come from PCG64, the same on every machine.
    """
    name = np.random.SeedSequence(seed, spawn_key=tuple(stream.encode()))
    random = np.random.Generator(np.random.PCG64(name)).random((2, COMPONENTS))
    frequencies = low + (high - low) * (np.arange(COMPONENTS) + random[0]) / COMPONENTS
    angles = 2.0 * np.pi * (np.multiply.outer(at, frequencies) + random[1])
    return np.sqrt(2.0 / COMPONENTS) * np.cos(angles).sum(axis=-1)


def wander(at: Array, *, low: float, high: float, seed: int, stream: str) -> Array:
    """Return a curve (T,) that wanders between about -1 and 1 with the mean 0: ``tanh`` of ``noise``."""
    curve = np.tanh(noise(at, low=low, high=high, seed=seed, stream=stream))
    return np.asarray(curve - curve.mean() if len(curve) else curve)
