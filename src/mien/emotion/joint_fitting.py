"""All coefficients at once, on the body that follows the rules: what Aristidou et al. (2017) leave to come.

Features are measured after inverse kinematics, so that a wish that the body cannot do is seen: arms that are
too short, legs that are straight. Those of pace follow rule g4 alone, as in the paper's table 2.
"""

from collections.abc import Sequence

import numpy as np

from ..kinematics.contacts import detect
from ..kinematics.control_points import moved
from ..kinematics.landmarks import landmarks
from ..motion import Motion
from ..typing import Array, Integers
from .control_features import faces
from .rule_fitting import HIGH, LOW, ROUGH, STEP, Wish, penalty

TRIALS = 5  # of the search at most
APART = 10.0  # seconds between keyframes, so that the way from one to the next says nothing


class _Search:
    """The misses of a wish after inverse kinematics, and their slopes."""

    def __init__(self, wish: Wish) -> None:
        self.wish = wish
        self.planted = detect(wish.motion, body=wish.body).feet[wish.frames]
        self.aim = wish.wanted_poses()
        self.last: tuple[bytes, Array, Sequence[Integers]] = (b"", np.zeros(0), ())

    def points(self, coefficients: Array) -> Array:
        """Return the landmarks (N, K, 19, 3) in heights for each of (N, 10) coefficients."""
        many, keys = len(coefficients), len(self.wish.frames)
        body = self.wish.body
        stacked = _stacked(self.wish.motion, self.wish.frames, many)
        values = np.repeat(coefficients, keys, axis=0)
        done = moved(stacked, body, values, np.tile(self.planted, (many, 1)))
        return landmarks(done, body).points.reshape(many, keys, -1, 3) / body.height

    def misses(self, c: Array) -> Array:
        """Return all misses for coefficients (11,); half their squares' sum is what is made small."""
        points = self.points(c[None, :-1])
        self.last = c.tobytes(), points, faces(points[0])
        return self._all(points, c[None], self.last[2])[0]

    def slopes(self, c: Array) -> Array:
        """Return the slope of each miss with each coefficient, by differences, hulls with the same faces."""
        if self.last[0] != c.tobytes():
            self.misses(c)
        _, here, near = self.last
        steps = np.where(c + STEP <= HIGH, STEP, -STEP)
        trials = c + np.diag(steps)
        there = np.concatenate([self.points(trials[:-1, :-1]), here])  # tempo moves no point
        before, after = self._all(here, c[None], near), self._all(there, trials, near)
        return np.asarray((after - before).T / steps)

    def _all(self, points: Array, trials: Array, near: Sequence[Integers]) -> Array:
        pace = self.wish.pace_misses(trials[:, -1:])
        pose = self.wish.misses(points, self.aim, near=near)
        return np.concatenate([pose, pace, penalty(trials, LOW, HIGH)], axis=1)


def joint(wish: Wish, start: Array) -> Array:
    """Return the coefficients (11,) fitted all at once, from ``start`` (11,), what the rules found.

    Where that is no better than ``start``, it is ``start`` itself.
    """
    from scipy.optimize import least_squares

    search = _Search(wish)
    span = HIGH - LOW
    inside = np.clip(start, LOW + 1e-3 * span, HIGH - 1e-3 * span)
    found = least_squares(
        search.misses, inside, search.slopes, (LOW, HIGH), ftol=ROUGH, xtol=ROUGH, max_nfev=TRIALS
    )
    before = 0.5 * float((search.misses(start) ** 2).sum())
    return found.x if found.cost <= before else start


def objective(wish: Wish, c: Array) -> float:
    """Return half the sum of the squares of all misses of coefficients (11,), after inverse kinematics."""
    return 0.5 * float((_Search(wish).misses(c) ** 2).sum())


def _stacked(motion: Motion, frames: Integers, times: int) -> Motion:
    """Return the keyframes ``times`` times after each other, too far apart to have to do with each other."""
    return motion.with_(
        rotations=np.tile(motion.rotations[frames], (times, 1, 1)),
        translations=np.tile(motion.translations[frames], (times, 1, 1)),
        frame_time=APART,
        source=None,
        reference=None,
        history=(),
    )
