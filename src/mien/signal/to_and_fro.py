"""What goes to and fro about its slow course, of numbers over time. Frames on axis 0."""

import numpy as np

from ..typing import Array
from .bridging import smooth

SLOW, FINE = 0.5, 8.0  # Hz of half amplitude: what is slower is the course, what is faster is noise
_HALF = np.sqrt(0.5 * np.log(2.0)) / np.pi  # sigma times frequency of half amplitude, of a Gaussian
ENDS = 1.0  # seconds whose straight line goes on beyond each end


def to_and_fro(values: Array, frame_time: float, *, frames: int = 0) -> Array:
    """Return ``values`` (T, ...) less their slow course, without noise: 0.5 to 8 Hz (half amplitude).

    Both are Gaussians, so nothing rings. Beyond the ends the straight line of the last second goes on, so
    that what steadily rises, such as the heading of a turn, has no residue there. ``frames`` above 0 is the
    length of one round of a loop (``loops.period``): beyond its ends is the next round.
    """
    values = np.asarray(values, dtype=float)
    pad = int(np.ceil(4.0 * _HALF / SLOW / frame_time)) + 1
    flat = values.reshape(len(values), -1)
    wide = _rounds(flat, frames, pad) if frames else _extended(flat, pad, round(ENDS / frame_time))
    fast, slow = (smooth(wide, sigma=_HALF / edge / frame_time) for edge in (FINE, SLOW))
    return np.asarray((fast - slow)[pad : pad + len(values)].reshape(values.shape))


def _extended(flat: Array, pad: int, last: int) -> Array:
    """Return ``flat`` (T, C) with the straight line through its first and last frames put on at both ends."""
    before, after = -np.arange(pad, 0, -1.0), np.arange(1.0, pad + 1.0)
    some = min(max(last, 1), len(flat))
    start, end = _line(flat[:some]), _line(flat[len(flat) - some :])
    first = start[0] + (before + 0.0)[:, None] * start[1]
    final = end[0] + (some - 1 + after)[:, None] * end[1]
    return np.concatenate([first, flat, final])


def _line(part: Array) -> tuple[Array, Array]:
    """Return where the straight line through ``part`` (T, C) begins, and what it adds a frame."""
    at = np.arange(len(part)) - 0.5 * (len(part) - 1)
    slope = at @ part / max(float(at @ at), 1.0)
    return part.mean(axis=0) + at[0] * slope, slope


def _rounds(flat: Array, frames: int, pad: int) -> Array:
    """Return ``flat`` (T, C) with other rounds around it, each further on by what a round adds."""
    if len(flat) > frames:  # the last frame is the first of the next round
        added = flat[frames] - flat[0]
    else:
        steps = np.diff(flat, axis=0)
        added = flat[-1] - flat[0] + 0.5 * (steps[0] + steps[-1]) if len(steps) else flat[0] * 0.0
    at = np.arange(-pad, len(flat) + pad)
    return flat[at % frames] + (at // frames)[:, None] * added
