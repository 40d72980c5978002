"""When a body is in the air: nothing of it touches the floor, and it falls."""

import numpy as np

from ..typing import Array, Mask
from .contacts import spans

CLEAR = 0.06  # leg lengths above the floor
SHORTEST, LONGEST = 0.1, 1.5  # seconds
RUN_CLEAR, RUN_SHORTEST = 0.02, 0.06  # of the flights of a run
FALLS = 0.75  # of gravity that a body in flight may at most be held up with


def airborne(
    lowest: Array, planted: Mask, leg: float, frame_time: float, *, runs: bool = False
) -> list[tuple[int, int]]:
    """Return when the whole body is clearly above the floor, as ``(first frame, frame after the last)``.

    From the height of its lowest point (T,) and whether its feet are planted (T, 2). Only what lasts 0.1 to
    1.5 s: nobody jumps longer, who stays up hangs or stands on something. ``runs`` counts what is lower and
    shorter too.
    """
    clear, shortest = (RUN_CLEAR, RUN_SHORTEST) if runs else (CLEAR, SHORTEST)
    up = (lowest > clear * leg) & ~planted.any(axis=1)
    return [(a, b) for a, b in spans(up) if shortest <= (b - a) * frame_time <= LONGEST]


def falling(air: list[tuple[int, int]], held: Array, gravity: float) -> list[tuple[int, int]]:
    """Return those stretches in which the body falls at least by a quarter of gravity, on average.

    ``held`` (T,) is the force that holds it up, per kilogram: what falls less is held by what is not shown.
    """
    return [(a, b) for a, b in air if float(np.mean(held[a:b])) < FALLS * gravity]
