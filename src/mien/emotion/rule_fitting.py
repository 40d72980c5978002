"""Fit the coefficients of the four rules to a wish, one rule after the other.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, equation 6:
``min_c sum_t |f*_t - f_t(c)|^2`` for each rule, from 1 on, on the points that the rules move, by the
interior-reflective Newton method (Coleman & Li 1996), in each cluster of poses for itself.

Differences: features are weighed by how surely emotions change them; volumes, which three rules affect, are
wished of the hands alone, as whoever leans less to be smaller is not sad; a small penalty on ``log c`` keeps
at 1 what does nothing; faces of hulls are found before the search for the hands, not for each trial.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..kinematics.control_points import NAMES
from ..kinematics.control_rules import BOUNDS
from ..typing import Array, Integers
from .control_features import AFFECTED, POSE, VOLUME, faces
from .rule_wish import Wish

PENALTY = 0.5  # of log c, over half its range, in spreads of one feature
STEP = 1e-4  # of a coefficient, for its slope
LOOKED_AT = 9  # values of a single coefficient over its range, before the search
NUDGE = 0.02  # of the range that a search starts from its ends
ROUGH, TRIALS = 3e-3, 8  # a search ends where it gains less, or after so many
# The rules about poses in their order, and where their coefficients are.
PLACES = {"pelvis": [0], "torso": [1], "hands": list(range(2, len(NAMES)))}
# Where coefficients are looked for: not as far as the edit goes, as a hand that comes nearer to four places
# at once is soon inside the body, and nobody walks in a squat.
RANGES = {**BOUNDS, "pelvis": (0.88, 1.4), "torso": (0.3, 2.0), "hand": (0.8, 1.5)}
LOW, HIGH = (np.array([RANGES[n if n in RANGES else "hand"][i] for n in NAMES]) for i in range(2))
SLOWEST, FASTEST = BOUNDS["tempo"]


@dataclass(frozen=True, eq=False)
class Found:
    """Coefficients: ``pose`` (B, 10) of each cluster as ``NAMES``, and the ``tempo`` of the clip."""

    pose: Array
    tempo: float

    @property
    def vector(self) -> Array:
        """All numbers (10 B + 1,)."""
        return np.append(self.pose.ravel(), self.tempo)

    @classmethod
    def of(cls, vector: Array) -> "Found":
        """Return the coefficients from all numbers."""
        return cls(vector[:-1].reshape(-1, len(NAMES)), float(vector[-1]))


def sequential(wish: Wish) -> Found:
    """Return the coefficients found rule by rule: g1, g2, g3, g4.

    Volumes are wished of the hands alone, which change them most.
    """
    c = np.ones((wish.clusters, len(NAMES)))
    for rule, some in PLACES.items():
        near = faces(wish.ruled(c[None])[0]) if rule == "hands" else None
        columns = [POSE.index(f) for f in AFFECTED[rule] if near is not None or f not in VOLUME]
        c[:, some] = _fitted(wish, c, some, columns, near=near)
    return Found(c, fitted_tempo(wish))


def _fitted(
    wish: Wish, c: Array, some: list[int], columns: list[int], *, near: Sequence[Integers] | None
) -> Array:
    """Return ``some`` of the coefficients (B, P), fitted to the features in ``columns``."""

    def misses(trials: Array) -> Array:
        """Return the misses (N, K, R) of many trials (N, B, P)."""
        whole = np.tile(c, (len(trials), 1, 1))
        whole[..., some] = trials
        return wish.misses(wish.ruled(whole), near=near)[..., columns]

    return fit(misses, c[:, some], LOW[some], HIGH[some], wish.member)


def fitted_tempo(wish: Wish) -> float:
    """Return the tempo whose pace is nearest to what is wanted, by rule g4."""

    def misses(trials: Array) -> Array:
        """Return how far the pace of many trials (N, 1, 1) is off (N, 1)."""
        return wish.pace_misses(trials[:, 0, 0])[:, None]

    low, high = np.array([SLOWEST]), np.array([FASTEST])
    return float(fit(misses, np.ones((1, 1)), low, high, np.zeros(1, np.int64))[0, 0])


def penalty(c: Array, low: Array, high: Array) -> Array:
    """Return what coefficients (..., P) away from 1 cost, more where their bounds are narrow."""
    return np.asarray(PENALTY * np.log(c) / (0.5 * np.log(high / low)))


def fit(
    misses: Callable[[Array], Array],
    start: Array,
    low: Array,
    high: Array,
    member: Integers,
    *,
    most: int = TRIALS,
) -> Array:
    """Return the coefficients (B, P) with the least squares, by the interior-reflective method of SciPy.

    ``misses`` (N, B, P) -> (N, K, R) of many trials at once, row k a matter of block ``member[k]`` alone, so
    that one trial tells a slope of every block. A single coefficient is first looked for all over its range,
    then on that side of its start: rule g1 has another slope there, and a head comes down forwards and
    backwards.
    """
    from scipy.optimize import least_squares

    blocks, count = start.shape
    lows, highs = np.tile(low, (blocks, 1)), np.tile(high, (blocks, 1))
    where = np.arange(len(member))

    def whole(trials: Array) -> tuple[Array, Array]:
        """Return the misses of many trials, and what they cost by themselves (N, B, P)."""
        return misses(trials), penalty(trials, low, high)

    def of_one(x: Array) -> Array:
        """Return the residuals of one trial, as SciPy wants them: one row."""
        return np.concatenate([part.ravel() for part in whole(x.reshape(1, blocks, count))])

    def slopes(x: Array) -> Array:
        """Return the Jacobian of ``of_one``, from as many trials as a block has coefficients."""
        here = x.reshape(blocks, count)
        steps = np.where(here + STEP <= highs, STEP, -STEP)
        trials = np.concatenate([here[None], here + steps.T[..., None] * np.eye(count)[:, None]])
        away, cost = whole(trials)
        change = (away[1:] - away[0]) / steps.T[:, member][..., None]
        out = np.zeros((*away.shape[1:], blocks, count))
        out[where, :, member] = np.moveaxis(change, 0, -1)
        own = np.diag(((cost[1:] - cost[0]).sum(axis=-1) / steps.T).T.ravel())
        return np.concatenate([out.reshape(-1, blocks * count), own])

    begin = start
    if count == 1:
        begin = _best_of_some(misses, start, low, high, member)
        up, down = begin > start, begin < start
        if not (up | down).any():
            return start
        lows, highs = np.where(up, start, lows), np.where(down, start, highs)
    inside = np.clip(begin, lows + NUDGE * (highs - lows), highs - NUDGE * (highs - lows))
    bounds = lows.ravel(), highs.ravel()
    found = least_squares(of_one, inside.ravel(), slopes, bounds, ftol=ROUGH, xtol=ROUGH, max_nfev=most)
    best = found.x.reshape(blocks, count)
    after, before = (_block_costs(misses, x, low, high, member) for x in (best, start))
    return np.where((after < before)[:, None], best, start)


def _best_of_some(
    misses: Callable[[Array], Array], start: Array, low: Array, high: Array, member: Integers
) -> Array:
    """Return for each block (B, 1) the best of ``start``, values beside it, and some over the range."""
    ratios = np.exp(np.linspace(np.log(low[0]), np.log(high[0]), LOOKED_AT))
    values = np.concatenate([[start[0, 0]], start[0, 0] + STEP * np.array([-1.0, 1.0]), ratios])
    trials = np.broadcast_to(values[:, None, None], (len(values), *start.shape))
    rows = (misses(trials) ** 2).sum(axis=-1)
    costs = np.stack([np.bincount(member, row, minlength=len(start)) for row in rows])
    costs += (penalty(trials, low, high) ** 2).sum(axis=-1)
    return values[costs.argmin(axis=0)][:, None]


def _block_costs(
    misses: Callable[[Array], Array], x: Array, low: Array, high: Array, member: Integers
) -> Array:
    """Return half the sum of squares (B,) of each block at ``x`` (B, P)."""
    rows = (misses(x[None])[0] ** 2).sum(axis=-1)
    own = (penalty(x, low, high) ** 2).sum(axis=-1)
    return np.asarray(0.5 * (np.bincount(member, rows, minlength=len(x)) + own))
