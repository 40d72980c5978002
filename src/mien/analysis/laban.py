"""Laban features of a motion: 37 in every frame, 121 of every 1.17 seconds and of the clip.

A. Aristidou, Q. Zeng, E. Stavrakis, K. Yin, D. Cohen-Or, Y. Chrysanthou, B. Chen, *Emotion control of
unstructured dance movements*, SCA 2017, table 1 (see ``laban_table``). The paper names the features; how each
is worked out is said here. Lengths are divided by the body's standing height, derivatives are per second
after a low-pass at 6 Hz: size, unit, place, heading and frame rate of a clip do not matter. A T-pose before
the motion is left out. The scaling to [0, 1] of the paper needs the clips a model was trained on.
"""

from dataclasses import dataclass

import numpy as np

from ..errors import MienError, unknown
from ..kinematics.body import Body
from ..kinematics.landmarks import INDEX, LANDMARKS, LIMB, TRUNK, landmarks
from ..kinematics.lead_in import still_before
from ..motion import Motion, require_motion
from ..signal.derivatives import derivatives
from ..typing import Array, Integers
from .hulls import hull_size, hull_volumes
from .laban_table import DERIVED, FEATURES, SELECTED, ZONES, Derived
from .windows import STRIDE, WINDOW, around, window_frames, window_starts, windowed

BRAKING = 0.5  # heights a second squared: a slower low of the pelvis' speed is no deceleration peak
RATE = 30.0  # frames a second that hulls over time are taken from, about
MOVING = ("pelvis", "left_hand", "right_hand", "left_foot", "right_foot")
_DISTANCES = (
    ("left_foot", "pelvis"),
    ("right_foot", "pelvis"),
    ("left_hand", "left_shoulder"),
    ("right_hand", "right_shoulder"),
    ("left_hand", "right_hand"),
    ("left_hand", "head"),
    ("right_hand", "head"),
    ("left_hand", "pelvis"),
    ("right_hand", "pelvis"),
    ("left_foot", "right_foot"),
    ("left_hand", "chest"),
    ("right_hand", "chest"),
    ("head", "pelvis"),
)
_RIGHT, _LEFT = (tuple(f"{side}_{place}" for place in LIMB) for side in ("right", "left"))
_EFFORT = slice(15, 26)  # the columns of f16 to f26
_LEGS = ("hip", "knee", "foot", "toe")
PACE = (*range(6, 18), 24, 25)  # selected features that say how fast, not which poses
# What the hulls of f27, f28 and f31 to f34 hold.
VOLUMES = (
    ("head", *MOVING[1:]),
    LANDMARKS,
    tuple(n for n in LANDMARKS if n != "pelvis" and n.rpartition("_")[2] not in _LEGS),
    ("pelvis", *(n for n in LANDMARKS if n.rpartition("_")[2] in _LEGS)),
    (*TRUNK, *_RIGHT),
    (*TRUNK, *_LEFT),
)


@dataclass(frozen=True)
class Row:
    """One line of the table of a clip: a derived feature and its ``value``."""

    feature: Derived
    value: float


@dataclass(frozen=True, eq=False)
class Features:
    """The Laban features of one motion, all finite.

    ``times`` (T,) seconds of the frames, without a T-pose at the start. ``frames`` (T, 37): the basic
    features in the order of ``FEATURES``; f15, f35, f36 and f37 are those of the window around the frame.
    ``zones`` (T, 3): the share of the hands above the head, from there down to the chest, and below it.
    ``clip`` (121,): the derived features, mean over all windows. ``frame_time`` in seconds.
    """

    times: Array
    frames: Array
    zones: Array
    clip: Array
    frame_time: float

    def __repr__(self) -> str:
        return f"Features({len(self.times)} frames, {self.times[-1]:.2f} s)"

    def _repr_html_(self) -> str:
        """Return the selected features with bars for notebooks; the front door knows who draws them."""
        import mien

        return mien.render.features_html(self)

    def __getitem__(self, name: str) -> float:
        """Return a derived feature of the clip by its name, such as ``hands_distance_mean``."""
        if name not in self.names:
            raise MienError(unknown("feature", name, self.names))
        return float(self.clip[self.names.index(name)])

    @property
    def names(self) -> tuple[str, ...]:
        """The names (121) of the derived features, in order."""
        return _NAMES

    @property
    def selected(self) -> Array:
        """The selected features (31,) of the clip, in the order of ``SELECTED``."""
        return self.clip[[d.number - 1 for d in SELECTED]]

    def window_times(self, *, stride: float = STRIDE) -> Array:
        """Return the middle (W,) of each of ``windows``, in seconds."""
        length = window_frames(len(self.times), self.frame_time)
        starts = _starts(len(self.times), length, self.frame_time, stride)
        return 0.5 * (self.times[starts] + self.times[starts + length - 1])

    def windows(self, *, stride: float = STRIDE) -> Array:
        """Return the derived features (W, 121) of windows of 1.17 s, ``stride`` seconds apart.

        A clip that is shorter is one window. Raises ``MienError`` for a stride that is not above 0.

        >>> from mien.samples import walk
        >>> features(walk(seconds=2.0).motion).windows(stride=0.25).shape
        (4, 121)
        """
        return _derive(self.frames, self.zones, self.frame_time, stride)

    def table(self) -> tuple[Row, ...]:
        """Return the derived features of the clip, one row each, in the order of their numbers."""
        return tuple(Row(d, float(value)) for d, value in zip(DERIVED, self.clip, strict=True))


