"""Flights: clear of the floor for long enough, falling, and neither planted nor hung up."""

import numpy as np

from mien.kinematics.flights import airborne, falling
from mien.kinematics.mass import GRAVITY


def low(*stretches: tuple[int, int], height: float = 0.1) -> np.ndarray:
    """Return heights (100,) of 0, and ``height`` in some stretches."""
    out = np.zeros(100)
    for start, stop in stretches:
        out[start:stop] = height
    return out


STANDS = np.zeros((100, 2), bool)


def test_only_what_is_high_and_long_enough_flies() -> None:
    heights = low((10, 40), (50, 55))
    assert airborne(heights, STANDS, 1.0, 0.01) == [(10, 40)]
    assert airborne(low((10, 40), height=0.05), STANDS, 1.0, 0.01) == []
    assert airborne(heights, STANDS, 2.0, 0.01) == [], "0.1 is not high for legs of 2"
    assert airborne(low((0, 100)), STANDS, 1.0, 0.05) == [], "nobody flies for five seconds"


def test_runs_fly_lower_and_shorter() -> None:
    heights = low((10, 18), height=0.03)
    assert airborne(heights, STANDS, 1.0, 0.01) == []
    assert airborne(heights, STANDS, 1.0, 0.01, runs=True) == [(10, 18)]


def test_a_planted_foot_ends_a_flight() -> None:
    planted = np.array(STANDS)
    planted[25, 0] = True
    assert airborne(low((10, 40)), planted, 1.0, 0.01) == [(10, 25), (26, 40)]


def test_what_is_held_up_does_not_fall() -> None:
    held = np.full(100, GRAVITY)
    held[10:40] = 0.1 * GRAVITY
    assert falling([(10, 40), (50, 70)], held, GRAVITY) == [(10, 40)]
