"""Values between the frames, and maps of time that never run backwards. Frames on axis 0."""

import numpy as np

from ..typing import Array


def spline(values: Array, at: Array) -> Array:
    """Return ``values`` (T, ...) at the moments ``at`` (M,), in frames, on a cubic spline through them.

    Moments beyond the ends take the end; at a whole frame it is that frame. Two frames have a straight line
    between them.
    """
    from scipy.interpolate import CubicSpline

    if len(values) == 1 or not values.size:
        return np.repeat(values[:1], len(at), axis=0)
    whole = np.round(at)
    at = np.clip(np.where(np.abs(at - whole) < 1e-9 * len(values), whole, at), 0, len(values) - 1)
    if (at == np.round(at)).all():
        return values[at.astype(np.int64)]
    return np.asarray(CubicSpline(np.arange(len(values)), values)(at))


def monotone(x: Array, y: Array, at: Array, *, least: float = 0.25) -> Array:
    """Return a smooth rising curve (M, ...) at ``at`` through the knots ``x`` (K,), ``y`` (K, ...).

    Both rise from knot to knot. It is a cubic without overshoot (Fritsch & Carlson 1980) on top of a
    straight line, so that it is nowhere flatter than ``least`` times the mean slope, or than the flattest
    way between two knots if that is less.
    """
    from scipy.interpolate import PchipInterpolator

    if len(x) == 1:
        return np.repeat(y[:1], len(at), axis=0)
    rise = np.diff(y, axis=0) / np.diff(x).reshape(-1, *[1] * (y.ndim - 1))
    slope = np.minimum(least * (y[-1] - y[0]) / (x[-1] - x[0]), rise.min(axis=0))
    at = np.clip(at, x[0], x[-1])
    curve = PchipInterpolator(x, y - np.multiply.outer(x - x[0], slope))
    return np.asarray(curve(at) + np.multiply.outer(at - x[0], slope))