_NAMES = tuple(d.name for d in DERIVED)


def features(motion: Motion, *, body: Body | None = None) -> Features:
    """Return the Laban features of a motion (Aristidou et al. 2017, table 1).

    ``body`` saves or overrides the search for one; the body of an edited motion is its original's, so before
    and after are measured alike. Raises ``BodyError`` if the skeleton is no humanoid.

    >>> from mien.samples import walk
    >>> round(features(walk(seconds=3.0).motion)["pelvis_speed_mean"], 2)
    0.73
    """
    motion = require_motion(motion)
    body = body or Body.of(motion)
    start = still_before(motion)
    motion = motion[start:]
    points = landmarks(motion, body).points / body.height
    frames = np.empty((len(motion), len(FEATURES)))
    distances = _distances(points)
    height = points @ body.up - body.floor / body.height
    frames[:, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 13, 28]] = distances
    frames[:, 9] = height[:, INDEX["pelvis"]]
    frames[:, 10] = frames[:, 9] - 0.5 * (frames[:, 0] + frames[:, 1])
    velocity = _fill_effort(frames, points, motion.frame_time)
    frames[:, [26, 27, 30, 31, 32, 33]] = hull_volumes(points, [[INDEX[n] for n in g] for g in VOLUMES])
    zones = _zones(height)
    frames[:, 29] = zones @ [1.0, 0.5, 0.0]
    _fill_space(frames, points, velocity, np.stack([body.left, body.forward]), motion.frame_time)
    frames[:, 36] = _total_volume(points, motion.frame_time)
    clip = _derive(frames, zones, motion.frame_time, STRIDE).mean(axis=0)
    for array in (frames, zones, clip):
        array.setflags(write=False)
    return Features(start * motion.frame_time + motion.times, frames, zones, clip, motion.frame_time)


def pace(points: Array, body: Body, frame_time: float) -> Array:
    """Return the selected features of Effort and Space (14,): those numbered 6 to 17, 24 and 25.

    ``points`` (T, 19, 3) are landmarks in heights of the body. They are what ``features`` finds, without the
    hulls of every frame, which take most of its time.
    """
    return pace_windows(points, body, frame_time).mean(axis=0)


def pace_windows(points: Array, body: Body, frame_time: float, *, stride: float = STRIDE) -> Array:
    """Return the features of ``pace`` for each window of 1.17 s (W, 14), ``stride`` seconds apart."""
    frames = np.zeros((len(points), len(FEATURES)))
    velocity = _fill_effort(frames, points, frame_time)
    ground = np.stack([body.left, body.forward])
    _fill_space(frames, points, velocity, ground, frame_time, stride=stride)
    windows = _derive(frames, np.zeros((len(points), 3)), frame_time, stride)
    return windows[:, [d.number - 1 for d in SELECTED if d.selected in PACE]]


def _distances(points: Array) -> Array:
    """Return the distance (T, 13) between the two places of each pair of ``_DISTANCES``."""
    one, other = (np.array([INDEX[pair[i]] for pair in _DISTANCES]) for i in range(2))
    return _length(points[:, one] - points[:, other])


def _length(vectors: Array) -> Array:
    return np.sqrt(np.einsum("...i,...i->...", vectors, vectors))


def _fill_effort(frames: Array, points: Array, frame_time: float) -> Array:
    """Fill in f15 to f26; return the velocity (T, 3) of the pelvis."""
    moving = points[:, [INDEX[name] for name in MOVING]]
    velocity, acceleration = derivatives(moving, frame_time, orders=(1, 2))
    (jerk,) = derivatives(moving[:, 0], frame_time, orders=(3,))
    frames[:, 15:20] = _length(velocity)
    frames[:, 20:25] = _length(acceleration)
    frames[:, 25] = _length(jerk)
    along = np.einsum("ti,ti->t", velocity[:, 0], acceleration[:, 0]) / np.maximum(frames[:, 15], 1e-9)
    frames[:, 14] = _mean_around(_peaks(-along), frame_time) * WINDOW / frame_time
    return velocity[:, 0]


