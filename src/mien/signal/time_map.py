"""Maps of time: at which moment of the source each moment of the result is.

Förger 2011, section 3.4.3. Each 10 ms of the source gets a duration; their sum is the time map, cut into
segments that keep their own length. All curves here have one value for each 10 ms (about: a whole number
of steps fills the clip) and lie on axis 0; with ``wrap`` they are one round of a loop.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ..typing import Array, Integers, Mask
from .multiresolution import smooth

RATE = 100.0
# The thesis's set of frames, 0.15 s: the shortest distance of two pauses and the length of one.
SET = 15
PROMINENCE = 0.8
FACTOR = 10.0
# Low-passed to 12.5 Hz (nominal), as the highest frequencies of speed are noise.
LEVEL = 2
# Steps over which the correction from segment to segment is smoothed.
BLUR = 5
# Steps of 10 ms over which durations are smoothed; more would slow the ends of even movements.
BLUR_ACCELERATED, BLUR_EVEN = 5, 3
SEGMENT_ACCELERATED, SEGMENT_EVEN = 0.9, 1.5

Mode = Literal["peaks", "grid"]


@dataclass(frozen=True)
class Rule:
    """How durations come from speeds.

    ``acceleration`` from -1 (constant speed) to 1 (added acceleration); ``mode`` as in ``short_pauses``;
    with ``rests`` whatever is still counts as a pause; ``segment`` seconds at most keep their length
    (None: 0.9 accelerated, 1.5 even); nothing runs more than ``steepest`` times as fast as it did.
    """

    acceleration: float
    mode: Mode = "peaks"
    rests: bool = False
    segment: float | None = None
    steepest: float = 2.5

    @property
    def longest(self) -> float:
        """The longest segment in seconds."""
        return self.segment or (SEGMENT_ACCELERATED if self.acceleration > 0.0 else SEGMENT_EVEN)


def speed_curve(points: Array, frame_time: float, *, wrap: bool = False) -> tuple[Array, float]:
    """Return the speed (N,) along the path of ``points (T, 3)`` a second, low-passed, and its time step.

    With ``wrap`` the path goes on from the last point to the first.
    """
    path = np.concatenate([points, points[:1]]) if wrap else points
    steps = np.linalg.norm(np.diff(path, axis=0), axis=-1)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    times = np.arange(len(path)) * frame_time
    count = max(round(times[-1] * RATE), 1)
    grid = np.linspace(0.0, times[-1], count + 1)
    step = float(times[-1]) / count if times[-1] else 1.0 / RATE
    return smooth(np.diff(np.interp(grid, times, length)) / step, LEVEL, wrap=wrap), step


def durations(speed: Array, still: float, borders: Integers, rule: Rule, *, wrap: bool = False) -> Array:
    """Return how long each step lasts (N,), 1 on average in every segment, by a rule.

    ``speed (N,)`` below ``still`` is rest. Above 0, ``1 + 9 a`` in pauses; below 0, ``1 + |a| (s / mean s
    - 1)`` where something moves.
    """
    a = rule.acceleration
    if a > 0.0:
        pauses = short_pauses(speed, still, mode=rule.mode, wrap=wrap)
        pauses = np.maximum(pauses, speed < still) if rule.rests else pauses
        raw, width = 1.0 + (FACTOR - 1.0) * a * pauses, BLUR_ACCELERATED
    else:
        even = constant_speed(speed, speed < still, borders)
        raw, width = 1.0 - a * (even - 1.0), BLUR_EVEN
    smooth_ones = blur(raw, width=width, wrap=wrap)
    return balance(smooth_ones, borders, steepest=rule.steepest, wrap=wrap)


def constant_speed(speed: Array, pause: Mask, borders: Integers) -> Array:
    """Return durations (N,) in proportion to speed, so that what moves moves evenly (equations 4 to 6).

    Where ``pause`` the duration is 1, so that a pause stays one; the rest of each segment is shared.
    """
    out = np.ones(len(speed))
    for a, b in pairwise(borders):
        moving = a + np.flatnonzero(~pause[a:b])
        total = speed[moving].sum()
        if total > 0.0:
            out[moving] = speed[moving] * len(moving) / total
    return out


def short_pauses(speed: Array, still: float, *, mode: Mode = "peaks", wrap: bool = False) -> Array:
    """Return 1 where a short pause lies and 0 elsewhere (N,) (equation 7).

    A pause is a set of 15 steps whose mean speed is below 0.8 times that of the sets before and after,
    and whose greatest speed is above ``still``: long rests are left alone. ``grid`` looks at
    consecutive sets from the start, ``peaks`` at those around the minima of the mean over 15 steps.
    """
    if len(speed) < 3 * SET:
        return np.zeros(len(speed))
    return _grid_pauses(speed, still, wrap) if mode == "grid" else _peak_pauses(speed, still, wrap)


def segment_borders(speed: Array, longest: float) -> Integers:
    """Return where segments of at most ``longest`` steps begin and end, with 0 and N.

    Each but a single one lasts at least half of that, and ends where ``speed`` is lowest.
    """
    reach = max(int(longest), 2)
    half = reach // 2
    out = [0]
    while len(speed) - out[-1] > reach:
        start = out[-1] + half
        end = min(out[-1] + reach, len(speed) - half) + 1
        out.append(start + int(np.argmin(speed[start:end])))
    return np.array([*out, len(speed)])


def balance(durations: Array, borders: Integers, *, steepest: float, wrap: bool = False) -> Array:
    """Return durations whose mean is 1 in every segment and that are nowhere below ``1 / steepest``.

    The correction goes smoothly from segment to segment, as far as that can be.
    """
    least = 1.0 / steepest
    for _ in range(12):
        durations = durations * blur(1.0 / _segment_means(durations, borders), width=BLUR, wrap=wrap)
        durations = np.maximum(durations, least)
    spare = durations - least
    means = _segment_means(spare, borders)
    return np.where(means > 0.0, least + spare * (1.0 - least) / np.where(means > 0.0, means, 1.0), 1.0)


def blur(values: Array, *, width: int, wrap: bool = False) -> Array:
    """Return the mean over ``width`` (odd) steps around each; beyond the ends the last value holds."""
    half = width // 2
    wide = np.pad(values, half, mode="wrap" if wrap else "edge")
    return sliding_window_view(wide, width).mean(axis=-1)


def source_times(durations: Array, step: float, at: Array) -> Array:
    """Return the source moments shown at the moments ``at``, both in seconds: the inverse of the sum."""
    shown = np.concatenate([[0.0], np.cumsum(durations)]) * step
    return np.interp(at, shown * (len(durations) * step / shown[-1]), np.arange(len(shown)) * step)


def between(at: Array, frames: int, *, wrap: bool = False) -> tuple[Integers, Integers, Array]:
    """Return the frames before and after the moments ``at`` (in frames), and how far they are in between.

    Moments beyond the ends of the ``frames`` are the first and last one, or with ``wrap`` start over.
    """
    here = np.floor(at).astype(np.int64)
    weight = at - here
    if wrap:
        return here % frames, (here + 1) % frames, weight
    return np.clip(here, 0, frames - 1), np.clip(here + 1, 0, frames - 1), weight


def _segment_means(values: Array, borders: Integers) -> Array:
    counts = np.diff(borders)
    return np.repeat(np.add.reduceat(values, borders[:-1]) / counts, counts)


def _grid_pauses(speed: Array, still: float, wrap: bool) -> Array:
    sets = speed[: len(speed) // SET * SET].reshape(-1, SET)
    mean = sets.mean(axis=1)
    around = np.pad(mean, 1, mode="wrap") if wrap else np.pad(mean, 1, constant_values=-np.inf)
    hit = (mean < PROMINENCE * np.minimum(around[:-2], around[2:])) & (sets.max(axis=1) > still)
    out = np.zeros(len(speed))
    out[: sets.size] = np.repeat(hit, SET)
    return out


def _peak_pauses(speed: Array, still: float, wrap: bool) -> Array:
    mean = blur(speed, width=SET, wrap=wrap)
    around = np.pad(mean, SET, mode="wrap") if wrap else np.pad(mean, SET, constant_values=-np.inf)
    windows = sliding_window_view(around, 2 * SET + 1)
    lowest = np.where(np.isfinite(windows), windows, np.inf)[:, 1:-1].min(axis=1)
    half = SET // 2
    fastest = sliding_window_view(np.pad(speed, half, mode="wrap" if wrap else "edge"), SET).max(axis=1)
    hit = (
        (mean == lowest) & (mean < PROMINENCE * np.minimum(windows[:, 0], windows[:, -1])) & (fastest > still)
    )
    out = np.zeros(len(speed))
    for at in np.flatnonzero(hit):
        out[np.arange(at - half, at + half + 1) % len(out)] = 1.0
    return out
