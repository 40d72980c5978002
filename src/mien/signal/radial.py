"""Smooth functions through or near scattered points: radial basis functions with a linear part.

``f(x) = w0 + W x + sum_k l_k phi(|x - c_k|)``, for any number of values at once. Two ways to find the weights
(Aristidou et al. 2017, equations 1 to 4):

* ``near``: Gaussian ``phi(r) = exp(-r^2 / (2 s^2))`` around given centres, fitted to many points by ridge
  least squares. Fitted to the centres alone, as the paper is written, the weights are not determined.
* ``through``: multiquadric ``phi(r) = sqrt(1 + r^2 / s^2)`` around the points themselves, with
  ``sum l = 0`` and ``sum l c = 0``, so that it goes through every point and repeats linear functions.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..errors import MienError
from ..typing import Array

Kind = Literal["gaussian", "multiquadric"]
RIDGES = tuple(10.0**e for e in np.arange(-6.0, 3.01, 0.25))


@dataclass(frozen=True, eq=False)
class Radial:
    """A fitted function from (D,) to (P,).

    ``centres`` (K, D), their width ``sigma``, the weights ``constant`` (P,), ``linear`` (D, P), ``radial``
    (K, P), and the ``ridge`` that was used.
    """

    kind: Kind
    centres: Array
    sigma: float
    constant: Array
    linear: Array
    radial: Array
    ridge: float = 0.0

    def __call__(self, points: Array) -> Array:
        """Return the values (..., P) at points (..., D)."""
        points = np.asarray(points, float)
        basis = _basis(self.kind, points, self.centres, self.sigma)
        found: Array = self.constant + points @ self.linear + basis @ self.radial
        return found


def mean_distance(points: Array) -> float:
    """Return the mean distance between two different points of (N, D); 1 where all are the same."""
    points = np.asarray(points, float)
    rows, columns = np.triu_indices(len(points), 1)
    found = float(np.linalg.norm(points[rows] - points[columns], axis=-1).mean()) if len(rows) else 0.0
    return found if found > 0.0 else 1.0


def near(
    points: Array, values: Array, centres: Array, *, ridge: float | None = None, linear: bool = True
) -> Radial:
    """Return the function with Gaussians around ``centres`` (K, D) that is near the values at the points.

    ``points`` (N, D), ``values`` (N, P). ``ridge`` is the penalty on the squares of all weights but the
    constant; None takes the one with the least generalised cross-validation error (Golub, Heath and Wahba
    1979). ``linear=False`` leaves the linear part out.
    """
    points, values, centres = (np.atleast_2d(np.asarray(a, float)) for a in (points, values, centres))
    sigma = mean_distance(centres)
    basis = _basis("gaussian", points, centres, sigma)
    design = np.concatenate([points, basis], axis=1) if linear else basis
    means = design.mean(axis=0)
    u, s, vt = np.linalg.svd(design - means, full_matrices=False)
    inside = u.T @ (values - values.mean(axis=0))
    chosen = _least_gcv(s, inside, values, len(points)) if ridge is None else ridge
    shrink = s / np.maximum(s * s + chosen, 1e-300)
    weights = vt.T @ (shrink[:, None] * inside)
    slope = weights[: points.shape[1]] if linear else np.zeros((points.shape[1], values.shape[1]))
    constant = values.mean(axis=0) - means @ weights
    return Radial("gaussian", centres, sigma, constant, slope, weights[-len(centres) :], chosen)


def through(points: Array, values: Array) -> Radial:
    """Return the multiquadric function that has ``values`` (N, P) at ``points`` (N, D).

    The width is the mean distance of the points. Raises ``MienError`` where two points are the same or all
    lie on one line, plane, ..., so that no linear part is determined.
    """
    points, values = (np.atleast_2d(np.asarray(a, float)) for a in (points, values))
    count, size = points.shape
    sigma = mean_distance(points)
    corner = np.concatenate([np.ones((count, 1)), points], axis=1)
    system = np.zeros((count + size + 1, count + size + 1))
    system[:count, :count] = _basis("multiquadric", points, points, sigma)
    system[:count, count:] = corner
    system[count:, :count] = corner.T
    if np.linalg.matrix_rank(system) < len(system):
        raise MienError(
            f"{count} points in {size} dimensions do not determine a function; give others that differ in all"
        )
    found = np.linalg.solve(system, np.concatenate([values, np.zeros((size + 1, values.shape[1]))]))
    radial, constant, slope = found[:count], found[count], found[count + 1 :]
    return Radial("multiquadric", points, sigma, constant, slope, radial)


def _basis(kind: Kind, points: Array, centres: Array, sigma: float) -> Array:
    square = ((points[..., None, :] - centres) ** 2).sum(axis=-1) / sigma**2
    return np.exp(-0.5 * square) if kind == "gaussian" else np.sqrt(1.0 + square)


def _least_gcv(s: Array, inside: Array, values: Array, count: int) -> float:
    """Return the ridge with the least ``N |rest|^2 / (N - degrees of freedom)^2``."""
    outside = float(((values - values.mean(axis=0)) ** 2).sum() - (inside**2).sum())
    best, least = RIDGES[0], np.inf
    for ridge in RIDGES:
        left = ridge / (s * s + ridge)
        freedom = count - 1.0 - float((1.0 - left).sum())
        rest = outside + float(((left[:, None] * inside) ** 2).sum())
        score = rest / max(freedom, 1e-9) ** 2
        if score < least:
            best, least = ridge, score
    return best
