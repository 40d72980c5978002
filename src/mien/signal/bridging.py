"""Fill gaps of a signal, and lie smoothly over what it must not go below. Frames on axis 0."""

import numpy as np

from ..typing import Array, Integers, Mask


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

    Where a gap is longer than ``2 reach`` frames, or at an end of the clip, the values fade towards zero
    within ``reach`` frames of the known side and back again.
    """
    flat = np.where(known[:, None], values.reshape(len(values), -1), 0.0)
    at = np.flatnonzero(known)
    gap = np.flatnonzero(~known)
    if len(at) and len(gap):
        place = np.searchsorted(at, gap)
        before, after = np.r_[-1, at][place], np.r_[at, len(values)][place]
        has_before, has_after = before >= 0, after < len(values)
        joined = has_before & has_after & (after - before <= 2 * reach)
        slope = np.diff(flat, axis=0, prepend=flat[:1]) * (known & np.r_[False, known[:-1]])[:, None]
        ahead = np.diff(flat, axis=0, append=flat[-1:]) * (known & np.r_[known[1:], False])[:, None]
        _join(flat, gap[joined], before[joined], after[joined], slope, ahead)
        longest = max(reach, 1)
        left = has_before & ~joined & (gap - before < longest)
        right = has_after & ~joined & (after - gap < longest)
        _fade(flat, gap[left], before[left], longest, slope)
        _fade(flat, gap[right], after[right], longest, -ahead)
    return flat.reshape(values.shape)


def _join(out: Array, frames: Integers, a: Integers, b: Integers, slope: Array, ahead: Array) -> None:
    """In place: fill ``frames`` with the cubic from each ``a`` to each ``b`` and their slopes."""
    length = (b - a)[:, None]
    s = (frames - a)[:, None] / length
    square, cube = s * s, s * s * s
    bends = (cube - 2 * square + s) * length * slope[a] + (cube - square) * length * ahead[b]
    out[frames] = (2 * cube - 3 * square + 1) * out[a] + (3 * square - 2 * cube) * out[b] + bends


def _fade(out: Array, frames: Integers, edge: Integers, length: int, slope: Array) -> None:
    """In place: add what each ``edge`` leaves on ``frames`` while it dies out over ``length`` frames."""
    s = (np.abs(frames - edge) / length)[:, None]
    square, cube = s * s, s * s * s
    bend = (cube - 2 * square + s) * length * slope[edge]
    out[frames] += (2 * cube - 3 * square + 1) * out[edge] + bend


def nearness(known: Mask, *, reach: float) -> Array:
    """Return 1 (T,) where ``known``, falling to 0 over ``reach`` frames to both sides without a corner."""
    from scipy.ndimage import distance_transform_edt

    if known.all() or not known.any():
        return known.astype(float)
    share = np.clip(distance_transform_edt(~known) / max(reach, 1e-9), 0.0, 1.0)
    return np.asarray(1.0 - share * share * (3.0 - 2.0 * share))


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
