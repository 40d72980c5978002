"""Fit the coefficients of the four rules to a wish, one rule after the other.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, equation 6:
``min_c sum_t |f*_t - f_t(c)|^2`` for each rule, from 1 on, on the points that the rules move.

Differences: features are counted in units of what emotions usually change; a feature that several rules
affect is shared among them; a small penalty on ``log c`` keeps at 1 what does nothing; the keyframes of long
clips are thinned out; faces of hulls are found at the start and for the hands, not for each trial.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..analysis.laban import PACE, pace
from ..kinematics.body import Body
from ..kinematics.control_points import NAMES
from ..kinematics.control_rules import BOUNDS, paced
from ..kinematics.landmarks import landmarks
from ..kinematics.lead_in import lead_in
from ..motion import Motion
from ..typing import Array, Integers
from .control_features import AFFECTED, POSE, Poses, faces, measured

KEYFRAMES = 6.0  # a second: every fifth frame of 30
MOST = 24  # keyframes, evenly spread over longer clips
PENALTY = 1.4  # of log c, over half its range, in usual changes of one feature
STEP = 1e-4  # of a coefficient, for its slope
NUDGE = 0.02  # of the range that a search starts from its ends
ROUGH, TRIALS = 1e-3, 12  # a search ends where it gains less, or after so many
_ORDER = np.array([{**dict.fromkeys(range(12, 17), 2), 17: 3}.get(number, 1) for number in PACE])
# The rules about poses in their order, and where their coefficients are.
PLACES = {"pelvis": [0], "torso": [1], "hands": list(range(2, len(NAMES)))}
LOW, HIGH = (np.array([BOUNDS[n if n in BOUNDS else "hand"][i] for n in (*NAMES, "tempo")]) for i in range(2))


@dataclass(frozen=True, eq=False)
class Wish:
    """What is fitted: the motion's keyframes, and the wanted change in units of what is usual.

    ``frames`` of the motion that are looked at, its ``poses`` there, the faces of their hulls (``near``), its
    ``pace`` (14,) features, ``change`` (31,) and ``scale`` (31,) of the selected features.
    """

    motion: Motion
    body: Body
    frames: Integers
    poses: Poses
    near: Sequence[Integers]
    pace: Array
    change: Array
    scale: Array

    @classmethod
    def of(cls, motion: Motion, change: Array, scale: Array) -> Self:
        """Return the wish for a motion. Raises ``BodyError`` where no body is found."""
        body = Body.of(motion)
        start = lead_in(motion)
        frames = _keyframes(len(motion) - start, motion.frame_time) + start
        points = landmarks(motion[start:], body).points / body.height
        poses = Poses.of(_at(motion, frames), body)
        near = faces(poses.points)
        return cls(motion, body, frames, poses, near, pace(points, body, motion.frame_time), change, scale)

    def wanted_poses(self) -> Array:
        """Return the features (K, 16) of poses that are wanted, f*: as they are, and the change."""
        return (
            measured(self.poses.points, self.poses.up, found=self.near) + self.change[[n - 1 for n in POSE]]
        )

    def misses(self, points: Array, aim: Array, *, near: Sequence[Integers] | None = None) -> Array:
        """Return how far (N, 16 K) the features of points (N, K, 19, 3) are from ``aim`` (K, 16).

        Each in usual changes, so that the squares of a trial add up to the mean over keyframes. ``near`` are
        faces of hulls that are near enough.
        """
        many, keys = points.shape[:2]
        found = None if near is None else [np.tile(part, (many, 1, 1)) for part in near]
        values = measured(points.reshape(many * keys, -1, 3), self.poses.up, found=found)
        scale = self.scale[[n - 1 for n in POSE]] * np.sqrt(keys)
        return ((values.reshape(many, keys, -1) - aim) / scale).reshape(many, -1)

    def pace_misses(self, c: Array) -> Array:
        """Return how far the features of pace (N, 14) are from wanted at tempo ``c`` (N, 1), by g4."""
        rows = [number - 1 for number in PACE]
        ruled = paced(self.pace, c, order=_ORDER)
        return np.asarray((ruled - self.pace - self.change[rows]) / self.scale[rows])


def sequential(wish: Wish) -> Array:
    """Return the coefficients (11,), as ``NAMES`` and the tempo, found rule by rule: g1, g2, g3, g4.

    A feature that several rules affect is wished from each in equal shares of what is left.
    """
    c = np.ones(len(NAMES) + 1)
    aim, near = wish.wanted_poses(), wish.near
    for number, (rule, some) in enumerate(PLACES.items()):
        if rule == "hands":
            near = faces(wish.poses.ruled(c[None, :-1])[0])
        later = [AFFECTED[name] for name in list(PLACES)[number:]]
        share = np.array([1.0 / max(sum(f in affected for affected in later), 1) for f in POSE])
        columns = [POSE.index(f) for f in AFFECTED[rule]]
        c[some] = _fitted(wish, c, some, columns, aim=aim, share=share, near=near)
    c[-1:] = fit(wish.pace_misses, c[-1:], LOW[-1:], HIGH[-1:])
    return c


def _fitted(
    wish: Wish,
    c: Array,
    some: list[int],
    columns: list[int],
    *,
    aim: Array,
    share: Array,
    near: Sequence[Integers],
) -> Array:
    """Return ``some`` of the coefficients, fitted to ``share`` (16,) of what is left to ``aim`` (K, 16)."""
    now = measured(wish.poses.ruled(c[None, :-1])[0], wish.poses.up, found=near)
    target = now + share * (aim - now)

    def misses(trials: Array) -> Array:
        whole = np.tile(c[:-1], (len(trials), 1))
        whole[:, some] = trials
        away = wish.misses(wish.poses.ruled(whole), target, near=near)
        return away.reshape(len(trials), -1, len(POSE))[..., columns].reshape(len(trials), -1)

    return fit(misses, c[some], LOW[some], HIGH[some])


def penalty(c: Array, low: Array, high: Array) -> Array:
    """Return what coefficients (N, P) away from 1 cost, more where their bounds are narrow."""
    return np.asarray(PENALTY * np.log(c) / (0.5 * np.log(high / low)))


def fit(misses: Callable[[Array], Array], start: Array, low: Array, high: Array) -> Array:
    """Return the coefficients with the least squares, by the interior-reflective Newton method of SciPy.

    ``misses`` (N, P) -> (N, R) of many trials at once. A single coefficient is looked for on either side of
    its start, as rule g1 has another slope there.
    """
    from scipy.optimize import least_squares

    def whole(trials: Array) -> Array:
        return np.concatenate([misses(trials), penalty(trials, low, high)], axis=1)

    def of_one(x: Array) -> Array:
        return whole(x[None])[0]

    def slopes(x: Array) -> Array:
        steps = np.where(x + STEP <= high, STEP, -STEP)
        found = whole(np.vstack([x, x + np.diag(steps)]))
        return np.asarray((found[1:] - found[0]).T / steps)

    best, least = start, 0.5 * float((of_one(start) ** 2).sum())
    sides = [(low, high)]
    if len(start) == 1:
        after = whole(np.stack([start - STEP, start + STEP]))
        downhill = 0.5 * (after**2).sum(axis=1) < least
        sides = [side for side, down in zip(((low, start), (start, high)), downhill, strict=True) if down]
    for a, b in sides:
        inside = np.clip(start, a + NUDGE * (b - a), b - NUDGE * (b - a))
        found = least_squares(of_one, inside, slopes, (a, b), ftol=ROUGH, xtol=ROUGH, max_nfev=TRIALS)
        if found.cost < least:
            best, least = found.x, found.cost
    return np.asarray(best)


def _keyframes(frames: int, frame_time: float) -> Integers:
    """Return every fifth frame of 30 a second, or fewer evenly spread."""
    keys = np.arange(0, frames, max(1, round(1.0 / (KEYFRAMES * frame_time))))
    few = np.linspace(0, len(keys) - 1, min(len(keys), MOST)).round().astype(np.int64)
    return keys[few]


def _at(motion: Motion, frames: Integers) -> Motion:
    """Return a motion of some frames, with the body of the whole one."""
    return motion.with_(
        rotations=motion.rotations[frames],
        translations=motion.translations[frames],
        source=None,
        reference=None,
    )
