"""Which of several groups a point belongs to: linear discriminant analysis with a shrunken covariance.

All groups share one covariance ``S``, estimated within them and drawn towards a round one of the same mean
variance: ``C = (1 - s) S + s tr(S) / D`` (Friedman 1989). The score of a group with the mean ``m`` is
``m' C^-1 x - m' C^-1 m / 2``; groups are equally likely beforehand.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import MienError
from ..typing import Array


@dataclass(frozen=True, eq=False)
class Discriminant:
    """The planes between groups: ``names`` (K), their ``weights`` (K, D) and ``offsets`` (K,)."""

    names: tuple[str, ...]
    weights: Array
    offsets: Array

    def log_probabilities(self, points: Array) -> Array:
        """Return the logarithm of each group's probability (..., K) at points (..., D)."""
        scores = np.asarray(points, float) @ self.weights.T + self.offsets
        top = scores - scores.max(axis=-1, keepdims=True)
        found: Array = top - np.log(np.exp(top).sum(axis=-1, keepdims=True))
        return found

    def pulls(self, point: Array, name: str) -> Array:
        """Return how much each component (D,) of a point speaks for a group rather than the mean of all."""
        own = self.weights[self.names.index(name)] - self.weights.mean(axis=0)
        pulled: Array = own * np.asarray(point, float)
        return pulled


def discriminate(points: Array, groups: Sequence[str], *, shrinkage: float = 0.3) -> Discriminant:
    """Return the discriminant of ``points`` (N, D), of which ``groups`` (N) says to which group each belongs.

    ``shrinkage`` from 0 to 1. Raises ``MienError`` where there are fewer than two groups, or no variance.
    """
    points, labels = np.asarray(points, float), np.asarray(groups)
    names = tuple(sorted(set(labels.tolist())))
    if len(names) < 2:
        raise MienError(f"to tell groups apart takes two or more, got {len(names)}")
    means = np.array([points[labels == name].mean(axis=0) for name in names])
    rest = points - means[[names.index(label) for label in labels.tolist()]]
    covariance = rest.T @ rest / len(points)
    size = np.trace(covariance) / len(covariance)
    if not size > 0.0:
        raise MienError("within their groups all points are the same; give more than one example of each")
    covariance = (1.0 - shrinkage) * covariance + shrinkage * size * np.eye(len(covariance))
    weights = np.linalg.solve(covariance, means.T).T
    return Discriminant(names, weights, -0.5 * np.einsum("kd,kd->k", weights, means))
