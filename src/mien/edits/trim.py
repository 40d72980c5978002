"""Keep a stretch of time: the frames from ``start`` to ``end``, both included.

To the motion: frames before and after go; the numbers of those kept are not touched, and time starts
at 0 again. To the viewer: the T-pose before a take or the walk-off after it is gone.
"""

from math import floor
from typing import Annotated

from ..errors import MienError
from ..motion import Motion
from .registry import Param, edit


@edit(kind="time", paper="", equation="frames round(start fps) to round(end fps)")
def trim(
    motion: Motion,
    *,
    start: Annotated[float, Param("first moment kept", 0.0, 1e6, "seconds")] = 0.0,
    end: Annotated[
        float | None, Param("last moment kept; none is the end of the clip", 0.0, 1e6, "seconds")
    ] = None,
) -> Motion:
    """Keep the frames from the one nearest to ``start`` to the one nearest to ``end``, both included.

    The same time twice keeps one frame, a still. An ``end`` after the last frame is that frame. Raises
    ``MienError`` where ``start`` is after the last frame or after ``end``.
    """
    last = len(motion) - 1
    until = last if end is None else min(_nearest(end, motion), last)
    first = _nearest(start, motion)
    if first > last or first > until:
        what = "after the end of the clip" if first > last else f"after the end at {end:g} s"
        raise MienError(f"trim: {start:g} s is {what}; the clip lasts {motion.duration:g} s")
    last = until
    return motion if (first, last) == (0, len(motion) - 1) else motion[first : last + 1]


def _nearest(time: float, motion: Motion) -> int:
    """Return the frame nearest to a time; of two equally near, the later."""
    return floor(time * motion.fps + 0.5 + 1e-6)
