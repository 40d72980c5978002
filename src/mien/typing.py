"""The array types used in signatures, float64 unless a docstring says otherwise; and who is told of work."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]
Integers = NDArray[np.int64]
Mask = NDArray[np.bool_]

# Is told what is being done, and which share of all of it is behind (None: not known). What it raises ends
# the work.
Progress = Callable[[str, float | None], None]


def untold(what: str, share: float | None) -> None:
    """Tell nobody."""


def share_of(progress: Progress, low: float, high: float) -> Progress:
    """Return who is told of work that is a part of a larger one, from its share ``low`` to ``high``."""
    return lambda what, share: progress(what, None if share is None else low + (high - low) * share)
