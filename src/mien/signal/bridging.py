"""Fill gaps of a signal, and lie smoothly over what it must not go below. Frames on axis 0."""

import numpy as np

from ..typing import Array, Mask


def hold_gaps(values: Array, known: Mask) -> Array:
    """Return ``values`` (T, ...) with gaps filled by straight lines, held beyond the first and last known."""
    if known.all() or not known.any():
        return values
    frames, at = np.arange(len(values)), np.flatnonzero(known)
    flat = values.reshape(len(values), -1)
    out = np.stack([np.interp(frames, at, flat[at, i]) for i in range(flat.shape[1])], axis=1)
    return out.reshape(values.shape)


def curve_gaps(values: Array, known: Mask, *, reach: int) -> Array:
    """Return ``values`` (T, ...) with gaps filled by cubic curves that continue the known slopes.

    Where a gap is longer than ``2 reach`` frames, or at an end of the clip, the values fade to zero
    within ``reach`` frames of the known side and back again.
    """
    out = np.where(known.reshape(-1, *[1] * (values.ndim - 1)), values, 0.0)
    at = np.flatnonzero(known)
    if not len(at):
        return out
    reach = max(reach, 1)
    starts = np.concatenate([[-1], at])
    stops = np.concatenate([at, [len(values)]])
    for a, b in zip(starts, stops, strict=True):
        if b - a > 2 * reach or a < 0 or b == len(values):
            _fade(out, values, known, a, min(a + reach, b), 1)
            _fade(out, values, known, b, max(b - reach, a), -1)
        elif b - a > 1:
            s = (np.arange(1, b - a) / (b - a)).reshape(-1, *[1] * (values.ndim - 1))
            first, last = _slope(values, known, a, -1) * (b - a), _slope(values, known, b, 1) * (b - a)
            out[a + 1 : b] = _hermite(s, values[a], first, values[b], last)
    return out


def _fade(out: Array, values: Array, known: Mask, edge: int, end: int, way: int) -> None:
    """In place: let the value at ``edge`` die out towards ``end`` (not included)."""
    if not 0 <= edge < len(values) or edge == end:
        return
    length = abs(end - edge)
    s = (np.arange(1, length) / length).reshape(-1, *[1] * (values.ndim - 1))
    slope = _slope(values, known, edge, -way) * length * way
    zero = np.zeros_like(values[edge])
    frames = edge + way * np.arange(1, length)
    out[frames] = _hermite(s, values[edge], slope, zero, zero)


def _slope(values: Array, known: Mask, edge: int, way: int) -> Array:
    """Return the change a frame at ``edge``, seen from its known side (``way`` frames further)."""
    other = edge + way
    if not (0 <= other < len(values)) or not known[other]:
        return np.zeros_like(values[edge])
    return (values[other] - values[edge]) * way


def _hermite(s: Array, a: Array, slope_a: Array, b: Array, slope_b: Array) -> Array:
    square, cube = s * s, s * s * s
    return (
        (2 * cube - 3 * square + 1) * a
        + (cube - 2 * square + s) * slope_a
        + (3 * square - 2 * cube) * b
        + (cube - square) * slope_b
    )


def envelope(values: Array, *, reach: int) -> Array:
    """Return a smooth curve (T,) that is nowhere below ``values``: the running maximum, then averaged."""
    from scipy.ndimage import convolve1d, maximum_filter1d

    if reach < 1 or len(values) < 2:
        return values
    bell = np.hanning(2 * reach + 3)[1:-1]
    high = maximum_filter1d(values, 2 * reach + 1, mode="nearest")
    return convolve1d(high, bell / bell.sum(), mode="nearest")


def smooth(values: Array, *, sigma: float) -> Array:
    """Return ``values`` (T, ...) averaged with a Gaussian of ``sigma`` frames.

    The clip is continued by point reflection at its ends, so the first and last value and every
    straight line stay as they are.
    """
    from scipy.ndimage import gaussian_filter1d

    if sigma <= 0 or len(values) < 3:
        return values
    pad = int(4 * sigma) + 1
    around = [(pad, pad)] + [(0, 0)] * (values.ndim - 1)
    wide = np.pad(values, around, mode="reflect", reflect_type="odd")
    return gaussian_filter1d(wide, sigma, axis=0)[pad:-pad]
