"""Which features tell emotions apart and are alike between performers (Aristidou et al. 2017)."""

import numpy as np

from ..typing import Array, Integers

EFFECTIVE, CONSISTENT = 0.21, 0.20  # standard deviations of features scaled to [0, 1]
PERFORMERS, EMOTIONS = 7.0 / 9.0, 10.0 / 12.0  # shares for whom it must hold


def effective(means: Array) -> Array:
    """Return for (P, E, F) means of performers and emotions whether (F,) features tell emotions apart.

    A feature does for a performer if it varies by 0.21 or more over the emotions, and overall if for seven of
    nine performers.
    """
    found: Array = (means.std(axis=1) >= EFFECTIVE).mean(axis=0) >= PERFORMERS - 1e-9
    return found


def consistent(means: Array) -> Array:
    """Return for (P, E, F) means whether (F,) features are alike between performers.

    A feature is for an emotion if it varies by no more than 0.20 over the performers, and overall if for ten
    of twelve emotions.
    """
    found: Array = (means.std(axis=0) <= CONSISTENT).mean(axis=0) >= EMOTIONS - 1e-9
    return found


def select(means: Array) -> Integers:
    """Return the indices of the features that are both, for means (P, E, F) scaled to [0, 1]."""
    return np.flatnonzero(np.logical_and(effective(means), consistent(means)))
