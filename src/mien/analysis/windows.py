"""Sliding windows of a fixed number of seconds, whatever the frame rate. Frames on axis 0."""

import numpy as np

from ..typing import Array, Integers

WINDOW = 35.0 / 30.0  # seconds: 35 frames of the 30 Hz of Aristidou et al. (2017)
STRIDE = 5.0 / 30.0  # seconds from one window to the next, a seventh of a window


def window_frames(frames: int, frame_time: float, *, seconds: float = WINDOW) -> int:
    """Return how many of ``frames`` (1 or more) make a window: at least one, at most all of them.

    >>> window_frames(600, 1 / 30), window_frames(600, 1 / 120), window_frames(10, 1 / 30)
    (35, 140, 10)
    """
    return min(frames, max(1, round(seconds / frame_time)))


def window_starts(frames: int, length: int, frame_time: float, *, stride: float = STRIDE) -> Integers:
    """Return the first frame (W,) of each window of ``length`` frames, about ``stride`` seconds apart.

    Evenly spread: the first window starts with the clip and the last one ends with it. At least one.

    >>> window_starts(45, 35, 1 / 30).tolist()
    [0, 5, 10]
    """
    count = round((frames - length) * frame_time / stride) + 1
    return np.unique(np.linspace(0, frames - length, max(count, 1)).round().astype(np.int64))


def windowed(values: Array, starts: Integers, length: int) -> Array:
    """Return the windows (W, ..., length) of ``values`` (T, ...) that begin at ``starts`` (W,)."""
    return np.lib.stride_tricks.sliding_window_view(values, length, axis=0)[starts]


def around(frames: int, length: int) -> Integers:
    """Return for every frame the start (T,) of the window around it, moved to lie within the clip.

    The window that starts at ``s`` is the one around frame ``s + length // 2``.
    """
    return np.clip(np.arange(frames) - length // 2, 0, frames - length)
