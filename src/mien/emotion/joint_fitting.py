"""All coefficients at once, on the body that follows them: what Aristidou et al. (2017) leave to come.

Features are measured after inverse kinematics, so that a wish that the body cannot do is seen: arms that are
too short, legs that are straight. The tempo moves no point and so is that of rule g4. Two stages:

1. ``joint``: the ten coefficients of each cluster of poses, by the same method as the rules.
2. ``drifted``: coefficients that change over time, ``c_t = c exp(q_t)`` with a knot each third of a second:
   ``sum_t |V (f_t - f*_t)|^2 + mu_2 |q|^2 + mu_3 |D^2 q|^2``, one Gauss-Newton step: the misses of a knot are
   its own, so the whole system is a band.

Neither is taken where it is worse than what came before.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..kinematics.contacts import detect
from ..kinematics.control_points import NAMES, moved
from ..kinematics.landmarks import landmarks
from ..motion import Motion
from ..typing import Array, Integers
from .control_features import faces
from .rule_fitting import HIGH, LOW, Found, fit, penalty
from .rule_wish import Wish

TRIALS = 2  # of the first stage at most
APART = 10.0  # seconds between keyframes, so that the way from one to the next says nothing
KNOT, MOST_KNOTS = 1.0 / 3.0, 24  # seconds between knots; more than so many are further apart
SIZE, BEND = 0.5, 4.0  # mu_2 and mu_3, of q in half ranges of log c
FURTHEST = 0.35  # of q, in log c
HALVINGS = 2
SLOPE = 1e-3  # of q, for its slope


class Bodies:
    """The keyframes of a wish as a body that follows the coefficients."""

    def __init__(self, wish: Wish) -> None:
        self.wish = wish
        self.planted = detect(wish.motion, body=wish.body).feet[wish.frames]

    def points(self, coefficients: Array) -> Array:
        """Return the landmarks (N, K, 19, 3) in heights for coefficients (N, K, 10)."""
        many, keys = coefficients.shape[:2]
        body = self.wish.body
        stacked = _stacked(self.wish.motion, self.wish.frames, many)
        done = moved(stacked, body, coefficients.reshape(many * keys, -1), np.tile(self.planted, (many, 1)))
        return landmarks(done, body).points.reshape(many, keys, -1, 3) / body.height

    def misses(self, coefficients: Array) -> Array:
        """Return the misses (N, K, 16) for coefficients (N, K, 10), hulls with the faces of the first."""
        points = self.points(coefficients)
        return self.wish.misses(points, near=faces(points[0]))


def joint(wish: Wish, start: Found) -> Found:
    """Return the coefficients fitted all at once, from ``start``, what the rules found.

    A cluster where that is no better keeps its ``start``.
    """
    bodies = Bodies(wish)

    def misses(trials: Array) -> Array:
        """Return the misses (N, K, 16) of many trials (N, B, 10)."""
        return bodies.misses(trials[:, wish.member])

    return replace(start, pose=fit(misses, start.pose, LOW, HIGH, wish.member, most=TRIALS))


def objective(wish: Wish, found: Found) -> float:
    """Return half the sum of the squares of all misses of coefficients, after inverse kinematics."""
    away = Bodies(wish).misses(found.pose[None, wish.member])
    pose = (away**2).sum() + (penalty(found.pose, LOW, HIGH) ** 2).sum()
    return 0.5 * float(pose + (wish.pace_misses(np.array([found.tempo])) ** 2).sum())


@dataclass(frozen=True, eq=False)
class Drift:
    """Coefficients (K, 10) at ``times`` (K,), and the objective ``before`` and ``after`` they drifted."""

    times: Array
    values: Array
    before: float
    after: float


def drifted(wish: Wish, base: Callable[[Array], Array]) -> Drift:
    """Return the coefficients with what each knot wants of them; ``base`` times (K,) -> (K, 10) as they were.

    The knots are the frames that are looked at. Where no step along the way found makes it better, they are
    as they were.
    """
    motion = wish.motion
    first = wish.frames[0]
    step = max(KNOT, (len(motion) - 1 - first) * motion.frame_time / MOST_KNOTS)
    count = max(1, round((len(motion) - 1 - first) * motion.frame_time / step)) + 1
    there = wish.elsewhere(np.unique(np.linspace(first, len(motion) - 1, count).round().astype(np.int64)))
    times = there.frames * motion.frame_time
    start, bodies, keys = base(times), Bodies(there), len(there.frames)
    scale = 0.5 * np.log(HIGH / LOW)
    # Misses count as often as there are knots, whatever cluster they are in.
    often = np.sqrt(np.bincount(there.member, minlength=there.clusters)[there.member])[:, None]
    trials = np.concatenate([start[None], start * np.exp(SLOPE * scale * np.eye(len(NAMES)))[:, None]])
    away = bodies.misses(trials) * often
    slopes = np.moveaxis((away[1:] - away[0]) / SLOPE, 0, -1)  # (K, 16, 10)
    q = _banded(slopes, away[0])
    limit = FURTHEST / scale

    def cost(misses: Array, drift: Array) -> float:
        """Return the objective for each knot of ``misses`` (K, 16) and a ``drift`` (K, 10) in half ranges."""
        bend = np.diff(drift, n=2, axis=0) if keys > 2 else np.zeros(1)
        return 0.5 * float((misses**2).sum() + SIZE * (drift**2).sum() + BEND * (bend**2).sum()) / keys

    before = cost(away[0], np.zeros_like(start))
    for halving in range(HALVINGS + 1):
        drift = np.clip(q * 0.5**halving, -limit, limit)
        values = np.clip(start * np.exp(drift * scale), LOW, HIGH)
        after = cost((bodies.misses(values[None]) * often)[0], drift)
        if after < before:
            return Drift(times, values, before, after)
    return Drift(times, start, before, before)


def _banded(slopes: Array, misses: Array) -> Array:
    """Return the drift (K, 10) with the least cost where misses (K, 16) change by ``slopes`` (K, 16, 10).

    The normal equations, ordered by knot, are a band of 20 on either side.
    """
    from scipy.linalg import solveh_banded

    keys, count = len(slopes), slopes.shape[-1]
    square = np.einsum("kri,krj->kij", slopes, slopes) + SIZE * np.eye(count)
    bend = np.diff(np.eye(keys), n=2, axis=0) if keys > 2 else np.zeros((1, keys))
    stiff = BEND * bend.T @ bend
    band = np.zeros((2 * count + 1, keys * count))
    for i in range(count):
        for j in range(i, count):
            band[j - i, i::count] = square[:, i, j]
    for apart in range(min(3, keys)):
        along = np.repeat(np.diagonal(stiff, apart), count)
        band[apart * count, : len(along)] += along
    right = -np.einsum("kri,kr->ki", slopes, misses).ravel()
    return np.asarray(solveh_banded(band, right, lower=True)).reshape(keys, count)


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