def _peaks(braking: Array) -> Array:
    """Return 1 (T,) where the braking has a peak above ``BRAKING`` that stands out as much, 0 elsewhere."""
    from scipy.signal import find_peaks

    out = np.zeros(len(braking))
    out[find_peaks(braking, height=BRAKING, prominence=BRAKING)[0]] = 1.0
    return out


def _mean_around(values: Array, frame_time: float) -> Array:
    """Return the mean (T,) of ``values`` (T,) over the window around each frame."""
    length = window_frames(len(values), frame_time)
    starts = around(len(values), length)
    total = np.concatenate([[0.0], np.cumsum(values)])
    return (total[starts + length] - total[starts]) / length


def _zones(height: Array) -> Array:
    """Return the share (T, 3) of the hands above the head, down to the chest, and below it."""
    hands = height[:, [INDEX["left_hand"], INDEX["right_hand"]]]
    above = hands > height[:, [INDEX["head"]]]
    below = ~above & (hands < height[:, [INDEX["chest"]]])
    return np.stack([zone.mean(axis=1) for zone in (above, ~above & ~below, below)], axis=1)


def _fill_space(
    frames: Array,
    points: Array,
    velocity: Array,
    ground: Array,
    frame_time: float,
    *,
    stride: float = STRIDE,
) -> None:
    """Fill in f35 and f36; ``ground`` (2, 3) are the axes of the floor."""
    frames[:, 34] = _mean_around(_length(velocity @ ground.T), frame_time) * WINDOW
    (smooth,) = derivatives(points[:, INDEX["pelvis"]], frame_time, orders=(0,))
    step, length, starts, middle = _hull_windows(len(points), frame_time, stride=stride)
    path = (smooth @ ground.T)[::step]
    areas = [hull_size(path[s : s + length]) / (length * step * frame_time) for s in starts]
    frames[:, 35] = np.interp(np.arange(len(points)), middle, areas)


def _total_volume(points: Array, frame_time: float) -> Array:
    """Return f37 (T,)."""
    step, length, starts, middle = _hull_windows(len(points), frame_time)
    thin = points[::step]
    volumes = [hull_size(thin[s : s + length].reshape(-1, 3)) for s in starts]
    return np.interp(np.arange(len(points)), middle, volumes)


def _hull_windows(
    frames: int, frame_time: float, *, stride: float = STRIDE
) -> tuple[int, int, Integers, Array]:
    """Return every so many frames, how many of these make a window, where windows start, and their middles.

    Hulls of a window are of some 30 frames a second, ``stride`` apart, and run in straight lines between.
    """
    step = max(1, round(1.0 / (RATE * frame_time)))
    thin = len(range(0, frames, step))
    length = window_frames(thin, step * frame_time)
    starts = window_starts(thin, length, step * frame_time, stride=stride)
    return step, length, starts, (starts + 0.5 * (length - 1)) * step


def _starts(frames: int, length: int, frame_time: float, stride: float) -> Integers:
    if not (np.isfinite(stride) and stride > 0):
        raise MienError(f"stride must be above 0 seconds, got {stride}")
    return window_starts(frames, length, frame_time, stride=stride)


def _crests(frames: Array) -> Array:
    """Return the features (T, 37) with the peaks of Effort as high as they are between the frames.

    A quick peak has few frames on it at 30 frames a second: the parabola through the highest and its two
    neighbours tells how high it is, ``b + (c - a)^2 / (8 (2 b - a - c))``.
    """
    out = frames.copy()
    a, b, c = frames[:-2, _EFFORT], frames[1:-1, _EFFORT], frames[2:, _EFFORT]
    bend = 2.0 * b - a - c
    peak = (b >= a) & (b >= c) & (bend > 0.0)
    out[1:-1, _EFFORT] = np.where(peak, b + (c - a) ** 2 / (8.0 * np.where(peak, bend, 1.0)), b)
    return out


def _derive(frames: Array, zones: Array, frame_time: float, stride: float) -> Array:
    """Return the derived features (W, 121) of the basic ones (T, 37) and the zones of the hands (T, 3)."""
    length = window_frames(len(frames), frame_time)
    starts = _starts(len(frames), length, frame_time, stride)
    values = windowed(frames, starts, length)
    mean = values.mean(axis=-1)
    found = {
        "max": windowed(_crests(frames), starts, length).max(axis=-1),
        "min": values.min(axis=-1),
        "std": np.sqrt(np.square(values - mean[..., None]).mean(axis=-1)),
        "mean": mean,
        "window": frames[starts + length // 2],
    }
    shares = windowed(zones, starts, length).mean(axis=-1)
    out = np.empty((len(starts), len(DERIVED)))
    for i, d in enumerate(DERIVED):
        if d.statistic in ZONES:
            out[:, i] = shares[:, ZONES.index(d.statistic)]
        else:
            out[:, i] = found[d.statistic][:, d.feature.number - 1]
    return out
